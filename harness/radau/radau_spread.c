/* Masses that elements spread, in the equations of three stages: blocks of all nodes of an element.
 */
#include <string.h>

#include "elements/math/vec3.h"
#include "harness/inertia/spread.h"
#include "harness/radau/radau_impl.h"

enum { MOST = ELEMENT_MAX_COORDINATES };

/* Block (i, k) of an element -> K[columns x columns]. */
static void block_of(const radau *r, const mesh_element *el, const spread_parts *p, double h, int i,
                     int k, double K[])
{
    spread_motion rates[ELEMENT_MAX_NODES], accelerations[ELEMENT_MAX_NODES],
        place[ELEMENT_MAX_NODES];
    memset(K, 0, (size_t)(p->columns * p->columns) * sizeof *K);
    for (int node = 0; node < el->nodes; node++) {
        radau_relation of;
        radau_relate(r, r->of.c->model->vertex[el->vertex[node]].body, h, i, k, &of);
        rates[node].plain = of.rate;
        accelerations[node].plain = of.acceleration;
        place[node].plain = 1;
        mat3_mul(p->rate[node], of.turn_rate, rates[node].turn);
        mat3_mul(p->rate[node], of.turn_acceleration, accelerations[node].turn);
        memcpy(place[node].turn, p->turn[node], sizeof place[node].turn);
    }
    spread_times(p->columns, p->acceleration, accelerations, K);
    spread_times(p->columns, p->velocity, rates, K);
    if (i == k)
        spread_times(p->columns, p->place, place, K);
    spread_rows(p, K);
}

static void add_element(radau *r, int element, double h, int i)
{
    const model *m = r->of.c->model;
    const mesh_element *el = &m->element[element];
    spread_parts p;
    double K[MOST * MOST];
    spread_element(m, element, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    for (int k = 0; k < STAGES; k++) {
        block_of(r, el, &p, h, i, k, K);
        for (int row = 0; row < p.columns; row++)
            for (int column = 0; column < p.columns; column++)
                stages_add(&r->S, i, k, el->index[row], el->index[column],
                           K[p.columns * row + column]);
    }
}

void radau_spread(radau *r, double h)
{
    for (int i = 0; i < STAGES; i++)
        for (int e = 0; e < r->of.c->model->elements; e++)
            add_element(r, e, h, i);
}
