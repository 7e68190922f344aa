#include "elements/exact/stages.h"

#include <math.h>
#include <string.h>

#include "elements/exact/line.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"

enum { Q = 0, S = 4, F = 8, SPACE = 11 }; /* a point's variables: Q, Q' and F */

/* Sums over the points in terms of the nodes' quaternions. */
typedef struct sums {
    int nodes, all;
    double q[STAGES_NODES][4];
    double T[STAGES_NODES][12];               /* dq on the node's own three variables */
    double g[STAGES_NODES][4];                /* gradient */
    double X[STAGES_NODES][STAGES_NODES][16]; /* second derivatives, l >= k only */
    double Y[STAGES_NODES][12];               /* with F */
    double FF[9], gF[3];
    double z[WARPING_MAX], dz[WARPING_MAX * STAGES_ALL]; /* arguments of the warping energy and their derivatives */
} sums;

/* Variables of node k: the turns of an inner node, x of both ends. */
static int variables(const stages *s, int k)
{
    return k == 0 || k == s->stages ? s->unknowns + 3 : 4 + 3 * (k - 1);
}

static double end_quaternion(const double x[3], double sign, double q[4], double T[12])
{
    const double n2 = 1 + vec3_dot(x, x) / 16, n = sqrt(n2);
    q[0] = 1 / n;
    for (int i = 0; i < 3; i++)
        q[i + 1] = sign * x[i] / (4 * n);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++)
            T[3 * i + j] = (i == j + 1 ? sign / (4 * n) : 0) - q[i] * x[j] / (16 * n2);
    return n2;
}

/* Second derivative of g . q(x). */
static void end_second(const double x[3], double sign, const double q[4], const double g[4], double H[9])
{
    const double n2 = 1 + vec3_dot(x, x) / 16, n = sqrt(n2);
    double along = 0;
    for (int i = 0; i < 4; i++)
        along += g[i] * q[i];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            H[3 * i + j] = -sign * (g[i + 1] * x[j] + g[j + 1] * x[i]) / (64 * n * n2) - (i == j ? along / (16 * n2) : 0) +
                           3 * along * x[i] * x[j] / (256 * n2 * n2);
}

/* Energy of a point as a function of (kappa, N): gradient [6] and Hessian [36], T: its warping torque. */
static double material(const constants *c, const double kappa[3], const double N[3], double T, double gradient[6], double M[36])
{
    const double k = kappa[0];
    const double ky = kappa[1] + c->bend_y * k * k / 2, kz = kappa[2] + c->bend_z * k * k / 2, My = c->EIy * ky, Mz = c->EIz * kz;
    const double gy = c->F[0] * N[1] + c->F[1] * N[2], gz = c->F[3] * N[1] + c->F[4] * N[2];
    const double torsion = c->GJ + c->trapeze * N[0] + c->bend_y * My + c->bend_z * Mz;
    const double eccentric = c->ys * N[2] - c->zs * N[1];
    gradient[0] = eccentric + torsion * k + 4 * c->torque * k * k * k + T;
    gradient[1] = My;
    gradient[2] = Mz;
    gradient[3] = -1 - N[0] / c->EA + c->trapeze * k * k / 2;
    gradient[4] = -gy - c->zs * k - c->F[6] * T;
    gradient[5] = -gz + c->ys * k - c->F[7] * T;
    memset(M, 0, 36 * sizeof *M);
    M[0] = torsion + (c->EIy * c->bend_y * c->bend_y + c->EIz * c->bend_z * c->bend_z + 12 * c->torque) * k * k;
    M[1] = M[6] = c->EIy * c->bend_y * k;
    M[2] = M[12] = c->EIz * c->bend_z * k;
    M[3] = M[18] = c->trapeze * k;
    M[4] = M[24] = -c->zs;
    M[5] = M[30] = c->ys;
    M[7] = c->EIy;
    M[14] = c->EIz;
    M[21] = -1 / c->EA;
    M[28] = -c->F[0];
    M[29] = M[34] = -c->F[1];
    M[35] = -c->F[4];
    return -N[0] - N[0] * N[0] / (2 * c->EA) - (N[1] * gy + N[2] * gz) / 2 + eccentric * k + c->trapeze * N[0] * k * k / 2 +
           My * ky / 2 + Mz * kz / 2 + c->GJ * k * k / 2 + c->torque * k * k * k * k;
}

