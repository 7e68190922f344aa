/* Damping in proportion to stiffness: a slow mode decays by eta w/2, what turns as a whole does not
 * decay, and what is lost is accounted for. */
#include <math.h>

#include "elements/math/pi.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

static const double y_axis[3] = {0, 1, 0};

/* Of 1 m along x. */
static void add_rod(scene *s, double damping, int *root, int *tip)
{
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 2e3, .GA = 1e3, .GJ = 3, .EI = 5, .mass = 1.5, .polar = 4e-3, .rotary = 2e-3});
    scene_init(s, "damped rod");
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int profile = scene_add_section(s, &spec);
    *root = scene_add_node(s, 0, 0, 0);
    *tip = scene_add_node(s, 1, 0, 0);
    scene_member_at(s, scene_add_member(s, *root, *tip, profile, y_axis))->damping = damping;
}

/* Angular frequency of the lowest mode. */
static double lowest(void)
{
    scene s;
    answer a;
    int root, tip;
    add_rod(&s, 0, &root, &tip);
    scene_hold_all(&s, root);
    scene_add_quantity(&s, "f", "Hz", scene_add_modal(&s, SCENE_NONE),
                       scene_frequency(0, SCENE_ANY));
    ask_scene(&s, &element_geometrically_exact, NULL, 6, &a);
    scene_free(&s);
    return 2 * PI * answer_of(&a, "f");
}

/* h: of a period */
static void decay(scene_scheme scheme, double h, double drift)
{
    const double w = lowest(), ratio = 0.03, eta = 2 * ratio / w, one[1] = {1};
    scene s;
    answer a;
    int root, tip;
    add_rod(&s, eta, &root, &tip);
    scene_hold_all(&s, root);
    const int load = scene_add_load(&s, SCENE_FORCE, tip, 0, 0.01, 0);
    scene_load_piece(&s, load, 0, "0");
    const double period = 2 * PI / w;
    const int bent = scene_add_static(&s, 1, one, 1),
              motion = moving_add(&s, scheme, h * period, MOVING_STATIONS / 2.0 * period);
    s.analysis[motion].follows = bent;
    for (int i = 0; i < 2; i++)
        scene_set_at(scene_add_quantity(&s, i ? "late" : "early", "J", motion,
                                        scene_balance_of(SCENE_ENERGY)),
                     i ? 8 * period : 2 * period);
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "lost", motion, SCENE_DISSIPATED);
    moving_range(&s, "energy", motion, SCENE_ENERGY);
    ask_scene(&s, &element_geometrically_exact, NULL, 6, &a);
    scene_free(&s);
    const double found = -log(answer_of(&a, "late") / answer_of(&a, "early")) / (6 * 4 * PI);
    gsl_test(!(fabs(found / ratio - 1) < 3e-3), "scheme %d: decays by %g, expected %g %s", scheme,
             found, ratio, a.reason);
    gsl_test(!(moving_largest(&a, "drift") < drift * moving_largest(&a, "energy")),
             "scheme %d: what decays is lost to damping (%g of %g J)", scheme,
             moving_largest(&a, "drift"), moving_largest(&a, "energy"));
}

/* A free rod turns, bent by nothing but its inertia: what is lost stays small. Returns the drift.
 */
static double turn(scene_scheme scheme, double eta, double h)
{
    scene s;
    answer a;
    int root, tip;
    add_rod(&s, eta, &root, &tip);
    const int motion = moving_add(&s, scheme, h, 2);
    s.analysis[motion].of.motion.start = (scene_start){.spin = {0.5, 1, 2}, .velocity = {1, 0, 0}};
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "lost", motion, SCENE_DISSIPATED);
    moving_range(&s, "energy", motion, SCENE_ENERGY);
    scene_add_quantity(&s, "Lz", "1", motion, scene_balance_of(SCENE_LZ));
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    const double lost = moving_largest(&a, "lost"), energy = moving_largest(&a, "energy");
    gsl_test(!(lost > 0 && lost < 2e-4 * energy), "scheme %d, damping %g s: lost %g of %g J %s",
             scheme, eta, lost, energy, a.reason);
    gsl_test(!(fabs(answer_of(&a, "Lz") - 1.004) < 2e-4), "angular momentum stays (%.9g)",
             answer_of(&a, "Lz"));
    return moving_largest(&a, "drift") / energy;
}

int main(void)
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
    return gsl_test_summary();
}
