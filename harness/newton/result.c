#include "harness/newton/newton.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

const char *result_event_name(event_kind kind)
{
    static const char *const name[EVENT_KINDS] = {"limit point", "bifurcation", "branch jump"};
    return name[kind];
}

int result_event_multiplicity(const path_event *e)
{
    const int changed = abs(e->negative_after - e->negative_before);
    return e->kind == EVENT_BIFURCATION && changed > 1 ? changed : 1;
}

const char *result_stability_name(step_stability which)
{
    static const char *const name[STEP_STABILITIES] = {"undecided",       "no divergence",
                                                       "stable",          "unstable",
                                                       "unstable: grows", "stable without damping"};
    return name[which];
}

int result_is_unstable(step_stability which)
{
    return which == STEP_UNSTABLE || which == STEP_GROWS;
}

void result_free(solve_result *r)
{
    if (r->quantity != NULL)
        for (int i = 0; i < r->quantities; i++) {
            free(r->quantity[i].curve.x);
            free(r->quantity[i].curve.value);
        }
    for (int i = 0; i < r->matrix_sets; i++) {
        free(r->matrices[i].path);
        free(r->matrices[i].compliance);
        free(r->matrices[i].stiffness);
    }
    for (int i = 0; i < r->ends; i++)
        outcome_end_free(&r->end[i]);
    free(r->end);
    free(r->matrices);
    free(r->quantity);
    free(r->step);
    shapes_free(&r->shapes);
    system_matrices_free(&r->systems);
    free(r->iteration);
    free(r->event);
    free(r->motion);
    memset(r, 0, sizeof *r);
}

void quantity_no_value(quantity_result *r, status s, const char *reason)
{
    r->status = s != STATUS_OK ? s : STATUS_NO_VALUE;
    r->value = NAN;
    snprintf(r->reason, sizeof r->reason, "%s", reason);
}

int quantity_governs(scene_envelope how, double value, double best)
{
    const double ties = 1e-9;
    return how == SCENE_ENVELOPE_MIN       ? value < best
           : how == SCENE_ENVELOPE_LARGEST ? fabs(value) > (1 + ties) * fabs(best)
                                           : value > best;
}

double quantity_scaled(const scene_quantity *q, double value)
{
    return q->factor * value + q->offset;
}

double quantity_abscissa(const scene_quantity *q, double x)
{
    return x * q->x.factor + q->x.offset;
}

int quantity_curve(quantity_result *r, int points)
{
    r->curve.x = calloc((size_t)points + 1, sizeof(double));
    r->curve.value = calloc((size_t)points + 1, sizeof(double));
    if (r->curve.x == NULL || r->curve.value == NULL) {
        quantity_no_value(r, STATUS_FAULT, "out of memory");
        return 0;
    }
    r->curve.points = points;
    return 1;
}

status shapes_alloc(shapes *s, fault *f)
{
    const size_t states = (size_t)s->states + 1;
    s->first = calloc((size_t)s->members + 2, sizeof *s->first);
    s->state = calloc(states, sizeof *s->state);
    s->point = calloc(states * (size_t)s->points + 1, sizeof *s->point);
    s->node = calloc(states * 3 * (size_t)s->nodes + 1, sizeof *s->node);
    return s->first != NULL && s->state != NULL && s->point != NULL && s->node != NULL
               ? STATUS_OK
               : fault_memory(f, "the shapes of %d states", s->states);
}

void shapes_free(shapes *s)
{
    free(s->first);
    free(s->state);
    free(s->point);
    free(s->node);
    memset(s, 0, sizeof *s);
}

const char *shapes_kind_name(shape_kind kind)
{
    static const char *const name[] = {"undeformed", "path", "linear",
                                       "buckling",   "mode", "motion"};
    return name[kind];
}

int shapes_frames(int most)
{
    if (most <= 0)
        return 0;
    return most <= SHAPES_FEW || most >= SHAPES_ALL ? SHAPES_FRAMES : most;
}

enum { N = 6 };

/* Computes B = A^-1, both [n x n], and overwrites A. Returns a nonzero value if A is singular to
 * working precision. */
