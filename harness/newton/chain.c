#include "harness/newton/newton_impl.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

/* Returns the number of negative eigenvalues of A[n x n], which is overwritten; -1: A is singular
 * (a pivot is a rounding error). The result does not depend on the units of the rows. */
static int symmetric_negative(int n, double A[]);

status chain_alloc(int links, int joint, int y, chain **out, fault *f)
{
    chain *s = *out = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_memory(f, "a member");
    s->links = links;
    s->c = joint;
    s->y = y;
    s->inside = y - joint;
    s->kept = malloc((size_t)links * (size_t)chain_kept_size(joint, y) * sizeof *s->kept);
    s->a = malloc(((size_t)links + 1) * (size_t)joint * sizeof *s->a);
    return s->kept != NULL && s->a != NULL ? STATUS_OK
                                           : fault_memory(f, "a member of %d elements", links);
}

void chain_free(chain *s)
{
    if (s == NULL)
        return;
    free(s->kept);
    free(s->a);
    free(s);
}

void chain_begin(chain *s)
{
    s->count = s->negative = 0;
    memset(s->F, 0, sizeof s->F);
    memset(s->B, 0, sizeof s->B);
    memset(s->A, 0, sizeof s->A);
    for (int i = 0; i < s->c; i++)
        s->A[i * s->c + i] = 1;
}

/* Returns 1 if a bound shows that all eigenvalues of 1 + F B are positive. If F is positive
 * definite, the eigenvalues of F B are real and bounded by the row sums of F B, scaled with the
 * diagonal of F. */
static int small_product(int n, const double F[], const double W[])
{
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += fabs(W[i * n + j] - (i == j)) * sqrt(fabs(F[j * n + j] / F[i * n + i]));
        if (!(sum < 0.9))
            return 0;
    }
    return 1;
}

/* Returns the increase of the number of negative eigenvalues of F^-1 when the stiffness B is added.
 * F^-1 is the stiffness of the end of the chain. */
static int more_negative(int n, const double F[], const double B[], const double W[])
{
    double stiffness[CHAIN_JOINT * CHAIN_JOINT];
    if (small_product(n, F, W))
        return 0;
    const int before = symmetric_inverse(n, F, stiffness);
    for (int i = 0; i < n * n; i++)
        stiffness[i] += B[i];
    return symmetric_negative(n, stiffness) - before;
}

static status carry(chain *s, const double B[], double Z[], fault *f)
{
    const int c = s->c;
    double W[CHAIN_JOINT * CHAIN_JOINT];
    int pivot[CHAIN_JOINT];
    dense_mul(c, c, c, s->F, B, W);
    memset(Z, 0, (size_t)(c * c) * sizeof *Z);
    for (int i = 0; i < c; i++) {
        W[i * c + i] += 1;
        Z[i * c + i] = 1;
    }
    if (s->count > 0)
        s->negative += more_negative(c, s->F, B, W);
    if (dense_lu(c, W, pivot) != 0)
        return fault_set(f, STATUS_SINGULAR,
                         "the stiffness matrix of a part of a member with one end fixed is "
                         "singular; use smaller steps, or correct the section");
    dense_lu_solve(c, c, W, pivot, Z);
    return STATUS_OK;
}

static void congruence(int m, int n, const double A[], const double M[], double out[])
{
    double work[CHAIN_JOINT * CHAIN_JOINT];
    memset(out, 0, (size_t)(n * n) * sizeof *out);
    dense_add_congruence(m, n, A, M, out, work);
}

static void transpose(int m, int n, const double A[], double out[])
{
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            out[j * m + i] = A[i * n + j];
}

static void pack(int n, const double A[], double packed[])
{
    for (int i = 0; i < n; i++, packed += i)
        memcpy(packed, &A[i * n], (size_t)(i + 1) * sizeof *packed);
}

static void symmetrise(int n, double A[])
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            A[i * n + j] = A[j * n + i] = (A[i * n + j] + A[j * n + i]) / 2;
}

status chain_add(chain *s, const chain_link *link, fault *f)
{
    const int c = s->c, y = s->y, in = s->inside;
    const double *A_q = link->A + in * c;
    double Z[CHAIN_JOINT * CHAIN_JOINT], BZ[CHAIN_JOINT * CHAIN_JOINT],
        ZF[CHAIN_JOINT * CHAIN_JOINT], turned[CHAIN_JOINT * CHAIN_JOINT],
        more[CHAIN_JOINT * CHAIN_JOINT];
    const kept_link k = chain_kept(s, s->count, c, y);
    memcpy(k.A, link->A, (size_t)(y * c) * sizeof *k.A);
    pack(y, link->F, k.own);
    TRY(carry(s, link->B, Z, f));
    memcpy(k.Z, Z, (size_t)(c * c) * sizeof *k.Z);
    dense_mul(c, c, c, link->B, Z, BZ);
    symmetrise(c, BZ);
    pack(c, BZ, k.BZ);
    congruence(c, c, s->A, BZ, more);
    for (int i = 0; i < c * c; i++)
        s->B[i] += more[i];
    dense_mul(c, c, c, Z, s->A, more);
    dense_mul(c, c, c, A_q, more, s->A);
    dense_mul(c, c, c, Z, s->F, ZF);
    symmetrise(c, ZF);
    pack(c, ZF, k.ZF);
    transpose(c, c, A_q, turned);
    congruence(c, c, turned, ZF, s->F);
    for (int i = 0; i < c; i++)
        for (int j = 0; j < c; j++)
            s->F[i * c + j] += link->F[(in + i) * y + in + j];
    s->negative += link->negative;
    s->count++;
    return STATUS_OK;
}

