/* Structures with hinges against closed forms: a beam with an inner hinge, a frame with three,
 * columns, vibration, a truss that snaps. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/pi.h"
#include "harness/analysis/test/hinged.h"
#include "harness/tools/kit/accepted.h"

static const double z_axis[3] = {0, 0, 1};

/* Clamped to a hinge at 0.8 m, from there to a roller at 2 m: force 5 N at the hinge, 3 N/m behind
 * it. */
static status build_beam(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              hinge = scene_add_node(s, 0.8, 0, 0), end = scene_add_node(s, 2, 0, 0);
    scene_hold_all(s, root);
    scene_hold(s, end, SCENE_UY, SCENE_RY);
    const int first = scene_add_member(s, root, hinge, profile, y_axis),
              second = scene_add_member(s, hinge, end, profile, y_axis);
    scene_release_end(s, second, 0, SCENE_RZ);
    scene_add_load(s, SCENE_FORCE, hinge, 0, -5, 0);
    scene_add_load(s, SCENE_DISTRIBUTED, second, 0, -3, 0);
    const int linear = scene_add_linear(s);
    scene_add_quantity(s, "deflection", "m", linear, scene_coordinate(hinge, SCENE_UY));
    scene_add_quantity(s, "roller", "N", linear, scene_internal_at(second, 1, SCENE_QY));
    scene_add_quantity(s, "moment", "N m", linear, scene_internal_at(first, 0, SCENE_MZ));
    scene_add_quantity(s, "left", "N m", linear, scene_internal_at(first, 1, SCENE_MZ));
    scene_add_quantity(s, "right", "N m", linear, scene_internal_at(second, 0, SCENE_MZ));
    return STATUS_OK;
}

/* Two legs of 3 m and two rafters that meet in a hinge 1 m higher, span 4 m: pinned feet, 2 N on
 * the crown. */
static status build_frame(const double value[], scene *s, fault *f)
{
    static const double at[5][2] = {{0, 0}, {0, 3}, {2, 4}, {4, 3}, {4, 0}};
    (void)value;
    (void)f;
    const int profile = add_section(s);
    for (int i = 0; i < 5; i++)
        scene_add_node(s, at[i][0], at[i][1], 0);
    for (int i = 0; i < 4; i++)
        scene_add_member(s, i, i + 1, profile, z_axis);
    for (int i = 0; i < 5; i += 4) {
        scene_hold_all(s, i);
        scene_release_end(s, i > 0 ? 3 : 0, i > 0,
                          SCENE_RY); /* z lies across the plane, so y' does */
    }
    scene_release_end(s, 2, 0, SCENE_RY);
    scene_add_load(s, SCENE_FORCE, 2, 0, -2, 0);
    const int linear = scene_add_linear(s);
    scene_add_quantity(s, "thrust", "N", linear, scene_internal_at(0, 0, SCENE_QZ));
    scene_add_quantity(s, "lift", "N", linear, scene_internal_at(3, 1, SCENE_N));
    scene_add_quantity(s, "corner", "N m", linear, scene_internal_at(0, 1, SCENE_MY));
    scene_add_quantity(s, "crown", "N m", linear, scene_internal_at(2, 0, SCENE_MY));
    scene_add_quantity(s, "foot", "N m", linear, scene_internal_at(0, 0, SCENE_MY));
    return STATUS_OK;
}

/* Clamped at both ends, 2 m long with a hinge in the middle; the far end slides along it under
 * load. */
static status build_column(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              hinge = scene_add_node(s, 1, 0, 0), end = scene_add_node(s, 2, 0, 0);
    scene_hold_all(s, root);
    scene_hold(s, end, SCENE_UY, SCENE_RZ);
    scene_hold(s, hinge, SCENE_UZ, SCENE_RY);
    scene_add_member(s, root, hinge, profile, y_axis);
    scene_release_end(s, scene_add_member(s, hinge, end, profile, y_axis), 0, SCENE_RZ);
    scene_add_load(s, SCENE_FORCE, end, -1, 0, 0);
    scene_add_quantity(s, "critical", "N", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    return STATUS_OK;
}

static status build_vibration(const double value[], scene *s, fault *f)
{
    build_column(value, s, f);
    s->loads = s->analyses = s->quantities = 0;
    const int modal = scene_add_modal(s, SCENE_NONE);
    scene_add_quantity(s, "first", "Hz", modal, scene_frequency(0, SCENE_ANY));
    scene_add_quantity(s, "second", "Hz", modal, scene_frequency(1, SCENE_ANY));
    return STATUS_OK;
}

/* Euler's columns: both ends of a member between clamped nodes released, or one. value: how many.
 */
static status euler(int released, scene *s)
{
    const int profile = add_section(s), root = scene_add_node(s, 0, 0, 0),
              end = scene_add_node(s, 1, 0, 0);
    scene_hold_all(s, root);
    scene_hold(s, end, SCENE_UY, SCENE_RZ);
    const int member = scene_add_member(s, root, end, profile, y_axis);
    for (int i = 0; i < released; i++)
        scene_release_end(s, member, i, SCENE_RZ);
    scene_add_load(s, SCENE_FORCE, end, -1, 0, 0);
    scene_add_quantity(s, "critical", "N", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0));
    return STATUS_OK;
}

static status build_pinned(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    return euler(2, s);
}

