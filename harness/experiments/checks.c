#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

const checks_family checks_families[CHECKS_FAMILIES] = {
    {"declared", "the declarations are consistent", checks_declared},
    {"features", "each declared feature works alone, in subsets and in the cases", checks_features},
    {"derivatives", "J and H are the first and second derivatives of the strains",
     checks_derivatives},
    {"energy", "stress and C derive from the energy; C and G are symmetric", checks_energy},
    {"force", "force and stiffness derive from the energy", checks_force},
    {"motion", "rigid motion, node order and units do not change the results", checks_motion},
    {"stateless", "equal calls give bit-for-bit equal results after any other calls",
     checks_stateless},
    {"many", "many elements at once give the same results as each element alone", checks_many},
    {"bounds", "outputs are filled completely; no memory outside them changes", checks_bounds},
    {"unsound", "NaN and Inf are reported and not suppressed", checks_nonfinite},
    {"mass", "M is positive definite and contains the mass of the beam", checks_mass},
    {"along", "distributed loads are as exact as forces at the nodes", checks_along},
    {"rotating", "centrifugal and gyroscopic terms derive from the kinetic energy",
     checks_rotating},
    {"in_time", "inertia forces during a motion derive from the kinetic energy", checks_in_time},
    {"history", "committing the history changes neither strains nor forces", checks_history},
};

enum { M = TEST_ELEMENT_STRAINS };

static void rigid(const test_element *s, double size, const double turn[3], check_result *one)
{
    double e[M], carried_e[M];
    node_state x[ELEMENT_MAX_NODES], carried[ELEMENT_MAX_NODES];
    test_element_state(s, size, 5, x);
    test_element_rigid_motion(s, turn, x, carried);
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    s->type.strain(s->data, carried, &(strain_output){.e = carried_e, .history = s->history});
    for (int i = 0; i < s->strains; i++)
        checks_deviation(
            one, fabs(carried_e[i] - e[i]) / s->request.length,
            "strain: if the element is rotated by (%g, %g, %g) rad and shifted as a "
            "whole, strain %d changes from %.6g to %.6g m; measure strains in axes that "
            "rotate with the element%s",
            turn[0], turn[1], turn[2], i + 1, e[i], carried_e[i], s->words);
}

