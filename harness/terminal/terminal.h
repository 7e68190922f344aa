/* terminal/: tables and lines on a terminal. */
#ifndef BEAMWORK_TERMINAL_H
#define BEAMWORK_TERMINAL_H

#include <stdio.h>

#include "harness/study/study.h"

/* Running text on a terminal. */

enum { PARAGRAPH_WIDTH = 100 /* columns */ };

/* Columns that a text takes. */
int paragraph_columns(const char *text);
/* Words of the text up to the last column, further lines indented, and the end of the line; a word
 * that is longer than a line stays whole. at: columns that the first line has already. */
void paragraph_write(FILE *to, int at, int indent, const char *text);
/* The same of a printf. */
void paragraph_say(FILE *to, int at, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A paragraph that is written word by word: between the two, to the stream that the first returns
 * (where memory is short, that is `to` itself, and lines are as long as they are). */
typedef struct paragraph {
    FILE *to, *words;
    char *text;
    size_t size;
} paragraph;
FILE *paragraph_begin(paragraph *, FILE *to);
/* As paragraph_write. */
void paragraph_end(paragraph *, int at, int indent);
/* The same of a command, whose lines but the last end in " \", as a shell reads it. */
void paragraph_end_command(paragraph *, int at, int indent);

/* Capabilities of a terminal: colour, signs beyond ASCII. */

typedef struct screen {
    int colour; /* 1: a terminal that supports colours, without NO_COLOR */
    int utf8;   /* 1: the locale has signs beyond ASCII */
} screen;

typedef enum screen_ink { SCREEN_PLAIN, SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT } screen_ink;

screen screen_of(FILE *to);
/* The text in that ink; never an escape sequence where there is no colour. */
void screen_put(FILE *to, screen, screen_ink, const char *text);

/* Helpers of the tables on a terminal. */

/* A relative error in percent, in 12 columns with a blank before it; a dash where there is none. */
void table_percent(FILE *to, double error);
/* A value as far as it is known (harness/study/study.h). */
void table_known(FILE *to, int width, double value, double uncertainty);
/* A value with that many digits. */
void table_digits(FILE *to, int width, double value, int digits);
/* printf's conversion 'g', 'e' or 'f' in a field of `width`; a dash for what is not finite. */
void table_value(FILE *to, int width, int digits, char conversion, double value);
/* "case: parameters" as far as they differ from the defaults. */
void table_point(FILE *to, const sweep_point *p);
/* A line "case (parameters), formulation". */
/* A line on members that loads divide, one on the physics that the scene leaves out, and one on the
 * theory of shear that the formulation follows where there are both shear and stability; none where
 * there is nothing to say.
 */
void table_omitted(FILE *to, const sweep_point *p);
void table_theory(FILE *to, const scene *s, const element_type *type);
void table_series(FILE *to, const sweep *s, int index);

/* Formulations side by side: a table for each quantity, a column for each formulation. */

/* Table of the one point of a sweep: rows are meshes, then limit, its uncertainty and order; below
 * it the verdicts that are not a pass, in words. Errors where there is a reference, else values.
 * Within 100 columns: several blocks where more formulations ran than fit; last what did not run.
 */
void table_beside(FILE *to, const sweep *s, const truths *t);

/* Series over their meshes for people, with their limits. */

void table_convergence(FILE *to, const sweep *s, const truths *t);

/* Modes followed over a parameter. */

/* A line for each value that was requested, a column for each mode [Hz]; crossings and veerings. */
void table_follow(FILE *to, const char *parameter, const follow_curves *);

/* A run on one screen: a matrix of cases and formulations, a mark each, and what the marks say. */

/* In lines of at most PARAGRAPH_WIDTH. Where there are many cases, those that pass share lines. */
void table_overview(FILE *to, screen, const overview *);

/* Summary of a whole run, as text. */

/* Behind the long table: published values that limits contradict, cells without a solution, how
 * often limits hold what they promise. */
void table_run_details(FILE *to, const sweep *s, const judgement *j);
/* The counts. seconds: that the run took. */
void table_run(FILE *to, const sweep *s, const judgement *j, double seconds);
/* The last sentence, and nothing where there is none. */
void table_run_end(FILE *to, screen, const char *sentence);

/* One cell for people: its quantities, matrices and load steps. */

void table_solution(FILE *to, const sweep *s, const truths *t);

/* Times of a benchmark for people: error against run time, and the cheapest way to an error. */

/* every_mesh: 1: a row for each mesh and the cheapest way for every quantity; 0: defaults and their
 * first quantity only. */
void table_timing(FILE *to, const sweep *s, const judgement *j, int every_mesh);

/* Unexpected outcomes of a run: together, in full, with commands that show them again. */

/* Nothing where all is as expected. */
/* Formulations that break the contract of the interface: before all else. */
void table_breaches(FILE *to, screen, const judgement *j);
void table_unexpected(FILE *to, screen, const sweep *s, const judgement *j, const truths *t);

/* The verdicts of a run for people, a block for each point. */

void table_verdicts(FILE *to, const sweep *s, const judgement *j);

#endif
