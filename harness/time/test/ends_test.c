/* Ends of members that are released from their nodes have their inertia where they are, with every
 * integrator: all come to one motion and one reaction, with errors of second order or less. */
#include <math.h>

#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

enum { COMPONENTS = 3, ASKED = COMPONENTS + 2 };

typedef struct joint {
    const char *name;
    int count, component[3];
} joint;

static const joint joints[] = {{"hinge", 1, {SCENE_RY}},
                               {"universal", 2, {SCENE_RY, SCENE_RZ}},
                               {"ball", 3, {SCENE_RX, SCENE_RY, SCENE_RZ}},
                               {"slide", 1, {SCENE_UX}},
                               {"sliding hinge", 2, {SCENE_RZ, SCENE_UX}}};

/* Places of the tip, reaction of the node that the other rod is released from, drift. */
static void solve(const joint *of, scene_scheme by, double step, double found[ASKED])
{
    static const double y_axis[] = {0, 1, 0};
    static const char *const name[] = {"x", "y", "z", "held", "drift"};
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 100, .GA = 60, .GJ = 12, .EI = 10, .mass = 1, .polar = 0.6, .rotary = 0.3});
    scene s;
    answer a;
    scene_init(&s, of->name);
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int profile = scene_add_section(&s, &spec), A = scene_add_node(&s, 0, 0, 0),
              B = scene_add_node(&s, 1, 0.2, 0.1), C = scene_add_node(&s, 1.6, 0.9, 0.4);
    scene_add_member(&s, A, B, profile, y_axis);
    const int member = scene_add_member(&s, B, C, profile, y_axis);
    scene_hold(&s, B, SCENE_UZ, SCENE_UZ);
    for (int i = 0; i < of->count; i++)
        scene_release_end(&s, member, 0, of->component[i]);
    const int pull = scene_add_load(&s, SCENE_FORCE, C, 1, 2, -1.5);
    scene_load_piece(&s, pull, 0, "2*sin(3*t)");
    const int motion = moving_add(&s, by, step, 0.4);
    s.analysis[motion].of.motion.start = (scene_start){.spin = {0, 0, 1.1}};
    for (int i = 0; i < COMPONENTS; i++)
        scene_add_quantity(&s, name[i], "m", motion, scene_coordinate(C, SCENE_UX + i));
    scene_add_quantity(&s, name[COMPONENTS], "N", motion, scene_reaction(B, SCENE_UZ));
    scene_add_quantity(&s, name[COMPONENTS + 1], "J", motion, scene_balance_of(SCENE_DRIFT));
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &a);
    scene_free(&s);
    for (int i = 0; i < ASKED; i++)
        found[i] = answer_of(&a, name[i]);
    gsl_test(a.status != STATUS_OK, "%s, integrator %d: %s", of->name, by, a.reason);
}

static double distance(const double a[], const double b[])
{
    double square = 0;
    for (int i = 0; i < COMPONENTS; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

static void compare(const joint *of, scene_scheme by, const double exact[ASKED])
{
    const double step = 0.01;
    double coarse[ASKED], fine[ASKED];
    solve(of, by, step, coarse);
    solve(of, by, step / 2, fine);
    const double first = distance(coarse, exact), second = distance(fine, exact);
    gsl_test(!(second < 1e-3 && first / second > 2.3), "%s, integrator %d: errors %g and %g m",
             of->name, by, first, second);
    gsl_test(!(fabs(fine[COMPONENTS] / exact[COMPONENTS] - 1) < 0.02),
             "%s, integrator %d: held by %g and %g N, by %g", of->name, by, coarse[COMPONENTS],
             fine[COMPONENTS], exact[COMPONENTS]);
    gsl_test(by == SCENE_CONSERVING && !(fabs(fine[COMPONENTS + 1]) < 1e-12),
             "%s: drift of conserving %g J", of->name, fine[COMPONENTS + 1]);
}

int main(void)
{
    for (int i = 0; i < (int)(sizeof joints / sizeof joints[0]); i++) {
        double exact[ASKED];
        solve(&joints[i], SCENE_RADAU, 0.005, exact);
        compare(&joints[i], SCENE_ALPHA, exact);
        compare(&joints[i], SCENE_CONSERVING, exact);
    }
    return gsl_test_summary();
}
