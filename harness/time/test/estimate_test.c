/* Error estimates of integrators for one step, which determine the next step size. */
#include <math.h>

#include "elements/math/dense.h"
#include "elements/test/kit.h"
#include "harness/model/model.h"
#include "harness/time/test/flying.h"
#include "harness/time/test/moving.h"
#include "harness/tools/kit/scenes.h"

extern const element_type element_collocation;

static const double mass = 2, stiffness = 18, velocity = 0.8, length = 1;
static const double estimate_y_axis[3] = {0, 1, 0};

static section_spec light(double EA)
{
    return timed_profile(&(timed_section){
        .EA = EA, .GA = EA, .GJ = 1, .EI = 1, .mass = 1e-12, .polar = 1e-12, .rotary = 1e-12});
}

static void add_motion(scene *s, scene_scheme by, const scene_alpha *alpha, double vx)
{
    static const double end[] = {1};
    scene_add_motion(s, SCENE_NONE, 1, end,
                     (scene_motion){.scheme = by,
                                    .alpha = alpha != NULL ? *alpha : scene_alpha_of_radius(0.9),
                                    .step = 0.1,
                                    .start = {.velocity = {vx}}});
}

static void add_oscillator(scene *s, scene_scheme by, const scene_alpha *alpha, double eta,
                           int forced)
{
    const section_spec spec = light(stiffness * length);
    scene_init(s, "oscillator");
    const int profile = scene_add_section(s, &spec), root = scene_add_node(s, 0, 0, 0),
              tip = scene_add_node(s, length, 0, 0),
              rod = scene_add_member(s, root, tip, profile, estimate_y_axis);
    scene_member_at(s, rod)->damping = eta;
    scene_hold_all(s, root);
    scene_hold(s, tip, SCENE_UY, SCENE_RZ);
    scene_set_body(s, tip, (scene_body){.mass = mass, .inertia = {1, 1, 1}});
    if (forced)
        scene_load_piece(s, scene_add_load(s, SCENE_FORCE, tip, 1, 0, 0), 0, "2 + 3*t");
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    add_motion(s, by, alpha, velocity);
}

static void begin(const scene *s, flying *f)
{
    const status outcome = flying_begin(s, &element_collocation, 1, f);
    gsl_test(outcome != STATUS_OK, "begins: %s", f->why.text);
}

/* Returns the error estimate of RADAU5 for y = (x, v), y' = J y + (0, F/m) (Hairer & Wanner II,
 * IV.8, eq. 8.19): (1 - h c J)^-1 [c h y'(0) + e . z], where z are the increments of the stages,
 * and c is the inverse of the real eigenvalue of A^-1. */
static double radau_of(double x, double v, double eta, double F0, double F1, double h)
{
    const double s = sqrt(6), c0 = 0.2748888295956773677478286,
                 e[3] = {c0 / 3 * (-13 - 7 * s), c0 / 3 * (-13 + 7 * s), -c0 / 3},
                 node[3] = {(4 - s) / 10, (4 + s) / 10, 1},
                 A[3][3] = {{(88 - 7 * s) / 360, (296 - 169 * s) / 1800, (-2 + 3 * s) / 225},
                            {(296 + 169 * s) / 1800, (88 + 7 * s) / 360, (-2 - 3 * s) / 225},
                            {(16 - s) / 36, (16 + s) / 36, 1 / 9.0}},
                 J[2][2] = {{0, 1}, {-stiffness / mass, -eta * stiffness / mass}};
    double S[36], z[6], f0[2] = {v, J[1][0] * x + J[1][1] * v + F0 / mass}, M[4], right[2];
    int pivot[6];
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 2; a++) {
            z[2 * i + a] = 0;
            for (int j = 0; j < 3; j++) {
                const double load = a ? (F0 + F1 * node[j] * h) / mass : 0;
                z[2 * i + a] += h * A[i][j] * (J[a][0] * x + J[a][1] * v + load);
                for (int b = 0; b < 2; b++)
                    S[6 * (2 * i + a) + 2 * j + b] = (i == j && a == b) - h * A[i][j] * J[a][b];
            }
        }
    dense_lu(6, S, pivot);
    dense_lu_solve(6, 1, S, pivot, z);
    for (int a = 0; a < 2; a++) {
        right[a] = c0 * h * f0[a];
        for (int i = 0; i < 3; i++)
            right[a] += e[i] * z[2 * i + a];
        for (int b = 0; b < 2; b++)
            M[2 * a + b] = (a == b) - h * c0 * J[a][b];
    }
    dense_lu(2, M, pivot);
    dense_lu_solve(2, 1, M, pivot, right);
    return fabs(right[0]);
}

