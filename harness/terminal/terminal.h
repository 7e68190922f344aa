/* terminal/: tables and lines on a terminal. */
#ifndef BEAMWORK_TERMINAL_H
#define BEAMWORK_TERMINAL_H

#include <stdio.h>

#include "harness/study/study.h"

/* Paragraphs on a terminal. */

enum { PARAGRAPH_WIDTH = 100 /* columns */ };

/* Number of columns of a text. */
int paragraph_columns(const char *text);
/* Wraps the text at the last column, indents continuation lines, and ends the line; a word longer
 * than a line is not divided. at: columns already used in the first line. */
void paragraph_write(FILE *to, int at, int indent, const char *text);
/* As paragraph_write with the format of printf. */
void paragraph_say(FILE *to, int at, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A paragraph that is written in pieces: between begin and end, write to the returned stream. When
 * memory is short, this is `to` itself, and lines are not wrapped. */
typedef struct paragraph {
    FILE *to, *words;
    char *text;
    size_t size;
} paragraph;
FILE *paragraph_begin(paragraph *, FILE *to);
/* As paragraph_write. */
void paragraph_end(paragraph *, int at, int indent);
/* As paragraph_end for a command; all lines but the last end in " \", for a shell. */
void paragraph_end_command(paragraph *, int at, int indent);

/* Capabilities of a terminal: colour, signs beyond ASCII. */

typedef struct screen {
    int colour; /* 1: the terminal supports colours, and NO_COLOR is not set */
    int utf8;   /* 1: the locale has characters outside ASCII */
} screen;

typedef enum screen_ink { SCREEN_PLAIN, SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT } screen_ink;

screen screen_of(FILE *to);
/* Prints the text in that colour; without escape sequences if colour is off. */
void screen_put(FILE *to, screen, screen_ink, const char *text);

/* Helpers of the tables on a terminal. */

/* Conversion 'g', 'e' or 'f' of printf in a field of `width`; a dash if the value is not finite. */
void table_value(FILE *to, int width, int digits, char conversion, double value);
/* A line "case (parameters), formulation". */
/* Prints a line on members divided by loads, one on omitted physics, and one on the formulation's
 * shear theory if there are both shear and stability; lines that do not apply are omitted. */
void table_omitted(FILE *to, const sweep_point *p);
void table_theory(FILE *to, const scene *s, const element_type *type);
void table_series(FILE *to, const sweep *s, int index);

/* Comparison of formulations: a table for each quantity, a column for each formulation. */

/* Table for the single point of a sweep: rows are meshes, then the limit, its uncertainty and
 * order; below it verdicts other than pass, in words. Shows errors if there is a reference,
 * otherwise values. The width is 100 columns: further formulations follow in more blocks; the last
 * part lists formulations that did not run. */
void table_beside(FILE *to, const sweep *s, const truths *t);

/* Series over their meshes as text, with their limits. */

void table_convergence(FILE *to, const sweep *s, const truths *t);

/* Modes followed over a parameter. */

/* A line for each requested value, a column for each mode [Hz]; then crossings and veerings. */
void table_follow(FILE *to, const char *parameter, const follow_curves *);

/* Overview of a run on one screen: a matrix of cases and formulations with a mark each, and the
 * meaning of the marks. */

/* Prints lines of at most PARAGRAPH_WIDTH columns. If there are many cases, those that pass share
 * lines. */
void table_overview(FILE *to, screen, const overview *);

/* Summary of a whole run, as text. */

/* After the long table: published values incompatible with limits, cells without a solution,
 * coverage of limits. */
void table_run_details(FILE *to, const sweep *s, const judgement *j);
/* The counts. seconds: run time. */
void table_run(FILE *to, const sweep *s, const judgement *j, double seconds);
/* The concluding sentence; nothing if there is none. */
void table_run_end(FILE *to, screen, const char *sentence);

/* One cell as text: its quantities, matrices and load steps. */

void table_solution(FILE *to, const sweep *s, const truths *t);

/* Times of a benchmark as text: error against run time, and the lowest cost for an error. */

/* every_mesh: 1: a row for each mesh, and the lowest cost for every quantity; 0: defaults and their
 * first quantity only. */
void table_timing(FILE *to, const sweep *s, const judgement *j, int every_mesh);

/* Unexpected results of a run, in full, with commands that show them again. */

/* Prints nothing if everything is as expected. */
/* Formulations that violate the interface requirements; printed first. */
void table_breaches(FILE *to, screen, const judgement *j);
void table_unexpected(FILE *to, screen, const sweep *s, const judgement *j, const truths *t);

/* Verdicts of a run as text, a block for each point. */

void table_verdicts(FILE *to, const sweep *s, const judgement *j);

#endif
