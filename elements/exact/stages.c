#include "elements/exact/stages.h"

#include <math.h>
#include <string.h>

#include "elements/exact/line.h"
#include "elements/exact/turn.h"
#include "elements/math/dense.h"

enum { TURN = 0, SLOPE = 3, F = 6, SPACE = 9 }; /* a point's variables: x, x' and F */

/* One Gauss point in the present state. */
typedef struct stage {
    double x[3], slope[3], kappa[3], N[3];
    turn_form orientation, curvature;
} stage;

/* Sums over the points in terms of x at the nodes. */
typedef struct sums {
    double g[STAGES_NODES][3];               /* gradient */
    double X[STAGES_NODES][STAGES_NODES][9]; /* second derivatives, l >= k only */
    double Y[STAGES_NODES][9];               /* with F */
    double FF[9], gF[3];
    double z[WARPING_MAX], dz[WARPING_MAX * STAGES_ALL]; /* arguments of the warping energy and their derivatives */
} sums;

/* x at node k is `factor` times the variables from `first` on: its own, or 2 X. */
static int variables(const stages *s, int k, double *factor)
{
    const int end = k == 0 || k == s->stages;
    *factor = !end ? 1 : k == 0 ? -0.5 : 0.5;
    return end ? s->unknowns + 3 : 4 + 3 * (k - 1);
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

/* Derivatives of kappa and N with respect to (x, x', F). */
static void rows_of_point(const stage *p, const double force[3], double D[6][SPACE])
{
    memset(D, 0, 6 * sizeof *D);
    for (int i = 0; i < 3; i++) {
        double unit[3] = {0};
        unit[i] = 1;
        turn_gradient(&p->curvature, p->x, unit, p->slope, &D[i][TURN], &D[i][SLOPE]);
        turn_gradient(&p->orientation, p->x, unit, force, &D[3 + i][TURN], &D[3 + i][F]);
    }
}

/* w (D^T M D + second derivatives of kappa and N contracted with `gradient`). */
static void hessian_of_point(const stage *p, const double force[3], const double gradient[6], const double M[36], double w,
                             double D[6][SPACE], double H[SPACE][SPACE])
{
    double MD[6][SPACE], PP[9] = {0}, PS[9] = {0}, PF[9] = {0};
    turn_add_hessian(&p->curvature, p->x, gradient, p->slope, PP, PS);
    turn_add_hessian(&p->orientation, p->x, gradient + 3, force, PP, PF);
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
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            H[TURN + i][TURN + j] += w * PP[3 * i + j];
            H[TURN + i][SLOPE + j] += w * PS[3 * i + j];
            H[SLOPE + j][TURN + i] += w * PS[3 * i + j];
            H[TURN + i][F + j] += w * PF[3 * i + j];
            H[F + j][TURN + i] += w * PF[3 * i + j];
        }
}

static void add_point(int nodes, const double N[], const double dN[], const double gradient[SPACE], double H[SPACE][SPACE], sums *a)
{
    for (int l = 0; l < nodes; l++) {
        double turn[9], slope[9];
        for (int i = 0; i < 3; i++) {
            a->g[l][i] += N[l] * gradient[TURN + i] + dN[l] * gradient[SLOPE + i];
            for (int j = 0; j < 3; j++) {
                turn[3 * i + j] = H[TURN + i][TURN + j] * N[l] + H[TURN + i][SLOPE + j] * dN[l];
                slope[3 * i + j] = H[SLOPE + i][TURN + j] * N[l] + H[SLOPE + i][SLOPE + j] * dN[l];
                a->Y[l][3 * i + j] += N[l] * H[TURN + i][F + j] + dN[l] * H[SLOPE + i][F + j];
            }
        }
        for (int k = 0; k <= l; k++)
            for (int i = 0; i < 9; i++)
                a->X[k][l][i] += N[k] * turn[i] + dN[k] * slope[i];
    }
    for (int i = 0; i < 3; i++) {
        a->gF[i] += gradient[F + i];
        for (int j = 0; j < 3; j++)
            a->FF[3 * i + j] += H[F + i][F + j];
    }
}