static void radau_errors(double eta)
{
    const double h = 0.1;
    scene s;
    flying f;
    add_oscillator(&s, SCENE_RADAU, NULL, eta, 1);
    begin(&s, &f);
    for (int i = 0; i < 3; i++) {
        const double expected =
            radau_of(f.now.state->u[3], f.now.v[0], eta, 2 + 3 * f.now.time, 3, h);
        const status outcome = flying_step(&f, h);
        gsl_test(outcome != STATUS_OK || !(fabs(f.error / expected - 1) < 1e-6),
                 "radau, damping %g s, step %d: error %.9g, expected %.9g %s", eta, i, f.error,
                 expected, f.why.text);
    }
    flying_end(&f);
    scene_free(&s);
}

static void of_second_order(scene_scheme by, const char *name, const scene_alpha *alpha,
                            double tolerance)
{
    const double h = 0.01, w = sqrt(stiffness / mass);
    scene s;
    flying f;
    add_oscillator(&s, by, alpha, 0, 0);
    begin(&s, &f);
    for (int i = 0; i < 30; i++)
        flying_step(&f, h);
    const double x = f.now.state->u[3], v = f.now.v[0];
    gsl_test(flying_step(&f, h) != STATUS_OK, "%s: %s", name, f.why.text);
    const double departs = fabs(f.now.state->u[3] - x * cos(w * h) - v / w * sin(w * h));
    gsl_test(!(fabs(f.error / departs - 1) < tolerance), "%s: error %g, estimated %g", name,
             departs, f.error);
    flying_end(&f);
    scene_free(&s);
}

static void explicit_one(void)
{
    double error[2];
    for (int k = 0; k < 2; k++) {
        const double h = 0.2 / (1 << k), w = sqrt(stiffness / mass);
        scene s;
        flying f;
        add_oscillator(&s, SCENE_EXPLICIT, NULL, 0, 0);
        begin(&s, &f);
        gsl_test(flying_step(&f, h) != STATUS_OK, "explicit: %s", f.why.text);
        const double departs = fabs(f.now.state->u[3] - velocity / w * sin(w * h));
        error[k] = f.error;
        gsl_test(!(f.error > departs && f.error < 1e-6), "explicit: error %g, estimated %g",
                 departs, f.error);
        flying_end(&f);
        scene_free(&s);
    }
    gsl_test(!(log2(error[0] / error[1]) > 7.5), "explicit: estimates %g, %g", error[0], error[1]);
}

static double of_lifted(double eta, double h)
{
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 20, .GA = 10, .GJ = 1, .EI = 1, .mass = 0.5, .polar = 0.02, .rotary = 0.01});
    scene s;
    flying f;
    scene_init(&s, "lifted");
    const int profile = scene_add_section(&s, &spec), A = scene_add_node(&s, 0, 0, 0),
              B = scene_add_node(&s, length, 0, 0.1),
              rod = scene_add_member(&s, A, B, profile, estimate_y_axis);
    scene_member_at(&s, rod)->damping = eta;
    scene_hold(&s, A, SCENE_UX, SCENE_UY);
    scene_set_body(&s, A, (scene_body){0.5, {0.1, 0.2, 0}, {0.03, 0.04, 0.05, 0, 0, 0}});
    scene_set_body(&s, B, (scene_body){0.5, {0, 0.1, 0.1}, {0.03, 0.04, 0.05, 0, 0, 0}});
    const int lift = scene_add_moving_driver(&s, "lift");
    scene_drive_piece(&s, lift, 0, "t^2");
    scene_drive(&s, A, SCENE_UZ, lift);
    scene_load_piece(&s, scene_add_load(&s, SCENE_FORCE, B, 0, 1, 0), 0, "1 + t");
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    add_motion(&s, SCENE_RADAU, NULL, 0);
    s.analysis[0].of.motion.start.spin[1] = -1;
    begin(&s, &f);
    for (int i = 0; i < 9; i++)
        gsl_test(flying_step(&f, i < 8 ? 0.02 : h) != STATUS_OK, "lifted: %s", f.why.text);
    const double error = f.error;
    flying_end(&f);
    scene_free(&s);
    return error;
}

