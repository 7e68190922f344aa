#include "harness/terminal/terminal.h"

#include <stdlib.h>
#include <string.h>

/* Prints "case (parameters), formulation, n = 1, 2: STATUS: WHY" for the meshes of a series without
 * a solution. The status and the reason are those of the finest of these meshes. */
static void failed_series(FILE *to, const sweep *s, int index, int *lines)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const solve_result *last = NULL;
    char meshes[16 * SERIES_MAX_MESHES] = "";
    for (int k = 0; k < one->meshes && one->missing[0] == '\0'; k++) {
        const size_t used = strlen(meshes);
        if (one->cell[k].solve.status == STATUS_OK)
            continue;
        snprintf(meshes + used, sizeof meshes - used, "%s%d", last != NULL ? ", " : "",
                 one->mesh[k]);
        last = &one->cell[k].solve;
    }
    if (last == NULL)
        return;
    if ((*lines)++ == 0)
        fprintf(to, "\nruns without a solution\n");
    const int at = fprintf(to, "  %s", p->type->name);
    paragraph_printf(to, at, 4, "%s%s%s, %s, n = %s: %s: %s", p->text[0] != '\0' ? " (" : "",
                     p->text, p->text[0] != '\0' ? ")" : "", one->formulation.key, meshes,
                     status_name(last->status), last->reason);
}

static void failed_cells(FILE *to, const sweep *s)
{
    int lines = 0;
    for (int i = 0; i < s->seriess; i++)
        failed_series(to, s, i, &lines);
}

static void coverage_lines(FILE *to, const evaluation *j)
{
    if (j->coverages > 0)
        fprintf(to, "\nlimits within their uncertainty of exact values: all meshes, and without "
                    "the 1, 2, 3 finest\n");
    for (int i = 0; i < j->coverages; i++) {
        coverage sum = {.type = j->coverage[i].type};
        int before = 0;
        for (int k = 0; k < j->coverages; k++) {
            before |= k < i && j->coverage[k].type == sum.type;
            if (j->coverage[k].type == sum.type)
                for (int m = 0; m < COVERAGE_MESHES; m++) {
                    sum.series[m] += j->coverage[k].series[m];
                    sum.covered[m] += j->coverage[k].covered[m];
                }
        }
        if (before)
            continue;
        fprintf(to, "  %-24s", sum.type->name);
        for (int m = 0; m < COVERAGE_MESHES; m++)
            fprintf(to, "  %4d of %4d", sum.covered[m], sum.series[m]);
        fputc('\n', to);
    }
}

static void contradictions(FILE *to, const sweep *s, const evaluation *j)
{
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        int count = 0, before = 0;
        if (v->contradicted != NULL)
            for (int k = 0; k < j->verdicts; k++) {
                count += j->verdict[k].contradicted == v->contradicted;
                before |= k < i && j->verdict[k].contradicted == v->contradicted;
            }
        if (count == 0 || before)
            continue;
        const sweep_point *p = &s->point[s->series[v->series].point];
        fprintf(to, "\n%s", p->type->name);
        paragraph_printf(to, (int)strlen(p->type->name), 2,
                         "%s%s, %s: limits that contradict the published value %.10g +- %.1g: %d, "
                         "such as %.10g (%s)",
                         p->text[0] != '\0' ? ": " : "", p->text, v->contradicted->quantity,
                         v->contradicted->value, v->contradicted->uncertainty, count, v->fit.limit,
                         s->series[v->series].formulation.key);
    }
}

static int count_contradicted(const evaluation *j)
{
    int count = 0;
    for (int i = 0; i < j->verdicts; i++) {
        int before = 0;
        for (int k = 0; k < i && j->verdict[i].contradicted != NULL; k++)
            before |= j->verdict[k].contradicted == j->verdict[i].contradicted;
        count += j->verdict[i].contradicted != NULL && !before;
    }
    return count;
}

void table_run_details(FILE *to, const sweep *s, const evaluation *j)
{
    contradictions(to, s, j);
    failed_cells(to, s);
    coverage_lines(to, j);
}

static void print_kinds(FILE *to, const evaluation *j)
{
    int parts = 0;
    for (int k = 0; k < VERDICT_KINDS; k++)
        if (j->by_kind[k] > 0 && k != VERDICT_SKIP && k != VERDICT_NO_TRUTH &&
            k != VERDICT_OTHER_MODEL)
            fprintf(to, "%s%d %s", parts++ > 0 ? "; " : " ", j->by_kind[k],
                    verdict_name((verdict_kind)k));
}

