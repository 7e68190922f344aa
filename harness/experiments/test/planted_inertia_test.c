/* Faults planted into the inertia of formulations: each is noticed, with a sentence that names the
 * right thing. */
#include "harness/experiments/test/planted.h"

/* An inertia whose outputs are changed. */
#define INERTIA(name, statement)                                                                   \
    static status name(const element_data *d, const node_state x[],                                \
                       const element_rotating_frame *frame, inertia_output *out)                   \
    {                                                                                              \
        const status outcome = base->inertia(d, x, frame, out);                                    \
        statement;                                                                                 \
        return outcome;                                                                            \
    }
#define EACH(count, statement)                                                                     \
    for (int i = 0; i < (count); i++)                                                              \
    statement

INERTIA(heavier, if (out->M != NULL) EACH(196, out->M[i] *= 1.01))
INERTIA(unsymmetric_mass, if (out->M != NULL) out->M[14 * 1 + 8] += 0.01 * out->M[14 + 1])
INERTIA(negative_mass, if (out->M != NULL) out->M[14 * 10 + 10] *= -1)
INERTIA(fixed_mass, if (out->M != NULL) out->M[14 * 3 + 3] += 0.5 * out->M[14 * 3 + 3])
INERTIA(half_potential, if (out->potential != NULL) *out->potential /= 2)
INERTIA(wrong_force, if (out->force != NULL) out->force[8] *= -1)
INERTIA(wrong_softening, if (out->N != NULL) out->N[14 * 2 + 2] *= 1.01)
INERTIA(unsymmetric_softening, if (out->N != NULL) out->N[14 * 1 + 2] *= 1.01)
/* Of a radian more than of a length, in units of the specimen's length [m]. */
INERTIA(
    unsymmetric_turns, if (out->N != NULL) {
        out->N[14 * 5 + 4] += 0.03 * 0.2385 * 0.2385 * out->N[0];
        out->N[14 * 2 + 1] += 0.01 * out->N[0];
    })
INERTIA(not_skew, if (out->G != NULL) out->G[14 * 1 + 1] += out->G[14 + 2])
INERTIA(half_coriolis, if (out->G != NULL) EACH(196, out->G[i] /= 2))
INERTIA(half_convective, if (out->taken != NULL) EACH(14, out->taken[i] *= 0.5))
INERTIA(wrong_rates, if (out->C != NULL) out->C[14 * 4 + 3] *= 1.01)
INERTIA(fixed_taken,
        if (out->taken != NULL && out->acceleration != NULL) out->taken[1] += 0.1 * out->taken[0])
INERTIA(beyond_taken, if (out->taken != NULL) out->taken[14] = 0)
INERTIA(beyond_M, if (out->M != NULL) out->M[196] = 0)

static status no_frame(const element_data *d, const node_state x[],
                       const element_rotating_frame *frame, inertia_output *out)
{
    return frame != NULL ? STATUS_SINGULAR : base->inertia(d, x, frame, out);
}

int main(void)
{
    PLANT(inertia, heavier, "mass", "inertia: the mass along x", "rho A l");
    PLANT(inertia, unsymmetric_mass, "mass", "inertia: M entry 9, 2", "other way round");
    PLANT(inertia, negative_mass, "mass", "not positive", "rotation about x of node 2");
    PLANT(inertia, fixed_mass, "mass", "turned as a whole", "turned back");
    PLANT(inertia, fixed_mass, "mass", "moment of inertia of the sections about x", "rho l I");
    PLANT(inertia, half_potential, "rotating", "the potential is", "kinetic energy");
    PLANT(inertia, wrong_force, "rotating", "centrifugal force in coordinate 9",
          "displacement along y of node 2");
    PLANT(inertia, wrong_softening, "rotating", "N entry 3, 3", "differences");
    PLANT(inertia, unsymmetric_softening, "rotating", "N entry 3, 2", "other way round");
    PLANT(inertia, unsymmetric_turns, "rotating", "N entry 6, 5", "other way round");
    PLANT(inertia, not_skew, "rotating", "G entry 2, 2", "skew");
    PLANT(inertia, half_coriolis, "rotating", "G times the frame's own motion", "centrifugal");
    PLANT(inertia, no_frame, "rotating", "status 'singular'", "rotating frame");
    PLANT(inertia, half_convective, "in_time", "inertia: taken in coordinate",
          "differences of the kinetic energy");
    PLANT(inertia, wrong_rates, "in_time", "C entry 5, 4", "differences of what is taken");
    PLANT(inertia, fixed_taken, "in_time", "inertia: taken in coordinate 2",
          "the same element turned as a whole");
    PLANT(inertia, beyond_taken, "bounds", "inertia: taken: it has 14 entries", "entry 15");
    PLANT(inertia, beyond_M, "bounds", "inertia: M: it has 196 entries", "entry 197");
    return gsl_test_summary();
}
