/* A steady rotation must continue as it starts, and a released structure must keep its energy.
 * Resultants in a rotating rod must agree with a closed form. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/scalar.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

#define START_RODS "harness/time/test/rods.yaml"

static const double omega = 3, end = 0.5;

static void check(const answer *a, const char *name, double expected, double tolerance)
{
    const double found = answer_of(a, name);
    gsl_test(!(fabs(found - expected) <= tolerance), "%s: %.12g, expected %.12g", name, found,
             expected);
}

/* The motion must agree with the steady rotation, at nodes and between them. `tolerance` is in m,
 * and `force` is the tolerance relative to the largest force. */
static void keep_turning(scene_scheme scheme, double step, double tolerance, double force)
{
    static const char *const place[] = {"ux", "uy", "uz"}, *const inside[] = {"inside_N",
                                                                              "inside_Qz",
                                                                              "inside_My"};
    char steady[SCENE_NAME];
    answer a;
    scenes_ask(START_RODS, &element_geometrically_exact, 4, &a, "of=on_hub;integrator=%s;step=%g",
               scenes_integrator[scheme], step);
    for (int i = 0; i < 3; i++) {
        snprintf(steady, sizeof steady, "steady_%s", place[i]);
        check(&a, place[i], answer_of(&a, steady), tolerance);
    }
    check(&a, "N", answer_of(&a, "steady_N"), force * answer_of(&a, "steady_N"));
    check(&a, "N_tip", 0, 1e-10);
    const double R = answer_of(&a, "steady_R_ux");
    check(&a, "R_ux", R * cos(omega * end), force * fabs(R));
    check(&a, "R_uy", R * sin(omega * end), force * fabs(R));
    check(&a, "R_rz", 0, force * fabs(R));
    for (int i = 0; i < 3; i++) {
        snprintf(steady, sizeof steady, "steady_%s", inside[i]);
        check(&a, inside[i], answer_of(&a, steady), force * fabs(R));
    }
}

static void refuse_otherwise(void)
{
    answer a;
    scenes_ask(START_RODS, &element_geometrically_exact, 2, &a,
               "of=on_hub;integrator=alpha;rate=2.9");
    gsl_test(a.status != STATUS_REFUSED ||
                 strstr(a.reason, "does not rotate with the axes") == NULL,
             "a drive beside the axes is refused (%s)", a.reason);
}

static void release(const char *then, int rings)
{
    answer a;
    scenes_ask(START_RODS, &element_geometrically_exact, 4, &a, "of=bent;end=1;stays=%s", then);
    const double strain = moving_largest(&a, "strain"), kinetic = moving_largest(&a, "kinetic");
    gsl_test(!(rings ? kinetic > 0.5 * strain : kinetic < 1e-15 * strain),
             "force %s: kinetic energy %g, strain %g J (%s)", then, kinetic, strain, a.reason);
    gsl_test(!(moving_largest(&a, "work") < 1e-12 * strain), "force %s: no work", then);
    gsl_test(!(moving_largest(&a, "drift") < 1e-3 * strain), "force %s: no drift (%g of %g)", then,
             moving_largest(&a, "drift"), strain);
}

static void start_tests(void)
{
    keep_turning(SCENE_ALPHA, 0.02, 2e-3, 5e-3);
    keep_turning(SCENE_RADAU, 0.02, 1e-8, 2e-6);
    refuse_otherwise();
    release("1", 0);
    release("0", 1);
}

/* Resultants between nodes in a motion must agree with a closed form. A rod of length L and mass m
 * per length along x spins about z through its end. The point at X moves to r = sin(k X)/(k cos(k
 * L)), and N = EA (cos(k X)/cos(k L) - 1) with k^2 = m w^2/EA. For small strains, N is m w^2 (L^2 -
 * X^2)/2. */

extern const element_type element_geometrically_exact, element_collocation;

#define NODES_RODS "harness/time/test/rods.yaml"

enum { PLACES = 3, MESHES = 4 };
static const double length = 2, nodes_omega = 3, EA = 200, mass = 1.5,
                    place[PLACES] = {0, 0.3, 0.5};

static double expected(int i)
{
    const double k = sqrt(mass / EA) * nodes_omega;
    return EA * (cos(k * place[i] * length) / cos(k * length) - 1);
}

/* The relative errors of N at the finest mesh must be below 2e-4. Their order, from the two finest
 * meshes, must exceed `order` - 0.2. If `order` is 2, their order must also be below 2.2. Errors
 * below 1e-8 may have any order. */