/* Row of the warping energy's argument at point i: kappa_x less the warping shear that Q_y and Q_z make. */
static void warping_row(const stages *s, int i, double D[6][SPACE], sums *a)
{
    double row[SPACE], *dz = &a->dz[i * (s->unknowns + STAGES_OUTER)];
    for (int j = 0; j < SPACE; j++)
        row[j] = D[0][j] - s->c.F[6] * D[4][j] - s->c.F[7] * D[5][j];
    for (int k = 0; k <= s->stages; k++) {
        double factor;
        const int first = variables(s, k, &factor);
        for (int j = 0; j < 3; j++)
            dz[first + j] += factor * (s->N[i][k] * row[TURN + j] + s->dN[i][k] * row[SLOPE + j]);
    }
    for (int j = 0; j < 3; j++)
        dz[j] += row[F + j];
}

/* From x at the nodes to the variables. */
static void gather(const stages *s, const sums *a, stages_derivatives *out)
{
    const int n = s->unknowns + STAGES_OUTER;
    double *K = out->hessian, row_factor, column_factor;
    for (int k = 0; k <= s->stages; k++) {
        const int row = variables(s, k, &row_factor);
        for (int i = 0; i < 3; i++) {
            out->gradient[row + i] += row_factor * a->g[k][i];
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
        out->gradient[i] += a->gF[i];
        for (int j = 0; j < 3; j++)
            K[i * n + j] += a->FF[3 * i + j];
    }
}

/* Arguments of the warping energy and its gradient with respect to them. */
static void warping_arguments(const stages *s, const double e[], double multiplier, const stage p[], sums *a, double Sz[])
{
    const int m = s->stages, n = s->unknowns + STAGES_OUTER;
    for (int i = 0; i < m; i++)
        a->z[i] = p[i].kappa[0] - s->c.F[6] * p[i].N[1] - s->c.F[7] * p[i].N[2];
    a->z[m] = e[6];
    a->z[m + 1] = e[7];
    a->z[m + 2] = multiplier;
    a->dz[m * n + s->unknowns + 6] = a->dz[(m + 1) * n + s->unknowns + 7] = a->dz[(m + 2) * n + 3] = 1;
    dense_mul_vec(m + 3, m + 3, s->S, a->z, Sz);
}

static void add_warping(const stages *s, const sums *a, const double Sz[], stages_derivatives *out)
{
    const int n = s->unknowns + STAGES_OUTER, m = s->stages + 3;
    double work[WARPING_MAX * STAGES_ALL];
    for (int i = 0; i < m; i++)
        out->P += a->z[i] * Sz[i] / 2;
    /* the points' part of the gradient is there already */
    out->gradient[s->unknowns + 6] += Sz[s->stages];
    out->gradient[s->unknowns + 7] += Sz[s->stages + 1];
    out->gradient[3] += Sz[s->stages + 2];
    dense_add_congruence(m, n, a->dz, s->S, out->hessian, work);
}

static void stage_at(const stages *s, int i, const double x[], const double force[3], stage *p)
{
    for (int j = 0; j < 3; j++) {
        p->x[j] = p->slope[j] = 0;
        for (int k = 0; k <= s->stages; k++) {
            p->x[j] += s->N[i][k] * x[3 * k + j];
            p->slope[j] += s->dN[i][k] * x[3 * k + j];
        }
    }
    turn_forms(vec3_dot(p->x, p->x), &p->orientation, &p->curvature);
    turn_vector(&p->curvature, p->x, p->slope, p->kappa);
    turn_vector(&p->orientation, p->x, force, p->N);
    for (int j = 0; j < 3; j++)
        p->kappa[j] -= s->rest_kappa[i][j];
}

/* Without bimoments: no multiplier, and amplitudes, if there are any, that nothing depends on. */
static void no_warping(const stages *s, const double e[], stages_derivatives *out)
{
    const int n = s->unknowns + STAGES_OUTER;
    out->hessian[3 * n + 3] = 1;
    for (int i = s->unknowns + 6; i < n && s->c.warping; i++) {
        out->hessian[i * (n + 1)] = s->c.GJ;
        out->gradient[i] = s->c.GJ * e[i - s->unknowns];
        out->P += s->c.GJ * e[i - s->unknowns] * e[i - s->unknowns] / 2;
    }
}

void stages_evaluate(const stages *s, const double e[], const double inner[], stages_derivatives *out)
{
    const int last = s->stages, n = s->unknowns + STAGES_OUTER;
    double x[STAGES_NODES][3], torque[WARPING_MAX] = {0};
    stage p[STAGES_MAX];
    sums a;
    memset(&a, 0, sizeof a);
    memset(out, 0, sizeof *out);
    memcpy(x[1], inner + 4, 3 * (size_t)(last - 1) * sizeof(double));
    for (int i = 0; i < 3; i++) {
        x[last][i] = (s->line.rest[0][3 + i] + e[3 + i]) / 2;
        x[0][i] = -x[last][i];
    }
    for (int i = 0; i < last; i++)
        stage_at(s, i, x[0], inner, &p[i]);
    if (s->warps)
        warping_arguments(s, e, inner[3], p, &a, torque);
    for (int i = 0; i < last; i++) {
        double gradient[6], M[36], D[6][SPACE], H[SPACE][SPACE], slope[SPACE] = {0};
        out->P += s->w[i] * material(&s->c, p[i].kappa, p[i].N, torque[i] / s->w[i], gradient, M);
        rows_of_point(&p[i], inner, D);
        hessian_of_point(&p[i], inner, gradient, M, s->w[i], D, H);
        for (int j = 0; j < SPACE; j++)
            for (int k = 0; k < 6; k++)
                slope[j] += s->w[i] * gradient[k] * D[k][j];
        add_point(last + 1, s->N[i], s->dN[i], slope, H, &a);
        if (s->warps)
            warping_row(s, i, D, &a);
    }
    gather(s, &a, out);
    for (int i = 0; i < 3; i++) {
        const double v = s->rest_v[i] + e[i];
        out->P += inner[i] * v;
        out->gradient[i] += v;
        out->gradient[s->unknowns + i] += inner[i];
        out->hessian[i * n + s->unknowns + i] += 1;
        out->hessian[(s->unknowns + i) * n + i] += 1;
    }
    if (s->warps)
        add_warping(s, &a, torque, out);
    else
        no_warping(s, e, out);
}

status stages_prepare(const element_request *request, int count, stages *out, fault *f)
{
    double point[STAGES_MAX], at[STAGES_NODES];
    const double pi = 3.14159265358979323846;
    memset(out, 0, sizeof *out);
    const status outcome = constants_of(request, &out->c, f);
    if (outcome != STATUS_OK)
        return outcome;
    out->stages = count;
    out->unknowns = 4 + 3 * (count - 1);
    strain_prepare(2, 1, request->length, request->curvature, STRAIN_EIGHTH, &out->line);
    line_gauss(count, point, out->w);
    const double turn = vec3_norm(request->curvature) * request->length;
    for (int k = 0; k <= count; k++) {
        at[k] = (1 - cos(pi * k / count)) / 2; /* any distinct points would do: Chebyshev's keep the numbers of a size */
        const double length = turn > 0 ? 4 * tan(turn * (at[k] - 0.5) / 4) / turn : 0;
        for (int i = 0; i < 3; i++)
            out->rest_x[k][i] = request->curvature[i] * request->length * length;
    }
    for (int i = 0; i < count; i++) {
        stage p;
        double axis[3];
        const double unit[3] = {1, 0, 0};
        line_lagrange(count + 1, at, point[i], out->N[i], out->dN[i]);
        stage_at(out, i, out->rest_x[0], unit, &p);
        memcpy(out->rest_kappa[i], p.kappa, sizeof p.kappa);
        for (int j = 0; j < 3; j++)
            p.x[j] = -p.x[j];
        turn_vector(&p.orientation, p.x, unit, axis); /* R e_x */
        for (int j = 0; j < 3; j++)
            out->rest_v[j] += out->w[i] * axis[j];
    }
    out->warps = out->c.warping && out->c.EIw > 0;
    if (out->warps)
        warping_energy(&out->c, count, point, out->w, out->S);
    return STATUS_OK;
}
