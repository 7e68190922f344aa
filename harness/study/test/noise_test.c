/* The scatter of the values on the finest mesh is measured on request. This scatter must be twice
 * the larger of two differences, and be due only to rounding. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study_impl.h"

static const sweep_request request = {.jobs = 2};

/* Runs all formulations on one case, with meshes of one and two elements and the given follower.
 * Series of formulations that do not run are empty. */
static int measure(const case_type *type, const sweep_follower *follower, sweep *s)
{
    static const int mesh[] = {1, 2};
    const sweep_request followed = {.jobs = 2, .follower = follower};
    formulation all[64];
    double value[CASE_MAX_PARAMETERS] = {0};
    int count = 0;
    fault f = {""};
    parameters_default(type, value);
    while (registry_formulations[count] != NULL) {
        formulation_default(registry_formulations[count], &all[count]);
        count++;
    }
    const status outcome = plan_one(type, value, all, count, mesh, 2, s, &f);
    gsl_test(outcome != STATUS_OK || run_sweep(&followed, s, &f) != STATUS_OK, "%s: %s", type->name,
             f.text);
    return count;
}

static int all_but_the_first(void *context, const sweep *s, int series_index)
{
    gsl_test(context != s, "the follower's own context");
    gsl_test_int(s->series[series_index].cell[1].solve.quantities, s->point[0].scene.quantities,
                 "asked when it has its values");
    return series_index > 0;
}

static void rounding(const case_type *type)
{
    sweep s;
    const sweep_follower follower = {.context = &s, .needs_scatter = all_but_the_first};
    const int count = measure(type, &follower, &s);
    double largest = 0;
    int measured = 0;
    gsl_test(s.series[0].noise != NULL, "not where it is not wanted");
    for (int i = 1; i < count; i++)
        if (s.series[i].noise != NULL)
            for (int q = 0; q < s.point[0].scene.quantities; q++)
                if (isfinite(s.series[i].noise[q])) {
                    measured++;
                    largest = fmax(largest, s.series[i].noise[q]);
                }
    gsl_test(measured == 0 || !(largest > 0 && largest < 1e-6), "%s: %d values, largest noise %.1e",
             type->name, measured, largest);
    gsl_test_int(noise_cells(&s), 2 * (sweep_cells(&s) / 2 - (s.series[0].missing[0] == '\0')),
                 "two cells for each series");
    sweep_free(&s);
}

typedef struct accident {
    sweep *of;
    double factor;
} accident;

static int change(void *context, const sweep *s, int series_index)
{
    const accident *what = context;
    (void)s;
    what->of->series[series_index].cell[1].solve.quantity[0].value *= what->factor;
    return 1;
}

static void size_of_it(const case_type *type)
{
    for (int k = 0; k < 2; k++) {
        sweep s;
        accident what = {&s, k == 0 ? 1 + 1e-3 : NAN};
        const sweep_follower follower = {.context = &what, .needs_scatter = change};
        const int count = measure(type, &follower, &s);
        int i = 0;
        while (i + 1 < count && s.series[i].missing[0] != '\0')
            i++;
        if (k == 0)
            gsl_test_rel(s.series[i].noise[0], 2e-3 / (1 + 1e-3), 1e-4,
                         "twice the larger difference");
        else
            gsl_test(isfinite(s.series[i].noise[0]), "no value has no noise");
        sweep_free(&s);
    }
}

static double in_other_words(const case_type *type, const formulation *chosen, scene_edit edit,
                             int quantity)
{
    static const int mesh[] = {2};
    double value[CASE_MAX_PARAMETERS] = {0};
    sweep s = {0};
    fault f = {""};
    parameters_default(type, value);
    gsl_test(plan_add(&s, type, value, &edit, mesh, 1, &f) != STATUS_OK, "planned %s", f.text);
    gsl_test(plan_extend(&s, chosen, 1, &f) != STATUS_OK ||
                 run_sweep(&request, &s, &f) != STATUS_OK,
             "run %s", f.text);
    const double out = s.series[0].cell[0].solve.quantity[quantity].value;
    sweep_free(&s);
    return out;
}

