/* Steady vibration by the modes without damping.
 *
 * With V the modes and the static shapes of inputs and outputs, all by K, the solution is x = V y,
 * V^T D V y = V^T f (Galerkin); damping couples the modes, so that nothing is omitted but modes.
 * With all of them V has as many columns as rows, and x is that of a direct solution.
 *
 * What is omitted is bounded: r = f - D x and s = o - D z of the solution z for the output o have
 * no part along the modes, and o^T (D^-1 f - x) = s^T D^-1 r. Scaled by the root of K, D on what is
 * beyond the modes has a real part of at least
 *   1 - w^2/least - |t| b - d,
 * least the square of the next frequency, t and b the factor of B in D and the largest value of B
 * by K, and d the norm of T D_m^-1 T^T, by which damping and B couple it to the D_m of the modes;
 * damping takes energy and cannot lower it. The error is sqrt(r^H K^-1 r s^H K^-1 s) by that, at
 * most. A structure that is not held has K + shift M in place of K. */
#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "harness/time/time.h"

enum { MOST_DENSE = 3000 };

struct harmonic_modes {
    int n, kept, count; /* of free coordinates; modes, and columns of V */
    int complete;       /* 1: V is complete */
    int damped;         /* modes with a damping ratio */
    sparse K, M, C, B;  /* free block, K shifted */
    matrix_factor *factor;
    double shift, least, inner; /* [1/s^2]; `least` shifted; b */
    double *square;             /* [kept] squares of circular frequencies, shifted */
    double *V;                  /* [count x n] K-orthonormal */
    double *U, *carried;        /* [damped x n]; [damped] factor of V^T K in U^T ... */
    int *of;                    /* [damped] ... for this mode */
    double *Kp, *Mp, *Cp, *Bp;  /* [count x count] V^T K V, ... */
    double *coupling[3];        /* [kept x kept] of C with C, C with B, B with B */
    double complex *D, *entry;  /* [count x count] scaled and factored; of D by v->first */
    double *scale;              /* [count] */
    int *pivot;
    double complex *y, *inverse, *half; /* [count]; [kept x kept] */
    double *work;                       /* [2 n] */
    double w, positive;                 /* the real part above */
};

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for the modes of a harmonic analysis");
}

double complex harmonic_dynamic(const vibration *v, double w, int k)
{
    double complex D = v->K.value[k] - w * w * v->M.value[k];
    if (v->inside) {
        const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
        const double complex moves = w * (w - I * damping->mass);
        D -= moves * moves / (1 + I * w * damping->stiffness) * v->B.value[k];
    }
    return v->damped ? D + I * w * v->C.value[k] : D;
}

void harmonic_modes_free(harmonic_modes *m)
{
    if (m == NULL)
        return;
    sparse *const matrix[] = {&m->K, &m->M, &m->C, &m->B};
    void *const block[] = {
        m->square, m->V,           m->U,           m->carried,     m->Kp,   m->Mp,    m->Cp,
        m->Bp,     m->coupling[0], m->coupling[1], m->coupling[2], m->D,    m->entry, m->scale,
        m->pivot,  m->y,           m->inverse,     m->half,        m->work, m->of,    m};
    factor_free(m->factor);
    for (size_t i = 0; i < sizeof matrix / sizeof matrix[0]; i++)
        sparse_free_values(matrix[i]);
    for (size_t i = 0; i < sizeof block / sizeof block[0]; i++)
        free(block[i]);
}

/* K without singular pivots. */
static status factor_stiffness(vibration *v, harmonic_modes *m, fault *f)
{
    fault why = {""};
    TRY(factor_alloc(&m->K, &m->factor, f));
    v->c->run->counters.factorisations++;
    status outcome = factor_numeric(m->factor, &m->K, &why);
    if (outcome == STATUS_SINGULAR) {
        double k = 0, mass = 0;
        for (int j = 0; j < m->n; j++) {
            k += sparse_diagonal(&m->K, j);
            mass += sparse_diagonal(&m->M, j);
        }
        m->shift = 1e-9 * k / mass;
        for (int i = 0; i < m->K.column[m->n]; i++)
            m->K.value[i] += m->shift * m->M.value[i];
        v->c->run->counters.factorisations++;
        outcome = factor_numeric(m->factor, &m->K, &why);
    }
    if (outcome != STATUS_OK)
        return fault_set(f, outcome, "%s", why.text);
    if (factor_count(m->factor).negative_pivots == 0)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     factor_count(m->factor).negative_pivots < 0
                         ? "undamped modes require a symmetric stiffness, but follower loads or "
                           "springs make it unsymmetric; remove 'solution' and 'ratios'"
                         : "the state is unstable: nothing vibrates steadily about it");
}

