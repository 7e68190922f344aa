/* Loads to the ends of a chain, and motions of the ends to all that is inside.
 *
 * Two sweeps find the forces between the links. Motions follow from these link by link, for between
 * neighbours they must differ by no more than what deforms a link: differences of motions found one
 * by one would cost as many digits as an assembled stiffness. */
#include <string.h>

#include "elements/math/dense.h"
#include "harness/condensation/chain_impl.h"
#include "harness/condensation/symmetric.h"

/* out[n] += M^T x, M[m x n] */
static void add_transposed(int m, int n, const double M[], const double x[], double out[])
{
    dense_add_transpose_mul(n, m, 1, M, x, out);
}

/* Motion of the joint before a link, which g acts on by the link: x = Z (a + F (r + v)); r NULL:
 * the joint is an end. */
static void joint_motion(const chain *s, const kept_link *k, const double a[], const double r[],
                         const double v[], double x[])
{
    double g[CHAIN_JOINT] = {0}, t[CHAIN_JOINT] = {0};
    for (int i = 0; i < s->c; i++) {
        g[i] = v[i] + (r != NULL ? r[i] : 0);
        t[i] = a[i];
        x[i] = 0;
    }
    add_transposed(s->c, s->c, k->F, g, t);
    add_transposed(s->c, s->c, k->Z, t, x);
}

/* The load on the joint before a link; NULL: none, it is an end. */
static const double *load_before(const chain *s, const double r[], int link)
{
    return link == 0 ? NULL : r + (size_t)(link - 1) * (size_t)s->y + s->inside;
}

/* a of every joint from that of the first. */
static void forward(chain *s, const double r[], const double first[])
{
    const int c = s->c, in = s->inside, y = s->y;
    memcpy(s->a, first, (size_t)c * sizeof *s->a);
    for (int e = 0; e < s->links; e++) {
        const kept_link k = chain_kept(s, e);
        const double *g = r + (size_t)e * (size_t)s->y;
        double v[CHAIN_JOINT] = {0}, x[CHAIN_JOINT], *next = s->a + (size_t)(e + 1) * (size_t)c;
        add_transposed(in, c, k.A, g, v);
        joint_motion(s, &k, s->a + (size_t)e * (size_t)c, load_before(s, r, e), v, x);
        double motion[CHAIN_LINK] = {0};
        add_transposed(c, y, k.turned, x, motion);
        memcpy(next, motion + in, (size_t)c * sizeof *next);
        for (int i = 0; i < in; i++)
            for (int j = 0; j < c; j++)
                next[j] += k.own[i * y + in + j] * g[i];
    }
}

/* Forces between the links when g[joint] acts on the last joint; begin[joint]: what the first one
 * exerts on the row. */
static void backward(chain *s, const double r[], const double last[], double begin[])
{
    const int c = s->c, in = s->inside, y = s->y;
    double g[CHAIN_LINK];
    memcpy(g + in, last, (size_t)c * sizeof *g);
    for (int e = s->links; e-- > 0;) {
        const kept_link k = chain_kept(s, e);
        const double *before = load_before(s, r, e);
        double v[CHAIN_JOINT] = {0}, p[CHAIN_JOINT], held[CHAIN_JOINT] = {0};
        memcpy(s->g + (size_t)e * (size_t)c, g + in, (size_t)c * sizeof *g);
        memcpy(g, r + (size_t)e * (size_t)y, (size_t)in * sizeof *g);
        add_transposed(y, c, k.A, g, v);
        joint_motion(s, &k, s->a + (size_t)e * (size_t)c, before, v, p);
        add_transposed(c, c, k.B, p, held);
        for (int i = 0; i < c; i++)
            g[in + i] = v[i] + (before != NULL ? before[i] : 0) - held[i];
    }
    for (int i = 0; i < c; i++)
        begin[i] = -g[in + i];
}

/* Motions x[links x y] from that of the first joint and the forces: links deform as these say, to
 * the last digit. */
static void deform(const chain *s, const double r[], const double first[], double x[])
{
    const int c = s->c, in = s->inside, y = s->y;
    const double *p = first;
    for (int e = 0; e < s->links; e++) {
        const kept_link k = chain_kept(s, e);
        double g[CHAIN_LINK], *here = x + (size_t)e * (size_t)y;
        memcpy(g, r + (size_t)e * (size_t)y, (size_t)in * sizeof *g);
        memcpy(g + in, s->g + (size_t)e * (size_t)c, (size_t)c * sizeof *g);
        memset(here, 0, (size_t)y * sizeof *here);
        add_transposed(c, y, k.turned, p, here);
        add_transposed(y, y, k.own, g, here);
        p = here + in;
    }
}

/* Forces on the last joint that take it to x. */
static void force_to(const chain *s, const double x[], double g[])
{
    double stiffness[CHAIN_JOINT * CHAIN_JOINT], moved[CHAIN_JOINT];
    symmetric_inverse(s->c, s->F, stiffness);
    for (int i = 0; i < s->c; i++)
        moved[i] = x[i] - s->a[(size_t)s->links * (size_t)s->c + (size_t)i];
    dense_mul_vec(s->c, s->c, stiffness, moved, g);
}

void chain_reduce(chain *s, const double r[], double ends[])
{
    const double clamped[CHAIN_JOINT] = {0};
    double last[CHAIN_JOINT], begin[CHAIN_JOINT];
    forward(s, r, clamped);
    force_to(s, clamped, last);
    backward(s, r, last, begin);
    for (int i = 0; i < s->c; i++) {
        ends[i] = -begin[i];
        ends[s->c + i] = -last[i];
    }
}

/* What rounding leaves between the last joint and its end goes to all links. */
static void close_gap(chain *s, const double end[], double x[])
{
    const int c = s->c;
    const size_t all = (size_t)s->links * (size_t)s->y;
    const double still[CHAIN_JOINT] = {0};
    double gap[CHAIN_JOINT], last[CHAIN_JOINT], begin[CHAIN_JOINT];
    for (int i = 0; i < c; i++)
        gap[i] = end[i] - x[all - (size_t)c + (size_t)i];
    memset(s->none, 0, all * sizeof *s->none);
    memset(s->a, 0, ((size_t)s->links + 1) * (size_t)c * sizeof *s->a);
    force_to(s, gap, last);
    backward(s, s->none, last, begin);
    deform(s, s->none, still, s->more);
    for (size_t i = 0; i < all; i++)
        x[i] += s->more[i];
}

void chain_expand(chain *s, const double r[], const double ends[], double x[])
{
    double last[CHAIN_JOINT], begin[CHAIN_JOINT];
    forward(s, r, ends);
    force_to(s, ends + s->c, last);
    backward(s, r, last, begin);
    deform(s, r, ends, x);
    close_gap(s, ends + s->c, x);
}
