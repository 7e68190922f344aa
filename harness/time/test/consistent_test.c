/* Motions with consistent mass must conserve momenta and energy, with as few iterations as with
 * lumped mass. */
#include <math.h>

#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_beamw_consistent, element_collocation,
    element_geometrically_exact;

static const double y_axis[3] = {0, 1, 0};

static int add_profile(scene *s, double stiffening)
{
    const double EA = 2e3 * stiffening, mass = 1.5, EI = 5;
    const section_spec spec = timed_profile(&(timed_section){.EA = EA,
                                                             .GA = 1e3 * stiffening,
                                                             .GJ = 3,
                                                             .EI = EI,
                                                             .mass = mass,
                                                             .polar = 8e-3,
                                                             .rotary = mass / EA * EI});
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    return scene_add_section(s, &spec);
}

static int add_motion(scene *s, scene_mass mass, scene_scheme scheme, double step, double end)
{
    const int motion = motion_added(s, scheme, step, end);
    s->analysis[motion].of.motion.mass = mass;
    return motion;
}

static void ask_momenta(scene *s, int motion)
{
    static const char *const name[] = {"px", "py", "pz", "Lx", "Ly", "Lz"};
    for (int i = 0; i < 6; i++)
        scene_add_quantity(s, name[i], "1", motion, scene_balance_of(SCENE_PX + i));
}

static void add_free(scene *s, double stiffening, scene_mass mass, scene_scheme scheme, double step,
                     double end)
{
    const scene_start start = {.velocity = {0.3, -0.2, 0.1}, .spin = {1, 2, -3}};
    scene_init(s, "free rod");
    const int profile = add_profile(s, stiffening), p = scene_add_node(s, 0.2, 0, 0),
              q = scene_add_node(s, 1.4, 0.5, 0.3);
    scene_add_member(s, p, q, profile, y_axis);
    const int load = scene_add_load(s, SCENE_MOMENT, q, 2, -3, 4);
    scene_load_piece(s, load, 0.4, "5*t*(0.4 - t)");
    scene_load_piece(s, load, 0, "0");
    const int motion = add_motion(s, mass, scheme, step, end);
    s->analysis[motion].of.motion.start = start;
    ask_momenta(s, motion);
    moving_range(s, "drift", motion, SCENE_DRIFT);
    moving_range(s, "energy", motion, SCENE_ENERGY);
}

typedef struct consistent_flight {
    double momentum, angular, energy;
} consistent_flight;

static void end_of(const element_type *type, scene_scheme scheme, double step, double end,
                   answer *out)
{
    scene s;
    add_free(&s, 1, SCENE_CONSISTENT, scheme, step, end);
    ask_scene(&s, type, NULL, 2, out);
    scene_free(&s);
    gsl_test(out->outcome != ASK_ANSWERED, "%s flies freely (%s)", type->name, out->reason);
}

/* Returns the largest changes of the momenta after 0.5 s, when no load acts, and the energy-balance
 * error relative to the energy. */
static consistent_flight fly(const element_type *type, scene_scheme scheme, double step)
{
    static const double end[] = {0.8, 1.1, 1.4, 2};
    answer early, late;
    consistent_flight out = {0};
    end_of(type, scheme, step, 0.5, &early);
    for (int k = 0; k < 4; k++) {
        double change[6];
        end_of(type, scheme, step, end[k], &late);
        for (int i = 0; i < 6; i++)
            change[i] = late.value[i] - early.value[i];
        out.momentum = fmax(out.momentum, hypot(hypot(change[0], change[1]), change[2]));
        out.angular = fmax(out.angular, hypot(hypot(change[3], change[4]), change[5]));
    }
    out.energy = moving_largest(&late, "drift") / moving_largest(&late, "energy");
    return out;
}

static void check_ratio(const char *what, double coarse, double fine, double least)
{
    gsl_test(!(coarse / fine > least), "%s: %.3e and %.3e with half the step, ratio %.1f above %g",
             what, coarse, fine, coarse / fine, least);
}

