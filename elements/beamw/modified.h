/* Second-order modified modes: which Q_i a BEAMW form has. */
#ifndef BEAMWORK_BEAMW_MODIFIED_H
#define BEAMWORK_BEAMW_MODIFIED_H

#include "elements/beamw/stiffness.h"

/* J Eq. 66 as printed: for Phi = 0 and the shear centre at the centroid consistent, otherwise not. */
void modified_printed(const section *c, unsigned features, element_data *d);

enum {
    MODIFIED_VARIABLES = FORMS_STRAINS + 3
}; /* e, and z: the parts of h [3] that are bending (y, z) and warping */

/* From the full shear interpolation: consistent with shear and eccentricity (reference/ERRATA.md), either theory of
 * shear in stability, with the monosymmetric Wagner moments where asked for.  ebar = e + 1/2 y^T Q y, y = (e, z). */
status modified_consistent(const section *c, unsigned features, double l0, const twist *t,
                           const stiffness_fields *fields,
                           double Q[FORMS_MODIFIED][MODIFIED_VARIABLES * MODIFIED_VARIABLES],
                           fault *f);

/* The same with z = hg, as in the unstressed element: Q of e alone. */
void modified_reduce(const stiffness_fields *fields,
                     double Q[FORMS_MODIFIED][MODIFIED_VARIABLES * MODIFIED_VARIABLES],
                     element_data *d);

#endif