static void print_verdicts(FILE *to, const evaluation *j)
{
    const struct {
        int count;
        const char *words;
    } more[] = {{j->by_kind[VERDICT_SKIP], "not supported (skip)"},
                {j->by_kind[VERDICT_OTHER_MODEL], "of another model"},
                {j->by_kind[VERDICT_NO_TRUTH], "without a reference value"}};
    int parts = 0, left = 0;
    paragraph words;
    FILE *line = paragraph_begin(&words, to);
    fprintf(line, "%d verdict%s against reference values%s", j->evaluated,
            j->evaluated == 1 ? "" : "s", j->evaluated > 0 ? ":" : "");
    print_kinds(line, j);
    for (int i = 0; i < 3; i++)
        left += more[i].count > 0;
    for (int i = 0; i < 3; i++) {
        if (more[i].count == 0)
            continue;
        fprintf(line, "%s %d %s",
                parts == 0          ? "; besides"
                : parts + 1 == left ? " and"
                                    : ",",
                more[i].count, more[i].words);
        parts++;
    }
    paragraph_end(&words, 0, 0);
}

void table_run(FILE *to, const sweep *s, const evaluation *j, double seconds)
{
    const int contradicted = count_contradicted(j);
    fprintf(to, "%d runs, and %d more to measure rounding scatter, in %.3g s", sweep_cells(s),
            noise_cells(s), seconds);
    if (s->unfinished > 0)
        fprintf(to,
                s->partial ? "; runs that are missing: %d"
                           : "; interrupted, runs that are missing: %d",
                s->unfinished);
    fputc('\n', to);
    print_verdicts(to, j);
    if (j->agreements > 0)
        fprintf(to, "%d of %d stored discrete values agree\n", j->agreements - j->disagreements,
                j->agreements);
    if (j->waiting > 0)
        fprintf(to, "reference values without a formulation that supports their physics: %d\n",
                j->waiting);
    if (j->unread > 0)
        fprintf(to,
                "reference values for times and structures of motions that verify does not run: "
                "%d; 'make lab L=motions' checks them\n",
                j->unread);
    if (contradicted > 0)
        fprintf(to,
                "published values contradicted by limits that agree with a better reference value: "
                "%d (-v lists them)\n",
                contradicted);
}

void table_run_end(FILE *to, screen look, const char *sentence)
{
    const size_t word = strcspn(sentence, ":");
    char begin[32];
    if (sentence[0] == '\0')
        return;
    snprintf(begin, sizeof begin, "%.*s", (int)word, sentence);
    screen_put(to, look, strcmp(begin, "PASS") == 0 ? SCREEN_GOOD : SCREEN_BAD, begin);
    paragraph_write(to, (int)word, 0, sentence + word);
}

enum { WIDEST_WORD = 24, NARROWEST_WORD = 5, HEAD_LINES = 12 };

typedef struct head {
    int lines, width;
    char line[HEAD_LINES][WIDEST_WORD + 1];
} head;

/* The columns from `from` to `to` - 1. */
typedef struct overview_block {
    int from, to;
    int name;
    head *head; /* [columns] */
} overview_block;

/* Returns the length of the first piece of a name. The piece has as many words as fit into `limit`.
 * A longer word is hyphenated. */
static int piece_of(const char *name, int limit, int *cut)
{
    int fits = 0;
    *cut = 0;
    for (int word = 0; name[word] != '\0';) {
        word += (int)strcspn(name + word, "_:=,- ");
        word += name[word] != '\0';
        if (word > limit)
            break;
        fits = word;
    }
    if (fits > 0)
        return fits;
    const int whole = (int)strcspn(name, "_:=,- "), most = (3 * whole + 4) / 5;
    *cut = 1;
    return most < limit - 1 ? most : limit - 1;
}

static head head_of(const char *name, int limit, const char *mark)
{
    head out = {0};
    if (mark[0] != '\0') {
        out.width = snprintf(out.line[0], sizeof out.line[0], "%s", mark);
        out.lines = 1;
    }
    while (*name != '\0' && out.lines < HEAD_LINES) {
        int cut;
        const int length = piece_of(name, limit, &cut);
        snprintf(out.line[out.lines], sizeof out.line[0], "%.*s%s", length, name, cut ? "-" : "");
        const int width = paragraph_columns(out.line[out.lines++]);
        out.width = width > out.width ? width : out.width;
        name += length;
    }
    return out;
}

/* Sets the headers of a block whose names are divided into words of at most `limit` characters.
 * Returns its width. */
static int width_with(const overview *o, screen look, overview_block *b, int limit)
{
    char text[OVERVIEW_TEXT];
    int sum = b->name;
    for (int c = b->from; c < b->to; c++) {
        b->head[c] = head_of(o->column[c], limit, c >= o->accepted ? "(new)" : "");
        for (int r = 0; r < o->rows; r++) {
            overview_text(overview_at(o, r, c), look.utf8, text);
            const int width = paragraph_columns(text);
            b->head[c].width = width > b->head[c].width ? width : b->head[c].width;
        }
        sum += 1 + b->head[c].width;
    }
    return sum;
}

static void lay_out(const overview *o, screen look, overview_block *b)
{
    for (b->to = o->columns; b->to > b->from + 1; b->to--)
        for (int limit = WIDEST_WORD; limit >= NARROWEST_WORD; limit--)
            if (width_with(o, look, b, limit) <= PARAGRAPH_WIDTH)
                return;
    width_with(o, look, b, NARROWEST_WORD);
}

