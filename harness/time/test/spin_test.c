/* Steady spin of a rod that is stretched by 2 %, bent by 0.8 rad and twisted by 0.6 rad between
 * prescribed ends. The shape that is in equilibrium at the angular velocity w = (2/h) tan(turn/2)
 * must remain constant. This holds for every formulation, about any axis, up to 3 rad per step. */
#include <stdio.h>

#include "cases/scene/scene.h"
#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/model/test/turned_end.h"
#include "harness/newton/newton.h"
#include "harness/time/test/flight.h"
#include "harness/time/time_impl.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/scenes.h"

enum { STEPS = 30, SPIN_STAGES = 4, ITERATIONS = 40 };

static const double rate = 3, stretch = 0.02, first[3] = {0.5, 0.2, 0.1}, along[3] = {1, 0, 0};

static struct {
    double axis[3], turn; /* unit vector, and rotation per step [rad] */
    double h;             /* step size [s]; the angular velocity is (2/h) tan(turn/2) */
} present;

/* Prescribes the motion of a node. It rotates about the origin, starting from r + d, where r is the
 * undeformed position. */
static void drive(scene *s, int node, const int vector[3], const double r[3], const double d[3])
{
    const double *n = present.axis, spin = present.turn / present.h;
    double at[3], crossed[3];
    scene_node_at(s, node)->rotation = SCENE_ROTATION_VECTOR;
    for (int i = 0; i < 3; i++)
        at[i] = r[i] + d[i];
    vec3_cross(n, at, crossed);
    for (int i = 0; i < 3; i++) {
        char name[] = {'u', (char)('x' + i), (char)('0' + node), 0}, text[256];
        const double stays = n[i] * vec3_dot(n, at);
        const int driver = scene_add_moving_driver(s, name);
        snprintf(text, sizeof text, "%.17g + %.17g*cos(%.17g*t) + %.17g*sin(%.17g*t)", stays - r[i],
                 at[i] - stays, spin, crossed[i], spin);
        scene_drive_piece(s, driver, 0, text);
        scene_drive(s, node, i, driver);
        scene_node_at(s, node)->angle[i] = vector[i];
    }
}

static status build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0}, end = 1e3, none[3] = {0, 0, 0};
    section_spec spec = section_spec_rectangle(2e6, 0.8e6, 0.1, 0.05);
    double moved[3], last[3];
    int vector[3];
    (void)value, (void)f;
    spec.density = 1000;
    for (int i = 0; i < 3; i++) {
        char name[] = {'t', (char)('x' + i), 0}, text[64];
        vector[i] = scene_add_moving_driver(s, name);
        snprintf(text, sizeof text, "%.17g*t", present.turn / present.h * present.axis[i]);
        scene_drive_piece(s, vector[i], 0, text);
        last[i] = first[i] + along[i];
        moved[i] = stretch * along[i];
    }
    const int profile = scene_add_section(s, &spec),
              A = scene_add_node(s, first[0], first[1], first[2]),
              B = scene_add_node(s, last[0], last[1], last[2]);
    scene_add_member(s, A, B, profile, y_axis);
    drive(s, A, vector, first, none);
    drive(s, B, vector, last, moved);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end,
                     (scene_motion){.scheme = SCENE_CONSERVING,
                                    .alpha = scene_alpha_of_radius(0.9),
                                    .step = present.h});
    return STATUS_OK;
}

static void turn_rates(const flight *f)
{
    const model *m = f->m;
    double w[3];
    for (int i = 0; i < 3; i++)
        w[i] = rate * present.axis[i];
    for (int i = 0; i < model_first_release(m); i++) {
        const int *at = model_vertex(m, i)->coordinate;
        double r[3], v[3], a[3], R[9], W[3];
        if (model_vertex(m, i)->body != i)
            continue;
        kinematics_position(m, f->now.state, i, r);
        vec3_cross(w, r, v);
        vec3_cross(w, v, a);
        rotation_matrix(&f->now.state->q[4 * (size_t)i], R);
        mat3_transpose_mul_vec(R, w, W);
        for (int k = 0; k < 3; k++) {
            if (at[k] != NONE) {
                f->now.v[at[k]] = v[k];
                f->now.a[at[k]] = a[k];
            }
            if (at[SCENE_RX + k] != NONE) {
                f->now.v[at[SCENE_RX + k]] = W[k];
                f->now.a[at[SCENE_RX + k]] = 0;
            }
        }
    }
}