static int invert(int n, double A[], double B[])
{
    int pivot[N];
    memset(B, 0, (size_t)(n * n) * sizeof *B);
    for (int i = 0; i < n; i++)
        B[i * n + i] = 1;
    const int failed = dense_lu_regular(n, A, pivot);
    if (failed == 0)
        dense_lu_solve(n, n, A, pivot, B);
    return failed;
}

/* Subtracts `times` m~/2 of the moment `of` from the rotational block of K. */
static void subtract_half_skew(const movable *v, double times, const double of[3], double K[])
{
    const double m[3] = {times * of[0], times * of[1], times * of[2]},
                 skew[9] = {0, -m[2], m[1], m[2], 0, -m[0], -m[1], m[0], 0};
    const int n = v->count;
    if (v->whole) {
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                if (v->component[i] >= 3 && v->component[j] >= 3)
                    K[i * n + j] -= skew[3 * (v->component[i] - 3) + v->component[j] - 3] / 2;
        return;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    K[i * n + j] -=
                        v->span[(3 + r) * n + i] * skew[3 * r + c] * v->span[(3 + c) * n + j] / 2;
}

static void symmetrise(int n, double K[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            K[i * n + j] = K[j * n + i] = (K[i * n + j] + K[j * n + i]) / 2;
}

int convention_changes(scene_moments of_tangent, scene_moments convention, const double m[3])
{
    return convention == SCENE_MOMENTS_SYMMETRISED ||
           (convention != of_tangent && vec3_norm(m) > 0);
}

/* Returns the multiple of m~/2 to subtract from a stiffness in the convention of the tangent; -1:
 * m~/2 is added. */
static int times_of(scene_moments of_tangent, scene_moments convention)
{
    return (convention != SCENE_MOMENTS_SEMITANGENTIAL) - (of_tangent == SCENE_MOMENTS_SPATIAL);
}

/* Computes to[m x m] = T A T^T with T[m x n]; m and n are at most N. */
static void congruence(int m, int n, const double T[], const double A[], double to[])
{
    double half[N * N];
    dense_mul(m, n, n, T, A, half);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++)
            to[i * m + j] = dense_dot(n, half + i * n, T + j * n);
}

static void gather(const movable *v, const double C[36], double to[])
{
    const int n = v->count;
    if (!v->whole)
        congruence(n, N, v->dual, C, to);
    for (int i = 0; v->whole && i < n; i++)
        for (int j = 0; j < n; j++)
            to[i * n + j] = C[N * v->component[i] + v->component[j]];
}

static void scatter(const movable *v, const double from[], double to[36])
{
    const int n = v->count;
    memset(to, 0, N * N * sizeof *to);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            to[N * v->component[i] + v->component[j]] += from[i * n + j];
}

static void scatter_compliance(const movable *v, const double from[], double C[36])
{
    if (v->whole)
        scatter(v, from, C);
    else
        congruence(N, v->count, v->span, from, C);
}

static void scatter_stiffness(const movable *v, const double from[], double K[36])
{
    const int n = v->count;
    double half[N * N];
    if (v->whole) {
        scatter(v, from, K);
        return;
    }
    memset(K, 0, N * N * sizeof *K);
    dense_mul(n, n, N, from, v->dual, half);
    dense_add_transpose_mul(N, n, N, v->dual, half, K);
}

status convention_apply(scene_moments of_tangent, scene_moments convention, const movable *motions,
                        const double m[3], double C[36], double K[36], fault *f)
{
    double A[N * N], B[N * N], inverse[N * N];
    gather(motions, C, A);
    if (invert(motions->count, A, B) != 0)
        return fault_set(f, STATUS_SINGULAR, "the compliance matrix is singular");
    if (convention_changes(of_tangent, convention, m)) {
        subtract_half_skew(motions, times_of(of_tangent, convention), m, B);
        if (convention == SCENE_MOMENTS_SYMMETRISED)
            symmetrise(motions->count, B);
        memcpy(A, B, sizeof A);
        if (invert(motions->count, A, inverse) != 0)
            return fault_set(
                f, STATUS_SINGULAR,
                "the stiffness with %s moments is singular; give another convention ('moments')",
                scene_moments_name(convention));
        scatter_compliance(motions, inverse, C);
    }
    scatter_stiffness(motions, B, K);
    return STATUS_OK;
}