static void order(double eta)
{
    const double first = of_lifted(eta, 0.04), second = of_lifted(eta, 0.02);
    gsl_test(!(fabs(log2(first / second) - 4) < 0.7), "radau, damping %g s: estimates %g, %g", eta,
             first, second);
}

static void estimate_tests(void)
{
    const scene_alpha trapezoidal = {0, 0}, hht = {.mass = 0, .force = 0.1},
                      strong = scene_alpha_of_radius(0.5);
    radau_errors(0);
    radau_errors(0.05);
    order(0);
    order(0.02);
    of_second_order(SCENE_ALPHA, "alpha", NULL, 0.1);
    of_second_order(SCENE_ALPHA, "strong", &strong, 0.1);
    of_second_order(SCENE_ALPHA, "hht", &hht, 0.1);
    of_second_order(SCENE_ALPHA, "trapezoidal", &trapezoidal, 0.1);
    of_second_order(SCENE_CONSERVING, "conserving", NULL, 0.1);
    explicit_one();
}

extern const element_type element_geometrically_exact;

#define RODS "harness/time/test/rods.yaml"

enum { PLACES = 3 };

static struct {
    double rotary, spin;
    int joint, thrown;
} how;

/* Builds a rod oblique to all axes. If how.joint is 1, another rod at its end rotates about a
 * single axis. If how.thrown is 1, the rods start at rest, under a force and a moment that rise and
 * end. */
static void build(scene *s, scene_scheme by, double step)
{
    scenes_read(s, RODS,
                "of=oblique;end=1;integrator=%s;step=%.17g;spin=%g;rotary=%g;joint=%s;"
                "comes_and_goes=%d",
                scenes_integrator[by], step, how.spin, how.rotary, how.joint ? "hinge" : "stiff",
                how.thrown);
}

static void fly(scene_scheme by, double step, double place[PLACES])
{
    scene s;
    flying f;
    build(&s, by, step);
    status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    for (int i = 0; i < lround(0.8 / step) && outcome == STATUS_OK; i++)
        outcome = flying_step(&f, step);
    gsl_test(outcome != STATUS_OK, "integrator %d, spin %g, rotary %g, step %g s: %s", by, how.spin,
             how.rotary, step, f.why.text);
    kinematics_position(f.m, f.now.state, 1, place);
    flying_end(&f);
    scene_free(&s);
}

static double distance(const double a[PLACES], const double b[PLACES])
{
    const double apart[PLACES] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dense_dot(PLACES, apart, apart));
}

static double error_of(scene_scheme by, double step)
{
    double exact[PLACES], place[PLACES];
    fly(SCENE_RADAU, 0.005, exact);
    fly(by, step, place);
    return distance(place, exact);
}

static void converge(scene_scheme by, double step, double ratio)
{
    const double first = error_of(by, step), second = error_of(by, step / 2);
    gsl_test(!(fabs(first / second / ratio - 1) < 0.25),
             "integrator %d, spin %g: errors %g and %g m", by, how.spin, first, second);
}

static void agree(scene_scheme by, double step, double most)
{
    const double error = error_of(by, step);
    gsl_test(!(error < most), "integrator %d, spin %g, joint: error %g m", by, how.spin, error);
}

static void limit(void)
{
    double place[3][PLACES], without[PLACES];
    for (int i = 0; i < 3; i++) {
        how.rotary = i < 2 ? 0.04 / (1 + i) : 0;
        fly(i < 2 ? SCENE_EXPLICIT : SCENE_RADAU, i < 2 ? 0.0025 : 0.01, place[i]);
    }
    for (int i = 0; i < PLACES; i++)
        without[i] = 2 * place[1][i] - place[0][i];
    const double coarse = distance(place[0], place[2]), fine = distance(place[1], place[2]),
                 rest = distance(without, place[2]);
    gsl_test(!(fabs(coarse / fine - 2) < 0.1 && rest < 0.04 * coarse),
             "less inertia of bending turns: %g, %g, then %g m from none", coarse, fine, rest);
}

