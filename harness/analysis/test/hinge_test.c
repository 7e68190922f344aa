/* Hinges compared with closed forms: a beam, a three-hinged frame, columns, vibration, and
 * snap-through of a truss. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "elements/math/scalar.h"
#include "harness/analysis/test/hinged.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/accepted.h"
#include "harness/tools/kit/scenes.h"

#define HINGES "harness/analysis/test/hinges.yaml"

static void check(const cell_result *r, int i, double exact, double allowed, double scale,
                  const char *chosen)
{
    const int there = i < r->solve.quantities;
    const double value = there ? r->solve.quantity[i].value : NAN,
                 size = exact != 0 ? fabs(exact) : scale;
    gsl_test(!(fabs(value - exact) <= allowed * size), "%s: %s is %.15g, not %.15g", chosen,
             there ? r->scene.quantity[i].name : "a quantity", value, exact);
}

static void statics(const char *chosen, double allowed)
{
    cell_result r;
    const double V = -5 - 3 * 1.2 / 2;
    scenes_solve(HINGES, chosen, 1, &r, "of=beam");
    check(&r, 0, V * 0.512 / (3 * EI), allowed, 0, chosen);
    check(&r, 1, 3 * 1.2 / 2, 1e-9, 0, chosen);
    check(&r, 2, 0.8 * V, 1e-9, 0, chosen);
    check(&r, 3, 0, 1e-12, 5, chosen);
    check(&r, 4, 0, 1e-12, 5, chosen);
    cell_result_free(&r);
    scenes_solve(HINGES, chosen, 1, &r, "of=frame");
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
    scenes_solve(HINGES, chosen, n, &r, "of=column");
    check(&r, 0, PI * PI * EI / 4, allowed, 0, chosen);
    cell_result_free(&r);
    scenes_solve(HINGES, chosen, n, &r, "of=euler;released=2");
    check(&r, 0, PI * PI * EI, allowed, 0, chosen);
    cell_result_free(&r);
    scenes_solve(HINGES, chosen, n, &r, "of=euler;released=1");
    check(&r, 0, gsl_pow_2(4.493409457909064) * EI, allowed, 0, chosen);
    cell_result_free(&r);
    scenes_solve(HINGES, chosen, n, &r, "of=vibration");
    check(&r, 0, hertz(hinged_zero(clamped_free, 1, 3)), allowed, 0, chosen);
    check(&r, 1, hertz(hinged_zero(clamped_pinned, 3, 4.5)), allowed, 0, chosen);
    cell_result_free(&r);
}

static void roof(const char *chosen)
{
    cell_result r;
    const double l0 = hypot(2, 0.6), l = hypot(2, 0.9), N = EA * (l - l0) / l0;
    scenes_solve(HINGES, chosen, 1, &r, "of=roof");
    check(&r, 0, -2 * N * 0.9 / l, 1e-9, 0, chosen);
    check(&r, 1, N, 1e-9, 0, chosen);
    check(&r, 2, 0, 1e-9, EI, chosen);
    cell_result_free(&r);
}

enum { REACTIONS = 3 };

static void axes(const char *of, const char *chosen, int n, unsigned released, double least)
{
    cell_result r;
    scenes_solve(HINGES, chosen, n, &r, "of=%s", of);
    gsl_test_int(r.solve.quantities, 2 * REACTIONS, "%s: reactions", chosen);
    double largest = 0;
    for (int i = 0; i < r.solve.quantities; i++)
        largest = fmax(largest, fabs(r.solve.quantity[i].value));
    gsl_test(!(largest > least), "%s: the clamps hold %g", chosen, largest);
    for (int i = 0; i < r.solve.quantities; i++)
        gsl_test((fabs(r.solve.quantity[i].value) <= 1e-9 * largest) != (released >> i & 1u),
                 "%s: %s is %.3g of %.3g", chosen, r.scene.quantity[i].name,
                 r.solve.quantity[i].value, largest);
    cell_result_free(&r);
}

static void hinge_tests(void)
{
    for (int i = 0; accepted_at(i) != NULL; i++) {
        statics(accepted_at(i)->name, 1e-2);
        roof(accepted_at(i)->name);
    }
    eigenvalues("beamw", 16, 1e-5);
    eigenvalues("geometrically_exact", 32, 1e-5);
    eigenvalues("collocation", 32, 3e-3);
    axes("angle", "beamw_consistent", 3, 1U << 2 | 1U << 4, 1e-3);
    axes("angle", "collocation", 2, 1U << 2 | 1U << 4, 1e-3);
    axes("angle", "geometrically_exact", 4, 1U << 2 | 1U << 4, 1e-3);
    for (int n = 1; n < 8; n += 3) {
        axes("arc", "geometrically_exact", n, 1U << 4, 0.1);
        axes("arc", "beamw", 2 * n, 1U << 4, 0.1);
    }
}

#define SPRINGS "harness/analysis/test/springs.yaml"

static void supported(const char *chosen, int dense)
{
    static const char *const released[] = {"hinge", "two_turns", "ball", "slide"};
    for (int k = 0; k < 4; k++) {
        cell_result at_support, at_node;
        scenes_solve(SPRINGS, chosen, 4, &at_support, "of=support;released=%s;about=%d",
                     released[k], !dense);
        scenes_solve(SPRINGS, chosen, 4, &at_node, "of=end;released=%s;about=%d", released[k],
                     !dense);
        const int requested = dense ? 19 : 23;
        gsl_test(at_node.solve.quantities != requested || at_support.solve.quantities != requested,
                 "%s, %s: %d quantities", chosen, released[k], at_node.solve.quantities);
        for (int i = 0; i < at_node.solve.quantities; i++) {
            const double expected = at_support.solve.quantity[i].value,
                         value = at_node.solve.quantity[i].value;
            gsl_test(!(fabs(value - expected) <= 1e-8 * fabs(expected) + 1e-11),
                     "%s, %s: %s is %.12g, at a support %.12g (%s)", chosen, released[k],
                     at_node.scene.quantity[i].name, value, expected,
                     at_node.solve.quantity[i].reason);
        }
        cell_result_free(&at_support);
        cell_result_free(&at_node);
    }
}

static void hinge_support_tests(void)
{
    static const char *const newton[] = {"", ":newton=displacement", ":newton=dense"};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int k = 0; k < 3; k++) {
            char chosen[80];
            snprintf(chosen, sizeof chosen, "%s%s", registry_formulations[i]->name, newton[k]);
            supported(chosen, k == 2);
        }
}

int main(void)
{
    hinge_tests();
    hinge_support_tests();
    return gsl_test_summary();
}
