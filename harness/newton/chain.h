/* Links in a row, condensed to what their two ends do, and back.
 *
 * A link joins joint p to joint q; y are the coordinates of q, and before them those inside. With
 * forces g that act on it it is
 *   y = A x_p + F g_y,   g_p = B x_p - A^T g_y:
 * A carries it along as if rigid, F is its flexibility with p clamped, B what carrying it along
 * costs (prestress, warping). Joined links are a link again (the star product of R. Redheffer, J.
 * Math. Phys. 41, 1962): with F of the row before joint m and B, A of the next link
 *   x_m = Z (a_m + F (r_m + A^T g_y)),   Z = (1 + F B)^-1,   F <- F_qq + A_q Z F A_q^T.
 * Flexibilities add without cancellation, so that rounding grows about as the number of links and
 * not as its fourth power, as it does where stiffnesses are assembled. */
#ifndef BEAMWORK_CHAIN_H
#define BEAMWORK_CHAIN_H

#include "elements/shared/status.h"

enum { CHAIN_JOINT = 7, CHAIN_LINK = 2 * CHAIN_JOINT };

/* What goes into a chain. */
typedef struct chain_link {
    double A[CHAIN_LINK * CHAIN_JOINT];  /* [y x joint] */
    double F[CHAIN_LINK * CHAIN_LINK];   /* [y x y] symmetric */
    double B[CHAIN_JOINT * CHAIN_JOINT]; /* symmetric */
    int negative;                        /* eigenvalues of F */
} chain_link;

typedef struct chain chain;

/* joint: coordinates of each joint; y: those of a link but for its first joint. */
status chain_alloc(int links, int joint, int y, chain **out, fault *);
void chain_free(chain *);

void chain_begin(chain *);
/* The next link. SINGULAR: the row up to here, clamped at its begin, is at a critical state. */
status chain_add(chain *, const chain_link *, fault *);
/* K[2 joint x 2 joint] of the ends when all links are there. SINGULAR: the chain, clamped at both
 * ends, is at a critical state. */
status chain_stiffness(const chain *, double K[], fault *);
/* Negative eigenvalues of what is inside, both ends clamped. */
int chain_negative(const chain *);

/* Loads r[links x y] on all coordinates but those of the ends (the last joint is not read), in the
 * order of the links; ends[2 joint]: forces by which they act on the ends. */
void chain_reduce(chain *, const double r[], double ends[]);
/* x[links x y] of these loads and of motions of the ends[2 joint]; the last joint is an end. x may
 * be r. */
void chain_expand(chain *, const double r[], const double ends[], double x[]);

#endif
