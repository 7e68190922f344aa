/* Symmetric matrices in blocks of 3 x 3, in lanes (real.h). Only blocks on and above the diagonal
 * are stored. The leading block K is eliminated by K = L D L^T without exchange of rows. The
 * elimination is accurate for any condition number if K is positive definite except for its last
 * block, which must be negative definite. exact_blocks_definite checks this condition. */
#ifndef BEAMWORK_COLLOCATION_SUMS_H
#define BEAMWORK_COLLOCATION_SUMS_H

#include "elements/collocation/collocation.h"
#include "elements/collocation/stage.h"
#include "elements/math/vec3.h"

enum { EXACT_BLOCKS_MAX = 12 };

/* Returns the position of block (i, j) for i <= j. */
static inline int exact_blocks_at(int i, int j)
{
    return j * (j + 1) / 2 + i;
}

/* Computes D of a diagonal block and overwrites the upper part of the block with L^T. */
static inline void exact_blocks_pivot(real a[9], real d[3], real inverse[3])
{
    d[0] = a[0];
    inverse[0] = 1 / d[0];
    const real l1 = a[1] * inverse[0], l2 = a[2] * inverse[0];
    d[1] = a[4] - l1 * a[1];
    inverse[1] = 1 / d[1];
    const real middle = a[5] - l1 * a[2], l12 = middle * inverse[1];
    d[2] = a[8] - l2 * a[2] - l12 * middle;
    inverse[2] = 1 / d[2];
    a[1] = l1;
    a[2] = l2;
    a[5] = l12;
}

/* Eliminates the first `rows` block rows of a matrix A [n (n + 1)/2][9] of n block rows. In the
 * result V, the eliminated rows contain L^T and D^-1 L^-1 A, and the other rows contain the Schur
 * complement. Block column `late` is zero above row rows - 1; `late` is n if there is no such
 * column. d [3 rows] is the diagonal of D. */
static inline __attribute__((always_inline)) void
exact_blocks_eliminate(int rows, int n, int late, real A[][9], real V[][9], real d[])
{
    real inverse[EXACT_BLOCKS_MAX][3], U[EXACT_BLOCKS_MAX][9];
    for (int j = 0; j < n; j++) {
        const int begin = j == late ? rows - 1 : 0;
        for (int i = begin; i <= j; i++) {
            const int from = i == late && begin == 0 ? rows - 1 : begin, at = exact_blocks_at(i, j);
            real sum[9];
            for (int c = 0; c < 9; c++)
                sum[c] = A[at][c];
            for (int k = from; k < (i < rows ? i : rows); k++)
                mat3_subtract_transpose_mul(V[exact_blocks_at(k, i)], U[k], sum);
            if (i == j && i < rows)
                exact_blocks_pivot(sum, &d[3 * i], inverse[i]);
            if (i < j && i < rows) {
                const real *L = V[exact_blocks_at(i, i)];
                for (int c = 0; c < 3; c++) {
                    U[i][c] = sum[c];
                    U[i][3 + c] = sum[3 + c] - L[1] * sum[c];
                    U[i][6 + c] = sum[6 + c] - L[2] * sum[c] - L[5] * U[i][3 + c];
                }
                for (int r = 0; r < 3; r++)
                    for (int c = 0; c < 3; c++)
                        sum[3 * r + c] = U[i][3 * r + c] * inverse[i][r];
            }
            for (int c = 0; c < 9; c++)
                V[at][c] = sum[c];
        }
    }
}

/* Computes X [rows][9] = K^-1 times block column j of A, for the eliminated rows. `late` has the
 * meaning given at exact_blocks_eliminate. */
static inline __attribute__((always_inline)) void exact_blocks_solve(int rows, int late, int j,
                                                                     real V[][9], real X[][9])
{
    for (int i = rows - 1; i >= 0; i--) {
        const real *L = V[exact_blocks_at(i, i)], *b = V[exact_blocks_at(i, j)];
        real *x = X[i];
        for (int c = 0; c < 9; c++)
            x[c] = j == late && i < rows - 1 ? real_of(0) : b[c];
        for (int k = i + 1; k < rows; k++) {
            const real *K = V[exact_blocks_at(i, k)];
            for (int r = 0; r < 3; r++)
                for (int c = 0; c < 3; c++)
                    x[3 * r + c] -= K[3 * r] * X[k][c] + K[3 * r + 1] * X[k][3 + c] +
                                    K[3 * r + 2] * X[k][6 + c];
        }
        for (int c = 0; c < 3; c++) {
            x[3 + c] -= L[5] * x[6 + c];
            x[c] -= L[1] * x[3 + c] + L[2] * x[6 + c];
        }
    }
}

