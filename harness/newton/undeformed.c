#include "harness/newton/undeformed.h"
#include "cases/scene/names.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/model/model.h"
#include "harness/newton/ahead.h"
#include "harness/newton/equations_impl.h"

/* Elements of a model from which on room is worth more than the last digits of each J. */
enum { LARGE = 1000, FIRST_ROOM = 16 };

static size_t size_of(const model *m)
{
    return (size_t)model_strains(m) * (size_t)(model_own_coordinates(m) + model_strains(m) + 1);
}

static status begin(const equations *eq, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    if (u->of != NULL)
        return STATUS_OK;
    u->room = model_elements(m) < LARGE ? model_elements(m) : FIRST_ROOM;
    u->of = malloc(((size_t)model_elements(m) + 1) * sizeof *u->of);
    u->value = malloc((size_t)u->room * size_of(m) * sizeof *u->value + 1);
    if (u->of == NULL || u->value == NULL) { /* another analysis may ask again */
        free(u->of);
        free(u->value);
        u->of = NULL;
        u->value = NULL;
        return fault_set(f, STATUS_FAULT, "out of memory for the undeformed elements");
    }
    for (int i = 0; i < model_elements(m); i++)
        u->of[i] = NONE;
    return STATUS_OK;
}

/* Is element i as the one whose forms were kept last? Its triads are those of chords between places
 * that are rounded. */
static int alike(const equations *eq, int i)
{
    const model *m = eq->m;
    const mesh_element *el = model_element(m, i),
                       *last = model_element(m, eq->run->undeformed.last);
    if (eq->run->undeformed.count == 0 || model_elements(m) < LARGE || el->kind != last->kind)
        return 0;
    const double same = 1e-12 + 8 * DBL_EPSILON *
                                    vec3_norm(model_vertex(m, el->vertex[0])->position) /
                                    model_kind(m, el->kind)->length;
    for (int k = 0; k < model_nodes(m); k++)
        for (int j = 0; j < 9; j++)
            if (!(fabs(el->triad[k][j] - last->triad[k][j]) <= same))
                return 0;
    return 1;
}

static int is_strained(const model *m, int i)
{
    return vec3_norm(model_kind_of(m, i)->strain) > 0;
}

/* C is that at no strain: what initial stresses add to it is left to geometric stiffnesses. */
static status evaluate_strained(const model *m, int i, const double e[], const double inner[],
                                double C[], double initial[])
{
    static const double none[ELEMENT_MAX_STRAINS];
    double own[ELEMENT_MAX_STRAINS];
    TRY(model_type(m)->stress(model_kind_of(m, i)->data, none, inner,
                              &(stress_output){.sigma = initial, .C = C}));
    dense_mul_vec(model_strains(m), model_strains(m), C, e, own);
    for (int k = 0; k < model_strains(m); k++)
        initial[k] += own[k];
    return STATUS_OK;
}

static status evaluate(const equations *eq, int i, double J[], double C[], double initial[])
{
    const model *m = eq->m;
    double e[ELEMENT_MAX_STRAINS] = {0}, none[1] = {0};
    const double *inner =
        model_inner(m) > 0 ? &kinematics_rest(m)->inner[(size_t)i * (size_t)model_inner(m)] : none;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), model_element(m, i), x);
    eq->run->counters.strain_evaluations++;
    eq->run->counters.stress_evaluations++;
    ahead_strain(eq, i, x, &(strain_output){.e = e, .J = J});
    if (is_strained(m, i))
        return evaluate_strained(m, i, e, inner, C, initial);
    return ahead_stress(eq, i, e, inner, &(stress_output){.C = C});
}

/* Room for one more. */
static status grow(const equations *eq, fault *f)
{
    run_undeformed *u = &eq->run->undeformed;
    if (u->count < u->room)
        return STATUS_OK;
    double *more = realloc(u->value, 2 * (size_t)u->room * size_of(eq->m) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the undeformed elements");
    u->value = more;
    u->room *= 2;
    return STATUS_OK;
}

static status make(const equations *eq, int i, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    if (!alike(eq, i)) {
        TRY(grow(eq, f));
        double *J = u->value + (size_t)u->count * size_of(m),
               *C = J + model_strains(m) * model_own_coordinates(m);
        const status outcome = evaluate(eq, i, J, C, C + model_strains(m) * model_strains(m));
        if (outcome != STATUS_OK)
            return fault_set(
                f, outcome,
                "element %d of %s: its undeformed state is outside what %s can evaluate", i,
                scene_called(model_scene(m), SCENE_MEMBERS, model_element(m, i)->member).text,
                model_type(m)->name);
        u->last = i;
        u->count++;
    }
    u->of[i] = u->count - 1;
    return STATUS_OK;
}

status undeformed_of(const equations *eq, int i, undeformed_element *out, fault *f)
{
    const model *m = eq->m;
    run_undeformed *u = &eq->run->undeformed;
    TRY(begin(eq, f));
    if (u->of[i] == NONE)
        TRY(make(eq, i, f));
    out->J = u->value + (size_t)u->of[i] * size_of(m);
    out->C = out->J + model_strains(m) * model_own_coordinates(m);
    out->initial = is_strained(m, i) ? out->C + model_strains(m) * model_strains(m) : NULL;
    return STATUS_OK;
}

void undeformed_begin(const equations *eq)
{
    const model *m = eq->m;
    if (eq->run->undeformed.of != NULL)
        return;
    ahead_strains(eq, kinematics_rest(m), AHEAD_E | AHEAD_J, NULL);
    ahead_stresses(eq, NULL, kinematics_rest(m)->inner);
}
