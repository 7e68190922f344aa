/* A rotation that is driven by its vector along any path: increments lead to it, rates and their
 * derivatives are those of the frame, from any state. */
#include "harness/time/time_impl.h"

#include "elements/math/rotation.h"
#include "harness/time/test/masses.h"

static void build_driven(scene *s)
{
    static const double y[3] = {0, 1, 0};
    static const char *const way[] = {"0.3 + sin(2*t)", "0.5*t^2 - 0.2", "cos(3*t)"};
    const section_spec spec = heavy();
    scene_init(s, "driven");
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 1, 0.1, 0.2);
    scene_add_member(s, A, B, profile, y);
    scene_node_at(s, A)->rotation = SCENE_ROTATION_VECTOR;
    for (int k = 0; k < 3; k++) {
        const int d = scene_add_moving_driver(s, (const char *const[]){"a", "b", "c"}[k]);
        scene_drive_piece(s, d, 0, way[k]);
        scene_drive(s, A, SCENE_RX + k, d);
    }
    const int lift = scene_add_moving_driver(s, "lift");
    scene_drive_piece(s, lift, 0, "t^3 + t");
    scene_drive(s, A, SCENE_UZ, lift);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
}

/* From a state to a time. */
static void go(const equations *eq, const model_state *from, double time, model_state *to,
               frame_rates *r)
{
    const model *m = eq->m;
    double inc[MOST] = {0}, v[MOST] = {0}, a[MOST] = {0};
    drive_at(eq, from, time, inc, v, a);
    increment_apply(m, from, inc, time, to);
    forms_rates(m, to, 0, v, a, r);
}

/* What is driven at a time, from a state. */
static void check(const equations *eq, const model_state *from, double t, model_state *to)
{
    const double dt = 1e-4;
    frame_rates at, before, after;
    double q[2][4], turn[3], expected[4];
    go(eq, from, t - dt, to, &before);
    memcpy(q[0], to->q, sizeof q[0]);
    go(eq, from, t + dt, to, &after);
    memcpy(q[1], to->q, sizeof q[1]);
    go(eq, from, t, to, &at);
    rotation_exp((const double[]){0.3 + sin(2 * t), 0.5 * t * t - 0.2, cos(3 * t)}, expected);
    rotation_between(expected, to->q, turn);
    gsl_test(!(vec3_norm(turn) < 1e-13), "turned otherwise by %g rad", vec3_norm(turn));
    gsl_test(!(fabs(to->u[2] - t * t * t - t) < 1e-13), "lifted by %g m", to->u[2]);
    gsl_test(!(fabs(at.v[2] - 3 * t * t - 1) < 1e-12), "lifted at %g m/s", at.v[2]);
    gsl_test(!(fabs(at.a[2] - 6 * t) < 1e-12), "lifted with %g m/s^2", at.a[2]);
    rotation_between(q[0], q[1], turn);
    for (int k = 0; k < 3; k++) {
        const double w = turn[k] / (2 * dt), wd = (after.w[k] - before.w[k]) / (2 * dt);
        gsl_test(!(fabs(w - at.w[k]) < 1e-6), "angular velocity %.9g, not %.9g", at.w[k], w);
        gsl_test(!(fabs(wd - at.wd[k]) < 1e-6), "its derivative %.9g, not %.9g", at.wd[k], wd);
    }
}

int main(void)
{
    scene s;
    model *m;
    run_state run;
    model_state *now = NULL, *to = NULL;
    formulation chosen;
    frame_rates at;
    fault f = {""};
    build_driven(&s);
    formulation_default(&element_collocation, &chosen);
    const model_request request = {
        .scene = &s, .type = &element_collocation, .options = chosen.option, .elements = 1};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s", f.text);
    gsl_test(run_state_begin(&run, m, 1, &f) != STATUS_OK, "%s", f.text);
    const equations eq = {.m = m, .loading = {.in_time = 1}, .run = &run};
    gsl_test(kinematics_state_alloc(m, &now, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &to, &f) != STATUS_OK,
             "%s", f.text);
    go(&eq, kinematics_rest(m), 0.4, now, &at);
    check(&eq, kinematics_rest(m), 0.7, to);
    check(&eq, now, 0.7, to);
    kinematics_state_free(now);
    kinematics_state_free(to);
    run_state_end(&run);
    model_free(m);
    scene_free(&s);
    return gsl_test_summary();
}
