#include "harness/newton/chain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/newton/chain_impl.h"
#include "harness/newton/symmetric.h"

status chain_alloc(int links, int joint, int y, chain **out, fault *f)
{
    chain *s = *out = calloc(1, sizeof *s);
    if (s == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a member");
    s->links = links;
    s->c = joint;
    s->y = y;
    s->inside = y - joint;
    s->kept = malloc((size_t)links * (size_t)chain_kept_size(joint, y) * sizeof *s->kept);
    s->a = malloc(((size_t)links + 1) * (size_t)joint * sizeof *s->a);
    return s->kept != NULL && s->a != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for a member of %d elements", links);
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

/* Can 1 + F B have no eigenvalue below zero? Where F is positive those of F B are real, and none is
 * larger than the rows of it in units of F's diagonal. */
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

/* Eigenvalues that become negative when the stiffness B is added behind the row. */
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

/* Z = (1 + F B)^-1 */
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
        return fault_set(f, STATUS_SINGULAR, "a part of a member is at a critical state");
    dense_lu_solve(c, c, W, pivot, Z);
    return STATUS_OK;
}

/* out = A^T M A */
static void congruence(int m, int n, const double A[], const double M[], double out[])
{
    double work[CHAIN_JOINT * CHAIN_JOINT];
    memset(out, 0, (size_t)(n * n) * sizeof *out);
    dense_add_congruence(m, n, A, M, out, work);
}

/* out[n x m] = A[m x n]^T */
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
    /* B and A of the row */
    dense_mul(c, c, c, link->B, Z, BZ);
    symmetrise(c, BZ);
    pack(c, BZ, k.BZ);
    congruence(c, c, s->A, BZ, more);
    for (int i = 0; i < c * c; i++)
        s->B[i] += more[i];
    dense_mul(c, c, c, Z, s->A, more);
    dense_mul(c, c, c, A_q, more, s->A);
    /* F of the row */
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
        return fault_set(f, STATUS_SINGULAR, "a member is at a critical state of its own");
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