static void free_flight(const element_type *type)
{
    const consistent_flight a = fly(type, SCENE_ALPHA, 0.002), b = fly(type, SCENE_ALPHA, 0.001),
                            c = fly(type, SCENE_RADAU, 0.01), d = fly(type, SCENE_RADAU, 0.005);
    check_ratio("momentum by alpha", a.momentum, b.momentum, 3.3);
    check_ratio("angular momentum by alpha", a.angular, b.angular, 3.3);
    check_ratio("energy by alpha", a.energy, b.energy, 3.3);
    gsl_test(!(b.momentum < 2e-4 && b.angular < 5e-4), "momenta by alpha: %.1e, %.1e", b.momentum,
             b.angular);
    check_ratio("angular momentum by radau", c.angular, d.angular, 12);
    gsl_test(!(d.momentum < 1e-6 && d.angular < 1e-6 && d.energy < 1e-5),
             "what is missing by radau: %.1e, %.1e, %.1e", d.momentum, d.angular, d.energy);
}

/* A base with prescribed translations along two axes and rotations about two axes. A rod with a
 * body at its end is attached to the base with an offset, and a second rod is attached to a node of
 * that body. */
static void add_driven(scene *s, int released, double step, double end)
{
    scene_init(s, "driven base");
    const int profile = add_profile(s, 1), base = scene_add_node(s, 0, 0, 0),
              foot = scene_add_attached(s, base, 0.1, 0.2, 0.05),
              tip = scene_add_node(s, 1.1, 0.2, 0.05),
              side = scene_add_attached(s, tip, 1.15, 0.1, 0.05),
              last = scene_add_node(s, 1.15, -0.5, 0.2);
    scene_set_body(
        s, tip,
        (scene_body){.mass = 0.4, .centre = {0.02, 0.03, 0}, .inertia = {4e-3, 5e-3, 6e-3}});
    scene_add_member(s, foot, tip, profile, y_axis);
    scene_add_member(s, side, last, profile, (const double[3]){1, 0, 0});
    for (int c = 0; c < 3 && released; c++)
        scene_release_end(s, 1, 0, SCENE_RX + c);
    if (released)
        scene_release_end(s, 0, 1, SCENE_RZ);
    scene_hold(s, base, SCENE_UX, SCENE_UY);
    scene_hold(s, base, SCENE_RX, SCENE_RY);
    const int turn = scene_add_moving_driver(s, "turn");
    scene_drive_piece(s, turn, 0, "1.5*sin(3*t)^2");
    scene_drive(s, base, SCENE_RZ, turn);
    const int shift = scene_add_moving_driver(s, "shift");
    scene_drive_piece(s, shift, 0, "0.2*sin(4*t)^2");
    scene_drive(s, base, SCENE_UZ, shift);
    const int motion = add_motion(s, SCENE_CONSISTENT, SCENE_RADAU, step, end);
    ask_momenta(s, motion);
    static const char *const name[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int c = 0; c < 6; c++)
        scene_add_quantity(s, name[c], "1", motion, scene_reaction(base, SCENE_UX + c));
    scene_add_quantity(s, "z", "m", motion, scene_coordinate(base, SCENE_UZ));
    for (int c = 0; c < 3; c++) {
        scene_add_quantity(s, (const char *const[]){"N", "Qy", "Qz"}[c], "N", motion,
                           scene_internal_at(0, 0, SCENE_N + c));
        scene_add_quantity(s, (const char *const[]){"N1", "Qy1", "Qz1"}[c], "N", motion,
                           scene_internal_at(1, 1, SCENE_N + c));
    }
    moving_range(s, "drift", motion, SCENE_DRIFT);
    moving_range(s, "energy", motion, SCENE_ENERGY);
}