/* Returns 1 if, in one lane, all pivots d except the last three are positive beyond round-off, and
 * the last three are negative. */
static inline int exact_blocks_definite(int rows, real A[][9], const real d[], int lane)
{
    const double lost = 1e-9;
    for (int i = 0; i < rows - 1; i++)
        for (int r = 0; r < 3; r++)
            if (!(real_lane(&d[3 * i + r], lane) >
                  lost * fabs(real_lane(&A[exact_blocks_at(i, i)][4 * r], lane))))
                return 0;
    for (int r = 3 * (rows - 1); r < 3 * rows; r++)
        if (!(real_lane(&d[r], lane) < 0))
            return 0;
    return 1;
}

/* Sums over the Gauss points of a collocation element: the Hessian of the energy, bordered by the
 * gradient, in blocks of 3 x 3 and in lanes (real.h).
 *
 * The order of the blocks is x of the inner nodes (stages - 1), F, the strains 2 X and v, and (a_p,
 * a_q, 1). The column of the constant 1 contains the gradient; its last entry is twice the
 * energy. */

/* Computes x and x' at all points. `at` contains x of the inner nodes, then 2 X. */
static inline void exact_sums_geometry(int stages, const exact_stages *s, real at[][3],
                                       const real force[3], exact_stage p[])
{
    for (int i = 0; i < stages; i++) {
        for (int j = 0; j < 3; j++) {
            real x = s->N[i][0] * at[0][j], slope = s->dN[i][0] * at[0][j];
            for (int k = 1; k < stages; k++) {
                x += s->N[i][k] * at[k][j];
                slope += s->dN[i][k] * at[k][j];
            }
            p[i].x[j] = x;
            p[i].slope[j] = slope;
        }
        exact_stage_of(force, s->rest_kappa[i], &p[i]);
    }
}

/* Computes Sz, the gradient of the warping energy with respect to the twist at the points and both
 * amplitudes a. Returns twice the warping energy. */
static inline real exact_sums_warping(int stages, const exact_stages *s, const exact_stage p[],
                                      const real a[2], real Sz[])
{
    const int m = stages + 2;
    real z[EXACT_WARPING_MAX], energy = real_of(0);
    for (int i = 0; i < stages; i++)
        z[i] = exact_stage_twist(&s->c, &p[i]);
    z[stages] = a[0];
    z[stages + 1] = a[1];
    for (int i = 0; i < m; i++) {
        Sz[i] = s->S[i * m] * z[0];
        for (int j = 1; j < m; j++)
            Sz[i] += s->S[i * m + j] * z[j];
        energy += Sz[i] * z[i];
    }
    return energy;
}

/* Adds the warping energy S, which couples the points. */
static inline void exact_sums_couple(int stages, const exact_stages *s, exact_stage_terms t[],
                                     real through[][EXACT_STAGES_MAX][3])
{
    real z[EXACT_STAGES_MAX][EXACT_STAGES_MAX][3];
    for (int i = 0; i < stages; i++)
        for (int l = 0; l < stages; l++)
            for (int j = 0; j < 3; j++)
                z[i][l][j] = s->N[i][l] * t[i].z[EXACT_STAGE_MILENKOVIC + j] +
                             s->dN[i][l] * t[i].z[EXACT_STAGE_SLOPE + j];
    for (int i = 0; i < stages; i++) {
        const double *S = &s->S[i * (stages + 2)];
        real force[3];
        real_zero(3, force);
        for (int h = 0; h < stages; h++)
            for (int j = 0; j < 3; j++)
                force[j] += S[h] * t[h].z[EXACT_STAGE_FORCE + j];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                t[i].xF[3 * j + k] += t[i].z[EXACT_STAGE_MILENKOVIC + j] * force[k];
                t[i].sF[3 * j + k] += t[i].z[EXACT_STAGE_SLOPE + j] * force[k];
                t[i].FF[3 * j + k] += t[i].z[EXACT_STAGE_FORCE + j] * force[k];
            }
        for (int l = 0; l < stages; l++)
            for (int j = 0; j < 3; j++) {
                through[i][l][j] = S[0] * z[0][l][j];
                for (int h = 1; h < stages; h++)
                    through[i][l][j] += S[h] * z[h][l][j];
            }
    }
}

