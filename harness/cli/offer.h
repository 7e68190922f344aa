/* What may stand at the place of the cursor, for a shell. */
#ifndef BEAMWORK_OFFER_H
#define BEAMWORK_OFFER_H

#include <stdio.h>

/* The word that is being written: `before` of it stays as it is, `begun` is to be completed. */
typedef struct offer {
    FILE *to;
    const char *before;
    int length; /* of before */
    const char *begun;
} offer;

/* A line "WORD<tab>SUMMARY" where the text begins as what was begun: the whole word, the text
 * behind `before`. What ends in '=' or ':' goes on. */
void offer_text(const offer *o, const char *text, const char *summary);
/* Each of "a|b|c". */
void offer_choices(const offer *o, const char *choices);
/* The place is that of a file, of a folder: a line that begins with ':', for the shell to do. */
void offer_files(const offer *o);
void offer_folders(const offer *o);
/* The same offer behind the last of the characters in what was begun (else: itself). */
offer offer_behind(const offer *o, const char *characters);

#endif
