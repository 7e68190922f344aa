#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/scene/scene.h"

enum { NAME = 23, LIMIT = 16, UNCERTAINTY = 7, ORDER = 5, MOST_RULES = 16 };

typedef struct verdicts_block {
    FILE *to;
    const sweep *s;
    const sweep_point *at;
    int count;
    /* [count] verdicts of the point, which are set to NULL after printing */
    const verdict **verdict;
    int name;
    int rules;
    /* known deviations to which the table refers, with numbers from 1 */
    const rule *rule[MOST_RULES];
} verdicts_block;

static const series *series_of(const verdicts_block *b, const verdict *v)
{
    return &b->s->series[v->series];
}

static void print_columns(const verdicts_block *b)
{
    fprintf(b->to, "    %-*s %*s %*s %*s %12s %s\n", b->name, "formulation", LIMIT, "limit",
            UNCERTAINTY, "+-", ORDER, "order", "error", "verdict");
}

static void print_other_model(const verdicts_block *b, const truth *other)
{
    char value[ROUNDING_TEXT];
    rounding_known(other->value, other->uncertainty, value);
    paragraph_printf(b->to, 0, 4, "another model: %s (%s, %s)", value, other->kind, other->source);
}

static void print_quantity(const verdicts_block *b, const scene_quantity *q, const verdict *v)
{
    const truth *row = v->truth;
    fprintf(b->to, "  %s [%s]", q->name, q->unit);
    if (row != NULL) {
        fprintf(b->to, ", truth ");
        table_known(b->to, 1, row->value, row->uncertainty);
        if (row->uncertainty > 0) {
            fprintf(b->to, " +- ");
            table_digits(b->to, 1, row->uncertainty, 2);
        }
        fprintf(b->to, " (%s%s%s)", row->kind, row->theory[0] != '\0' ? ", " : "", row->theory);
    }
    fputc('\n', b->to);
    if (row != NULL && v->model_truth != NULL)
        print_other_model(b, v->model_truth);
}

/* Returns the number of a known deviation; 0: there is none, or the list is full. */
static int number_of_rule(verdicts_block *b, const rule *r)
{
    int i = 0;
    while (i < b->rules && b->rule[i] != r)
        i++;
    if (r == NULL || i == MOST_RULES)
        return 0;
    if (i == b->rules)
        b->rule[b->rules++] = r;
    return i + 1;
}

static void add_difference(const verdict *v, char *text, size_t size)
{
    const truth *other = v->model_truth;
    if (v->kind == VERDICT_OTHER_MODEL && strcmp(other->kind, "agreement") != 0)
        snprintf(text, size, "; %+.3g %% from the reference value (%s)", 100 * v->model_error,
                 other->kind);
    else if (other->theory[0] != '\0')
        snprintf(text, size, "; %+.3g %% from %s", 100 * v->model_error, other->theory);
    else
        snprintf(text, size, "; %+.3g %% from %s (%s)", 100 * v->model_error,
                 strcmp(other->kind, "agreement") == 0 ? "the value on which families agree"
                                                       : "another model",
                 other->kind);
}

