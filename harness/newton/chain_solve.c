/* Loads to the ends of a chain, and motions of the ends to all that is inside.
 *
 * Two sweeps find the forces between the links: with w the forces on the joint before a link and by
 * the link on it,
 *   x = Z a + Z F w,   w - B x = Z^T w - B Z a.
 * Motions follow from these link by link, for between neighbours they must differ by no more than
 * what deforms a link: differences of motions found one by one would cost as many digits as an
 * assembled stiffness. Sizes that are known where a sweep is inlined leave no loops inside it. */
#include <string.h>

#include "elements/math/dense.h"
#include "harness/newton/chain_impl.h"
#include "harness/newton/symmetric.h"

#define INLINED static inline __attribute__((always_inline))

/* out[m] = M x */
INLINED void mul(int m, int n, const double M[], const double x[], double out[])
{
    for (int i = 0; i < m; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += M[i * n + j] * x[j];
        out[i] = sum;
    }
}

/* out[n] = M^T x, M[m x n] */
INLINED void mul_transposed(int m, int n, const double M[], const double x[], double out[])
{
    for (int j = 0; j < n; j++)
        out[j] = 0;
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            out[j] += M[i * n + j] * x[i];
}

/* out[n] = S x, S packed */
INLINED void mul_packed(int n, const double S[], const double x[], double out[])
{
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += S[i > j ? chain_packed(i) + j : chain_packed(j) + i] * x[j];
        out[i] = sum;
    }
}

/* The load on the joint before a link, as it adds to the forces w there; none on an end. */
INLINED void add_load_before(int c, int y, const double r[], int link, double w[])
{
    if (link > 0)
        for (int i = 0; i < c; i++)
            w[i] += r[(size_t)link * (size_t)y - (size_t)(c - i)];
}

/* a of every joint from that of the first. */
INLINED void forward(chain *s, int c, int y, const double r[], const double first[])
{
    const int in = y - c;
    memcpy(s->a, first, (size_t)c * sizeof *s->a);
    for (int e = 0; e < s->links; e++) {
        const kept_link k = chain_kept(s, e, c, y);
        const double *g = r + (size_t)e * (size_t)y, *a = s->a + (size_t)e * (size_t)c;
        double w[CHAIN_JOINT], x[CHAIN_JOINT], more[CHAIN_JOINT], next[CHAIN_JOINT];
        mul_transposed(in, c, k.A, g, w);
        add_load_before(c, y, r, e, w);
        mul(c, c, k.Z, a, x);
        mul_packed(c, k.ZF, w, more);
        for (int i = 0; i < c; i++)
            x[i] += more[i];
        mul(c, c, k.A + in * c, x, next);
        for (int i = 0; i < c; i++)
            for (int j = 0; j < in; j++)
                next[i] += k.own[chain_packed(in + i) + j] * g[j];
        memcpy(s->a + (size_t)(e + 1) * (size_t)c, next, (size_t)c * sizeof *next);
    }
}

/* Forces between the links when g[joint] acts on the last joint, into s->a behind its first;
 * begin[joint]: what the first joint exerts on the row. r NULL: nothing else acts, nor do joints
 * move without forces. */
INLINED void backward(chain *s, int c, int y, const double r[], const double last[], double begin[])
{
    const int in = y - c;
    double g[CHAIN_LINK] = {0};
    memcpy(g + in, last, (size_t)c * sizeof *g);
    for (int e = s->links; e-- > 0;) {
        const kept_link k = chain_kept(s, e, c, y);
        double *a = s->a + (size_t)e * (size_t)c, w[CHAIN_JOINT], held[CHAIN_JOINT];
        memcpy(a + c, g + in, (size_t)c * sizeof *a);
        if (r != NULL)
            memcpy(g, r + (size_t)e * (size_t)y, (size_t)in * sizeof *g);
        mul_transposed(y, c, k.A, g, w);
        if (r != NULL)
            add_load_before(c, y, r, e, w);
        mul_transposed(c, c, k.Z, w, g + in);
        if (r == NULL)
            continue;
        mul_packed(c, k.BZ, a, held);
        for (int i = 0; i < c; i++)
            g[in + i] -= held[i];
    }
    for (int i = 0; i < c; i++)
        begin[i] = -g[in + i];
}