/* Finds the state in equilibrium with the inertia forces of the steady rotation. Returns the
 * largest component of the last correction. */
static double relax_flight(flight *f)
{
    model *m = f->m;
    const sparse *pattern;
    sparse K;
    matrix_factor *of = NULL;
    double correction = INFINITY;
    const size_t all = (size_t)model_all_coordinates(m) + 1;
    double *residual = calloc(all, sizeof *residual);
    memset(&K, 0, sizeof K);
    if (residual == NULL ||
        assemble_pattern(m, f->run.patterns, 0, &pattern, &f->why) != STATUS_OK ||
        sparse_alloc_like(pattern, &K, &f->why) != STATUS_OK ||
        factor_alloc(pattern, &of, &f->why) != STATUS_OK || of == NULL) {
        free(residual);
        sparse_free_values(&K);
        return INFINITY;
    }
    for (int i = 0; i < ITERATIONS && correction > 1e-15; i++) {
        model_linearisation lin = {.path = 0, .K = &K, .residual = residual};
        turn_rates(f);
        if (linearise_state(&f->c.eq, &f->run.memory, f->now.state, &lin, &f->why) != STATUS_OK)
            break;
        inertia_subtract(m, &f->masses, f->now.state, f->now.v, f->now.a, residual);
        memset(residual + model_unknowns(m), 0, (size_t)model_driven(m) * sizeof *residual);
        if (factor_numeric(of, &K, &f->why) != STATUS_OK)
            break;
        factor_solve(of, residual);
        correction = advance_state(&f->c.eq, &f->run.memory, f->now.state, residual, 0, NULL);
    }
    turn_rates(f);
    free(residual);
    factor_free(of);
    sparse_free_values(&K);
    return correction;
}

static void pull(flight *f)
{
    model *m = f->m;
    double *dx = calloc((size_t)model_all_coordinates(m) + 1, sizeof *dx);
    for (int d = 0; d < model_scene(m)->drivers; d++)
        if (model_driver_coordinate(m, d) >= model_unknowns(m))
            dx[model_driver_coordinate(m, d)] =
                loads_driver_value(&f->c.eq, &model_scene(m)->driver[d], 0) -
                f->now.state->driver[d];
    increment_apply(m, f->now.state, dx, 0, f->next.state);
    motion_state_copy(m, &f->next, &f->now);
    free(dx);
}

static double spin_change(flight *f, const double begin[], int *iterations)
{
    const int count = model_elements(f->m) * model_strains(f->m);
    double largest = 0, change = 0;
    for (int i = 0; i < STEPS; i++) {
        if (flight_step(f, present.h) != STATUS_OK)
            return NAN;
        for (int k = 0; k < count; k++)
            change = fmax(change, fabs(f->now.state->e[k] - begin[k]));
    }
    for (int k = 0; k < count; k++)
        largest = fmax(largest, fabs(begin[k]));
    *iterations = f->most;
    return change / largest;
}

