/* State-space form of M q'' + C q' + K q = B u. Coordinates with mass become undamped modes a with
 * unit mass. Their circular frequencies w are computed with a one-sided Jacobi method, which is
 * accurate for low and high frequencies alike (Z. Drmac, K. Veselic, SIAM J. Matrix Anal. Appl. 29
 * (2008) 1322). The states are w a and a'. Coordinates with damping but without mass are of first
 * order. Coordinates with neither are eliminated by their static equations. */
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/numerics/numerics_impl.h"

/* Matrices of the free coordinates in new coordinates q = T x. Coordinates with mass come first
 * [masses], followed by those of first order [slow] and those that are eliminated [rigid]. */
typedef struct split {
    const second_order *of;
    int n, masses, slow, rigid;
    double *T;
    double *w;         /* [n] circular frequencies of the coordinates with mass, which come first */
    double *K, *C, *M; /* [n x n] T^T K T, T^T C T, T^T M T */
    /* [n x motions] forces due to motions through K, C and M; [n x inputs] forces of inputs */
    double *moved[3], *F;
    double shift;  /* shift of the squares of frequencies */
    double *still; /* [rigid x (masses + slow + motions + inputs)] eliminated coordinates as
                      functions of the others */
    double *row, *of_input;
} split;

static status no_memory(fault *f)
{
    return fault_memory(f, "a state space");
}

/* Computes C(m x n) = A(m x k) B(k x n) for large matrices. */
static void product(int m, int k, int n, const double A[], const double B[], double C[])
{
    memset(C, 0, (size_t)m * (size_t)n * sizeof *C);
    for (int i = 0; i < m; i++)
        for (int l = 0; l < k; l++) {
            const double a = A[(size_t)i * (size_t)k + (size_t)l];
            const double *b = B + (size_t)l * (size_t)n;
            double *c = C + (size_t)i * (size_t)n;
            for (int j = 0; j < n && a != 0; j++)
                c[j] += a * b[j];
        }
}

/* Computes out = T^T A T for the leading block of A [size x size]. */
static status congruence(const split *s, const double A[], int size, double out[], fault *f)
{
    const size_t n = (size_t)s->n;
    double *block = calloc(2 * n * n + 1, sizeof *block), *AT = block + n * n;
    if (block == NULL)
        return no_memory(f);
    for (size_t i = 0; i < n; i++)
        memcpy(block + i * n, A + i * (size_t)size, n * sizeof *block);
    product(s->n, s->n, s->n, block, s->T, AT);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            block[i * n + j] = s->T[j * n + i];
    product(s->n, s->n, s->n, block, AT, out);
    free(block);
    return STATUS_OK;
}

/* Computes out[n x columns] = T^T times the columns of A [. x size] from column `from` on. */
static void turned(const split *s, const double A[], int size, int from, int columns, double out[])
{
    const size_t n = (size_t)s->n;
    memset(out, 0, n * (size_t)columns * sizeof *out);
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < (size_t)columns; j++)
                out[i * (size_t)columns + j] +=
                    s->T[k * n + i] * A[k * (size_t)size + (size_t)from + j];
}

static status project(split *s, fault *f)
{
    const second_order *m = s->of;
    const int size = m->n + m->motions;
    const double *const from[] = {m->K, m->C, m->M};
    double *const to[] = {s->K, s->C, s->M};
    for (int i = 0; i < 3; i++) {
        TRY(congruence(s, from[i], size, to[i], f));
        turned(s, from[i], size, m->n, m->motions, s->moved[i]);
    }
    turned(s, m->B, m->inputs, 0, m->inputs, s->F);
    return STATUS_OK;
}

/* Replaces columns `from` to s->n of T by eigenvectors of the symmetric part of A [n x n], of which
 * rows and columns before `from` are omitted and the others are multiplied by `scale`. Eigenvectors
 * whose eigenvalue exceeds rounding come first. Returns their number; -1: the fault contains the
 * reason. */
