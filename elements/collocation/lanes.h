/* Strains and stresses of several elements by collocation at once, as
 * elements/geometrically_exact/lanes.h. */
#ifndef BEAMWORK_COLLOCATION_LANES_H
#define BEAMWORK_COLLOCATION_LANES_H

#include "elements/collocation/along.h"
#include "elements/geometrically_exact/lanes.h"

typedef void exact_lanes_loads(const exact_stages *, const exact_along *, int count,
                               const node_state x[], along_output out[], status outcome[]);

/* For data that begin with exact_stages. */
exact_lanes_strains exact_lanes_stages_strain_plain, exact_lanes_stages_strain_avx2;
exact_lanes_stresses exact_lanes_stages_stress_plain, exact_lanes_stages_stress_avx2;
/* For one kind, at most LANES_TOGETHER; as element_type.along. */
exact_lanes_loads exact_lanes_along_plain, exact_lanes_along_avx2;

#endif
