#include "harness/terminal/terminal_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEAD = 8,
    COLUMN = 15,
    COLUMNS = (PARAGRAPH_WIDTH - HEAD) / COLUMN,
    LINE = 1000,
    DIGITS = 9
};

typedef struct beside_column {
    const series *one;
    const truth *row; /* reference value; NULL: none */
    verdict shown;
    const char *name; /* rest of the name, which the header does not contain yet */
    char title[FORMULATION_KEY + 16];
} beside_column;

typedef struct block {
    const scene_quantity *q;
    int quantity, count;
    int known;
    beside_column list[COLUMNS];
} block;

/* Returns the length of the part of a name that a line contains, up to the last separator that
 * fits. */
static int piece_of(const char *name)
{
    const int length = (int)strlen(name);
    int fits = 0;
    if (length < COLUMN)
        return length;
    for (int i = 0; i < COLUMN - 1; i++)
        if (strchr("_:,= ", name[i]) != NULL)
            fits = i + 1;
    return fits > 0 ? fits : COLUMN - 1;
}

/* Writes one line of the column names. Returns 0 if the names are complete. */
static int write_names(FILE *to, block *b, const char *head)
{
    int left = 0, last = -1;
    for (int i = 0; i < b->count; i++)
        last = b->list[i].name[0] != '\0' ? i : last;
    fprintf(to, "%*s", HEAD, head);
    for (int i = 0; i <= last; i++) {
        beside_column *c = &b->list[i];
        const int length = piece_of(c->name);
        fprintf(to, " %*.*s", COLUMN - 1, length, c->name);
        c->name += length;
        left += c->name[0] != '\0';
    }
    fputc('\n', to);
    return left;
}

static const solve_result *result_of(const series *one, int elements)
{
    for (int k = 0; k < one->meshes; k++)
        if (one->mesh[k] == elements)
            return &one->cell[k].solve;
    return NULL;
}

/* Writes the error, the value if there is no reference value, or the reason why there is no
 * value. */
static void write_cell(FILE *to, const block *b, const beside_column *c, int elements)
{
    const solve_result *r = result_of(c->one, elements);
    const double x =
        r != NULL && b->quantity < r->quantities ? r->quantity[b->quantity].value : (double)NAN;
    char text[ROUNDING_TEXT] = "-";
    if (r != NULL && !isfinite(x))
        snprintf(text, sizeof text, "%s",
                 status_name(r->status == STATUS_OK ? STATUS_NO_VALUE : r->status));
    else if (c->row != NULL)
        rounding_percent(verdict_error(b->q, x, c->row->value), text);
    else
        rounding_digits(x, DIGITS, text);
    fprintf(to, "%*s", COLUMN, text);
}

static void write_limit(FILE *to, const block *b, const beside_column *c)
{
    char text[ROUNDING_TEXT];
    if (c->row != NULL)
        rounding_percent(verdict_error(b->q, c->shown.fit.limit, c->row->value), text);
    else
        rounding_known(c->shown.fit.limit, c->shown.fit.limit_uncertainty, text);
    fprintf(to, "%*s", COLUMN, text);
}

static void write_uncertainty(FILE *to, const block *b, const beside_column *c)
{
    const double own = c->shown.fit.limit_uncertainty;
    const double shown =
        c->row != NULL ? 100 * fabs(verdict_error(b->q, c->row->value + own, c->row->value)) : own;
    char text[ROUNDING_TEXT], unit[ROUNDING_TEXT + 2];
    rounding_digits(shown, 2, text);
    snprintf(unit, sizeof unit, "%s%s", text, c->row != NULL && isfinite(shown) ? " %" : "");
    fprintf(to, "%*s", COLUMN, unit);
}

static void write_order(FILE *to, const block *b, const beside_column *c)
{
    (void)b;
    table_value(to, COLUMN, 2, 'f', c->shown.fit.order);
}

static void write_row(FILE *to, const block *b, const char *head,
                      void (*cell)(FILE *, const block *, const beside_column *))
{
    fprintf(to, "%*s", HEAD, head);
    for (int i = 0; i < b->count; i++)
        cell(to, b, &b->list[i]);
    fputc('\n', to);
}

static void write_meshes(FILE *to, const block *b)
{
    for (int last = 0, next = 0;; last = next) {
        next = 0;
        for (int i = 0; i < b->count; i++)
            for (int k = 0; k < b->list[i].one->meshes; k++) {
                const int n = b->list[i].one->mesh[k];
                next = n > last && (next == 0 || n < next) ? n : next;
            }
        if (next == 0)
            return;
        fprintf(to, "%*d", HEAD, next);
        for (int i = 0; i < b->count; i++)
            write_cell(to, b, &b->list[i], next);
        fputc('\n', to);
    }
}

/* Describes a verdict with its word. A verdict without a reference value has no word. */
static void describe(const verdict *v, double least_order, char *text, size_t size)
{
    char sentence[2 * FAULT_TEXT];
    const char *word = v->kind == VERDICT_NO_TRUTH ? "" : verdict_name(v->kind);
    sentence_of_verdict(v, least_order, sentence, sizeof sentence);
    const int named = strstr(sentence, word) != NULL;
    snprintf(text, size, "%s%s%s", named ? "" : word, named ? "" : ": ", sentence);
}

