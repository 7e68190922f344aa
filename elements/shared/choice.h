#ifndef BEAMWORK_SHARED_CHOICE_H
#define BEAMWORK_SHARED_CHOICE_H

#include "elements/shared/status.h"

/* Reads the decimal number at the start of `text` and sets *end to the character after the number.
 * Returns
 * 1. Returns 0 if a number is missing or outside the range of a double: infinite, or below
 * 2.2e-308, where digits would be lost. */
int number_read(const char *text, const char **end, double *out);

/* Returns the index of `word` in the list "a|b|c", or -1. */
int choice_index(const char *choices, const char *word);
void choice_name(const char *choices, int index, char *text, int size);

/* Returns REFUSED with the message "unknown WHAT 'WORD', did you mean 'NEAREST'?". The candidates
 * are given as in choice_nearest. */
status choice_unknown(const char *what, const char *word,
                      const char *(*next)(const void *context, int i), fault *f);

/* Returns the candidate nearest to a misspelt word by edit distance, or NULL if no candidate is
 * similar. next(context, i) returns candidate i, or NULL after the last candidate. */
const char *choice_nearest(const char *word, const char *(*next)(const void *context, int i),
                           const void *context);

/* Returns the number of letters to change, add or remove to convert a to b. Only the first 63
 * letters are compared. */
int choice_distance(const char *a, const char *b);

#endif