static void verdict_words(verdicts_block *b, const verdict *v, char *text, size_t size)
{
    const int number = v->matches ? number_of_rule(b, v->rule) : 0;
    int used = snprintf(text, size, "%s", verdict_name(v->kind));
    if (!v->matches)
        used +=
            snprintf(text + used, size - (size_t)used, "  << expected %s",
                     v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    else if (number > 0)
        used += snprintf(text + used, size - (size_t)used, " [%d]", number);
    if (v->truth == NULL && isfinite(v->model_error))
        add_difference(v, text + used, size - (size_t)used);
}

static void print_verdict(verdicts_block *b, const verdict *v)
{
    const char *name = series_of(b, v)->formulation.key;
    const int column = 4 + b->name + LIMIT + UNCERTAINTY + ORDER + 3 + 12 + 1;
    char words[160];
    const int begun = fprintf(b->to, "    %-*s", b->name, name);
    if (begun > 4 + b->name)
        fprintf(b->to, "\n%*s", 4 + b->name, "");
    fputc(' ', b->to);
    table_known(b->to, LIMIT, v->fit.limit, v->fit.limit_uncertainty);
    fputc(' ', b->to);
    table_digits(b->to, UNCERTAINTY, v->fit.limit_uncertainty, 2);
    table_value(b->to, ORDER + 1, 2, 'f', v->fit.order);
    table_percent(b->to, v->error);
    verdict_words(b, v, words, sizeof words);
    fputc(' ', b->to);
    paragraph_write(b->to, column, 6, words);
    if (v->reason[0] != '\0' && v->kind != VERDICT_OTHER_MODEL)
        paragraph_printf(b->to, 0, 6, "%s", v->reason);
}

static void print_evaluated(verdicts_block *b, int quantity)
{
    const scene_quantity *q = &b->at->scene.quantity[quantity];
    for (int i = 0; i < b->count; i++) {
        const verdict *first = b->verdict[i];
        if (first == NULL || first->quantity != quantity || first->kind == VERDICT_SKIP)
            continue;
        print_quantity(b, q, first);
        for (int k = i; k < b->count; k++) {
            const verdict *v = b->verdict[k];
            if (v == NULL || v->quantity != quantity || v->kind == VERDICT_SKIP ||
                v->truth != first->truth)
                continue;
            print_verdict(b, v);
            b->verdict[k] = NULL;
        }
    }
}

static void print_skipped(verdicts_block *b)
{
    for (int i = 0; i < b->count; i++) {
        const verdict *first = b->verdict[i];
        paragraph words;
        int names = 0, last = -1;
        if (first == NULL)
            continue;
        FILE *line = paragraph_begin(&words, b->to);
        fprintf(line, "skip: %s: ", first->reason);
        for (int k = i; k < b->count; k++) {
            const verdict *v = b->verdict[k];
            if (v == NULL || strcmp(v->reason, first->reason) != 0)
                continue;
            if (v->series != last)
                fprintf(line, "%s%s", names++ > 0 ? ", " : "", series_of(b, v)->formulation.key);
            last = v->series;
            if (v != first)
                b->verdict[k] = NULL;
        }
        paragraph_end(&words, 0, 2);
    }
}

static void print_omissions(const verdicts_block *b)
{
    const sweep *s = b->s;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        char text[OMISSION_TEXT];
        paragraph words;
        int first = &s->point[one->point] == b->at && one->without.what != 0;
        for (int k = 0; k < i && first; k++)
            first =
                s->series[k].point != one->point || s->series[k].without.what != one->without.what;
        if (!first)
            continue;
        omission_words(&one->without, text);
        FILE *line = paragraph_begin(&words, b->to);
        for (int k = i; k < s->seriess; k++)
            if (s->series[k].point == one->point && s->series[k].without.what == one->without.what)
                fprintf(line, "%s%s", k > i ? ", " : "", s->series[k].formulation.key);
        fprintf(line, ": %s", text);
        paragraph_end(&words, 0, 2);
    }
}

static void print_rules(const verdicts_block *b)
{
    for (int i = 0; i < b->rules; i++)
        paragraph_printf(b->to, 0, 2, "[%d] %s: %s", i + 1, b->rule[i]->name, b->rule[i]->cause);
}

static void print_point(verdicts_block *b, const evaluation *j, int index)
{
    b->count = b->rules = b->name = 0;
    b->at = &b->s->point[index];
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        if (series_of(b, v)->point != index)
            continue;
        b->verdict[b->count++] = v;
        const int width = paragraph_columns(series_of(b, v)->formulation.key);
        b->name = width <= NAME && width > b->name ? width : b->name;
    }
    if (b->count == 0)
        return;
    fputc('\n', b->to);
    table_point(b->to, b->at);
    fputc('\n', b->to);
    table_omitted(b->to, b->at);
    b->name = b->name > 11 ? b->name : 11;
    print_columns(b);
    for (int q = 0; q < b->at->scene.quantities; q++)
        print_evaluated(b, q);
    print_skipped(b);
    print_omissions(b);
    print_rules(b);
}

void table_verdicts(FILE *to, const sweep *s, const evaluation *j)
{
    verdicts_block b = {
        .to = to, .s = s, .verdict = calloc((size_t)j->verdicts + 1, sizeof(verdict *))};
    for (int i = 0; i < s->points && b.verdict != NULL; i++)
        print_point(&b, j, i);
    free(b.verdict);
}

enum { MOST_RUNS = 6, WORDS = 400 };

