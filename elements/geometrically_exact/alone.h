/* Strains of one exact element; of two, the second for processors with AVX2, the same bits
 * (elements/math/real.h). */
#ifndef BEAMWORK_EXACT_ALONE_H
#define BEAMWORK_EXACT_ALONE_H

#include "elements/geometrically_exact/strain.h"

typedef void exact_alone_strains(const exact_strain_line *, const node_state x[], strain_output *);

exact_alone_strains exact_alone_strain_plain, exact_alone_strain_avx2;

#endif
