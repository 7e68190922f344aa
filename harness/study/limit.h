/* Limit of a sequence of values on finer and finer meshes, and how well it is known.
 *
 * The limit is Richardson's with an order of its own, from the last three meshes.  Its uncertainty
 * is the change of that limit when the last mesh was added, times 1.25, where two orders agree;
 * else the worst of the last changes, times 3.  No step takes the smaller of two estimates.
 * Sources: Roache, Verification and Validation in Computational Science and Engineering (1998),
 * grid convergence index and its factors 1.25 and 3; Eca and Hoekstra, J. Comput. Phys. 262 (2014)
 * 104-130, range of the data, poor orders, noise; Phillips and Roy, J. Fluids Eng. 136 (2014)
 * 121401, limits of extrapolated limits; Oberkampf and Roy, Verification and Validation in
 * Scientific Computing (2010), chapter 8. */
#ifndef BEAMWORK_LIMIT_H
#define BEAMWORK_LIMIT_H

enum { LIMIT_MESHES = 32 };

/* What a sequence looks like: for the reader; a verdict rests on the value and its uncertainty
 * alone. */
typedef enum limit_kind {
    LIMIT_NONE,            /* no value at all */
    LIMIT_NOISE_DOMINATED, /* the last two changes are noise */
    LIMIT_SETTLED,         /* known to 1e-4 of its size, or its last change is noise */
    LIMIT_ASYMPTOTIC,      /* two orders agree: value(n) = limit + c n^-order */
    LIMIT_OSCILLATING,     /* the last two changes differ in sign */
    LIMIT_NOT_YET,         /* drifting orders, or fewer than three meshes */
    LIMIT_KINDS
} limit_kind;

typedef struct limit_sequence {
    int count;           /* at most LIMIT_MESHES */
    const int *n;        /* [count] numbers of elements, in any order */
    const double *value; /* [count] where not finite: left out */
    double noise;        /* relative, measured; NAN: not measured */
    /* the least and the highest that formulation and quantity can show */
    double nominal_order, highest_order;
    /* [unit of value] size of the quantity where the limit may vanish; 0: its own size */
    double near_zero;
} limit_sequence;

typedef struct mesh_limit {
    limit_kind kind;
    double limit, limit_uncertainty; /* NAN, INFINITY: none */
    /* NAN where none is seen; uncertainty: difference of the last two orders */
    double order, order_uncertainty;
    double earlier_order; /* of the three meshes before those two orders; NAN: none */
    int order_turns; /* 1: of these three orders the middle one is clearly the least or the greatest
                      */
    double noise;    /* [unit of value] that was reckoned with */
    double last_change; /* |last value - the one before|; NAN: one mesh */
    /* coarsest mesh that was used, 0: none; number of meshes left after thinning */
    int from, meshes;
} mesh_limit;

mesh_limit limit_of(const limit_sequence *s);
const char *limit_kind_name(limit_kind kind);

#endif
