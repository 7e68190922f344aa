/* A command line as words. */
#ifndef BEAMWORK_WORDS_H
#define BEAMWORK_WORDS_H

#include <stdio.h>

#include "elements/shared/status.h"

enum { WORDS_MOST = 63 };

/* *words: NULL-terminated, to be freed at once with what they point to. Blanks part words; quotes '
 * and " keep blanks. REFUSED: none, too many, a quote that does not end; FAULT: memory. */
status words_split(const char *command, char ***words, fault *f);

/* A word as a shell reads it: as it is, or in quotes where it needs them. */
void words_quote(FILE *to, const char *word);
/* The same as a text, as far as there is room. */
void words_quoted(const char *word, char *out, size_t size);

#endif
