/* The integrators alpha and radau must agree for every formulation, within 1 % of the static
 * deflection. */
#include <math.h>

#include "elements/math/scalar.h"
#include "harness/analysis/test/hinged.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/accepted.h"

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space;

static const double length = 1;

/* Computes the motion of a cantilever after a small static force is removed at 0 s. If `turn` is 1,
 * the axes x, y, z become y, z, x. If `back` is 1, the member runs from its tip to its root.
 * `early` and `late` are the deflections of the tip at a sixteenth of a period and at two periods,
 * and f is the frequency from a modal analysis. */
static void swing(const element_type *type, scene_scheme by, int turn, int back, answer *a)
{
    const double one[1] = {1}, first = 1.875104 * 1.875104 * sqrt(EI / mass);
    const double period = 2 * PI / first, at[2] = {period / 16, 2 * period};
    double place[3] = {0}, force[3] = {0}, y[3] = {0};
    scene s;
    place[turn] = length;
    force[(turn + 1) % 3] = 0.01;
    y[(turn + 1) % 3] = 1;
    scene_init(&s, "swing");
    const int profile = add_section(&s), root = scene_add_node(&s, 0, 0, 0),
              tip = scene_add_node(&s, place[0], place[1], place[2]);
    scene_add_member(&s, back ? tip : root, back ? root : tip, profile, y);
    scene_hold_all(&s, root);
    const int load = scene_add_load(&s, SCENE_FORCE, tip, force[0], force[1], force[2]);
    scene_load_piece(&s, load, 0, "0");
    const int bent = scene_add_static(&s, 1, one, 1);
    const int motion = scene_add_motion(
        &s, bent, 2, at,
        (scene_motion){.scheme = by, .alpha = scene_alpha_of_radius(0.9), .step = period / 160});
    const int modal = scene_add_modal(&s, SCENE_NONE);
    scene_add_quantity(&s, "static", "m", bent, scene_coordinate(tip, (turn + 1) % 3));
    scene_set_at(
        scene_add_quantity(&s, "early", "m", motion, scene_coordinate(tip, (turn + 1) % 3)), at[0]);
    scene_set_at(scene_add_quantity(&s, "late", "m", motion, scene_coordinate(tip, (turn + 1) % 3)),
                 at[1]);
    scene_set_at(scene_add_quantity(&s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY)),
                 at[1]);
    scene_add_quantity(&s, "f", "Hz", modal, scene_frequency(0, SCENE_ANY));
    ask_scene(&s, type, NULL, 4, a);
    scene_free(&s);
}

static void check_formulation(const element_type *type)
{
    ask_tally tally = {.most_refused = 0};
    answer alpha, radau;
    swing(type, SCENE_ALPHA, 0, 0, &alpha);
    swing(type, SCENE_RADAU, 0, 0, &radau);
    if (ask_count(&tally, &alpha, "alpha") && ask_count(&tally, &radau, "radau")) {
        const double u = answer_of(&radau, "static"), late = answer_of(&radau, "late");
        gsl_test(!(fabs(answer_of(&alpha, "late") - late) < 0.01 * u && late > 0.9 * u),
                 "%s: alpha and radau come to the same place (%g, %g of %g)", type->name,
                 answer_of(&alpha, "late"), late, u);
        gsl_test(!(fabs(answer_of(&radau, "energy") / (0.005 * u) - 1) < 0.02),
                 "%s: its energy is what the force has stored", type->name);
    }
    ask_conclude(&tally, type, "motion_test");
}

static void check_same(scene_scheme by)
{
    answer plain, turned, back;
    swing(&element_geometrically_exact, by, 0, 0, &plain);
    swing(&element_geometrically_exact, by, 1, 0, &turned);
    swing(&element_geometrically_exact, by, 0, 1, &back);
    const double u = answer_of(&plain, "static");
    gsl_test(!(fabs(answer_of(&turned, "late") - answer_of(&plain, "late")) < 1e-9 * u),
             "scheme %d: turned, %.12g of %.12g", by, answer_of(&turned, "late"),
             answer_of(&plain, "late"));
    gsl_test(!(fabs(answer_of(&back, "late") - answer_of(&plain, "late")) < 1e-9 * u),
             "scheme %d: from tip to root, %.12g of %.12g", by, answer_of(&back, "late"),
             answer_of(&plain, "late"));
}

typedef struct motion_rod {
    int profile, root, tip, member;
} motion_rod;

static motion_rod add_rod(scene *s, const char *name)
{
    motion_rod out;
    scene_init(s, name);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_ROTARY_INERTIA);
    out.profile = add_section(s);
    out.root = scene_add_node(s, 0, 0, 0);
    out.tip = scene_add_node(s, length, 0, 0);
    out.member = scene_add_member(s, out.root, out.tip, out.profile, y_axis);
    scene_hold_all(s, out.root);
    return out;
}

