/* What integrators say of the error of a step, which sets the length of the next one, in
 * milliseconds: a mass on a spring, whose step is known in closed form, and the order of the
 * estimate where masses are driven, turn and are damped. */
#include <math.h>

#include "elements/math/dense.h"
#include "harness/time/test/flying.h"
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

/* eta: damping [s]; the force is 2 + 3 t. */
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

/* The radius of RADAU5 for y = (x, v), y' = J y + (0, F/m) (Hairer & Wanner II, IV.8, eq. 8.19):
 * (1 - h c J)^-1 [c h y'(0) + e . z], c the inverse of the real eigenvalue of A^-1. */
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

/* Against the motion that is exact from where the step begins. */
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

/* A rod behind a body that is lifted, beside which its centre is, and turns freely. */
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

int main(void)
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
    return gsl_test_summary();
}
