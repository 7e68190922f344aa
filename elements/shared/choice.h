/* Words and numbers in user input. */
#ifndef BEAMWORK_SHARED_CHOICE_H
#define BEAMWORK_SHARED_CHOICE_H

#include "elements/shared/status.h"

/* Numbers in user input. */

/* Reads the number at the start of `text` and sets *end to the character after it. Returns 1; 0 if
 * a number is missing or outside the range of a double: infinite, or below 2.2e-308, where digits
 * would be lost. */
int number_read(const char *text, const char **end, double *out);

/* Words of a list "a|b|c", and the candidate nearest to a misspelt word. */

/* Returns the index of `word` in "a|b|c", or -1. */
int choice_index(const char *choices, const char *word);
void choice_name(const char *choices, int index, char *text, int size);

/* REFUSED: "unknown WHAT 'WORD', did you mean 'NEAREST'?"; candidates as below. */
status choice_unknown(const char *what, const char *word,
                      const char *(*next)(const void *context, int i), fault *f);

/* Returns the candidate nearest to a misspelt word (edit distance), or NULL if none is similar.
 * next(context, i) returns NULL at the end. */
const char *choice_nearest(const char *word, const char *(*next)(const void *context, int i),
                           const void *context);

/* Returns the number of letters to change, add or remove to turn a into b; only the first 63
 * letters count. */
int choice_distance(const char *a, const char *b);

#endif
