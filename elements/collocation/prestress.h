/* Stiffness that a prestress gives to the undeformed collocation element. */
#ifndef BEAMWORK_EXACT_PRESTRESS_H
#define BEAMWORK_EXACT_PRESTRESS_H

#include "elements/collocation/stages.h"

/* Q[i]: derivative of the condensed stiffness [8 x 8] with respect to stress i of the undeformed
 * geometry, in which it is linear; dimensionless. */
void exact_prestress_derivatives(
    const exact_stages *s, double Q[EXACT_STAGES_OUTER][EXACT_STAGES_OUTER * EXACT_STAGES_OUTER]);

/* The same in the direction of loads along the element between held nodes, which add along[stages]
 * to F at the points: Q [strains x strains]. */
void exact_prestress_load(const exact_stages *s, double along[][3],
                          double Q[EXACT_STAGES_OUTER * EXACT_STAGES_OUTER]);

#endif
