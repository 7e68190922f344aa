/* Words and numbers that a user writes. */
#ifndef BEAMWORK_SHARED_CHOICE_H
#define BEAMWORK_SHARED_CHOICE_H

#include "elements/shared/status.h"

/* Numbers that a user writes. */

/* The number that `text` begins with; *end: after it. 0: there is none, or a double does not hold
 * it: it is infinite, or so small (below 2.2e-308) that it would become zero or lose digits. */
int number_read(const char *text, const char **end, double *out);

/* Words of a list "a|b|c", and the nearest one to a misspelt word. */

/* Index of `word` in "a|b|c", or -1. */
int choice_index(const char *choices, const char *word);
void choice_name(const char *choices, int index, char *text, int size);

/* REFUSED: "unknown WHAT 'WORD', did you mean 'NEAREST'?"; candidates as below. */
status choice_unknown(const char *what, const char *word,
                      const char *(*next)(const void *context, int i), fault *f);

/* The candidate nearest to a misspelt word (edit distance), or NULL when none is near.
 * next(context, i): NULL ends. */
const char *choice_nearest(const char *word, const char *(*next)(const void *context, int i),
                           const void *context);

/* Letters to change, add or remove to make b of a; of a the first 63 count. */
int choice_distance(const char *a, const char *b);

#endif
