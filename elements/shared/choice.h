#ifndef BEAMWORK_SHARED_CHOICE_H
#define BEAMWORK_SHARED_CHOICE_H

#include "elements/shared/status.h"

/* Reads the decimal number at the start of `text` and sets *end to the character after the number.
 * Returns 1, or 0 if there is no decimal number (also for 0x10, inf and nan) or if the number is
 * outside the range of a double: too large, or nonzero and below 2.2e-308, where digits would be
 * lost. */
int number_read(const char *text, const char **end, double *out);

/* Returns the index of `word` in the list "a|b|c", or -1. */
int choice_index(const char *choices, const char *word);
void choice_name(const char *choices, int index, char *text, int size);

/* Returns REFUSED with the message "unknown WHAT 'WORD'; did you mean 'NEAREST'? 'beamwork list'
 * shows the names", without the question if no candidate is similar. `next` is that of
 * choice_nearest, with the context NULL. */
status choice_unknown(const char *what, const char *word,
                      const char *(*next)(const void *context, int i), fault *f);

/* Returns the candidate nearest to a misspelt word by edit distance, which counts as at most 1 for
 * candidates that start with the word (of at least two letters). Returns NULL if no distance is at
 * most a third of the length of the word. next(context, i) returns candidate i, or NULL after the
 * last candidate. */
const char *choice_nearest(const char *word, const char *(*next)(const void *context, int i),
                           const void *context);

/* Returns the number of letters to change, add or remove, and of adjacent letters to exchange, to
 * convert a to b. Only the first 63 letters of a and the first 64 of b are compared. */
int choice_distance(const char *a, const char *b);

#endif