static int range_of(split *s, const double A[], const double scale[], int from, fault *f)
{
    const size_t n = (size_t)s->n, size = n - (size_t)from;
    double *S = calloc(size * size + size + 1, sizeof *S), *mu = S + size * size,
           *turned_T = calloc(n * size + 1, sizeof *turned_T);
    int count = -1;
    if (S == NULL || turned_T == NULL) {
        no_memory(f);
    } else {
        for (size_t i = 0; i < size; i++)
            for (size_t j = 0; j < size; j++)
                S[i * size + j] = scale[i] * scale[j] * 0.5 *
                                  (A[(i + (size_t)from) * n + j + (size_t)from] +
                                   A[(j + (size_t)from) * n + i + (size_t)from]);
        if (size > 0 && LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', (int)size, S, (int)size, mu) != 0)
            fault_set(f, STATUS_NOT_CONVERGED,
                      "the eigenvalues of a state space did not converge; use another number of "
                      "elements");
        else
            count = 0;
        const double none = 1e-12 * (size > 0 ? mu[size - 1] : 0);
        for (size_t k = 0; k < size && count >= 0; k++) {
            const size_t at = size - 1 - k;
            count += mu[at] > none && mu[at] > 0;
            for (size_t i = 0; i < n; i++) {
                double sum = 0;
                for (size_t j = 0; j < size; j++)
                    sum += s->T[i * n + (size_t)from + j] * scale[j] * S[j * size + at];
                turned_T[i * size + k] = sum;
            }
        }
        for (size_t i = 0; i < n; i++)
            memcpy(s->T + i * n + (size_t)from, turned_T + i * size, size * sizeof *turned_T);
    }
    free(S);
    free(turned_T);
    return count;
}

static status split_masses(split *s, fault *f)
{
    const size_t n = (size_t)s->n;
    double *scale = calloc(n + 1, sizeof *scale), *was = calloc(n * n + 1, sizeof *was);
    status outcome = scale != NULL && was != NULL ? STATUS_OK : no_memory(f);
    for (size_t i = 0; outcome == STATUS_OK && i < n; i++) {
        s->T[i * n + i] = 1;
        scale[i] = s->M[i * n + i] > 0 ? 1 / sqrt(s->M[i * n + i]) : 1;
    }
    if (outcome == STATUS_OK) {
        memcpy(was, s->T, n * n * sizeof *was);
        s->masses = range_of(s, s->M, scale, 0, f);
        if (s->masses == s->n)
            memcpy(s->T, was, n * n * sizeof *was);
        outcome = s->masses < 0 ? STATUS_FAULT : project(s, f);
    }
    free(scale);
    free(was);
    return outcome;
}

static status split_dampers(split *s, fault *f)
{
    const size_t n = (size_t)s->n, from = (size_t)s->masses;
    double *scale = calloc(n + 1, sizeof *scale);
    if (scale == NULL)
        return no_memory(f);
    for (size_t i = from; i < n; i++) {
        const double k = fabs(s->K[i * n + i]);
        scale[i - from] = k > 0 ? 1 / sqrt(k) : 1;
    }
    s->slow = range_of(s, s->C, scale, s->masses, f);
    s->rigid = s->n - s->masses - s->slow;
    free(scale);
    return s->slow < 0 ? STATUS_FAULT : project(s, f);
}

/* Expresses the eliminated coordinates by their static equations, still = K00^-1 [K0., moved by K,
 * F], and removes them from K. */
static status eliminate(split *s, fault *f)
{
    const size_t n = (size_t)s->n, first = (size_t)s->masses + (size_t)s->slow,
                 rigid = (size_t)s->rigid, motions = (size_t)s->of->motions,
                 inputs = (size_t)s->of->inputs, width = first + motions + inputs;
    double *block = calloc(rigid * rigid + 1, sizeof *block);
    int *pivot = calloc(rigid + 1, sizeof *pivot), singular = 0;
    s->still = calloc(rigid * width + 1, sizeof *s->still);
    if (block == NULL || pivot == NULL || s->still == NULL) {
        free(block);
        free(pivot);
        return no_memory(f);
    }
    for (size_t i = 0; i < rigid; i++) {
        memcpy(block + i * rigid, s->K + (first + i) * n + first, rigid * sizeof *block);
        memcpy(s->still + i * width, s->K + (first + i) * n, first * sizeof *block);
        memcpy(s->still + i * width + first, s->moved[0] + (first + i) * motions,
               motions * sizeof *block);
        memcpy(s->still + i * width + first + motions, s->F + (first + i) * inputs,
               inputs * sizeof *block);
    }
    if (rigid > 0) {
        singular = dense_lu_regular(s->rigid, block, pivot) != 0;
        if (!singular)
            dense_lu_solve(s->rigid, (int)width, block, pivot, s->still);
    }
    for (size_t i = 0; i < first && !singular; i++)
        for (size_t j = 0; j < first; j++)
            for (size_t k = 0; k < rigid; k++)
                s->K[i * n + j] -= s->K[i * n + first + k] * s->still[k * width + j];
    free(block);
    free(pivot);
    return singular ? fault_set(f, STATUS_REFUSED,
                                "a coordinate has no mass, no damping and no stiffness; fix it, or "
                                "give it one of these")
                    : STATUS_OK;
}

/* Computes L and G = R from K + shift M = R^T R and M = L L^T for the coordinates with mass:
 * triangles [masses x masses], stored by columns. Returns 0 if K + shift M or M is not positive
 * definite. */
static int relative(const split *s, double L[], double G[])
{
    const size_t n = (size_t)s->n, p = (size_t)s->masses;
    const int size = s->masses;
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < p; j++) {
            L[i * p + j] = s->M[i * n + j];
            G[i * p + j] = 0.5 * (s->K[i * n + j] + s->K[j * n + i]) + s->shift * s->M[i * n + j];
        }
    if (LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', size, L, size) != 0 ||
        LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'U', size, G, size) != 0)
        return 0;
    for (size_t i = 0; i < p; i++) {
        const double whole = s->K[i * n + i] + s->shift * s->M[i * n + i];
        if (s->shift == 0 && !(G[i * p + i] * G[i * p + i] > 1e-13 * (double)p * whole))
            return 0; /* only rounding errors remain */
        for (size_t j = i + 1; j < p; j++)
            G[i * p + j] = 0; /* below the diagonal */
    }
    return 1;
}

