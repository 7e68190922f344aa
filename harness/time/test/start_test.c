/* What a motion starts from, and what it reads: a beam that turns steadily keeps its shape in the
 * motion that follows it; what holds it takes what the steady rotation says; sections carry what is
 * beyond them; a state at rest rings when its load is dropped. */
#include <math.h>

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

/* In time as in the steady rotation, at the nodes and between them. tolerance [m]; force: in parts
 * of the largest */
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
    gsl_test(a.status != STATUS_REFUSED || strstr(a.reason, "turn") == NULL,
             "a drive beside the axes is refused (%s)", a.reason);
}

/* Bent by a force that stays, or that is dropped. */
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

int main(void)
{
    keep_turning(SCENE_ALPHA, 0.02, 2e-3, 5e-3);
    keep_turning(SCENE_RADAU, 0.02, 1e-8, 2e-6);
    refuse_otherwise();
    release("1", 0);
    release("0", 1);
    return gsl_test_summary();
}