static void check(const char *name, const double axis[3], double turn)
{
    const double bend = 0.8, twist = 0.6, size = vec3_norm(axis);
    mesh_triad own[ELEMENT_MAX_NODES];
    flight f;
    int iterations = 0;
    double correction = INFINITY;
    present.turn = turn;
    present.h = 2 * tan(turn / 2) / rate;
    for (int i = 0; i < 3; i++)
        present.axis[i] = axis[i] / size;
    if (flight_ready(&f, build, name, 3) != STATUS_OK) {
        gsl_test(1, "%s: %s", name, f.why.text);
        flight_end(&f);
        return;
    }
    mesh_triad *before = model_element(f.m, model_elements(f.m) - 1)->triad;
    pull(&f);
    for (int part_of = 1; part_of <= SPIN_STAGES; part_of++) {
        const double part = (double)part_of / SPIN_STAGES,
                     vector[3] = {twist * part, 0, bend * part};
        turned_end(f.m, vector, own, before);
        correction = relax_flight(&f);
    }
    double *begin = malloc(sizeof *begin * (size_t)(model_elements(f.m) * model_strains(f.m)));
    memcpy(begin, f.now.state->e,
           sizeof *begin * (size_t)(model_elements(f.m) * model_strains(f.m)));
    const double change = spin_change(&f, begin, &iterations);
    gsl_test(!(correction < 1e-12), "%s, %g rad: in balance (%.1e) %s", name, turn, correction,
             f.why.text);
    gsl_test(!(change < 1e-12), "%s, %g rad a step about %g %g %g: strains change by %.1e %s", name,
             turn, axis[0], axis[1], axis[2], change, f.why.text);
    gsl_test(iterations > 4, "%s, %g rad a step: %d iterations at most", name, turn, iterations);
    free(begin);
    flight_end(&f);
}

static void spin_tests(void)
{
    static const double axes[][3] = {{1, 0, 0}, {0, 1, 0}, {0.48, 0.6, 0.64}},
                        turns[] = {0.1, 0.3, 1, 2, 3};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int a = 0; a < 3; a++)
            for (int t = 0; t < 5; t++)
                check(registry_formulations[i]->name, axes[a], turns[t]);
}

static struct {
    double stiffening,
        turn[4]; /* factor of the stiffness, and quaternion of the axes of the scene */
} how = {1, {1, 0, 0, 0}};

static const double flights_h = 0.05,
                    thrown = 5; /* step size, and time at which the loads end [s] */

static status flights_build(const double value[], scene *s, fault *f)
{
    static const double end = 50, y[3] = {0, 1, 0}, at[2][3] = {{0, 0, 8}, {6, 0, 0}},
                        force[3] = {0.1, 0, 0}, moment[3] = {0, 1, 0.5};
    const double k = how.stiffening;
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 1e4 * k, .GA = 1e4 * k, .GJ = 500, .EI = 500, .mass = 1, .polar = 20, .rotary = 10});
    const int profile = scene_add_section(s, &spec);
    double v[5][3];
    (void)value, (void)f;
    rotation_apply(how.turn, y, v[0]);
    rotation_apply(how.turn, at[0], v[1]);
    rotation_apply(how.turn, at[1], v[2]);
    rotation_apply(how.turn, force, v[3]);
    rotation_apply(how.turn, moment, v[4]);
    const int A = scene_add_node(s, v[1][0], v[1][1], v[1][2]),
              B = scene_add_node(s, v[2][0], v[2][1], v[2][2]);
    scene_add_member(s, A, B, profile, v[0]);
    const int loads[] = {scene_add_load(s, SCENE_FORCE, B, v[3][0], v[3][1], v[3][2]),
                         scene_add_load(s, SCENE_MOMENT, B, v[4][0], v[4][1], v[4][2])};
    for (int i = 0; i < 2; i++) {
        scene_load_piece(s, loads[i], 2.5, "80*t");
        scene_load_piece(s, loads[i], thrown, "400 - 80*t");
        scene_load_piece(s, loads[i], 0, "0");
    }
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end,
                     (scene_motion){.scheme = SCENE_CONSERVING,
                                    .alpha = scene_alpha_of_radius(0.9),
                                    .step = flights_h});
    return STATUS_OK;
}

static status reversed(const double value[], scene *s, fault *f)
{
    static const scene_edit edit = {SCENE_EDIT_REVERSE, 0};
    TRY(flights_build(value, s, f));
    return scene_edit_apply(s, &edit, f);
}

