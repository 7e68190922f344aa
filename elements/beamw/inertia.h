/* Inertia of the two-node beam: lumped at the nodes (J Eq. 73), consistent with the linear fields
 * of J section 3.2 in the element's deformed state, or the mean of both.  What a frame that turns
 * does to it derives from the same kinetic energy. */
#ifndef BEAMWORK_BEAMW_INERTIA_H
#define BEAMWORK_BEAMW_INERTIA_H

#include "elements/beamw/stiffness.h"
#include "elements/beamw/variants.h"

typedef enum beamw_inertia_kind {
    BEAMW_INERTIA_LUMPED,
    BEAMW_INERTIA_CONSISTENT,
    BEAMW_INERTIA_AVERAGED
} beamw_inertia_kind;

/* Fills lumped, field and share.  Without FEATURE_ROTARY_INERTIA only translations and the polar
 * moment of the twist count, so that the matrix is singular in the other rotations and in the
 * warping.  fields: NULL for lumped. */
void beamw_inertia_prepare(const section *c, unsigned features, beamw_inertia_kind kind,
                           const beamw_stiffness_fields *fields, element_data *d);

status beamw_inertia_of(const element_data *d, const node_state x[],
                        const element_rotating_frame *frame, inertia_output *out);

#endif