static void start_again(void)
{
    scene s;
    flying f;
    motion_state before;
    build(&s, SCENE_RADAU, 0.01);
    status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    for (int i = 0; i < 50 && outcome == STATUS_OK; i++)
        outcome = flying_step(&f, 0.01);
    if (outcome == STATUS_OK)
        outcome = motion_state_alloc(f.m, &before, &f.why);
    gsl_test(outcome != STATUS_OK, "%s", f.why.text);
    motion_state_copy(f.m, &f.now, &before);
    const scene_motion *motion = scene_motion_of(&s.analysis[0]);
    outcome = consistent_restart(&f.c, &f.masses, motion, &f.now, &f.next, &f.why);
    gsl_test(outcome != STATUS_OK, "%s", f.why.text);
    double moved = 0, changed = 0, largest = 0, forces[2][100] = {{0}};
    for (int i = 0; i < model_vertices(f.m); i++) {
        double p[3], q[3];
        kinematics_position(f.m, before.state, i, p);
        kinematics_position(f.m, f.now.state, i, q);
        moved = fmax(moved, distance(p, q));
        for (int k = 0; k < 4; k++)
            moved = fmax(moved, fabs(before.state->q[4 * i + k] - f.now.state->q[4 * i + k]));
    }
    inertia_subtract(f.m, &f.masses, f.now.state, f.now.v, before.a, forces[0]);
    inertia_subtract(f.m, &f.masses, f.now.state, f.now.v, f.now.a, forces[1]);
    for (int c = 0; c < model_unknowns(f.m); c++) {
        changed = fmax(changed, fabs(forces[0][c] - forces[1][c]));
        largest = fmax(largest, fabs(forces[1][c]));
    }
    gsl_test(!(moved < 1e-9), "joint %d: started again it moves by %g", how.joint, moved);
    gsl_test(!(changed < 1e-3 * largest), "joint %d: started again inertia changes by %g of %g N",
             how.joint, changed, largest);
    motion_state_free(&before);
    flying_end(&f);
    scene_free(&s);
}

static void refuse(void)
{
    scene s;
    flying f;
    build(&s, SCENE_ALPHA, 0.01);
    const status outcome = flying_begin(&s, &element_geometrically_exact, 2, &f);
    gsl_test(outcome != STATUS_NOT_CONVERGED || strstr(f.why.text, "no equilibrium") == NULL,
             "without a balance: %s", f.why.text);
    flying_end(&f);
    scene_free(&s);
}

static void motion_massless_tests(void)
{
    static const double spins[] = {0.3, 1};
    for (how.joint = 0; how.joint < 2; how.joint++)
        for (int i = 0; i < 2; i++) {
            how.spin = spins[i];
            if (how.joint) {
                agree(SCENE_ALPHA, 0.01, 3e-3);
            } else {
                converge(SCENE_ALPHA, 0.02, 4);
                converge(SCENE_CONSERVING, 0.02, 4);
                converge(SCENE_RADAU, 0.02, 28);
            }
            start_again();
        }
    how.joint = 0;
    how.spin = 60;
    refuse();
    how.spin = 0;
    how.thrown = 1;
    limit();
}

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space;

static void throw_rod(scene *s, scene_scheme by, const scene_alpha *alpha)
{
    moving_case(&case_free_flight_space, "", s);
    const int motion = motion_added(s, by, 0.05, 1);
    moving_unload(s);
    s->analysis[motion].of.motion.alpha = *alpha;
    s->analysis[motion].of.motion.start = (scene_start){.spin = {0.3, 1, 2}};
}

static void steps_begin(const scene *s, flying *f)
{
    const status outcome = flying_begin(s, &element_geometrically_exact, 3, f);
    gsl_test(outcome != STATUS_OK, "begins: %s", f->why.text);
}

static void reverse(void)
{
    enum { STEPS = 40 };
    const scene_alpha trapezoidal = {0, 0};
    scene s;
    flying f;
    double largest = 0;
    throw_rod(&s, SCENE_ALPHA, &trapezoidal);
    steps_begin(&s, &f);
    double *first = flying_all(&f);
    for (int i = 0; i < 2 * STEPS; i++)
        gsl_test(flying_step(&f, i < STEPS ? 0.02 : -0.02) != STATUS_OK, "step %d: %s", i,
                 f.why.text);
    const size_t n = (size_t)model_unknowns(f.m);
    double *last = flying_all(&f);
    for (size_t i = 0; i < n; i++)
        largest = fmax(largest, fabs(last[i] - first[i]));
    for (int i = 0; i < 3 * model_vertices(f.m); i++)
        largest = fmax(largest, fabs(f.now.state->u[i]));
    gsl_test(!(largest < 1e-10), "the trapezoidal rule runs back (%g)", largest);
    free(first);
    free(last);
    flying_end(&f);
    scene_free(&s);
}