static void driven(const element_type *type, int released)
{
    const double step = 0.001, end = 0.2;
    answer a[3];
    for (int i = 0; i < 3; i++) {
        scene s;
        add_driven(&s, released, step, end + step * (i - 1));
        ask_scene(&s, type, NULL, 2, &a[i]);
        scene_free(&s);
        gsl_test(a[i].outcome != ASK_ANSWERED, "%s is driven (%s)", type->name, a[i].reason);
    }
    double size = 0;
    a[1].value[9] -=
        answer_of(&a[1], "z") * answer_of(&a[1], "Fy"); /* transforms the moment to the origin */
    a[1].value[10] += answer_of(&a[1], "z") * answer_of(&a[1], "Fx");
    for (int i = 0; i < 6; i++)
        size = fmax(size, fabs(a[1].value[6 + i]));
    for (int i = 0; i < 6; i++) {
        const double rate = (a[2].value[i] - a[0].value[i]) / (2 * step), taken = a[1].value[6 + i];
        gsl_test(!(fabs(rate - taken) < 2e-4 * size),
                 "reaction %d: %.8g, momentum gains %.8g of %g", i, taken, rate, size);
    }
    double held = 0, root = 0, free = 0;
    for (int c = 0; c < 3; c++) {
        held += pow(answer_of(&a[1], (const char *const[]){"Fx", "Fy", "Fz"}[c]), 2);
        root += pow(answer_of(&a[1], (const char *const[]){"N", "Qy", "Qz"}[c]), 2);
        free += pow(answer_of(&a[1], (const char *const[]){"N1", "Qy1", "Qz1"}[c]), 2);
    }
    gsl_test(!(fabs(sqrt(root / held) - 1) < 1e-8), "the root carries %g N, the base %g N",
             sqrt(root), sqrt(held));
    gsl_test(!(sqrt(free) < 1e-8 * sqrt(held)), "a free end carries nothing (%g of %g N)",
             sqrt(free), sqrt(held));
    gsl_test(!(moving_largest(&a[1], "drift") < 1e-4 * moving_largest(&a[1], "energy")),
             "energy is the work of the drives (%g of %g)", moving_largest(&a[1], "drift"),
             moving_largest(&a[1], "energy"));
}

static double iterations_of(double stiffening, scene_mass mass, scene_scheme scheme, double step)
{
    solve_options options;
    solve_result result;
    formulation chosen;
    scene s;
    model *m;
    double mean = NAN;
    fault f = {""};
    formulation_default(&element_beamw_consistent, &chosen);
    add_free(&s, stiffening, mass, scheme, step, 0.5);
    memset(&options, 0, sizeof options);
    memset(&result, 0, sizeof result);
    const model_request wanted = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 4};
    if (model_alloc(&wanted, &m, &f) == STATUS_OK &&
        solve_scene(&s, m, &options, &result, &f) == STATUS_OK)
        mean = (double)result.counters.iterations / (double)result.counters.steps;
    model_free(m);
    result_free(&result);
    scene_free(&s);
    return mean;
}

static void iterations(void)
{
    for (int k = 0; k < 2; k++) {
        const scene_scheme scheme = k == 0 ? SCENE_ALPHA : SCENE_RADAU;
        const double soft = iterations_of(1, SCENE_CONSISTENT, scheme, 0.002),
                     lumped = iterations_of(1, SCENE_LUMPED, scheme, 0.002);
        gsl_test(!(soft < lumped + 0.1), "scheme %d: %g iterations a step, lumped %g", scheme, soft,
                 lumped);
        for (double stiffening = 1e3; stiffening < 1e7; stiffening *= 1e3)
            gsl_test(!(iterations_of(stiffening, SCENE_CONSISTENT, scheme, 0.002) < soft + 1),
                     "scheme %d: %g times as stiff, %g iterations a step, soft %g", scheme,
                     stiffening, iterations_of(stiffening, SCENE_CONSISTENT, scheme, 0.002), soft);
    }
}

static void check_refused(status outcome, const char *reason, const char *words)
{
    gsl_test(outcome != STATUS_REFUSED || strstr(reason, words) == NULL, "refused (%s)", reason);
}

static void refuse(void)
{
    answer a;
    scene s;
    for (int k = 0; k < 2; k++) {
        fault f = {""};
        add_free(&s, 1, SCENE_CONSISTENT, k == 0 ? SCENE_CONSERVING : SCENE_EXPLICIT, 0.01, 0.1);
        const status outcome = scene_validate(&s, &f);
        check_refused(outcome, f.text, "give mass: lumped");
        scene_free(&s);
    }
    add_free(&s, 1, SCENE_CONSISTENT, SCENE_ALPHA, 0.01, 0.1);
    ask_scene(&s, &element_geometrically_exact, NULL, 2, &a);
    scene_free(&s);
    check_refused(a.status, a.reason, "supports only lumped mass");
}

static void consistent_tests(void)
{
    const element_type *const type[] = {&element_beamw_consistent, &element_collocation};
    free_flight(type[0]);
    for (int i = 0; i < 2; i++)
        for (int released = 0; released < 2; released++)
            driven(type[i], released);
    iterations();
    refuse();
}

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space, case_spin_up, case_elbow, case_pendulum;

