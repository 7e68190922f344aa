/* The linear state under sigma determines the force, moments and warping torques at the points.
 * With these stresses and the undeformed geometry, the Hessian of the potential is a quadratic
 * polynomial of the prestress. The linear part of the Hessian is the geometric stiffness. The
 * quadratic part is due to strains of the prestressed state and is neglected in linear buckling.
 * The inner unknowns depend on the strains as in the stress-free element. Therefore the error of a
 * critical load is of fourth order in the length of an element if the section is rigid in shear,
 * and of second order otherwise. */
#include "elements/collocation/collocation.h"

#include <string.h>

#include "elements/collocation/collocated.h"
#include "elements/math/dense.h"

enum { OUTER = EXACT_STAGES_OUTER };

/* Computes the linear response to a unit value of each stress: the change [n x 8] of all variables,
 * and the derivatives Z [unknowns x 8] of the unknowns. */
static void linear_states(const exact_stages *s, double change[], double Z[])
{
    const int m = s->unknowns, n = m + OUTER;
    double rest[EXACT_STAGES_UNKNOWNS] = {0}, none[OUTER] = {0},
           K[EXACT_STAGES_UNKNOWNS * EXACT_STAGES_UNKNOWNS], A[EXACT_VARIABLES_BLOCKS][9],
           hessian[EXACT_STAGES_ALL * EXACT_STAGES_ALL];
    int pivot[EXACT_STAGES_ALL];
    memcpy(rest + 3, s->rest_x[1], 3 * (size_t)(s->stages - 1) * sizeof(double));
    exact_collocated_evaluate(s->stages, s, none, rest, NULL, A);
    exact_variables_matrix(s->stages, A, n, hessian);
    for (int i = 0; i < m; i++) {
        memcpy(&K[i * m], &hessian[i * n], (size_t)m * sizeof *K);
        for (int j = 0; j < OUTER; j++)
            Z[i * OUTER + j] = -hessian[i * n + m + j];
    }
    dense_lu(m, K, pivot); /* not singular, because the undeformed element is stable */
    dense_lu_solve(m, OUTER, K, pivot, Z);
    memset(change, 0, (size_t)(n * OUTER) * sizeof *change);
    for (int i = 0; i < OUTER; i++)
        change[(m + i) * OUTER + i] = 1;
    if (!s->c.warping)
        for (int i = n - 2; i < n; i++)
            hessian[i * (n + 1)] = 1; /* without warping */
    dense_lu(n, hessian, pivot);
    dense_lu_solve(n, OUTER, hessian, pivot, change);
}

/* Computes N, its change due to a change of the variables, and `moment`, the change of the moments,
 * at point i of the undeformed element with the Hessian M. The terms in which N stiffens torsion
 * use the change of N itself. Returns the change of the argument of the warping energy. */
static double moments(const exact_stages *s, int i, const exact_stage *p,
                      const exact_stage_material *M, const double change[], const double force[3],
                      double moment[3], double N[3])
{
    const double none[3] = {0};
    double x[3], slope[3], kappa[3];
    exact_stage_rows D;
    exact_stage_rows_of(p, none, &D);
    exact_variables_change(s, i, change, x, slope);
    for (int k = 0; k < 3; k++) {
        kappa[k] = vec3_dot(&D.Kx[3 * k], x) + vec3_dot(&D.Ks[3 * k], slope);
        N[k] = vec3_dot(&D.Nx[3 * k], x) + vec3_dot(&D.NF[3 * k], force);
    }
    for (int k = 0; k < 3; k++)
        moment[k] = vec3_dot(&M->kk[3 * k], kappa) + vec3_dot(&M->kN[3 * k], N);
    return kappa[0] - s->c.F[6] * N[1] - s->c.F[7] * N[2];
}

/* Computes the Hessian of the undeformed element with stresses `factor` times those of the linear
 * state. along[stages][3] is the contribution of loads to F at the points, or NULL. */
