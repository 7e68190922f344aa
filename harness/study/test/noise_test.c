/* Noise of a finest mesh: measured where it is wanted, twice the larger difference, and nothing but
 * rounding. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

static const sweep_request request = {.jobs = 2};

/* All formulations on one case, meshes of one and two elements, run with that follower; the series
 * of formulations that do not run stay empty. */
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

/* Rounding only, also of formulations that answer to the order of nodes. */
static void rounding(const case_type *type)
{
    sweep s;
    const sweep_follower follower = {.context = &s, .doubts = all_but_the_first};
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

/* What the finest mesh has by accident. */
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

/* A value that was changed by hand differs from both repetitions by that much. */
static void size_of_it(const case_type *type)
{
    for (int k = 0; k < 2; k++) {
        sweep s;
        accident what = {&s, k == 0 ? 1 + 1e-3 : NAN};
        const sweep_follower follower = {.context = &what, .doubts = change};
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

/* One value of a case and formulation, its scene in other words. */
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

/* Both repetitions count, whichever is the worse. */
static void larger_of_two(const case_type *type)
{
    sweep s;
    accident none = {&s, 1};
    const sweep_follower follower = {.context = &none, .doubts = change};
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

/* One mesh of a point of a case. */
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

/* What only curves and matrices show costs nothing, and the values have the same bits. */
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

int main(void)
{
    fault f = {""};
    static const char *const base[] = {"elastica", "bend_45", "shear_column", "wagner_torsion"};
    for (size_t i = 0; i < sizeof base / sizeof base[0]; i++)
        rounding(case_find(base[i], &f));
    size_of_it(case_find("elastica", &f));
    values_only("rotating_cantilever", "stations=4");
    values_only("sheet_cantilever", "");
    larger_of_two(case_find("elastica", &f));
    return gsl_test_summary();
}