static double drift(const case_type *type, scene_scheme scheme, double step, double end)
{
    scene s;
    answer a;
    moving_case(type, "", &s);
    const int motion = motion_added(&s, scheme, step, end);
    moving_range(&s, "drift", motion, SCENE_DRIFT);
    moving_range(&s, "energy", motion, SCENE_ENERGY);
    moving_range(&s, "work", motion, SCENE_WORK);
    ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
    scene_free(&s);
    const double energy = moving_largest(&a, "energy"), work = moving_largest(&a, "work");
    gsl_test(!(fabs(work / energy - 1) < 0.01), "%s: all energy is work (%g of %g J)%s", type->name,
             work, energy, a.reason);
    return moving_largest(&a, "drift") / energy;
}

static const struct {
    const case_type *type;
    double step, end, conserving;
} drift_motion[] = {{&case_free_flight_space, 0.05, 6, 1e-13},
                    {&case_spin_up, 0.05, 4, 1e-13},
                    {&case_elbow, 0.125, 5, 1e-13},
                    {&case_pendulum, 0.005, 0.5, 1e-13}};

static void drift_tests(void)
{
    for (int i = 0; i < (int)(sizeof drift_motion / sizeof drift_motion[0]); i++) {
        const double h = drift_motion[i].step, end = drift_motion[i].end;
        const char *name = drift_motion[i].type->name;
        const double first = drift(drift_motion[i].type, SCENE_ALPHA, h / 2, end),
                     second = drift(drift_motion[i].type, SCENE_ALPHA, h / 4, end);
        gsl_test(!(second < 1e-4 && fabs(first / second - 4) < 0.4),
                 "%s: drift of alpha of second order (%g, %g)", name, first, second);
        const double radau = drift(drift_motion[i].type, SCENE_RADAU, h / 2, end),
                     shorter = drift(drift_motion[i].type, SCENE_RADAU, h / 4, end);
        gsl_test(!(shorter < 1e-8 && radau / shorter > 5),
                 "%s: drift of radau of higher order (%g, %g)", name, radau, shorter);
        for (int k = 0; k < 2; k++) {
            const double exact = drift(drift_motion[i].type, SCENE_CONSERVING, h / (1 << k), end);
            gsl_test(!(exact < drift_motion[i].conserving),
                     "%s: no drift of the conserving scheme (%g)", name, exact);
        }
    }
}

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space, case_free_flight_plane, case_release,
    case_leaf_guide, case_rigid_body, case_pendulum;

/* Impulse of the force along x. The force is a triangle, which rises at 8 N/s for 2.5 s and falls
 * at the same rate, or a step of 8 N for 2.5 s. */
static double impulse_of_triangle(double t)
{
    const double rise = fmin(t, 2.5), fall = fmin(fmax(t - 2.5, 0), 2.5);
    return 4 * rise * rise + 20 * fall - 4 * fall * fall;
}

static double ramp_of_triangle(double t)
{
    return t < 5 ? 8 : 0;
}

static double impulse_of_step(double t)
{
    return 8 * fmin(t, 2.5);
}

static double no_ramp(double t)
{
    (void)t;
    return 0;
}

static void momentum(const case_type *type, const char *parameters, double (*impulse)(double),
                     double (*ramp)(double))
{
    static const scene_scheme scheme[] = {SCENE_ALPHA, SCENE_CONSERVING, SCENE_RADAU};
    static const double end[] = {0.7, 2.5, 3.1, 6};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++) {
            scene s;
            answer a;
            moving_case(type, parameters, &s);
            const double h = 0.05;
            const int motion = motion_added(&s, scheme[i], h, end[k]);
            for (int j = 0; j < 3; j++)
                scene_add_quantity(&s, (const char *const[]){"px", "py", "pz"}[j], "kg m/s", motion,
                                   scene_balance_of(SCENE_PX + j));
            ask_scene(&s, &element_geometrically_exact, NULL, 4, &a);
            scene_free(&s);
            const double late = scheme[i] == SCENE_ALPHA ? h * h / 100 * ramp(end[k]) : 0,
                         expected = impulse(end[k]), along = answer_of(&a, "px") - expected,
                         across = hypot(answer_of(&a, "py"), answer_of(&a, "pz"));
            gsl_test(!(fabs(along) < late + 1e-11 * expected && across < 1e-11 * expected),
                     "%s %s, scheme %d: momentum at %g s is the impulse %g (%g, %g)%s", type->name,
                     parameters, scheme[i], end[k], expected, along, across, a.reason);
        }
}