static void rest(const test_element *s, check_result *one)
{
    double e[M];
    node_state x[ELEMENT_MAX_NODES];
    test_element_state(s, 0, 5, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    for (int i = 0; i < s->strains; i++)
        checks_deviation(one, fabs(e[i]) / s->request.length,
                         "strain: strain %d of the undeformed element is %.6g m; define it as zero "
                         "in that state%s",
                         i + 1, e[i], s->words);
}

/* Computes the energy or, if there is none, the sum of the absolute stresses, times the length. */
static status energy_of(const test_element *s, const node_state x[], double *energy)
{
    double e[M], inner[TEST_ELEMENT_INNER];
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    test_element_rest(s, inner);
    *energy = NAN;
    if (!test_element_lacks_energy(s))
        return test_element_converged(s, e, inner, &(stress_output){.energy = energy});
    double sigma[M];
    *energy = 0;
    TRY(test_element_converged(s, e, inner, &(stress_output){.sigma = sigma}));
    for (int i = 0; i < s->strains; i++)
        *energy += fabs(sigma[i]) * s->request.length;
    return STATUS_OK;
}

static const char *energy_word(const test_element *s)
{
    return test_element_lacks_energy(s) ? "a sum of forces times its length" : "an energy";
}

/* Checks that exchanging the nodes does not change the energy. The sections of the reversed element
 * are rotated by pi about y, and the warping amplitudes are unchanged. */
static void node_order(const test_element *s, double size, check_result *one)
{
    static const double half_turn[9] = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
    double there, back;
    node_state x[ELEMENT_MAX_NODES], reversed[ELEMENT_MAX_NODES];
    test_element_state(s, size, 3, x);
    for (int k = 0; k < s->nodes; k++) {
        reversed[k] = x[s->nodes - 1 - k];
        mat3_mul(x[s->nodes - 1 - k].R, half_turn, reversed[k].R);
        memset(x[k].scalar, 0, sizeof x[k].scalar);
        memset(reversed[k].scalar, 0, sizeof reversed[k].scalar);
    }
    energy_of(s, x, &there);
    energy_of(s, reversed, &back);
    checks_deviation(
        one, checks_relative(fabs(back - there), fabs(there)),
        "strain, stress: if its nodes are exchanged, the element has an energy of %.9g "
        "J instead of %.9g J; correct strain or stress, or declare LIMIT_ORDER_DEPENDENT%s",
        back, there, s->words);
}

static void has_energy(const test_element *s, check_result *one)
{
    double energy;
    node_state x[ELEMENT_MAX_NODES];
    test_element_state(s, 0.05, 3, x);
    energy_of(s, x, &energy);
    checks_require(
        one, energy != 0,
        "strain, stress: the deformed element has %s of zero; correct strain or stress%s",
        energy_word(s), s->words);
}

static void units(const test_element *s, check_result *one)
{
    static const double unit[] = {1, 1e-3, 1e-6};
    double energy[3];
    for (int k = 0; k < 3; k++) {
        test_element_request what = s->made;
        test_element other;
        node_state x[ELEMENT_MAX_NODES];
        fault f = {""};
        what.unit = unit[k];
        for (int i = 0; i < 3; i++)
            what.curvature[i] *= unit[k];
        energy[k] = NAN;
        if (test_element_make(&what, &other, &f) == STATUS_OK) {
            test_element_state(&other, 0.01, 23, x);
            energy_of(&other, x, &energy[k]);
            energy[k] *= unit[k];
        }
        test_element_free(&other);
    }
    for (int k = 1; k < 3; k++)
        checks_deviation(
            one, checks_relative(fabs(energy[k] - energy[0]), fabs(energy[0])),
            "prepare, stress: the same element in units of %g m has %s of %.9g J instead of "
            "%.9g J; check that no length is compared with a dimensionless number%s",
            unit[k], energy_word(s), energy[k], energy[0], s->words);
}

static void check(const test_element *s, check_results *c)
{
    static const double turn[][3] = {{0.71, -1.93, 1.37}, {0, 0, 2.2}, {3.1, 0, 0}, {0, -1.6, 0}};
    checks_current(c, "strain of a rotated element%s", s->words);
    const int objective = !(s->type.limits & LIMIT_NOT_OBJECTIVE) && !test_element_lacks_energy(s);
    for (size_t k = 0; k < sizeof turn / sizeof turn[0] && objective; k++) {
        rigid(s, 0, turn[k], checks_open(c, "rigid motion causes no strain", 1e-14));
        rigid(s, 0.2, turn[k], checks_open(c, "rigid motion changes no strain", 2e-14));
    }
    rest(s, checks_open(c, "the undeformed element has no strain", 1e-14));
    checks_current(c, "strain and stress of an element whose nodes are exchanged%s", s->words);
    if (!(s->type.limits & LIMIT_ORDER_DEPENDENT) && s->values == 0 && s->made.curvature[0] == 0 &&
        s->made.form == PROFILES_RECTANGLE) {
        if (s->type.offers & FEATURE_LARGE)
            node_order(
                s, 0.05,
                checks_open(c, "the energy does not change if the nodes are exchanged", 1e-9));
        else
            node_order(
                s, 1e-5,
                checks_open(c, "the energy does not change if the nodes are exchanged", 5e-5));
    }
    checks_current(c, "strain and stress of a deformed element%s", s->words);
    has_energy(s, checks_open(c, "a deformed element has energy", 0));
    checks_current(c, "prepare, strain and stress in units of mm and um%s", s->words);
    units(s, checks_open(c, "the energy does not depend on the unit of length", 1e-10));
}

void checks_motion(const formulation *chosen, check_results *out)
{
    test_elements_each(chosen, out, check);
    if (chosen->type->limits & LIMIT_ORDER_DEPENDENT)
        checks_not_made(out, "the energy does not change if the nodes are exchanged",
                        "declares LIMIT_ORDER_DEPENDENT");
    else if (element_history(chosen->type, chosen->option) > 0)
        checks_not_made(out, "the energy does not change if the nodes are exchanged",
                        "the history of the element depends on the order of the nodes");
    if (chosen->type->limits & LIMIT_NOT_OBJECTIVE)
        checks_not_made(out, "rigid motion changes no strain",
                        "declares LIMIT_NOT_OBJECTIVE; see 'paths'");
    else if (chosen->type->force != NULL && element_history(chosen->type, chosen->option) > 0)
        checks_not_made(out, "rigid motion changes no strain",
                        "the element provides forces with a history, which 'paths' checks");
}

enum { NONFINITE_M = TEST_ELEMENT_STRAINS };

static int all_finite(int n, const double a[])
{
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i]))
            return 0;
    return 1;
}

