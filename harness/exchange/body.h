/* Rigid bodies of a deck: all faces that end at a node or at what is attached to it, and two nodes
 * that move them: one of translations [m, N], one of rotations [rad, N m]. */
#ifndef BEAMWORK_BODY_H
#define BEAMWORK_BODY_H

#include <stdio.h>

#include "harness/exchange/brick.h"

typedef struct body_numbers {
    int first; /* of the two nodes of node 0's body; of node i: two further each */
} body_numbers;

/* The deck's node of a component, SCENE_UX .. SCENE_RZ, and its direction 1..3. */
int body_node(const body_numbers *, int node, int component);
int body_direction(int component);
/* Their cards below *NODE. */
void body_write_nodes(const body_numbers *, const scene *s, FILE *to);
/* Sets of faces, the bodies, and the set BODIES of all their nodes. bricks: [members]. */
void body_write(const body_numbers *, const scene *s, const brick bricks[], FILE *to);
/* Where all prescribed coordinates are at `path`, below *BOUNDARY. */
void body_write_state(const body_numbers *, const scene *s, double path, FILE *to);
/* The same of a small motion: they stay. released: components of `node` (bit i) that are free. */
void body_write_held(const body_numbers *, const scene *s, int node, unsigned released, FILE *to);

#endif
