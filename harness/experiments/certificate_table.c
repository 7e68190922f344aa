#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROWS = MEASURES_MOST + 2,
    LONG = 50,
    COLUMNS = MEASURE_POINTS + 4,
    CELL = 2 * MEASURE_WORDS
};

/* Row 0 is the heading. words[row] 1: the text of cell 1 extends over all following columns. */
typedef struct paper_table {
    int latex, rows, columns;
    char caption[2 * CELL], label[CELL];
    char cell[ROWS][COLUMNS][CELL];
    int words[ROWS];
} paper_table;

static void put_text(const paper_table *t, char cell[CELL], const char *text)
{
    static const char special[] = "&%$#_{}";
    size_t at = 0;
    for (; *text != '\0' && at + 20 < CELL; text++) {
        const char *code = NULL;
        if (t->latex)
            code = *text == '\\'  ? "\\textbackslash{}"
                   : *text == '~' ? "\\textasciitilde{}"
                   : *text == '^' ? "\\textasciicircum{}"
                   : *text == '<' ? "$<$"
                   : *text == '>' ? "$>$"
                                  : NULL;
        if (code != NULL)
            at += (size_t)snprintf(cell + at, CELL - at, "%s", code);
        else if (t->latex ? strchr(special, *text) != NULL : *text == '|')
            at += (size_t)snprintf(cell + at, CELL - at, "\\%c", *text);
        else
            cell[at++] = *text == '\n' ? ' ' : *text;
    }
    cell[at] = '\0';
}

/* Writes a number and a unit. The number has a form such as "0.35", "3e-05" or "$3\cdot10^{-5}$".
 * digits > 0: number of significant digits. digits <= 0: power of ten with -digits decimal
 * digits. */
static void put_number(const paper_table *t, char cell[CELL], int digits, double value,
                       const char *unit)
{
    char text[40];
    if (digits > 0)
        snprintf(text, sizeof text, "%.*g", digits, value);
    else
        snprintf(text, sizeof text, "%.*e", -digits, value);
    char *power = strchr(text, 'e');
    if (value == 0) {
        snprintf(cell, CELL, "0%s", unit);
    } else if (t->latex && power != NULL) {
        *power = '\0';
        snprintf(cell, CELL, "$%s%s10^{%ld}$%s", strcmp(text, "1") == 0 ? "" : text,
                 strcmp(text, "1") == 0 ? "" : "\\cdot", strtol(power + 1, NULL, 10), unit);
    } else {
        snprintf(cell, CELL, "%s%s", text, unit);
    }
}

static void put_error(const paper_table *t, char cell[CELL], double error)
{
    const double percent = 100 * fabs(error);
    if (isnan(error))
        snprintf(cell, CELL, t->latex ? "--" : "-");
    else if (fabs(error) < CERTIFICATE_EXACT)
        snprintf(cell, CELL, "exact");
    else
        put_number(t, cell, percent < 1e-2 || percent >= 999 ? 0 : 2, percent,
                   t->latex ? "\\,\\%" : " %");
}

static void head(paper_table *t, int column, const char *text)
{
    put_text(t, t->cell[0][column], text);
    t->columns = column + 1;
}

/* Returns the check with the largest ratio of its worst deviation to the allowed deviation; NULL:
 * no check has a finite deviation and an allowed deviation. */
static const check_result *worst_of(const check_results *c)
{
    const check_result *found = NULL;
    for (int i = 0; i < c->count; i++) {
        const check_result *one = &c->check_result[i];
        if (one->allowed > 0 && isfinite(one->worst) && one->outcome != CHECK_NOT_MADE &&
            (found == NULL || one->worst / one->allowed > found->worst / found->allowed))
            found = one;
    }
    return found;
}

