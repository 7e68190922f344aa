/* A reference for structures without a truth: the limit on which formulations of different families
 * agree.  Types of one family share code or theory: that they agree proves little; families that
 * agree can all be wrong together, so that an agreement informs and never gates.  Who is known to
 * have another limit where the scene has a feature (a finding with that feature in its condition),
 * and who is kept with its misprint, does not vote.
 *
 * Each formulation has a limit L and its uncertainty U (limit.h).  Two agree when they have the
 * same theory of shear in stability, where that matters, and |L1 - L2| + U1 + U2 is within
 * FAMILIES_APART of their size.  Around the limit that most families agree with, at least two, the
 * reference is the mean by 1/U^2 of those that are within their U of it; its uncertainty is that of
 * the mean or their spread by the same weights, whichever is larger.  Others that are off by more
 * than their U are named.  Where no two families are that near, it is the limit of the one with the
 * nearest of another family, uncertain by their distance and U.  Where as many families agree on
 * another limit, there is no reference. */
#ifndef BEAMWORK_FAMILIES_H
#define BEAMWORK_FAMILIES_H

#include "harness/study/verdict.h"

/* Relative: half of the one per cent that `converge` answers for. */
#define FAMILIES_APART 5e-3
enum { FAMILIES_MOST = 8 };

typedef struct families_limit {
    int families;              /* that agree; below two: no reference */
    int disputed;              /* 1: as many agree on another limit */
    double value, uncertainty; /* [unit of the quantity] */
    int series[FAMILIES_MOST]; /* the nearest of each family, `families` of them */
    int others;                /* that are near, and off by more than their uncertainty */
    int other[FAMILIES_MOST];
    unsigned theory; /* of shear in stability, enum element_feature; 0: it does not matter */
} families_limit;

/* Of one point and quantity; for tests too, which see a dispute and how many agree. */
families_limit families_limit_of(const sweep *s, int point_index, int quantity, const truths *);
/* Adds a truth of kind agreement for every quantity of a point that has none of its model.
 * files_only: 1: of scene files, not of built-in cases. */
status families_add_truths(const sweep *s, int files_only, truths *t, fault *f);
/* The same of one point, all of whose series are done. */
status families_add_point(const sweep *s, int point_index, int files_only, truths *t, fault *f);
/* Room for all that can be added, before the first verdict refers to a truth. */
status families_reserve(const sweep *s, int files_only, truths *t, fault *f);

#endif
