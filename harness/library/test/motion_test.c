/* A motion in time through the interface: values and when they were reached, curves, every step
 * with its energies, and frames. */
#include <math.h>
#include <stdlib.h>

#include "harness/library/test/leaf.h"

/* A tip mass on an arm that falls from rest. */
static const char falling[] =
    "beamwork: 1\n"
    "sections:\n"
    "  tube: {tube: {diameter: 20e-3, thickness: 1e-3}, young: 70e9, shear_modulus: 26e9, density: "
    "2700}\n"
    "nodes:\n"
    "  pin: {at: [0, 0, 0], hold: [ux, uy, uz, rx, ry]}\n"
    "  tip: {at: [1, 0, 0], mass: 0.3}\n"
    "members:\n"
    "  arm: {from: pin, to: tip, section: tube, y: [0, 1, 0]}\n"
    "loads:\n"
    "  weight: {gravity: [0, -9.81, 0], on: arm}\n"
    "  weight_of_tip: {gravity: [0, -9.81, 0], on: tip}\n"
    "analyses:\n"
    "  fall: {motion: {stations: 0..1/10, step: 0.01, integrator: conserving}}\n"
    "quantities:\n"
    "  lowest: {displacement: {analysis: fall, node: tip, component: uy, take: min}}\n"
    "  way: {displacement: {analysis: fall, node: tip, component: uy, take: curve}}\n"
    "  kinetic: {energy: {analysis: fall, of: kinetic}}\n"
    "omit: [trapeze, wagner_moments, wagner_torque]\n";

static double largest(size_t count, const double value[])
{
    double out = 0;
    for (size_t i = 0; i < count; i++)
        out = fmax(out, fabs(value[i]));
    return out;
}

static void steps(bw_result *r)
{
    const double *time = NULL, *kinetic = NULL, *drift = NULL, *none = NULL;
    const size_t count = bw_result_motion(r, "time", &time);
    gsl_test(count < 20 || time[0] != 0 || time[count - 1] != 1, "%d steps from 0 to 1 s",
             (int)count);
    if (count == 0)
        return;
    gsl_test(bw_result_motion(r, "kinetic", &kinetic) != count ||
                 kinetic[count - 1] != bw_result_value(r, "kinetic"),
             "the last step has the energy that is read at the end");
    gsl_test(bw_result_motion(r, "drift", &drift) != count ||
                 largest(count, drift) > 1e-11 * largest(count, kinetic),
             "conserving steps miss no energy");
    gsl_test(bw_result_motion(r, "nonsense", &none) != 0 || none != NULL ||
                 bw_result_motion(r, NULL, NULL) != 0 || bw_result_motion(NULL, "time", &none) != 0,
             "no such column, and no result");
}

static void readings(bw_result *r)
{
    const double *x = NULL, *y = NULL, *places = NULL;
    const double when = bw_result_at(r, "lowest");
    gsl_test(!(when > 0.3 && when < 0.6) || !(bw_result_value(r, "lowest") < -0.98),
             "the lowest place, at %g s", when);
    gsl_test(bw_result_at(r, "kinetic") != 1, "what is read at the end is of the end");
    gsl_test(bw_result_curve(r, "way", &x, &y) != 11 || x[10] != 1 || y[0] != 0,
             "a curve over time");
    gsl_test(!isnan(bw_result_at(r, "way")) || !isnan(bw_result_at(r, "nothing")) ||
                 !isnan(bw_result_at(NULL, "way")),
             "a curve is nowhere in particular");
    const size_t states = bw_result_shapes(r, NULL, &places);
    gsl_test(states != 9 || strcmp(bw_result_shape_kind(r, 8), "motion") != 0 ||
                 bw_result_shape_value(r, 8) != 1,
             "eight frames, the last one at the end");
}

int main(void)
{
    char *why = NULL;
    bw_scene *s = NULL;
    bw_result *r = NULL;
    WELL(bw_scene_read(falling, sizeof falling - 1, "falling", &s, &why), "a scene that moves");
    WELL(bw_solve(s, "collocation", 2, "{\"shapes\": 8}", &r, &why), "its motion");
    steps(r);
    readings(r);
    bw_result_free(r);
    bw_scene_free(s);
    WELL(bw_scene_read(leaf, sizeof leaf - 1, "leaf", &s, &why), "a scene that does not");
    WELL(bw_solve(s, "collocation", 2, NULL, &r, &why), "its solution");
    gsl_test(bw_result_motion(r, "time", NULL) != 0 || !isnan(bw_result_at(r, "tip_uy")),
             "has no steps in time, and no time");
    bw_result_free(r);
    bw_scene_free(s);
    return gsl_test_summary();
}
