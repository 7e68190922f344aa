#include "harness/newton/advance.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/larger.h"
#include "elements/math/rotation.h"
#include "harness/model/model.h"
#include "harness/newton/equations_impl.h"
#include "harness/newton/linearise.h"
#include "harness/newton/loads.h"

/* What loads that the element takes do when its frame turns: to stresses, and to inner unknowns. */
static void follow_turn(const model *m, const double along[], const double local[], double sigma[],
                        double inner[])
{
    double turn[3], more[ELEMENT_MAX_STRAINS];
    dense_mul_vec(3, ELEMENT_ALONG_COORDINATES, along + SLOT_TURN, local, turn);
    dense_mul_vec(model_strains(m), 3, along + SLOT_MIXED, turn, more);
    for (int k = 0; k < model_strains(m); k++)
        sigma[k] += more[k];
    for (int k = 0; k < model_inner(m); k++)
        inner[k] += vec3_dot(along + slot_followed(m) + (ptrdiff_t)3 * k, turn);
}

/* Strains, stresses and inner unknowns of one element. */
static double advance_element(const model *m, const linear_memory *memory, model_state *s, int i,
                              const double dx[], advance_stress *stress)
{
    const mesh_element *el = model_element(m, i);
    model_slot w = linearise_slot(m, memory, i);
    double local[ELEMENT_MAX_COORDINATES], de[ELEMENT_MAX_STRAINS], more[ELEMENT_MAX_STRAINS];
    double *e = &s->e[(size_t)i * (size_t)model_strains(m)],
           *sigma = &s->sigma[(size_t)i * (size_t)model_strains(m)];
    kinematics_local(m, s, el, dx, local);
    dense_mul_vec(model_strains(m), model_own_coordinates(m), w.J, local, de);
    dense_mul_vec(model_strains(m), model_strains(m), w.C, de, more);
    if (model_takes_loads(m) && w.along[SLOT_TAKES] != 0)
        follow_turn(m, w.along, local, more, &s->inner[(size_t)i * (size_t)model_inner(m)]);
    for (int k = 0; k < model_strains(m); k++) {
        const double next = w.sigma[k] + more[k], change = fabs(next - sigma[k]);
        stress->change = change > stress->change ? change : stress->change;
        stress->largest = fabs(next) > stress->largest ? fabs(next) : stress->largest;
        sigma[k] = next;
        de[k] += w.incompatibility[k];
        e[k] += de[k];
    }
    if (model_type(m)->update == NULL)
        return 0;
    return model_type(m)->update(model_kind(m, el->kind)->data, de, w.memory,
                                 &s->inner[(size_t)i * (size_t)model_inner(m)]);
}

static double advance_vertex(const model *m, model_state *s, int index, const double dx[])
{
    const mesh_vertex *v = model_vertex(m, index);
    double d[6], q[4], largest = 0;
    for (int c = 0; c < 6; c++)
        d[c] = v->coordinate[c] == NONE ? 0 : dx[v->coordinate[c]];
    for (int c = 0; c < 3; c++) {
        s->u[3 * index + c] += d[c];
        s->angle[3 * index + c] += d[3 + c];
        largest = larger(largest, larger(fabs(d[c]) / model_length(m), fabs(d[3 + c])));
    }
    if (v->angles == 0) {
        rotation_exp(d + 3, q);
        rotation_compose(q, &s->q[4 * index], &s->q[4 * index]);
        rotation_normalise(&s->q[4 * index]);
    }
    return largest;
}

double advance_state(const equations *eq, const linear_memory *memory, model_state *s,
                     const double dx[], double path, advance_stress *stress)
{
    const model *m = eq->m;
    double largest = 0;
    advance_stress of_elements = {0, 0};
    for (int i = 0; i < model_elements(m); i++)
        largest = larger(largest, advance_element(m, memory, s, i, dx, &of_elements));
    if (stress != NULL)
        *stress = of_elements;
    phases_lap(&eq->run->phases, PHASE_ELEMENTS);
    for (int i = 0; i < model_vertices(m); i++)
        if (model_vertex(m, i)->body == i)
            largest = larger(largest, advance_vertex(m, s, i, dx));
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        largest = larger(largest, release_advance(m, s, i, dx));
    for (int i = 0; i < model_warps(m); i++) {
        s->warp[i] += dx[model_warp(m, i)];
        largest = larger(largest, fabs(dx[model_warp(m, i)]) * model_length(m));
    }
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) != NONE)
            s->driver[d] += dx[model_driver_coordinate(m, d)];
        else if (model_scene(m)->driver[d].value != NULL)
            s->driver[d] = loads_driver_value(eq, &model_scene(m)->driver[d], path);
    kinematics_follow(m, s);
    s->path = path;
    return largest;
}

void advance_settle(const model *m, const linear_memory *memory, const model_state *s)
{
    const size_t n = (size_t)model_strains(m);
    for (int i = 0; i < model_elements(m); i++) {
        const model_slot w = linearise_slot(m, memory, i);
        memcpy(w.sigma, &s->sigma[(size_t)i * n], n * sizeof *w.sigma);
        memset(w.incompatibility, 0, n * sizeof *w.incompatibility);
    }
}
