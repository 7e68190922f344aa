/* Expressions that choose cells: -k "c_column and not (beamw or beamw_first)". */
#ifndef BEAMWORK_SELECT_H
#define BEAMWORK_SELECT_H

#include "elements/shared/status.h"

/* Words of an expression, their length, and brackets and nots inside each other. */
enum { SELECT_WORDS = 256, SELECT_WORD = 128, SELECT_DEPTH = 64 };

/* Does an expression (words joined by and, or, not, in brackets where they belong together; a word
 * is looked for in text, =NAME is one of its parts between slashes) hold? -1: malformed. */
int select_matches(const char *expression, const char *text);
/* Does it hold of every text that this one is a part of? Of an expression with a not: 0. NULL: all
 * is chosen. */
int select_covers(const char *expression, const char *part);

/* Which words of an expression anything is called by: a misspelt one would leave cells out in
 * silence. */
typedef struct select_words {
    char met[SELECT_WORDS];
} select_words;

/* STATUS_REFUSED: malformed. Names of cases and formulations are met, whether there are cells of
 * them or not. expression NULL: all is chosen. */
status select_begin(const char *expression, select_words *, fault *);
void select_meet(const char *expression, const char *text, select_words *);
/* The first word that was never met; 0: all were. */
int select_unmet(const char *expression, const select_words *, char word[SELECT_WORD]);
/* STATUS_REFUSED: the first word that was never met, and the nearest name. */
status select_all_met(const char *expression, const select_words *, fault *);

#endif