static void fill_requirements(paper_table *t, const certificate *c)
{
    static const char *const names[] = {"requirement", "numbers", "deviation", "allowed",
                                        "outcome"};
    for (int i = 0; i < 5; i++)
        head(t, i, names[i]);
    for (int i = 0; i < CHECKS_FAMILIES; i++) {
        const check_results *own = &c->part[i].check_results;
        const check_result *worst = worst_of(own);
        char(*cell)[CELL] = t->cell[t->rows];
        const check_outcome outcome = checks_outcome(own);
        put_text(t, cell[0], certificate_part_words(i));
        if (outcome == CHECK_NOT_MADE) {
            char words[CHECK_TEXT + 20];
            const char *why =
                own->count > 0 ? own->check_result[own->count - 1].sentence : "no check";
            snprintf(words, sizeof words, "%s%s",
                     strncmp(why, "not checked", 11) == 0 ? "" : "not applicable: ", why);
            put_text(t, cell[1], words);
            t->words[t->rows] = 1;
        } else {
            snprintf(cell[1], CELL, "%d", checks_compared(own));
            put_error(t, cell[2], NAN);
            put_error(t, cell[3], NAN);
            if (worst != NULL) {
                put_number(t, cell[2], -1, worst->worst, "");
                put_number(t, cell[3], -1, worst->allowed, "");
            }
            snprintf(cell[4], CELL, outcome == CHECK_PASSED ? "satisfied" : "violated");
        }
        t->rows++;
    }
}

/* Returns "correct" or "wrong" for the limit of a linear state, as found by its check. Returns
 * `none` if the limit was not checked. */
static const char *state_limit(const check_results *c, const char *state, const char *none)
{
    char name[CHECK_NAME];
    snprintf(name, sizeof name, "limit of %.50s", state);
    for (int i = 0; i < c->count; i++)
        if (strcmp(c->check_result[i].name, name) == 0)
            return c->check_result[i].outcome == CHECK_PASSED ? "correct" : "wrong";
    return none;
}

static void fill_measure(paper_table *t, const certificate_part *of, int index, int points,
                         int group)
{
    const element_measure *one = &of->measures.measure[index];
    char(*cell)[CELL] = t->cell[t->rows];
    int values = 0;
    put_text(t, cell[0], one->name);
    for (int i = 0; i < points; i++) {
        put_error(t, cell[1 + i], i < one->points ? one->error[i] : NAN);
        values += i < one->points && !isnan(one->error[i]);
    }
    if (values == 0) {
        put_text(t, cell[1], one->words);
        t->words[t->rows++] = 1;
        return;
    }
    if (group == 0)
        snprintf(cell[1 + points], CELL, "%s",
                 state_limit(&of->check_results, one->name, t->latex ? "--" : "-"));
    else if (group == 1)
        snprintf(cell[1 + points], CELL, one->locks ? "yes" : "no");
    else if (group == 3)
        put_text(t, cell[1 + points], one->words);
    else {
        put_error(t, cell[1 + points], NAN);
        if (!isnan(one->order))
            snprintf(cell[1 + points], CELL, "%.1f", one->order);
        snprintf(cell[2 + points], CELL, t->latex ? "%d--%d" : "%d-%d", one->least, one->highest);
    }
    t->rows++;
}

static void fill_measures(paper_table *t, const certificate *c, int group)
{
    static const char *const first[] = {"elements", "thickness/length", "elements",
                                        "turns, cycles"},
                             *const last[] = {"limit", "locks", "order", "verdict"};
    const certificate_part *own = &c->part[CHECKS_FAMILIES + group];
    const element_measure *longest = &own->measures.measure[0];
    for (int i = 1; i < own->measures.count; i++)
        if (own->measures.measure[i].points > longest->points)
            longest = &own->measures.measure[i];
    const int points = own->measures.count > 0 ? longest->points : 0;
    head(t, 0, first[group]);
    for (int i = 0; i < points; i++) {
        put_number(t, t->cell[0][1 + i], group == 1 ? 0 : 9, longest->at[i], "");
        t->columns++;
    }
    head(t, points + 1, last[group]);
    if (group == 2)
        head(t, points + 2, "declared");
    for (int i = 0; i < own->measures.count && t->rows < ROWS; i++)
        fill_measure(t, own, i, points, group);
    if (own->measures.count == 0 && own->check_results.count > 0) {
        put_text(t, t->cell[1][0], certificate_part_name(CHECKS_FAMILIES + group));
        put_text(t, t->cell[1][1], own->check_results.check_result[0].sentence);
        t->words[t->rows++] = 1;
    }
}

static void begin(paper_table *t, int latex, const certificate *c, const char *part,
                  const char *caption)
{
    char whole[CELL], label[CELL];
    t->latex = latex;
    t->rows = 1;
    memset(t->words, 0, sizeof t->words);
    snprintf(whole, sizeof whole, "%.90s: %.200s", c->chosen.key, caption);
    put_text(t, t->caption, whole);
    snprintf(label, sizeof label, "%.90s-%.40s", c->chosen.type->name, part);
    snprintf(t->label, sizeof t->label, "%s", label);
}

