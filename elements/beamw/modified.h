/* Second-order modified modes: which Q_i a BEAMW form has. */
#ifndef BEAMWORK_BEAMW_MODIFIED_H
#define BEAMWORK_BEAMW_MODIFIED_H

#include "elements/beamw/stiffness.h"

/* J Eq. 66 as printed: for Phi = 0 and the shear centre at the centroid consistent, otherwise not. */
void modified_printed(const section *c, unsigned features, element_data *d);

/* From the full shear interpolation: consistent with shear and eccentricity (reference/ERRATA.md), either theory of
 * shear in stability, with the monosymmetric Wagner moments where asked for. */
status modified_consistent(const section *c, unsigned features, const twist *t, const stiffness_fields *fields, element_data *d,
                           fault *f);

#endif
