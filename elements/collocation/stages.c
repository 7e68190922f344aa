#include <math.h>
#include <string.h>

#include "elements/collocation/collocated.h"
#include "elements/collocation/collocation.h"
#include "elements/collocation/sums.h"
#include "elements/geometrically_exact/exact.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

/* Computes the weights N and dN of the variables in the values of x and x' at a point, from the
 * Lagrange polynomials of the nodes. */
static void weights(int count, const double at[], double x, double N[], double dN[])
{
    double node[EXACT_STAGES_NODES], slope[EXACT_STAGES_NODES];
    lagrange_at(count + 1, at, x, node, slope);
    for (int k = 0; k < count - 1; k++) {
        N[k] = node[k + 1];
        dN[k] = slope[k + 1];
    }
    N[count - 1] = (node[count] - node[0]) / 2;
    dN[count - 1] = (slope[count] - slope[0]) / 2;
}

/* Subtracts the contribution int R g of the initial strains, in the mean axes, from v. Strains are
 * measured from the arc without initial strains. */
static void less_initial_strain(const element_request *request, double v[3])
{
    double rotation[3], back[3], added[3], q[4], R[9], middle[3];
    for (int i = 0; i < 3; i++) {
        rotation[i] = request->curvature[i] * request->length;
        back[i] = -rotation[i] / 2;
    }
    arc_at(rotation, request->strain, 1, added, q);
    rotation_exp(back, q);
    rotation_matrix(q, R);
    mat3_mul_vec(R, added, middle);
    for (int i = 0; i < 3; i++)
        v[i] -= middle[i];
}

/* Computes the curvatures and axes at the points, and the vector between the ends, for the
 * stress-free element. */
static void rest_of_points(const element_request *request, exact_stages *out)
{
    const double strained[3] = {1 + request->strain[0], request->strain[1], request->strain[2]},
                 none[3] = {0};
    exact_stage p[EXACT_STAGES_MAX];
    double at[EXACT_STAGES_MAX][3];
    memcpy(at, out->rest_x[1], sizeof at);
    for (int j = 0; j < 3; j++)
        at[out->stages - 1][j] = 2 * out->rest_x[out->stages][j];
    exact_sums_geometry(out->stages, out, at, none, p);
    for (int i = 0; i < out->stages; i++) {
        double back[3], axis[3];
        for (int j = 0; j < 3; j++)
            back[j] = -p[i].x[j];
        exact_milenkovic_vector(&p[i].orientation, back, strained, axis); /* R (e_x + g) */
        for (int j = 0; j < 3; j++) {
            out->rest_kappa[i][j] = p[i].kappa[j];
            out->rest_axis[i][j] = axis[j];
            out->rest_v[j] += out->w[i] * axis[j];
        }
    }
}

status exact_stages_prepare(const element_request *request, int count, exact_stages *out, fault *f)
{
    double point[EXACT_STAGES_MAX], at[EXACT_STAGES_NODES];
    memset(out, 0, sizeof *out);
    TRY(beam_constants_of(request, &out->c, f));
    out->stages = count;
    out->unknowns = 3 * count;
    const double none[3] = {0};
    exact_strain_prepare(2, 1, request->length, request->curvature, none, EXACT_MEASURE_EIGHTH,
                         &out->line);
    quadrature_points(count, point, out->w);
    const double angle = vec3_norm(request->curvature) * request->length;
    for (int k = 0; k <= count; k++) {
        at[k] = (1 - cos(PI * k / count)) / 2; /* any distinct points are valid, and the Chebyshev
                                                  points give coefficients of similar size */
        const double length = angle > 0 ? 4 * tan(angle * (at[k] - 0.5) / 4) / angle : 0;
        for (int i = 0; i < 3; i++)
            out->rest_x[k][i] = request->curvature[i] * request->length * length;
    }
    for (int i = 0; i < count; i++)
        weights(count, at, point[i], out->N[i], out->dN[i]);
    rest_of_points(request, out);
    less_initial_strain(request, out->rest_v);
    out->warps = out->c.warping && out->c.EIw > 0;
    if (out->warps)
        exact_warping_energy(&out->c, count, point, out->w, out->S);
    return STATUS_OK;
}

enum { OUTER = EXACT_STAGES_OUTER, UNKNOWNS = EXACT_STAGES_UNKNOWNS };

static double entry(int stages, double A[][9], int i, int j)
{
    int row, column;
    const int I = exact_variables_block(stages, i, &row),
              J = exact_variables_block(stages, j, &column);
    if (I < J || (I == J && row <= column))
        return A[exact_blocks_at(I, J)][3 * row + column];
    return A[exact_blocks_at(J, I)][3 * column + row];
}

void exact_variables_matrix(int stages, double A[][9], int n, double matrix[])
{
    int row, column;
    for (int i = 0; i < n; i++) {
        const int I = exact_variables_block(stages, i, &row);
        for (int j = 0; j < n; j += 3) {
            const int J = exact_variables_block(stages, j, &column), down = I > J,
                      at = down ? exact_blocks_at(J, I) : exact_blocks_at(I, J);
            for (int k = 0; k < 3 && j + k < n; k++)
                matrix[i * n + j + k] =
                    A[at][down || (I == J && row > k) ? 3 * k + row : 3 * row + k];
        }
    }
}

int exact_variables_eliminate(int stages, int columns, double A[][9], double S[][9],
                              double X[][EXACT_STAGES_MAX][9])
{
    enum { MOST = OUTER + 4 };
    const int m = 3 * stages, n = columns;
    double K[UNKNOWNS * UNKNOWNS], B[UNKNOWNS * MOST], solved[UNKNOWNS * MOST];
    int pivot[UNKNOWNS], row, column;
    exact_variables_matrix(stages, A, m, K);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            B[i * n + j] = solved[i * n + j] = entry(stages, A, i, m + j);
    const int failed = dense_lu(m, K, pivot);
    if (failed != 0)
        return failed;
    dense_lu_solve(m, n, K, pivot, solved);
    for (int j = 0; j < n; j++) {
        const int J = exact_variables_block(stages, m + j, &column);
        for (int i = 0; i < m; i++) {
            const int I = exact_variables_block(stages, i, &row);
            X[J - stages][I][3 * row + column] = solved[i * n + j];
        }
        for (int i = 0; i < n; i++) {
            const int I = exact_variables_block(stages, m + i, &row);
            double rest = entry(stages, A, m + i, m + j);
            for (int k = 0; k < m; k++)
                rest -= B[k * n + i] * solved[k * n + j];
            if (I <= J)
                S[exact_blocks_at(I, J)][3 * row + column] = rest;
        }
    }
    return 0;
}

void exact_variables_change(const exact_stages *s, int i, const double change[], double x[3],
                            double slope[3])
{
    memset(x, 0, 3 * sizeof *x);
    memset(slope, 0, 3 * sizeof *slope);
    for (int k = 0; k < s->stages; k++) {
        const int first = k < s->stages - 1 ? 3 * (k + 1) : s->unknowns + 3;
        for (int j = 0; j < 3; j++) {
            x[j] += s->N[i][k] * change[first + j];
            slope[j] += s->dN[i][k] * change[first + j];
        }
    }
}
