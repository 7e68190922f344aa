#include "harness/tables/table_timing.h"

#include <math.h>
#include <string.h>

#include "harness/judge/reach.h"
#include "harness/tables/paragraph.h"
#include "harness/tables/table.h"

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

static void rows(FILE *to, const sweep *s, const judgement *j, int at)
{
    fprintf(to, "%*s%7s%7s%9s%9s %8s %8s\n", 2 + NAME + 5, "", "un-", "itera-", "evalu-",
            "factori-", "set-up", "solution");
    fprintf(to, "  %-*s%5s%7s%7s%9s%9s %8s %8s %5s %11s\n", NAME, "formulation", "n", "knowns",
            "tions", "ations", "sations", "[ms]", "[ms]", "noise", "error");
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0;
             k < s->series[i].meshes && s->series[i].point == at && s->series[i].missing[0] == '\0';
             k++)
            row(to, s, &s->series[i], first_judged(j, i), k);
}

/* Microseconds per iteration in each of its parts; the dense reference where it was timed. */
static void parts_of(FILE *to, const series *one, int mesh)
{
    const cell_timing *t = &one->timing[mesh];
    const long iterations = one->cell[mesh].counters.iterations;
    if (t->as_is.rounds == 0 || iterations == 0)
        return;
    subject(to, one, mesh);
    for (int k = 0; k < PHASES; k++)
        fprintf(to, " %14.4g", 1e6 * t->phase[k] / (double)iterations);
    fputc('\n', to);
    if (t->dense.whole.rounds > 0)
        fprintf(to, "    dense %.4g ms", 1e3 * rounds_least(&t->dense.whole));
    else if (t->dense.unknowns > 0)
        fprintf(to, "    dense %ld x %.4g ms", iterations, 1e3 * t->dense.iteration);
    if (t->dense.unknowns > 0)
        fprintf(to, " (%d unknowns): %.4g times ours\n", t->dense.unknowns,
                dense_reference_seconds(&t->dense, iterations) / rounds_least(&t->as_is));
}

static void parts(FILE *to, const sweep *s, int at)
{
    int iterative = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0;
             k < s->series[i].meshes && s->series[i].point == at && s->series[i].missing[0] == '\0';
             k++)
            iterative |= s->series[i].cell[k].counters.iterations > 0;
    if (!iterative)
        return;
    fprintf(to, "  %-*s%5s", NAME, "[us] in an iteration", "n");
    for (int k = 0; k < PHASES; k++)
        fprintf(to, " %14s", phase_name((phase)k));
    fputc('\n', to);
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0;
             k < s->series[i].meshes && s->series[i].point == at && s->series[i].missing[0] == '\0';
             k++)
            parts_of(to, &s->series[i], k);
}

static const rounds_reading *time_of(const sweep *s, const verdict *v, int mesh)
{
    return &s->series[v->series].timing[mesh].as_is;
}

/* Least time within the level among the formulations of a point, and those which the noise does not
 * tell from it. */
static void cheapest(FILE *to, const sweep *s, const judgement *j, int at, int quantity,
                     double level)
{
    const verdict *best = NULL;
    int best_mesh = -1;
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        if (s->series[v->series].point != at || v->quantity != quantity)
            continue;
        const int mesh = reach_fastest(s, v, level);
        if (mesh < 0 || time_of(s, v, mesh)->rounds == 0)
            continue;
        if (best == NULL ||
            rounds_least(time_of(s, v, mesh)) < rounds_least(time_of(s, best, best_mesh))) {
            best = v;
            best_mesh = mesh;
        }
    }
    fprintf(to, "  %s within %g %%: ", s->point[at].scene.quantity[quantity].name, 100 * level);
    if (best == NULL) {
        fprintf(to, "none\n");
        return;
    }
    fprintf(to, "%s, n = %d, %.4g ms", s->series[best->series].formulation.key,
            s->series[best->series].mesh[best_mesh],
            1e3 * rounds_least(time_of(s, best, best_mesh)));
    for (int i = 0, named = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const int mesh = v != best && s->series[v->series].point == at && v->quantity == quantity
                             ? reach_fastest(s, v, level)
                             : -1;
        if (mesh >= 0 && rounds_compare(time_of(s, v, mesh), time_of(s, best, best_mesh)) == 0)
            fprintf(to, "%s%s, n = %d", named++ == 0 ? " (undecided: " : "; ",
                    s->series[v->series].formulation.key, s->series[v->series].mesh[mesh]);
        if (i + 1 == j->verdicts && named > 0)
            fprintf(to, ")");
    }
    fputc('\n', to);
}

static int has_truth(const sweep *s, const judgement *j, int at, int quantity)
{
    for (int i = 0; i < j->verdicts; i++)
        if (s->series[j->verdict[i].series].point == at && j->verdict[i].quantity == quantity &&
            j->verdict[i].truth != NULL)
            return 1;
    return 0;
}

void table_timing(FILE *to, const sweep *s, const judgement *j, int every_mesh)
{
    for (int p = 0; p < s->points; p++) {
        const point *here = &s->point[p];
        int shown = 0;
        if (!every_mesh && strcmp(here->name, "default") != 0)
            continue;
        fprintf(to, "%s%s%s\n", here->type->name, here->text[0] != '\0' ? " " : "", here->text);
        if (every_mesh)
            rows(to, s, j, p);
        if (every_mesh)
            parts(to, s, p);
        for (int q = 0; q < here->scene.quantities && (every_mesh || shown == 0); q++)
            if (has_truth(s, j, p, q))
                for (int level = 0; level < REACH_LEVELS; level++, shown = 1)
                    cheapest(to, s, j, p, q, reach_level[level]);
        if (!shown)
            fprintf(to, "  no truth\n");
    }
}
