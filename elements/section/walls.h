/* Connection of straight thin walls: a spanning tree of the mid-lines, and the walls that close
 * cells.
 *
 * Equilibrium does not determine a flow that is constant around each cell and zero elsewhere.
 * Compatibility of the warping determines this flow by the value of oint flow/t ds (Bredt 1896;
 * Vlasov, Thin-walled elastic beams, 1961, chapter 4). */
#ifndef BEAMWORK_SECTION_WALLS_H
#define BEAMWORK_SECTION_WALLS_H

#include "elements/section/section.h"

/* Spanning tree whose root is point 0. The first walls - cells entries form the tree, from the root
 * outwards. Each of the other entries closes a cell. */
typedef struct section_tree {
    int wall[SECTION_MAX_WALLS];                         /* wall of an entry */
    int near[SECTION_MAX_WALLS], far[SECTION_MAX_WALLS]; /* end of the wall that is closer to the
                                                            root, and the opposite end */
    int cells;
    /* [cell][wall]: 1 if the cell contains the wall in the direction from `from` to `to`, -1 in the
     * opposite direction, 0 if the cell does not contain the wall */
    signed char round[SECTION_MAX_WALLS][SECTION_MAX_WALLS];
} section_tree;

/* Builds the tree. Returns REFUSED with the cause if the connection of the walls is invalid. */
status tree_grow(const section_spec *s, section_tree *t, fault *f);

/* Computes flow[walls], positive from `from` to `to`. The flow is constant around each cell and
 * satisfies oint flow/t ds = oint d(jump), where jump[w] is the contribution of wall w. The flow is
 * zero in an open section. */
void tree_flow(const section_spec *s, const section_tree *t, const double jump[], double flow[]);

double tree_wall_length(const section_spec *s, int w); /* [m] */

/* Shear flow of a thin-walled section.
 *
 * For normal stresses that are linear in y, z and omega, q = - sum over i of Q_i S_i/I_i, with the
 * first moments S of y, z and omega (J Eq. 27), Q = (Qy, Qz, Mw) and I = (Iz, Iy, Iw). */

enum { FLOW_GAUSS = 3 }; /* exact for the polynomials of degree five that occur */

typedef struct flow_rule {
    double x[FLOW_GAUSS], w[FLOW_GAUSS]; /* on [0, 1] */
} flow_rule;

flow_rule flow_rule_of_three(void);

/* Returns the value at x in [0, 1] of a function that is linear along wall w. `value` contains its
 * values at the points of the section. */
double flow_along(const section_spec *s, int w, const double value[], double x);

typedef struct flow_frame {
    double length, ty, tz, ny, nz;
} flow_frame;

flow_frame flow_frame_of(const section_spec *s, int w, const double y[], const double z[]);

/* First moments of y, z and omega at the far point of a wall, including contributions of cells
 * [m^3, m^3, m^4]. */
typedef struct flow_moments {
    double start[3];
} flow_moments;

/* Computes the first moments of all walls, in the order of the tree. `value` contains y, z and
 * omega at the points. */
void flow_first_moments(const section_spec *s, const section_tree *t, const double *value[3],
                        flow_moments q[]);
/* Returns moment i of wall t->wall[k] at x in [0, 1] from the far to the near point of the wall.
 * The direction towards the near point is positive. */
double flow_moment(const section_spec *s, const section_tree *t, const double *value[3],
                   const flow_moments q[], int k, int i, double x);

/* Adds int S_i S_j/t ds, plus the contribution across the thickness about the shear centre `pole`,
 * to sum. `value` contains y, z and omega at the points. */
void flow_compliance(const section_spec *s, const section_tree *t, const double *value[3],
                     const double pole[2], double sum[9]);

typedef struct walls_lines {
    section_tree tree;
    double y[SECTION_MAX_POINTS], z[SECTION_MAX_POINTS]; /* [m] */
    double omega[SECTION_MAX_POINTS]; /* sectorial coordinate about the shear centre, with zero mean
                                         [m^2] */
    double flow[SECTION_MAX_WALLS];   /* flow of Saint-Venant torsion of the cells, divided by G and
                                         by the twist rate, positive from `from` to `to` [m^2] */
    double pole[2];                   /* position of the shear centre [m] */
} walls_lines;

/* Returns the angle of the principal y axis [rad]: the smaller of the two possible angles, or 0 if
 * every axis is principal. */
double section_principal_angle(double Iyy, double Izz, double Iyz);

/* Computes the constants of a zeroed section, except those of shear and moments of higher order.
 * Returns REFUSED in the cases given at section_walls. */
status walls_lines_of(const section_spec *spec, walls_lines *lines, section *out, fault *f);

/* Adds the geometric constants and the shear compliance F to a zeroed section, without the
 * material. Returns REFUSED with the cause if the walls are invalid. */
status section_walls(const section_spec *spec, section *out, fault *f);

/* Returns int omega r^2 dA divided by the square root of int omega^2 dA int r^4 dA. This ratio
 * measures a coupling of bimoment and twist that differs between the two directions of twist and
 * that no element includes. The ratio is 0 for symmetric sections and for sections without
 * walls. */
double walls_one_sided(const section_spec *spec);

#endif
