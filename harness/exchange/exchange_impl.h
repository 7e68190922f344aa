/* Internal declarations of exchange/. */
#ifndef BEAMWORK_EXCHANGE_IMPL_H
#define BEAMWORK_EXCHANGE_IMPL_H

#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"
#include "harness/exchange/exchange.h"
#include "harness/study/study.h"

/* The cross-section of a solid: a lattice of rectangles along the y and z axes of the section, some
 * of which are filled.
 *
 * A straight wall is a strip along its centre line. Where walls meet at right angles, each one
 * is extended by half the thickness of the other: an L has its whole corner, and the area is
 * that of the walls. Where a wall ends on the side of another one (I, T), the section counts
 * half of the thickness there twice, but the solid counts it once. */

enum {
    FACE_WALLS = 8, /* minimum number of elements along the longer side of a section of walls */
    FACE_MOST = 2 * SECTION_MAX_WALLS + FACE_WALLS
};

typedef struct face {
    int elements[2];                            /* number along y and z */
    double corner[2][FACE_MOST + 1];            /* positions of the lattice lines, ascending,
                                                   from the centroid of the beam [m] */
    unsigned char filled[FACE_MOST][FACE_MOST]; /* [elements along y][elements along z] 1: filled
                                                   by a brick */
} face;

/* Returns the filled area [m^2]. */
double face_area(const face *);

/* A member as a structured mesh of C3D20R: bricks with 20 nodes and reduced integration. */

enum { BRICK_ALONG, BRICK_Y, BRICK_Z };

/* Nodes are on a lattice with two steps per element, numbered from its first corner. Numbers
 * that belong to positions without a node are not used. */
typedef struct brick {
    int elements[3];               /* number along x, y and z of the member */
    int first_node, first_element; /* numbers, starting at 1 */
    double origin[3], axes[9];     /* centre of the first face [m]; the columns of axes are the
                                      axes x, y, z */
    double length;                 /* [m] */
    face face;                     /* cross-section, which is the same along the whole member */
} brick;

/* Numbers start at first_node and first_element. along: number of elements along the member; the
 * numbers across the member come from its face. REFUSED: the section has no face. */
status brick_init(brick *out, const scene *s, int member, int along, int first_node,
                  int first_element, fault *f);
/* Return the first node number and the first element number that the brick does not use. */
int brick_next_node(const brick *);
int brick_next_element(const brick *);
/* Write the lines that follow the keywords *NODE and *ELEMENT. */
void brick_write_nodes(const brick *, FILE *to);
void brick_write_elements(const brick *, FILE *to);
/* Writes the node numbers of the first (end 0) or last face, one per line. */
void brick_write_face(const brick *, int end, FILE *to);

/* Rigid bodies of a deck. A body joins all faces at a node and at the nodes attached to it. Two
 * reference nodes move it: one by translations [m, N], one by rotations [rad, N m]. */

typedef struct body_numbers {
    int first; /* first number of the body of node 0; each scene node has two node numbers */
} body_numbers;

/* Returns the node in the deck for a component SCENE_UX .. SCENE_RZ, and its direction 1..3. */
int body_node(const body_numbers *, int node, int component);
int body_direction(int component);

/* Steps of a deck, with comments that assign printed numbers of steps to quantities:
 *
 *   **Q name|unit|displacements or forces|step|node|direction|reciprocal|factor|offset|x
 *
 * value = factor*printed + offset, with the reciprocal of the printed number if `reciprocal` is 1.
 * Steps start at 1; x [SI] is the abscissa of a curve, or empty. */

/* Quantities and loads of a scene that a deck of solids supports. All others are rejected, so none
 * is omitted without notice. */

/* Returns the index of the static analysis if there is exactly one, else SCENE_NONE. */
int carried_static(const scene *s);
/* REFUSED: the message names the part of the structure or of its analyses that a deck cannot
 * express, and the remedy. */
status carried_check(const scene *s, fault *f);
/* As carried_check, for the quantities. */
status carried_asked_check(const scene *s, fault *f);

/* Conversion of units of other programs; values are converted nowhere else.
 *
 * A unit is a product of powers with at most one '/': "N mm", "mm/N", "rad/(N m)", "1/s", "kg/m^3",
 * "%". Symbols: m mm cm um km in ft, N kN MN mN lbf, Pa kPa MPa GPa, kg g t, s ms us min, Hz kHz,
 * rad mrad deg, rpm, 1. Angles have no dimension. */

/* Computes the factor in 1 `from` = factor `to`. REFUSED: a unit is unknown, or the two have
 * different dimensions. */
status conversion_factor(const char *from, const char *to, double *factor, fault *f);

/* Values of another program as a series of a sweep, whose cells are not run here. */

/* Appends a series to the point; takes ownership of `found`, even after a failure. REFUSED: more
 * meshes than a series can have. */
status import_cells_add(sweep *s, int point_index, imported *found, fault *f);

/* Reads entries of a map in YAML (strings, numbers), and reports unknown keys and other errors with
 * their positions. */

/* Returns the string of an entry, or `otherwise` if the entry is missing. */
const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise);
double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise);

/* Points of a deck on a static path: its stations, points that quantities need, and the corners of
 * drivers and load factors, so each step is linear. */

typedef struct path_points {
    int count;
    double *value; /* [count] ascending */
} path_points;

void path_points_free(path_points *);

/* Nodes of a scene that move independently and carry faces of solids. */

/* Returns the node of the body to which a node belongs; the node itself if it is not attached to
 * another one. */
int rigid_body(const scene *s, int node);
/* Returns 1 if the node is not attached to another one, and a member ends at it or at a node
 * attached to it. */
int rigid_moves(const scene *s, int node);
/* Returns the axis 0, 1 or 2 of a node that rotates only about x, y or z; SCENE_NONE for other
 * nodes. */
int rigid_single_axis(const scene_node *n);

#endif
