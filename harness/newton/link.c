#include "harness/newton/link.h"

#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "harness/newton/symmetric.h"

enum { WIDE = ELEMENT_MAX_COORDINATES };

/* Where coordinate i of the link is among those of the element; the first joint's come first. */
static int place(const link_element *el, int i)
{
    return NODE_COORDINATES * (i / el->joint) + i % el->joint;
}

/* The wanted columns of J: of the first node J_p[strains x joint], of the others J_y[strains x y];
 * H[wanted x wanted]. */
static void take(const link_element *el, double J_p[], double J_y[], double H[])
{
    const int c = el->joint, n = c * el->nodes, y = n - c, all = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < el->strains; k++)
        for (int i = 0; i < n; i++) {
            double *to = i < c ? &J_p[k * c + i] : &J_y[k * y + i - c];
            *to = el->J[k * all + place(el, i)];
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            H[i * n + j] = el->H[place(el, i) * all + place(el, j)];
}

/* T[wanted x joint]: all nodes move as one body with the first one; warping stays behind. */
static void carry_along(const link_element *el, double T[])
{
    const int c = el->joint;
    memset(T, 0, (size_t)(c * el->nodes * c) * sizeof *T);
    for (int i = 0; i < c; i++)
        T[i * c + i] = 1;
    for (int k = 1; k < el->nodes; k++) {
        double *at = T + (size_t)(k * c * c);
        const double d[3] = {el->r[3 * k] - el->r[0], el->r[3 * k + 1] - el->r[1],
                             el->r[3 * k + 2] - el->r[2]};
        for (int i = 0; i < 6; i++)
            at[i * c + i] = 1;
        at[0 * c + 4] = d[2]; /* theta x d */
        at[0 * c + 5] = -d[1];
        at[1 * c + 5] = d[0];
        at[1 * c + 3] = -d[2];
        at[2 * c + 3] = d[1];
        at[2 * c + 4] = -d[0];
    }
}

/* F = (J_y^T C J_y + H_yy)^-1 */
static status flexibility(const link_element *el, const double J_y[], const double H[],
                          chain_link *out, fault *f)
{
    const int c = el->joint, n = c * el->nodes, y = n - c;
    double K[CHAIN_LINK * CHAIN_LINK], work[ELEMENT_MAX_STRAINS * CHAIN_LINK];
    for (int i = 0; i < y; i++)
        memcpy(&K[i * y], &H[(c + i) * n + c], (size_t)y * sizeof *K);
    dense_add_congruence(el->strains, y, J_y, el->C, K, work);
    out->negative = symmetric_inverse(y, K, out->F);
    return out->negative >= 0 ? STATUS_OK
                              : fault_set(f, STATUS_SINGULAR, "an element is at a critical state");
}

status link_of(const link_element *el, chain_link *out, fault *f)
{
    const int c = el->joint, n = c * el->nodes, y = n - c, s = el->strains;
    double J_p[ELEMENT_MAX_STRAINS * CHAIN_JOINT], J_y[ELEMENT_MAX_STRAINS * CHAIN_LINK],
        H[WIDE * WIDE], T[WIDE * CHAIN_JOINT], E[ELEMENT_MAX_STRAINS * CHAIN_JOINT],
        CE[ELEMENT_MAX_STRAINS * CHAIN_JOINT], HT[WIDE * CHAIN_JOINT],
        work[WIDE * CHAIN_JOINT + ELEMENT_MAX_STRAINS * CHAIN_JOINT];
    take(el, J_p, J_y, H);
    carry_along(el, T);
    TRY(flexibility(el, J_y, H, out, f));
    /* E, and the forces that hold it there */
    dense_mul(s, y, c, J_y, T + c * c, E);
    for (int i = 0; i < s * c; i++)
        E[i] += J_p[i];
    dense_mul(s, s, c, el->C, E, CE);
    dense_mul(n, n, c, H, T, HT);
    dense_add_transpose_mul(y, s, c, J_y, CE, HT + c * c);
    /* A = R + d */
    dense_mul(y, y, c, out->F, HT + c * c, out->A);
    for (int i = 0; i < y * c; i++)
        out->A[i] = -out->A[i];
    dense_mul(s, y, c, J_y, out->A, CE);
    for (int i = 0; i < s * c; i++)
        E[i] += CE[i];
    for (int i = 0; i < y * c; i++)
        out->A[i] += T[c * c + i];
    memcpy(T + c * c, out->A, (size_t)(y * c) * sizeof *T);
    memset(out->B, 0, sizeof out->B);
    dense_add_congruence(s, c, E, el->C, out->B, work);
    dense_add_congruence(n, c, T, H, out->B, work);
    return STATUS_OK;
}
