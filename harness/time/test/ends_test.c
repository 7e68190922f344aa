/* Ends of members that are released from their nodes have their inertia where they are, with every
 * integrator: all come to one motion and one reaction, with errors of second order or less. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

enum { COMPONENTS = 3, ASKED = COMPONENTS + 2 };

#define ENDS_RODS "harness/time/test/rods.yaml"

static const char *const ends_joints[] = {"hinge", "universal", "ball", "slide", "sliding_hinge"};

/* Places of the tip, reaction of the node that the other rod is released from, drift. */
static void ends_solve(const char *of, scene_scheme by, double step, double found[ASKED])
{
    static const char *const name[] = {"C_ux", "C_uy", "C_uz", "held", "drift"};
    answer a;
    scenes_ask(ENDS_RODS, &element_geometrically_exact, 2, &a,
               "of=ends;end=0.4;joint=%s;integrator=%s;step=%g", of, scenes_integrator[by], step);
    for (int i = 0; i < ASKED; i++)
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

static void compare(const char *of, scene_scheme by, const double exact[ASKED])
{
    const double step = 0.01;
    double coarse[ASKED], fine[ASKED];
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

int main(void)
{
    for (int i = 0; i < (int)(sizeof ends_joints / sizeof ends_joints[0]); i++) {
        double exact[ASKED];
        ends_solve(ends_joints[i], SCENE_RADAU, 0.005, exact);
        compare(ends_joints[i], SCENE_ALPHA, exact);
        compare(ends_joints[i], SCENE_CONSERVING, exact);
    }
    return gsl_test_summary();
}
