#include "harness/time/balance.h"

#include <float.h>
#include <math.h>

#include "harness/model/model.h"
#include "harness/time/inertia.h"

static status stored(const model *m, const model_state *s, double *out, fault *f)
{
    double none[1] = {0};
    *out = 0;
    for (int i = 0; i < model_elements(m); i++) {
        double energy = 0;
        const double *inner =
            model_inner(m) > 0 ? s->inner + (size_t)i * (size_t)model_inner(m) : none;
        const status outcome = model_type(m)->stress(model_kind_of(m, i)->data,
                                                     s->e + (size_t)i * (size_t)model_strains(m),
                                                     inner, &(stress_output){.energy = &energy});
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "element %d: outside what %s can evaluate", i,
                             model_type(m)->name);
        *out += energy;
    }
    *out += discrete_stored(m, s);
    return STATUS_OK;
}

status balance_of(const model *m, const carried_masses *masses, const instant *at,
                  double out[SCENE_BALANCES], fault *f)
{
    inertia_balance moving;
    inertia_of(m, masses, at->state, at->v, at->ends_known ? at->ends : NULL, &moving);
    TRY(stored(m, at->state, &out[SCENE_STRAIN], f));
    out[SCENE_KINETIC] = moving.kinetic;
    out[SCENE_ENERGY] = out[SCENE_KINETIC] + out[SCENE_STRAIN];
    out[SCENE_WORK] = at->work;
    out[SCENE_DISSIPATED] = at->dissipated;
    out[SCENE_DRIFT] = out[SCENE_ENERGY] + at->dissipated - at->work;
    for (int i = 0; i < 3; i++) {
        out[SCENE_PX + i] = moving.momentum[i];
        out[SCENE_LX + i] = moving.angular[i];
    }
    return STATUS_OK;
}

/* What coordinates are off by when they come out of equations, by their size. */
static const double coordinate_rounding = 32 * DBL_EPSILON;

/* Strain energy of an element whose coordinates are off by that. */
static double rounding_of(const model *m, const mesh_element *el, int index)
{
    enum { E = ELEMENT_MAX_STRAINS };
    const size_t first = (size_t)index * (size_t)model_strains(m);
    const double size = model_length(m),
                 part[NODE_COORDINATES] = {size, size, size, 1, 1, 1, 1 / size};
    double J[E * ELEMENT_MAX_COORDINATES], C[E * E], sum = 0;
    node_state x[ELEMENT_MAX_NODES];
    kinematics_gather(m, kinematics_rest(m), el, x);
    model_type(m)->strain(model_kind(m, el->kind)->data, x, &(strain_output){.J = J});
    if (model_type(m)->stress(model_kind(m, el->kind)->data, kinematics_rest(m)->e + first,
                              kinematics_rest(m)->inner + (size_t)index * (size_t)model_inner(m),
                              &(stress_output){.C = C}) != STATUS_OK)
        return 0;
    for (int i = 0; i < model_strains(m); i++) {
        double off = 0;
        for (int k = 0; k < model_own_coordinates(m); k++)
            off += fabs(J[i * model_own_coordinates(m) + k]) * part[k % NODE_COORDINATES] *
                   coordinate_rounding;
        sum += C[i * model_strains(m) + i] * off * off / 2;
    }
    return sum;
}

double balance_rounding(const model *m)
{
    double sum = 0;
    for (int i = 0; i < model_elements(m); i++)
        sum += rounding_of(m, model_element(m, i), i);
    for (int i = model_discretes(m) - model_springs(m); i < model_discretes(m); i++)
        for (int k = 0; k < 6; k++) {
            const double off = coordinate_rounding * (k < 3 ? model_length(m) : 1);
            sum += model_discrete(m, i)->spring->stiffness[7 * k] * off * off / 2;
        }
    return sum;
}
