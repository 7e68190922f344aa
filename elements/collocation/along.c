#include "elements/collocation/collocation.h"

#include <math.h>
#include <string.h>

#include "elements/collocation/collocated.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

enum { POINTS = ELEMENT_ALONG_POINTS, FINE = 20, X = 2 * NODE_COORDINATES, TURN = 3 };

typedef struct load_points {
    double x[POINTS], weight[POINTS], scale[POINTS];
} load_points;

static void points_of(load_points *p)
{
    quadrature_points(POINTS, p->x, p->weight);
    for (int j = 0; j < POINTS; j++) {
        double product = 1;
        for (int k = 0; k < POINTS; k++)
            product *= k == j ? 1 : p->x[j] - p->x[k];
        p->scale[j] = 1 / product;
    }
}

/* Adds factor times the Lagrange polynomials at x to `out`. */
static void add_lagrange(const load_points *p, double x, double factor, double out[POINTS])
{
    double before[POINTS], after = factor;
    before[0] = 1;
    for (int j = 1; j < POINTS; j++)
        before[j] = before[j - 1] * (x - p->x[j - 1]);
    for (int j = POINTS - 1; j >= 0; j--) {
        out[j] += before[j] * after * p->scale[j];
        after *= x - p->x[j];
    }
}

/* Computes the integrals of the polynomials from x to 1, minus half of the integrals from 0 to
 * 1. */
static void weights_at(const load_points *p, double x, double out[POINTS])
{
    for (int j = 0; j < POINTS; j++)
        out[j] = -p->weight[j] / 2;
    for (int m = 0; m < POINTS; m++)
        add_lagrange(p, x + (1 - x) * p->x[m], (1 - x) * p->weight[m], out);
}

/* Computes R (e_x + g) of the undeformed line in the mean axes. */
static void undeformed_axis(const element_request *request, double x, double out[3])
{
    const double strained[3] = {1 + request->strain[0], request->strain[1], request->strain[2]};
    double turn[3], q[4];
    for (int i = 0; i < 3; i++)
        turn[i] = request->curvature[i] * request->length * (x - 0.5);
    rotation_exp(turn, q);
    rotation_apply(q, strained, out);
}

/* Computes `missed` for a curved line: the integral over the line minus the quadrature at the Gauss
 * points. */
static void missed_of(const element_request *request, const exact_stages *s, const load_points *p,
                      double own[EXACT_STAGES_MAX][POINTS], exact_along *out)
{
    double fine[FINE], weight[FINE], a[POINTS], axis[3];
    const double area = s->line.l0 * s->line.l0;
    quadrature_points(FINE, fine, weight);
    for (int i = 0; i < s->stages; i++)
        for (int j = 0; j < POINTS; j++)
            for (int k = 0; k < 3; k++)
                out->missed[j][k] -= area * s->w[i] * own[i][j] * s->rest_axis[i][k];
    for (int i = 0; i < FINE; i++) {
        weights_at(p, fine[i], a);
        undeformed_axis(request, fine[i], axis);
        for (int j = 0; j < POINTS; j++)
            for (int k = 0; k < 3; k++)
                out->missed[j][k] += area * weight[i] * a[j] * axis[k];
    }
}

void exact_along_prepare(const element_request *request, const exact_stages *s, exact_along *out)
{
    load_points p;
    double at[EXACT_STAGES_MAX], weight[EXACT_STAGES_MAX], own[EXACT_STAGES_MAX][POINTS];
    memset(out, 0, sizeof *out);
    points_of(&p);
    quadrature_points(s->stages, at, weight);
    for (int j = 0; j < POINTS; j++)
        out->half[j] = s->line.l0 / 2 * p.weight[j];
    for (int i = 0; i < s->stages; i++) {
        weights_at(&p, at[i], own[i]);
        for (int j = 0; j < POINTS; j++)
            out->at[i][j] = s->line.l0 * own[i][j];
    }
    if (vec3_norm(request->curvature) > 0)
        missed_of(request, s, &p, own, out);
}