static status free_blocks(vibration *v, harmonic_modes *m, fault *f)
{
    const sparse *pattern;
    TRY(v->c->scene->analysis[v->analysis].follows != SCENE_NONE
            ? assemble_pattern_of_states(v->c->model, v->c->run->patterns, 0, &pattern, f)
            : assemble_pattern_at_rest(v->c->model, v->c->run->patterns, 1, 0, &pattern, f));
    const sparse *const from[] = {&v->K, &v->M, &v->C, &v->B};
    sparse *const to[] = {&m->K, &m->M, &m->C, &m->B};
    for (int i = 0; i < 4; i++) {
        TRY(sparse_alloc_like(pattern, to[i], f));
        sparse_copy_leading(from[i], to[i]);
    }
    return STATUS_OK;
}

static void whole(const sparse *a, double D[])
{
    const size_t n = (size_t)a->n;
    for (size_t j = 0; j < n; j++)
        for (int k = a->column[j]; k < a->column[j + 1]; k++)
            D[(size_t)a->row[k] * n + j] = D[j * n + (size_t)a->row[k]] = a->value[k];
}

/* All modes, including those without mass; the first has the lowest frequency. */
static status all_modes(vibration *v, harmonic_modes *m, fault *f)
{
    const size_t n = (size_t)m->n;
    if (m->n > MOST_DENSE)
        return fault_set(f, STATUS_REFUSED,
                         "all modes of %d coordinates are too many (at most %d): give a number of "
                         "modes, such as modes: 50",
                         m->n, MOST_DENSE);
    double *K = calloc(n * n + 1, sizeof *K), *x = calloc(n * n + 1, sizeof *x),
           *mu = calloc(n + 1, sizeof *mu);
    int info = -1;
    if (K != NULL && x != NULL && mu != NULL) {
        whole(&m->K, K);
        whole(&m->M, x);
        info =
            n == 0 ? 0 : LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', m->n, x, m->n, K, m->n, mu);
        v->c->run->counters.dense_operations += (double)n * (double)n * (double)n;
    }
    const double none = 16 * (double)n * sqrt((double)n) * DBL_EPSILON;
    for (size_t i = 0; info == 0 && i < n; i++) {
        const size_t from = n - 1 - i; /* ascending */
        memcpy(m->V + i * n, x + from * n, n * sizeof *x);
        m->square[i] = mu[from] > none * mu[n - 1] ? 1 / mu[from] : INFINITY;
    }
    m->kept = m->count = m->n;
    m->complete = 1;
    free(K);
    free(x);
    free(mu);
    return info == 0    ? STATUS_OK
           : info == -1 ? no_memory(f)
                        : fault_set(f, STATUS_NOT_CONVERGED,
                                    "all modes of %d coordinates: LAPACK returned %d", m->n, info);
}

/* The first modes, and the frequency of the next. */
static status first_modes(vibration *v, harmonic_modes *m, int wanted, fault *f)
{
    const size_t n = (size_t)m->n;
    eigen_result e = {0};
    const eigen_problem p = {
        .K = &m->K, .A = &m->M, .K_factor = m->factor, .sign = 1, .largest = wanted + 1};
    const status outcome = eigen_solve(&p, &e, f);
    context_count_eigen(v->c, &e);
    const int found = e.positive.count;
    if (outcome == STATUS_OK) {
        m->kept = m->count = found < wanted ? found : wanted;
        memcpy(m->V, e.positive.mode, (size_t)m->kept * n * sizeof *m->V);
        for (int i = 0; i < m->kept; i++)
            m->square[i] = 1 / e.positive.mu[i];
        /* without a next one, the others may be round-off of the first */
        m->least = found > wanted ? 1 / e.positive.mu[wanted]
                   : found > 0    ? fmax(m->square[m->kept - 1], 1e8 * m->square[0])
                                  : INFINITY;
    }
    eigen_free(&e);
    return outcome;
}