/* Motions from that of the first joint and the forces: links deform as these say, to the last
 * digit. Into x[links x y], or where r is NULL on top of them; r may be x. */
INLINED void deform(const chain *s, int c, int y, const double r[], const double first[],
                    double x[])
{
    const int in = y - c;
    double p[CHAIN_JOINT];
    memcpy(p, first, (size_t)c * sizeof *p);
    for (int e = 0; e < s->links; e++) {
        const kept_link k = chain_kept(s, e, c, y);
        double g[CHAIN_LINK] = {0}, here[CHAIN_LINK], more[CHAIN_LINK],
               *to = x + (size_t)e * (size_t)y;
        if (r != NULL)
            memcpy(g, r + (size_t)e * (size_t)y, (size_t)in * sizeof *g);
        memcpy(g + in, s->a + (size_t)(e + 1) * (size_t)c, (size_t)c * sizeof *g);
        mul(y, c, k.A, p, here);
        mul_packed(y, k.own, g, more);
        for (int i = 0; i < y; i++) {
            here[i] += more[i];
            to[i] = r != NULL ? here[i] : to[i] + here[i];
        }
        memcpy(p, here + in, (size_t)c * sizeof *p);
    }
}

/* Forces on the last joint that take it to x, from where no force leaves it. */
static void force_to(const chain *s, const double x[], const double from[], double g[])
{
    double stiffness[CHAIN_JOINT * CHAIN_JOINT], moved[CHAIN_JOINT];
    symmetric_inverse(s->c, s->F, stiffness);
    for (int i = 0; i < s->c; i++)
        moved[i] = x[i] - from[i];
    dense_mul_vec(s->c, s->c, stiffness, moved, g);
}

static const double still[CHAIN_JOINT] = {0};

/* Where the last joint is without forces behind it. */
static const double *last_of(const chain *s)
{
    return s->a + (size_t)s->links * (size_t)s->c;
}

INLINED void reduce(chain *s, int c, int y, const double r[], double ends[])
{
    double last[CHAIN_JOINT], begin[CHAIN_JOINT];
    forward(s, c, y, r, still);
    force_to(s, still, last_of(s), last);
    backward(s, c, y, r, last, begin);
    for (int i = 0; i < c; i++) {
        ends[i] = -begin[i];
        ends[c + i] = -last[i];
    }
}

/* What rounding leaves between the last joint and its end goes to all links. */
INLINED void close_gap(chain *s, int c, int y, const double end[], double x[])
{
    double gap[CHAIN_JOINT], last[CHAIN_JOINT], begin[CHAIN_JOINT];
    for (int i = 0; i < c; i++)
        gap[i] = end[i] - x[(size_t)s->links * (size_t)y - (size_t)(c - i)];
    force_to(s, gap, still, last);
    backward(s, c, y, NULL, last, begin);
    deform(s, c, y, NULL, still, x);
}

INLINED void expand(chain *s, int c, int y, const double r[], const double ends[], double x[])
{
    double last[CHAIN_JOINT], begin[CHAIN_JOINT];
    forward(s, c, y, r, ends);
    force_to(s, ends + c, last_of(s), last);
    backward(s, c, y, r, last, begin);
    deform(s, c, y, r, ends, x);
    close_gap(s, c, y, ends + c, x);
}

/* Elements of two nodes, with and without warping. */
void chain_reduce(chain *s, const double r[], double ends[])
{
    if (s->c == 7 && s->y == 7)
        reduce(s, 7, 7, r, ends);
    else if (s->c == 6 && s->y == 6)
        reduce(s, 6, 6, r, ends);
    else
        reduce(s, s->c, s->y, r, ends);
}

void chain_expand(chain *s, const double r[], const double ends[], double x[])
{
    if (s->c == 7 && s->y == 7)
        expand(s, 7, 7, r, ends, x);
    else if (s->c == 6 && s->y == 6)
        expand(s, 6, 6, r, ends, x);
    else
        expand(s, s->c, s->y, r, ends, x);
}