/* Derivatives of kappa and N with respect to (Q, Q', F). */
static void rows_of_point(const point *p, double D[6][SPACE])
{
    const double none[3] = {0};
    for (int i = 0; i < 6; i++) {
        double unit[3] = {0};
        unit[i % 3] = 1;
        point_gradient(p, i < 3 ? unit : none, i < 3 ? none : unit, &D[i][Q], &D[i][S]);
        for (int j = 0; j < 3; j++)
            D[i][F + j] = i < 3 ? 0 : p->R[3 * j + i - 3];
    }
}

/* w (D^T M D + second derivatives of kappa and N contracted with `gradient`). */
static void hessian_of_point(const point *p, const double gradient[6], const double M[36], double w, double D[6][SPACE],
                             double H[SPACE][SPACE])
{
    double MD[6][SPACE], QQ[16], QS[16], QF[12];
    point_hessian(p, gradient, gradient + 3, QQ, QS, QF);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < SPACE; j++) {
            MD[i][j] = 0;
            for (int k = 0; k < 6; k++)
                MD[i][j] += w * M[6 * i + k] * D[k][j];
        }
    for (int i = 0; i < SPACE; i++)
        for (int j = 0; j < SPACE; j++) {
            H[i][j] = 0;
            for (int k = 0; k < 6; k++)
                H[i][j] += D[k][i] * MD[k][j];
        }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            H[Q + i][Q + j] += w * QQ[4 * i + j];
            H[Q + i][S + j] += w * QS[4 * i + j];
            H[S + j][Q + i] += w * QS[4 * i + j];
        }
        for (int j = 0; j < 3; j++) {
            H[Q + i][F + j] += w * QF[3 * i + j];
            H[F + j][Q + i] += w * QF[3 * i + j];
        }
    }
}

static void add_point(const double N[], const double dN[], const double gradient[SPACE], double H[SPACE][SPACE], sums *a)
{
    for (int l = 0; l < a->nodes; l++) {
        double fromQ[16], fromS[16];
        for (int i = 0; i < 4; i++) {
            a->g[l][i] += N[l] * gradient[Q + i] + dN[l] * gradient[S + i];
            for (int j = 0; j < 4; j++) {
                fromQ[4 * i + j] = H[Q + i][Q + j] * N[l] + H[Q + i][S + j] * dN[l];
                fromS[4 * i + j] = H[S + i][Q + j] * N[l] + H[S + i][S + j] * dN[l];
            }
            for (int j = 0; j < 3; j++)
                a->Y[l][3 * i + j] += N[l] * H[Q + i][F + j] + dN[l] * H[S + i][F + j];
        }
        for (int k = 0; k <= l; k++)
            for (int i = 0; i < 16; i++)
                a->X[k][l][i] += N[k] * fromQ[i] + dN[k] * fromS[i];
    }
    for (int i = 0; i < 3; i++) {
        a->gF[i] += gradient[F + i];
        for (int j = 0; j < 3; j++)
            a->FF[3 * i + j] += H[F + i][F + j];
    }
}

/* Row of the warping energy's argument at a stage: kappa_x less the warping shear that Q_y and Q_z make. */
static void warping_row(const stages *s, int stage, double D[6][SPACE], sums *a)
{
    double row[SPACE], *dz = &a->dz[stage * a->all];
    for (int j = 0; j < SPACE; j++)
        row[j] = D[0][j] - s->c.F[6] * D[4][j] - s->c.F[7] * D[5][j];
    for (int k = 0; k < a->nodes; k++) {
        const int first = variables(s, k);
        for (int i = 0; i < 4; i++) {
            const double weight = s->N[stage][k] * row[Q + i] + s->dN[stage][k] * row[S + i];
            for (int j = 0; j < 3; j++)
                dz[first + j] += weight * a->T[k][3 * i + j];
        }
    }
    for (int j = 0; j < 3; j++)
        dz[j] += row[F + j];
}

