/* Stiffness that a prestress gives to the undeformed collocation element. */
#ifndef BEAMWORK_EXACT_PRESTRESS_H
#define BEAMWORK_EXACT_PRESTRESS_H

#include "elements/exact/stages.h"

/* Derivative of the condensed stiffness [8 x 8] with respect to the stresses sigma [8] in the
 * undeformed geometry; dimensionless. */
void exact_prestress_stiffness(const exact_stages *s, const double sigma[], double G[]);

#endif
