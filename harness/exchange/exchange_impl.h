/* The inside of exchange/. */
#ifndef BEAMWORK_EXCHANGE_IMPL_H
#define BEAMWORK_EXCHANGE_IMPL_H

#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"
#include "harness/exchange/exchange.h"
#include "harness/study/study.h"

/* The cross-section of a solid: a lattice of rectangles in the section's own y, z, some of which
 * are filled.
 *
 * A straight wall is a strip along its centre line. Where walls meet at right angles each extends
 * by half the thickness of the other: an L has its whole corner, and the area is that of the walls.
 * Where a wall ends on the side of another (I, T), the walls count the half of its end that lies
 * inside the other twice; the solid has it once. */

enum {
    FACE_WALLS = 8, /* elements along the longer side of a section of walls, at least */
    FACE_MOST = 2 * SECTION_MAX_WALLS + FACE_WALLS
};

typedef struct face {
    int elements[2];                 /* along y, z */
    double corner[2][FACE_MOST + 1]; /* ascending, from the centroid of the beam [m] */
    unsigned char filled[FACE_MOST]
                        [FACE_MOST]; /* [elements along y][along z] 1: there is a brick */
} face;

/* Place of corner k of n elements on 0 to 1, dense at both ends. */
double face_graded(int k, int n);
/* section: what the spec comes to. REFUSED: tubes, constants, also given ones, walls that are
 * oblique to y and z. */
status face_of(const section_spec *spec, const section *constants, face *out, fault *f);
/* Area that is filled [m^2]. */
double face_area(const face *);

/* A member as a structured mesh of C3D20R: bricks with 20 nodes and reduced integration. */

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

/* Numbers begin at first_node and first_element. along: elements along the member; across it those
 * of its face. REFUSED: a section without a face. */
status brick_init(brick *out, const scene *s, int member, int along, int first_node,
                  int first_element, fault *f);
/* First numbers after it. */
int brick_next_node(const brick *);
int brick_next_element(const brick *);
/* The cards below *NODE and *ELEMENT. */
void brick_write_nodes(const brick *, FILE *to);
void brick_write_elements(const brick *, FILE *to);
/* The numbers of the nodes of the first (end 0) or last face, a line each. */
void brick_write_face(const brick *, int end, FILE *to);

/* Rigid bodies of a deck: all faces that end at a node or at what is attached to it, and two nodes
 * that move them: one of translations [m, N], one of rotations [rad, N m]. */

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
/* Writes the prescribed coordinates at `path`, below *BOUNDARY. */
void body_write_state(const body_numbers *, const scene *s, double path, FILE *to);
/* The same of a small motion: they stay. released: components of `node` (bit i) that are free. */
void body_write_held(const body_numbers *, const scene *s, int node, unsigned released, FILE *to);

/* The steps of a deck, and which printed number of which step is which quantity:
 *
 *   **Q name|unit|displacements or forces|step|node|direction|reciprocal|factor|offset|x
 *
 * value = factor*printed + offset, of the reciprocal of what is printed where it says 1; steps are
 * counted from 1, x [SI] is the abscissa of a curve or empty. */

/* All steps: linear analyses and compliances of the undeformed structure, then the static path,
 * with one unit load about its last state. FAULT: out of memory. */
status answers_write(const scene *s, const body_numbers *bodies, FILE *to, fault *f);

/* Quantities and loads of a scene that a deck of solids supports: everything else is refused, never
 * omitted. */

/* The one static analysis, or SCENE_NONE. */
int carried_static(const scene *s);
/* REFUSED: names what of the structure and its analyses no deck says, and what to do. */
status carried_check(const scene *s, fault *f);
/* The same of the quantities. */
status carried_asked_check(const scene *s, fault *f);

/* Units of other programs: the only place where values are converted.
 *
 * A unit is a product of powers with at most one '/': "N mm", "mm/N", "rad/(N m)", "1/s", "kg/m^3",
 * "%".  Symbols: m mm cm um km in ft, N kN MN mN lbf, Pa kPa MPa GPa, kg g t, s ms us min, Hz kHz,
 * rad mrad deg, rpm, 1. Angles have no dimension. */

/* factor: 1 `from` = factor `to`.  REFUSED: a unit that is not known, or of another dimension. */
status conversion_factor(const char *from, const char *to, double *factor, fault *f);

/* Values of another program as a series of a sweep: cells that were not run here. */

/* Sorts the values by elements, quantity, abscissa. */
void import_cells_order(imported *found);
/* A series of the point, after those that the point has; it owns what was found, also after a
 * failure. REFUSED: more meshes than a series has room for. */
status import_cells_add(sweep *s, int point_index, imported *found, fault *f);

/* Entries of a map in YAML: unknown keys, texts, numbers; mistakes with their places. */

/* A mistake for every key that is not in the list, which ends with NULL. */
void map_keys_check(const document_node *map, const char *const known[], mistakes *m);
/* The text of an entry; `otherwise` where there is none. */
const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise);
double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise);
/* A whole number, zero or above. */
int map_keys_count(mistakes *m, const document_node *map, const char *key, int otherwise);

/* Points of a deck on a static path: its stations, those that quantities need, and the corners of
 * drivers and load factors, so that each step is straight. */

typedef struct path_points {
    int count;
    double *value; /* [count] ascending */
} path_points;

status path_points_of(const scene *s, int analysis, path_points *out, fault *f);
void path_points_free(path_points *);
/* Does the quantity, of the path or of what follows it, ask for its value at the point? */
int path_points_asked(const scene *s, int analysis, const scene_quantity *q, double point);

/* Which nodes of a scene are moved by themselves, and carry faces of solids. */

/* Node whose body a node is part of: itself where it is attached to none. */
int rigid_body(const scene *s, int node);
/* Is it a body, or a node of its own, at which a member ends? */
int rigid_moves(const scene *s, int node);
/* One turn about x, y or z and no other: its axis 0, 1 or 2; SCENE_NONE: it turns otherwise. */
int rigid_single_axis(const scene_node *n);

#endif
