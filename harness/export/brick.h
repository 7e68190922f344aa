/* A member with a rectangular section as a structured mesh of C3D20R: bricks with 20 nodes and
 * reduced integration. */
#ifndef BEAMWORK_BRICK_H
#define BEAMWORK_BRICK_H

#include <stdio.h>

#include "cases/scene/scene.h"

enum { BRICK_ALONG, BRICK_Y, BRICK_Z };

/* Nodes lie on a lattice with two steps for each element, numbered from its first corner; numbers
 * of places without a node stay unused. */
typedef struct brick {
    int elements[3];               /* along x, y, z of the member */
    int first_node, first_element; /* counted from 1 */
    double origin[3], axes[9];     /* centre of the first face [m]; columns: x, y, z */
    double length, height, width;  /* along x, y, z [m] */
} brick;

/* Numbers begin where told. along: elements along the member; across it 8 and 1 of a sheet, else 2
 * for the smaller side. */
void brick_init(brick *out, const scene *s, int member, int along, int first_node,
                int first_element);
/* First numbers behind it. */
int brick_next_node(const brick *);
int brick_next_element(const brick *);
/* The cards below *NODE and *ELEMENT. */
void brick_write_nodes(const brick *, FILE *to);
void brick_write_elements(const brick *, FILE *to);
/* The numbers of the nodes of the first (end 0) or last face, a line each. */
void brick_write_face(const brick *, int end, FILE *to);

#endif
