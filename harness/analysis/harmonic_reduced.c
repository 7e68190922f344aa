/* Steady-state vibration by superposition of undamped modes.
 *
 * V contains the modes and the static shapes of inputs and outputs, K-orthonormalised. The solution
 * is x = V y with V^T D V y = V^T f (Galerkin). The coupling of modes by damping is included, so
 * the only approximation is the omission of modes. If all modes are used, V is square, and x equals
 * the direct solution.
 *
 * The error due to omitted modes is bounded as follows. The residuals r = f - D x and s = o - D z,
 * where z is the solution for the output o, have no component along the modes, and o^T (D^-1 f - x)
 * = s^T D^-1 r. Scaled by the square root of K, the part of D beyond the modes has a real part of
 * at least 1 - w^2/least - |t| b - d. Here `least` is the square of the next frequency, t is the
 * factor of B in D, and b is the largest eigenvalue of K^-1 B. d is the norm of T D_m^-1 T^T. D_m
 * is the part of D of the modes, and T couples the two parts by damping and by B. Damping
 * dissipates energy and cannot lower the real part. The error is at most sqrt(r^H K^-1 r s^H K^-1
 * s) divided by this real part. For a free structure, K + shift M replaces K. */
#include "harness/analysis/analysis_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "the modes of a harmonic analysis");
}

/* Bounds B: finds the smallest g for which B <= g (M + K/least). Beyond the modes, M <= K/least. */
static status bound_inner(vibration *v, harmonic_modes *m, sparse *N, matrix_factor **factor,
                          eigen_result *e, fault *f)
{
    TRY(sparse_alloc_like(&m->K, N, f));
    for (int i = 0; i < N->column[N->n]; i++)
        N->value[i] = m->M.value[i] + m->K.value[i] / m->least;
    TRY(factor_alloc_like(m->factor, N, factor, f));
    v->c->run->counters.factorisations++;
    TRY(factor_numeric(*factor, N, f));
    const eigen_problem p = {.K = N, .A = &m->B, .K_factor = *factor, .sign = 1, .largest = 1};
    const status outcome = eigen_solve(&p, e, f);
    context_count_eigen(v->c, e);
    if (outcome == STATUS_OK && e->positive.count > 0) /* with a margin */
        m->inner = 1.001 * e->positive.mu[0] * 2 / m->least;
    return outcome;
}

static status largest_inner(vibration *v, harmonic_modes *m, fault *f)
{
    sparse N = {0};
    matrix_factor *factor = NULL;
    eigen_result e = {0};
    const status outcome = bound_inner(v, m, &N, &factor, &e, f);
    eigen_free(&e);
    factor_free(factor);
    sparse_free_values(&N);
    return outcome;
}

/* Adds K^-1 f to V, without the component that V already contains. */
static void take_static(harmonic_modes *m, const double f[])
{
    const size_t n = (size_t)m->n;
    double *x = m->V + (size_t)m->count * n, *Kx = m->work;
    memcpy(x, f, n * sizeof *x);
    factor_solve(m->factor, x);
    const double size = dense_dot(m->n, x, f);
    double left = size;
    for (int pass = 0; pass < 3 && left > 0; pass++) {
        sparse_mul(&m->K, x, Kx);
        for (int i = 0; i < m->count; i++) {
            const double *b = m->V + (size_t)i * n, part = dense_dot(m->n, b, Kx);
            for (size_t k = 0; k < n; k++)
                x[k] -= part * b[k];
        }
        sparse_mul(&m->K, x, Kx);
        left = dense_dot(m->n, x, Kx);
        if (!(left > (pass == 0 ? 1e-20 * size : 0.5)))
            return;
        for (size_t k = 0; k < n; k++)
            x[k] /= sqrt(left);
    }
    m->count += size > 0;
}

/* Computes the symmetric P = V^T A V. of_modes: receives A V of the modes; NULL: not requested. */
static void project(const harmonic_modes *m, const sparse *A, double P[], double *of_modes)
{
    const size_t n = (size_t)m->n, count = (size_t)m->count;
    for (size_t j = 0; j < count; j++) {
        sparse_mul(A, m->V + j * n, m->work);
        for (size_t i = 0; i <= j; i++)
            P[i * count + j] = P[j * count + i] = dense_dot(m->n, m->V + i * n, m->work);
        if (of_modes != NULL && j < (size_t)m->kept)
            memcpy(of_modes + j * n, m->work, n * sizeof *m->work);
    }
}

