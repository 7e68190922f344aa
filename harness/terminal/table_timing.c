#include "harness/terminal/table_timing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"
#include "harness/terminal/paragraph.h"
#include "harness/terminal/table.h"
#include "harness/terminal/table_cheapest.h"

enum { NAME = 23 };

/* First verdict of a series that has a truth, or NULL. */
static const verdict *first_judged(const judgement *j, int series_index)
{
    for (int i = 0; i < j->verdicts; i++)
        if (j->verdict[i].series == series_index && j->verdict[i].truth != NULL)
            return &j->verdict[i];
    return NULL;
}

static double error_on(const sweep *s, const verdict *v, int mesh)
{
    const series *one = &s->series[v->series];
    const solve_result *r = &one->cell[mesh].solve;
    return v->quantity < r->quantities
               ? verdict_error(&s->point[one->point].scene.quantity[v->quantity],
                               r->quantity[v->quantity].value, v->truth->value)
               : NAN;
}

/* Formulation and mesh; a longer name has a line of its own. Returns its columns. */
static int subject(FILE *to, const series *one, int mesh)
{
    if (fprintf(to, "  %-*s", NAME, one->formulation.key) > 2 + NAME)
        fprintf(to, "\n%*s", 2 + NAME, "");
    return 2 + NAME + fprintf(to, "%5d", one->mesh[mesh]);
}

static void row(FILE *to, const sweep *s, const series *one, const verdict *v, int mesh)
{
    const cell_result *c = &one->cell[mesh];
    const rounds_reading *t = &one->timing[mesh].as_is;
    const double error = v != NULL ? error_on(s, v, mesh) : NAN;
    int column = subject(to, one, mesh);
    column += fprintf(to, "%7d%7ld%9ld%9ld", c->size.free, c->counters.iterations,
                      c->counters.strain_evaluations, c->counters.factorisations);
    if (t->rounds > 0)
        column += fprintf(to, " %8.4g %8.4g %3.0f %%", 1e3 * t->setup, 1e3 * t->solve,
                          100 * (rounds_most(t) / rounds_least(t) - 1));
    else
        column += fprintf(to, " %8s %8s %5s", "-", "-", "-");
    if (isfinite(error) || c->solve.reason[0] == '\0') {
        table_percent(to, error);
        fputc('\n', to);
    } else
        paragraph_say(to, column, 6, " %s", c->solve.reason);
}

/* Meshes of a series of that point that were run. */
static int meshes_run(const series *one, int at)
{
    return one->point == at && one->missing[0] == '\0' ? one->meshes : 0;
}

static void rows(FILE *to, const sweep *s, const judgement *j, int at)
{
    fprintf(to, "%*s%7s%7s%9s%9s %8s %8s\n", 2 + NAME + 5, "", "un-", "itera-", "evalu-",
            "factori-", "set-up", "solution");
    fprintf(to, "  %-*s%5s%7s%7s%9s%9s %8s %8s %5s %11s\n", NAME, "formulation", "n", "knowns",
            "tions", "ations", "sations", "[ms]", "[ms]", "noise", "error");
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < meshes_run(&s->series[i], at); k++)
            row(to, s, &s->series[i], first_judged(j, i), k);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].point == at && s->series[i].missing[0] != '\0')
            paragraph_say(to, fprintf(to, "  %s: ", s->series[i].formulation.key), 4,
                          "not timed, %s not modelled", s->series[i].missing);
    for (int i = 0; i < s->seriess; i++) {
        const char *why = reach_unranked(s->series[i].formulation.type);
        if (meshes_run(&s->series[i], at) > 0 && why[0] != '\0')
            fprintf(to, "  %s: %s, its times rank nothing\n", s->series[i].formulation.key, why);
    }
}

/* Microseconds per iteration in each of its parts and in the rest of the solution; the dense
 * reference where it was timed. */
static void parts_of(FILE *to, const series *one, int mesh)
{
    const cell_timing *t = &one->timing[mesh];
    const long iterations = one->cell[mesh].counters.iterations;
    if (t->as_is.rounds == 0 || iterations == 0)
        return;
    subject(to, one, mesh);
    for (int k = 0; k < PHASES; k++)
        fprintf(to, " %13.4g", 1e6 * t->phase[k] / (double)iterations);
    fputc('\n', to);
    if (t->dense.whole.rounds > 0)
        fprintf(to, "    dense %.4g ms", 1e3 * rounds_least(&t->dense.whole));
    else if (t->dense.unknowns > 0)
        fprintf(to, "    dense %ld x %.4g ms", iterations, 1e3 * t->dense.iteration);
    if (t->dense.unknowns > 0)
        fprintf(to, " (%d unknowns): %.4g times as long\n", t->dense.unknowns,
                dense_reference_seconds(&t->dense, iterations) / rounds_least(&t->as_is));
}

/* Is any part of the iterations known apart from the rest? */
static int is_parted(const series *one, int mesh)
{
    double sum = 0;
    for (int k = 0; k < PHASE_REST; k++)
        sum += one->timing[mesh].phase[k];
    return sum > 0;
}

static void parts(FILE *to, const sweep *s, int at)
{
    int iterative = 0, parted = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < meshes_run(&s->series[i], at); k++) {
            iterative |= s->series[i].cell[k].counters.iterations > 0;
            parted |= is_parted(&s->series[i], k);
        }
    if (!iterative)
        return;
    if (!parted) {
        fputs("  steps of motions are not divided into elements, assembly and factors\n", to);
        return;
    }
    fprintf(to, "  %-*s%5s", NAME, "[us] in an iteration", "n");
    for (int k = 0; k < PHASES; k++)
        fprintf(to, " %13s", phase_name((newton_phase)k));
    fputc('\n', to);
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < meshes_run(&s->series[i], at); k++)
            parts_of(to, &s->series[i], k);
}

void table_timing(FILE *to, const sweep *s, const judgement *j, int every_mesh)
{
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    for (int p = 0; p < s->points && list != NULL; p++) {
        const sweep_point *here = &s->point[p];
        if (!every_mesh && strcmp(here->name, "default") != 0)
            continue;
        fprintf(to, "%s%s%s\n", here->type->name, here->text[0] != '\0' ? " " : "", here->text);
        if (here->status == STATUS_OK)
            table_omitted(to, here);
        if (every_mesh)
            rows(to, s, j, p);
        if (every_mesh)
            parts(to, s, p);
        if (!table_cheapest(to, s, j, p, every_mesh, list))
            fprintf(to, "  no truth\n");
    }
    free(list);
}
