/* What a motion starts from, and what it reads: a beam that turns steadily keeps its shape in the
 * motion that follows it; what holds it takes what the steady rotation says; sections carry what is
 * beyond them; a state at rest rings when its load is dropped. */
#include <math.h>

#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact;

/* Between nodes: in a motion as in the steady rotation. */
enum { INSIDE = 3 };
static const scene_resultant inside[INSIDE] = {SCENE_N, SCENE_QZ, SCENE_MY};
static const char *const steady_inside[INSIDE] = {"N_in_steady", "Qz_in_steady", "My_in_steady"},
                         *const moving_inside[INSIDE] = {"N_in", "Qz_in", "My_in"};

static const double length = 2, omega = 3, end = 0.5, y_axis[3] = {0, 1, 0};

static int add_beam(scene *s, int *tip)
{
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 2e3, .GA = 1e3, .GJ = 3, .EI = 5, .mass = 1.5, .polar = 4e-3, .rotary = 2e-3});
    scene_init(s, "turning beam");
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0.5, 0, 0);
    *tip = scene_add_node(s, 0.5 + length, 0, 0.3);
    scene_add_member(s, root, *tip, profile, y_axis);
    return root;
}

static scene_quantity *ask_for(scene *s, const char *name, int analysis, scene_extract what)
{
    return scene_add_quantity(s, name, "1", analysis, what);
}

/* The root turns about an axis through the origin: a body there carries it. how: its angle in time.
 * Returns the last of two analyses. */
static int add_turning(scene *s, scene_scheme scheme, double step, const char *how, int *hub,
                       int *tip)
{
    const double none[2] = {0, 0}, one[2] = {0, 1}, at[1] = {1};
    const int root = add_beam(s, tip);
    *hub = scene_add_node(s, 0, 0, 0);
    scene_node_at(s, root)->attached = *hub;
    scene_hold(s, *hub, SCENE_UX, SCENE_RY);
    const int turn = scene_add_driver(s, "turn", 2, one, none);
    scene_drive_piece(s, turn, 0, how);
    scene_drive(s, *hub, SCENE_RZ, turn);
    const int steady =
        scene_add_rotation(s, 1, at, 4, 0, (scene_rotating_frame){.omega = {0, 0, omega}});
    const int motion = moving_add(s, scheme, step, end);
    s->analysis[motion].follows = steady;
    return motion;
}

static void check(const answer *a, const char *name, double expected, double tolerance)
{
    const double found = answer_of(a, name);
    gsl_test(!(fabs(found - expected) <= tolerance), "%s: %.12g, expected %.12g", name, found,
             expected);
}

/* tolerance [m]; force: in parts of the largest */
static void keep_turning(scene_scheme scheme, double step, double tolerance, double force)
{
    static const char *const name[] = {"ux", "uy", "uz"}, *const moving[] = {"x", "y", "z"};
    scene s;
    answer a;
    int tip, hub;
    const int motion = add_turning(&s, scheme, step, "3*t", &hub, &tip), steady = motion - 1;
    for (int i = 0; i < 3; i++) {
        ask_for(&s, name[i], steady, scene_coordinate(tip, SCENE_UX + i));
        ask_for(&s, moving[i], motion, scene_relative_to(tip, SCENE_UX + i, hub));
    }
    ask_for(&s, "N_steady", steady, scene_internal_at(0, 0, SCENE_N));
    ask_for(&s, "N", motion, scene_internal_at(0, 0, SCENE_N));
    ask_for(&s, "N_tip", motion, scene_internal_at(0, 1, SCENE_N));
    ask_for(&s, "R_steady", steady, scene_reaction(hub, SCENE_UX));
    ask_for(&s, "R_x", motion, scene_reaction(hub, SCENE_UX));
    ask_for(&s, "R_y", motion, scene_reaction(hub, SCENE_UY));
    ask_for(&s, "R_z", motion, scene_reaction(hub, SCENE_RZ));
    for (int i = 0; i < INSIDE; i++) {
        ask_for(&s, steady_inside[i], steady, scene_internal_at(0, 0.4, inside[i]));
        ask_for(&s, moving_inside[i], motion, scene_internal_at(0, 0.4, inside[i]));
    }
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    for (int i = 0; i < 3; i++)
        check(&a, moving[i], answer_of(&a, name[i]), tolerance);
    check(&a, "N", answer_of(&a, "N_steady"), force * answer_of(&a, "N_steady"));
    check(&a, "N_tip", 0, 1e-10);
    const double R = answer_of(&a, "R_steady");
    check(&a, "R_x", R * cos(omega * end), force * fabs(R));
    check(&a, "R_y", R * sin(omega * end), force * fabs(R));
    check(&a, "R_z", 0, force * fabs(R));
    for (int i = 0; i < INSIDE; i++)
        check(&a, moving_inside[i], answer_of(&a, steady_inside[i]), force * fabs(R));
}

static void refuse_otherwise(void)
{
    scene s;
    answer a;
    int tip, hub;
    const int motion = add_turning(&s, SCENE_ALPHA, 0.02, "2.9*t", &hub, &tip);
    ask_for(&s, "x", motion, scene_coordinate(tip, SCENE_UX));
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &a);
    scene_free(&s);
    gsl_test(a.status != STATUS_REFUSED || strstr(a.reason, "turn") == NULL,
             "a drive beside the axes is refused (%s)", a.reason);
}

/* Bent by a force that stays, or that is dropped. */
static void release(const char *then, int rings)
{
    const double one[1] = {1};
    scene s;
    answer a;
    int tip;
    const int root = add_beam(&s, &tip);
    scene_hold_all(&s, root);
    const int load = scene_add_load(&s, SCENE_FORCE, tip, 0, 2, 1);
    scene_load_piece(&s, load, 0, then);
    const int bent = scene_add_static(&s, 1, one, 1), motion = moving_add(&s, SCENE_RADAU, 0.02, 1);
    s.analysis[motion].follows = bent;
    moving_range(&s, "kinetic", motion, SCENE_KINETIC);
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "work", motion, SCENE_WORK);
    moving_range(&s, "strain", motion, SCENE_STRAIN);
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
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
