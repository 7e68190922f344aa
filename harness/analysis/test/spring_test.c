/* Structures with springs against closed forms: a beam on rotational springs (deflection, buckling,
 * frequency), a sprung cantilever rolled up by a moment, a spring between two bodies that move. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/pi.h"
#include "harness/analysis/test/hinged.h"
#include "harness/tools/kit/scenes.h"

#define SPRINGS "harness/analysis/test/springs.yaml"

static const double length = 1.3, kappa = 3.7; /* kappa: of the springs, in EI/L */

static void check(const cell_result *r, int i, double exact, double allowed, const char *chosen)
{
    if (i < r->solve.quantities)
        gsl_test_rel(r->solve.quantity[i].value, exact, allowed, "%s: %s", chosen,
                     r->scene.quantity[i].name);
    else
        gsl_test(1, "%s: quantity %d is there", chosen, i);
}

/* Moments about the origin of forces and moments at two nodes, and the load. */
static void equilibrium(const cell_result *r, const char *chosen)
{
    const double load[3] = {0.3, 1, 0.2},
                 at[3][3] = {{0, 0, 0}, {length, 0.4, 0.3}, {length, 0, 0}};
    double R[6], G[6], sprung[3] = {0};
    for (int i = 0; i < 6; i++) {
        R[i] = r->solve.quantity[2 + i].value;
        G[i] = r->solve.quantity[8 + i].value;
    }
    sprung[1] = -kappa * 3 * EI / gsl_pow_3(length) * r->solve.quantity[14].value;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        gsl_test_abs(R[i] + G[i] + sprung[i] + load[i], 0, 1e-9, "%s: forces along %d", chosen, i);
        gsl_test_abs(R[3 + i] + G[3 + i] + at[1][j] * G[k] - at[1][k] * G[j] +
                         at[2][j] * (sprung[k] + load[k]) - at[2][k] * (sprung[j] + load[j]),
                     0, 1e-9, "%s: moments about %d", chosen, i);
    }
}

/* A cantilever with a spring at its tip, and a second body at it on a spring of six entries: the
 * tip's spring takes its part of the load, the clamp and the ground the rest. */
static void supported(const char *chosen)
{
    cell_result r;
    scenes_solve(SPRINGS, chosen, 4, &r, "of=tip");
    check(&r, 0, length / (1 + kappa), 1e-6, chosen);
    check(&r, 1, length / 2 / (1 + kappa), 1e-6, chosen);
    equilibrium(&r, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, 4, &r, "of=tip_and_edge");
    equilibrium(&r, chosen);
    cell_result_free(&r);
}

/* Half the wave number times the length: tan u = -2 u/kappa, tan u + tanh u = -4 u/kappa. */
static double buckled(double u)
{
    return sin(u) + 2 * u / kappa * cos(u);
}

static double vibrating(double u)
{
    return sin(u) + cos(u) * (tanh(u) + 4 * u / kappa);
}

static void closed_forms(const char *chosen, int n, double allowed)
{
    cell_result r;
    scenes_solve(SPRINGS, chosen, n, &r, "of=beam");
    const double L3 = length * length * length, u = hinged_zero(buckled, PI / 2, PI),
                 v = 2 * hinged_zero(vibrating, PI / 2, PI) / length;
    check(&r, 0, L3 / (48 * EI) * (1 - 0.75 * kappa / (2 + kappa)), allowed, chosen);
    check(&r, 1, v * v * sqrt(EI / mass) / (2 * PI), allowed, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, n, &r, "of=column");
    check(&r, 0, EI * 4 * u * u / (length * length), allowed, chosen);
    cell_result_free(&r);
    scenes_solve(SPRINGS, chosen, n, &r, "of=roll");
    const double turned = 2.9 / kappa, bent = 2.9;
    check(&r, 0, length * ((sin(turned + bent) - sin(turned)) / bent - 1), allowed, chosen);
    check(&r, 1, length * (cos(turned) - cos(turned + bent)) / bent, allowed, chosen);
    cell_result_free(&r);
}

/* A very stiff spring is a rigid body. */
static void stiff(const char *chosen)
{
    cell_result sprung, rigid;
    scenes_solve(SPRINGS, chosen, 3, &sprung, "of=sprung_body");
    scenes_solve(SPRINGS, chosen, 3, &rigid, "of=body");
    gsl_test_int(rigid.solve.quantities, 17, "%s: all quantities", chosen);
    for (int i = 0; i < rigid.solve.quantities; i++)
        check(&sprung, i, rigid.solve.quantity[i].value, 3e-6, chosen);
    cell_result_free(&sprung);
    cell_result_free(&rigid);
}

int main(void)
{
    supported("geometrically_exact");
    supported("beamw_consistent");
    supported("collocation");
    stiff("geometrically_exact");
    stiff("beamw_consistent");
    stiff("beamw_consistent:newton=displacement");
    static const char *const chosen[] = {"geometrically_exact", "beamw_consistent",
                                         "beamw_consistent:newton=displacement",
                                         "beamw_consistent:newton=dense"};
    for (int i = 0; i < 4; i++)
        closed_forms(chosen[i], i == 0 ? 32 : 12, 1e-5);
    closed_forms("sheet_third", 96, 1e-3);
    closed_forms("collocation", 96, 1e-3);
    return gsl_test_summary();
}
