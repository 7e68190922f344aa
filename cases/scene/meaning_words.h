/* Parts of the words of a quantity: nodes, members, coordinates and ordinals. */
#ifndef BEAMWORK_MEANING_WORDS_H
#define BEAMWORK_MEANING_WORDS_H

#include <stdio.h>

#include "cases/scene/scene.h"

/* " of node_1 (0.1, 0, 0)" behind the preposition. */
void meaning_node(FILE *to, const scene *s, const char *preposition, int node);
/* " of member_0 (node_0 to node_1)" */
void meaning_member(FILE *to, const scene *s, int member);
/* " at the end", " at 0.5 of the length": before: of what jumps there. */
void meaning_place(FILE *to, double where, int before);
/* "x" of SCENE_UX and SCENE_RX. */
char meaning_axis(int component);
/* "force along", "moment about". */
const char *meaning_load(int component);
/* "first", "second", ... of 0, 1, ... */
void meaning_ordinal(FILE *to, int order);
/* "displacement of node_1 (...) along x", "rotation of ... about x". */
void meaning_coordinate(FILE *to, const scene *s, int node, int component);

#endif
