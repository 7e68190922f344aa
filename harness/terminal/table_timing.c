#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Prints the lowest cost for all quantities of a point (`every` 1), or for the first quantity with
 * a reference value. Returns 0 if no quantity has a reference value. list[series]: work space. */
static int table_lowest_cost(FILE *to, const sweep *, const evaluation *, int point, int every,
                             reached list[]);

enum { NAME = 23 };

/* Returns the verdict of a series on a quantity; NULL: it has no reference value. */
static const verdict *verdict_on(const evaluation *j, int series_index, int quantity)
{
    for (int i = 0; i < j->verdicts; i++)
        if (j->verdict[i].series == series_index && j->verdict[i].quantity == quantity &&
            j->verdict[i].truth != NULL)
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

/* Prints the formulation and the mesh. Returns the width in columns. */
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
        paragraph_printf(to, column, 6, " %s", c->solve.reason);
}

/* Returns the number of meshes of a series that were run; 0: the series does not belong to point
 * `at`, or its formulation does not support the scene. */
static int meshes_run(const series *one, int at)
{
    return one->point == at && one->missing[0] == '\0' ? one->meshes : 0;
}

/* Returns the first quantity with a reference value for a formulation whose errors have not been
 * shown yet; -1: none. done[series] 1: the errors of the series have been shown. */
static int next_quantity(const sweep *s, const evaluation *j, int at, const char done[])
{
    for (int q = 0; q < s->point[at].scene.quantities; q++)
        for (int i = 0; i < s->seriess; i++)
            if (!done[i] && meshes_run(&s->series[i], at) > 0 && verdict_on(j, i, q) != NULL)
                return q;
    return -1;
}

static void mark_shown(const sweep *s, const evaluation *j, int at, int quantity, char done[])
{
    for (int i = 0; i < s->seriess; i++)
        done[i] |= s->series[i].point == at && verdict_on(j, i, quantity) != NULL;
}

static void errors_of(FILE *to, const sweep *s, const evaluation *j, int at, int quantity)
{
    fprintf(to, "  %-*s%5s %11s   of %s\n", NAME, "formulation", "n", "error",
            s->point[at].scene.quantity[quantity].name);
    for (int i = 0; i < s->seriess; i++) {
        const verdict *v = verdict_on(j, i, quantity);
        for (int k = 0; v != NULL && k < meshes_run(&s->series[i], at); k++) {
            subject(to, &s->series[i], k);
            table_percent(to, error_on(s, v, k));
            fputc('\n', to);
        }
    }
}

static void rows(FILE *to, const sweep *s, const evaluation *j, int at, char done[])
{
    const int first = next_quantity(s, j, at, done);
    if (first >= 0)
        fprintf(to, "  errors of %s\n", s->point[at].scene.quantity[first].name);
    fprintf(to, "%*s%7s%7s%9s%9s %8s %8s\n", 2 + NAME + 5, "", "un-", "itera-", "evalu-",
            "factori-", "set-up", "solution");
    fprintf(to, "  %-*s%5s%7s%7s%9s%9s %8s %8s %5s %11s\n", NAME, "formulation", "n", "knowns",
            "tions", "ations", "sations", "[ms]", "[ms]", "noise", "error");
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < meshes_run(&s->series[i], at); k++)
            row(to, s, &s->series[i], verdict_on(j, i, first), k);
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].point == at && s->series[i].missing[0] != '\0')
            paragraph_printf(to, fprintf(to, "  %s: ", s->series[i].formulation.key), 4,
                             "not timed, %s not modelled", s->series[i].missing);
    for (int i = 0; i < s->seriess; i++) {
        const char *why = reach_unranked(s->series[i].formulation.type);
        if (meshes_run(&s->series[i], at) > 0 && why[0] != '\0')
            fprintf(to, "  %s: %s, so its times are not ranked\n", s->series[i].formulation.key,
                    why);
    }
    for (int q = first; q >= 0; q = next_quantity(s, j, at, done)) {
        mark_shown(s, j, at, q, done);
        if (q != first)
            errors_of(to, s, j, at, q);
    }
}

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
        fputs("  times of motions are not divided into elements, assembly and factors\n", to);
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

static int is_selected(const sweep *s, int at)
{
    int found = 0;
    for (int i = 0; i < s->seriess; i++)
        found |= s->series[i].point == at;
    return found;
}

void table_timing(FILE *to, const sweep *s, const evaluation *j, int every_mesh)
{
    reached *list = calloc((size_t)s->seriess + 1, sizeof *list);
    char *done = calloc((size_t)s->seriess + 1, 1);
    for (int p = 0; p < s->points && list != NULL && done != NULL; p++) {
        const sweep_point *here = &s->point[p];
        if (!is_selected(s, p) || (!every_mesh && strcmp(here->name, "default") != 0))
            continue;
        fprintf(to, "%s%s%s\n", here->type->name, here->text[0] != '\0' ? " " : "", here->text);
        if (here->status == STATUS_OK)
            table_omitted(to, here);
        if (every_mesh)
            rows(to, s, j, p, done);
        if (every_mesh)
            parts(to, s, p);
        if (!table_lowest_cost(to, s, j, p, every_mesh, list))
            fprintf(to, "  no reference value, and no agreement of formulations\n");
    }
    free(done);
    free(list);
}

static const rounds_reading *time_of(const sweep *s, const reached *r)
{
    return &s->series[r->series].timing[r->mesh].as_is;
}