/* Returns 1 if neither the status nor the values show that the state is invalid. */
static int accepts_nonfinite(const test_element *s, const node_state x[])
{
    double e[NONFINITE_M], sigma[NONFINITE_M], inner[TEST_ELEMENT_INNER], energy = 0;
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    if (!all_finite(s->strains, e))
        return 0;
    test_element_rest(s, inner);
    const status outcome =
        s->type.stress(s->data, e, inner,
                       &(stress_output){.energy = &energy, .sigma = sigma, .history = s->history});
    return outcome == STATUS_OK && (test_element_lacks_energy(s) || isfinite(energy)) &&
           all_finite(s->strains, sigma);
}

static void corrupt(const test_element *s, double by, check_result *one)
{
    static const char *const what[] = {"position", "rotation"};
    for (int k = 0; k < s->nodes; k++)
        for (int i = 0; i < 4; i++) {
            node_state x[ELEMENT_MAX_NODES];
            test_element_state(s, 0.02, 59, x);
            if (i < 3)
                x[k].r[i] = x[k].u[i] = by;
            for (int j = 0; j < 9 && i == 3; j++)
                x[k].R[j] = by;
            checks_require(one, !accepts_nonfinite(s, x),
                           "strain, stress: a %s of node %d that is %g gives finite strains and "
                           "stresses; let NaN and Inf propagate, or return a status%s",
                           what[i == 3], k + 1, by, s->words);
        }
}

static void corrupt_strains(const test_element *s, double by, check_result *one)
{
    const double none[NONFINITE_M] = {0};
    double C[NONFINITE_M * NONFINITE_M], inner[TEST_ELEMENT_INNER];
    test_element_rest(s, inner);
    if (s->type.stress(s->data, none, inner, &(stress_output){.C = C, .history = s->history}) !=
        STATUS_OK)
        return;
    for (int i = 0; i < s->strains; i++) {
        double e[NONFINITE_M] = {0}, sigma[NONFINITE_M], energy = 0;
        if (C[i * s->strains + i] == 0)
            continue;
        e[i] = by;
        test_element_rest(s, inner);
        const status outcome = s->type.stress(
            s->data, e, inner,
            &(stress_output){.energy = &energy, .sigma = sigma, .history = s->history});
        const int finite = test_element_lacks_energy(s) || isfinite(energy);
        checks_require(
            one, outcome != STATUS_OK || !finite || !all_finite(s->strains, sigma),
            "stress: strain %d that is %g gives a finite energy and finite stresses; let "
            "NaN and Inf propagate, or return a status%s",
            i + 1, by, s->words);
    }
}

static void far_away(const test_element *s, double size, check_result *one)
{
    double e[NONFINITE_M], J[NONFINITE_M * TEST_ELEMENT_COORDINATES], sigma[NONFINITE_M],
        C[NONFINITE_M * NONFINITE_M], inner[TEST_ELEMENT_INNER];
    node_state x[ELEMENT_MAX_NODES];
    test_element_state(s, size, 61, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J, .history = s->history});
    test_element_rest(s, inner);
    s->type.stress(s->data, e, inner,
                   &(stress_output){.sigma = sigma, .C = C, .history = s->history});
    checks_require(one, 1, "%s", "");
}

static void nonfinite_check(const test_element *s, check_results *c)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (size_t k = 0; k < sizeof none / sizeof none[0]; k++) {
        checks_current(c, "strain and stress of a state that is %g%s", none[k], s->words);
        corrupt(s, none[k], checks_open(c, "states that are NaN or Inf are reported", 0));
        corrupt_strains(s, none[k], checks_open(c, "strains that are NaN or Inf are reported", 0));
    }
    static const double far[] = {1, 1e3, 1e10, 1e30, 1e100, 1e200, 1e300};
    for (size_t k = 0; k < sizeof far / sizeof far[0]; k++) {
        const double size = far[k];
        checks_current(c, "strain and stress of a state %g lengths and radians away%s", size,
                       s->words);
        far_away(s, size, checks_open(c, "calls with states far from rest return", 0));
    }
}

void checks_nonfinite(const formulation *chosen, check_results *out)
{
    test_elements_each(chosen, out, nonfinite_check);
}
