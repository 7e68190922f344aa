/* Parts of a scene file, for the files that write it. */
#ifndef BEAMWORK_SCENE_WRITE_IMPL_H
#define BEAMWORK_SCENE_WRITE_IMPL_H

#include <stdio.h>

#include "cases/scene/entry.h"

typedef struct writer {
    FILE *to;
    const scene *scene;
    int unwritable; /* 1: a number that is none */
    int begun;      /* 1: a key stands in the map already */
} writer;

/* What functions of its own write of an entry: its key, and all behind it. */
typedef struct write_own {
    const char *key; /* NULL ends a list */
    void (*write)(writer *, const void *entry);
} write_own;

/* A map with the keys of an entry that are not as if they were left out. own, also of the maps
 * below it: NULL: none. */
void write_entry(writer *w, const entry_field *table, const void *entry, const write_own own[]);
/* "key: ", behind ", " where it is not the first of its map. */
void write_values_key(writer *w, const char *key);
/* The word of that index in "a|b|c". */
void write_values_word(writer *w, const char *words, int index);
/* A list of words between [ and ]: a bit for each. */
void write_values_bits(writer *w, const char *words, unsigned bits);

/* Six digits, or as many more as give the same number. */
void write_values_number(writer *w, double value);
/* [a, b, c] */
void write_values_numbers(writer *w, int count, const double value[]);
/* The diagonal of a 6 x 6 matrix, or all of it where the rest is not zero. */
void write_values_matrix(writer *w, const double A[36]);
/* Is one of them not zero? */
int write_values_any(int count, const double value[]);
/* Key and number where it differs from what a reader takes when it is not there. */
void write_values_if(writer *w, const char *key, double value, double otherwise);
/* In double quotes. */
void write_values_quoted(writer *w, const char *text);
/* What an entry is called in the file: as in the scene where no other is called so and a file can
 * say it, else by its number. */
void write_values_name(writer *w, scene_list list, int index);
void write_values_motion(writer *w, int index);
/* `before` and the name of an entry. */
void write_values_named(writer *w, const char *before, scene_list list, int index);
/* "ux" .. "rz" */
extern const char *const write_values_component[6];

void write_sections(writer *w);
void write_structure(writer *w);
void write_analyses(writer *w);
void write_quantities(writer *w);

#endif
