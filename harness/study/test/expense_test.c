/* Every cell is a task once; those of the dearest series come first, then the others in order, and
 * of a series the finest. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

static const int mesh[] = {1, 2, 4};

/* All formulations on a case. */
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

static double expense_of(const sweep *s, int index)
{
    double all = 0;
    for (int k = 0; k < 3; k++)
        all += expense_of_cell(s, index, k);
    return all;
}

/* Is what goes into the series less than a hundredth of the work of one process? */
static int is_small(const sweep *s, int jobs, int index)
{
    double all = 0;
    for (int i = 0; i < s->seriess; i++)
        all += s->series[i].missing[0] == '\0' ? expense_of(s, i) : 0;
    return expense_of(s, index) < 0.01 * all / jobs;
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
    int elements_free = 0, repeated = 0, cheaper_first = 0, coarser_first = 0, small = 0, late = 0;
    gsl_test(count == 0 || tasks == NULL || met == NULL || expense_order(&s, jobs, tasks) != 0,
             "%d cells in order", count);
    for (int i = 0; i < count; i++) {
        elements_free +=
            tasks[i].mesh > 0 && expense_of_cell(&s, tasks[i].series, tasks[i].mesh) <=
                                     expense_of_cell(&s, tasks[i].series, tasks[i].mesh - 1);
        repeated += met[3 * tasks[i].series + tasks[i].mesh]++;
        if (i == 0)
            continue;
        const workload_task *a = &tasks[i - 1], *b = &tasks[i];
        const int before = is_small(&s, jobs, a->series), here = is_small(&s, jobs, b->series);
        cheaper_first += !here && expense_of(&s, a->series) < expense_of(&s, b->series);
        late += before && !here;
        late += before && here && a->series > b->series;
        small += here;
        coarser_first += a->series == b->series && a->mesh < b->mesh;
    }
    gsl_test_int(elements_free, 0, "more elements cost more");
    gsl_test_int(repeated, 0, "each once");
    gsl_test_int(cheaper_first, 0, "the dearest series first");
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

/* What the analyses of a case at its defaults do. */
static void counted(const char *name, expense_kind kind, double wanted)
{
    fault f = {""};
    double value[CASE_MAX_PARAMETERS] = {0}, times[EXPENSE_KINDS];
    const case_type *type = case_find(name, &f);
    scene s;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s: %s", name, f.text);
    expense_count(&s, 0, times);
    gsl_test_rel(times[kind], wanted, 1e-15, "%s: kind %d of work", name, (int)kind);
    gsl_test_rel(times[EXPENSE_cell], 1, 1e-15, "%s: one cell", name);
    expense_count(&s, 7, times);
    if (kind == EXPENSE_load_step)
        gsl_test_rel(times[kind], 7, 1e-15, "%s: load steps that are asked for", name);
    scene_free(&s);
}

/* Steps that adapt are counted by the tolerance: more by a power of it, each of Radau's longer. */
static void adapts(void)
{
    const double instant = 3;
    double times[EXPENSE_KINDS];
    scene s;
    scene_init(&s, "adapts");
    const scene_motion how = {.step = 1e-3, .tolerance = 1e-6};
    scene_add_motion(&s, SCENE_NONE, 1, &instant, how);
    scene_motion *m = &s.analysis[0].of.motion;
    expense_count(&s, 0, times);
    gsl_test_rel(times[EXPENSE_alpha_step], 80 * pow(100, 0.45), 1e-12, "of alpha");
    m->scheme = SCENE_RADAU;
    expense_count(&s, 0, times);
    gsl_test_rel(times[EXPENSE_radau_step], 40 * pow(100, 0.3), 1e-12, "of radau");
    gsl_test_abs(times[EXPENSE_alpha_step], 0, 0, "none of alpha");
    m->tolerance = 0;
    m->step = 0.7;
    expense_count(&s, 0, times);
    gsl_test_rel(times[EXPENSE_radau_step], 5, 1e-15, "the last step is shorter");
    scene_free(&s);
}

/* Every price is known, and some formulation has a row of its own. */
static void prices(void)
{
    double all = 0;
    for (int k = 0; k < EXPENSE_KINDS; k++) {
        gsl_test(expense_work[k].once < 0 || expense_work[k].element < 0, "price %d", k);
        all += expense_work[k].element;
    }
    gsl_test(all <= 0, "elements cost something");
    gsl_test(expense_factors[0].formulation == NULL, "formulations have rows");
}

int main(void)
{
    order(1);
    order(3);
    counted("bend_45", EXPENSE_load_step, 1);
    counted("warping_torsion", EXPENSE_linear, 1);
    counted("tip_body", EXPENSE_modal, 1);
    counted("lee_frame", EXPENSE_continuation, 1);
    counted("pendulum", EXPENSE_radau_step, 40 * pow(1 / 6.0, 0.3)); /* tolerance 6e-4 */
    adapts();
    prices();
    return gsl_test_summary();
}