/* Returns the error at 10 s of a body with J = diag(1, 2, 3) and w(0) = (0.5, 0.2, 2), by
 * comparison with Jacobi's elliptic functions. */
static double turn_body(scene_scheme by, double h)
{
    static const double w[3] = {0.069492061156576, 0.5340139075307, 1.9794636602342},
                        R[6] = {0.1439879275647, -0.9562925632996, 0.2545034579204,
                                0.9873599189256, 0.1560479392089,  0.02773862231498},
                        y_axis[3] = {0, 1, 0}, at[1] = {10};
    scene s;
    answer a;
    double largest = 0;
    scene_init(&s, "body");
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const section_spec spec = timed_profile(&(timed_section){.EA = 1e-3,
                                                             .GA = 1e-3,
                                                             .GJ = 1e-3,
                                                             .EI = 1e-3,
                                                             .mass = 1e-11,
                                                             .polar = 2e-11,
                                                             .rotary = 1e-11});
    const int profile = scene_add_section(&s, &spec), body = scene_add_node(&s, 0, 0, 0);
    scene_add_member(&s, body, scene_add_node(&s, 1, 0, 0), profile, y_axis);
    scene_node_at(&s, body)->body = (scene_body){.mass = 1, .inertia = {1, 2, 3}};
    const int motion = scene_add_motion(&s, SCENE_NONE, 1, at,
                                        (scene_motion){.scheme = by,
                                                       .alpha = scene_alpha_of_radius(0.9),
                                                       .step = h,
                                                       .start = {.spin = {0.5, 0.2, 2}}});
    for (int i = 0; i < 9; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "%d", i);
        scene_add_quantity(&s, name, "1", motion,
                           i < 3 ? scene_rate(body, SCENE_RX + i)
                                 : scene_orientation_entry(body, (i - 3) / 3, i % 3));
    }
    ask_scene(&s, &element_geometrically_exact, NULL, 1, &a);
    scene_free(&s);
    for (int i = 0; i < 9; i++)
        largest = worst_of(largest, fabs(a.value[i] - (i < 3 ? w[i] : R[i - 3])));
    return largest;
}

static void check_body(scene_scheme by, double h, double order, double least)
{
    const double first = turn_body(by, h), second = turn_body(by, h / 2);
    gsl_test(!(second < least && fabs(log2(first / second) - order) < 0.15),
             "scheme %d: a free body, errors %g, %g, order %g", by, first, second,
             log2(first / second));
}

static void impulse(scene_scheme by)
{
    scene s;
    answer a;
    moving_case(&case_free_flight_space, "", &s);
    const int motion = motion_added(&s, by, 0.07, 6);
    scene_add_quantity(&s, "px", "1", motion, scene_balance_of(SCENE_PX));
    scene_add_quantity(&s, "py", "1", motion, scene_balance_of(SCENE_PY));
    ask_scene(&s, &element_geometrically_exact, NULL, 3, &a);
    scene_free(&s);
    gsl_test(!(fabs(answer_of(&a, "px") - 50) < 1e-11 && fabs(answer_of(&a, "py")) < 1e-11),
             "scheme %d: momentum is the impulse (%.15g, %g) %s", by, answer_of(&a, "px"),
             answer_of(&a, "py"), a.reason);
}

static void steps_tests(void)
{
    reverse();
    check_body(SCENE_ALPHA, 0.05, 2, 2.3e-3);
    check_body(SCENE_CONSERVING, 0.05, 2, 5e-3);
    check_body(SCENE_RADAU, 0.1, 5, 2e-8);
    for (int by = 0; by <= SCENE_RADAU; by++)
        impulse((scene_scheme)by);
}

int main(void)
{
    estimate_tests();
    motion_massless_tests();
    steps_tests();
    return gsl_test_summary();
}
