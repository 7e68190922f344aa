/* Momentum of what flies freely is the integral of the load over time, to round-off, whatever the
 * integrator: the loads are linear in pieces. (Generalized-alpha averages accelerations over two
 * steps: while a load rises it is late by a part of h^2, which goes when the load has gone.) What
 * cases of motion refuse. */
#include <math.h>

#include "harness/time/test/moving.h"

extern const element_type element_geometrically_exact;
extern const case_type case_free_flight_space, case_free_flight_plane, case_release,
    case_leaf_guide, case_rigid_body, case_pendulum;

/* Of the force along x: of the triangle, 8 N m s^-1 for 2.5 s and back; of the step, 8 N for as
 * long. */
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
            const int motion = moving_add(&s, scheme[i], h, end[k]);
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

int main(void)
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
    return gsl_test_summary();
}
