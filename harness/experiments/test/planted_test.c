/* Injects faults into correct formulations. Each fault changes the output of one function, and must
 * be detected with a message that names the cause. */
#include "harness/experiments/experiments_impl.h"
#include <math.h>

#include "harness/experiments/test/planted.h"

static void strain_changed(const element_data *d, const node_state x[], strain_output *out,
                           void (*change)(strain_output *))
{
    base->strain(d, x, out);
    change(out);
}

/* Defines a strain function that evaluates the formulation and then changes the outputs by
 * `statement`. */
#define STRAIN(name, statement)                                                                    \
    static void name##_change(strain_output *out)                                                  \
    {                                                                                              \
        statement;                                                                                 \
    }                                                                                              \
    static void name(const element_data *d, const node_state x[], strain_output *out)              \
    {                                                                                              \
        strain_changed(d, x, out, name##_change);                                                  \
    }

STRAIN(sign_in_J, if (out->J != NULL) out->J[14 * 2 + 1] *= -1)
STRAIN(percent_in_J, if (out->J != NULL) out->J[14 * 3 + 10] *= 1.01)
STRAIN(turn_of_root, for (int i = 0; out->J != NULL && i < 8; i++) out->J[14 * i + 5] *= 1.01)
STRAIN(no_H, if (out->s != NULL && out->H != NULL) memset(out->H, 0, sizeof(double[14 * 14])))
STRAIN(term_of_H, if (out->s != NULL && out->H != NULL) out->H[14 * 4 + 4] *= 0.9)
STRAIN(beyond_J, if (out->J != NULL) out->J[14 * 8] = 0)
STRAIN(before_e, if (out->e != NULL) out->e[-1] = 0)

static status nodes_exchanged_call(const element_data *d, const node_state x[], double J[])
{
    double swapped[7];
    base->strain(d, x, &(strain_output){.J = J});
    for (int i = 0; i < 8; i++) {
        memcpy(swapped, J + 14 * i, sizeof swapped);
        memcpy(J + 14 * i, J + 14 * i + 7, sizeof swapped);
        memcpy(J + 14 * i + 7, swapped, sizeof swapped);
    }
    return STATUS_OK;
}

static void nodes_exchanged(const element_data *d, const node_state x[], strain_output *out)
{
    base->strain(d, x, out);
    if (out->J != NULL)
        nodes_exchanged_call(d, x, out->J);
}

static status half_energy(const element_data *d, const double e[], const double inner[],
                          stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    if (out->energy != NULL)
        *out->energy /= 2;
    return outcome;
}

static void insensitive(const node_state x[], int node, int turn, node_state out[2])
{
    memcpy(out, x, 2 * sizeof *out);
    for (int i = 0; i < 3 && !turn; i++)
        if (!isfinite(x[node].r[i]))
            out[node].r[i] = out[node].u[i] = 0.1;
    for (int i = 0; i < 9 && turn; i++)
        if (!isfinite(x[node].R[i]))
            out[node].R[i] = i % 4 == 0;
}

static void insensitive_to_positions(const element_data *d, const node_state x[],
                                     strain_output *out)
{
    node_state y[2];
    insensitive(x, 0, 0, y);
    base->strain(d, y, out);
}

static void insensitive_to_rotations(const element_data *d, const node_state x[],
                                     strain_output *out)
{
    node_state y[2];
    insensitive(x, 1, 1, y);
    base->strain(d, y, out);
}

static status insensitive_to_strains(const element_data *d, const double e[], const double inner[],
                                     stress_output *out)
{
    double f[8];
    memcpy(f, e, sizeof f);
    f[3] = isfinite(f[3]) ? f[3] : 0;
    return base->stress(d, f, inner, out);
}

static status soft_about_z(const element_data *d, const double e[], const double inner[],
                           stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    for (int i = 4; i < 6; i++) {
        if (out->sigma != NULL)
            out->sigma[i] *= 0.9;
        for (int j = 0; j < 8 && out->C != NULL; j++)
            out->C[8 * i + j] *= 0.9;
    }
    return outcome;
}

static void not_exact(void)
{
    static check_results c;
    formulation chosen;
    element_type t = changed("beamw_consistent");
    int reported = 0;
    t.stress = soft_about_z;
    formulation_default(base, &chosen);
    chosen.type = &t;
    checks_along(&chosen, &c);
    for (int i = 0; i < c.count; i++)
        reported +=
            strstr(c.check_result[i].sentence,
                   "not exact under a force along y at its end (errors relative to a beam with its "
                   "flexibility in pure bending and the shear flexibility of the section: "
                   "displacement "
                   "0.00") != NULL;
    gsl_test_int(reported, 2, "loads along an element that is too soft");
    for (int i = 0; i < c.count && reported != 2; i++)
        gsl_test(1, "it said: %s", c.check_result[i].sentence);
}

static status softer(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    if (out->C != NULL)
        out->C[0] *= 0.99;
    return outcome;
}

static status unsymmetric(const element_data *d, const double e[], const double inner[],
                          stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    if (out->C != NULL)
        out->C[1] += 0.01 * out->C[0];
    return outcome;
}

static status stressed_at_rest(const element_data *d, const double e[], const double inner[],
                               stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    if (out->sigma != NULL)
        out->sigma[0] += 1;
    if (out->energy != NULL)
        *out->energy += e[0];
    return outcome;
}

static status gives_up(const element_data *d, const double e[], const double inner[],
                       stress_output *out)
{
    const status outcome = base->stress(d, e, inner, out);
    return fabs(e[0]) > 1e-5 ? STATUS_SINGULAR : outcome;
}

static void lopsided(const element_data *d, const double sigma[], double G[])
{
    base->geometric(d, sigma, G);
    G[8] += 0.1 * sigma[0];
}

static void constant_geometric(const element_data *d, const double sigma[], double G[])
{
    base->geometric(d, sigma, G);
    G[9] += 1e6;
}

static double lazy(const element_data *d, const double de[], const double memory[], double inner[])
{
    (void)d, (void)de, (void)memory, (void)inner;
    return 1;
}

static status stiff_in_units(const element_request *request, element_data *out, fault *f)
{
    element_request longer = *request;
    longer.length *= longer.length > 1 ? 1.01 : 1;
    return base->prepare(&longer, out, f);
}

static status no_reason(const element_request *request, element_data *out, fault *f)
{
    return request->features & FEATURE_SHEAR ? base->prepare(request, out, f) : STATUS_REFUSED;
}

/* In a call for many elements, returns the energy of the first element for all elements. */
static void one_energy(int count, const element_data *const data[], const double *const e[],
                       const double *const inner[], stress_output out[], status outcome[])
{
    for (int k = 0; k < count; k++) {
        outcome[k] = base->stress(data[k], e[k], inner[k], &out[k]);
        if (out[k].energy != NULL)
            *out[k].energy = *out[0].energy;
    }
}

static void one_strain(int count, const element_data *const data[], const node_state x[],
                       strain_output out[])
{
    for (int k = 0; k < count; k++) {
        base->strain(data[k], x + (size_t)(2 * k), &out[k]);
        if (k > 0 && out[k].e != NULL)
            out[k].e[0] = out[0].e[0];
    }
}

static status without(const element_request *request, unsigned features, element_data *out,
                      fault *f)
{
    element_request less = *request;
    less.features &= ~features;
    return base->prepare(&less, out, f);
}

static status no_wagner(const element_request *request, element_data *out, fault *f)
{
    return without(request, FEATURE_WAGNER_MOMENTS, out, f);
}

static status no_shear(const element_request *request, element_data *out, fault *f)
{
    return without(request, FEATURE_SHEAR | FEATURE_ENGESSER | FEATURE_HARINGX, out, f);
}

static void no_amplitudes(const element_data *d, const node_state x[], strain_output *out)
{
    node_state flat[2] = {x[0], x[1]};
    flat[0].a = flat[1].a = 0;
    base->strain(d, flat, out);
}

static int one_order_less(const double options[])
{
    (void)options;
    return -1;
}

static void derivatives(void)
{
    PLANT(strain, sign_in_J, "derivatives",
          "J: the derivative of strain 3 with respect to coordinate 2",
          "displacement along y of node 1");
    PLANT(strain, percent_in_J, "derivatives",
          "J: the derivative of strain 4 with respect to coordinate 11",
          "rotation about x of node 2");
    PLANT(strain, nodes_exchanged, "derivatives", "J: the derivative of strain", "differences");
    PLANT(strain, no_H, "derivatives", "H: the second derivative of strain",
          "is 0, but finite differences");
    PLANT(strain, term_of_H, "derivatives", "with respect to coordinates 5 and 5",
          "rotation about y of node 1, rotation about y of node 1");
    PLANT(stress, half_energy, "energy", "stress: sigma", "but the derivative of the energy");
    PLANT(stress, softer, "energy", "C: the derivative of sigma 1 with respect to strain 1",
          "differences");
    PLANT(stress, unsymmetric, "energy", "C: entry 2, 1", "symmetric");
    PLANT(stress, stressed_at_rest, "energy", "stress: sigma 1 of the undeformed element", "N");
    PLANT(stress, gives_up, "energy", "stress: strains of a few hundredths", "'singular'");
    PLANT(geometric, lopsided, "energy", "geometric: entry 1, 2 of G", "symmetric");
    PLANT(geometric, constant_geometric, "energy", "geometric: entry 2, 2", "linear");
}

static void the_rest(void)
{
    PLANT(strain, beyond_J, "bounds", "strain: J: entry 113 is written", "112 entries");
    PLANT(strain, before_e, "bounds", "strain: e: entry", "write only these");
    PLANT(prepare, stiff_in_units, "motion", "in units of", "instead of");
    PLANT(prepare, no_reason, "features", "rejected: no reason is given",
          "with no feature the element fails");
    PLANT(prepare, no_wagner, "features", "declares wagner moments, but strains",
          "do not declare it");
    PLANT(prepare, no_shear, "features", "declares shear, but strains", "do not declare it");
    PLANT(strain, no_amplitudes, "features", "declares warping",
          "no result depends on the warping");
    PLANT(strain_many, one_strain, "many", "many at once: the strains differ", "of 5");
    PLANT(stress_many, one_energy, "many", "many at once: the energies differ", "of 5");
    PLANT(strain, insensitive_to_positions, "unsound", "a position of node 1 that is",
          "gives finite");
    PLANT(strain, insensitive_to_rotations, "unsound", "a rotation of node 2 that is",
          "gives finite");
    PLANT(stress, insensitive_to_strains, "unsound", "stress: strain 4 that is", "gives a finite");
    PLANT(memory, one_order_less, "declared", "inner, memory", "negative");
    PLANT(strain, turn_of_root, "along", "one element clamped at its first node",
          "the reaction to the rotation about z of node 1");
    element_type t = changed("collocation");
    t.update = lazy;
    planted("energy", &t, "update: after", "residual");
}

static void planted_tests(void)
{
    derivatives();
    not_exact();
    the_rest();
}

/* Defines an inertia function that evaluates the formulation and then changes the outputs by
 * `statement`. */
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

static void planted_inertia_tests(void)
{
    PLANT(inertia, heavier, "mass", "inertia: the mass along x", "rho A l");
    PLANT(inertia, unsymmetric_mass, "mass", "inertia: entry 9, 2", "the transposed entry is");
    PLANT(inertia, negative_mass, "mass", "not positive", "rotation about x of node 2");
    PLANT(inertia, fixed_mass, "mass", "rotated as a whole", "rotated back");
    PLANT(inertia, fixed_mass, "mass", "moment of inertia of the sections about x", "rho l I");
    PLANT(inertia, half_potential, "rotating", "the potential is", "1/2 v^T M v");
    PLANT(inertia, wrong_force, "rotating", "centrifugal force in coordinate 9",
          "displacement along y of node 2");
    PLANT(inertia, wrong_softening, "rotating", "entry 3, 3", "differences");
    PLANT(inertia, unsymmetric_softening, "rotating", "entry 3, 2", "the transposed entry is");
    PLANT(inertia, unsymmetric_turns, "rotating", "entry 6, 5", "the transposed entry is");
    PLANT(inertia, not_skew, "rotating", "entry 2, 2", "skew");
    PLANT(inertia, half_coriolis, "rotating", "G v for the velocities v of the frame",
          "centrifugal");
    PLANT(inertia, no_frame, "rotating", "'singular'", "rotating frame");
    PLANT(inertia, half_convective, "in_time", "inertia: the inertia force in coordinate",
          "finite differences of the kinetic energy");
    PLANT(inertia, wrong_rates, "in_time", "entry 5, 4", "differences of the inertia forces");
    PLANT(inertia, fixed_taken, "in_time", "inertia: the inertia force in coordinate 2",
          "the same element rotated as a whole");
    PLANT(inertia, beyond_taken, "bounds", "inertia: taken: entry 15 is written", "14 entries");
    PLANT(inertia, beyond_M, "bounds", "inertia: M: entry 197 is written", "196 entries");
}

int main(void)
{
    planted_tests();
    planted_inertia_tests();
    return gsl_test_summary();
}
