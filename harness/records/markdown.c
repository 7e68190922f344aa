#include "harness/records/records.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"

enum { MOST_ROWS = 50 };

/* Writes a cell of a table. */
static void cell(FILE *to, const char *text)
{
    for (; *text != '\0'; text++)
        if (*text == '|')
            fputs("\\|", to);
        else
            fputc(*text == '\n' ? ' ' : *text, to);
}

static void number(FILE *to, double value)
{
    if (isfinite(value))
        fprintf(to, " | %.6g", value);
    else
        fprintf(to, " | -");
}

static void write_verdict(FILE *to, const sweep *s, const verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    fprintf(to, "| %s | ", p->type->name);
    cell(to, p->text);
    fprintf(to, " | `%s` | %s | **%s** | %s", one->formulation.key,
            p->scene.quantity[v->quantity].name, verdict_name(v->kind),
            v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    number(to, v->fit.limit);
    number(to, v->truth != NULL ? v->truth->value : NAN);
    if (isfinite(v->error))
        fprintf(to, " | %+.3g %% | ", 100 * v->error);
    else
        fprintf(to, " | - | ");
    cell(to, v->reason);
    fprintf(to, " |\n");
}

static void write_regressions(FILE *to, const evaluation *j)
{
    if (j->regressions == 0)
        return;
    fprintf(to, "\n| worse than in the previous run | |\n|---|---|\n");
    for (int i = 0; i < j->regressions && i < MOST_ROWS; i++) {
        fputs("| ", to);
        cell(to, j->regression[i].of);
        fputs(" | ", to);
        cell(to, j->regression[i].why);
        fputs(" |\n", to);
    }
    if (j->regressions > MOST_ROWS)
        fprintf(to, "\n… and %d more.\n", j->regressions - MOST_ROWS);
}

static void write_unexpected(FILE *to, const sweep *s, const evaluation *j)
{
    int rows = 0;
    if (j->unexpected == 0)
        return;
    fprintf(to, "\n| case | parameters | formulation | quantity | verdict | expected | limit | "
                "truth | error | reason |\n"
                "|---|---|---|---|---|---|---:|---:|---:|---|\n");
    for (int i = 0; i < j->verdicts && rows < MOST_ROWS; i++)
        if (!j->verdict[i].matches) {
            write_verdict(to, s, &j->verdict[i]);
            rows++;
        }
    if (j->unexpected > rows)
        fprintf(to, "\n… and %d more.\n", j->unexpected - rows);
}

static void write_formulations(FILE *to, const sweep *s, const evaluation *j)
{
    fprintf(to, "\n| formulation");
    for (int k = 0; k < VERDICT_KINDS; k++)
        fprintf(to, " | %s", verdict_name((verdict_kind)k));
    fprintf(to, " |\n|---");
    for (int k = 0; k < VERDICT_KINDS; k++)
        fprintf(to, "|---:");
    fprintf(to, "|\n");
    for (int first = 0; first < s->seriess; first++) {
        const char *key = s->series[first].formulation.key;
        int counts[VERDICT_KINDS] = {0}, before = 0;
        for (int i = 0; i < first && !before; i++)
            before = strcmp(s->series[i].formulation.key, key) == 0;
        if (before)
            continue;
        for (int i = 0; i < j->verdicts; i++)
            if (strcmp(s->series[j->verdict[i].series].formulation.key, key) == 0)
                counts[j->verdict[i].kind]++;
        fprintf(to, "| `%s`", key);
        for (int k = 0; k < VERDICT_KINDS; k++)
            fprintf(to, counts[k] > 0 ? " | %d" : " | ", counts[k]);
        fprintf(to, " |\n");
    }
}

static void write_legend(FILE *to, const overview *o)
{
    int used[OVERVIEW_MARKS] = {0}, entries = 0;
    for (int i = 0; i < o->rows * o->columns; i++)
        used[o->cell[i].mark] = 1;
    for (int m = OVERVIEW_MARKS - 1; m >= 0; m--) {
        char text[OVERVIEW_TEXT];
        const overview_cell one = {.mark = (overview_mark)m};
        overview_text(&one, 1, text);
        if (used[m])
            fprintf(to, "%s%.*s %s", entries++ > 0 ? "; " : "\n", (int)strcspn(text, "0"), text,
                    overview_words((overview_mark)m));
    }
    fprintf(to,
            "; **!** not as expected. A mark shows the worst verdict over all parameters%s; the "
            "number counts quantities with it.\n",
            o->joined ? " and options" : "");
    if (o->accepted < o->columns)
        fprintf(to, "\n(new): the formulation is not accepted yet; its verdicts do not affect the "
                    "exit status.\n");
}

static void write_row(FILE *to, const overview *o, int row)
{
    fprintf(to, "| %s", o->row[row]->name);
    for (int c = 0; c < o->columns; c++) {
        char text[OVERVIEW_TEXT];
        const overview_cell *one = overview_at(o, row, c);
        overview_text(one, 1, text);
        fprintf(to, one->unexpected ? " | **%s**" : " | %s", text);
    }
    fprintf(to, " |\n");
}

static void write_unshown(FILE *to, const overview *o, int evaluated, const char *what)
{
    int named = 0;
    for (int r = 0; r < o->rows; r++)
        if (!overview_shown(o, r) && overview_evaluated(o, r) == evaluated) {
            if (named == 0)
                fprintf(to, "\n%s", what);
            fprintf(to, "%s%s", named++ > 0 ? ", " : ": ", o->row[r]->name);
        }
    fputs(named > 0 ? ".\n" : "", to);
}

static void write_overview(FILE *to, const overview *o)
{
    fprintf(to, "\n| case");
    for (int c = 0; c < o->columns; c++) {
        fprintf(to, " | ");
        cell(to, o->column[c]);
        fputs(c >= o->accepted ? " (new)" : "", to);
    }
    fprintf(to, " |\n|---");
    for (int c = 0; c < o->columns; c++)
        fprintf(to, "|---");
    fprintf(to, "|\n");
    for (int r = 0; r < o->rows; r++)
        if (overview_shown(o, r))
            write_row(to, o, r);
    write_unshown(to, o, 1, "All verdicts pass");
    write_unshown(to, o, 0, "No verdict");
    write_legend(to, o);
}

static int is_run(const sweep *s, int point)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].point == point && s->series[i].missing[0] == '\0')
            return 1;
    return 0;
}

