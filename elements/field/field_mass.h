/* Mass along an element on the displacement field (field.h).  Two nodes: the consistent mass of the
 * field; its frequencies converge with order 4 in slender bending, and with what is inside of the
 * element (below) with order 4 in any motion of a straight one.  Three nodes: lumped by Simpson's
 * rule, of order 4. */
#ifndef BEAMWORK_FIELD_MASS_H
#define BEAMWORK_FIELD_MASS_H

#include "elements/beamw/spread.h"
#include "elements/field/field.h"

typedef struct field_mass {
    int nodes;
    beamw_spread spread; /* two nodes */
    lumped_mass lumped;  /* three nodes: of the whole element */
} field_mass;

/* Order of frequencies without prestress, for two nodes and a stiffness that is exact without
 * loads; slender bending has the highest. */
#define FIELD_MASS_ORDER ((element_order){4, 8})

/* nodes: of an element. */
void field_mass_prepare(const element_request *, int nodes, field_mass *);
status field_mass_inertia(const field_mass *, const node_state x[], const element_rotating_frame *,
                          inertia_output *);

enum { FIELD_INNER = 2 * NODE_COORDINATES };

/* Effect of the mass of a straight element of two nodes that does not move as the field does: a
 * motion v of the nodes [14, in the axes of the element] of the eigenvalue lambda = omega^2 obeys
 *   v . K v = lambda v . M v + lambda^2 v . B v + O(lambda^3),   B = M_bu^T K_bb^-1 M_bu,
 * b the displacements between fixed ends: B is the flexibility of the fixed element under the
 * inertia of its static field, twice the complementary energy
 *   min over r: int s . C s dx,   s = s_p v + s_r r,
 * of resultants s_p in equilibrium with that inertia and those s_r of forces at the ends, and of
 * bimoments, alone.  B [14 x 14, kg s^2 and with m for each rotation, likewise warping], symmetric
 * and positive; zero for sections by matrices that couple and where a stiffness is zero. */
void field_inner(const element_request *, const displacement_field *,
                 double B[FIELD_INNER * FIELD_INNER]);

#endif
