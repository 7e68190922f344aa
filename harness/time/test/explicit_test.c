/* The explicit integrator must agree with the exact motion of a body without torque and with the
 * implicit integrator of order 5, have its order, and reject models without inertia. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "elements/test/kit.h"
#include "harness/time/time_impl.h"
#include "harness/tools/kit/cells.h"
#include "harness/tools/kit/scenes.h"

static const double J[3] = {1, 2, 3}, start[3] = {0.5, 0.2, 2};

static struct {
    scene_scheme scheme;
    double step, tolerance, time;
    int light, released;
} how;

static int add_motion(scene *s)
{
    scene_motion m = {.scheme = how.scheme,
                      .alpha = scene_alpha_of_radius(0.9),
                      .step = how.step,
                      .mass = SCENE_LUMPED,
                      .tolerance = how.tolerance};
    memcpy(m.start.spin, start, sizeof start);
    return scene_add_motion(s, SCENE_NONE, 1, &how.time, m);
}

static status body(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0, 1, 0};
    (void)value, (void)f;
    const section_spec spec =
        timed_profile(&(timed_section){.EA = 1, .GA = 1, .GJ = 1, .EI = 1, .mass = 0.4});
    const int profile = scene_add_section(s, &spec), hub = scene_add_node(s, 0, 0, 0),
              A = scene_add_attached(s, hub, -0.5, 0, 0), B = scene_add_attached(s, hub, 0.5, 0, 0);
    scene_add_member(s, A, B, profile, y_axis);
    scene_set_body(s, hub, (scene_body){.mass = 1, .inertia = {J[0], J[1] - 0.1, J[2] - 0.1}});
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    const int motion = add_motion(s);
    for (int i = 0; i < 3; i++) {
        const char rate[] = {'w', (char)('x' + i), 0}, entry[] = {'R', (char)('x' + i), 0};
        scene_add_quantity(s, rate, "rad/s", motion, scene_rate(hub, SCENE_RX + i));
        scene_add_quantity(s, entry, "1", motion, scene_orientation_entry(hub, i, 0));
    }
    return STATUS_OK;
}

/* Computes the rates of the free body by Jacobi's functions (Landau and Lifshitz, Mechanics,
 * section 37), for L^2 > 2 T J_y. */
static void exact_rates(double t, double w[3])
{
    double energy = 0, square = 0, sn, cn, dn;
    for (int i = 0; i < 3; i++) {
        energy += J[i] * start[i] * start[i];
        square += J[i] * J[i] * start[i] * start[i];
    }
    const double x = sqrt((energy * J[2] - square) / (J[0] * (J[2] - J[0]))),
                 y = sqrt((energy * J[2] - square) / (J[1] * (J[2] - J[1]))),
                 z = sqrt((square - energy * J[0]) / (J[2] * (J[2] - J[0]))),
                 rate = sqrt((J[2] - J[1]) * (square - energy * J[0]) / (J[0] * J[1] * J[2])),
                 m = (J[1] - J[0]) * (energy * J[2] - square) /
                     ((J[2] - J[1]) * (square - energy * J[0])),
                 begin = gsl_sf_ellint_F(asin(start[1] / y), sqrt(m), GSL_PREC_DOUBLE);
    /* J_y w_y' = (J_z - J_x) w_z w_x > 0 at the start */
    gsl_sf_elljac_e(begin + rate * t, m, &sn, &cn, &dn);
    w[0] = x * cn;
    w[1] = y * sn;
    w[2] = z * dn;
}

static double error_of_body(double step, double tolerance)
{
    /* first column of R at 10 s, computed by quadrature of the precession */
    static const double column[3] = {0.1439879275647, 0.9873599189256, -0.066240978366};
    double w[3], largest = 0;
    cell_result r;
    how.step = step;
    how.tolerance = tolerance;
    cells_solve(body, "collocation", 1, &r);
    exact_rates(how.time, w);
    for (int i = 0; i < 3; i++) {
        const char rate[] = {'w', (char)('x' + i), 0}, entry[] = {'R', (char)('x' + i), 0};
        largest = fmax(largest, fabs(cells_value(&r, rate) - w[i]));
        largest = fmax(largest, fabs(cells_value(&r, entry) - column[i]));
    }
    cell_result_free(&r);
    return largest;
}

