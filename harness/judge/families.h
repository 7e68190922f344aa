/* A reference for structures without a truth: the limit on which formulations of different families
 * agree.  Types of one family share code or theory: that they agree proves little; families that
 * agree can all be wrong together, so that an agreement informs and never gates.
 *
 * Each formulation has a limit L and its uncertainty U (limit.h).  Two agree when |L1 - L2| + U1 +
 * U2 is within FAMILIES_APART of their size.  The reference is the limit that most families agree
 * with, at least two; of several that with the least uncertainty: the distance to the nearest of
 * another family with what both are uncertain by, or what a third is off beyond its own
 * uncertainty, where that is more. Where as many families
 * agree on another limit, there is no reference. */
#ifndef BEAMWORK_FAMILIES_H
#define BEAMWORK_FAMILIES_H

#include "harness/judge/verdict.h"

/* Relative: half of the one per cent that `converge` answers for. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families;              /* that agree; below two: no reference */
    int disputed;              /* 1: as many agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    int series[FAMILIES_MOST]; /* the nearest of each family, `families` of them */
} families_limit;

/* Of one point and quantity; for tests too, which see a dispute and how many agree. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity);
/* Adds a truth of kind agreement for every quantity of a point that has none of its model.
 * files_only: 1: of scene files, not of built-in cases. */
status families_add_truths(const sweep *s, int files_only, truths *t, fault *f);
/* The same of one point, all of whose series are done. */
status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f);
/* Room for all that can be added, before the first verdict refers to a truth. */
status families_reserve(const sweep *s, int files_only, truths *t, fault *f);

#endif
