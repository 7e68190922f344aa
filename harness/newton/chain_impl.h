/* What a chain consists of: chain.c builds it, chain_solve.c solves with it. */
#ifndef BEAMWORK_CHAIN_IMPL_H
#define BEAMWORK_CHAIN_IMPL_H

#include <stddef.h>

#include "harness/newton/chain.h"

/* Of a symmetric matrix the rows up to the diagonal, one after the other. */
static inline int chain_packed(int n)
{
    return n * (n + 1) / 2;
}

/* What is kept of a link: its A and F, and with Z, F of the row before it and its B what joins the
 * two: Z, B Z and Z F. */
struct chain {
    int links, count; /* count: that are there */
    int c, y, inside; /* coordinates of a joint; of a link; inside = y - c */
    int negative;
    double *kept;
    double
        *a; /* [(links + 1) x c] of joints, without forces behind them; then the forces on them */
    double F[CHAIN_JOINT * CHAIN_JOINT]; /* of the row */
    double A[CHAIN_JOINT * CHAIN_JOINT], B[CHAIN_JOINT * CHAIN_JOINT];
};

typedef struct kept_link {
    double *A, *Z;         /* [y x c], [c x c] */
    double *own, *BZ, *ZF; /* packed: F of the link, [y x y]; [c x c] */
} kept_link;

static inline int chain_kept_size(int c, int y)
{
    return y * c + c * c + chain_packed(y) + 2 * chain_packed(c);
}

static inline kept_link chain_kept(const chain *s, int link, int c, int y)
{
    kept_link k;
    k.A = s->kept + (size_t)link * (size_t)chain_kept_size(c, y);
    k.Z = k.A + y * c;
    k.own = k.Z + c * c;
    k.BZ = k.own + chain_packed(y);
    k.ZF = k.BZ + chain_packed(c);
    return k;
}

#endif
