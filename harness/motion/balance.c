#include "harness/motion/balance.h"

#include "harness/inertia/inertia.h"
#include "harness/model/discrete.h"

static status stored(model *m, const model_state *s, double *out, fault *f)
{
    double none[1] = {0};
    *out = 0;
    for (int i = 0; i < m->elements; i++) {
        double energy = 0;
        const double *inner = m->inner > 0 ? s->inner + (size_t)i * (size_t)m->inner : none;
        const status outcome =
            m->type->stress(m->kind[m->element[i].kind].data, s->e + (size_t)i * (size_t)m->strains,
                            inner, &(stress_output){.energy = &energy});
        if (outcome != STATUS_OK)
            return fault_set(f, outcome, "element %d: outside what %s can evaluate", i,
                             m->type->name);
        *out += energy;
    }
    *out += discrete_stored(m, s);
    return STATUS_OK;
}

status balance_of(model *m, const carried *masses, const instant *at, double out[SCENE_BALANCES],
                  fault *f)
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