/* Computes the circular frequencies w[masses] of K + shift M and M, and V[masses x masses] by
 * columns, where L^-T V are the modes. *positive 0: K + shift M or M is not positive definite, and
 * there is no other result. */
static status decompose(split *s, double L[], double G[], double V[], int *positive, fault *f)
{
    const int size = s->masses;
    const size_t p = (size_t)size;
    double stat[6] = {0};
    *positive = relative(s, L, G);
    if (!*positive)
        return STATUS_OK;
    memset(V, 0, p * p * sizeof *V);
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j <= i; j++)
            V[j * p + i] = G[i * p + j]; /* R^T, lower */
    LAPACKE_dtrtrs(LAPACK_COL_MAJOR, 'L', 'N', 'N', size, size, L, size, V, size);
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < p; j++)
            G[j * p + i] = V[i * p + j];
    if (LAPACKE_dgesvj(LAPACK_COL_MAJOR, 'G', 'N', 'V', size, size, G, size, s->w, 0, V, size,
                       stat) != 0)
        return fault_set(
            f, STATUS_NOT_CONVERGED,
            "the frequencies of a state space did not converge; use another number of elements");
    for (size_t i = 0; i < p; i++)
        s->w[i] *= stat[0];
    return STATUS_OK;
}

static status take_modes(split *s, double L[], double G[], double V[], fault *f)
{
    const size_t n = (size_t)s->n, p = (size_t)s->masses;
    int positive = 0;
    double size = 0;
    for (size_t i = 0; i < p; i++)
        size = fmax(size, s->M[i * n + i] > 0 ? fabs(s->K[i * n + i]) / s->M[i * n + i] : 0);
    s->shift = 0;
    TRY(decompose(s, L, G, V, &positive, f));
    for (double part = 1e-9; !positive && part < 1e3; part *= 1e3) {
        s->shift = part * (size > 0 ? size : 1);
        TRY(decompose(s, L, G, V, &positive, f));
    }
    if (!positive)
        return fault_set(f, STATUS_REFUSED,
                         "the mass matrix is not positive definite; check the inertias");
    if (s->shift > 0) {
        double least = INFINITY;
        for (size_t i = 0; i < p; i++) {
            const double square = s->w[i] * s->w[i] - s->shift;
            if (square > 1e-5 * s->shift)
                least = fmin(least, square);
        }
        const double was = s->shift;
        s->shift = isfinite(least) ? least : s->shift;
        TRY(decompose(s, L, G, V, &positive, f));
        if (!positive) {
            s->shift = was;
            TRY(decompose(s, L, G, V, &positive, f));
        }
    }
    /* T := T L^-T V */
    LAPACKE_dtrtrs(LAPACK_COL_MAJOR, 'L', 'T', 'N', (int)p, (int)p, L, (int)p, V, (int)p);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < p; j++) {
            G[j] = 0;
            for (size_t k = 0; k < p; k++)
                G[j] += s->T[i * n + k] * V[j * p + k];
        }
        memcpy(s->T + i * n, G, p * sizeof *G);
    }
    return STATUS_OK;
}

