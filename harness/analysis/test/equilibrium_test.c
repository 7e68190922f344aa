/* Frequencies and critical loads about a loaded state: limits that linear theory knows, and what is
 * refused. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"
#include "harness/tools/kit/scenes.h"

static double value_of(const char *case_name, const char *chosen, int n,
                       const char *const assignment[], const char *quantity)
{
    cell_request request = cells_of(case_find(case_name, NULL), chosen, n);
    cell_result r;
    fault f = {""};
    cells_set(&request, assignment);
    gsl_test(cell_run(&request, &r, &f) != STATUS_OK, "%s solved with %s: %s", case_name, chosen,
             f.text);
    const double value = cells_value(&r, quantity);
    cell_result_free(&r);
    return value;
}

/* Strong bending 1e6 times as stiff as weak: what linear prestress says, 4.012599344, and the first
 * power of 1/ratio beyond it. */
static void stiff_before_buckling(void)
{
    const char *const included[] = {"prebuckling=included", "ratio=1e6", NULL};
    const double linear = 4.012599344,
                 of_1e4 = 4.013057842318; /* derive/linear_buckling.py, derive/equilibrium.py */
    gsl_test_rel(value_of("lateral_buckling", "collocation", 4, included, "load_factor"),
                 linear + (of_1e4 - linear) / 100, 1e-8,
                 "critical load, hardly any deflection before it");
}

/* Exact: derive/equilibrium.py. */
static void deflected_before_buckling(void)
{
    static const struct {
        const char *ratio;
        double load;
    } exact[] = {{"ratio=10", 4.624628010365}, {"ratio=4", 7.053702891992}};
    for (int i = 0; i < 2; i++) {
        const char *const included[] = {"prebuckling=included", exact[i].ratio, NULL};
        gsl_test_rel(value_of("lateral_buckling", "collocation", 4, included, "load_factor"),
                     exact[i].load, 1e-7, "collocation, %s: critical load", exact[i].ratio);
    }
}

/* A cantilever of unit constants under a dead tip force P along -x or a dead tip moment M about z,
 * then an analysis about it. */
static status solve_column(scene_analysis_kind kind, double P, double M, double end, double *value,
                           fault *f)
{
    scene s;
    model *m = NULL;
    formulation fm;
    solve_result r;
    section_spec spec = sections_of(1e6, 2, 1, 1);
    spec.density = 1;
    scene_init(&s, "column");
    const int tip = scenes_cantilever(&s, &spec);
    if (P != 0)
        scene_add_load(&s, SCENE_FORCE, tip, -P, 0, 0);
    if (M != 0)
        scene_add_load(&s, SCENE_MOMENT, tip, 0, 0, M);
    const int path = scene_add_static(&s, 1, &end, 1);
    const int about =
        kind == SCENE_MODAL ? scene_add_modal(&s, path) : scene_add_buckling(&s, path);
    scene_add_quantity(&s, "wanted", "1", about,
                       kind == SCENE_MODAL ? scene_frequency(0, SCENE_ANY)
                                           : scene_critical_factor(1, 0));
    gsl_test(formulation_parse("beamw", &fm, f) != STATUS_OK, "beamw exists");
    const model_request what = {&s, fm.type, fm.option, 16, 0};
    status outcome = model_alloc(&what, &m, f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&s, m, NULL, &r, f);
        *value = r.quantity[0].value;
        result_free(&r);
    }
    model_free(m);
    scene_free(&s);
    return outcome;
}

static void columns(void)
{
    const double euler = PI * PI / 4;
    double value = NAN, rest = NAN;
    fault f = {""};
    gsl_test(solve_column(SCENE_BUCKLING, 1, 0, 0.5, &value, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test_rel(value, euler, 1e-4, "Euler's load on the nonlinear path");
    gsl_test(solve_column(SCENE_BUCKLING, 10, 0, 1, &value, &f) != STATUS_OK, "column: %s", f.text);
    gsl_test_rel(10 * value, euler, 1e-4, "Euler's load from a state beyond it");
    gsl_test(solve_column(SCENE_MODAL, euler, 0, 1e-9, &rest, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test_rel(2 * PI * rest, 1.8751040687 * 1.8751040687 / sqrt(1e6), 2e-3,
                 "first frequency of the unloaded column");
    gsl_test(solve_column(SCENE_MODAL, euler, 0, 0.999, &value, &f) != STATUS_OK, "column: %s",
             f.text);
    gsl_test(!(value > 0) || !(value < 0.05 * rest),
             "its frequency falls to zero at Euler's load: %g of %g Hz", value, rest);
}

static void refused(void)
{
    double value = NAN;
    fault f = {""};
    gsl_test(solve_column(SCENE_MODAL, 10, 0, 1, &value, &f) != STATUS_REFUSED ||
                 strstr(f.text, "critical") == NULL,
             "frequencies of a state beyond the critical load: %s", f.text);
    gsl_test(solve_column(SCENE_MODAL, 0, 1, 1, &value, &f) != STATUS_OK,
             "a moment dead about fixed axes has no potential, but frequencies: %s", f.text);
    gsl_test_rel(2 * PI * value, 1.8751040687 * 1.8751040687 / sqrt(1e6), 0.3,
                 "first frequency under a moment");
    gsl_test(solve_column(SCENE_BUCKLING, -1, 0, 1, &value, &f) != STATUS_NOT_CONVERGED ||
                 strstr(f.text, "no critical load") == NULL,
             "tension: %s", f.text);
}

int main(void)
{
    stiff_before_buckling();
    deflected_before_buckling();
    columns();
    refused();
    return gsl_test_summary();
}
