#ifndef BEAMWORK_TERMINAL_H
#define BEAMWORK_TERMINAL_H

#include <stdio.h>

#include "harness/study/study.h"

enum { PARAGRAPH_WIDTH = 100 /* columns */ };

int paragraph_columns(const char *text);
/* Writes the text in lines of at most PARAGRAPH_WIDTH columns, indents continuation lines, and ends
 * the last line. A word that is longer than a line is not divided. at: number of columns already
 * used in the first line. */
void paragraph_write(FILE *to, int at, int indent, const char *text);
/* Like paragraph_write, with the format and arguments of printf. */
void paragraph_printf(FILE *to, int at, int indent, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A paragraph that is written in parts. Between begin and end, the caller writes to the returned
 * stream. If memory is short, this stream is `to`, and lines are not wrapped. */
typedef struct paragraph {
    FILE *to, *words;
    char *text;
    size_t size;
} paragraph;
FILE *paragraph_begin(paragraph *, FILE *to);
/* Writes the paragraph as paragraph_write does. */
void paragraph_end(paragraph *, int at, int indent);
/* Like paragraph_end, for a command: all lines except the last end with " \", as a shell
 * requires. */
void paragraph_end_command(paragraph *, int at, int indent);

typedef struct screen {
    int colour; /* 1: the terminal supports colours, and NO_COLOR is not set */
    int utf8;   /* 1: the locale has characters outside ASCII */
} screen;

typedef enum screen_ink { SCREEN_PLAIN, SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT } screen_ink;

screen screen_of(FILE *to);
/* Prints the text in the given colour, or without escape sequences if colour is off. */
void screen_put(FILE *to, screen, screen_ink, const char *text);

/* Prints a value with the conversion 'g', 'e' or 'f' of printf in a field of `width` columns; a
 * dash if the value is not finite. */
void table_value(FILE *to, int width, int digits, char conversion, double value);
/* table_omitted prints the assumptions on the sections, the members that have more elements than
 * the mesh specifies, and the omitted physics. table_theory prints the shear theory of the
 * formulation if shear and stability occur together. Lines that do not apply are omitted. */
void table_omitted(FILE *to, const sweep_point *p);
void table_theory(FILE *to, const scene *s, const element_type *type);
/* Prints a line "case (parameters), formulation", and the physics that the formulation omits. */
void table_series(FILE *to, const sweep *s, int index);

/* Prints the tables for the single point of a sweep. The rows are the meshes, the limit, its
 * uncertainty and its order. Verdicts other than pass follow in words. The width is 100 columns;
 * formulations that do not fit follow in further blocks. */
void table_beside(FILE *to, const sweep *s, const truths *t);

/* Prints series over their meshes as text, with their limits. */

void table_convergence(FILE *to, const sweep *s, const truths *t);

/* Prints a line for each requested value with a column for each mode [Hz], followed by the
 * crossings and veerings. */
void table_follow(FILE *to, const char *parameter, const follow_curves *);

/* Prints lines of at most PARAGRAPH_WIDTH columns. If there are many cases, passing cases share
 * lines. */
void table_overview(FILE *to, screen, const overview *);

/* Prints the part after the long table: published values that are incompatible with limits, runs
 * without a solution, and the coverage of limits. */
void table_run_details(FILE *to, const sweep *s, const evaluation *j);
/* Prints the counts. seconds: run time. */
void table_run(FILE *to, const sweep *s, const evaluation *j, double seconds);
void table_run_end(FILE *to, screen, const char *sentence);

void table_solution(FILE *to, const sweep *s, const truths *t);

/* Prints the times. every_mesh 1: prints a row for each mesh, and the lowest cost for every
 * quantity; 0: prints only default points and the first quantity. */
void table_timing(FILE *to, const sweep *s, const evaluation *j, int every_mesh);

/* Prints the formulations that violate the requirements of the interface. They precede all other
 * results. */
void table_breaches(FILE *to, screen, const evaluation *j);
/* Prints unexpected results, or nothing if all results are as expected. */
void table_unexpected(FILE *to, screen, const sweep *s, const evaluation *j, const truths *t);

void table_verdicts(FILE *to, const sweep *s, const evaluation *j);

#endif