static void write_omitted(FILE *to, const sweep *s)
{
    int lines = 0;
    const char *before = "";
    char last[SCENE_OMISSION_WORDS] = "";
    for (int i = 0; i < s->points; i++) {
        const sweep_point *p = &s->point[i];
        char words[SCENE_OMISSION_WORDS] = "";
        if (p->status == STATUS_OK && is_run(s, i))
            scene_omission_words(features_omitted(&p->scene), words);
        const int again = strcmp(p->type->name, before) == 0 && strcmp(words, last) == 0;
        before = p->type->name;
        snprintf(last, sizeof last, "%s", words);
        if (words[0] == '\0' || again)
            continue;
        if (lines++ == 0)
            fprintf(to, "\n<details><summary>Omitted by the scenes</summary>\n\n");
        fprintf(to, "- %s", p->type->name);
        if (p->text[0] != '\0')
            fprintf(to, " (%s)", p->text);
        fprintf(to, ": %s\n", words);
    }
    if (lines > 0)
        fprintf(to, "\n</details>\n");
}

static void write_assumed(FILE *to, const sweep *s)
{
    int lines = 0;
    for (int i = 0; i < s->points; i++) {
        const sweep_point *p = &s->point[i];
        assumption a;
        for (int k = 0; is_run(s, i) && assumptions_at(p, k, &a); k++) {
            if (lines++ == 0)
                fprintf(to, "\n<details><summary>Assumptions about sections</summary>\n\n");
            fprintf(to, "- %s", p->type->name);
            if (p->text[0] != '\0')
                fprintf(to, " (%s)", p->text);
            fprintf(to, ": %s: %s\n", assumptions_kind(a.kind), a.text);
        }
    }
    if (lines > 0)
        fprintf(to, "\n</details>\n");
}

static const char *words_before(const sweep *s)
{
    if (s->unfinished == 0)
        return "";
    return s->partial ? "incomplete; for the existing part  " : "interrupted; until then ";
}

void markdown_write(FILE *to, const sweep *s, const evaluation *j, const overview *o,
                    const environment *e)
{
    char sentence[SENTENCE_OF_RUN];
    fprintf(to, "## beamwork: %s%s\n\n", words_before(s), evaluation_outcome(j));
    for (int i = 0; i < j->breaches; i++)
        fprintf(to, "**%s violates the interface requirements**: %s\n\n", j->breach[i].formulation,
                j->breach[i].why);
    fprintf(to,
            "runs: %d; verdicts against reference values: %d; unexpected verdicts: %d; stored "
            "discrete values that agree: %d of %d",
            sweep_cells(s), j->evaluated, j->unexpected, j->agreements - j->disagreements,
            j->agreements);
    if (s->unfinished > 0)
        fprintf(to, "; missing runs: %d", s->unfinished);
    if (j->unobserved > 0)
        fprintf(to, "; %d known deviation%s not observed", j->unobserved,
                j->unobserved == 1 ? " was" : "s were");
    if (j->unmet > 0)
        fprintf(to, "; %d reference value%s", j->unmet,
                j->unmet == 1 ? " refers to an unknown name" : "s refer to unknown names");
    if (j->flaws > 0)
        fprintf(to, "; %d inconsistent run record%s", j->flaws, j->flaws == 1 ? "" : "s");
    fprintf(to, ". Commit %s, %s.\n", e->commit, e->compiler);
    sentence_of_run(s, j, sentence, sizeof sentence);
    if (sentence[0] != '\0')
        fprintf(to, "\n%s\n", sentence);
    write_regressions(to, j);
    write_unexpected(to, s, j);
    write_overview(to, o);
    write_omitted(to, s);
    write_assumed(to, s);
    fprintf(to, "\n<details><summary>Verdicts by formulation</summary>\n");
    write_formulations(to, s, j);
    fprintf(to, "\n</details>\n");
}