static void fly(flight *f, int steps, double step)
{
    status outcome = STATUS_OK;
    for (int i = 0; i < steps && outcome == STATUS_OK; i++)
        outcome = flight_step(f, step);
    gsl_test(outcome != STATUS_OK, "EA x %g, steps of %g s: %s", how.stiffening, step, f->why.text);
}

static void ends_of(const flight *f, double r[6])
{
    double back[4];
    rotation_conjugate(how.turn, back);
    for (int i = 0; i < 2; i++) {
        kinematics_position(f->m, f->now.state, i, r + 3 * i);
        rotation_apply(back, r + 3 * i, r + 3 * i);
    }
}

static double apart(const double a[6], const double b[6])
{
    double largest = 0;
    for (int i = 0; i < 6; i++)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

static double long_flight(const char *with)
{
    flight f;
    double drift = 0, angular = 0, momentum = 0;
    gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
    fly(&f, (int)lround(thrown / flights_h), flights_h);
    const double energy = flight_energy(&f);
    const inertia_balance before = flight_inertia(&f);
    for (int i = 0; i < 80; i++) {
        fly(&f, 10, flights_h);
        const inertia_balance now = flight_inertia(&f);
        drift = fmax(drift, fabs(flight_energy(&f) / energy - 1));
        for (int k = 0; k < 3; k++) {
            angular = fmax(angular, fabs(now.angular[k] - before.angular[k]));
            momentum = fmax(momentum, fabs(now.momentum[k] - before.momentum[k]));
        }
    }
    angular /= vec3_norm(before.angular);
    momentum /= vec3_norm(before.momentum);
    const double iterations = (double)f.sum / f.steps;
    gsl_test(!(drift < 1e-12), "%s, EA x %g: energy changes by %.1e in 40 s", with, how.stiffening,
             drift);
    gsl_test(!(angular < 1e-12 && momentum < 1e-12), "%s, EA x %g: momenta change by %.1e, %.1e",
             with, how.stiffening, angular, momentum);
    gsl_test(!(iterations < 5.5), "%s, EA x %g: %.2f iterations a step", with, how.stiffening,
             iterations);
    flight_end(&f);
    return iterations;
}

static void stiff_flights(const char *with)
{
    static const double times[] = {1, 1e4, 1e6};
    double least = INFINITY, most = 0;
    for (int i = 0; i < 3; i++) {
        how.stiffening = times[i];
        const double iterations = long_flight(with);
        least = fmin(least, iterations);
        most = fmax(most, iterations);
    }
    how.stiffening = 1;
    gsl_test(!(most < 1.5 * least), "%s: %.2f to %.2f iterations a step at EA x 1 .. 1e6", with,
             least, most);
}

static void order(const char *with)
{
    double r[4][6];
    for (int i = 0; i < 4; i++) {
        flight f;
        gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
        fly(&f, 150 << i, flights_h / (1 << i));
        ends_of(&f, r[i]);
        flight_end(&f);
    }
    const double ratio = sqrt(apart(r[0], r[1]) / apart(r[2], r[3]));
    gsl_test(fabs(ratio - 4) > 0.6, "%s: differences fall by %.2f from %.1e, step %g s", with,
             ratio, apart(r[0], r[1]), flights_h);
}

static void reversal(const char *with)
{
    flight f;
    double before[6], after[6];
    gsl_test(flight_begin(&f, flights_build, with, 4) != STATUS_OK, "%s: %s", with, f.why.text);
    fly(&f, 120, flights_h);
    ends_of(&f, before);
    fly(&f, 100, flights_h);
    ends_of(&f, after);
    gsl_test(!(apart(before, after) > 10), "%s: it goes away by %.1f m", with,
             apart(before, after));
    fly(&f, 100, -flights_h);
    ends_of(&f, after);
    gsl_test(!(apart(before, after) < 1e-10), "%s, EA x %g: back within %.1e m of %g m", with,
             how.stiffening, apart(before, after), 40.);
    flight_end(&f);
}

static void same_answers(const char *with)
{
    static const double turn[3] = {0.7, -1.1, 1.9};
    double r[3][6];
    for (int i = 0; i < 3; i++) {
        flight f;
        rotation_exp(turn, how.turn);
        if (i < 2)
            memcpy(how.turn, (double[4]){1, 0, 0, 0}, sizeof how.turn);
        gsl_test(flight_begin(&f, i == 1 ? reversed : flights_build, with, 4) != STATUS_OK,
                 "%s: %s", with, f.why.text);
        fly(&f, 150, flights_h);
        ends_of(&f, r[i]);
        flight_end(&f);
    }
    memcpy(how.turn, (double[4]){1, 0, 0, 0}, sizeof how.turn);
    gsl_test(!(apart(r[0], r[1]) < 1e-10), "%s: the same from q to p, but for %.1e m", with,
             apart(r[0], r[1]));
    gsl_test(!(apart(r[0], r[2]) < 1e-10), "%s: the same in other axes, but for %.1e m", with,
             apart(r[0], r[2]));
}

static void flights_tests(void)
{
    static const char *const with[] = {"geometrically_exact", "geometrically_exact:nodes=2",
                                       "collocation"};
    for (int i = 0; i < 3; i++) {
        stiff_flights(with[i]);
        order(with[i]);
        same_answers(with[i]);
        reversal(with[i]);
        how.stiffening = 1e6;
        reversal(with[i]);
        how.stiffening = 1;
    }
}

enum { FORMULATIONS_STEPS = 60 };

typedef struct look {
    const char *name;
    section_kind kind;
    double curvature[3]; /* [1/m] */
    int tapers;
    double h, speed, spin; /* step size [s], velocity of the swing [m/s], spin [rad/s] */
} look;

static const look checks_flutter[] = {
    {.name = "sheet", .kind = SECTION_RECTANGLE, .h = 1e-3, .speed = 2, .spin = 32},
    {.name = "channel", .kind = SECTION_WALLS, .h = 2e-4, .speed = 2, .spin = 32},
    {.name = "arc", .kind = SECTION_RECTANGLE, .curvature = {0, 0, 1.1}, .h = 2.5e-4, .speed = 0.3},
    {.name = "two sections",
     .kind = SECTION_RECTANGLE,
     .tapers = 1,
     .h = 1e-3,
     .speed = 2,
     .spin = 32},
};
enum { LOOKS = sizeof checks_flutter / sizeof checks_flutter[0] };

static const look *formulations_present;
static const double length = 0.5;

static section_spec profile_of(double thickness)
{
    static const double point[][2] = {{0.04, 0.02}, {0, 0.02}, {0, -0.02}, {0.04, -0.02}},
                        wall[] = {1.5e-3, 1.5e-3, 1.5e-3};
    section_spec spec = formulations_present->kind == SECTION_RECTANGLE
                            ? section_spec_rectangle(2e11, 8e10, 0.1, thickness)
                            : section_spec_walls(2e11, 8e10, 3, point, NULL, wall);
    spec.density = 7800;
    return spec;
}

static status formulations_build(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0}, axis[] = {0.36, 0.48, -0.8}, end = 1;
    const section_spec spec = profile_of(2.25e-3), thick = profile_of(3e-3);
    scene_motion motion = {.scheme = SCENE_CONSERVING,
                           .alpha = scene_alpha_of_radius(0.9),
                           .step = formulations_present->h,
                           .start = {.velocity = {0.3, -0.2, 1}}};
    (void)value, (void)f;
    for (int i = 0; i < 3; i++)
        motion.start.spin[i] = formulations_present->spin * axis[i];
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, length, 0, 0), rod = scene_add_member(s, A, B, profile, y_axis);
    if (formulations_present->tapers)
        scene_member_at(s, rod)->section_q = scene_add_section(s, &thick);
    memcpy(scene_member_at(s, rod)->curvature, formulations_present->curvature,
           sizeof formulations_present->curvature);
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end, motion);
    return STATUS_OK;
}

