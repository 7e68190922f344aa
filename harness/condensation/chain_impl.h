/* What a chain consists of: chain.c builds it, chain_solve.c solves with it. */
#ifndef BEAMWORK_CHAIN_IMPL_H
#define BEAMWORK_CHAIN_IMPL_H

#include <stddef.h>

#include "harness/condensation/chain.h"

/* What is kept of a link: its A, B and F, and of the row before it F and Z; turned where products
 * then run along rows. */
struct chain {
    int links, count; /* count: that are there */
    int c, y, inside; /* coordinates of a joint; of a link; inside = y - c */
    int size;         /* doubles of a link in `kept` */
    int negative;
    double *kept;
    double *a;           /* [(links + 1) x c] of joints, without forces behind them */
    double *g;           /* [links x c] on the last joints of links */
    double *none, *more; /* [links x y] */
    double F[CHAIN_JOINT * CHAIN_JOINT]; /* of the row */
    double A[CHAIN_JOINT * CHAIN_JOINT], B[CHAIN_JOINT * CHAIN_JOINT];
};

typedef struct kept_link {
    double *A, *turned, *own, *B, *F, *Z; /* own: F of the link; turned: A^T; Z: Z^T */
} kept_link;

static inline kept_link chain_kept(const chain *s, int link)
{
    kept_link k;
    k.A = s->kept + (size_t)link * (size_t)s->size;
    k.turned = k.A + s->y * s->c;
    k.own = k.turned + s->y * s->c;
    k.B = k.own + s->y * s->y;
    k.F = k.B + s->c * s->c;
    k.Z = k.F + s->c * s->c;
    return k;
}

#endif
