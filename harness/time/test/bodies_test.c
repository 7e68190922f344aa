/* Bodies without torque with the conserving scheme: one node, two bodies that a stiff rod joins,
 * and a flexible rod between two bodies beside its ends. */
#include <stdio.h>

#include "harness/time/test/flight.h"
#include "harness/tools/kit/scenes.h"

static const double bodies_y_axis[] = {0, 1, 0};

static struct {
    double stiffness;
    int rod; /* 0: one body; 1: two that make up the same one; 2: on offsets */
} how;

static int profile_of(scene *s, double E, double mass)
{
    const section_spec spec = timed_profile(&(timed_section){.EA = E,
                                                             .GA = E,
                                                             .GJ = how.rod == 2 ? 50 : E,
                                                             .EI = how.rod == 2 ? 50 : E,
                                                             .mass = mass,
                                                             .polar = mass / 50,
                                                             .rotary = mass / 100});
    return scene_add_section(s, &spec);
}

static void bodies_add_motion(scene *s, const double spin[3])
{
    static const double end = 10;
    scene_motion motion = {
        .scheme = SCENE_CONSERVING, .alpha = scene_alpha_of_radius(0.9), .step = 0.1};
    memcpy(motion.start.spin, spin, 3 * sizeof *spin);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    scene_add_motion(s, SCENE_NONE, 1, &end, motion);
}

/* J = diag(1, 2, 3) about the middle, which stays. The rod's own mass is none. */
static status free_body(const double value[], scene *s, fault *f)
{
    static const double spin[] = {0.5, 0.2, 2};
    const int profile = profile_of(s, how.rod ? how.stiffness : 1, 0);
    (void)value, (void)f;
    if (how.rod == 0) {
        const int hub = scene_add_node(s, 0, 0, 0), A = scene_add_attached(s, hub, -0.5, 0, 0),
                  B = scene_add_attached(s, hub, 0.5, 0, 0);
        scene_add_member(s, A, B, profile, bodies_y_axis);
        scene_set_body(s, hub, (scene_body){.mass = 1, .inertia = {1, 2, 3}});
    } else {
        const int A = scene_add_node(s, -0.5, 0, 0), B = scene_add_node(s, 0.5, 0, 0);
        scene_add_member(s, A, B, profile, bodies_y_axis);
        scene_set_body(s, A, (scene_body){.mass = 1, .inertia = {0.5, 0.75, 1.25}});
        scene_set_body(s, B, (scene_body){.mass = 1, .inertia = {0.5, 0.75, 1.25}});
    }
    bodies_add_motion(s, spin);
    return STATUS_OK;
}

static status on_offsets(const double value[], scene *s, fault *f)
{
    static const double spin[] = {0.9, -0.6, 1.2};
    const int profile = profile_of(s, 1e4 * how.stiffness, 1), a = scene_add_node(s, -2.1, 0.6, 0),
              b = scene_add_node(s, 2, -0.3, 0.7), A = scene_add_attached(s, a, -1.5, 0, 0),
              B = scene_add_attached(s, b, 1.5, 0, 0);
    (void)value, (void)f;
    scene_add_member(s, A, B, profile, bodies_y_axis);
    scene_set_body(s, a, (scene_body){.mass = 2, .inertia = {0.4, 0.5, 0.7, 0.1}});
    scene_set_body(s, b,
                   (scene_body){.mass = 3, .centre = {0.1, 0.2, 0}, .inertia = {0.6, 0.9, 0.8}});
    bodies_add_motion(s, spin);
    return STATUS_OK;
}

static void bodies_fly(flight *f, int steps, double h, double *drift, double *angular)
{
    const double energy = flight_energy(f);
    const inertia_balance before = flight_inertia(f);
    status outcome = STATUS_OK;
    for (int i = 0; i < steps && outcome == STATUS_OK; i++) {
        outcome = flight_step(f, h);
        const inertia_balance now = flight_inertia(f);
        *drift = fmax(*drift, fabs(flight_energy(f) / energy - 1));
        for (int k = 0; k < 3; k++)
            *angular = fmax(*angular,
                            fabs(now.angular[k] - before.angular[k]) / vec3_norm(before.angular));
    }
    gsl_test(outcome != STATUS_OK, "steps of %g s: %s", h, f->why.text);
}

/* Of R at 10 s, whose exact value is by quadrature of the precession: largest entry. */
static double error_of_body(double h)
{
    static const double exact[9] = {0.1439879275647, -0.9562925632996, 0.2545034579204,
                                    0.9873599189256, 0.1560479392089,  0.02773862231498,
                                    -0.066240978366, 0.2472924868379,  0.9666739671361};
    flight f;
    double drift = 0, angular = 0, error = 0, R[9];
    gsl_test(flight_begin(&f, free_body, "geometrically_exact", 1) != STATUS_OK, "%s", f.why.text);
    bodies_fly(&f, (int)lround(10 / h), h, &drift, &angular);
    rotation_matrix(f.now.state->q, R);
    for (int i = 0; i < 9; i++)
        error = fmax(error, fabs(R[i] - exact[i]));
    gsl_test(!(drift < 1e-12 && angular < 1e-12), "%d bodies, %g, %g s: energy %.1e, momentum %.1e",
             1 + how.rod, how.stiffness, h, drift, angular);
    gsl_test(f.most > 5, "%d bodies, %g, %g s: %d iterations at most", 1 + how.rod, how.stiffness,
             h, f.most);
    flight_end(&f);
    return error;
}

static void bodies(void)
{
    static const double known[] = {2.86e-1, 7.55e-2, 1.91e-2, 4.78e-3};
    for (int i = 0; i < 4; i++) {
        const double h = 0.2 / (1 << i);
        how.rod = 0;
        const double one = error_of_body(h);
        gsl_test(fabs(one / known[i] - 1) > 0.01, "%g s: R is wrong by %.3e, as known %.3e", h, one,
                 known[i]);
        how.rod = 1;
        for (int k = 2; k < 5; k++) {
            how.stiffness = pow(100, k);
            const double two = error_of_body(h);
            gsl_test(fabs(two - one) > 0.02 * one + 20 / how.stiffness,
                     "stiffness %g, %g s: R is wrong by %.3e", how.stiffness, h, two);
        }
    }
}

static void offset_flight(double h)
{
    const int steps = (int)lround(20 / h);
    flight f;
    double drift = 0, angular = 0, from[3], to[3];
    gsl_test(flight_begin(&f, on_offsets, "geometrically_exact", 2) != STATUS_OK, "%s", f.why.text);
    kinematics_position(f.m, f.now.state, 0, from);
    bodies_fly(&f, steps, h, &drift, &angular);
    gsl_test(!(drift < 1e-12 && angular < 1e-12), "EA x %g, %g s: energy %.1e, momentum %.1e",
             how.stiffness, h, drift, angular);
    gsl_test(f.sum > 4.2 * f.steps, "EA x %g, %g s: %.2f iterations", how.stiffness, h,
             (double)f.sum / f.steps);
    bodies_fly(&f, steps, -h, &drift, &angular);
    kinematics_position(f.m, f.now.state, 0, to);
    for (int i = 0; i < 3; i++)
        to[i] -= from[i];
    gsl_test(!(vec3_norm(to) < 1e-10), "EA x %g, %g s: back within %.1e m", how.stiffness, h,
             vec3_norm(to));
    flight_end(&f);
}

static void offsets(void)
{
    how.rod = 2;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            how.stiffness = pow(1e3, i);
            offset_flight(0.02 * (1 << k));
        }
}

int main(void)
{
    bodies();
    offsets();
    return gsl_test_summary();
}
