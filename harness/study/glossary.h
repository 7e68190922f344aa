/* Words of the program and the report, explained (reference/glossary.csv), as they are packed. */
#ifndef BEAMWORK_GLOSSARY_H
#define BEAMWORK_GLOSSARY_H

#include "elements/shared/status.h"

typedef struct glossary_entry {
    char *term;
    char *also;    /* other names, separated by '|'; "": none */
    char *group;   /* heading; entries of one group stand together */
    char *meaning; /* one to four sentences */
    char *see;     /* terms to go on with, separated by '|'; "": none */
} glossary_entry;

typedef struct glossary {
    int entries;
    glossary_entry *entry;
} glossary;

enum { GLOSSARY_WORD = 128 };

/* FAULT: the packed truths are missing, damaged, or have none. */
status glossary_read(const char *path, glossary *out, fault *f);
void glossary_free(glossary *);
/* The entry that has the word as its term or another name, whatever its letters' case, '_' and '-'
 * as blanks; NULL: none. */
const glossary_entry *glossary_find(const glossary *, const char *word);
/* Are two words the same to glossary_find? */
int glossary_same(const char *a, const char *b);
/* Part `index` of "a|b|c" into word; 0: there are fewer. */
int glossary_part(const char *list, int index, char word[GLOSSARY_WORD]);

#endif