static inline void exact_sums_column(int stages, const exact_stages *s, int l,
                                     const exact_stage_terms t[],
                                     real through[][EXACT_STAGES_MAX][3], real A[][9])
{
    real value[EXACT_STAGES_MAX][9], slope[EXACT_STAGES_MAX][9];
    for (int i = 0; i < stages; i++) {
        const double N = s->N[i][l], dN = s->dN[i][l];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                value[i][3 * j + k] = t[i].xx[3 * j + k] * N + t[i].xs[3 * j + k] * dN;
                slope[i][3 * j + k] = t[i].xs[3 * k + j] * N + t[i].ss[3 * j + k] * dN;
            }
        if (s->warps)
            for (int j = 0; j < 3; j++)
                for (int k = 0; k < 3; k++) {
                    value[i][3 * j + k] += t[i].z[EXACT_STAGE_MILENKOVIC + j] * through[i][l][k];
                    slope[i][3 * j + k] += t[i].z[EXACT_STAGE_SLOPE + j] * through[i][l][k];
                }
    }
    const int column = l < stages - 1 ? l : stages;
    for (int k = 0; k <= l; k++) {
        real *X = A[exact_blocks_at(k < stages - 1 ? k : stages, column)], sum[9];
        for (int j = 0; j < 9; j++)
            sum[j] = s->N[0][k] * value[0][j] + s->dN[0][k] * slope[0][j];
        for (int i = 1; i < stages; i++)
            for (int j = 0; j < 9; j++)
                sum[j] += s->N[i][k] * value[i][j] + s->dN[i][k] * slope[i][j];
        for (int j = 0; j < 9; j++)
            X[j] = sum[j];
    }
}

/* Fills the blocks that couple x or 2 X with F and with (a_p, a_q, 1). */
static inline void exact_sums_border(int stages, const exact_stages *s, int k,
                                     const exact_stage_terms t[], real A[][9])
{
    const int F = stages - 1, last = stages + 2, row = k < stages - 1 ? k : stages;
    real Y[9], edge[9], *E = A[exact_blocks_at(row, last)];
    real_zero(9, Y);
    real_zero(9, edge);
    for (int i = 0; i < stages; i++) {
        const double N = s->N[i][k], dN = s->dN[i][k], *S = &s->S[i * (stages + 2) + stages];
        for (int j = 0; j < 9; j++)
            Y[j] += N * t[i].xF[j] + dN * t[i].sF[j];
        for (int j = 0; j < 3; j++) {
            edge[3 * j + 2] += N * t[i].gradient[EXACT_STAGE_MILENKOVIC + j] +
                               dN * t[i].gradient[EXACT_STAGE_SLOPE + j];
            if (!s->warps)
                continue;
            const real z =
                N * t[i].z[EXACT_STAGE_MILENKOVIC + j] + dN * t[i].z[EXACT_STAGE_SLOPE + j];
            edge[3 * j] += S[0] * z;
            edge[3 * j + 1] += S[1] * z;
        }
    }
    for (int j = 0; j < 9; j++)
        E[j] = edge[j];
    if (row < F)
        for (int j = 0; j < 9; j++)
            A[exact_blocks_at(row, F)][j] = Y[j];
    else
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                A[exact_blocks_at(F, row)][3 * i + j] = Y[3 * j + i];
}

/* Fills the blocks that couple F with itself, with v (identity) and with (a_p, a_q, 1). */
static inline void exact_sums_force(int stages, const exact_stages *s, const exact_stage_terms t[],
                                    real A[][9])
{
    const int F = stages - 1, v = stages + 1, last = stages + 2;
    real *FF = A[exact_blocks_at(F, F)], *Fv = A[exact_blocks_at(F, v)],
         *FE = A[exact_blocks_at(F, last)];
    real_zero(9, FF);
    real_zero(9, Fv);
    real_zero(9, FE);
    for (int i = 0; i < stages; i++) {
        const double *S = &s->S[i * (stages + 2) + stages];
        for (int j = 0; j < 9; j++)
            FF[j] += t[i].FF[j];
        for (int j = 0; j < 3; j++) {
            FE[3 * j + 2] += t[i].gradient[EXACT_STAGE_FORCE + j];
            if (!s->warps)
                continue;
            FE[3 * j] += S[0] * t[i].z[EXACT_STAGE_FORCE + j];
            FE[3 * j + 1] += S[1] * t[i].z[EXACT_STAGE_FORCE + j];
        }
    }
    for (int j = 0; j < 3; j++)
        Fv[4 * j] = real_of(1);
}