/* K(rows of i, columns of j) += A [3 x 3], and its transpose off the diagonal. */
static void add_block(double *K, int n, int i, int j, const double A[9])
{
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            K[(i + k) * n + j + l] += A[3 * k + l];
            if (i != j)
                K[(j + l) * n + i + k] += A[3 * k + l];
        }
}

/* From the nodes' quaternions to the variables. */
static void gather(const stages *s, const double x[3], const sums *a, stages_derivatives *out)
{
    const int n = a->all, last = s->stages;
    double *K = out->hessian;
    for (int k = 0; k <= last; k++) {
        const int row = variables(s, k);
        double block[9] = {0}, curved[9] = {0}, along = 0;
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 4; i++)
                out->gradient[row + j] += a->T[k][3 * i + j] * a->g[k][i];
        dense_add_transpose_mul(3, 4, 3, a->Y[k], a->T[k], block);
        add_block(K, n, 0, row, block);
        for (int i = 0; i < 4; i++)
            along += a->g[k][i] * a->q[k][i];
        if (k == 0 || k == last)
            end_second(x, k == 0 ? -1 : 1, a->q[k], a->g[k], curved);
        else
            for (int i = 0; i < 3; i++)
                curved[4 * i] = -along / 4;
        add_block(K, n, row, row, curved);
        for (int l = k; l <= last; l++) {
            const int column = variables(s, l);
            double XT[12], product[9] = {0}, both[9];
            dense_mul(4, 4, 3, a->X[k][l], a->T[l], XT);
            dense_add_transpose_mul(3, 4, 3, a->T[k], XT, product);
            if (k != l && row == column) { /* the two ends share their variables */
                for (int i = 0; i < 9; i++)
                    both[i] = product[i] + product[3 * (i % 3) + i / 3];
                add_block(K, n, row, row, both);
            } else {
                add_block(K, n, row, column, product);
            }
        }
    }
}

static void add_warping(const stages *s, const sums *a, stages_derivatives *out)
{
    const int n = a->all, m = s->stages + 3;
    double Sz[WARPING_MAX], work[WARPING_MAX * STAGES_ALL];
    dense_mul_vec(m, m, s->S, a->z, Sz);
    for (int i = 0; i < m; i++)
        out->P += a->z[i] * Sz[i] / 2;
    /* the stages' part of the gradient is in the points' already */
    out->gradient[3] += Sz[s->stages + 2];
    out->gradient[s->unknowns + 6] += Sz[s->stages];
    out->gradient[s->unknowns + 7] += Sz[s->stages + 1];
    dense_add_congruence(m, n, a->dz, s->S, out->hessian, work);
}

static status add_points(const stages *s, const double force[3], const point p[], const double torque[], sums *a,
                         stages_derivatives *out)
{
    for (int i = 0; i < s->stages; i++) {
        double kappa[3], gradient[6], M[36], D[6][SPACE], H[SPACE][SPACE], slope[SPACE];
        for (int j = 0; j < 3; j++)
            kappa[j] = p[i].kappa[j] - s->rest_kappa[i][j];
        out->P += s->w[i] * material(&s->c, kappa, p[i].v, torque[i], gradient, M);
        rows_of_point(&p[i], D);
        hessian_of_point(&p[i], gradient, M, s->w[i], D, H);
        for (int j = 0; j < SPACE; j++) {
            slope[j] = 0;
            for (int k = 0; k < 6; k++)
                slope[j] += s->w[i] * gradient[k] * D[k][j];
        }
        add_point(s->N[i], s->dN[i], slope, H, a);
        if (s->warps)
            warping_row(s, i, D, a);
    }
    (void)force;
    return STATUS_OK;
}

