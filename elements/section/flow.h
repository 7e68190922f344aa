/* Shear flow of a section of thin walls, by equilibrium from the free ends and, around cells, by
 * compatibility.
 *
 * With normal stress that is linear in y, z and omega along the member, q = -sum over i of Q_i
 * S_i/I_i with the first moments S of y, z and omega (J Eq. 27), Q = (Qy, Qz, Mw), I = (Iz, Iy,
 * Iw). */
#ifndef BEAMWORK_SECTION_FLOW_H
#define BEAMWORK_SECTION_FLOW_H

#include "elements/section/tree.h"

enum { FLOW_GAUSS = 3 }; /* exact for the polynomials of degree five that occur */

typedef struct flow_rule {
    double x[FLOW_GAUSS], w[FLOW_GAUSS]; /* on [0, 1] */
} flow_rule;

flow_rule flow_rule_of_three(void);

/* Value at x in [0, 1] of a function that is linear along the wall, from its values at the points.
 */
double flow_along(const section_spec *s, int w, const double value[], double x);

/* Directions of a wall: t along it, n = (tz, -ty) its normal. */
typedef struct flow_frame {
    double length, ty, tz, ny, nz;
} flow_frame;

flow_frame flow_frame_of(const section_spec *s, int w, const double y[], const double z[]);

/* First moments of y, z and omega at the far point of a wall, with what the cells add [m^3, m^3,
 * m^4]. */
typedef struct flow_moments {
    double start[3];
} flow_moments;

/* q[walls], in the order of the tree; value: y, z and omega at the points. */
void flow_first_moments(const section_spec *s, const section_tree *t, const double *value[3],
                        flow_moments q[]);
/* Moment i of wall t->wall[k] at x in [0, 1] from its far to its near point, positive towards the
 * latter. */
double flow_moment(const section_spec *s, const section_tree *t, const double *value[3],
                   const flow_moments q[], int k, int i, double x);

/* Adds int S_i S_j/t ds, plus the share across the thickness about the shear centre `pole`, to sum.
 * value: y, z and omega at the points. */
void flow_compliance(const section_spec *s, const section_tree *t, const double *value[3],
                     const double pole[2], double sum[9]);

#endif
