#include <math.h>
#include <string.h>

#include "harness/newton/newton.h"
#include "harness/time/drive.h"
#include "harness/time/inertia.h"
#include "harness/time/radau_impl.h"

status radau_error(radau *r, const instant *from, double h, instant *room, double *error, fault *f)
{
    const model *m = r->of.c->model;
    const double s = sqrt(6), l = 0.2748888295956773677478286,
                 e[STAGES] = {(-13 - 7 * s) / 3, (-13 + 7 * s) / 3, -1 / 3.0}, g = 1 / (l * h);
    model_linearisation lin = {.path = from->time, .K = &r->K, .residual = r->dx};
    double *still = room->algorithm;
    for (int c = 0; c < r->free; c++) {
        double positions = from->v[c], rates = 0;
        for (int i = 0; i < STAGES; i++) {
            positions += e[i] * r->stage[i].inc[c] / h;
            rates += e[i] * (r->stage[i].v[c] - from->v[c]) / h;
        }
        room->a[c] = -(rates + g * positions);
    }
    drive_at(&r->of.c->eq, from->state, from->time, NULL, NULL, room->a);
    memset(still, 0, (size_t)r->all * sizeof *still);
    const inertia_relation with = {g * g, 0, still};
    radau_damp_error(r, from, h, e, g, room->strain);
    TRY(linearise_state(&r->of.c->eq, &r->of.c->run->memory, from->state, &lin, f));
    inertia_subtract(m, r->of.masses, from->state, from->v, room->a, r->dx);
    inertia_add_tangent(&r->of.c->eq, r->of.masses, from->state, from->v, from->a, &with, &r->K);
    TRY(context_factor(r->of.c, r->single, &r->K, f));
    factor_solve(r->single, r->dx);
    double square = 0;
    for (int c = 0; c < r->free; c++)
        square += r->weight[c] * r->dx[c] * r->dx[c];
    *error = sqrt(square);
    const factor_counts counts = factor_count(r->single);
    r->of.c->run->counters.factorisations += counts.factorisations - r->counted_single;
    r->counted_single = counts.factorisations;
    r->of.c->run->counters.solutions++;
    return STATUS_OK;
}