/* Computes X^T (K^-1 - V V^T) Y for the modes V, where X = A V, Y = A' V, solved = K^-1 Y, Xp = X^T
 * V and Yp = V^T Y. */
static void couple(const harmonic_modes *m, const double X[], const double solved[],
                   const double Xp[], const double Yp[], double out[])
{
    const int kept = m->kept;
    const size_t n = (size_t)m->n, count = (size_t)m->count;
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++) {
            double sum = dense_dot(m->n, X + (size_t)i * n, solved + (size_t)j * n);
            for (int k = 0; k < kept; k++)
                sum -= Xp[(size_t)i * count + (size_t)k] * Yp[(size_t)k * count + (size_t)j];
            out[i * kept + j] = sum;
        }
}

static status couplings(harmonic_modes *m, double *X[2], fault *f)
{
    const size_t size = (size_t)m->kept * (size_t)m->n;
    double *solved[2] = {NULL, NULL};
    status outcome = STATUS_OK;
    for (int i = 0; i < 2; i++) {
        solved[i] = malloc((size + 1) * sizeof **solved);
        if (solved[i] == NULL)
            outcome = no_memory(f);
    }
    for (int i = 0; i < 2 && outcome == STATUS_OK; i++) {
        memcpy(solved[i], X[i], size * sizeof **solved);
        factor_solve_many(m->factor, m->kept, m->n, solved[i]);
    }
    if (outcome == STATUS_OK) {
        couple(m, X[0], solved[0], m->Cp, m->Cp, m->coupling[0]);
        couple(m, X[0], solved[1], m->Cp, m->Bp, m->coupling[1]);
        couple(m, X[1], solved[1], m->Bp, m->Bp, m->coupling[2]);
    }
    free(solved[0]);
    free(solved[1]);
    return outcome;
}

static void add_ratios(harmonic_modes *m)
{
    const size_t n = (size_t)m->n, count = (size_t)m->count;
    for (int u = 0; u < m->damped; u++) {
        for (size_t i = 0; i < count; i++)
            m->scale[i] = dense_dot(m->n, m->V + i * n, m->U + (size_t)u * n);
        for (size_t i = 0; i < count; i++)
            for (size_t j = 0; j < count; j++)
                m->Cp[i * count + j] += m->scale[i] * m->scale[j];
    }
}

static status project_all(vibration *v, harmonic_modes *m, double *X[2], fault *f)
{
    const size_t square = (size_t)m->count * (size_t)m->count;
    project(m, &m->K, m->Kp, NULL);
    project(m, &m->M, m->Mp, NULL);
    for (size_t i = 0; i < square; i++)
        m->Kp[i] -= m->shift * m->Mp[i];
    if (v->damped)
        project(m, &m->C, m->Cp, X[0]);
    if (v->inside)
        project(m, &m->B, m->Bp, X[1]);
    if (!m->complete) {
        if (v->inside && isfinite(m->least))
            TRY(largest_inner(v, m, f));
        if (v->damped || v->inside)
            TRY(couplings(m, X, f));
    }
    add_ratios(m);
    return STATUS_OK;
}