static void row_markdown(FILE *to, const paper_table *t, int row)
{
    fprintf(to, "| %s |", t->cell[row][0]);
    for (int i = 1; i < t->columns; i++)
        fprintf(to, " %s |", t->words[row] && i > 1 ? "" : t->cell[row][i]);
    fputc('\n', to);
}

static void write_markdown(FILE *to, const paper_table *t)
{
    fprintf(to, "**%s**\n\n", t->caption);
    row_markdown(to, t, 0);
    fputs("|---|", to);
    for (int i = 1; i < t->columns; i++)
        fputs("---|", to);
    fputc('\n', to);
    for (int i = 1; i < t->rows; i++)
        row_markdown(to, t, i);
    fputc('\n', to);
}

static void row_latex(FILE *to, const paper_table *t, int row)
{
    fprintf(to, "    %s", t->cell[row][0]);
    if (t->words[row])
        fprintf(to, " & \\multicolumn{%d}{%s}{%s}", t->columns - 1,
                strlen(t->cell[row][1]) > LONG ? "p{0.45\\linewidth}" : "l", t->cell[row][1]);
    for (int i = 1; i < t->columns && !t->words[row]; i++)
        fprintf(to, " & %s", t->cell[row][i]);
    fputs(" \\\\\n", to);
}

static void write_latex(FILE *to, const paper_table *t)
{
    size_t longest = 0;
    for (int i = 0; i < t->rows; i++)
        longest = strlen(t->cell[i][0]) > longest ? strlen(t->cell[i][0]) : longest;
    fprintf(to, "\\begin{table}\n  \\small\n  \\caption{%s}\n  \\label{tab:%s}\n", t->caption,
            t->label);
    fprintf(to, "  \\begin{tabular}{%s", longest > LONG ? "p{0.42\\linewidth}" : "l");
    for (int i = 1; i < t->columns; i++)
        fputc('r', to);
    fputs("}\n    \\hline\n", to);
    row_latex(to, t, 0);
    fputs("    \\hline\n", to);
    for (int i = 1; i < t->rows; i++)
        row_latex(to, t, i);
    fputs("    \\hline\n  \\end{tabular}\n\\end{table}\n\n", to);
}

static void write_table(FILE *to, const paper_table *t)
{
    (t->latex ? write_latex : write_markdown)(to, t);
}

static const char *what_is_hashed(const certificate *c)
{
    const char *from = formulations_element(c->chosen.type);
    if (from == NULL)
        return "of the program that contains the element";
    return strncmp(from, "exec:", 5) == 0 ? "of the files named by its command" : "of its file";
}

static void write_about(FILE *to, int latex, const certificate *c)
{
    const environment now = environment_now(1);
    const char *left = adapters_words(c->chosen.type), *line = latex ? "% " : "";
    fprintf(to, latex ? "%% %s: %s\n" : "### %s\n%s\n\n", c->chosen.key, c->chosen.type->summary);
    fprintf(to, "%s%s: %s\n", line, latex ? "source" : "* Source", c->chosen.type->source);
    fprintf(to, "%s%s: %s (SHA-256 %s)\n", line, latex ? "element" : "* Element",
            c->hash[0] != '\0' ? c->hash : "unknown", what_is_hashed(c));
    fprintf(to, "%s%s: beamwork %s, commit %s, %s\n", line, latex ? "tested by" : "* Tested by",
            now.version, now.commit, now.clock);
    if (left[0] != '\0')
        fprintf(to, "%s%s: %s\n", line, latex ? "computed by beamwork" : "* Computed by beamwork",
                left);
    fputs("\n", to);
}

static void write_violations(FILE *to, int latex, const certificate *c)
{
    int count = 0;
    for (int i = 0; i < CERTIFICATE_PARTS; i++)
        for (int k = 0; k < c->part[i].check_results.count; k++)
            if (c->part[i].check_results.check_result[k].outcome == CHECK_FAILED) {
                fprintf(to, "%sviolated: %s\n", latex ? "% " : "* ",
                        c->part[i].check_results.check_result[k].sentence);
                count++;
            }
    if (count > 0)
        fputc('\n', to);
}