static void free_body(void)
{
    how.scheme = SCENE_EXPLICIT;
    how.time = 10;
    const double adaptive = error_of_body(0.1, 1e-12), long_steps = error_of_body(0.5, 0),
                 half = error_of_body(0.25, 0), order = log2(long_steps / half);
    gsl_test(!(adaptive < 1e-10), "free body, tolerance 1e-12: error %.1e", adaptive);
    gsl_test(!(order > 7.6 && order < 9.4), "free body: errors %.1e, %.1e, order %.2f", long_steps,
             half, order);
}

static status rod(const double value[], scene *s, fault *f)
{
    static const double y_axis[] = {0.1, 1, 0.2};
    (void)value, (void)f;
    section_spec spec = section_spec_rectangle(2e6, 8e5, 0.1, 0.05);
    spec.density = 1000;
    const int profile = scene_add_section(s, &spec), A = scene_add_node(s, 0, 0, 0),
              B = scene_add_node(s, 1, 0, 0.1), member = scene_add_member(s, A, B, profile, y_axis);
    scene_hold(s, A, SCENE_UX, SCENE_UY);
    if (how.released) {
        scene_release_end(s, member, 0, SCENE_RZ);
        scene_hold(s, A, SCENE_RX, SCENE_RZ);
    }
    scene_set_body(s, A, (scene_body){.mass = 0.5, .centre = {0, 0.1, 0}});
    scene_omit(s,
               FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | (how.light ? FEATURE_ROTARY_INERTIA : 0));
    const int push = scene_add_load(s, SCENE_FORCE, B, 0, 3, 1);
    scene_load_piece(s, push, 0.04, "t/0.04");
    scene_load_piece(s, push, 0, "1 - t");
    const int lift = scene_add_moving_driver(s, "lift");
    scene_drive_piece(s, lift, 0, "0.1*t^2");
    scene_drive(s, A, SCENE_UZ, lift);
    const int motion = add_motion(s);
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "tip_%d", c);
        scene_add_quantity(s, name, c < SCENE_RX ? "m" : "rad", motion, scene_coordinate(B, c));
    }
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    return STATUS_OK;
}

static void against_radau(const char *chosen)
{
    cell_result one, other;
    how.time = 0.08;
    how.step = 1e-3;
    how.tolerance = 1e-10;
    how.scheme = SCENE_EXPLICIT;
    cells_solve(rod, chosen, 2, &one);
    how.scheme = SCENE_RADAU;
    cells_solve(rod, chosen, 2, &other);
    for (int i = 0; i < one.solve.quantities && i < other.solve.quantities; i++)
        gsl_test_abs(one.solve.quantity[i].value, other.solve.quantity[i].value, 1e-8, "%s: %s",
                     chosen, one.scene.quantity[i].name);
    gsl_test(fabs(cells_value(&one, "tip_1")) < 1e-3, "%s: it moves, by %g m", chosen,
             cells_value(&one, "tip_1"));
    cell_result_free(&one);
    cell_result_free(&other);
}

static void refused(const char *chosen, const char *words)
{
    static const parameter_type none[] = {{0}};
    const case_type type = {.name = "of_the_test",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = rod};
    cell_result r;
    fault f = {""};
    how.scheme = SCENE_EXPLICIT;
    const cell_request request = cells_of(&type, chosen, 2);
    const status outcome = cell_run(&request, &r, &f);
    const char *why = outcome == STATUS_OK ? r.solve.reason : f.text;
    gsl_test((outcome == STATUS_OK ? r.solve.status : outcome) != STATUS_REFUSED ||
                 strstr(why, words) == NULL,
             "%s is refused for '%s': %s", chosen, words, why);
    cell_result_free(&r);
}

