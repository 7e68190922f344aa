/* Deformation modes of the two-node beam: eight generalized strains, all lengths, from the nodes'
 * positions and triads (J Eq. 7).  e1 elongation, e2 torsion, e3 e4 bending in x-z, e5 e6 bending
 * in x-y, e7 e8 = l0^2 a. */
#ifndef BEAMWORK_BEAMW_MODES_H
#define BEAMWORK_BEAMW_MODES_H

#include "elements/element.h"

/* l0: initial length [m].  Same conventions as element_type.strain: e[8], J[8 x 14], s[8] in, H[14
 * x 14]. */
void beamw_modes_strain(double l0, const node_state x[2], strain_output *out);

#endif
