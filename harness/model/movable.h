/* The motions [6: displacement, turn] that a node can make: the span of the columns of its
 * Jacobian.  Axes that are computed are known to round-off only, so that dimensions are decided
 * beside the size of the columns and never by comparison with zero. */
#ifndef BEAMWORK_MOVABLE_H
#define BEAMWORK_MOVABLE_H

typedef struct movable {
    int count;           /* dimension */
    unsigned components; /* bit i: some motion has component i */
    int whole;           /* 1: the motions are those of components, one by one ... */
    int component[6];    /* ... [count] */
    double span[36]; /* [6 x count] a basis: unit vectors where these span it, else orthonormal with
                        lengths in units of `length` */
    double dual[36]; /* [count x 6] dual span = 1: the least combination of components that gives a
                        basis vector's share */
} movable;

/* T[6 x columns]: columns of motions, of order 1 in displacements per displacement or turns per
 * angle.  length [m] > 0: of the structure. */
void movable_of(int columns, const double *T, double length, movable *out);
/* out[3] = m without its part along the turns among the columns of T: along these nothing is
 * prescribed, and a moment there is what Newton's method left over. */
void movable_prescribed(int columns, const double *T, const double m[3], double out[3]);

#endif