static void write_sentences(FILE *to, const block *b)
{
    for (int i = 0; i < b->count; i++) {
        char text[2 * FAULT_TEXT + 64];
        const beside_column *c = &b->list[i];
        if (c->shown.kind == VERDICT_PASS || c->shown.kind == VERDICT_OTHER_MODEL)
            continue;
        if (c->shown.kind == VERDICT_NO_TRUTH && (c->row != NULL || !b->known))
            continue;
        describe(&c->shown, b->q->least_order, text, sizeof text);
        paragraph_write(to, fprintf(to, "  %s: ", c->one->formulation.key), 4, text);
    }
}

static void write_block(FILE *to, block *b)
{
    const char *head = "n";
    for (int i = 0; i < b->count; i++)
        b->list[i].name = b->list[i].title;
    while (write_names(to, b, head))
        head = "";
    write_meshes(to, b);
    write_row(to, b, "limit", write_limit);
    write_row(to, b, "+-", write_uncertainty);
    write_row(to, b, "order", write_order);
    write_sentences(to, b);
}

/* Appends a reference value, such as "; exact 11419457.12 (haringx)". For an agreement, appends the
 * names of the formulations that agree. */
static void add_truth(char *line, size_t size, const truth *row)
{
    const size_t used = strlen(line);
    char value[ROUNDING_TEXT];
    rounding_known(row->value, row->uncertainty, value);
    const int agreed = strcmp(row->kind, "agreement") == 0;
    snprintf(line + used, size - used, "%s%s %s%s%s%s%s%s", used > 0 ? "; " : "errors against ",
             row->kind, value, row->theory[0] != '\0' ? " (" : "", row->theory,
             row->theory[0] != '\0' ? ")" : "", agreed ? ", no reference value: " : "",
             agreed ? row->source : "");
}

static void write_why(FILE *to, int at, const sweep *s, const truths *t, int quantity)
{
    paragraph words;
    FILE *text = paragraph_begin(&words, to);
    fputs("values: no reference value and no agreement of formulations: ", text);
    families_why(text, s, 0, quantity, t);
    paragraph_end(&words, at, 4);
}

/* Writes the name, the unit, the reference values of the formulations without repetition (or the
 * reason why there are none), and the analytic estimate. Returns 0 if there is no reference
 * value. */
static int write_heading(FILE *to, const sweep *s, const truths *t, int quantity)
{
    const sweep_point *p = &s->point[0];
    const scene_quantity *q = &p->scene.quantity[quantity];
    char line[LINE] = "";
    const truth *last = NULL;
    for (int i = 0; i < s->seriess; i++) {
        const truth *row = verdict_reference(t, p, &s->series[i].formulation, quantity);
        int known = row == NULL || s->series[i].missing[0] != '\0' || row == last;
        for (int k = 0; k < i && !known; k++)
            known = s->series[k].missing[0] == '\0' &&
                    verdict_reference(t, p, &s->series[k].formulation, quantity) == row;
        if (!known)
            add_truth(line, sizeof line, row);
        last = row != NULL && s->series[i].missing[0] == '\0' ? row : last;
    }
    const int at = fprintf(to, "\n%s [%s], ", q->name, q->unit) - 1;
    if (line[0] != '\0')
        paragraph_write(to, at, 4, line);
    else
        write_why(to, at, s, t, quantity);
    if (q->prediction.source != NULL)
        fprintf(to, "  estimate %.8g %s (%s, analytic)\n", q->prediction.value, q->unit,
                q->prediction.source);
    return line[0] != '\0';
}

static void write_quantity(FILE *to, const sweep *s, const truths *t, int quantity)
{
    block b = {.q = &s->point[0].scene.quantity[quantity], .quantity = quantity};
    int blocks = 0;
    b.known = write_heading(to, s, t, quantity);
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        if (one->missing[0] == '\0') {
            beside_column *c = &b.list[b.count++];
            *c = (beside_column){
                .one = one,
                .row = verdict_reference(t, &s->point[0], &one->formulation, quantity),
                .shown = {.series = i, .quantity = quantity}};
            snprintf(c->title, sizeof c->title, "%s%s", one->formulation.key,
                     one->without.other ? " (other model)" : "");
            verdict_reach(s, t, &c->shown);
        }
        if (b.count == COLUMNS || (b.count > 0 && i + 1 == s->seriess)) {
            if (blocks++ > 0)
                fputc('\n', to);
            write_block(to, &b);
            b.count = 0;
        }
    }
}

static void write_missing(FILE *to, const sweep *s)
{
    for (int i = 0; i < s->seriess; i++) {
        const char *missing = s->series[i].missing;
        char line[LINE] = "";
        int first = 1;
        for (int k = 0; k < i; k++)
            first &= strcmp(s->series[k].missing, missing) != 0;
        if (missing[0] == '\0' || !first)
            continue;
        for (int k = i; k < s->seriess; k++)
            if (strcmp(s->series[k].missing, missing) == 0)
                snprintf(line + strlen(line), sizeof line - strlen(line), "%s%s", k > i ? ", " : "",
                         s->series[k].formulation.key);
        paragraph_printf(to, fprintf(to, "not run, "), 4, "does not support %s: %s", missing, line);
    }
}

