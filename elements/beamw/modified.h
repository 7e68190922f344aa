/* Second-order modified modes: which Q_i a BEAMW variant has. */
#ifndef BEAMWORK_BEAMW_MODIFIED_H
#define BEAMWORK_BEAMW_MODIFIED_H

#include "elements/beamw/stiffness.h"
#include "elements/beamw/variants.h"

/* J Eq. 66 as printed: for Phi = 0 and the shear centre at the centroid consistent, otherwise not.
 */
void beamw_modified_printed(const section *c, unsigned features, element_data *d);

enum {
    BEAMW_MODIFIED_VARIABLES = BEAMW_STRAINS + 3
}; /* e, and z: the parts of h [3] that are bending (y, z) and warping */

/* From the full shear interpolation: consistent with shear and eccentricity (reference/ERRATA.md),
 * either theory of shear in stability, with the monosymmetric Wagner moments where asked for.  ebar
 * = e + 1/2 y^T Q y, y = (e, z). */
void beamw_modified_consistent(
    const section *c, unsigned features, double l0, const beamw_twist *t,
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES]);

/* The same with z = hg, as in the unstressed element: Q of e alone. */
void beamw_modified_reduce(
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES], element_data *d);

#endif