static void way(FILE *to, const sweep *s, const reached *r)
{
    const series *one = &s->series[r->series];
    fprintf(to, "%s, n = %d", one->formulation.key, one->mesh[r->mesh]);
    if (isfinite(r->cost))
        fprintf(to, ", cost %.3g ms", 1e3 * r->cost);
    if (time_of(s, r)->rounds > 0)
        fprintf(to, ", timed %.4g ms", 1e3 * rounds_least(time_of(s, r)));
    if (!isfinite(r->cost))
        fprintf(to, " (%s: no rank)", reach_unranked(one->formulation.type));
}

static void faster_ones(FILE *to, const sweep *s, const reached list[], int count, int ties)
{
    int reported = 0;
    for (int i = ties; i < count && list[i].defect == NULL; i++)
        if (isfinite(list[i].cost) &&
            rounds_compare(time_of(s, &list[i]), time_of(s, &list[0])) < 0) {
            fputs(reported++ > 0 ? "; " : "; higher counted cost, but faster in every round: ", to);
            way(to, s, &list[i]);
        }
}

static void defective_ones(FILE *to, const sweep *s, const reached list[], int count)
{
    for (int i = 0; i < count; i++) {
        int reported = 0;
        const char *words = reach_defect_words(list[i].defect->kind);
        for (int k = 0; k < i; k++)
            reported |= strcmp(words, reach_defect_words(list[k].defect->kind)) == 0;
        for (int k = reported ? count : i; k < count; k++)
            if (strcmp(words, reach_defect_words(list[k].defect->kind)) == 0) {
                if (k > i)
                    fputs("; ", to);
                else
                    fprintf(to, "; also within this error, %s: ", words);
                way(to, s, &list[k]);
            }
    }
}

/* Prints the formulations that pass, but whose cost is unknown. Returns the number of all
 * formulations that pass. */
static int unranked_ones(FILE *to, const sweep *s, const reached list[], int count)
{
    int i = 0, reported = 0;
    for (; i < count && list[i].defect == NULL; i++)
        if (!isfinite(list[i].cost)) {
            fputs(reported++ > 0 ? "; " : "; also within this error: ", to);
            way(to, s, &list[i]);
        }
    return i;
}

/* Returns a text with the formulation that has the lowest counted work at a point, and the
 * formulations tied with it. The caller frees the text; NULL: out of memory. */
static char *lowest_cost(const reach_question *q, reached list[])
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return NULL;
    const int count = reach_ranking(q, list), ties = reach_ties(list, count);
    for (int i = 0; i < ties; i++) {
        fputs(i > 0 ? "; " : "", to);
        way(to, q->s, &list[i]);
    }
    if (ties > 0) {
        fputs(ties > 1 ? ": costs tie" : "", to);
        faster_ones(to, q->s, list, count, ties);
        unranked_ones(to, q->s, list, count);
    } else {
        const int passes = count > 0 && list[0].defect == NULL;
        fputs(passes ? "none that ranks" : count > 0 ? "none that passes" : "none", to);
        const int sound = unranked_ones(to, q->s, list, count);
        defective_ones(to, q->s, list + sound, count - sound);
    }
    fclose(to);
    return text;
}

static int has_truth(const sweep *s, const evaluation *j, int at, int quantity)
{
    for (int i = 0; i < j->verdicts; i++)
        if (s->series[j->verdict[i].series].point == at && j->verdict[i].quantity == quantity &&
            j->verdict[i].truth != NULL)
            return 1;
    return 0;
}

typedef struct lowest_cost_result {
    int quantity, reported;
    char *text[REACH_LEVELS];
} lowest_cost_result;

static int same_text(const char *a, const char *b)
{
    return a != NULL && b != NULL && strcmp(a, b) == 0;
}

static int same_answer(const lowest_cost_result *a, const lowest_cost_result *b)
{
    int same = 1;
    for (int i = 0; i < REACH_LEVELS; i++)
        same &= same_text(a->text[i], b->text[i]);
    return same;
}

static void write_together(FILE *out, const scene *here, lowest_cost_result a[], int count)
{
    for (int level = 0, next; level < REACH_LEVELS; level = next) {
        paragraph words;
        FILE *to = paragraph_begin(&words, out);
        const char *before = "";
        for (int i = 0; i < count; i++)
            if (i == 0 || same_answer(&a[i], &a[0])) {
                a[i].reported = 1;
                fprintf(to, "%s%s", before, here->quantity[a[i].quantity].name);
                before = ", ";
            }
        before = " within ";
        for (next = level;
             next == level || (next < REACH_LEVELS && same_text(a->text[next], a->text[level]));
             before = ", ")
            fprintf(to, "%s%g", before, 100 * reach_level[next++]);
        fprintf(to, " %%: %s", a->text[level] != NULL ? a->text[level] : "out of memory");
        paragraph_end(&words, 0, 2);
    }
}

static int table_lowest_cost(FILE *to, const sweep *s, const evaluation *j, int at, int every,
                             reached list[])
{
    const scene *here = &s->point[at].scene;
    lowest_cost_result *a = calloc((size_t)here->quantities + 1, sizeof *a);
    int count = 0;
    for (int q = 0; a != NULL && q < here->quantities && (every || count == 0); q++) {
        if (!has_truth(s, j, at, q))
            continue;
        a[count].quantity = q;
        for (int level = 0; level < REACH_LEVELS; level++) {
            const reach_question requested = {s,  j->verdict, j->verdicts,
                                              at, q,          reach_level[level]};
            a[count].text[level] = lowest_cost(&requested, list);
        }
        count++;
    }
    for (int i = 0; i < count; i++)
        if (!a[i].reported)
            write_together(to, here, &a[i], count - i);
    for (int i = 0; i < count * REACH_LEVELS; i++)
        free(a[i / REACH_LEVELS].text[i % REACH_LEVELS]);
    free(a);
    return count;
}
