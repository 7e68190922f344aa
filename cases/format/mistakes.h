/* What is wrong with a scene file: each with its place, all at once. */
#ifndef BEAMWORK_MISTAKES_H
#define BEAMWORK_MISTAKES_H

#include <stdio.h>

#include "elements/shared/status.h"

enum { MISTAKES_MOST = 20 };

typedef struct mistake {
    int line, column; /* counted from 1 */
    char text[FAULT_TEXT];
} mistake;

typedef struct mistakes {
    const char *file; /* as messages call it */
    int count;
    int more;                    /* that found no room */
    int out_of_memory;           /* 1: the file was not read to its end for lack of it */
    mistake list[MISTAKES_MOST]; /* ascending by place */
} mistakes;

/* Adds one, unless there is one at that place. */
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void mistakes_add(mistakes *m, int line, int column, const char *format, ...);

/* "; did you mean 'near'?", or the remedy where near is NULL. */
const char *mistakes_remedy(const char *near, const char *remedy, char text[FAULT_TEXT]);

/* OK where there are none; else REFUSED, or FAULT out of memory, and the first of them in f. */
status mistakes_status(const mistakes *m, fault *f);

/* "file:line:column: what", a line each; after them how many more there are. */
void mistakes_print(const mistakes *m, FILE *to);
/* {"file": ..., "mistakes": [{"line", "column", "text"}, ...], "more": n}, for editors; FAULT out
 * of memory. */
status mistakes_json(const mistakes *m, FILE *to, fault *f);

#endif
