#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/time/time.h"

enum { MOST_DENSE = 3000 };

static status no_memory(fault *f)
{
    return fault_memory(f, "the modes of a harmonic analysis");
}

void harmonic_modes_free(harmonic_modes *m)
{
    if (m == NULL)
        return;
    sparse *const matrix[] = {&m->K, &m->M, &m->C, &m->B};
    void *const block[] = {
        m->square, m->V,     m->U,           m->carried,     m->Kp,           m->Mp,
        m->Cp,     m->Bp,    m->coupling[0], m->coupling[1], m->coupling[2],  m->D,
        m->entry,  m->scale, m->pivot,       m->y,           m->inverse,      m->half,
        m->work,   m->of,    m->closed,      m->closing,     m->closed_pivot, m->loop_parts,
        m};
    factor_free(m->factor);
    for (size_t i = 0; i < sizeof matrix / sizeof matrix[0]; i++)
        sparse_free_values(matrix[i]);
    for (size_t i = 0; i < sizeof block / sizeof block[0]; i++)
        free(block[i]);
}

/* Factors K, or K + shift M if K is singular. */
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
                     : v->loops > 0
                         ? "the state is unstable without its feedback loops, so it has no "
                           "undamped modes; remove 'solution' and 'ratios'"
                         : "the state is unstable, so there are no steady vibrations about it");
}

status harmonic_modes_blocks(vibration *v, harmonic_modes *m, fault *f)
{
    const sparse *pattern;
    TRY(v->about != NULL || v->rotates
            ? assemble_pattern_whole(v->c->model, v->c->run->patterns, 0, &pattern, f)
        : v->c->scene->analysis[v->analysis].follows != SCENE_NONE
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

static status all_modes(harmonic_modes *m, fault *f)
{
    const size_t n = (size_t)m->n;
    if (m->n > MOST_DENSE)
        return fault_set(f, STATUS_REFUSED,
                         "%d coordinates are too many for computing all modes (at most %d); give a "
                         "number of modes, such as modes: 50",
                         m->n, MOST_DENSE);
    double *K = calloc(n * n + 1, sizeof *K), *x = calloc(n * n + 1, sizeof *x),
           *mu = calloc(n + 1, sizeof *mu);
    int info = -1;
    if (K != NULL && x != NULL && mu != NULL) {
        whole(&m->K, K);
        whole(&m->M, x);
        info =
            n == 0 ? 0 : LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', m->n, x, m->n, K, m->n, mu);
        numerics_work_add_dense(n);
    }
    const double none = 16 * (double)n * sqrt((double)n) * DBL_EPSILON;
    for (size_t i = 0; info == 0 && i < n; i++) {
        const size_t from = n - 1 - i;
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
                                    "the modes of %d coordinates were not found (LAPACK returned "
                                    "%d); give a number of modes, such as modes: 50",
                                    m->n, info);
}

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
        /* if no next mode was found, further modes may be lost in the rounding errors of the first
         * mode */
        m->least = found > wanted ? 1 / e.positive.mu[wanted]
                   : found > 0    ? fmax(m->square[m->kept - 1], 1e8 * m->square[0])
                                  : INFINITY;
    }
    eigen_free(&e);
    return outcome;
}

/* Computes U for the damping ratios: C = M X diag(2 ratio w) X^T M with X^T M X = 1. */
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

status harmonic_modes_lowest(vibration *v, harmonic_modes *m, int wanted, fault *f)
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
    TRY(harmonic_modes_blocks(v, m, f));
    TRY(factor_stiffness(v, m, f));
    return all ? all_modes(m, f) : first_modes(v, m, wanted, f);
}

/* Checks the damping. REFUSED: the damping matrix of a spring is not symmetric, although a solution
 * by modes requires symmetry. */
static status check_damping(const vibration *v, fault *f)
{
    const scene *s = v->c->scene;
    for (int i = 0; i < s->springs && s->analysis[v->analysis].by_modes; i++)
        if (scene_spring_gyrates(&s->spring[i]))
            return fault_set(f, STATUS_REFUSED,
                             "a solution by modes requires symmetric damping, but that of %s is "
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
    TRY(harmonic_modes_lowest(v, v->modes, v->c->scene->analysis[v->analysis].modes, f));
    return damp(v, v->modes, f);
}
