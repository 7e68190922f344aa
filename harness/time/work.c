#include "harness/time/work.h"

#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/inertia.h"
#include "harness/time/kinks.h"

static int is_driven(const model *m, const mesh_element *el)
{
    for (int k = 0; k < el->columns; k++)
        if (el->index[k] >= model_unknowns(m))
            return 1;
    return 0;
}

status work_alloc(const equations *eq, const carried_masses *masses, outer_work *w, fault *f)
{
    const model *m = eq->m;
    *w = (outer_work){.eq = eq,
                      .m = m,
                      .masses = masses,
                      .force = calloc(2 * (size_t)model_all_coordinates(m) + 1, sizeof *w->force),
                      .element = calloc((size_t)model_elements(m) + 1, sizeof *w->element)};
    if (w->force == NULL || w->element == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the work of a motion");
    w->holding = w->force + model_all_coordinates(m);
    for (int i = 0; i < model_elements(m); i++)
        if (is_driven(m, model_element(m, i)))
            w->element[w->elements++] = i;
    return STATUS_OK;
}

void work_free(outer_work *w)
{
    free(w->force);
    free(w->element);
}

/* Sum over the coordinates; moments of frames whose rates are in their own axes are spatial. */
static double product(const outer_work *w, const model_state *s, const double along[])
{
    const model *m = w->m;
    double sum = dense_dot(model_all_coordinates(m), w->force, along);
    for (int i = 0; i < model_vertices(m); i++) {
        const int *at = &model_vertex(m, i)->coordinate[SCENE_RX];
        double R[9], own[3], moment[3], turned[3];
        if ((model_vertex(m, i)->body != i && i < model_first_release(m)) ||
            forms_of(m, i) != FORM_BODY)
            continue;
        rotation_matrix(&s->q[4 * i], R);
        for (int k = 0; k < 3; k++) {
            own[k] = along[at[k]];
            moment[k] = w->force[at[k]];
        }
        mat3_mul_vec(R, own, turned);
        sum += vec3_dot(moment, turned) - vec3_dot(moment, own);
    }
    return sum;
}

/* All that acts on driven coordinates from outside, loads too: what stresses and inertia take. */
static void hold(outer_work *w, const model_state *s, const double v[], const double a[])
{
    const model *m = w->m;
    const int all = model_all_coordinates(m);
    memset(w->holding, 0, (size_t)all * sizeof *w->holding);
    inertia_subtract(m, w->masses, s, v, a, w->holding);
    for (int c = 0; c < all; c++)
        w->holding[c] = -w->holding[c];
    linearise_add_internal(w->eq, s, w->elements, w->element, w->holding);
    memcpy(w->force + model_unknowns(m), w->holding + model_unknowns(m),
           (size_t)model_driven(m) * sizeof *w->force);
}

double work_power(outer_work *w, const model_state *s, const double v[], const double a[],
                  double time, const double along[])
{
    const model *m = w->m;
    memset(w->force, 0, (size_t)model_all_coordinates(m) * sizeof *w->force);
    for (int i = 0; i < model_scene(m)->loads; i++)
        loads_add_one(w->eq, s, &model_scene(m)->load[i],
                      applied_factor(w->eq, &model_scene(m)->load[i], time), w->force);
    if (model_driven(m) > 0)
        hold(w, s, v, a);
    return product(w, s, along);
}

double work_trapezoid(outer_work *w, const instant *from, const instant *to, const double inc[])
{
    return (work_power(w, from->state, from->v, from->a, from->time, inc) +
            work_power(w, to->state, to->v, to->a, kinks_before(w->m, to->time), inc)) /
           2;
}