/* U of the damping ratios: C = M X diag(2 ratio w) X^T M, X^T M X = 1. */
static status damp(const vibration *v, harmonic_modes *m, fault *f)
{
    const scene_analysis *a = &v->c->scene->analysis[v->analysis];
    const scene_path *ratios = &a->damping.ratios;
    const size_t n = (size_t)m->n;
    if (!scene_has_ratios(a))
        return STATUS_OK;
    m->U = calloc((size_t)m->kept * n + 1, sizeof *m->U);
    m->carried = calloc((size_t)m->kept + 1, sizeof *m->carried);
    m->of = calloc((size_t)m->kept + 1, sizeof *m->of);
    if (m->U == NULL || m->carried == NULL || m->of == NULL)
        return no_memory(f);
    for (int i = 0; i < m->kept; i++) {
        const double square = m->square[i] - m->shift,
                     ratio = i < ratios->stations ? ratios->value[i] : a->damping.ratio;
        if (!(ratio > 0) || !isfinite(square) || square <= 1e-9 * m->shift)
            continue;
        double *u = m->U + (size_t)m->damped * n;
        const double size = sqrt(2 * ratio * sqrt(square) * m->square[i]);
        sparse_mul(&m->M, m->V + (size_t)i * n, u);
        for (size_t k = 0; k < n; k++)
            u[k] *= size;
        m->carried[m->damped] = size / square;
        m->of[m->damped++] = i;
    }
    return STATUS_OK;
}

int harmonic_modes_damped(const harmonic_modes *m, const double **U)
{
    if (m == NULL)
        return 0;
    *U = m->U;
    return m->damped;
}

void harmonic_modes_carried(const vibration *v, int driven, double out[])
{
    const harmonic_modes *m = v->modes;
    for (int i = 0; m != NULL && i < m->damped; i++) {
        const double *mode = m->V + (size_t)m->of[i] * (size_t)m->n;
        double sum = 0;
        for (int k = v->K.column[driven]; k < v->K.column[driven + 1]; k++)
            if (v->K.row[k] < m->n)
                sum -= mode[v->K.row[k]] * v->K.value[k];
        out[i] = m->carried[i] * sum;
    }
}

/* wanted 0: all. */
static status find(vibration *v, harmonic_modes *m, int wanted, fault *f)
{
    const size_t n = (size_t)v->free;
    const int all = wanted == 0 || wanted >= v->free;
    const size_t kept = all ? n : (size_t)wanted;
    m->n = v->free;
    m->least = INFINITY;
    m->V = calloc((all && v->free > MOST_DENSE ? 0 : kept * n) + 1, sizeof *m->V);
    m->square = calloc(kept + 1, sizeof *m->square);
    m->work = calloc(2 * n + 1, sizeof *m->work);
    if (m->V == NULL || m->square == NULL || m->work == NULL)
        return no_memory(f);
    TRY(free_blocks(v, m, f));
    TRY(factor_stiffness(v, m, f));
    return all ? all_modes(v, m, f) : first_modes(v, m, wanted, f);
}

/* Projections on modes are symmetric. */
static status check_damping(const vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    for (int i = 0; i < s->springs && s->analysis[v->analysis].by_modes; i++)
        if (scene_spring_gyrates(&s->spring[i]))
            return fault_set(f, STATUS_REFUSED,
                             "a solution by modes needs symmetric damping, and that of %s is "
                             "unsymmetric; remove 'solution'",
                             scene_called(s, SCENE_SPRINGS, i).text);
    return STATUS_OK;
}

status harmonic_modes_find(vibration *v, fault *f)
{
    TRY(check_damping(v, f));
    v->modes = calloc(1, sizeof *v->modes);
    if (v->modes == NULL)
        return no_memory(f);
    TRY(find(v, v->modes, v->c->scene->analysis[v->analysis].modes, f));
    return damp(v, v->modes, f);
}

static status take_frequencies(const harmonic_modes *m, int *count, double **hertz, fault *f)
{
    *hertz = calloc((size_t)m->kept + 1, sizeof **hertz);
    if (*hertz == NULL)
        return no_memory(f);
    for (int i = 0; i < m->kept; i++)
        if (isfinite(m->square[i]) && m->square[i] > m->shift)
            (*hertz)[(*count)++] = sqrt(m->square[i] - m->shift) / (2 * PI);
    return STATUS_OK;
}

/* Frequencies of damped modes. K unsymmetric, or gyroscopic damping: those without damping, if
 * there are any, may be far from all peaks. */
static status find_damped(vibration *v, harmonic_modes *m, double below, unsymmetric_result *r,
                          fault *f)
{
    fault why = {""};
    m->n = v->free;
    TRY(free_blocks(v, m, f));
    TRY(factor_alloc(&m->K, &m->factor, f));
    v->c->run->counters.factorisations++;
    if (factor_numeric(m->factor, &m->K, &why) != STATUS_OK)
        return STATUS_OK;
    for (int wanted = 16, enough = 0; !enough; wanted *= 4) {
        const unsymmetric_problem p = {.K = &m->K,
                                       .M = &m->M,
                                       .C = v->damped ? &m->C : NULL,
                                       .K_factor = m->factor,
                                       .wanted = wanted,
                                       .decaying = v->damped};
        unsymmetric_free(r);
        const status found = unsymmetric_solve(&p, r, &why);
        v->c->run->counters.solutions += r->solutions;
        if (found == STATUS_FAULT)
            return fault_set(f, found, "%s", why.text);
        enough = found != STATUS_OK || r->count < wanted ||
                 hypot(r->growth[r->count - 1], r->frequency[r->count - 1]) > 2 * PI * below;
    }
    return STATUS_OK;
}