static void larger_of_two(const case_type *type)
{
    sweep s;
    accident none = {&s, 1};
    const sweep_follower follower = {.context = &none, .needs_scatter = change};
    const int count = measure(type, &follower, &s);
    int differ = 0;
    for (int i = 0; i < count; i++) {
        const series *one = &s.series[i];
        if (one->noise == NULL || (one->formulation.type->limits & LIMIT_ORDER_DEPENDENT))
            continue;
        const double value = one->cell[1].solve.quantity[0].value;
        const double a = fabs(in_other_words(type, &one->formulation,
                                             (scene_edit){SCENE_EDIT_UNIT, 1000}, 0) -
                              value),
                     b = fabs(in_other_words(type, &one->formulation,
                                             (scene_edit){SCENE_EDIT_REVERSE, 0}, 0) -
                              value);
        gsl_test_abs(one->noise[0], 2 * fmax(a, b) / fabs(value), 0, "%s, %s: %g and %g",
                     type->name, one->formulation.key, a, b);
        differ += a != b;
    }
    gsl_test(differ == 0, "%s: the repetitions differ somewhere", type->name);
    sweep_free(&s);
}

static void run_values(const char *name, const char *text, int values_only, sweep *s)
{
    static const int mesh[] = {2};
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    formulation chosen;
    const case_type *type = case_find(name, &f);
    gsl_test(parameters_parse(type, text, value, NULL, &f) != STATUS_OK, "point %s", f.text);
    formulation_default(formulation_find("collocation"), &chosen);
    gsl_test(plan_one(type, value, &chosen, 1, mesh, 1, s, &f) != STATUS_OK, "planned %s", f.text);
    s->values_only = values_only;
    gsl_test(run_sweep(&request, s, &f) != STATUS_OK, "run %s", f.text);
}

static void values_only(const char *name, const char *text)
{
    sweep whole, some;
    int curves = 0, finite = 0;
    run_values(name, text, 0, &whole);
    run_values(name, text, 1, &some);
    const scene *here = &whole.point[0].scene;
    const cell_result *a = whole.series[0].cell, *b = some.series[0].cell;
    for (int q = 0; q < here->quantities; q++) {
        const double x = a->solve.quantity[q].value, y = b->solve.quantity[q].value;
        const int is_curve = here->quantity[q].reduction == SCENE_CURVE;
        curves += is_curve;
        finite += !is_curve && isfinite(x);
        gsl_test(!is_curve && memcmp(&x, &y, sizeof x) != 0, "%s, %s: %g, %g", name,
                 here->quantity[q].name, x, y);
    }
    gsl_test(curves == 0 || finite == 0, "%s: %d curves, %d values", name, curves, finite);
    gsl_test(b->counters.factorisations >= a->counters.factorisations,
             "%s: %ld factorisations of %ld", name, b->counters.factorisations,
             a->counters.factorisations);
    sweep_free(&whole);
    sweep_free(&some);
}

static void noise_tests(void)
{
    fault f = {""};
    static const char *const base[] = {"elastica", "bend_45", "shear_column", "wagner_torsion"};
    for (size_t i = 0; i < sizeof base / sizeof base[0]; i++)
        rounding(case_find(base[i], &f));
    size_of_it(case_find("elastica", &f));
    values_only("rotating_cantilever", "stations=4");
    values_only("sheet_cantilever", "");
    larger_of_two(case_find("elastica", &f));
}

static const int mesh[] = {1, 2, 4};

static void add(const char *name, sweep *s)
{
    formulation all[64];
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    int count = 0;
    const case_type *type = case_find(name, &f);
    for (; registry_formulations[count] != NULL; count++)
        formulation_default(registry_formulations[count], &all[count]);
    parameters_default(type, value);
    gsl_test(plan_add(s, type, value, NULL, mesh, 3, &f) != STATUS_OK ||
                 plan_extend(s, all, count, &f) != STATUS_OK,
             "%s: planned %s", name, f.text);
}

static double run_cost_of(const sweep *s, int index)
{
    double all = 0;
    for (int k = 0; k < 3; k++)
        all += run_cost_of_cell(s, index, k);
    return all;
}

/* Returns 1 if the cost of the series is below a hundredth of the work of one process. */
static int is_small(const sweep *s, int jobs, int index)
{
    double all = 0;
    for (int i = 0; i < s->seriess; i++)
        all += s->series[i].missing[0] == '\0' ? run_cost_of(s, i) : 0;
    return run_cost_of(s, index) < 0.01 * all / jobs;
}

