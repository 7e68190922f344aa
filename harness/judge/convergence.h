/* Limit and order of a sequence of values on finer and finer meshes (Richardson). */
#ifndef BEAMWORK_CONVERGENCE_H
#define BEAMWORK_CONVERGENCE_H

typedef enum convergence_kind {
    CONVERGENCE_NONE,    /* fewer than three meshes, or differences that change sign or grow */
    CONVERGENCE_ORDERLY, /* v(n) = limit + c n^-order */
    CONVERGENCE_FLOOR    /* the last values agree to round-off: limit is the last value */
} convergence_kind;

typedef struct convergence {
    convergence_kind kind;
    double limit, limit_uncertainty;
    double order, order_uncertainty; /* NAN where there is none */
    int from; /* the asymptotic range: coarsest mesh from which on every three meshes show that order, within half of one; 0: none */
} convergence;

/* count values at ascending numbers of elements n; `scale` > 0: size of the value that relative errors refer to. */
convergence convergence_of(int count, const int n[], const double value[], double scale);

#endif