static void spin(const element_type *type, scene_scheme scheme, double order)
{
    double error[MESHES][PLACES];
    for (int n = 0; n < MESHES; n++) {
        answer a;
        scenes_ask(NODES_RODS, type, 2 << n, &a, "of=spun;end=0.02;step=5e-4;integrator=%s",
                   scenes_integrator[scheme]);
        for (int i = 0; i < PLACES; i++) {
            const char name[] = {'N', (char)('0' + i), 0};
            error[n][i] = fabs(answer_of(&a, name) / expected(i) - 1);
        }
        gsl_test(!(fabs(answer_of(&a, "largest") / answer_of(&a, "N0") - 1) < 1e-9),
                 "%s: most where it is held (%s)", type->name, a.reason);
    }
    for (int i = 0; i < PLACES; i++) {
        const double last = error[MESHES - 1][i], found = log2(error[MESHES - 2][i] / last);
        gsl_test(
            !(((found > order - 0.2 && (order > 2 || found < 2.2)) || last < 1e-8) && last < 2e-4),
            "%s: N at %g: errors %.3g %.3g %.3g %.3g, order %.3g", type->name, place[i],
            error[0][i], error[1][i], error[2][i], last, found);
    }
}

static void between_nodes_tests(void)
{
    spin(&element_collocation, SCENE_CONSERVING, 2);
    spin(&element_collocation, SCENE_RADAU, 2);
    spin(&element_geometrically_exact, SCENE_CONSERVING, 3);
    spin(&element_geometrically_exact, SCENE_RADAU, 3);
}

extern const element_type element_geometrically_exact;

#define LINKED_RODS "harness/time/test/rods.yaml"

static const char *const joints[] = {"stiff", "hinge", "universal",
                                     "ball",  "slide", "sliding_hinge"};

static double solve(const char *joint, double damping, scene_scheme scheme, double step, double *x,
                    char *why)
{
    answer a;
    scenes_ask(LINKED_RODS, &element_geometrically_exact, 2, &a,
               "of=linked;end=0.4;joint=%s;damping=%g;integrator=%s;step=%g", joint, damping,
               scenes_integrator[scheme], step);
    *x = answer_of(&a, "x");
    snprintf(why, FAULT_TEXT, "%s", a.reason);
    return moving_largest(&a, "drift") / moving_largest(&a, "kinetic");
}

static void linked_tests(void)
{
    for (int i = 0; i < (int)(sizeof joints / sizeof joints[0]); i++) {
        double alpha, radau, shorter;
        char why[FAULT_TEXT];
        const double of_alpha = solve(joints[i], 0, SCENE_ALPHA, 0.0025, &alpha, why),
                     of_radau = solve(joints[i], 0, SCENE_RADAU, 0.005, &radau, why),
                     of_shorter = solve(joints[i], 0, SCENE_RADAU, 0.0025, &shorter, why);
        gsl_test(!(of_shorter < 2e-7 && of_radau / of_shorter > 8),
                 "%s: drift of radau of higher order (%g, %g) %s", joints[i], of_radau, of_shorter,
                 why);
        gsl_test(!(of_alpha < 2e-4), "%s: drift of alpha (%g)", joints[i], of_alpha);
        gsl_test(!(fabs(radau - shorter) < 2e-5 && fabs(alpha - shorter) < 1e-3),
                 "%s: both come to the same place (%.9g, %.9g, %.9g)", joints[i], alpha, radau,
                 shorter);
        const double damped = solve(joints[i], 0.02, SCENE_RADAU, 0.005, &radau, why);
        gsl_test(!(damped < 2e-5 && fabs(radau - shorter) > 1e-5),
                 "%s: damped (drift %g, at %.9g) %s", joints[i], damped, radau, why);
    }
}

extern const element_type element_geometrically_exact;

enum { COMPONENTS = 3, REQUESTED = COMPONENTS + 2 };

#define ENDS_RODS "harness/time/test/rods.yaml"

static const char *const ends_joints[] = {"hinge", "universal", "ball", "slide", "sliding_hinge"};

static void ends_solve(const char *of, scene_scheme by, double step, double found[REQUESTED])
{
    static const char *const name[] = {"C_ux", "C_uy", "C_uz", "held", "drift"};
    answer a;
    scenes_ask(ENDS_RODS, &element_geometrically_exact, 2, &a,
               "of=ends;end=0.4;joint=%s;integrator=%s;step=%g", of, scenes_integrator[by], step);
    for (int i = 0; i < REQUESTED; i++)
        found[i] = answer_of(&a, name[i]);
    gsl_test(a.status != STATUS_OK, "%s, integrator %d: %s", of, by, a.reason);
}