static void write_one(FILE *to, int latex, const certificate *c)
{
    static const char *const caption[] = {
        "errors in uniform and linear states of a cantilever",
        "errors over thickness with 8 elements",
        "errors over numbers of elements, with observed and declared orders of convergence",
        ("changes due to superposed full turns and after closed cycles of deformation, 24 steps "
         "each")};
    static paper_table t;
    char words[2 * CELL], parts[CERTIFICATE_PARTS_TEXT];
    write_about(to, latex, c);
    certificate_violated_parts(c, parts, sizeof parts);
    snprintf(words, sizeof words,
             "interface requirements %s%s%s, %d checks on %d numbers (beamwork %s, SHA-256 of the "
             "element %.12s)",
             certificate_holds(c) ? "satisfied" : "violated (", parts,
             certificate_holds(c) ? "" : ")",
             certificate_counted(c, CHECK_PASSED) + certificate_counted(c, CHECK_FAILED),
             certificate_compared(c), environment_version(), c->hash);
    begin(&t, latex, c, "requirements", words);
    fill_requirements(&t, c);
    write_table(to, &t);
    write_violations(to, latex, c);
    for (int i = 0; i < MEASURED_GROUPS; i++) {
        snprintf(words, sizeof words, "%s%s", caption[i],
                 i == 2 && c->chosen.type->inertia == NULL
                     ? "; vibration with the mass computed by beamwork"
                     : "");
        begin(&t, latex, c, certificate_part_name(CHECKS_FAMILIES + i), words);
        fill_measures(&t, c, i);
        write_table(to, &t);
    }
}

void certificate_paper(FILE *to, int latex, const certificate *all, int count)
{
    for (int i = 0; i < count; i++)
        write_one(to, latex, &all[i]);
}

static void put_quoted(FILE *to, const char *text)
{
    fputs(",\"", to);
    for (; *text != '\0'; text++)
        if (*text == '"')
            fputs("\"\"", to);
        else
            fputc(*text, to);
    fputc('"', to);
}

static void put_value(FILE *to, double value)
{
    fputc(',', to);
    if (!isnan(value))
        fprintf(to, "%.17g", value);
}

static void csv_begin(FILE *to, const certificate *c, int part, const char *name)
{
    const environment now = environment_now(1);
    fprintf(to, "\"%s\",%s,%s,%s,%s", c->chosen.key, now.version, now.commit, c->hash,
            certificate_part_name(part));
    put_quoted(to, name);
}

static void csv_check(FILE *to, const certificate *c, int part, const check_result *one)
{
    static const char *const word[CHECK_OUTCOMES] = {"holds", "broken", "not claimed"};
    csv_begin(to, c, part, one->name);
    fprintf(to, ",%s,%d", word[one->outcome], one->compared);
    put_value(to, one->worst);
    put_value(to, one->allowed);
    fputs(",,,,,", to);
    put_quoted(to, one->sentence);
    fputc('\n', to);
}

static void csv_measure(FILE *to, const certificate *c, int part, const element_measure *m)
{
    for (int i = 0; i < (m->points > 0 ? m->points : 1); i++) {
        csv_begin(to, c, part, m->name);
        fputs(",measured,,,", to);
        put_value(to, i < m->points ? m->at[i] : NAN);
        put_value(to, i < m->points ? m->error[i] : NAN);
        put_value(to, m->order);
        if (m->highest > 0)
            fprintf(to, ",%d,%d", m->least, m->highest);
        else
            fputs(",,", to);
        put_quoted(to, m->words);
        fputc('\n', to);
    }
}

void certificate_csv(FILE *to, const certificate *all, int count)
{
    fputs("formulation,version,commit,hash,family,name,outcome,compared,deviation,allowed,at,error,"
          "order,least_order,highest_order,words\n",
          to);
    for (int i = 0; i < count; i++)
        for (int part = 0; part < CERTIFICATE_PARTS; part++) {
            const certificate_part *own = &all[i].part[part];
            for (int k = 0; k < own->check_results.count; k++)
                csv_check(to, &all[i], part, &own->check_results.check_result[k]);
            for (int k = 0; k < own->measures.count; k++)
                csv_measure(to, &all[i], part, &own->measures.measure[k]);
        }
}
