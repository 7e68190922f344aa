/* Mechanisms and unstable states: large turns in one step, few iterations, inertia of the tangent,
 * both directions of elements. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/test/sections.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"
#include "harness/tools/kit/cells.h"
#include "harness/tools/kit/scenes.h"

/* Solves a case with n elements; assignments end with NULL. The caller frees the result. */
static status run(const char *case_name, const char *key, int n, const char *const assignment[],
                  cell_result *out)
{
    cell_request request = cells_of(case_find(case_name, NULL), key, n);
    fault f = {""};
    cells_set(&request, assignment);
    return cell_run(&request, out, &f);
}

/* N section 4: coordinates, strains and stresses at once reach 15 degrees from rest without steps
 * between. */
static void from_rest_in_one_step(void)
{
    const char *const once[] = {"steps=1", "wagner=0", NULL};
    int runs = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int n = 1; n <= 2; n++) {
            cell_result r;
            const char *name = registry_formulations[i]->name;
            const status outcome =
                run("spherical_joint", registry_formulations[i]->name, n, once, &r);
            if (ask_offered(&r.scene, registry_formulations[i])) {
                runs++;
                gsl_test(outcome != STATUS_OK || r.solve.steps != 1 ||
                             r.solve.step[0].rejected != 0,
                         "%s, n = %d: 15 degrees in one step, nothing rejected", name, n);
                gsl_test(!(r.counters.iterations <= 6), "%s, n = %d: in %ld iterations", name, n,
                         r.counters.iterations);
            }
            cell_result_free(&r);
        }
    gsl_test(runs < 16, "%d cells turned at once", runs);
}

static void few_iterations(void)
{
    static const struct {
        const char *case_name, *formulation;
        double most;
    } path[] = {{"spherical_joint", "sheet_third", 3.5},
                {"spherical_joint", "sheet_second", 3.5},
                {"hexapod", "sheet_third", 3.5},
                {"hexapod", "sheet_second", 3.5},
                {"sheet_cantilever", "sheet_third", 2.5}};
    for (size_t i = 0; i < sizeof path / sizeof path[0]; i++) {
        cell_result r;
        gsl_test(run(path[i].case_name, path[i].formulation, 1, (const char *const[]){NULL}, &r) !=
                     STATUS_OK,
                 "%s solved", path[i].case_name);
        const double average = (double)r.counters.iterations / (double)r.counters.steps;
        gsl_test(!(average <= path[i].most), "%s, %s: %.2f iterations a step", path[i].case_name,
                 path[i].formulation, average);
        cell_result_free(&r);
    }
}

/* A guess of the next state saves iterations and changes no result: more steps between the stations
 * reach the same. */
static void guesses_change_nothing(void)
{
    const char *const defaults[] = {NULL};
    cell_request request = cells_of(case_find("spherical_joint", NULL), "sheet_third", 1);
    cell_result plain, halved;
    fault f = {""};
    gsl_test(run("spherical_joint", "sheet_third", 1, defaults, &plain) != STATUS_OK, "the curve");
    request.solve.steps_between = 3;
    gsl_test(cell_run(&request, &halved, &f) != STATUS_OK,
             "the curve in three steps from azimuth to azimuth");
    gsl_test(halved.counters.steps <= plain.counters.steps, "%ld and %ld steps",
             halved.counters.steps, plain.counters.steps);
    for (int k = 0; k < plain.solve.quantities; k++)
        gsl_test_rel(halved.solve.quantity[k].value, plain.solve.quantity[k].value, 1e-11, "%s",
                     plain.scene.quantity[k].name);
    cell_result_free(&plain);
    cell_result_free(&halved);
}

/* Formulations that treat both ends alike do not notice which way the elements run; the others by a
 * discretisation error. */
static void directions(void)
{
    static const struct {
        const char *formulation;
        double least, most; /* relative change */
    } row[] = {{"sheet_second", 1e-3, 5e-3},
               {"sheet_third", 1e-3, 5e-3},
               {"collocation", 0, 1e-10},
               {"geometrically_exact", 0, 1e-10}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        cell_result bodies, chained;
        run("spherical_joint", row[i].formulation, 1, (const char *const[]){"wagner=0", NULL},
            &bodies);
        run("spherical_joint", row[i].formulation, 1,
            (const char *const[]){"wagner=0", "element_direction=chained", NULL}, &chained);
        const double change = fabs(cells_value(&chained, "support_stiffness_max") /
                                       cells_value(&bodies, "support_stiffness_max") -
                                   1);
        gsl_test(!(change >= row[i].least && change <= row[i].most),
                 "%s, one element: the direction changes %.1e", row[i].formulation, change);
        cell_result_free(&bodies);
        cell_result_free(&chained);
    }
}

/* Largest stiffnesses with one element per sheet; independent prototype: 9.37, 9.720, 9.92 x 10^5
 * N/m. */
