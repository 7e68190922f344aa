/* Stresses of one element by collocation; of each two, the second for processors with AVX2, the
 * same bits (elements/math/real.h). */
#ifndef BEAMWORK_COLLOCATION_ALONE_H
#define BEAMWORK_COLLOCATION_ALONE_H

#include "elements/collocation/along.h"

typedef status exact_alone_stresses(const exact_stages *, const double e[], const double inner[],
                                    stress_output *);
/* As element_type.along, of one. */
typedef status exact_alone_loads(const exact_stages *, const exact_along *, const node_state x[],
                                 along_output *);

exact_alone_stresses exact_alone_stress_plain, exact_alone_stress_avx2;
exact_alone_loads exact_alone_along_plain, exact_alone_along_avx2;

#endif