static void write_omissions(FILE *to, const sweep *s)
{
    for (int i = 0; i < s->seriess; i++) {
        char words[OMISSION_TEXT];
        omission_words(&s->series[i].without, words);
        if (words[0] != '\0')
            paragraph_write(to, fprintf(to, "%s: ", s->series[i].formulation.key), 4, words);
    }
}

void table_beside(FILE *to, const sweep *s, const truths *t)
{
    table_point(to, &s->point[0]);
    fputc('\n', to);
    table_omitted(to, &s->point[0]);
    for (int q = 0; q < s->point[0].scene.quantities; q++)
        if (s->point[0].scene.quantity[q].reduction != SCENE_CURVE)
            write_quantity(to, s, t, q);
    table_curves_errors(to, s);
    table_stability_meshes(to, s);
    fputc('\n', to);
    write_omissions(to, s);
    write_missing(to, s);
}

enum { CONVERGENCE_DIGITS = 10, VALUE = 20 };

static void prediction_line(FILE *to, const scene_quantity *q, const truth *row)
{
    char source[FAULT_TEXT];
    int column = fprintf(to, "  %-10s", "estimate");
    table_digits(to, VALUE - 4, q->prediction.value, CONVERGENCE_DIGITS);
    table_percent(to, row != NULL ? verdict_error(q, q->prediction.value, row->value) : NAN);
    snprintf(source, sizeof source, "%s, analytic", q->prediction.source);
    column += VALUE - 4 + 12 + fprintf(to, "  ");
    paragraph_write(to, column, 4, source);
}

static void mesh_line(FILE *to, const series *one, int mesh, int quantity, const scene_quantity *q,
                      const truth *row)
{
    const solve_result *r = &one->cell[mesh].solve;
    const int known = quantity < r->quantities;
    const double x = known ? r->quantity[quantity].value : NAN;
    char seconds[ROUNDING_TEXT];
    int column = fprintf(to, "  %6d", one->mesh[mesh]) + VALUE + 12;
    table_digits(to, VALUE, x, CONVERGENCE_DIGITS);
    table_percent(to, row != NULL ? verdict_error(q, x, row->value) : NAN);
    rounding_digits(r->seconds_setup + r->seconds_solve, 3, seconds);
    column += fprintf(to, " %9s s", seconds);
    if (!isfinite(x))
        paragraph_printf(to, column, column + 2, "%s",
                         known ? r->quantity[quantity].reason : r->reason);
    else
        fputc('\n', to);
}

static void limit_line(FILE *to, const verdict *v, const scene_quantity *q, const truth *row)
{
    char sentence[2 * FAULT_TEXT + 64], limit[ROUNDING_TEXT], uncertainty[ROUNDING_TEXT],
        known[ROUNDING_TEXT] = "", order[ROUNDING_TEXT];
    describe(v, q->least_order, sentence, sizeof sentence);
    rounding_known(v->fit.limit, v->fit.limit_uncertainty, limit);
    rounding_digits(v->fit.limit_uncertainty, 2, uncertainty);
    rounding_digits(v->fit.order, 3, order);
    if (row != NULL)
        rounding_known(row->value, row->uncertainty, known);
    const int at = fprintf(to, "  limit ");
    if (row != NULL)
        paragraph_printf(to, at, 4, "%s +- %s, order %s; %s %s: %s", limit, uncertainty, order,
                         row->kind, known, sentence);
    else
        paragraph_printf(to, at, 4, "%s +- %s, order %s", limit, uncertainty, order);
}

static void quantity_block(FILE *to, const sweep *s, const truths *t, int index, int quantity)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const scene_quantity *q = &p->scene.quantity[quantity];
    const truth *row = verdict_reference(t, p, &one->formulation, quantity);
    verdict v = {.series = index, .quantity = quantity};
    fprintf(to, "  %s [%s]\n", q->name, q->unit);
    for (int k = 0; k < one->meshes; k++)
        mesh_line(to, one, k, quantity, q, row);
    verdict_reach(s, t, &v);
    limit_line(to, &v, q, row);
    if (q->prediction.source != NULL)
        prediction_line(to, q, row);
}

void table_convergence(FILE *to, const sweep *s, const truths *t)
{
    for (int i = 0; i < s->points; i++)
        table_omitted(to, &s->point[i]);
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const scene *wanted = &s->point[one->point].scene;
        table_series(to, s, i);
        if (one->missing[0] != '\0') {
            paragraph_printf(to, 0, 2, "skip: does not support %s", one->missing);
            continue;
        }
        table_theory(to, wanted, one->formulation.type);
        for (int q = 0; q < wanted->quantities; q++)
            if (wanted->quantity[q].reduction != SCENE_CURVE)
                quantity_block(to, s, t, i, q);
    }
    if (s->points > 0)
        table_curves_errors(to, s);
    table_stability_meshes(to, s);
}