static status damped_frequencies(vibration *v, double below, int *count, double **hertz, fault *f)
{
    harmonic_modes *m = calloc(1, sizeof *m);
    unsymmetric_result r = {0};
    status outcome = m != NULL ? find_damped(v, m, below, &r, f) : no_memory(f);
    *hertz = calloc((size_t)r.count + 1, sizeof **hertz);
    for (int i = 0; *hertz != NULL && i < r.count; i++) {
        int at = *count;
        if (r.frequency[i] <= 0)
            continue;
        for (; at > 0 && (*hertz)[at - 1] > r.frequency[i] / (2 * PI); at--)
            (*hertz)[at] = (*hertz)[at - 1];
        (*hertz)[at] = r.frequency[i] / (2 * PI);
        ++*count;
    }
    if (outcome == STATUS_OK && *hertz == NULL)
        outcome = no_memory(f);
    unsymmetric_free(&r);
    harmonic_modes_free(m);
    return outcome;
}

status harmonic_judge_springs(vibration *v, double below, fault *f)
{
    const scene *s = v->c->scene;
    harmonic_modes *m = NULL;
    unsymmetric_result r = {0};
    int circulates = 0;
    double growth = 0;
    for (int i = 0; i < s->springs; i++)
        circulates |= scene_spring_circulates(&s->spring[i]);
    if (!circulates || s->analysis[v->analysis].by_modes)
        return STATUS_OK;
    m = calloc(1, sizeof *m);
    const status outcome = m != NULL ? find_damped(v, m, below, &r, f) : no_memory(f);
    for (int i = 0; i < r.count; i++)
        if (r.growth[i] > 1e-9 * r.frequency[i])
            growth = fmax(growth, r.growth[i]);
    unsymmetric_free(&r);
    harmonic_modes_free(m);
    if (outcome != STATUS_OK || growth == 0)
        return outcome;
    return fault_set(f, STATUS_REFUSED,
                     "nothing vibrates steadily, because a mode grows with %.4g 1/s: see modal: "
                     "{damped: yes}; add damping, or make cross terms of springs smaller",
                     growth);
}

static int is_unsymmetric(const scene *s)
{
    for (int i = 0; i < s->springs; i++)
        if (scene_spring_circulates(&s->spring[i]) || scene_spring_gyrates(&s->spring[i]))
            return 1;
    return 0;
}

status harmonic_natural(vibration *v, double below, int *count, double **hertz, fault *f)
{
    const double square = pow(2 * PI * below, 2);
    status outcome = STATUS_OK;
    *count = 0;
    *hertz = NULL;
    if (is_unsymmetric(v->c->scene))
        return damped_frequencies(v, below, count, hertz, f);
    for (int wanted = 16, enough = 0; outcome == STATUS_OK && !enough; wanted *= 4) {
        fault why = {""};
        harmonic_modes *m = calloc(1, sizeof *m);
        if (m == NULL)
            return no_memory(f);
        outcome = find(v, m, wanted, &why);
        enough = outcome == STATUS_REFUSED || m->complete || m->least - m->shift > square;
        if (outcome == STATUS_OK && enough)
            outcome = take_frequencies(m, count, hertz, f);
        else if (outcome == STATUS_REFUSED)
            outcome = STATUS_OK;
        else if (outcome != STATUS_OK)
            fault_set(f, outcome, "%s", why.text);
        harmonic_modes_free(m);
    }
    return outcome;
}

/* B <= g (M + K/least), and M <= K/least beyond the modes. */
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
    if (outcome == STATUS_OK && e->positive.count > 0) /* plus a margin */
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