/* Fills the block column of three parameters on which F depends at the points. column[] contains
 * the derivatives of F at the points [3 x 3]. */
static inline void exact_sums_load(int stages, const exact_stages *s, const exact_stage_terms t[],
                                   real column[][9], real A[][9])
{
    const int F = stages - 1, v = stages + 1, last = stages + 2, load = stages + 3;
    real y[EXACT_STAGES_MAX][3], through[EXACT_STAGES_MAX][3],
        *own = A[exact_blocks_at(load, load)], *E = A[exact_blocks_at(last, load)];
    for (int I = 0; I <= load; I++)
        real_zero(9, A[exact_blocks_at(I, load)]);
    for (int i = 0; i < stages; i++)
        for (int j = 0; j < 3; j++) {
            y[i][j] = column[i][j] * t[i].z[EXACT_STAGE_FORCE] +
                      column[i][3 + j] * t[i].z[EXACT_STAGE_FORCE + 1] +
                      column[i][6 + j] * t[i].z[EXACT_STAGE_FORCE + 2];
            through[i][j] = real_of(0);
        }
    for (int i = 0; i < stages && s->warps; i++) {
        const double *S = &s->S[i * (stages + 2)];
        for (int h = 0; h < stages; h++)
            for (int j = 0; j < 3; j++)
                through[i][j] += S[h] * y[h][j];
        for (int j = 0; j < 3; j++) {
            E[j] += S[stages] * y[i][j];
            E[3 + j] += S[stages + 1] * y[i][j];
        }
    }
    for (int i = 0; i < stages; i++) {
        const real *z = t[i].z, *B = column[i];
        real x[9], slope[9], force[9], xF[9], sF[9];
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                xF[3 * j + k] = t[i].xF[3 * k + j];
                sF[3 * j + k] = t[i].sF[3 * k + j];
                x[3 * j + k] = z[EXACT_STAGE_MILENKOVIC + j] * through[i][k];
                slope[3 * j + k] = z[EXACT_STAGE_SLOPE + j] * through[i][k];
                force[3 * j + k] = z[EXACT_STAGE_FORCE + j] * through[i][k];
            }
        mat3_add_transpose_mul(xF, B, x);
        mat3_add_transpose_mul(sF, B, slope);
        mat3_add_transpose_mul(t[i].FF, B, force);
        for (int k = 0; k < stages; k++) {
            real *X = A[exact_blocks_at(k < stages - 1 ? k : stages, load)];
            for (int j = 0; j < 9; j++)
                X[j] += s->N[i][k] * x[j] + s->dN[i][k] * slope[j];
        }
        for (int j = 0; j < 9; j++)
            A[exact_blocks_at(F, load)][j] += force[j];
        mat3_add_transpose_mul(B, force, own);
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                E[6 + j] += B[3 * k + j] * t[i].gradient[EXACT_STAGE_FORCE + k];
    }
    real_zero(9, A[exact_blocks_at(v, load)]);
}

/* Fills all blocks and changes t. The blocks of the strains receive only the contributions of the
 * points and of the warping energy. */
static inline void exact_sums_gather(int stages, const exact_stages *s, exact_stage_terms t[],
                                     real A[][9])
{
    const int F = stages - 1, rho = stages, v = stages + 1, last = stages + 2;
    real through[EXACT_STAGES_MAX][EXACT_STAGES_MAX][3];
    if (s->warps)
        exact_sums_couple(stages, s, t, through);
    for (int k = 0; k < stages; k++) {
        exact_sums_column(stages, s, k, t, through, A);
        exact_sums_border(stages, s, k, t, A);
    }
    exact_sums_force(stages, s, t, A);
    for (int k = 0; k < F; k++)
        real_zero(9, A[exact_blocks_at(k, v)]);
    real_zero(9, A[exact_blocks_at(rho, v)]);
    real_zero(9, A[exact_blocks_at(v, v)]);
    real_zero(9, A[exact_blocks_at(v, last)]);
    real *E = A[exact_blocks_at(last, last)];
    real_zero(9, E);
    if (s->warps)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++)
                E[3 * i + j] = real_of(s->S[(stages + i) * (stages + 2) + stages + j]);
    else if (s->c.warping) /* without warping energy, the amplitudes have no effect */
        for (int i = 0; i < 2; i++)
            E[4 * i] = real_of(s->c.GJ);
}

#endif
