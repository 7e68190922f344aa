/* What comes from outside over a step: the very forces of the step, on what they work on. */
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/time/deformable.h"

/* dr and c of the coordinates; of angles 2 tan(d angle/2). */
static double worked_on(const conserving *s, const double force[])
{
    const model *m = s->of.c->model;
    double sum = 0;
    for (int c = 0; c < s->all; c++)
        sum += force[c] * s->step[c];
    for (int i = 0; i < model_vertices(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        const mesh_release *r = release_of(m, i);
        const int turns = r == NULL ? (v->body == i ? v->angles : 0) : r->turns < 3 ? r->turns : 0;
        for (int k = 0; k < turns; k++) {
            const int c = v->coordinate[SCENE_RX + k];
            if (c != NONE)
                sum += force[c] * (2 * tan(s->step[c] / 2) - s->step[c]);
        }
    }
    return sum;
}

static int moves_by_drivers(const conserving *s)
{
    for (int c = s->free; c < s->all; c++)
        if (s->step[c] != 0)
            return 1;
    return 0;
}

/* eta d . S0 d/h, what the damping stresses of the step take. */
static double dissipated(const conserving *s, const instant *from, model_state *now)
{
    double sum = 0;
    for (int i = 0; i < model_elements(s->of.c->model) && s->of.c->run->damping != NULL; i++) {
        const deformable of = deformable_at(s, from, now, i);
        if (of.S != NULL)
            sum += of.damping / s->h * dense_quadratic(of.strains, of.S, of.d);
    }
    return sum;
}

status conserving_work(conserving *s, const instant *from, instant *to, double h, fault *f)
{
    const size_t bytes = (size_t)s->all * sizeof *s->residual;
    const int behind = 3; /* of the iterations in which k counts */
    double ignored = 0;
    memset(s->residual, 0, bytes);
    conserving_loads(s, from, to->state, h, s->residual);
    to->work = from->work;
    if (moves_by_drivers(s)) {
        double *held = s->dx;
        memcpy(held, s->residual, bytes);
        TRY(conserving_stresses(s, from, to->state, behind, f));
        s->settled = 1;
        conserving_forces(s, from, to->state, &ignored);
        s->settled = 0;
        conserving_inertia(s, from, to->state, h);
        for (int c = s->free; c < s->all; c++)
            held[c] -= s->residual[c];
        to->work += worked_on(s, held);
    } else {
        to->work += worked_on(s, s->residual);
    }
    to->dissipated = from->dissipated + dissipated(s, from, to->state);
    return STATUS_OK;
}

/* Rates r of strains and theirs, s, at the end of a step, from those at its begin and the mean m:
 *   r1 = (3 m - r0)/2 + h s0/4,  s1 = (m - r0)/h + s0/2:
 * of second order, also of what has no inertia, and an error of the begin is gone after two steps
 * (2 m - r0 would keep it for ever). */
void conserving_damped(const conserving *s, const instant *from, double h, instant *to)
{
    const model *m = s->of.c->model;
    for (int i = 0; i < model_elements(m) && s->of.c->run->damping != NULL; i++) {
        const deformable of = deformable_at(s, from, to->state, i);
        const int first = i * model_strains(m);
        double *r = to->strain + first, *rate2 = to->strain2 + first, more[DEFORMABLE_STRAINS];
        for (int k = 0; k < of.strains; k++) {
            const double mean = of.d[k] / h, r0 = from->strain[first + k],
                         s0 = from->strain2[first + k];
            r[k] = (3 * mean - r0) / 2 + h * s0 / 4;
            rate2[k] = (mean - r0) / h + s0 / 2;
        }
        if (of.S == NULL)
            continue;
        dense_mul_vec(of.strains, of.strains, of.S, r, more);
        for (int k = 0; k < of.strains; k++)
            of.sigma[k] += of.damping * more[k];
    }
}
