/* Every failing call must return a status and a message of one line. */
#include <math.h>
#include <stdlib.h>

#include "harness/library/test/leaf.h"

static bw_scene *scene_of(const char *name)
{
    bw_scene *s = NULL;
    char *why = NULL;
    WELL(bw_scene_case(name, &s, &why), name);
    return s;
}

static void names(void)
{
    char *why = NULL, *text = NULL;
    bw_scene *s = NULL;
    FAILS(bw_scene_case("c_colum", &s, &why), BW_REFUSED, "did you mean 'c_column'");
    gsl_test(s != NULL, "no scene after a failure");
    FAILS(bw_list("collocaton", &text, &why), BW_REFUSED, "did you mean 'collocation'");
    gsl_test(text != NULL, "no text after a failure");
    FAILS(bw_scene_open("/nowhere.yaml", &s, &why), BW_FAULT, "/nowhere.yaml");
    FAILS(bw_formulation_load("./nowhere.so", &text, &why), BW_REFUSED, "nowhere.so");
    FAILS(bw_truths("/nowhere.h5", &why), BW_FAULT, "/nowhere.h5");
    WELL(bw_truths(NULL, &why), "the usual truths again");
    s = scene_of("c_column");
    FAILS(bw_scene_set(s, "lenght=1", &why), BW_REFUSED, "did you mean 'length'");
    FAILS(bw_scene_set(s, "length=-1", &why), BW_REFUSED, "length");
    FAILS(bw_scene_set(s, "length", &why), BW_REFUSED, "length");
    bw_scene_free(s);
}

static void mistakes(void)
{
    static const char text[] = "beamwork: 1\nnodess: {}\n";
    char *why = NULL;
    bw_scene *s = NULL;
    FAILS(bw_scene_read(text, sizeof text - 1, "mine.yaml", &s, &why), BW_REFUSED,
          "\"file\": \"mine.yaml\"");
    FAILS(bw_scene_read(text, sizeof text - 1, NULL, &s, &why), BW_REFUSED,
          "the scene has no key 'nodess'; did you mean 'nodes'?");
    FAILS(bw_scene_read("", 0, "empty.yaml", &s, &why), BW_REFUSED, "empty.yaml");
    FAILS(bw_scene_open("/\xff\n", &s, &why), BW_FAULT, "/?? cannot be read");
}

static void formulations(void)
{
    char *why = NULL, *json = NULL;
    bw_scene *s = scene_of("sheet_cantilever");
    bw_result *r = NULL;
    FAILS(bw_solve(s, "sheet_thrid", 1, NULL, &r, &why), BW_REFUSED, "sheet_third");
    FAILS(bw_solve(s, "", 1, NULL, &r, &why), BW_REFUSED, "formulation");
    FAILS(bw_solve(s, "sheet_third:newtn=dense", 1, NULL, &r, &why), BW_REFUSED, "newton");
    FAILS(bw_solve(s, NULL, -1, NULL, &r, &why), BW_REFUSED, "elements -1");
    FAILS(bw_solve(s, NULL, 10000001, NULL, &r, &why), BW_REFUSED, "10000001");
    gsl_test(r != NULL, "no result after a failure");
    FAILS(bw_converge(s, "beamw beamw", NULL, NULL, &json, &why), BW_REFUSED, "twice");
    FAILS(bw_converge(s, "beamw", "1,,2", NULL, &json, &why), BW_REFUSED, "''");
    FAILS(bw_converge(s, "beamw", "0", NULL, &json, &why), BW_REFUSED, "'0'");
    FAILS(bw_converge(s, "beamw", "", NULL, &json, &why), BW_REFUSED, "''");
    FAILS(bw_converge(s, NULL, NULL, "{\"select\": \"nonsense\"}", &json, &why), BW_REFUSED,
          "nonsense");
    FAILS(bw_verify(s, NULL, "no_such_word", NULL, NULL, &json, &why), BW_REFUSED, "no_such_word");
    FAILS(bw_verify(s, NULL, NULL, NULL, "/nowhere/r.h5", &json, &why), BW_FAULT, "/nowhere");
    gsl_test(json != NULL, "no document after a failure");
    bw_scene_free(s);
}

