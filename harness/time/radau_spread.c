/* Masses that elements spread, in the equations of three stages: blocks of all nodes of an element.
 */
#include <string.h>

#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/radau_impl.h"
#include "harness/time/spread.h"

/* What the motion of a node in stage i gains by spatial increments of its coordinates in stage k.
 */
static void motions_of(const radau *r, const spread_parts *p, int node, double h, int i, int k,
                       spread_motion *rates, spread_motion *accelerations)
{
    const int vertex = p->el->vertex[node], body = model_vertex(r->of.c->model, vertex)->body;
    radau_relation of;
    radau_relate(r, body, h, i, k, &of);
    rates->plain = of.rate;
    accelerations->plain = of.acceleration;
    if (vertex < model_first_release(r->of.c->model)) {
        mat3_mul(p->rate[node], of.turn_rate, rates->turn);
        mat3_mul(p->rate[node], of.turn_acceleration, accelerations->turn);
        return;
    }
    radau_in_space(r, body, i, of.turn_rate, rates->turn);
    radau_in_space(r, body, i, of.turn_acceleration, accelerations->turn);
    radau_relate(r, vertex, h, i, k, &of);
    radau_in_space(r, vertex, i, of.turn_rate, rates->ball);
    radau_in_space(r, vertex, i, of.turn_acceleration, accelerations->ball);
}

static void add_element(radau *r, int element, double h, int i)
{
    const model *m = r->of.c->model;
    spread_parts p;
    spread_motion rates[ELEMENT_MAX_NODES], accelerations[ELEMENT_MAX_NODES],
        place[ELEMENT_MAX_NODES];
    spread_element(m, element, r->stage[i].state, r->stage[i].v, r->stage[i].a, &p);
    spread_place(m, &p, place);
    for (int k = 0; k < STAGES; k++) {
        double K[MODEL_MAX_COORDINATES * MODEL_MAX_COORDINATES];
        memset(K, 0, (size_t)(p.columns * p.columns) * sizeof *K);
        for (int node = 0; node < p.el->nodes; node++)
            motions_of(r, &p, node, h, i, k, &rates[node], &accelerations[node]);
        spread_times(m, &p, p.acceleration, accelerations, K);
        spread_times(m, &p, p.velocity, rates, K);
        if (i == k)
            spread_times(m, &p, p.place, place, K);
        spread_rows(&p, K);
        stages_add_element(&r->S, i, k, assemble_of(r->of.c->run->patterns, &r->K), element, K);
    }
}

void radau_spread(radau *r, double h)
{
    for (int i = 0; i < STAGES; i++)
        for (int e = 0; e < model_elements(r->of.c->model); e++)
            add_element(r, e, h, i);
}
