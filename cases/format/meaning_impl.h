/* Parts of the words of a quantity, for the files that put them together. */
#ifndef BEAMWORK_MEANING_IMPL_H
#define BEAMWORK_MEANING_IMPL_H

#include <stdio.h>

#include "cases/scene/scene.h"

/* " of node_1 (0.1, 0, 0)" behind the preposition. */
void meaning_node(FILE *to, const scene *s, const char *preposition, int node);
/* "x" of SCENE_UX and SCENE_RX. */
char meaning_axis(int component);
/* "first", "second", ... of 0, 1, ... */
void meaning_ordinal(FILE *to, int order);
/* "displacement of node_1 (...) along x", "rotation of ... about x". */
void meaning_coordinate(FILE *to, const scene *s, int node, int component);
/* What motions have: as seen from another node, a velocity, an entry of a rotation, energies. */
void meaning_relative(FILE *to, const scene *s, const scene_relative *what);
void meaning_rate(FILE *to, const scene *s, const scene_component *what);
void meaning_orientation(FILE *to, const scene *s, const scene_orientation *what);
void meaning_balance(FILE *to, scene_balance what);
/* Of which states of which analysis: ", at the end of the static path". */
void meaning_state(FILE *to, const scene *s, const scene_quantity *q);

#endif
