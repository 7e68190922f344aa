/* What the values of one point are measured by: a truth that is stored there, one that a deriving
 * program solves for, or the limit that the meshes of all formulations of the same physics go to.
 *
 * Of limits the one with the least uncertainty U counts; its doubt is U and what another one is off
 * beyond its own uncertainty, where that is more.  A doubt of more than half of the tolerance is
 * none to measure by: a truth is passed over, limits are disputed, or where U alone is more, not
 * known. */
#ifndef BEAMWORK_REFERENCE_H
#define BEAMWORK_REFERENCE_H

#include "harness/experiments/rows.h"
#include "harness/study/study.h"

typedef struct point_reference {
    rows_reference kind;
    double value, doubt; /* doubt: relative */
} point_reference;

/* Of a series of the sweep and a quantity of its scene; stored, derived: truths of this point.
 * NULL: none. */
point_reference reference_of(const sweep *s, int series_index, int quantity, const truths *stored,
                             const truths *derived, double tolerance);

#endif
