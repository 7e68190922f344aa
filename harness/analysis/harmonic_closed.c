/* Solution by modes with closed loops of feedback. With the forces P u of the loops and the
 * measured forms S, x = V y and u satisfy
 *     V^T D V y - V^T P u = V^T f,   gain S^T V y + own u = b.
 * If all modes are used, this is the direct solution.
 *
 * The error due to omitted modes is bounded from the residuals of solutions without the loops, as
 * in harmonic_reduced.c: the error of each o^T D^-1 f is at most |o| |f|/positive, where |f| is the
 * norm of the residual of f. With Z = D^-1 P and G = |(own + gain S^T Z)^-1|, the error of u is at
 * most q (|f| + |P| |u|)/(1 - |P| q),   q = G |gain| |S|/positive, and that of o^T x at most
 * |o|/positive (|f| + |P| |u|) + (|o^T Z + o_u| + |o| |P|/positive) times the error of u. */
#include "harness/analysis/analysis_impl.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

static status no_memory(fault *f)
{
    return fault_memory(f, "the modes of a harmonic analysis");
}

status harmonic_closed_alloc(vibration *v, fault *f)
{
    harmonic_modes *m = v->modes;
    const size_t n = (size_t)m->n, count = (size_t)m->count, loops = (size_t)v->loops,
                 all = count + loops;
    if (loops == 0)
        return STATUS_OK;
    m->closed = calloc(all * all + 1, sizeof *m->closed);
    m->closing = calloc(all + 2 * n + loops * loops + 1, sizeof *m->closing);
    m->closed_pivot = calloc(all + 1, sizeof *m->closed_pivot);
    m->loop_parts = calloc(2 * loops * count + 4 * loops + 1, sizeof *m->loop_parts);
    if (m->closed == NULL || m->closing == NULL || m->closed_pivot == NULL || m->loop_parts == NULL)
        return no_memory(f);
    m->balance = m->loop_parts + 2 * loops * count;
    m->feedback_size = m->balance + 2 * loops;
    m->lag = m->feedback_size + loops;
    for (size_t l = 0; l < loops; l++)
        for (size_t i = 0; i < count; i++) {
            m->loop_parts[2 * l * count + i] = dense_dot(m->n, m->V + i * n, v->loop[l].push);
            m->loop_parts[(2 * l + 1) * count + i] =
                dense_dot(m->n, m->V + i * n, v->loop[l].measured);
        }
    return STATUS_OK;
}

/* Returns the norm of V^T P (part 0) or V^T S (part 1), scaled with D. */
static double scaled_size(const harmonic_modes *m, int loop, int part)
{
    const double *of = m->loop_parts + (size_t)(2 * loop + part) * (size_t)m->count;
    double sum = 0;
    for (int i = 0; i < m->count; i++)
        sum += pow(m->scale[i] * of[i], 2);
    return sqrt(sum);
}

static void put_loop(const vibration *v, int l)
{
    harmonic_modes *m = v->modes;
    const size_t count = (size_t)m->count, all = count + (size_t)v->loops, at = count + (size_t)l;
    const double *push = m->loop_parts + (size_t)(2 * l) * count, *measured = push + count;
    double complex own;
    const double complex gain = loops_gain(&v->loop[l], m->w, &own);
    const double pushed = scaled_size(m, l, 0), column = pushed > 0 ? 1 / pushed : 1,
                 size = cabs(gain) * scaled_size(m, l, 1) + cabs(own) * column,
                 row = size > 0 ? 1 / size : 1;
    for (size_t i = 0; i < count; i++) {
        m->closed[i * all + at] = -column * m->scale[i] * push[i];
        m->closed[at * all + i] = row * gain * measured[i] * m->scale[i];
    }
    m->closed[at * all + at] = row * own * column;
    m->balance[2 * l] = row;
    m->balance[2 * l + 1] = column;
}

/* Solves for the real forces f[free] of a loop, without loops. x[free]: the solution. Returns the
 * norm of the residual. */
static double left_of(vibration *v, const double f[], double complex x[])
{
    harmonic_modes *m = v->modes;
    double complex *left = m->closing + m->count + v->loops + m->n;
    for (int k = 0; k < m->n; k++)
        left[k] = f[k];
    harmonic_modes_solve(v, left, x);
    return harmonic_modes_left(v, left);
}