static void order(int jobs)
{
    sweep s = {0};
    add("elastica", &s);
    add("hexapod", &s);
    add("c_column", &s);
    add("rotating_cantilever", &s);
    const int count = sweep_cells(&s);
    workload_task *tasks = calloc((size_t)count + 1, sizeof *tasks);
    char *met = calloc((size_t)s.seriess * 3 + 1, 1);
    int elements_free = 0, repeated = 0, lower_cost_first = 0, coarser_first = 0, small = 0,
        late = 0;
    gsl_test(count == 0 || tasks == NULL || met == NULL || run_cost_order(&s, jobs, tasks) != 0,
             "%d cells in order", count);
    for (int i = 0; i < count; i++) {
        elements_free +=
            tasks[i].mesh > 0 && run_cost_of_cell(&s, tasks[i].series, tasks[i].mesh) <=
                                     run_cost_of_cell(&s, tasks[i].series, tasks[i].mesh - 1);
        repeated += met[3 * tasks[i].series + tasks[i].mesh]++;
        if (i == 0)
            continue;
        const workload_task *a = &tasks[i - 1], *b = &tasks[i];
        const int before = is_small(&s, jobs, a->series), here = is_small(&s, jobs, b->series);
        lower_cost_first += !here && run_cost_of(&s, a->series) < run_cost_of(&s, b->series);
        late += before && !here;
        late += before && here && a->series > b->series;
        small += here;
        coarser_first += a->series == b->series && a->mesh < b->mesh;
    }
    gsl_test_int(elements_free, 0, "more elements cost more");
    gsl_test_int(repeated, 0, "each once");
    gsl_test_int(lower_cost_first, 0, "the dearest series first");
    gsl_test_int(late, 0, "then small ones, as they stand");
    gsl_test(small == 0 || small > count - 3, "%d cells of %d are in small ones", small, count);
    gsl_test_int(coarser_first, 0, "the finest mesh of a series first");
    gsl_test(strcmp(s.point[s.series[tasks[0].series].point].type->name, "hexapod") != 0,
             "first the one of 144 elements and a path, not %s",
             s.point[s.series[tasks[0].series].point].type->name);
    free(tasks);
    free(met);
    sweep_free(&s);
}

static void counted(const char *name, run_cost_kind kind, double wanted)
{
    fault f = {""};
    double value[CASE_MAX_PARAMETERS] = {0}, times[RUN_COST_KINDS];
    const case_type *type = case_find(name, &f);
    scene s;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s: %s", name, f.text);
    run_cost_count(&s, 0, times);
    gsl_test_rel(times[kind], wanted, 1e-15, "%s: kind %d of work", name, (int)kind);
    gsl_test_rel(times[RUN_COST_cell], 1, 1e-15, "%s: one cell", name);
    run_cost_count(&s, 7, times);
    if (kind == RUN_COST_load_step)
        gsl_test_rel(times[kind], 7, 1e-15, "%s: load steps that are asked for", name);
    scene_free(&s);
}

static void adapts(void)
{
    const double instant = 3;
    double times[RUN_COST_KINDS];
    scene s;
    scene_init(&s, "adapts");
    const scene_motion how = {.step = 1e-3, .tolerance = 1e-6};
    scene_add_motion(&s, SCENE_NONE, 1, &instant, how);
    scene_motion *m = &s.analysis[0].of.motion;
    run_cost_count(&s, 0, times);
    gsl_test_rel(times[RUN_COST_alpha_step], 80 * pow(100, 0.45), 1e-12, "of alpha");
    m->scheme = SCENE_RADAU;
    run_cost_count(&s, 0, times);
    gsl_test_rel(times[RUN_COST_radau_step], 40 * pow(100, 0.3), 1e-12, "of radau");
    gsl_test_abs(times[RUN_COST_alpha_step], 0, 0, "none of alpha");
    m->tolerance = 0;
    m->step = 0.7;
    run_cost_count(&s, 0, times);
    gsl_test_rel(times[RUN_COST_radau_step], 5, 1e-15, "the last step is shorter");
    scene_free(&s);
}

static void prices(void)
{
    double all = 0;
    for (int k = 0; k < RUN_COST_KINDS; k++) {
        gsl_test(run_cost_work[k].once < 0 || run_cost_work[k].element < 0, "price %d", k);
        all += run_cost_work[k].element;
    }
    gsl_test(all <= 0, "elements cost something");
    gsl_test(run_cost_factors[0].formulation == NULL, "formulations have rows");
}

static void run_cost_tests(void)
{
    order(1);
    order(3);
    counted("bend_45", RUN_COST_load_step, 1);
    counted("warping_torsion", RUN_COST_linear, 1);
    counted("tip_body", RUN_COST_modal, 1);
    counted("lee_frame", RUN_COST_continuation, 1);
    counted("pendulum", RUN_COST_radau_step, 40 * pow(1 / 6.0, 0.3));
    adapts();
    prices();
}

int main(void)
{
    noise_tests();
    run_cost_tests();
    return gsl_test_summary();
}