status stages_evaluate(const stages *s, const double e[], const double inner[], stages_derivatives *out)
{
    const int last = s->stages, n = s->unknowns + STAGES_OUTER;
    double v[3], x[3], torque[STAGES_MAX] = {0}, Sz[WARPING_MAX];
    point p[STAGES_MAX];
    sums a;
    memset(&a, 0, sizeof a);
    memset(out, 0, sizeof *out);
    a.nodes = last + 1;
    a.all = n;
    for (int i = 0; i < 3; i++) {
        v[i] = s->rest_v[i] + e[i];
        x[i] = s->line.rest[0][3 + i] + e[3 + i];
    }
    end_quaternion(x, -1, a.q[0], a.T[0]);
    end_quaternion(x, 1, a.q[last], a.T[last]);
    for (int k = 1; k < last; k++) {
        memcpy(a.q[k], &inner[4 * k], sizeof a.q[k]);
        point_turn(a.q[k], a.T[k]);
        for (int i = 0; i < 12; i++)
            a.T[k][i] /= 2;
    }
    for (int i = 0; i < last; i++) {
        point_at(a.nodes, a.q[0], s->N[i], s->dN[i], inner, &p[i]);
        if (!(p[i].m > 0.3))
            return STATUS_NOT_CONVERGED;
        a.z[i] = p[i].kappa[0] - s->rest_kappa[i][0] - s->c.F[6] * p[i].v[1] - s->c.F[7] * p[i].v[2];
    }
    if (s->warps) {
        a.z[last] = e[6];
        a.z[last + 1] = e[7];
        a.z[last + 2] = inner[3];
        a.dz[last * n + s->unknowns + 6] = a.dz[(last + 1) * n + s->unknowns + 7] = a.dz[(last + 2) * n + 3] = 1;
        dense_mul_vec(last + 3, last + 3, s->S, a.z, Sz);
        for (int i = 0; i < last; i++)
            torque[i] = Sz[i] / s->w[i];
    }
    add_points(s, inner, p, torque, &a, out);
    gather(s, x, &a, out);
    out->P += vec3_dot(inner, v);
    for (int i = 0; i < 3; i++) {
        out->gradient[i] += a.gF[i] + v[i];
        out->gradient[s->unknowns + i] += inner[i];
        out->hessian[i * n + s->unknowns + i] += 1;
        out->hessian[(s->unknowns + i) * n + i] += 1;
        for (int j = 0; j < 3; j++)
            out->hessian[i * n + j] += a.FF[3 * i + j];
    }
    if (s->warps)
        add_warping(s, &a, out);
    else
        out->hessian[3 * n + 3] = 1; /* no bimoment */
    return STATUS_OK;
}

status stages_prepare(const element_request *request, int count, stages *out, fault *f)
{
    double x[STAGES_MAX], at[STAGES_NODES];
    const double pi = 3.14159265358979323846, none[3] = {0};
    memset(out, 0, sizeof *out);
    const status outcome = constants_of(request, &out->c, f);
    if (outcome != STATUS_OK)
        return outcome;
    out->stages = count;
    out->unknowns = 4 + 3 * (count - 1);
    strain_prepare(2, 1, request->length, request->curvature, 0, &out->line);
    line_gauss(count, x, out->w);
    /* Chebyshev's points: what the unit length at the nodes says of the points between them is spread evenly. */
    for (int k = 0; k <= count; k++) {
        double turn[3];
        at[k] = (1 - cos(pi * k / count)) / 2;
        for (int i = 0; i < 3; i++)
            turn[i] = request->curvature[i] * request->length * (at[k] - 0.5);
        rotation_exp(turn, out->rest_q[k]);
    }
    for (int i = 0; i < count; i++) {
        point p;
        line_lagrange(count + 1, at, x[i], out->N[i], out->dN[i]);
        point_at(count + 1, out->rest_q[0], out->N[i], out->dN[i], none, &p);
        memcpy(out->rest_kappa[i], p.kappa, sizeof p.kappa);
        for (int j = 0; j < 3; j++)
            out->rest_v[j] += out->w[i] * p.R[3 * j];
    }
    out->warps = out->c.warping && out->c.EIw > 0;
    if (out->warps)
        warping_energy(&out->c, count, x, out->w, out->S);
    return STATUS_OK;
}