/* Computes |P| and q. NOT_CONVERGED: 1 - |P| q is not positive, so there is no bound. */
static status bound_loops(vibration *v, fault *f)
{
    harmonic_modes *m = v->modes;
    const int loops = v->loops;
    double complex *x = m->closing + m->count + loops, *A = x + 2 * (ptrdiff_t)m->n;
    double part = 0;
    for (int k = 0; k < loops; k++) {
        m->feedback_size[k] = left_of(v, v->loop[k].push, x);
        for (int l = 0; l < loops; l++) {
            double complex own, sum = 0;
            const double complex gain = loops_gain(&v->loop[l], m->w, &own);
            for (int i = 0; i < m->n; i++)
                sum += v->loop[l].measured[i] * x[i];
            A[l * loops + k] = gain * sum + (l == k ? own : 0);
        }
    }
    if (LAPACKE_zgetrf(LAPACK_ROW_MAJOR, loops, loops, A, loops, m->closed_pivot) != 0 ||
        LAPACKE_zgetri(LAPACK_ROW_MAJOR, loops, A, loops, m->closed_pivot) != 0)
        return fault_set(f, STATUS_SINGULAR, "the closed loops have a natural frequency");
    memset(m->lag, 0, (size_t)loops * sizeof *m->lag);
    for (int k = 0; k < loops; k++) {
        double complex own;
        const double sensed = cabs(loops_gain(&v->loop[k], m->w, &own)) *
                              left_of(v, v->loop[k].measured, x) / m->positive;
        for (int l = 0; l < loops; l++)
            m->lag[l] += cabs(A[l * loops + k]) * sensed;
    }
    for (int l = 0; l < loops; l++)
        part += m->feedback_size[l] * m->lag[l];
    m->damps = 1 - part;
    return m->damps > 0 ? STATUS_OK : harmonic_modes_few(v, f);
}

static status factor_closed(vibration *v, fault *f)
{
    harmonic_modes *m = v->modes;
    const size_t count = (size_t)m->count, all = count + (size_t)v->loops;
    const int size = (int)all;
    double condition = 0;
    memset(m->closed + count * all, 0, (size_t)v->loops * all * sizeof *m->closed);
    for (int l = 0; l < v->loops; l++)
        put_loop(v, l);
    numerics_work_add_dense((double)all);
    const double norm = LAPACKE_zlange(LAPACK_ROW_MAJOR, '1', size, size, m->closed, size);
    const int info = LAPACKE_zgetrf(LAPACK_ROW_MAJOR, size, size, m->closed, size, m->closed_pivot);
    if (info == 0)
        LAPACKE_zgecon(LAPACK_ROW_MAJOR, '1', size, m->closed, size, norm, &condition);
    return condition > 1e-14 ? STATUS_OK : fault_set(f, STATUS_SINGULAR, "a mode has no damping");
}

status harmonic_closed_factor(vibration *v, fault *f)
{
    if (v->loops == 0)
        return STATUS_OK;
    if (!v->modes->complete)
        TRY(bound_loops(v, f));
    return factor_closed(v, f);
}

void harmonic_closed_solve(vibration *v, const double complex f[], double complex x[])
{
    harmonic_modes *m = v->modes;
    const size_t n = (size_t)m->n;
    const int all = m->count + v->loops;
    double complex *y = m->closing, *u = x + v->all;
    for (int i = 0; i < m->count; i++) {
        y[i] = 0;
        for (size_t k = 0; k < n; k++)
            y[i] += m->V[(size_t)i * n + k] * f[k];
        y[i] *= m->scale[i];
    }
    for (int l = 0; l < v->loops; l++)
        y[m->count + l] = m->balance[2 * l] * u[l];
    LAPACKE_zgetrs(LAPACK_ROW_MAJOR, 'N', all, 1, m->closed, all, m->closed_pivot, y, 1);
    memset(x, 0, n * sizeof *x);
    for (int i = 0; i < m->count; i++)
        for (size_t k = 0; k < n; k++)
            x[k] += m->scale[i] * y[i] * m->V[(size_t)i * n + k];
    for (int l = 0; l < v->loops; l++)
        u[l] = m->balance[2 * l + 1] * y[m->count + l];
    numerics_work_add(
        &(numerics_work){.solutions = 1, .solved_entries = (double)all * (double)(m->n + all)});
}

double harmonic_closed_bound(vibration *v, const double complex left_of_f[],
                             const double complex u[], const double complex output[],
                             const double complex dual[])
{
    const harmonic_modes *m = v->modes;
    if (m->complete)
        return 0;
    const double out = harmonic_modes_left(v, output) / m->positive;
    double size = harmonic_modes_left(v, left_of_f), bound = 0;
    for (int l = 0; l < v->loops; l++)
        size += m->feedback_size[l] * cabs(u[l]);
    for (int l = 0; l < v->loops; l++) {
        double complex by_u = output[v->all + l];
        for (int k = 0; k < m->n; k++)
            by_u += v->loop[l].push[k] * dual[k];
        bound += (cabs(by_u) + out * m->feedback_size[l]) * m->lag[l] * size / m->damps;
    }
    return bound + out * size;
}