void exact_along_frame_of(const exact_stages *s, const exact_along *a, const node_state x[],
                          const double force[], exact_along_frame *out)
{
    const double unit = s->line.l0 / s->c.energy;
    double side = 0;
    memset(out->g, 0, sizeof out->g);
    memset(out->missed, 0, sizeof out->missed);
    for (int k = 0; k < 2; k++)
        rotation_from_matrix(x[k].R, out->q[k]);
    for (int i = 0; i < 4; i++)
        side += out->q[0][i] * out->q[1][i];
    for (int i = 0; i < 4; i++) {
        if (side < 0)
            out->q[1][i] = -out->q[1][i];
        out->u[i] = (out->q[0][i] + out->q[1][i]) / 2;
    }
    out->size = sqrt(out->u[0] * out->u[0] + out->u[1] * out->u[1] + out->u[2] * out->u[2] +
                     out->u[3] * out->u[3]);
    for (int i = 0; i < 4; i++)
        out->u[i] /= out->size;
    rotation_matrix(out->u, out->G);
    for (int j = 0; j < POINTS; j++)
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < s->stages; k++)
                out->g[k][i] += a->at[k][j] * force[3 * j + i];
            for (int k = 0; k < 3; k++)
                out->missed[3 * i + k] += force[3 * j + i] * a->missed[j][k];
        }
    for (int k = 0; k < s->stages; k++) {
        mat3_transpose_mul_vec(out->G, out->g[k], out->xi[k]);
        for (int i = 0; i < 3; i++)
            out->xi[k][i] *= unit;
    }
}

/* Adds to `moment` the derivative of the potential M : G with respect to a rotation of G in the
 * axes of G. */
static void add_moment(const double M[9], const double G[9], double moment[3])
{
    double A[9] = {0};
    mat3_add_transpose_mul(G, M, A);
    moment[0] += A[7] - A[5];
    moment[1] += A[2] - A[6];
    moment[2] += A[3] - A[1];
}

/* Computes dQ, the derivative of the mean quaternion Q with respect to a rotation of node k about
 * axis j: 1/4 e_j o q_k. */
static void mean_gradient(const exact_along_frame *at, int k, int j, double out[4])
{
    double axis[4] = {0};
    axis[j + 1] = 0.25;
    rotation_compose(axis, at->q[k], out);
}

static void turn_of(const exact_along_frame *at, double turn[3 * X])
{
    double inverse[4];
    rotation_conjugate(at->u, inverse);
    memset(turn, 0, 3 * X * sizeof *turn);
    for (int k = 0; k < 2; k++)
        for (int j = 0; j < 3; j++) {
            double moved[4], inside[4];
            mean_gradient(at, k, j, moved);
            rotation_compose(inverse, moved, inside);
            for (int i = 0; i < 3; i++)
                turn[i * X + NODE_COORDINATES * k + TURN + j] = 2 / at->size * inside[i + 1];
        }
}

/* Computes B, where M : R(u) = u . B u for unit quaternions u. */
static void quadratic_of(const double M[9], double B[4][4])
{
    B[0][0] = M[0] + M[4] + M[8];
    B[1][1] = M[0] - M[4] - M[8];
    B[2][2] = M[4] - M[0] - M[8];
    B[3][3] = M[8] - M[0] - M[4];
    B[0][1] = B[1][0] = M[7] - M[5];
    B[0][2] = B[2][0] = M[2] - M[6];
    B[0][3] = B[3][0] = M[3] - M[1];
    B[1][2] = B[2][1] = M[1] + M[3];
    B[1][3] = B[3][1] = M[2] + M[6];
    B[2][3] = B[3][2] = M[5] + M[7];
}

/* Computes H, the second derivative of M : G with respect to rotations of the nodes in the
 * exponential chart. M : G equals (Q . B Q)/(Q . Q), and d2Q = -1/8 |theta|^2 q_k for each node. */
