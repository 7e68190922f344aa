/* A member as a structured mesh of C3D20R: bricks with 20 nodes and reduced integration. */
#ifndef BEAMWORK_BRICK_H
#define BEAMWORK_BRICK_H

#include <stdio.h>

#include "cases/scene/scene.h"
#include "harness/exchange/face.h"

enum { BRICK_ALONG, BRICK_Y, BRICK_Z };

/* Nodes lie on a lattice with two steps for each element, numbered from its first corner; numbers
 * of places without a node stay unused. */
typedef struct brick {
    int elements[3];               /* along x, y, z of the member */
    int first_node, first_element; /* counted from 1 */
    double origin[3], axes[9];     /* centre of the first face [m]; columns: x, y, z */
    double length;                 /* [m] */
    face face;                     /* of every place along it */
} brick;

/* Numbers begin where told. along: elements along the member; across it those of its face. REFUSED:
 * a section without a face. */
status brick_init(brick *out, const scene *s, int member, int along, int first_node,
                  int first_element, fault *f);
/* First numbers behind it. */
int brick_next_node(const brick *);
int brick_next_element(const brick *);
/* The cards below *NODE and *ELEMENT. */
void brick_write_nodes(const brick *, FILE *to);
void brick_write_elements(const brick *, FILE *to);
/* The numbers of the nodes of the first (end 0) or last face, a line each. */
void brick_write_face(const brick *, int end, FILE *to);

#endif
