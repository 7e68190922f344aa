#ifndef BEAMWORK_IMPORT_EXPORT_IMPL_H
#define BEAMWORK_IMPORT_EXPORT_IMPL_H

#include <stdio.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"
#include "harness/import_export/import_export.h"
#include "harness/study/study.h"

/* The cross-section of a solid: a lattice of rectangles along the y and z axes of the section, some
 * of which are filled. A straight wall is a strip along its centre line. Where a wall ends at the
 * centre line of another wall (I, T), they overlap over half of the thickness of the other wall.
 * The area of the section counts the overlap twice, that of the solid once. */

enum {
    FACE_WALLS = 8, /* minimum number of elements along the longer side of a section of walls */
    FACE_MOST = 2 * SECTION_MAX_WALLS + FACE_WALLS
};

typedef struct face {
    int elements[2];
    /* positions [m] of the lattice lines relative to the centroid of the beam, in ascending
     * order */
    double corner[2][FACE_MOST + 1];
    /* [elements along y][elements along z] 1: a brick fills the rectangle */
    unsigned char filled[FACE_MOST][FACE_MOST];
} face;

/* Returns the filled area [m^2]. */
double face_area(const face *);

enum { BRICK_ALONG, BRICK_Y, BRICK_Z };

/* Nodes are on a lattice with two steps per element. Their numbers increase along z first, then
 * along y, then along x. Numbers of positions without a node are not used. */
typedef struct brick {
    int elements[3]; /* number of elements along x, y and z of the member */
    int first_node, first_element;
    /* start of the member [m]; the columns of `axes` are the axes x, y, z of the member */
    double origin[3], axes[9];
    double length;
    face face; /* cross-section, which is constant along the member */
} brick;

/* Makes the mesh of a member. Numbers start at first_node and first_element. along: number of
 * elements along the member; the numbers across the member follow from its face. REFUSED:
 * scene_constants rejects the section, or it cannot be divided into bricks. */
status brick_init(brick *out, const scene *s, int member, int along, int first_node,
                  int first_element, fault *f);
/* Return the first node number and the first element number that the brick does not use. */
int brick_next_node(const brick *);
int brick_next_element(const brick *);
/* Write the lines after the keywords *NODE and *ELEMENT. */
void brick_write_nodes(const brick *, FILE *to);
void brick_write_elements(const brick *, FILE *to);
/* Writes the node numbers of the first face (end 0) or of the last face (end 1), one per line. */
void brick_write_face(const brick *, int end, FILE *to);

/* Rigid bodies of a deck. A body connects all faces at a node and at the nodes attached to this
 * node. Two reference nodes move the body, one with translations [m, N] and one with rotations
 * [rad, N m]. */

typedef struct body_numbers {
    int first; /* first number of the body of node 0; each node of the scene has two node numbers */
} body_numbers;

/* Returns the node of the deck for a component SCENE_UX .. SCENE_RZ, and its direction 1..3. */
int body_node(const body_numbers *, int node, int component);
int body_direction(int component);

/* Steps of a deck, with comments that assign printed numbers of steps to quantities:
 *
 *   **Q name|unit|displacements or forces|step|node|direction|reciprocal|factor|offset|x
 *
 * value = factor*printed + offset, with the reciprocal of the printed number if `reciprocal` is 1.
 * Steps start at 1; x [SI] is the abscissa of a curve, or empty. */

/* Quantities and loads of a scene that a deck of solids supports. All others are rejected, so a
 * deck never omits one without a message. */

/* Returns the index of the first static analysis; SCENE_NONE: there is none. */
int export_is_static(const scene *s);
/* Checks the scene. REFUSED: the message names the part of the structure or of its analyses that a
 * deck cannot express, and the remedy. */
status export_support_check(const scene *s, fault *f);
/* Like export_support_check, for the quantities, with the same statuses. */
status export_support_requests(const scene *s, fault *f);

/* Conversion of units of other programs. Values are converted only by these functions. A unit is a
 * product of powers with at most one '/': "N mm", "mm/N", "rad/(N m)", "1/s", "kg/m^3", "%".
 * Symbols are m mm cm um km in ft, N kN MN mN lbf, J mJ kJ MJ, Pa kPa MPa GPa, kg g t, s ms us min,
 * Hz kHz, rad mrad deg, rpm, %, 1 and -. Angles have no dimension. */

/* Computes the factor in 1 `from` = factor `to`. REFUSED: a unit is unknown, or the two units have
 * different dimensions. */
status conversion_factor(const char *from, const char *to, double *factor, fault *f);

/* Values of another program as a series of a sweep. The cells of such a series are not run. */

/* Appends a series to the point. Takes ownership of `found`, even after a failure. REFUSED: there
 * are more meshes than a series can have. FAULT: out of memory. */
status import_cells_add(sweep *s, int point_index, imported *found, fault *f);

/* Returns the string of an entry, or `otherwise` if the entry is missing. A value that is not a
 * string is added to m as an error. map_keys_number does the same for a number. */
const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise);
double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise);

/* Points on a static path at which steps of a deck end: stations, points that quantities need, and
 * changes of slope of drivers and load factors. Drivers and load factors are then linear within
 * each step. */

typedef struct path_points {
    int count;
    double *value; /* [count] ascending */
} path_points;

void path_points_free(path_points *);

/* Returns the node of the body to which a node belongs, or the node if it is not attached to
 * another node. */
int rigid_body(const scene *s, int node);
/* Returns 1 if the node is not attached to another node, and a member ends at the node or at a node
 * attached to it. */
int rigid_moves(const scene *s, int node);
/* Returns the axis 0, 1 or 2 of a node that rotates only about x, y or z; SCENE_NONE: another
 * node. */
int rigid_single_axis(const scene_node *n);

#endif