static void check_frequency(scene_scheme by, double step, double tolerance)
{
    const double one[1] = {1}, first = sqrt(3 * EI / 50);
    scene s;
    answer a;
    const motion_rod is = add_rod(&s, "one mode");
    const int tip = is.tip;
    scene_node_at(&s, tip)->body = (scene_body){.mass = 50, .inertia = {1e-3, 1e-3, 1e-3}};
    s.section[is.profile].density *= 1e-6;
    const int load = scene_add_load(&s, SCENE_FORCE, tip, 0, 1e-4, 0);
    const int bent = scene_add_static(&s, 1, one, 1), modal = scene_add_modal(&s, SCENE_NONE);
    scene_add_quantity(&s, "f", "Hz", modal, scene_frequency(0, SCENE_ANY));
    scene_add_quantity(&s, "static", "m", bent, scene_coordinate(tip, SCENE_UY));
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    const double u = answer_of(&a, "static"), f = answer_of(&a, "f"), at[1] = {2.25 / f};
    gsl_test(!(fabs(2 * PI * f / first - 1) < 1e-2), "frequency near that of the body");
    s.quantities = 0;
    scene_load_piece(&s, load, 0, "0");
    const int motion = scene_add_motion(
        &s, bent, 1, at,
        (scene_motion){.scheme = by, .alpha = scene_alpha_of_radius(0.9), .step = step / f});
    scene_add_quantity(&s, "u", "m", motion, scene_coordinate(tip, SCENE_UY));
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    gsl_test(!(fabs(answer_of(&a, "u")) < tolerance * u),
             "scheme %d: after two periods and a quarter at %g of %g m %s", by, answer_of(&a, "u"),
             u, a.reason);
}

/* Returns the displacement relative to the base if the base moves as t^3 or, if moves is 0, under
 * an equivalent gravity field. */
static double base(scene_scheme by, int moves)
{
    const double at[1] = {0.7};
    scene s;
    answer a;
    const motion_rod is = add_rod(&s, "base");
    if (moves) {
        const int driver = scene_add_moving_driver(&s, "base");
        scene_drive_piece(&s, driver, 0, "t^3");
        scene_drive(&s, is.root, SCENE_UY, driver);
    } else
        scene_load_piece(&s, scene_add_load(&s, SCENE_GRAVITY, is.member, 0, -1, 0), 0, "6*t");
    const int motion = scene_add_motion(
        &s, SCENE_NONE, 1, at,
        (scene_motion){.scheme = by, .alpha = scene_alpha_of_radius(0.9), .step = 0.01});
    scene_add_quantity(&s, "u", "m", motion, scene_relative_to(is.tip, SCENE_UY, is.root));
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    return answer_of(&a, "u");
}

static void check_base(scene_scheme by, double tolerance)
{
    const double moves = base(by, 1), acts = base(by, 0);
    gsl_test(!(fabs(moves - acts) < tolerance * fabs(acts) && fabs(acts) > 0.01),
             "scheme %d: the base moves or its inertia acts: %.12g, %.12g", by, moves, acts);
}

static double work_at(const char *integrator, const char *stiffening, double *A_x)
{
    char how[64], much[64];
    const char *const with[] = {how, much, "time=3", "step=0.05", "tolerance=0", NULL};
    cell_result result;
    fault f = {""};
    snprintf(how, sizeof how, "integrator=%s", integrator);
    snprintf(much, sizeof much, "stiffening=%s", stiffening);
    cell_request request = cells_of(&case_free_flight_space, "geometrically_exact", 4);
    cells_set(&request, with);
    gsl_test(cell_run(&request, &result, &f) != STATUS_OK, "%s %s: %s", how, much, f.text);
    *A_x = cells_value(&result, "A_x");
    const double each = (double)result.counters.iterations / (double)result.counters.steps;
    gsl_test(result.counters.rejected_steps > 0, "%s %s: no step is rejected", how, much);
    cell_result_free(&result);
    return each;
}

static void check_stiffness(const char *integrator)
{
    double soft, stiff, rigid;
    const double first = work_at(integrator, "1", &soft),
                 second = work_at(integrator, "1e3", &stiff),
                 third = work_at(integrator, "1e6", &rigid);
    gsl_test(!(fabs(second - first) < 1 && fabs(third - first) < 1),
             "%s: %.2f, %.2f, %.2f iterations a step at EA x 1, 1e3, 1e6", integrator, first,
             second, third);
    gsl_test(!(fabs(stiff - rigid) < 1e-3 * fabs(rigid)), "%s: the stiffest move alike (%g, %g)",
             integrator, stiff, rigid);
}

static void check_massless(void)
{
    const double at[1] = {0.1};
    static const double rho[] = {1, 0.9};
    for (int i = 0; i < 2; i++) {
        scene s;
        answer a;
        const int tip = add_rod(&s, "massless").tip;
        scene_load_piece(&s, scene_add_load(&s, SCENE_FORCE, tip, 0, 1, 0), 0, "sin(9*t)");
        const int motion =
            scene_add_motion(&s, SCENE_NONE, 1, at,
                             (scene_motion){.alpha = scene_alpha_of_radius(rho[i]), .step = 0.005});
        scene_add_quantity(&s, "u", "m", motion, scene_coordinate(tip, SCENE_UY));
        ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
        scene_free(&s);
        gsl_test((a.status == STATUS_REFUSED) != (rho[i] == 1), "rho = %g: %s %s", rho[i],
                 status_name(a.status), a.reason);
    }
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++)
        check_formulation(accepted_at(i));
    for (int by = 0; by <= SCENE_RADAU; by++)
        check_same((scene_scheme)by);
    check_frequency(SCENE_ALPHA, 0.005, 5e-3);
    check_frequency(SCENE_RADAU, 0.05, 1e-4);
    check_base(SCENE_ALPHA, 1e-3);
    check_base(SCENE_RADAU, 1e-7);
    check_stiffness("alpha");
    check_stiffness("radau");
    check_massless();
    return gsl_test_summary();
}