static void options(void)
{
    static const char *const bad[][2] = {{"{\"step\": 3}", "did you mean 'steps'"},
                                         {"{\"steps\": 0}", "from 1 to"},
                                         {"{\"steps\": 1.5}", "whole number"},
                                         {"{\"steps\": 99999999999}", "whole number"},
                                         {"{\"all_dofs\": 1}", "true or false"},
                                         {"{\"steps\": 3, \"steps\": 4}", "duplicate"},
                                         {"[]", "object"},
                                         {"{", "line 1"},
                                         {"", "line"}};
    char *why = NULL, *json = NULL;
    bw_scene *s = scene_of("sheet_cantilever");
    bw_result *r = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        FAILS(bw_solve(s, "sheet_third", 1, bad[i][0], &r, &why), BW_REFUSED, bad[i][1]);
    FAILS(bw_converge(s, NULL, NULL, "{\"error\": 2}", &json, &why), BW_REFUSED, "between 0 and 1");
    FAILS(bw_converge(s, NULL, NULL, "{\"select\": 2}", &json, &why), BW_REFUSED, "text");
    FAILS(bw_verify(s, NULL, NULL, "{\"jobs\": 0}", NULL, &json, &why), BW_REFUSED, "jobs");
    bw_scene_free(s);
}

static void nothing(void)
{
    char *why = NULL, *text = NULL;
    bw_scene *s = scene_of("sheet_cantilever"), *none = s;
    bw_result *r = NULL;
    const double *x = NULL, *y = NULL;
    const int *first = NULL;
    size_t points = 1;
    FAILS(bw_scene_case(NULL, &none, &why), BW_REFUSED, "bw_scene_case");
    gsl_test(none != NULL, "what was asked for is NULL");
    FAILS(bw_scene_case("c_column", NULL, &why), BW_REFUSED, "bw_scene_case");
    FAILS(bw_scene_read(NULL, 0, NULL, NULL, &why), BW_REFUSED, "bw_scene_read");
    FAILS(bw_scene_open(NULL, NULL, &why), BW_REFUSED, "bw_scene_open");
    FAILS(bw_scene_set(NULL, "a=1", &why), BW_REFUSED, "bw_scene_set");
    FAILS(bw_scene_set(s, NULL, &why), BW_REFUSED, "bw_scene_set");
    FAILS(bw_scene_write(NULL, &text, &why), BW_REFUSED, "bw_scene_write");
    FAILS(bw_scene_write(s, NULL, &why), BW_REFUSED, "bw_scene_write");
    FAILS(bw_scene_json(NULL, &text, &why), BW_REFUSED, "bw_scene_json");
    FAILS(bw_solve(NULL, NULL, 0, NULL, &r, &why), BW_REFUSED, "bw_solve");
    FAILS(bw_solve(s, NULL, 0, NULL, NULL, &why), BW_REFUSED, "bw_solve");
    FAILS(bw_result_json(NULL, &text, &why), BW_REFUSED, "bw_result_json");
    FAILS(bw_converge(NULL, NULL, NULL, NULL, &text, &why), BW_REFUSED, "bw_converge");
    FAILS(bw_converge(s, NULL, NULL, NULL, NULL, &why), BW_REFUSED, "bw_converge");
    FAILS(bw_verify(s, NULL, NULL, NULL, NULL, NULL, &why), BW_REFUSED, "bw_verify");
    FAILS(bw_list(NULL, NULL, &why), BW_REFUSED, "bw_list");
    FAILS(bw_formulation_load(NULL, NULL, &why), BW_REFUSED, "bw_formulation_load");
    gsl_test(bw_scene_case("c_colum", &none, NULL) != BW_REFUSED, "the reason need not be wanted");
    bw_scene_free(s);
    bw_scene_free(NULL);
    bw_result_free(NULL);
    bw_free_text(NULL);
    gsl_test(bw_result_quantities(NULL) != 0 || bw_result_name(NULL, 0) != NULL ||
                 bw_result_unit(NULL, 0) != NULL || !isnan(bw_result_value(NULL, "a")) ||
                 !isnan(bw_result_error(NULL, "a")) || bw_result_elements(NULL) != 0 ||
                 bw_result_formulation(NULL) != NULL,
             "no result has no quantities");
    gsl_test(bw_result_curve(NULL, "a", &x, &y) != 0 || x != NULL || y != NULL ||
                 bw_result_steps(NULL, "path", &x) != 0 || x != NULL ||
                 bw_result_shapes(NULL, &points, &x) != 0 || points != 0 ||
                 bw_result_members(NULL, &first) != 0 || first != NULL ||
                 bw_result_shape_kind(NULL, 0) != NULL || !isnan(bw_result_shape_value(NULL, 0)),
             "and no curves, steps and shapes");
}