static void print_head(FILE *to, const overview_block *b)
{
    int lines = 0;
    for (int c = b->from; c < b->to; c++)
        lines = b->head[c].lines > lines ? b->head[c].lines : lines;
    for (int i = 0; i < lines; i++) {
        int blanks = b->name;
        for (int c = b->from; c < b->to; c++) {
            const head *h = &b->head[c];
            const int at = i - (lines - h->lines);
            const char *text = at >= 0 ? h->line[at] : "";
            if (text[0] != '\0')
                fprintf(to, "%*s %s", blanks, "", text);
            blanks = text[0] != '\0' ? h->width - paragraph_columns(text) : blanks + 1 + h->width;
        }
        fputc('\n', to);
    }
}

static screen_ink ink_of(const overview_cell *c)
{
    if (c->unexpected)
        return SCREEN_BAD;
    if (c->mark == OVERVIEW_PASS)
        return SCREEN_GOOD;
    return c->mark == OVERVIEW_NOTHING ? SCREEN_FAINT : SCREEN_PLAIN;
}

static void print_row(FILE *to, screen look, const overview *o, const overview_block *b, int row)
{
    int blanks = b->name - paragraph_columns(o->row[row]->name);
    fprintf(to, "%s", o->row[row]->name);
    for (int c = b->from; c < b->to; c++) {
        char text[OVERVIEW_TEXT];
        overview_text(overview_at(o, row, c), look.utf8, text);
        fprintf(to, "%*s ", blanks, "");
        screen_put(to, look, ink_of(overview_at(o, row, c)), text);
        blanks = b->head[c].width - paragraph_columns(text);
    }
    fputc('\n', to);
}

static void print_block(FILE *to, screen look, const overview *o, const overview_block *b)
{
    print_head(to, b);
    for (int r = 0; r < o->rows; r++)
        if (overview_shown(o, r))
            print_row(to, look, o, b, r);
}

static int width_of_names(const overview *o)
{
    int width = 0;
    for (int r = 0; r < o->rows; r++)
        if (overview_shown(o, r)) {
            const int here = paragraph_columns(o->row[r]->name);
            width = here > width ? here : width;
        }
    return width;
}

static void print_unshown(FILE *to, const overview *o, int evaluated, const char *what)
{
    paragraph words;
    int all = 0, named = 0;
    for (int r = 0; r < o->rows; r++)
        all += !overview_shown(o, r) && overview_evaluated(o, r) == evaluated;
    if (all == 0)
        return;
    FILE *list = paragraph_begin(&words, to);
    fprintf(list, "%d %s: ", all, what);
    for (int r = 0; r < o->rows; r++)
        if (!overview_shown(o, r) && overview_evaluated(o, r) == evaluated)
            fprintf(list, "%s%s", named++ > 0 ? ", " : "", o->row[r]->name);
    paragraph_end(&words, 0, 0);
}

static void print_passing(FILE *to, const overview *o)
{
    print_unshown(to, o, 1, "more pass in all verdicts");
    print_unshown(to, o, 0, "more have no verdict");
}

static void print_entry(FILE *to, int *column, const char *text)
{
    const int width = paragraph_columns(text);
    if (*column > 0 && *column + 3 + width > PARAGRAPH_WIDTH) {
        fputc('\n', to);
        *column = 0;
    }
    fprintf(to, "%s%s", *column > 0 ? "   " : "", text);
    *column += width + (*column > 0 ? 3 : 0);
}

static void print_legend(FILE *to, screen look, const overview *o)
{
    int used[OVERVIEW_MARKS] = {0}, unexpected = 0, column = 0;
    for (int i = 0; i < o->rows * o->columns; i++) {
        used[o->cell[i].mark] = 1;
        unexpected |= o->cell[i].unexpected;
    }
    if (unexpected)
        print_entry(to, &column, "! not as expected, see below");
    for (int m = OVERVIEW_MARKS - 1; m >= 0; m--) {
        char text[OVERVIEW_TEXT], entry[120];
        const overview_cell one = {.mark = (overview_mark)m};
        overview_text(&one, look.utf8, text);
        snprintf(entry, sizeof entry, "%.*s %s", (int)strcspn(text, "0"), text,
                 overview_words((overview_mark)m));
        if (used[m])
            print_entry(to, &column, entry);
    }
    fprintf(to, "\nA mark shows the worst verdict%s; the number counts quantities with it.\n",
            o->joined ? " over all parameters and options" : " over all parameters");
    if (o->accepted < o->columns)
        fprintf(to, "(new): the formulation is not accepted yet; its verdicts do not affect the "
                    "exit status.\n");
}

void table_overview(FILE *to, screen look, const overview *o)
{
    overview_block b = {.name = width_of_names(o),
                        .head = calloc((size_t)o->columns + 1, sizeof(head))};
    if (b.head == NULL || o->rows == 0) {
        free(b.head);
        return;
    }
    for (; b.from < o->columns && b.name > 0; b.from = b.to) {
        lay_out(o, look, &b);
        print_block(to, look, o, &b);
    }
    print_passing(to, o);
    print_legend(to, look, o);
    free(b.head);
}