static double distance(const double a[], const double b[])
{
    double square = 0;
    for (int i = 0; i < COMPONENTS; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

static void compare(const char *of, scene_scheme by, const double exact[REQUESTED])
{
    const double step = 0.01;
    double coarse[REQUESTED], fine[REQUESTED];
    ends_solve(of, by, step, coarse);
    ends_solve(of, by, step / 2, fine);
    const double first = distance(coarse, exact), second = distance(fine, exact);
    gsl_test(!(second < 1e-3 && first / second > 2.3), "%s, integrator %d: errors %g and %g m", of,
             by, first, second);
    gsl_test(!(fabs(fine[COMPONENTS] / exact[COMPONENTS] - 1) < 0.02),
             "%s, integrator %d: held by %g and %g N, by %g", of, by, coarse[COMPONENTS],
             fine[COMPONENTS], exact[COMPONENTS]);
    gsl_test(by == SCENE_CONSERVING && !(fabs(fine[COMPONENTS + 1]) < 1e-12),
             "%s: drift of conserving %g J", of, fine[COMPONENTS + 1]);
}

static void ends_tests(void)
{
    for (int i = 0; i < (int)(sizeof ends_joints / sizeof ends_joints[0]); i++) {
        double exact[REQUESTED];
        ends_solve(ends_joints[i], SCENE_RADAU, 0.005, exact);
        compare(ends_joints[i], SCENE_ALPHA, exact);
        compare(ends_joints[i], SCENE_CONSERVING, exact);
    }
}

extern const element_type element_geometrically_exact;

#define DAMPING_RODS "harness/time/test/rods.yaml"

static double lowest(void)
{
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 6, &a, "of=modal");
    return 2 * PI * answer_of(&a, "f");
}

/* The damping ratio of the lowest mode must be 0.03 within 0.3 %. h is the step size as a fraction
 * of the period, and `drift` is the largest energy-balance error relative to the energy. */
static void decay(scene_scheme scheme, double h, double drift)
{
    const double w = lowest(), ratio = 0.03, eta = 2 * ratio / w, period = 2 * PI / w;
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 6, &a,
               "of=damped;integrator=%s;damping=%.17g;step=%.17g;end=%.17g",
               scenes_integrator[scheme], eta, h * period, 10 * period);
    const double found = -log(answer_of(&a, "late") / answer_of(&a, "early")) / (6 * 4 * PI);
    gsl_test(!(fabs(found / ratio - 1) < 3e-3), "scheme %d: decays by %g, expected %g %s", scheme,
             found, ratio, a.reason);
    gsl_test(!(moving_largest(&a, "drift") < drift * moving_largest(&a, "energy")),
             "scheme %d: what decays is lost to damping (%g of %g J)", scheme,
             moving_largest(&a, "drift"), moving_largest(&a, "energy"));
}

static double turn(scene_scheme scheme, double eta, double h)
{
    answer a;
    scenes_ask(DAMPING_RODS, &element_geometrically_exact, 4, &a,
               "of=free;end=2;integrator=%s;damping=%g;step=%g", scenes_integrator[scheme], eta, h);
    const double lost = moving_largest(&a, "lost"), energy = moving_largest(&a, "energy");
    gsl_test(!(lost > 0 && lost < 2e-4 * energy), "scheme %d, damping %g s: lost %g of %g J %s",
             scheme, eta, lost, energy, a.reason);
    gsl_test(!(fabs(answer_of(&a, "Lz") - 1.004) < 2e-4), "angular momentum stays (%.9g)",
             answer_of(&a, "Lz"));
    return moving_largest(&a, "drift") / energy;
}

static void damping_tests(void)
{
    decay(SCENE_ALPHA, 0.01, 0.02);
    decay(SCENE_RADAU, 0.02, 1e-3);
    decay(SCENE_CONSERVING, 0.01, 1e-12);
    for (int stiff = 0; stiff < 2; stiff++) {
        const double eta = stiff ? 10 : 0.01, first = turn(SCENE_ALPHA, eta, 0.01),
                     second = turn(SCENE_ALPHA, eta, 0.005);
        gsl_test(!(second < 2e-5 && fabs(first / second - 4) < 0.6),
                 "damping %g s: drift of alpha of second order (%g, %g)", eta, first, second);
    }
    for (int stiff = 0; stiff < 2; stiff++) {
        const double eta = stiff ? 10 : 0.01, exact = turn(SCENE_CONSERVING, eta, 0.01);
        gsl_test(!(exact < 1e-12), "damping %g s: no drift of the conserving scheme (%g)", eta,
                 exact);
    }
    const double radau = turn(SCENE_RADAU, 0.01, 0.01), shorter = turn(SCENE_RADAU, 0.01, 0.005);
    gsl_test(!(shorter < 5e-9 && radau / shorter > 12), "drift of radau of high order (%g, %g)",
             radau, shorter);
}

int main(void)
{
    start_tests();
    between_nodes_tests();
    linked_tests();
    ends_tests();
    damping_tests();
    return gsl_test_summary();
}