status harmonic_modes_project(vibration *v, int count, const double f[], fault *f_)
{
    harmonic_modes *m = v->modes;
    const size_t n = (size_t)m->n, kept = (size_t)m->kept;
    const size_t most = kept + (m->complete ? 0 : (size_t)count);
    double *V = realloc(m->V, (most * n + 1) * sizeof *V);
    if (V == NULL)
        return no_memory(f_);
    m->V = V;
    for (int i = 0; i < count && !m->complete && m->count < m->n; i++)
        take_static(m, f + (size_t)i * n);
    const size_t square = (size_t)m->count * (size_t)m->count;
    double **const block[] = {&m->Kp, &m->Mp, &m->Cp, &m->Bp};
    double *X[2];
    int enough = 1;
    for (int i = 0; i < 4; i++)
        enough &= (*block[i] = calloc(square + 1, sizeof **block[i])) != NULL;
    for (int i = 0; i < 3; i++)
        enough &= (m->coupling[i] = calloc(kept * kept + 1, sizeof *m->coupling[i])) != NULL;
    for (int i = 0; i < 2; i++)
        enough &= (X[i] = calloc((m->complete ? 0 : kept * n) + 1, sizeof *X[i])) != NULL;
    m->D = calloc(square + 1, sizeof *m->D);
    m->entry = calloc((size_t)v->first[m->n] + 1, sizeof *m->entry);
    m->scale = calloc((size_t)m->count + 1, sizeof *m->scale);
    m->pivot = calloc((size_t)m->count + 1, sizeof *m->pivot);
    m->y = calloc((size_t)m->count + 1, sizeof *m->y);
    m->inverse = calloc(kept * kept + 1, sizeof *m->inverse);
    m->half = calloc(2 * kept * kept + 1, sizeof *m->half);
    enough &= m->D != NULL && m->entry != NULL && m->scale != NULL && m->pivot != NULL &&
              m->y != NULL && m->inverse != NULL && m->half != NULL;
    if (m->complete) { /* the solution is exact, so the bound is zero */
        free(X[0]);
        free(X[1]);
        X[0] = X[1] = NULL;
    }
    const status outcome = enough ? project_all(v, m, X, f_) : no_memory(f_);
    free(X[0]);
    free(X[1]);
    return outcome;
}

static double complex projected(const vibration *v, const harmonic_modes *m, double w, size_t k)
{
    const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
    const double complex moves = w * (w - I * damping->mass);
    return m->Kp[k] - w * w * m->Mp[k] + I * w * m->Cp[k] -
           moves * moves / (1 + I * w * damping->stiffness) * m->Bp[k];
}

/* Returns d, the Frobenius norm of T D_m^-1 T^T; INFINITY: unknown. */
static double coupled(vibration *v, harmonic_modes *m, double w)
{
    const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
    const int kept = m->kept;
    const size_t k2 = (size_t)kept * (size_t)kept;
    const double complex moves = w * (w - I * damping->mass), c = I * w,
                         b = -moves * moves / (1 + I * w * damping->stiffness);
    if (kept == 0 || !(v->damped || v->inside))
        return 0;
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++)
            m->inverse[i * kept + j] = projected(v, m, w, (size_t)i * (size_t)m->count + (size_t)j);
    if (LAPACKE_zgetrf(LAPACK_ROW_MAJOR, kept, kept, m->inverse, kept, m->pivot) != 0 ||
        LAPACKE_zgetri(LAPACK_ROW_MAJOR, kept, m->inverse, kept, m->pivot) != 0)
        return INFINITY;
    /* G = T^H T; product = G D^-1, where D is D_m */
    double complex *G = m->half, *product = m->half + k2;
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++) {
            const size_t at = (size_t)i * (size_t)kept + (size_t)j,
                         across = (size_t)j * (size_t)kept + (size_t)i;
            G[at] = conj(c) * c * m->coupling[0][at] + conj(c) * b * m->coupling[1][at] +
                    conj(b) * c * m->coupling[1][across] + conj(b) * b * m->coupling[2][at];
        }
    /* d^2 = tr(G D^-1 conj(G) D^-H), where conj(G) D^-H = conj(G D^-1) because D is symmetric */
    double complex sum = 0;
    memset(product, 0, k2 * sizeof *product);
    for (int i = 0; i < kept; i++)
        for (int k = 0; k < kept; k++)
            for (int j = 0; j < kept; j++)
                product[i * kept + j] += G[i * kept + k] * m->inverse[k * kept + j];
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++)
            sum += product[i * kept + j] * conj(product[j * kept + i]);
    return sqrt(fmax(0, creal(sum)));
}

/* Returns a lower bound of the real part of D beyond the modes. */
static double positive_part(vibration *v, harmonic_modes *m, double w)
{
    const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
    const double complex moves = w * (w - I * damping->mass);
    const double beyond = 1 - (w * w + m->shift) / m->least -
                          cabs(moves * moves / (1 + I * w * damping->stiffness)) * m->inner;
    return beyond > 0 ? beyond - coupled(v, m, w) : beyond;
}

status harmonic_modes_few(const vibration *v, fault *f)
{
    return fault_set(f, STATUS_NOT_CONVERGED,
                     "at %g Hz the number of modes, %d, is too small for an error bound; use more "
                     "modes, up to well above this frequency, or remove solution: modal",
                     v->modes->w / (2 * PI), v->modes->kept);
}