static status find_modes(split *s, fault *f)
{
    const size_t n = (size_t)s->n, p = (size_t)s->masses;
    double *room = calloc(3 * p * p + n + 1, sizeof *room);
    if (room == NULL)
        return no_memory(f);
    status outcome = p > 0 ? take_modes(s, room, room + p * p, room + 2 * p * p, f) : STATUS_OK;
    free(room);
    if (outcome != STATUS_OK)
        return outcome;
    TRY(project(s, f));
    free(s->still);
    TRY(eliminate(s, f));
    for (size_t i = 0; i < p; i++) {
        double square = s->w[i] * s->w[i] - s->shift;
        if (fabs(square) <= 1e-9 * s->shift)
            square = 0;
        for (size_t j = 0; j < p; j++) {
            const double skew = 0.5 * (s->K[i * n + j] - s->K[j * n + i]);
            if (j > i) {
                s->K[i * n + j] = skew;
                s->K[j * n + i] = -skew;
            }
        }
        s->K[i * n + i] = square;
    }
    return STATUS_OK;
}

/* Adds to the row to[states + inputs] the force F - C q' - K q in the equation of coordinate r,
 * without inertia, multiplied by `times`. */
static void force_on(const split *s, size_t r, double times, const double *slow_rows, double to[])
{
    const second_order *m = s->of;
    const size_t n = (size_t)s->n, p = (size_t)s->masses, slow = (size_t)s->slow, first = p + slow,
                 motions = (size_t)m->motions, inputs = (size_t)m->inputs,
                 states = 2 * p + slow + 2 * motions, width = first + motions + inputs;
    double *const of_input = to + states;
    for (size_t j = 0; j < p; j++) {
        to[j] -= times * s->K[r * n + j] / s->w[j];
        to[first + motions + j] -= times * s->C[r * n + j];
    }
    for (size_t j = 0; j < slow; j++) {
        to[p + j] -= times * s->K[r * n + p + j];
        for (size_t k = 0; k < states + inputs && slow_rows != NULL; k++)
            to[k] -= times * s->C[r * n + p + j] * slow_rows[j * (states + inputs) + k];
    }
    for (size_t j = 0; j < motions; j++) {
        to[first + j] -= times * s->moved[0][r * motions + j];
        to[first + motions + p + j] -= times * s->moved[1][r * motions + j];
    }
    for (size_t j = 0; j < inputs; j++) {
        of_input[j] += times * s->F[r * inputs + j];
        if (m->motion_of[j] >= 0)
            of_input[j] -= times * s->moved[2][r * motions + (size_t)m->motion_of[j]];
    }
    for (size_t i = 0; i < (size_t)s->rigid; i++) {
        const double k = times * s->K[r * n + first + i];
        for (size_t j = 0; j < motions; j++)
            to[first + j] += k * s->still[i * width + first + j];
        for (size_t j = 0; j < inputs; j++)
            of_input[j] -= k * s->still[i * width + first + motions + j];
    }
}

/* Fills the rows [states x (states + inputs)] of x' = A x + B u. */
static void fill_rows(const split *s, double rows[])
{
    const second_order *m = s->of;
    const size_t p = (size_t)s->masses, slow = (size_t)s->slow, first = p + slow, n = (size_t)s->n,
                 motions = (size_t)m->motions, states = 2 * p + slow + 2 * motions,
                 width = states + (size_t)m->inputs;
    for (size_t i = 0; i < slow; i++)
        force_on(s, p + i, 1 / s->C[(p + i) * n + p + i], NULL, rows + (p + i) * width);
    for (size_t i = 0; i < p; i++) {
        rows[i * width + first + motions + i] = s->w[i];
        force_on(s, i, 1, rows + p * width, rows + (first + motions + i) * width);
    }
    for (size_t i = 0; i < motions; i++)
        rows[(first + i) * width + first + motions + p + i] = 1;
    for (size_t j = 0; j < (size_t)m->inputs; j++)
        if (m->motion_of[j] >= 0)
            rows[(first + motions + p + (size_t)m->motion_of[j]) * width + states + j] = 1;
}