static void refused(const case_type *type, const char *parameters, const char *word)
{
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    parameters_default(type, value);
    const status outcome = parameters_parse(type, parameters, value, NULL, &f);
    gsl_test(outcome != STATUS_REFUSED || strstr(f.text, word) == NULL, "%s %s: refused (%s)",
             type->name, parameters, f.text);
}

static void flight_tests(void)
{
    momentum(&case_free_flight_space, "", impulse_of_triangle, ramp_of_triangle);
    momentum(&case_free_flight_plane, "load=step", impulse_of_step, no_ramp);
    refused(&case_free_flight_plane, "load=jump", "load");
    refused(&case_free_flight_plane, "integrator=euler", "integrator");
    refused(&case_free_flight_space, "stiffening=0.5", "stiffening");
    refused(&case_pendulum, "step=0", "step");
    refused(&case_rigid_body, "time=-1", "time");
    refused(&case_leaf_guide, "amplitude=0", "amplitude");
    refused(&case_release, "tolerance=1", "tolerance");
}

extern const case_type case_pendulum;
extern const element_type element_collocation;

enum { ELEMENTS = 4 };

typedef struct swing {
    double iterations;
    long steps;
} swing;

static swing take(const formulation *with, scene_scheme by, double stiffening, double step,
                  int steps, int elements)
{
    char parameters[64];
    solve_options options;
    solve_result result;
    scene s;
    model *m;
    swing out = {NAN, 0};
    fault f = {""};
    snprintf(parameters, sizeof parameters, "stiffening=%g", stiffening);
    moving_case(&case_pendulum, parameters, &s);
    motion_added(&s, by, step, steps * step);
    memset(&options, 0, sizeof options);
    memset(&result, 0, sizeof result);
    const model_request wanted = {
        .scene = &s, .type = with->type, .options = with->option, .elements = elements};
    if (model_alloc(&wanted, &m, &f) == STATUS_OK) {
        const status outcome = solve_scene(&s, m, &options, &result, &f);
        gsl_test(outcome != STATUS_OK, "%s, EA x %g: %s", with->type->name, stiffening, f.text);
        out.steps = result.counters.steps;
        out.iterations = (double)result.counters.iterations / (double)out.steps;
    }
    model_free(m);
    result_free(&result);
    scene_free(&s);
    return out;
}

static void compare(const element_type *type, scene_scheme by, double step, double more,
                    double times)
{
    formulation with;
    formulation_default(type, &with);
    const swing soft = take(&with, by, 1, step, MOVING_STATIONS, ELEMENTS);
    for (double stiffening = 1e3; isfinite(soft.iterations) && stiffening < 1e7;
         stiffening *= 1e3) {
        const swing stiff = take(&with, by, stiffening, step, MOVING_STATIONS, ELEMENTS);
        gsl_test(stiff.steps != soft.steps, "%s, EA x %g: %ld steps, soft %ld", type->name,
                 stiffening, stiff.steps, soft.steps);
        gsl_test(!(stiff.iterations < times * soft.iterations + more),
                 "%s, EA x %g: %.2f iterations a step, soft %.2f", type->name, stiffening,
                 stiff.iterations, soft.iterations);
    }
}

static void one_element(void)
{
    const int steps = 60;
    formulation with;
    formulation_default(&element_collocation, &with);
    const swing stiff = take(&with, SCENE_CONSERVING, 1e6, 0.002, steps, 1);
    gsl_test(stiff.steps != steps, "one element, EA x 1e6: %ld steps", stiff.steps);
    gsl_test(!(stiff.iterations < 8), "one element, EA x 1e6: %g iterations a step",
             stiff.iterations);
}

static void stiff_tests(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        compare(registry_formulations[i], SCENE_ALPHA, 0.005, 1, 1);
        compare(registry_formulations[i], SCENE_RADAU, 0.02, 1, 1);
        compare(registry_formulations[i], SCENE_CONSERVING, 0.005, 0, 1.5);
    }
    one_element();
}

int main(void)
{
    consistent_tests();
    drift_tests();
    flight_tests();
    stiff_tests();
    return gsl_test_summary();
}
