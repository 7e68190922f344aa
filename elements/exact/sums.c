#include "elements/exact/sums.h"

#include <string.h>

#include "elements/math/dense.h"

/* x at node k is `factor` times the variables from `first` on: its own, or 2 X. */
static int variables(const exact_stages *s, int k, double *factor)
{
    const int end = k == 0 || k == s->stages;
    *factor = 1;
    if (end)
        *factor = k == 0 ? -0.5 : 0.5;
    return end ? s->unknowns + 3 : 3 * k;
}

static void add_point(int nodes, const double N[], const double dN[],
                      const double gradient[EXACT_STAGE_SPACE],
                      double H[EXACT_STAGE_SPACE][EXACT_STAGE_SPACE], exact_sums *a)
{
    for (int l = 0; l < nodes; l++) {
        double value[9], slope[9];
        for (int i = 0; i < 3; i++) {
            a->g[l][i] += N[l] * gradient[EXACT_STAGE_MILENKOVIC + i] +
                          dN[l] * gradient[EXACT_STAGE_SLOPE + i];
            for (int j = 0; j < 3; j++) {
                value[3 * i + j] =
                    H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_MILENKOVIC + j] * N[l] +
                    H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_SLOPE + j] * dN[l];
                slope[3 * i + j] = H[EXACT_STAGE_SLOPE + i][EXACT_STAGE_MILENKOVIC + j] * N[l] +
                                   H[EXACT_STAGE_SLOPE + i][EXACT_STAGE_SLOPE + j] * dN[l];
                a->Y[l][3 * i + j] += N[l] * H[EXACT_STAGE_MILENKOVIC + i][EXACT_STAGE_FORCE + j] +
                                      dN[l] * H[EXACT_STAGE_SLOPE + i][EXACT_STAGE_FORCE + j];
            }
        }
        for (int k = 0; k <= l; k++)
            for (int i = 0; i < 9; i++)
                a->X[k][l][i] += N[k] * value[i] + dN[k] * slope[i];
    }
    for (int i = 0; i < 3; i++) {
        a->gF[i] += gradient[EXACT_STAGE_FORCE + i];
        for (int j = 0; j < 3; j++)
            a->FF[3 * i + j] += H[EXACT_STAGE_FORCE + i][EXACT_STAGE_FORCE + j];
    }
}

/* Row of the warping energy's argument at point i: kappa_x less the warping shear that Q_y and Q_z
 * make. */
static void warping_row(const exact_stages *s, int i, double D[6][EXACT_STAGE_SPACE], exact_sums *a)
{
    double row[EXACT_STAGE_SPACE], *dz = &a->dz[i * (s->unknowns + EXACT_STAGES_OUTER)];
    for (int j = 0; j < EXACT_STAGE_SPACE; j++)
        row[j] = D[0][j] - s->c.F[6] * D[4][j] - s->c.F[7] * D[5][j];
    for (int k = 0; k <= s->stages; k++) {
        double factor;
        const int first = variables(s, k, &factor);
        for (int j = 0; j < 3; j++)
            dz[first + j] += factor * (s->N[i][k] * row[EXACT_STAGE_MILENKOVIC + j] +
                                       s->dN[i][k] * row[EXACT_STAGE_SLOPE + j]);
    }
    for (int j = 0; j < 3; j++)
        dz[j] += row[EXACT_STAGE_FORCE + j];
}

void exact_sums_add(const exact_stages *s, int i, const exact_stage *p, const double force[3],
                    const double gradient[6], const double M[36], exact_sums *a)
{
    double D[6][EXACT_STAGE_SPACE], H[EXACT_STAGE_SPACE][EXACT_STAGE_SPACE],
        slope[EXACT_STAGE_SPACE] = {0};
    exact_stage_rows(p, force, D);
    exact_stage_hessian(p, force, gradient, M, s->w[i], D, H);
    for (int j = 0; j < EXACT_STAGE_SPACE; j++)
        for (int k = 0; k < 6; k++)
            slope[j] += s->w[i] * gradient[k] * D[k][j];
    add_point(s->stages + 1, s->N[i], s->dN[i], slope, H, a);
    if (s->warps)
        warping_row(s, i, D, a);
}

void exact_sums_warping(const exact_stages *s, const double e[], const exact_stage p[],
                        exact_sums *a, double Sz[])
{
    const int m = s->stages, n = s->unknowns + EXACT_STAGES_OUTER;
    for (int i = 0; i < m; i++)
        a->z[i] = p[i].kappa[0] - s->c.F[6] * p[i].N[1] - s->c.F[7] * p[i].N[2];
    a->z[m] = e[6];
    a->z[m + 1] = e[7];
    a->dz[m * n + s->unknowns + 6] = a->dz[(m + 1) * n + s->unknowns + 7] = 1;
    dense_mul_vec(m + 2, m + 2, s->S, a->z, Sz);
}

void exact_sums_gather(const exact_stages *s, const exact_sums *a, double gradient[],
                       double hessian[])
{
    const int n = s->unknowns + EXACT_STAGES_OUTER;
    double *K = hessian, row_factor, column_factor;
    for (int k = 0; k <= s->stages; k++) {
        const int row = variables(s, k, &row_factor);
        for (int i = 0; i < 3; i++) {
            gradient[row + i] += row_factor * a->g[k][i];
            for (int j = 0; j < 3; j++) {
                K[(row + i) * n + j] += row_factor * a->Y[k][3 * i + j];
                K[j * n + row + i] += row_factor * a->Y[k][3 * i + j];
            }
        }
        for (int l = k; l <= s->stages; l++) {
            const int column = variables(s, l, &column_factor);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++) {
                    const double value = row_factor * column_factor * a->X[k][l][3 * i + j];
                    K[(row + i) * n + column + j] += value;
                    if (k != l)
                        K[(column + j) * n + row + i] += value;
                }
        }
    }
    for (int i = 0; i < 3; i++) {
        gradient[i] += a->gF[i];
        for (int j = 0; j < 3; j++)
            K[i * n + j] += a->FF[3 * i + j];
    }
    if (s->warps) {
        double work[EXACT_WARPING_MAX * EXACT_STAGES_ALL];
        dense_add_congruence(s->stages + 2, n, a->dz, s->S, K, work);
    }
}

void exact_sums_change(const exact_stages *s, int i, const double change[], double x[3],
                       double slope[3])
{
    memset(x, 0, 3 * sizeof *x);
    memset(slope, 0, 3 * sizeof *slope);
    for (int k = 0; k <= s->stages; k++) {
        double factor;
        const int first = variables(s, k, &factor);
        for (int j = 0; j < 3; j++) {
            x[j] += s->N[i][k] * factor * change[first + j];
            slope[j] += s->dN[i][k] * factor * change[first + j];
        }
    }
}