static void stressed_hessian(const exact_stages *s, const double change[], double along[][3],
                             double factor, double hessian[])
{
    double force[EXACT_STAGES_MAX][3], whole[EXACT_STAGES_MAX][3],
        Sz[EXACT_WARPING_MAX] = {0}, dz[EXACT_WARPING_MAX], at[EXACT_STAGES_MAX][3],
        moment[EXACT_STAGES_MAX][3], N[EXACT_STAGES_MAX][3], A[EXACT_VARIABLES_BLOCKS][9];
    const double none[3] = {0};
    const int stages = s->stages;
    exact_stage p[EXACT_STAGES_MAX];
    exact_stage_terms t[EXACT_STAGES_MAX];
    exact_stage_material M;
    memcpy(at, s->rest_x[1], sizeof at);
    for (int i = 0; i < 3; i++) {
        at[stages - 1][i] = s->line.rest[0][3 + i];
        for (int k = 0; k < stages; k++) {
            whole[k][i] = change[i] + (along != NULL ? along[k][i] : 0);
            force[k][i] = factor * whole[k][i];
        }
    }
    exact_stage_energy(&s->c, none, none, 0, &M);
    exact_sums_geometry(stages, s, at, none, p);
    for (int i = 0; i < stages; i++)
        dz[i] = moments(s, i, &p[i], &M, change, whole[i], moment[i], N[i]);
    if (s->warps) {
        dz[stages] = change[s->unknowns + 6];
        dz[stages + 1] = change[s->unknowns + 7];
        dense_mul_vec(stages + 2, stages + 2, s->S, dz, Sz);
    }
    for (int i = 0; i < stages; i++) {
        exact_milenkovic_vector(&p[i].orientation, p[i].x, force[i], p[i].N);
        exact_stage_material stiff = M;
        for (int k = 0; k < 3; k++) {
            stiff.kappa[k] = factor * (moment[i][k] + (k == 0 ? Sz[i] / s->w[i] : 0));
            stiff.N[k] = k == 0 ? -1 : 0;
        }
        stiff.kk[0] += factor * (s->c.trapeze * N[i][0] + s->c.bend_y * moment[i][1] +
                                 s->c.bend_z * moment[i][2]);
        exact_stage_terms_of(&s->c, &p[i], force[i], &stiff, s->w[i], &t[i]);
    }
    exact_sums_gather(stages, s, t, A);
    exact_variables_matrix(stages, A, s->unknowns + EXACT_STAGES_OUTER, hessian);
}

void exact_prestress_derivatives(const exact_stages *s, double Q[OUTER][OUTER * OUTER])
{
    const int m = s->unknowns, n = m + OUTER;
    double all[EXACT_STAGES_ALL * OUTER], change[EXACT_STAGES_ALL],
        W[EXACT_STAGES_ALL * OUTER] = {0}, plus[EXACT_STAGES_ALL * EXACT_STAGES_ALL],
                             minus[EXACT_STAGES_ALL * EXACT_STAGES_ALL],
                             work[EXACT_STAGES_ALL * OUTER];
    linear_states(s, all, W);
    for (int j = 0; j < OUTER; j++)
        W[(m + j) * OUTER + j] = 1;
    for (int k = 0; k < OUTER; k++) {
        for (int i = 0; i < n; i++)
            change[i] = all[i * OUTER + k];
        stressed_hessian(s, change, NULL, 1, plus);
        stressed_hessian(s, change, NULL, -1, minus);
        for (int i = 0; i < n * n; i++)
            plus[i] = (plus[i] - minus[i]) / 2;
        memset(Q[k], 0, sizeof Q[k]);
        dense_add_congruence(n, OUTER, W, plus, Q[k], work);
    }
}

void exact_prestress_load(const exact_stages *s, double along[][3], double Q[OUTER * OUTER])
{
    enum { UNKNOWNS = EXACT_STAGES_UNKNOWNS };
    const int m = s->unknowns, n = m + OUTER;
    double all[EXACT_STAGES_ALL * OUTER],
        change[EXACT_STAGES_ALL] = {0}, W[EXACT_STAGES_ALL * OUTER] = {0},
        plus[EXACT_STAGES_ALL * EXACT_STAGES_ALL], minus[EXACT_STAGES_ALL * EXACT_STAGES_ALL],
        work[EXACT_STAGES_ALL * OUTER], rest[UNKNOWNS] = {0}, none[OUTER] = {0};
    exact_collocated w;
    exact_collocated_load load = {.moved = {{0}}};
    int column;
    memcpy(rest + 3, s->rest_x[1], 3 * (size_t)(s->stages - 1) * sizeof(double));
    for (int k = 0; k < s->stages; k++)
        for (int i = 0; i < 3; i++)
            load.column[k][3 * i] = along[k][i];
    exact_collocated_evaluate(s->stages, s, none, rest, &load, w.A);
    exact_collocated_exchange(s->stages, OUTER + 4, 0, &w);
    for (int i = 0; i < m; i++) {
        const int I = exact_variables_block(s->stages, i, &column);
        change[i] = -w.X[3][I][3 * column];
    }
    linear_states(s, all, W);
    for (int j = 0; j < OUTER; j++)
        W[(m + j) * OUTER + j] = 1;
    stressed_hessian(s, change, along, 1, plus);
    stressed_hessian(s, change, along, -1, minus);
    for (int i = 0; i < n * n; i++)
        plus[i] = (plus[i] - minus[i]) / 2;
    memset(Q, 0, OUTER * OUTER * sizeof *Q);
    dense_add_congruence(n, OUTER, W, plus, Q, work);
}
