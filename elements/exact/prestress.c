/* The linear state under sigma gives force, moments and warping torques at the points.  With them,
 * but in the undeformed geometry, the Hessian of the potential is a quadratic polynomial of the
 * prestress; its linear part is the geometric stiffness (the square belongs to strains of the
 * prestressed state, which linear buckling leaves out).  The inner unknowns follow the strains as
 * they do without stress: the error of a critical load is of fourth order in the length of an
 * element, and of second where shear is flexible (c_column: 0.052, 0.0033, 0.00021 % rigid in
 * shear, 1.26, 0.31, 0.078 % with n = 4, 8, 16). */
#include "elements/exact/prestress.h"

#include <string.h>

#include "elements/exact/sums.h"
#include "elements/math/dense.h"

/* Linear response: change of all variables under sigma, and how the unknowns follow the strains, Z
 * [unknowns x 8]. */
static void linear_state(const exact_stages *s, const double sigma[], double change[], double Z[])
{
    const int m = s->unknowns, n = m + EXACT_STAGES_OUTER;
    double rest[EXACT_STAGES_UNKNOWNS] = {0}, none[EXACT_STAGES_OUTER] = {0},
           K[EXACT_STAGES_UNKNOWNS * EXACT_STAGES_UNKNOWNS];
    exact_stages_derivatives d;
    int pivot[EXACT_STAGES_ALL];
    memcpy(rest + 3, s->rest_x[1], 3 * (size_t)(s->stages - 1) * sizeof(double));
    exact_stages_evaluate(s, none, rest, &d);
    for (int i = 0; i < m; i++) {
        memcpy(&K[i * m], &d.hessian[i * n], (size_t)m * sizeof *K);
        for (int j = 0; j < EXACT_STAGES_OUTER; j++)
            Z[i * EXACT_STAGES_OUTER + j] = -d.hessian[i * n + m + j];
    }
    dense_lu(m, K, pivot); /* the undeformed element is stable */
    dense_lu_solve(m, EXACT_STAGES_OUTER, K, pivot, Z);
    memset(change, 0, (size_t)n * sizeof *change);
    memcpy(change + m, sigma, EXACT_STAGES_OUTER * sizeof *change);
    if (!s->c.warping)
        for (int i = n - 2; i < n; i++)
            d.hessian[i * (n + 1)] = 1; /* no amplitudes */
    dense_lu(n, d.hessian, pivot);
    dense_lu_solve(n, 1, d.hessian, pivot, change);
}

/* Hessian at rest with stresses `factor` times those of the linear state. */
static void stressed_hessian(const exact_stages *s, const double change[], double factor,
                             double hessian[])
{
    const int n = s->unknowns + EXACT_STAGES_OUTER;
    double force[3], Sz[EXACT_WARPING_MAX] = {0}, dz[EXACT_WARPING_MAX],
                     ignored[EXACT_STAGES_ALL] = {0};
    const double none[3] = {0};
    exact_stage p[EXACT_STAGES_MAX];
    double moment[EXACT_STAGES_MAX][6], M[36];
    exact_sums a;
    for (int i = 0; i < 3; i++)
        force[i] = factor * change[i];
    exact_stage_material(&s->c, none, none, 0, moment[0], M);
    for (int i = 0; i < s->stages; i++) {
        double x[3], slope[3], D[6][EXACT_STAGE_SPACE], strain[6];
        exact_stage_at(s->stages + 1, s->N[i], s->dN[i], s->rest_x[0], none, s->rest_kappa[i],
                       &p[i]);
        exact_stage_rows(&p[i], none, D);
        exact_sums_change(s, i, change, x, slope);
        for (int k = 0; k < 6; k++)
            strain[k] = vec3_dot(&D[k][EXACT_STAGE_MILENKOVIC], x) +
                        vec3_dot(&D[k][EXACT_STAGE_SLOPE], slope) +
                        vec3_dot(&D[k][EXACT_STAGE_FORCE], change);
        dz[i] = strain[0] - s->c.F[6] * strain[4] - s->c.F[7] * strain[5];
        dense_mul_vec(6, 6, M, strain, moment[i]);
        memcpy(moment[i] + 3, strain + 3,
               3 * sizeof(double)); /* N itself, for the terms it makes stiff in torsion */
    }
    if (s->warps) {
        dz[s->stages] = change[s->unknowns + 6];
        dz[s->stages + 1] = change[s->unknowns + 7];
        dense_mul_vec(s->stages + 2, s->stages + 2, s->S, dz, Sz);
    }
    memset(&a, 0, sizeof a);
    memset(hessian, 0, (size_t)(n * n) * sizeof *hessian);
    if (s->warps)
        exact_sums_warping(s, (const double[EXACT_STAGES_OUTER]){0}, p, &a, dz);
    for (int i = 0; i < s->stages; i++) {
        double gradient[6] = {0, 0, 0, -1, 0, 0}, stiff[36];
        memcpy(stiff, M, sizeof stiff);
        for (int k = 0; k < 3; k++)
            gradient[k] = factor * (moment[i][k] + (k == 0 ? Sz[i] / s->w[i] : 0));
        stiff[0] += factor * (s->c.trapeze * moment[i][3] + s->c.bend_y * moment[i][1] +
                              s->c.bend_z * moment[i][2]);
        exact_stage_at(s->stages + 1, s->N[i], s->dN[i], s->rest_x[0], force, s->rest_kappa[i],
                       &p[i]);
        exact_sums_add(s, i, &p[i], force, gradient, stiff, &a);
    }
    exact_sums_gather(s, &a, ignored, hessian);
}

void exact_prestress_stiffness(const exact_stages *s, const double sigma[], double G[])
{
    const int m = s->unknowns, n = m + EXACT_STAGES_OUTER;
    double change[EXACT_STAGES_ALL],
        W[EXACT_STAGES_ALL * EXACT_STAGES_OUTER] = {0}, plus[EXACT_STAGES_ALL * EXACT_STAGES_ALL],
                             minus[EXACT_STAGES_ALL * EXACT_STAGES_ALL],
                             work[EXACT_STAGES_ALL * EXACT_STAGES_OUTER];
    linear_state(s, sigma, change, W);
    for (int j = 0; j < EXACT_STAGES_OUTER; j++)
        W[(m + j) * EXACT_STAGES_OUTER + j] = 1;
    stressed_hessian(s, change, 1, plus);
    stressed_hessian(s, change, -1, minus);
    for (int i = 0; i < n * n; i++)
        plus[i] = (plus[i] - minus[i]) / 2;
    memset(G, 0, EXACT_STAGES_OUTER * EXACT_STAGES_OUTER * sizeof *G);
    dense_add_congruence(n, EXACT_STAGES_OUTER, W, plus, G, work);
}