static void second_of(const exact_along_frame *at, const double M[9], double H[X * X])
{
    double B[4][4], Bu[4], value = 0, dQ[6][4], along[6], across[6], own[2] = {0};
    quadratic_of(M, B);
    for (int i = 0; i < 4; i++) {
        Bu[i] = B[i][0] * at->u[0] + B[i][1] * at->u[1] + B[i][2] * at->u[2] + B[i][3] * at->u[3];
        value += Bu[i] * at->u[i];
    }
    for (int i = 0; i < 4; i++)
        Bu[i] -= value * at->u[i]; /* half the gradient, times the magnitude of Q */
    for (int a = 0; a < 6; a++) {
        along[a] = across[a] = 0;
        mean_gradient(at, a / 3, a % 3, dQ[a]);
        for (int i = 0; i < 4; i++) {
            along[a] += at->u[i] * dQ[a][i];
            across[a] += Bu[i] * dQ[a][i];
        }
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            own[k] -= Bu[i] * at->q[k][i] / 4 / at->size;
    memset(H, 0, X * X * sizeof *H);
    for (int a = 0; a < 6; a++)
        for (int b = 0; b < 6; b++) {
            double sum = -2 * (along[a] * across[b] + across[a] * along[b]);
            for (int i = 0; i < 4; i++) {
                double BdQ = -value * dQ[b][i];
                for (int j = 0; j < 4; j++)
                    BdQ += B[i][j] * dQ[b][j];
                sum += dQ[a][i] * BdQ;
            }
            H[(NODE_COORDINATES * (a / 3) + TURN + a % 3) * X + NODE_COORDINATES * (b / 3) + TURN +
              b % 3] = 2 * sum / (at->size * at->size) + (a == b ? own[a / 3] : 0);
        }
}

void exact_along_finish(const exact_stages *s, const exact_along *a, const exact_along_frame *at,
                        double moved[][3], along_output *out)
{
    double M[9], missed[9];
    for (int i = 0; i < 9; i++)
        missed[i] = M[i] = -at->missed[i];
    for (int k = 0; k < s->stages; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                M[3 * i + j] += s->line.l0 * at->g[k][i] * moved[k][j];
    add_moment(missed, at->G, out->moment);
    turn_of(at, out->turn);
    memset(out->ends, 0, sizeof out->ends);
    for (int j = 0; j < POINTS; j++)
        for (int i = 0; i < 3; i++) {
            out->ends[i] += a->half[j] * out->force[3 * j + i];
            out->ends[NODE_COORDINATES + i] = out->ends[i];
        }
    if (out->H != NULL)
        second_of(at, M, out->H);
}

/* Returns 0, or the number of the pivot that fails. */
static int eliminate(int stages, exact_collocated *w)
{
    exact_blocks_eliminate(stages, stages + 4, stages + 1, w->A, w->V, w->d);
    return exact_blocks_definite(stages, w->A, w->d, 0)
               ? 0
               : exact_collocated_exchange(stages, EXACT_STAGES_OUTER + 4, 0, w);
}

status exact_along_linear(const exact_stages *s, const exact_along *a, const node_state x[],
                          along_output *out)
{
    enum { OUTER = EXACT_STAGES_OUTER };
    const double none[OUTER] = {0}, unit = s->c.energy, l0 = s->line.l0;
    double rest[EXACT_STAGES_UNKNOWNS] = {0}, G[OUTER * OUTER];
    exact_along_frame at;
    exact_collocated w;
    exact_collocated_load load;
    memcpy(rest + 3, s->rest_x[1], 3 * (size_t)(s->stages - 1) * sizeof(double));
    exact_along_frame_of(s, a, x, out->force, &at);
    for (int pass = 0; pass < (out->H != NULL ? 2 : 1); pass++) {
        memset(&load, 0, sizeof load);
        for (int k = 0; k < s->stages; k++)
            if (pass == 0)
                for (int i = 0; i < 3; i++)
                    load.column[k][3 * i] = at.xi[k][i];
            else
                exact_along_column(at.xi[k], load.column[k]);
        exact_collocated_evaluate(s->stages, s, none, rest, &load, w.A);
        if (eliminate(s->stages, &w) != 0)
            return STATUS_SINGULAR;
        for (int i = 0; i < OUTER; i++)
            if (pass == 0)
                out->sigma[i] = unit / l0 * exact_collocated_entry(s->stages, &w, i, OUTER + 1, 0);
            else
                for (int k = 0; k < 3; k++)
                    out->mixed[3 * i + k] =
                        unit / l0 * exact_collocated_entry(s->stages, &w, i, OUTER + 1 + k, 0);
    }
    memset(out->moment, 0, sizeof out->moment);
    memset(out->second, 0, sizeof out->second);
    for (int k = 0; k < s->stages; k++) {
        double moment[3];
        vec3_cross(at.xi[k], load.moved[k], moment);
        for (int i = 0; i < 3; i++)
            out->moment[i] -= unit * moment[i];
    }
    exact_along_finish(s, a, &at, load.moved, out);
    if (out->C == NULL)
        return STATUS_OK;
    exact_prestress_load(s, at.xi, G);
    for (int i = 0; i < OUTER * OUTER; i++)
        out->C[i] = unit / (l0 * l0) * G[i];
    return STATUS_OK;
}

status exact_along_rate(const exact_stages *s, const exact_along *a, const node_state x[],
                        along_output *out)
{
    enum { OUTER = EXACT_STAGES_OUTER };
    const double unit = s->c.energy, l0 = s->line.l0;
    double e[OUTER], turned[9], moment[3] = {0};
    exact_along_frame at, more;
    exact_collocated w;
    exact_collocated_load load;
    for (int i = 0; i < OUTER; i++)
        e[i] = out->e[i] / l0;
    exact_along_frame_of(s, a, x, out->force, &at);
    exact_along_frame_of(s, a, x, out->rate, &more);
    for (int pass = 0; pass < 2; pass++) {
        for (int k = 0; k < s->stages; k++) {
            memcpy(load.force[k], at.xi[k], sizeof load.force[k]);
            exact_along_column(at.xi[k], turned);
            for (int i = 0; i < 3; i++) {
                load.column[k][3 * i] = more.xi[k][i];
                load.column[k][3 * i + 1] = turned[3 * i + 2 * pass];
                load.column[k][3 * i + 2] = turned[3 * i + 1];
            }
        }
        exact_collocated_evaluate(s->stages, s, e, out->inner, &load, w.A);
        if (eliminate(s->stages, &w) != 0)
            return STATUS_SINGULAR;
        moment[2 * pass] = exact_collocated_entry(s->stages, &w, OUTER + 1, OUTER + 2, 0);
        moment[1] = exact_collocated_entry(s->stages, &w, OUTER + 1, OUTER + 3, 0);
    }
    for (int i = 0; i < OUTER; i++)
        out->sigma[i] = unit / l0 * exact_collocated_entry(s->stages, &w, i, OUTER + 1, 0);
    for (int k = 0; k < s->stages; k++) {
        double own[3];
        vec3_cross(more.xi[k], load.moved[k], own);
        for (int i = 0; i < 3; i++)
            moment[i] -= own[i];
    }
    along_output of_rate = {.force = out->rate};
    for (int i = 0; i < 3; i++)
        of_rate.moment[i] = unit * moment[i];
    exact_along_finish(s, a, &more, load.moved, &of_rate);
    memcpy(out->moment, of_rate.moment, sizeof out->moment);
    memcpy(out->turn, of_rate.turn, sizeof out->turn);
    memcpy(out->ends, of_rate.ends, sizeof out->ends);
    return STATUS_OK;
}