status harmonic_modes_factor(vibration *v, double w, fault *f)
{
    harmonic_modes *m = v->modes;
    const size_t count = (size_t)m->count;
    const int size = m->count;
    m->w = w;
    for (int k = 0; k < v->first[m->n]; k++)
        m->entry[k] = harmonic_dynamic(v, w, v->source[k]);
    for (size_t i = 0; i < count; i++)
        m->scale[i] = 1 / sqrt(m->Kp[i * count + i] + (w * w + m->shift) * m->Mp[i * count + i]);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            m->D[i * count + j] = m->scale[i] * m->scale[j] * projected(v, m, w, i * count + j);
    for (size_t i = 0; i < count && v->loops > 0; i++)
        memcpy(m->closed + i * (count + (size_t)v->loops), m->D + i * count, count * sizeof *m->D);
    m->positive = m->complete ? 1 : positive_part(v, m, w);
    if (!(m->positive > 0))
        return harmonic_modes_few(v, f);
    if (v->loops > 0 && m->complete) /* the factors of D are not needed */
        return STATUS_OK;
    numerics_work_add_dense((double)count);
    if (size == 0)
        return STATUS_OK;
    double condition = 0;
    const double norm = LAPACKE_zlange(LAPACK_ROW_MAJOR, '1', size, size, m->D, size);
    const int info = LAPACKE_zgetrf(LAPACK_ROW_MAJOR, size, size, m->D, size, m->pivot);
    if (info == 0)
        LAPACKE_zgecon(LAPACK_ROW_MAJOR, '1', size, m->D, size, norm, &condition);
    return condition > 1e-14 ? STATUS_OK : fault_set(f, STATUS_SINGULAR, "a mode has no damping");
}

static void subtract_product(const vibration *v, const double complex x[], double complex y[])
{
    const harmonic_modes *m = v->modes;
    for (int j = 0; j < m->n; j++)
        for (int k = v->first[j]; k < v->first[j + 1]; k++)
            y[v->row[k]] -= m->entry[k] * x[j];
    for (int u = 0; u < m->damped; u++) {
        const double *U = m->U + (size_t)u * (size_t)m->n;
        double complex sum = 0;
        for (int k = 0; k < m->n; k++)
            sum += U[k] * x[k];
        for (int k = 0; k < m->n; k++)
            y[k] -= I * m->w * sum * U[k];
    }
}

void harmonic_modes_solve(vibration *v, double complex f[], double complex x[])
{
    harmonic_modes *m = v->modes;
    const size_t n = (size_t)m->n;
    for (int i = 0; i < m->count; i++) {
        m->y[i] = 0;
        for (size_t k = 0; k < n; k++)
            m->y[i] += m->V[(size_t)i * n + k] * f[k];
        m->y[i] *= m->scale[i];
    }
    if (m->count > 0)
        LAPACKE_zgetrs(LAPACK_ROW_MAJOR, 'N', m->count, 1, m->D, m->count, m->pivot, m->y, 1);
    memset(x, 0, n * sizeof *x);
    for (int i = 0; i < m->count; i++)
        for (size_t k = 0; k < n; k++)
            x[k] += m->scale[i] * m->y[i] * m->V[(size_t)i * n + k];
    numerics_work_add(&(numerics_work){
        .solutions = 1, .solved_entries = (double)m->count * (double)(m->n + m->count)});
    if (!m->complete)
        subtract_product(v, x, f);
}

/* Returns r^H K^-1 r. */
static double size_of(vibration *v, const double complex r[])
{
    harmonic_modes *m = v->modes;
    double *re = m->work, *im = m->work + m->n, sum = 0;
    for (int k = 0; k < m->n; k++) {
        re[k] = creal(r[k]);
        im[k] = cimag(r[k]);
    }
    factor_solve_many(m->factor, 2, m->n, m->work);
    for (int k = 0; k < m->n; k++)
        sum += re[k] * creal(r[k]) + im[k] * cimag(r[k]);
    return fmax(0, sum);
}

double harmonic_modes_bound(vibration *v, const double complex left_of_f[],
                            const double complex left_of_o[])
{
    const harmonic_modes *m = v->modes;
    return m->complete ? 0 : sqrt(size_of(v, left_of_f) * size_of(v, left_of_o)) / m->positive;
}

double harmonic_modes_left(vibration *v, const double complex r[])
{
    return sqrt(size_of(v, r));
}