static void swing(flight *f)
{
    const model *m = f->m;
    const double speed = formulations_present->speed;
    for (int i = 0; i < model_first_release(m); i++) {
        const double x = 2 * model_vertex(m, i)->position[0] / length - 1;
        const int *at = model_vertex(m, i)->coordinate;
        for (int k = 1; k < 3; k++)
            f->now.v[at[k]] += speed * (3 * x * x - 1) / 2;
        f->now.v[at[SCENE_RY]] -= speed * 6 * x / length;
        f->now.v[at[SCENE_RZ]] += speed * 6 * x / length;
    }
}

static int is_offered(const element_type *type)
{
    scene s;
    fault f;
    scene_init(&s, "flight");
    formulations_build(NULL, &s, &f);
    const int offered = ask_offered(&s, type);
    scene_free(&s);
    return offered;
}

static void formulations_fly(const element_type *type)
{
    flight f;
    double drift = 0, angular = 0, momentum = 0, from[3], to[3], most = 0;
    status outcome = flight_begin(&f, formulations_build, type->name, 4);
    if (outcome != STATUS_OK) {
        gsl_test(1, "%s, %s: %s", formulations_present->name, type->name, f.why.text);
        flight_end(&f);
        return;
    }
    swing(&f);
    const double energy = flight_energy(&f);
    const inertia_balance before = flight_inertia(&f);
    kinematics_position(f.m, f.now.state, 1, from);
    for (int i = 0; i < 2 * FORMULATIONS_STEPS && outcome == STATUS_OK; i++) {
        outcome = flight_step(&f, i < FORMULATIONS_STEPS ? formulations_present->h
                                                         : -formulations_present->h);
        const inertia_balance now = flight_inertia(&f);
        drift = fmax(drift, fabs(flight_energy(&f) / energy - 1));
        most = fmax(most, flight_strain_energy(&f) / energy);
        for (int k = 0; k < 3; k++) {
            angular = fmax(angular, fabs(now.angular[k] - before.angular[k]));
            momentum = fmax(momentum, fabs(now.momentum[k] - before.momentum[k]));
        }
    }
    kinematics_position(f.m, f.now.state, 1, to);
    for (int k = 0; k < 3; k++)
        to[k] -= from[k];
    gsl_test(outcome != STATUS_OK, "%s, %s: %s", formulations_present->name, type->name,
             f.why.text);
    gsl_test(!(most > 1e-4), "%s, %s: deforms (%.1e)", formulations_present->name, type->name,
             most);
    gsl_test(!(drift < 1e-11), "%s, %s: energy %.1e", formulations_present->name, type->name,
             drift);
    gsl_test(!(angular < 1e-12 * vec3_norm(before.angular) &&
               momentum < 1e-12 * vec3_norm(before.momentum)),
             "%s, %s: momenta %.1e %.1e", formulations_present->name, type->name,
             angular / vec3_norm(before.angular), momentum / vec3_norm(before.momentum));
    gsl_test(!(vec3_norm(to) < 1e-9), "%s, %s: back within %.1e m", formulations_present->name,
             type->name, vec3_norm(to));
    gsl_test(f.sum > 7 * f.steps, "%s, %s: %.2f iterations a step", formulations_present->name,
             type->name, f.sum / (f.steps + 1e-9));
    flight_end(&f);
}

static void formulations_tests(void)
{
    for (int i = 0; i < LOOKS; i++) {
        int flown = 0;
        formulations_present = &checks_flutter[i];
        for (int k = 0; registry_formulations[k] != NULL; k++)
            if (is_offered(registry_formulations[k])) {
                formulations_fly(registry_formulations[k]);
                flown++;
            }
        gsl_test(flown < 2, "%s: %d formulations fly", formulations_present->name, flown);
    }
}

int main(void)
{
    spin_tests();
    flights_tests();
    formulations_tests();
    return gsl_test_summary();
}