static void explicit_tests(void)
{
    static const char *const chosen[] = {"geometrically_exact", "collocation", "beamw_consistent",
                                         "sheet_third"};
    free_body();
    for (int i = 0; i < 4; i++)
        against_radau(chosen[i]);
    how.light = 1;
    refused("geometrically_exact", "the rotation of node");
    how.light = 0;
    how.released = 1;
    refused("geometrically_exact", "released ends");
}

static const double along[3] = {0.48, -0.6, 0.64}, other[3] = {0.7, 0.4, -0.9}, step = 1e-4;

/* Computes the rotation vector of exp(-t~) exp(s~). */
static void between(const double t[3], const double s[3], double out[3])
{
    double p[4], q[4], back[4];
    rotation_exp(t, p);
    rotation_exp(s, q);
    rotation_conjugate(p, back);
    rotation_compose(back, q, q);
    rotation_log(q, out);
}

static void differ(void (*f)(const double t[3], double out[3]), const double t[3],
                   const double d[3], double out[3])
{
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < 4; k++) {
        double moved[3], value[3];
        for (int i = 0; i < 3; i++)
            moved[i] = t[i] + at[k] * step * d[i];
        f(moved, value);
        for (int i = 0; i < 3; i++)
            out[i] += weight[k] * value[i] / (12 * step);
    }
}

static double begin[3];

static void turned(const double t[3], double out[3])
{
    between(begin, t, out);
}

static void rates(const double t[3], double out[3])
{
    double Jr[9];
    rotation_rates_jacobian(t, Jr);
    mat3_mul_vec(Jr, other, out);
}

static void check(const char *what, double angle, const double found[3], const double expected[3])
{
    double largest = 0;
    for (int i = 0; i < 3; i++)
        largest = worst_of(largest, fabs(found[i] - expected[i]));
    gsl_test(!(largest < 1e-10), "%s at %g rad: %g", what, angle, largest);
}

static void turn(double angle)
{
    double Jr[9], inverse[9], D[9], found[3], expected[3], back[3];
    for (int i = 0; i < 3; i++)
        begin[i] = angle * along[i];
    rotation_rates_jacobian(begin, Jr);
    mat3_mul_vec(Jr, other, found);
    differ(turned, begin, other, expected);
    check("angular velocity", angle, found, expected);
    rotation_rates_inverse(begin, inverse);
    mat3_mul_vec(inverse, found, back);
    check("inverse", angle, back, other);
    rotation_rates_derivative(begin, other, D);
    for (int k = 0; k < 3; k++) {
        const double axis[3] = {k == 0, k == 1, k == 2};
        mat3_mul_vec(D, axis, found);
        differ(rates, begin, axis, expected);
        check("derivative", angle, found, expected);
    }
    memcpy(found, begin, sizeof found);
    rotation_rates_add(found, other);
    between(begin, found, back);
    check("one turn behind another", angle, back, other);
}

static void seam(double angle)
{
    static const char *const what[] = {"Jr", "its inverse", "its derivative"};
    double value[2][3][9], t[3];
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < 3; i++)
            t[i] = angle * (side ? 1 + 1e-14 : 1 - 1e-14) * along[i];
        rotation_rates_jacobian(t, value[side][0]);
        rotation_rates_inverse(t, value[side][1]);
        rotation_rates_derivative(t, other, value[side][2]);
    }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 9; i++)
            gsl_test_abs(value[1][k][i], value[0][k][i], 2e-15, "%s at %g rad, entry %d", what[k],
                         angle, i);
}

static void turning_tests(void)
{
    static const double angle[] = {0, 1e-3, 0.02, 0.0499, 0.0501, 0.4, 1.3, 1.9};
    for (int i = 0; i < (int)(sizeof angle / sizeof angle[0]); i++)
        turn(angle[i]);
    seam(0.05);
}

int main(void)
{
    explicit_tests();
    turning_tests();
    return gsl_test_summary();
}