/* Fills the rows [(n + motions) x (states + inputs)] of q = Q x + R u. */
static void fill_positions(const split *s, double out[])
{
    const second_order *m = s->of;
    const size_t n = (size_t)s->n, p = (size_t)s->masses, first = p + (size_t)s->slow,
                 motions = (size_t)m->motions, inputs = (size_t)m->inputs,
                 states = 2 * p + (size_t)s->slow + 2 * motions, width = states + inputs,
                 wide = first + motions + inputs;
    for (size_t i = 0; i < n; i++) {
        double *to = out + i * width;
        for (size_t j = 0; j < first; j++)
            to[j] += s->T[i * n + j] / (j < p ? s->w[j] : 1);
        for (size_t k = 0; k < (size_t)s->rigid; k++) {
            const double T = s->T[i * n + first + k], *still = s->still + k * wide;
            for (size_t j = 0; j < first + motions; j++)
                to[j] -= T * still[j] / (j < p ? s->w[j] : 1);
            for (size_t j = 0; j < inputs; j++)
                to[states + j] += T * still[first + motions + j];
        }
    }
    for (size_t i = 0; i < motions; i++)
        out[(n + i) * width + first + i] = 1;
}

/* Returns 1 if the instantaneous effect of an input on c x + d u is not negligible compared with
 * its effect through the modes. */
static int passes_through(const split *s, const double rows[], const double c[], int states)
{
    const size_t p = (size_t)s->masses, rates = p + (size_t)s->slow + (size_t)s->of->motions,
                 inputs = (size_t)s->of->inputs, width = (size_t)states + inputs;
    for (size_t j = 0; j < inputs; j++) {
        double size = 0;
        for (size_t i = 0; i < p; i++)
            size += (fabs(c[i]) + fabs(c[rates + i])) *
                    fabs(rows[(rates + i) * width + (size_t)states + j]) / s->w[i];
        if (fabs(c[(size_t)states + j]) > 1e-9 * size)
            return 1;
    }
    return 0;
}

/* Fills the outputs [outputs x (states + inputs)]: L0 q + L1 q' + L2 q'' + D u, with q = Q x + R u
 * (`position`), and q' = Q A x + Q B u, which requires that R is zero. */
static status fill_outputs(const split *s, const double rows[], const double position[],
                           double *work, state_space *out, fault *f)
{
    const second_order *m = s->of;
    const size_t N = (size_t)m->n + (size_t)m->motions, states = (size_t)out->states,
                 inputs = (size_t)m->inputs, width = states + inputs;
    double *const c = work, *const d = work + width;
    for (size_t y = 0; y < (size_t)m->outputs; y++) {
        memcpy(out->D + y * inputs, m->D + y * inputs, inputs * sizeof *out->D);
        for (int rate = 0; rate < 3; rate++) {
            const double *L = m->L[rate] + y * N;
            memset(c, 0, width * sizeof *c);
            for (size_t k = 0; k < N; k++)
                for (size_t j = 0; j < width && L[k] != 0; j++)
                    c[j] += L[k] * position[k * width + j];
            for (int times = 0; times < rate; times++) {
                if (passes_through(s, rows, c, out->states)) {
                    out->improper = (int)y;
                    return fault_set(f, STATUS_REFUSED,
                                     "no mass separates the quantity from an input, so its rate "
                                     "has no state space");
                }
                memset(d, 0, width * sizeof *d);
                for (size_t k = 0; k < states; k++)
                    for (size_t j = 0; j < width && c[k] != 0; j++)
                        d[j] += c[k] * rows[k * width + j];
                memcpy(c, d, width * sizeof *c);
            }
            for (size_t j = 0; j < states; j++)
                out->C[y * states + j] += c[j];
            for (size_t j = 0; j < inputs; j++)
                out->D[y * inputs + j] += c[states + j];
        }
    }
    return STATUS_OK;
}

