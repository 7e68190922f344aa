/* Parts of a scene file, for the files that write it. */
#ifndef BEAMWORK_SCENE_WRITE_IMPL_H
#define BEAMWORK_SCENE_WRITE_IMPL_H

#include <stdio.h>

#include "cases/scene/names.h"

typedef struct writer {
    FILE *to;
    const scene *scene;
    int unwritable; /* 1: a number that is none */
} writer;

/* Six digits, or as many more as give the same number. */
void write_values_number(writer *w, double value);
/* [a, b, c] */
void write_values_numbers(writer *w, int count, const double value[]);
/* KEY followed by the diagonal of a 6 x 6 matrix, or by all of it where the rest is not zero. */
void write_values_matrix(writer *w, const char *key, const double A[36]);
/* Is one of them not zero? */
int write_values_any(int count, const double value[]);
/* ", key: number" where it differs from what a reader takes when it is not there. */
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
void write_structure_nodes(writer *w);
void write_structure_members(writer *w);
void write_structure_springs(writer *w);
void write_structure_motions(writer *w);
void write_structure_loads(writer *w);
void write_analyses(writer *w);
void write_quantities(writer *w);

#endif