int chain_negative(const chain *s)
{
    double stiffness[CHAIN_JOINT * CHAIN_JOINT];
    return s->negative - symmetric_inverse(s->c, s->F, stiffness);
}

status chain_stiffness(const chain *s, double K[], fault *f)
{
    const int c = s->c, n = 2 * c;
    double stiffness[CHAIN_JOINT * CHAIN_JOINT], KA[CHAIN_JOINT * CHAIN_JOINT],
        whole[CHAIN_JOINT * CHAIN_JOINT];
    if (symmetric_inverse(c, s->F, stiffness) < 0)
        return fault_set(f, STATUS_SINGULAR,
                         "the flexibility matrix of a member with one end fixed is singular; use "
                         "smaller steps, or correct the section");
    dense_mul(c, c, c, stiffness, s->A, KA);
    congruence(c, c, s->A, stiffness, whole);
    for (int i = 0; i < c; i++)
        for (int j = 0; j < c; j++) {
            K[i * n + j] = whole[i * c + j] + s->B[i * c + j];
            K[(c + i) * n + j] = K[j * n + c + i] = -KA[i * c + j];
            K[(c + i) * n + c + j] = stiffness[i * c + j];
        }
    return STATUS_OK;
}

/* Transfers loads to the ends of a chain, and motions of the ends to its interior. Two sweeps
 * compute the forces between the links. If w is the force on the joint before a link, including the
 * force of the link, then x = Z a + Z F w and w - B x = Z^T w - B Z a. */

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

INLINED void mul_transposed(int m, int n, const double M[], const double x[], double out[])
{
    for (int j = 0; j < n; j++)
        out[j] = 0;
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            out[j] += M[i * n + j] * x[i];
}

INLINED void mul_packed(int n, const double S[], const double x[], double out[])
{
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            sum += S[i > j ? chain_packed(i) + j : chain_packed(j) + i] * x[j];
        out[i] = sum;
    }
}

INLINED void add_load_before(int c, int y, const double r[], int link, double w[])
{
    if (link > 0)
        for (int i = 0; i < c; i++)
            w[i] += r[(size_t)link * (size_t)y - (size_t)(c - i)];
}

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

/* Computes the forces between the links, and stores them in s->a from its second entry on.
 * last[joint]: force on the last joint. begin[joint]: force of the first joint on the chain. r
 * NULL: there are no other loads, and joints do not move without forces. */
INLINED void backward(chain *s, int c, int y, const double r[], const double last[], double begin[])
{
    const int in = y - c;
    double g[CHAIN_LINK];
    memset(g, 0, (size_t)in * sizeof *g);
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

/* Computes the motions from the motion of the first joint and the forces, without cancellation in
 * the deformations of links. Writes x[links x y], which may be r. r NULL: adds to x. */
INLINED void deform(const chain *s, int c, int y, const double r[], const double first[],
                    double x[])
{
    const int in = y - c;
    double p[CHAIN_JOINT];
    memcpy(p, first, (size_t)c * sizeof *p);
    for (int e = 0; e < s->links; e++) {
        const kept_link k = chain_kept(s, e, c, y);
        double g[CHAIN_LINK], here[CHAIN_LINK], more[CHAIN_LINK], *to = x + (size_t)e * (size_t)y;
        if (r != NULL)
            memcpy(g, r + (size_t)e * (size_t)y, (size_t)in * sizeof *g);
        else
            memset(g, 0, (size_t)in * sizeof *g);
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

/* Computes the forces g on the last joint that change its displacement from `from` (without forces)
 * to x. */
static void force_to(const chain *s, const double x[], const double from[], double g[])
{
    double stiffness[CHAIN_JOINT * CHAIN_JOINT], moved[CHAIN_JOINT];
    symmetric_inverse(s->c, s->F, stiffness);
    for (int i = 0; i < s->c; i++)
        moved[i] = x[i] - from[i];
    dense_mul_vec(s->c, s->c, stiffness, moved, g);
}

static const double still[CHAIN_JOINT] = {0};

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

static int symmetric_negative(int n, double A[])
{
    const double digits = 16 * DBL_EPSILON;
    double terms[SYMMETRIC_MOST];
    int negative = 0;
    for (int k = 0; k < n; k++)
        terms[k] = fabs(A[k * n + k]);
    for (int k = 0; k < n; k++) {
        const double d = A[k * n + k];
        if (!(fabs(d) > digits * terms[k]) || !isfinite(d))
            return -1;
        negative += d < 0;
        for (int i = k + 1; i < n; i++) {
            const double l = A[i * n + k] / d;
            for (int j = k + 1; j <= i; j++)
                A[i * n + j] -= l * A[j * n + k];
        }
        for (int i = k + 1; i < n; i++)
            A[i * n + k] /= d;
    }
    return negative;
}

int symmetric_inverse(int n, const double A[], double inverse[])
{
    double L[SYMMETRIC_MOST * SYMMETRIC_MOST];
    memcpy(L, A, (size_t)(n * n) * sizeof *L);
    const int negative = symmetric_negative(n, L);
    if (negative < 0)
        return negative;
    for (int c = 0; c < n; c++) {
        double x[SYMMETRIC_MOST];
        x[c] = 1;
        for (int i = c + 1; i < n; i++) {
            x[i] = 0;
            for (int j = c; j < i; j++)
                x[i] -= L[i * n + j] * x[j];
        }
        for (int i = c; i < n; i++)
            x[i] /= L[i * n + i];
        for (int i = n; i-- > c;) {
            for (int j = i + 1; j < n; j++)
                x[i] -= L[j * n + i] * x[j];
            inverse[i * n + c] = inverse[c * n + i] = x[i];
        }
    }
    return negative;
}