/* Adds K^-1 f to V, without its part that V contains already. */
static void take_static(vibration *v, harmonic_modes *m, const double f[])
{
    const size_t n = (size_t)m->n;
    double *x = m->V + (size_t)m->count * n, *Kx = m->work;
    memcpy(x, f, n * sizeof *x);
    factor_solve(m->factor, x);
    v->c->run->counters.solutions++;
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

/* P = V^T A V, symmetric; A V of the modes in `of_modes` where that is not NULL. */
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

/* X^T (K^-1 - V V^T) Y of the modes, X = A V, Y = A' V. */
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

static status couplings(vibration *v, harmonic_modes *m, double *X[2], fault *f)
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
        v->c->run->counters.solutions += m->kept;
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

/* V^T U U^T V of the damping ratios. */
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
            TRY(couplings(v, m, X, f));
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
        take_static(v, m, f + (size_t)i * n);
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
    if (m->complete) { /* no bound is needed */
        free(X[0]);
        free(X[1]);
        X[0] = X[1] = NULL;
    }
    const status outcome = enough ? project_all(v, m, X, f_) : no_memory(f_);
    free(X[0]);
    free(X[1]);
    return outcome;
}

/* D of the projected matrices. */
static double complex projected(const vibration *v, const harmonic_modes *m, double w, size_t k)
{
    const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
    const double complex moves = w * (w - I * damping->mass);
    return m->Kp[k] - w * w * m->Mp[k] + I * w * m->Cp[k] -
           moves * moves / (1 + I * w * damping->stiffness) * m->Bp[k];
}

/* Frobenius norm of the coupling between the modes and the rest; INFINITY: not known. */
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
    /* T^H T in the first half; behind it, its product with the inverse, and the conjugate of that
     * product */
    double complex *G = m->half, *product = m->half + k2;
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++) {
            const size_t at = (size_t)i * (size_t)kept + (size_t)j,
                         across = (size_t)j * (size_t)kept + (size_t)i;
            G[at] = conj(c) * c * m->coupling[0][at] + conj(c) * b * m->coupling[1][at] +
                    conj(b) * c * m->coupling[1][across] + conj(b) * b * m->coupling[2][at];
        }
    /* tr(G D^-1 conj(G) D^-H) = sum of (G D^-1) . conj(D^-1 G^T) */
    double complex sum = 0;
    memset(product, 0, k2 * sizeof *product);
    for (int i = 0; i < kept; i++)
        for (int k = 0; k < kept; k++)
            for (int j = 0; j < kept; j++)
                product[i * kept + j] += G[i * kept + k] * m->inverse[k * kept + j];
    /* conj(G) D^-H = conj((D^-1)^T's G): D is symmetric, so that conj(G) D^-H = conj(G D^-1) */
    for (int i = 0; i < kept; i++)
        for (int j = 0; j < kept; j++)
            sum += product[i * kept + j] * conj(product[j * kept + i]);
    return sqrt(fmax(0, creal(sum)));
}

/* The part of D beyond the modes that is certainly positive. */
static double positive_part(vibration *v, harmonic_modes *m, double w)
{
    const scene_proportional *damping = &v->c->scene->analysis[v->analysis].damping;
    const double complex moves = w * (w - I * damping->mass);
    const double beyond = 1 - (w * w + m->shift) / m->least -
                          cabs(moves * moves / (1 + I * w * damping->stiffness)) * m->inner;
    return beyond > 0 ? beyond - coupled(v, m, w) : beyond;
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
    m->positive = m->complete ? 1 : positive_part(v, m, w);
    if (!(m->positive > 0))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "at %g Hz the first %d modes give no error bound; use more modes, up to "
                         "frequencies well above it, or remove solution: modal",
                         w / (2 * PI), m->kept);
    v->c->run->counters.dense_operations += (double)count * (double)count * (double)count;
    if (size == 0)
        return STATUS_OK;
    double condition = 0;
    const double norm = LAPACKE_zlange(LAPACK_ROW_MAJOR, '1', size, size, m->D, size);
    const int info = LAPACKE_zgetrf(LAPACK_ROW_MAJOR, size, size, m->D, size, m->pivot);
    if (info == 0)
        LAPACKE_zgecon(LAPACK_ROW_MAJOR, '1', size, m->D, size, norm, &condition);
    return condition > 1e-14 ? STATUS_OK : fault_set(f, STATUS_SINGULAR, "a mode has no damping");
}

/* y -= D x */
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
    v->c->run->counters.solutions++;
    if (!m->complete)
        subtract_product(v, x, f);
}

/* r^H K^-1 r */
static double size_of(vibration *v, const double complex r[])
{
    harmonic_modes *m = v->modes;
    double *re = m->work, *im = m->work + m->n, sum = 0;
    for (int k = 0; k < m->n; k++) {
        re[k] = creal(r[k]);
        im[k] = cimag(r[k]);
    }
    factor_solve_many(m->factor, 2, m->n, m->work);
    v->c->run->counters.solutions += 2;
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