static status build_half_pinned(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    return euler(1, s);
}

/* Two bars of a flat roof, all ends hinged across them, pushed through by its crown: 4 m wide, 0.6
 * m high. */
static status build_roof(const double value[], scene *s, fault *f)
{
    static const double path[] = {0, 1}, down[] = {0, -1.5};
    (void)value;
    (void)f;
    const int profile = add_section(s), left = scene_add_node(s, -2, 0, 0),
              right = scene_add_node(s, 2, 0, 0), crown = scene_add_node(s, 0, 0.6, 0),
              driver = scene_add_driver(s, "down", 2, path, down);
    scene_hold_all(s, left);
    scene_hold_all(s, right);
    scene_hold(s, crown, SCENE_UZ, SCENE_RZ);
    scene_drive(s, crown, SCENE_UY, driver);
    for (int i = 0; i < 2; i++) {
        const int member = scene_add_member(s, i ? right : left, crown, profile, y_axis);
        for (int end = 0; end < 4; end++)
            scene_release_end(s, member, end / 2, end % 2 ? SCENE_RZ : SCENE_RY);
    }
    const int statics = scene_add_static(s, 1, &path[1], 4);
    scene_add_quantity(s, "force", "N", statics, scene_reaction(crown, SCENE_UY));
    scene_add_quantity(s, "thrust", "N", statics, scene_internal_at(0, 1, SCENE_N));
    scene_add_quantity(s, "hinge", "N m", statics, scene_internal_at(1, 0, SCENE_MZ));
    return STATUS_OK;
}

/* scale: of a value that is zero. */
static void check(const cell_result *r, int i, double exact, double allowed, double scale,
                  const char *chosen)
{
    const int there = i < r->solve.quantities;
    const double value = there ? r->solve.quantity[i].value : NAN,
                 size = exact != 0 ? fabs(exact) : scale;
    gsl_test(!(fabs(value - exact) <= allowed * size), "%s: %s is %.15g, not %.15g", chosen,
             there ? r->scene.quantity[i].name : "a quantity", value, exact);
}

/* Nodally exact where nothing but bending and stretching is: with one element for each member. */
static void statics(const char *chosen, double allowed)
{
    cell_result r;
    const double V = -5 - 3 * 1.2 / 2;
    cells_solve(build_beam, chosen, 1, &r);
    check(&r, 0, V * 0.512 / (3 * EI), allowed, 0, chosen);
    check(&r, 1, 3 * 1.2 / 2, 1e-9, 0, chosen);
    check(&r, 2, 0.8 * V, 1e-9, 0, chosen);
    check(&r, 3, 0, 1e-12, 5, chosen);
    check(&r, 4, 0, 1e-12, 5, chosen);
    cell_result_free(&r);
    cells_solve(build_frame, chosen, 1, &r);
    check(&r, 0, -2 * 4.0 / 4 / 4, 1e-6, 0, chosen);
    check(&r, 1, -1, 1e-6, 0, chosen);
    check(&r, 2, -1.5, 1e-6, 0, chosen);
    check(&r, 3, 0, 1e-10, 1.5, chosen);
    check(&r, 4, 0, 1e-10, 1.5, chosen);
    cell_result_free(&r);
}

static double clamped_free(double u)
{
    return cos(u) + 1 / cosh(u);
}

static double clamped_pinned(double u)
{
    return sin(u) - cos(u) * tanh(u);
}

static double hertz(double u)
{
    return u * u * sqrt(EI / mass) / (2 * PI);
}

static void eigenvalues(const char *chosen, int n, double allowed)
{
    cell_result r;
    cells_solve(build_column, chosen, n, &r);
    check(&r, 0, PI * PI * EI / 4, allowed, 0, chosen);
    cell_result_free(&r);
    cells_solve(build_pinned, chosen, n, &r);
    check(&r, 0, PI * PI * EI, allowed, 0, chosen);
    cell_result_free(&r);
    cells_solve(build_half_pinned, chosen, n, &r);
    check(&r, 0, gsl_pow_2(4.493409457909064) * EI, allowed, 0, chosen);
    cell_result_free(&r);
    cells_solve(build_vibration, chosen, n, &r);
    check(&r, 0, hertz(hinged_zero(clamped_free, 1, 3)), allowed, 0, chosen);
    check(&r, 1, hertz(hinged_zero(clamped_pinned, 3, 4.5)), allowed, 0, chosen);
    cell_result_free(&r);
}

/* Bars that only stretch. */
static void roof(const char *chosen)
{
    cell_result r;
    const double l0 = hypot(2, 0.6), l = hypot(2, 0.9), N = EA * (l - l0) / l0;
    cells_solve(build_roof, chosen, 1, &r);
    check(&r, 0, -2 * N * 0.9 / l, 1e-9, 0, chosen);
    check(&r, 1, N, 1e-9, 0, chosen);
    check(&r, 2, 0, 1e-9, EI, chosen);
    cell_result_free(&r);
}

int main(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        statics(accepted_at(i)->name, 1e-2);
        roof(accepted_at(i)->name);
    }
    eigenvalues("beamw", 16, 1e-5);
    eigenvalues("geometrically_exact", 32, 1e-5);
    eigenvalues("collocation", 32, 3e-3);
    return gsl_test_summary();
}