static status fill(const split *s, state_space *out, fault *f)
{
    const second_order *m = s->of;
    const size_t N = (size_t)m->n + (size_t)m->motions, inputs = (size_t)m->inputs,
                 outputs = (size_t)m->outputs;
    out->states = 2 * s->masses + s->slow + 2 * m->motions;
    out->eliminated = s->rigid;
    const size_t states = (size_t)out->states, width = states + inputs;
    double *room = calloc((states + N + 2) * width + 1, sizeof *room), *rows = room,
           *position = rows + states * width, *work = position + N * width;
    out->A = calloc(states * states + 1, sizeof *out->A);
    out->B = calloc(states * inputs + 1, sizeof *out->B);
    out->C = calloc(outputs * states + 1, sizeof *out->C);
    out->D = calloc(outputs * inputs + 1, sizeof *out->D);
    status outcome = STATUS_OK;
    if (room == NULL || out->A == NULL || out->B == NULL || out->C == NULL || out->D == NULL)
        outcome = no_memory(f);
    if (outcome == STATUS_OK) {
        fill_rows(s, rows);
        fill_positions(s, position);
        for (size_t i = 0; i < states; i++) {
            memcpy(out->A + i * states, rows + i * width, states * sizeof *rows);
            memcpy(out->B + i * inputs, rows + i * width + states, inputs * sizeof *rows);
        }
        outcome = fill_outputs(s, rows, position, work, out, f);
    }
    free(room);
    return outcome;
}

static status find(split *s, state_space *out, fault *f)
{
    const second_order *m = s->of;
    const size_t n = (size_t)s->n, motions = (size_t)m->motions;
    s->T = calloc(n * n + 1, sizeof *s->T);
    s->K = calloc(n * n + 1, sizeof *s->K);
    s->C = calloc(n * n + 1, sizeof *s->C);
    s->M = calloc(n * n + 1, sizeof *s->M);
    s->w = calloc(n + 1, sizeof *s->w);
    s->F = calloc(n * (size_t)m->inputs + 1, sizeof *s->F);
    int enough = s->T != NULL && s->K != NULL && s->C != NULL && s->M != NULL && s->w != NULL &&
                 s->F != NULL;
    for (int i = 0; i < 3; i++)
        enough &= (s->moved[i] = calloc(n * motions + 1, sizeof *s->moved[i])) != NULL;
    if (!enough)
        return no_memory(f);
    for (size_t i = 0; i < n; i++)
        s->T[i * n + i] = 1;
    TRY(project(s, f));
    TRY(split_masses(s, f));
    TRY(split_dampers(s, f));
    TRY(eliminate(s, f));
    TRY(find_modes(s, f));
    return fill(s, out, f);
}

status state_space_of(const second_order *m, state_space *out, fault *f)
{
    split s = {.of = m, .n = m->n};
    *out = (state_space){.improper = -1};
    const status outcome = find(&s, out, f);
    double *const block[] = {s.T, s.w,        s.K,        s.C,        s.M,
                             s.F, s.moved[0], s.moved[1], s.moved[2], s.still};
    for (size_t i = 0; i < sizeof block / sizeof block[0]; i++)
        free(block[i]);
    return outcome;
}

void state_space_free(state_space *s)
{
    free(s->A);
    free(s->B);
    free(s->C);
    free(s->D);
}

status second_order_alloc(int n, int motions, int inputs, int outputs, second_order *m, fault *f)
{
    const size_t N = (size_t)n + (size_t)motions, y = (size_t)outputs, u = (size_t)inputs;
    *m = (second_order){.n = n, .motions = motions, .inputs = inputs, .outputs = outputs};
    double **const block[] = {&m->K, &m->C, &m->M, &m->B, &m->L[0], &m->L[1], &m->L[2], &m->D};
    const size_t size[] = {N * N, N * N, N * N, N * u, y * N, y * N, y * N, y * u};
    m->motion_of = calloc(u + 1, sizeof *m->motion_of);
    int enough = m->motion_of != NULL;
    for (int i = 0; i < 8; i++)
        enough &= (*block[i] = calloc(size[i] + 1, sizeof **block[i])) != NULL;
    if (enough)
        return STATUS_OK;
    second_order_free(m);
    return no_memory(f);
}

void second_order_free(second_order *m)
{
    double *const block[] = {m->K, m->C, m->M, m->B, m->L[0], m->L[1], m->L[2], m->D};
    for (int i = 0; i < 8; i++)
        free(block[i]);
    free(m->motion_of);
    *m = (second_order){0};
}