const char *table_stability_word(step_stability which)
{
    static const char *const word[STEP_STABILITIES] = {"?", "?", "yes", "no", "no", "held"};
    return word[which];
}

static const char *const words_of[] = {[STEP_OPEN] = "not determined by pivots",
                                       [STEP_NO_DIVERGENCE] = "no divergence",
                                       [STEP_STABLE] = "stable",
                                       [STEP_UNSTABLE] = "unstable",
                                       [STEP_GROWS] = "unstable",
                                       [STEP_HELD] = "stable without damping"};

static void add(char *text, const char *word)
{
    const size_t used = strlen(text);
    snprintf(text + used, WORDS - used, "%s", word);
}

/* Describes steps `first` to `last` of a path, which have the same stability. begin 1: they are the
 * first steps of the path; end 1: the last. */
static void add_run(const solve_result *r, int first, int last, int begin, int end, char *text)
{
    const step_record *a = &r->step[first], *b = &r->step[last];
    char run[160];
    if (begin && end)
        snprintf(run, sizeof run, "%s all along", words_of[a->stability]);
    else if (begin)
        snprintf(run, sizeof run, "%s up to %.6g", words_of[a->stability], b->path);
    else if (end)
        snprintf(run, sizeof run, ", %s from %.6g", words_of[a->stability], a->path);
    else if (first == last)
        snprintf(run, sizeof run, ", %s at %.6g", words_of[a->stability], a->path);
    else
        snprintf(run, sizeof run, ", %s %.6g to %.6g", words_of[a->stability], a->path, b->path);
    add(text, run);
}

/* Describes a path, for example "stable up to 1.35, unstable 1.4 to 1.6, stable from 1.65". The
 * text is "" if the whole path is stable or if its stability is unknown. */
static void words_of_path(const solve_result *r, int analysis, char text[WORDS])
{
    int begin = -1, last = -1, runs = 0, reported = 0;
    text[0] = '\0';
    for (int i = 0; i < r->steps; i++)
        if (r->step[i].analysis == analysis) {
            begin = begin < 0 ? i : begin;
            last = i;
            reported |= r->step[i].stability != STEP_STABLE &&
                        (r->step[i].negative_pivots > 0 || r->step[i].stability != STEP_OPEN);
        }
    for (int i = begin; reported && i >= 0 && i <= last; runs++) {
        int end = i;
        while (end < last && r->step[end + 1].stability == r->step[i].stability)
            end++;
        if (runs < MOST_RUNS)
            add_run(r, i, end, i == begin, end == last, text);
        else if (runs == MOST_RUNS)
            add(text, ", and so on");
        i = end + 1;
    }
}

int table_stability_paths(FILE *to, const scene *s, const solve_result *r)
{
    int lines = 0;
    for (int i = 0; i < s->analyses; i++) {
        char words[WORDS];
        words_of_path(r, i, words);
        if (words[0] == '\0')
            continue;
        const int column = fprintf(to, "%s: ", scene_called(s, SCENE_ANALYSES, i).text);
        paragraph_printf(to, column, 2, "%s (%s)", words,
                         s->analysis[i].kind == SCENE_CONTINUATION ? "load factor" : "path");
        lines++;
    }
    return lines;
}

static int met_unstable(const solve_result *r)
{
    for (int i = 0; i < r->steps; i++)
        if (result_is_unstable(r->step[i].stability))
            return 1;
    return 0;
}

void table_stability_meshes(FILE *to, const sweep *s)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const scene *what = &s->point[one->point].scene;
        int unstable = 0;
        for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++)
            unstable += met_unstable(&one->cell[k].solve);
        if (unstable == 0)
            continue;
        fprintf(to, "\n%s had unstable states:\n", one->formulation.key);
        for (int k = 0; k < one->meshes; k++) {
            const solve_result *r = &one->cell[k].solve;
            const int column = fprintf(to, "  n = %d: ", one->mesh[k]);
            char words[WORDS] = "";
            for (int a = 0; a < what->analyses && words[0] == '\0'; a++)
                words_of_path(r, a, words);
            paragraph_printf(to, column, 4, "%s%s%s", words[0] != '\0' ? words : "stable all along",
                             r->status != STATUS_OK ? "; " : "",
                             r->status != STATUS_OK ? r->reason : "");
        }
    }
}
