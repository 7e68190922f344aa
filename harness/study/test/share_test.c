/* Cells with the same answers are solved once, others by themselves: nothing but times differs from
 * solving all. */
#include <gsl/gsl_test.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/study/test/same_cell.h"

/* All formulations at two points of a case, on meshes of one and two elements. */
static void run(const case_type *type, const char *const text[2], int share, sweep *s)
{
    static const int mesh[] = {1, 2};
    const sweep_request request = {.jobs = 2, .share = share};
    formulation all[64];
    int count = 0;
    fault f = {""};
    memset(s, 0, sizeof *s);
    for (; registry_formulations[count] != NULL; count++)
        formulation_default(registry_formulations[count], &all[count]);
    for (int i = 0; i < 2; i++) {
        double value[CASE_MAX_PARAMETERS] = {0};
        gsl_test(parameters_parse(type, text[i], value, NULL, &f) != STATUS_OK ||
                     plan_add(s, type, value, NULL, mesh, 2, &f) != STATUS_OK ||
                     plan_extend(s, all, count, &f) != STATUS_OK,
                 "planned %s", f.text);
    }
    gsl_test(run_sweep(&request, s, &f) != STATUS_OK, "run %s", f.text);
}

static double seconds(const cell_result *c)
{
    return c->solve.seconds_setup + c->solve.seconds_solve;
}

/* Cells that took, to the bit, as long as another: so they have its answers. */
static int shared(const sweep *s)
{
    int out = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int j = 0; j < i; j++)
            for (int k = 0; k < s->series[i].meshes; k++)
                out += s->series[i].missing[0] == '\0' && s->series[j].missing[0] == '\0' &&
                       seconds(&s->series[i].cell[k]) > 0 &&
                       seconds(&s->series[i].cell[k]) == seconds(&s->series[j].cell[k]);
    return out;
}

static void forget_times(cell_result *c)
{
    c->solve.seconds_setup = c->solve.seconds_solve = 0;
    memset(c->solve.phase, 0, sizeof c->solve.phase);
}

static void same_answers(const char *name, const char *first, const char *second)
{
    const char *const text[2] = {first, second};
    fault f = {""};
    sweep once, each;
    int cells = 0;
    const case_type *type = case_find(name, &f);
    run(type, text, 1, &once);
    run(type, text, 0, &each);
    gsl_test(shared(&once) == 0, "%s: something is solved once", name);
    gsl_test_int(shared(&each), 0, "%s: nothing is, unless it was asked for", name);
    for (int i = 0; i < once.seriess; i++)
        for (int k = 0; k < once.series[i].meshes && once.series[i].missing[0] == '\0'; k++) {
            cell_result *a = &once.series[i].cell[k], *b = &each.series[i].cell[k];
            forget_times(a);
            forget_times(b);
            const difference d = compare_cells(a, b);
            gsl_test(d.name != NULL, "%s, %s, n = %d: %s", name, once.series[i].formulation.key,
                     once.series[i].mesh[k], d.name);
            cells++;
        }
    gsl_test(cells == 0, "%s: cells", name);
    sweep_free(&once);
    sweep_free(&each);
}

int main(void)
{
    same_answers("sheet_cantilever", "", "shear=0");
    same_answers("c_cantilever", "", "shear=0");
    same_answers("rotating_cantilever", "", "omega_star=2");
    return gsl_test_summary();
}
