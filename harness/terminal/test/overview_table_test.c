/* The matrix on a screen: no line wider than it, whatever the names; every name and every mark is
 * there; cases that pass share lines where there are many. */
#include <gsl/gsl_test.h>
#include <stdlib.h>
#include <string.h>

#include "harness/terminal/terminal.h"

enum { MOST = 64, NAME = 40 };

typedef struct table_bench {
    overview o;
    case_type type[MOST];
    const case_type *row[MOST];
    const char *column[MOST];
    char case_name[MOST][NAME], name[MOST][NAME];
    overview_cell cell[MOST * MOST];
} table_bench;

static const screen plain = {0, 0};

static void make(table_bench *b, int rows, int columns, const char *name)
{
    memset(b, 0, sizeof *b);
    b->o = (overview){.rows = rows,
                      .columns = columns,
                      .accepted = columns,
                      .row = b->row,
                      .column = b->column,
                      .cell = b->cell};
    for (int i = 0; i < MOST; i++) {
        snprintf(b->case_name[i], NAME, "case_%d", i);
        snprintf(b->name[i], NAME, "%s_%d", name, i);
        b->type[i].name = b->case_name[i];
        b->row[i] = &b->type[i];
        b->column[i] = b->name[i];
    }
    for (int i = 0; i < rows * columns; i++)
        b->cell[i].mark = OVERVIEW_PASS;
}

/* What is shown; the caller frees it. */
static char *shown(const table_bench *b, screen look)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    table_overview(to, look, &b->o);
    fclose(to);
    return text;
}

static int widest(const char *text)
{
    int most = 0, here = 0;
    for (; *text != '\0'; text++) {
        here = *text == '\n' ? 0 : here + (((unsigned char)*text & 0xc0) != 0x80);
        most = here > most ? here : most;
    }
    return most;
}

static int count(const char *text, const char *word)
{
    int n = 0;
    for (size_t i = 0; text[i] != '\0'; i++)
        n += strncmp(text + i, word, strlen(word)) == 0;
    return n;
}

/* Any number of columns, names long and short: they fit, in several blocks where they must. */
static void widths(void)
{
    static const char *const names[] = {"a", "geometrically_exact",
                                        "beamw_consistent:torsion=hyperbolic",
                                        "nameofoneverylongwordwithout"};
    static table_bench b;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
        for (int columns = 1; columns <= 40; columns++) {
            make(&b, 3, columns, names[k]);
            for (int c = 0; c < columns; c++)
                b.cell[c] = (overview_cell){OVERVIEW_WRONG, 1, 100 + c};
            char *text = shown(&b, plain);
            for (int c = 0; c < columns; c++) {
                char mark[16];
                snprintf(mark, sizeof mark, "!#%d", 100 + c);
                gsl_test(count(text, mark) != 1, "%d x %s: %s is there", columns, names[k], mark);
            }
            const int width = widest(text);
            gsl_test(width > PARAGRAPH_WIDTH, "%d x %s: %d columns", columns, names[k], width);
            free(text);
        }
}

/* One block: the head says each name whole, cut only where words are long. */
static void heads(void)
{
    static table_bench b;
    make(&b, 1, 3, "sheet_second");
    char *text = shown(&b, plain);
    for (int c = 0; c < 3; c++)
        gsl_test(count(text, b.name[c]) != 1, "%s is there", b.name[c]);
    free(text);
}

/* New formulations are marked above their names, and what that means is said once. */
static void new_ones(void)
{
    static table_bench b;
    make(&b, 1, 3, "beam");
    char *text = shown(&b, plain);
    gsl_test_int(count(text, "(new)"), 0, "none is new");
    free(text);
    b.o.accepted = 1;
    text = shown(&b, plain);
    gsl_test_int(count(text, "(new)"), 3, "two are new, and what that means");
    gsl_test_int(count(text, "do not affect the exit"), 1, "they do not gate");
    free(text);
}

/* Where there are many cases, those that pass share lines; the others never do. */
static void passing(void)
{
    static table_bench b;
    make(&b, MOST, 4, "beam");
    b.cell[4 * 7 + 2] = (overview_cell){OVERVIEW_UNDECIDED, 0, 3};
    b.cell[4 * 9 + 1] = (overview_cell){OVERVIEW_BIASED, 1, 2};
    for (int c = 0; c < 4; c++) /* no pass of it is in a sentence that says so */
        b.cell[4 * 11 + c] =
            (overview_cell){c == 2 ? OVERVIEW_OTHER_MODEL : OVERVIEW_NOTHING, 0, 1};
    char *text = shown(&b, plain);
    gsl_test(strstr(text, "\ncase_7 ") == NULL || strstr(text, "\ncase_9 ") == NULL, "rows");
    gsl_test(count(text, "61 more pass in all that is judged: case_0, case_1,") != 1, "the others");
    gsl_test(count(text, "\n1 more have nothing that is judged: case_11\n") != 1, "not judged");
    gsl_test(count(text, "ok") != 6 + 1, "%d marks, and the words of one", count(text, "ok"));
    int lines = 0;
    for (const char *c = text; *c != '\0'; c++)
        lines += *c == '\n';
    gsl_test(lines > 20, "%d lines", lines);
    free(text);
    make(&b, 5, 4, "beam");
    text = shown(&b, plain);
    gsl_test(count(text, "\ncase_") != 5, "few cases have a line each");
    free(text);
}

static void legend(void)
{
    static table_bench b;
    make(&b, 2, 2, "beam");
    b.cell[1].mark = OVERVIEW_NOTHING;
    char *text = shown(&b, plain);
    gsl_test(strstr(text, "ok all pass") == NULL || strstr(text, ". nothing judged") == NULL,
             "what is used is told");
    gsl_test(strstr(text, "limit off") != NULL || strstr(text, "!") != NULL, "and no more");
    free(text);
    b.cell[0] = (overview_cell){OVERVIEW_WRONG, 1, 1};
    text = shown(&b, (screen){0, 1});
    gsl_test(strstr(text, "! not as expected") == NULL || strstr(text, "≠ limit off") == NULL, "%s",
             text);
    free(text);
    text = shown(&b, (screen){1, 1});
    gsl_test(strstr(text, "\033[1;31m!≠1\033[0m") == NULL, "what is unexpected jumps out");
    free(text);
    b.o.rows = 0;
    text = shown(&b, plain);
    gsl_test(text[0] != '\0', "nothing of nothing");
    free(text);
}

int main(void)
{
    widths();
    heads();
    new_ones();
    passing();
    legend();
    return gsl_test_summary();
}