static void fold_warping(void)
{
    static const char *const choice[3] = {"fold_warping=fixed", "fold_warping=shared",
                                          "fold_warping=free"};
    double value[3];
    for (int i = 0; i < 3; i++) {
        cell_result r;
        run("spherical_joint", "sheet_third", 1, (const char *const[]){choice[i], NULL}, &r);
        value[i] = cells_value(&r, "support_stiffness_max");
        cell_result_free(&r);
    }
    gsl_test_rel(value[0], 9.37e5, 1e-3, "folds that do not warp");
    gsl_test_rel(value[1], 9.720e5, 1e-4, "folds that share their warping");
    gsl_test_rel(value[2], 9.92e5, 2e-3, "folds free to warp");
}

/* A cantilever of length 1 with EIy = 4 EIz = 4 under P = path [N], straight: its critical loads
 * are (2k - 1)^2 pi^2 EI/4. */
static void straight_column(scene *s, int stations, const double path[])
{
    const section_spec spec = sections_of(1e8, 4, 1, 10);
    scene_init(s, "straight_column");
    const int tip = scenes_cantilever(s, &spec);
    scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    scene_add_static(s, stations, path, 1);
}

/* Newton stays on the straight path, where the tangent has as many negative eigenvalues as there
 * are critical loads below. */
static void inertia_counts_critical_loads(void)
{
    const double weak = PI * PI / 4;
    const double path[] = {0.9 * weak, 1.1 * weak, 3.9 * weak, 4.1 * weak, 8.8 * weak,
                           9.2 * weak, 24 * weak,  26 * weak,  35 * weak,  37 * weak};
    const int below[] = {0, 1, 1, 2, 2,
                         3, 3, 4, 4, 5}; /* weak plane 1, 9, 25, 49; strong plane 4, 36 */
    enum { STATIONS = sizeof below / sizeof below[0] };
    const char *const names[] = {"beamw_consistent", "collocation", "geometrically_exact"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        scene s;
        model *m = NULL;
        fault f = {""};
        formulation chosen;
        solve_result r = {0};
        straight_column(&s, STATIONS, path);
        formulation_parse(names[k], &chosen, &f);
        const model_request what = {&s, chosen.type, chosen.option, 16, 0};
        status outcome = scene_validate(&s, &f);
        if (outcome == STATUS_OK)
            outcome = model_alloc(&what, &m, &f);
        if (outcome == STATUS_OK)
            outcome = solve_scene(&s, m, NULL, &r, &f);
        gsl_test(outcome != STATUS_OK || r.steps != STATIONS,
                 "%s: the straight path beyond critical loads (%s)", names[k], f.text);
        if (outcome == STATUS_OK)
            for (int i = 0; i < STATIONS; i++)
                gsl_test_int(r.step[i].negative_pivots, below[i],
                             "%s: critical loads below %.1f of the first", names[k],
                             path[i] / weak);
        gsl_test_int((int)r.counters.negative_pivots, 5, "%s: the most is counted", names[k]);
        result_free(&r);
        model_free(m);
        scene_free(&s);
    }
}

/* Sums keep their order: several threads give the same bits and the same work, also where pieces
 * are not full and more than are kept at a time. */
static void threads_change_no_bit(void)
{
    static const struct {
        const char *name, *key;
        int n, threads;
    } cells[] = {{"hexapod", "sheet_third", 1, 2},
                 {"hexapod", "collocation", 1, 2},
                 {"hexapod", "geometrically_exact", 1, 4},
                 {"spherical_joint", "sheet_third", 37, 3},
                 {"c_cantilever", "geometrically_exact", 331, 2}};
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        const char *name = cells[i].name, *key = cells[i].key;
        cell_request request = cells_of(case_find(name, NULL), key, cells[i].n);
        cell_result one, more;
        fault f = {""};
        gsl_test(cell_run(&request, &one, &f) != STATUS_OK, "%s, %s, one thread", name, key);
        request.threads = cells[i].threads;
        gsl_test(cell_run(&request, &more, &f) != STATUS_OK, "%s, %s, %d threads", name, key,
                 cells[i].threads);
        for (int k = 0; k < one.solve.quantities; k++)
            gsl_test(memcmp(&one.solve.quantity[k].value, &more.solve.quantity[k].value,
                            sizeof(double)) != 0,
                     "%s, %s: the same %s", name, key, one.scene.quantity[k].name);
        gsl_test(memcmp(&one.counters, &more.counters, sizeof one.counters) != 0,
                 "%s, %s: the same work", name, key);
        cell_result_free(&one);
        cell_result_free(&more);
    }
}

int main(void)
{
    threads_change_no_bit();
    from_rest_in_one_step();
    few_iterations();
    guesses_change_nothing();
    directions();
    fold_warping();
    inertia_counts_critical_loads();
    return gsl_test_summary();
}
