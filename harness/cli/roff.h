/* Pages of the manual as mdoc(7): what a text means stands in macros, what it says in lines that no
 * formatter takes for one. */
#ifndef BEAMWORK_ROFF_H
#define BEAMWORK_ROFF_H

#include <stdio.h>

/* Running text: lines of its words, each as it is written: hyphens, quotes and '^' can be copied.
 */
void roff_text(FILE *to, const char *text);
/* Behind a macro: one argument, a blank before it, whatever it says. */
void roff_argument(FILE *to, const char *text);
/* A line inside .Bd -literal. */
void roff_literal(FILE *to, const char *line, size_t length);
/* The head of a page: ".Dd" to ".Nd". name: "beamwork-solve"; about: one line. */
void roff_page(FILE *to, const char *name, int section, const char *about);
/* "See also": names with their sections, "beamwork 1 beamwork-scene 5". */
typedef struct roff_reference {
    const char *name;
    int section;
} roff_reference;
void roff_see(FILE *to, const roff_reference list[], int count);

#endif
