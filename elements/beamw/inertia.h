/* Inertia of the two-node beam: lumped at the nodes (J Eq. 73, its J corrected to diag(Ip, Iy, Iz)), consistent with the
 * linear fields of J section 3.2, or the mean of both. */
#ifndef BEAMWORK_BEAMW_INERTIA_H
#define BEAMWORK_BEAMW_INERTIA_H

#include "elements/beamw/stiffness.h"

typedef enum inertia_kind { INERTIA_LUMPED, INERTIA_CONSISTENT, INERTIA_AVERAGED } inertia_kind;

/* Fills lumped, consistent and share.  Without FEATURE_ROTARY_INERTIA only translations and the polar moment of the
 * twist count, so that the matrix is singular in the other rotations and in the warping. */
void inertia_prepare(const section *c, unsigned features, inertia_kind kind, const stiffness_fields *fields, element_data *d);

/* Moving nodes (v, a): convective forces exist for the lumped mass only; REFUSED with another. */
status inertia_of(const element_data *d, const node_state x[], const node_rate v[], const node_rate a[], inertia_output *out);

#endif
