#include "harness/time/massless.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/body_mass.h"
#include "harness/time/forms.h"

/* Of M as it is measured there, in parts of the largest mass. */
static const double massless_nothing = 1e-14;

/* What is done with the masses of a body. */
typedef enum massless_task { COUNT, STIFFEST, KEEP_FORCES, KEEP_MOTION, ACCELERATE } massless_task;

typedef struct wish {
    massless_task task;
    const double *given; /* [free] diagonal of a stiffness; forces */
    double *changed;     /* [free] forces; increments; accelerations */
    double stiffest;
} wish;

/* x[free] onto the null space of M, whose vectors are columns of g->M. */
static void project(const body_mass *g, double none, int forces, double x[])
{
    const int n = g->count;
    for (int i = 0; i < n; i++) {
        const double unit = forces ? g->unit[i] : 1 / g->unit[i];
        g->rest[i] = x[g->index[i]] * unit;
        x[g->index[i]] = 0;
    }
    for (int k = 0; k < n && g->value[k] <= none; k++) {
        double part = 0;
        for (int i = 0; i < n; i++)
            part += g->M[n * i + k] * g->rest[i];
        for (int i = 0; i < n; i++)
            x[g->index[i]] += part * g->M[n * i + k] * (forces ? 1 / g->unit[i] : g->unit[i]);
    }
}

static void accelerate(const body_mass *g, double none, const double force[], double a[])
{
    const int n = g->count;
    for (int i = 0; i < n; i++)
        a[g->index[i]] = 0;
    for (int k = 0; k < n; k++) {
        double part = 0;
        if (g->value[k] <= none)
            continue;
        for (int i = 0; i < n; i++)
            part += g->M[n * i + k] * g->unit[i] * force[g->index[i]];
        for (int i = 0; i < n; i++)
            a[g->index[i]] += part / g->value[k] * g->M[n * i + k] * g->unit[i];
    }
}

static double stiffest(const body_mass *g, double none, const double diagonal[], double most)
{
    const int n = g->count;
    for (int k = 0; k < n; k++) {
        double stiffness = 0;
        for (int i = 0; i < n; i++)
            stiffness += pow(g->M[n * i + k] * g->unit[i], 2) * diagonal[g->index[i]];
        if (g->value[k] > none)
            most = fmax(most, stiffness / g->value[k]);
    }
    return most;
}

/* Rank of a body's M. */
static int visit(const model *m, const carried_masses *all, int body, const model_state *s,
                 body_mass *g, wish *of)
{
    const double none = massless_nothing * body_mass_of(m, all, body, s, g);
    const int n = g->count, rank = body_mass_rank(g, none);
    if (of->task == COUNT)
        return rank;
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'V', 'U', n, g->M, n, g->value); /* fails only for NAN */
    if (of->task == STIFFEST)
        of->stiffest = stiffest(g, none, of->given, of->stiffest);
    else if (of->task == ACCELERATE)
        accelerate(g, none, of->given, of->changed);
    else
        project(g, none, of->task == KEEP_FORCES, of->changed);
    return rank;
}

static int warping(const model *m, const carried_masses *all, const model_state *s, wish *of)
{
    int heavy = 0;
    for (int i = 0; i < model_warps(m); i++) {
        const int c = model_warp(m, i);
        const double mass = body_mass_warps(m, all, i, s);
        if (c >= model_unknowns(m))
            continue;
        heavy += mass > 0;
        if (of->task == STIFFEST && mass > 0)
            of->stiffest = fmax(of->stiffest, of->given[c] / mass);
        if (of->task == ACCELERATE)
            of->changed[c] = mass > 0 ? of->given[c] / mass : 0;
        if ((of->task == KEEP_FORCES || of->task == KEEP_MOTION) && mass > 0)
            of->changed[c] = 0;
    }
    return heavy;
}

/* Free coordinates less the rank of their masses: *out. */
static status walk(const model *m, const carried_masses *all, const model_state *s, wish *of,
                   int *out, fault *f)
{
    int heavy = 0;
    body_mass g;
    TRY(body_mass_alloc(m, &g, f));
    for (int i = 0; i < model_first_release(m); i++)
        if (model_vertex(m, i)->body == i)
            heavy += visit(m, all, i, s, &g, of);
    *out = model_unknowns(m) - heavy - warping(m, all, s, of);
    body_mass_free(&g);
    return STATUS_OK;
}

status massless_count(const model *m, const carried_masses *all, const model_state *s, int *out,
                      fault *f)
{
    wish of = {.task = COUNT};
    return walk(m, all, s, &of, out, f);
}

status massless_forces(const model *m, const carried_masses *all, const model_state *s,
                       double force[], fault *f)
{
    wish of = {.task = KEEP_FORCES, .changed = force};
    int count;
    return walk(m, all, s, &of, &count, f);
}

status massless_motion(const model *m, const carried_masses *all, const model_state *s, double dx[],
                       fault *f)
{
    wish of = {.task = KEEP_MOTION, .changed = dx};
    int count;
    return walk(m, all, s, &of, &count, f);
}

status massless_stiffest(const model *m, const carried_masses *all, const model_state *s,
                         const double diagonal[], double *out, fault *f)
{
    wish of = {.task = STIFFEST, .given = diagonal};
    int count;
    TRY(walk(m, all, s, &of, &count, f));
    *out = of.stiffest;
    return STATUS_OK;
}

/* Turns of bodies between spatial axes and their own. */
static void turn_axes(const model *m, const model_state *s, int own_to_space, double a[])
{
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = model_vertex(m, i)->coordinate + SCENE_RX;
        double R[9], turning[3], turned[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY || at[0] >= model_unknowns(m) ||
            at[1] >= model_unknowns(m) || at[2] >= model_unknowns(m))
            continue;
        for (int k = 0; k < 3; k++)
            turning[k] = a[at[k]];
        rotation_matrix(&s->q[4 * i], R);
        if (own_to_space)
            mat3_mul_vec(R, turning, turned);
        else
            mat3_transpose_mul_vec(R, turning, turned);
        for (int k = 0; k < 3; k++)
            a[at[k]] = turned[k];
    }
}

void massless_own_axes(const model *m, const model_state *s, double a[])
{
    turn_axes(m, s, 0, a);
}

status massless_drop(const model *m, const carried_masses *all, const model_state *s, double a[],
                     fault *f)
{
    const size_t size = (size_t)model_unknowns(m) * sizeof *a;
    double *light = malloc(size + 1);
    if (light == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a motion in time");
    turn_axes(m, s, 1, a);
    memcpy(light, a, size);
    const status outcome = massless_motion(m, all, s, light, f);
    for (int c = 0; c < model_unknowns(m); c++)
        a[c] -= light[c];
    massless_own_axes(m, s, a);
    free(light);
    return outcome;
}

status massless_accelerate(const model *m, const carried_masses *all, const model_state *s,
                           const double force[], double a[], fault *f)
{
    wish of = {.task = ACCELERATE, .given = force, .changed = a};
    int count;
    TRY(walk(m, all, s, &of, &count, f));
    massless_own_axes(m, s, a);
    return STATUS_OK;
}