static void results(void)
{
    char *why = NULL, *before = NULL, *after = NULL;
    bw_scene *s = NULL;
    bw_result *r = NULL, *second = NULL;
    const double *x = NULL, *y = NULL, *places = NULL;
    const int *first = NULL;
    size_t points = 0;
    WELL(bw_scene_read(leaf, sizeof leaf - 1, "leaf", &s, &why), "a scene of one's own");
    WELL(bw_solve(s, NULL, 0, NULL, &r, &why), "its solution");
    bw_result_json(r, &before, NULL);
    bw_scene_free(s);
    bw_result_json(r, &after, NULL);
    gsl_test(before == NULL || after == NULL || strcmp(before, after) != 0,
             "a result outlives its scene");
    bw_free_text(before);
    bw_free_text(after);
    gsl_test(bw_result_name(r, -1) != NULL || bw_result_name(r, 1000) != NULL ||
                 bw_result_unit(r, 1000) != NULL || !isnan(bw_result_value(r, "nothing")) ||
                 !isnan(bw_result_value(r, NULL)) || !isnan(bw_result_error(r, "nothing")),
             "there are no more quantities than there are");
    gsl_test(bw_result_shapes(r, &points, &places) != 0 || bw_result_steps(r, "path", &x) != 0,
             "a linear scene has no steps, and shapes were not asked for");
    bw_result_free(r);

    s = scene_of("sheet_cantilever");
    WELL(bw_solve(s, "sheet_third", 2, "{\"shapes\": 4}", &r, &why), "shapes");
    WELL(bw_scene_set(s, "thickness=1e-3", &why), "another thickness");
    WELL(bw_solve(s, "sheet_third", 2, "{\"steps\": 3}", &second, &why), "again");
    bw_scene_free(s);
    const size_t curve = bw_result_curve(r, "C_zz_curve", &x, &y);
    gsl_test(curve < 2 || x == NULL || y == NULL || !isfinite(y[curve - 1]), "a curve has points");
    gsl_test(bw_result_curve(second, "C_zz_curve", NULL, NULL) != curve, "and as many again");
    bw_result_curve(second, "C_zz_curve", NULL, &places);
    gsl_test(fabs(places[0] / y[0] - 1) < 0.1, "which are those of another sheet");
    const size_t steps = bw_result_steps(r, "path", &x);
    gsl_test(steps < 2 || x[steps - 1] <= x[0] ||
                 bw_result_steps(second, "iterations", &y) <= steps || y[0] < 1,
             "more steps where more are asked for");
    gsl_test(bw_result_steps(r, "nonsense", &x) != 0 || x != NULL, "no such column");
    const size_t states = bw_result_shapes(r, &points, &places);
    gsl_test(states < 2 || points < 2 || bw_result_members(r, &first) != 1 ||
                 first[1] != (int)points || !isfinite(places[3 * states * points - 1]),
             "shapes of %d states with %d points", (int)states, (int)points);
    gsl_test(strcmp(bw_result_shape_kind(r, 0), "undeformed") != 0 ||
                 strcmp(bw_result_shape_kind(r, states - 1), "path") != 0 ||
                 bw_result_shape_kind(r, states) != NULL ||
                 !(bw_result_shape_value(r, states - 1) > 0),
             "the first is undeformed, the last the end of the path");
    bw_result_free(r);
    bw_result_free(second);
}

static void not_converged(void)
{
    static const char text[] =
        "beamwork: 1\n"
        "sections:\n"
        "  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: "
        "81e9}\n"
        "nodes:\n"
        "  base: {at: [0, 0, 0], hold: all}\n"
        "  tip:  {at: [0.1, 0, 0]}\n"
        "members:\n"
        "  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}\n"
        "loads:\n"
        "  push: {force: [0, 1e9, 0], on: tip}\n"
        "analyses:\n"
        "  run: {static: {stations: [1], steps: 1}}\n";
    char *why = NULL, *json = NULL;
    bw_scene *s = NULL;
    bw_result *r = NULL;
    WELL(bw_scene_read(text, sizeof text - 1, "far", &s, &why), "a load far too large");
    const bw_status ended = bw_solve(s, "beamw", 1, NULL, &r, &why);
    gsl_test(ended != BW_NOT_CONVERGED && ended != BW_SINGULAR, "is not solved: %s",
             bw_status_name(ended));
    gsl_test(r == NULL || why == NULL || !isnan(bw_result_value(r, bw_result_name(r, 0))),
             "and is a result without values");
    bw_free_text(why);
    WELL(bw_result_json(r, &json, &why), "with a document");
    gsl_test(json == NULL || strstr(json, bw_status_name(ended)) == NULL, "that says so");
    bw_free_text(json);
    bw_result_free(r);
    bw_scene_free(s);
}

static void library_tests(void)
{
    names();
    mistakes();
    formulations();
    options();
    nothing();
    results();
    not_converged();
}

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

static void motion_tests(void)
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
}

int main(void)
{
    library_tests();
    motion_tests();
    return gsl_test_summary();
}
