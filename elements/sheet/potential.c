/* A_ij = int [(Mx_i + B_i')(Mx_j + B_j')/GJ + B_i B_j/EIw + My_i My_j/EIy + Mz_i Mz_j/EIz + Fx_i Fx_j/EA + Fz_i Fz_j/kGA] ds
 * b_i  = int [(Mx_i + B_i') phi_x' + B_i phi_x'' + My_i phi_x u_y'' + Mz_i u_y'' - (Mx_i + B_i') B_0'/GJ - B_i B_0/EIw] ds
 *        + (u + int u_y'^2/2 for F~x, yp for M~yp, yq for M~yq)
 * P0   = int [B_0' phi_x' + B_0 phi_x'' - B_0'^2/2GJ - B_0^2/2EIw + c phi_x'^4] ds
 * with Mx of N Eq. 49 (its sign of u_y corrected unless printed). */
#include "elements/sheet/potential.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/quadrature.h"
#include "elements/sheet/bimoment.h"

const int potential_local[AFFINE] = {-1, LOCAL_PX, LOCAL_ZP, LOCAL_ZQ, LOCAL_WP, LOCAL_WQ};

/* Unit-stress fields at one point, affine in (1, px, zp, zq, Wp, Wq). */
typedef struct unit_fields {
    double T[STRESSES][AFFINE]; /* Mx + B' */
    double B[STRESSES][AFFINE];
    double My[STRESSES], Mz[STRESSES][AFFINE];
    double B0[AFFINE], B01[AFFINE]; /* part of B due to Wp, Wq, and its derivative */
} unit_fields;

typedef struct stiffnesses {
    double L, GJ, EIw, EIy, EIz, EA, fz, lambda;
    int warps, printed;
} stiffnesses;

static void moment_bimoments(const stiffnesses *k, double x, unit_fields *u)
{
    static const bimoment_load corrected[2][2] = {{{6, -10, 4, -1, 0}, {6, -8, 2, 0, 0}}, {{6, -4, 0, 0, 0}, {6, -2, 0, 0, 1}}};
    static const bimoment_load printed[2][2] = {{{12, -18, 6, -1, 0}, {12, -12, 2, 0, 0}}, {{12, -12, 2, 0, 0}, {12, -6, 0, 0, 1}}};
    for (int n = 0; n < 2; n++)
        for (int j = 0; j < 2; j++) {
            double b, db;
            bimoment_moment(k->lambda, k->printed ? &printed[n][j] : &corrected[n][j], x, &b, &db);
            u->B[2 + n][2 + j] = k->L * b;
            u->T[2 + n][2 + j] += db;
        }
}

static void unit_fields_at(const stiffnesses *k, double x, double f[FIELD_COUNT][LOCALS], unit_fields *u)
{
    const double sign = k->printed ? 1 : -1, shape[2] = {x - 1, x};
    memset(u, 0, sizeof *u);
    u->T[1][0] = 1;
    u->My[2] = shape[0];
    u->My[3] = shape[1];
    u->Mz[4][0] = shape[0];
    u->Mz[5][0] = shape[1];
    for (int a = 1; a < AFFINE; a++) {
        const int local = potential_local[a];
        u->Mz[0][a] = f[FIELD_UY][local];
        for (int n = 0; n < 2; n++) {
            u->T[2 + n][a] = sign * f[FIELD_UY][local] / k->L + f[FIELD_UY1][local] * shape[n];
            u->Mz[2 + n][a] = -f[FIELD_PX][local] * shape[n];
        }
    }
    if (!k->warps)
        return;
    bimoment_values v;
    bimoment_functions(k->lambda, x, &v);
    u->B[1][0] = k->L * v.torque;
    u->T[1][0] += v.dtorque;
    moment_bimoments(k, x, u);
    const double unit = k->L * k->GJ / k->lambda;
    u->B0[4] = -unit * v.c2;
    u->B0[5] = unit * v.c1;
    u->B01[4] = -unit * v.dc2 / k->L;
    u->B01[5] = unit * v.dc1 / k->L;
}

/* target[local a][local b] += w * p_a q_b, symmetrised as second derivatives; p affine in y, q linear in x. */
static void add_product(double target[LOCALS][LOCALS], double linear[LOCALS], double w, const double p[AFFINE],
                        const double q[LOCALS])
{
    for (int b = 0; b < LOCALS; b++) {
        if (linear != NULL)
            linear[b] += w * p[0] * q[b];
        for (int a = 1; a < AFFINE; a++) {
            target[potential_local[a]][b] += w * p[a] * q[b];
            target[b][potential_local[a]] += w * p[a] * q[b];
        }
    }
}

static void add_compliance(const stiffnesses *k, const unit_fields *u, double w, potential *out)
{
    for (int i = 0; i < STRESSES; i++)
        for (int j = 0; j < STRESSES; j++)
            for (int a = 0; a < AFFINE; a++)
                for (int b = 0; b < AFFINE; b++) {
                    double sum = u->T[i][a] * u->T[j][b] / k->GJ + u->Mz[i][a] * u->Mz[j][b] / k->EIz;
                    if (k->warps)
                        sum += u->B[i][a] * u->B[j][b] / k->EIw;
                    if (a == 0 && b == 0)
                        sum += u->My[i] * u->My[j] / k->EIy;
                    out->A[i][j][a][b] += w * sum; /* second derivatives: symmetric in a and b */
                    out->A[i][j][b][a] += w * sum;
                }
}

static void add_work(const stiffnesses *k, const unit_fields *u, double f[FIELD_COUNT][LOCALS], double w, potential *out)
{
    double px[AFFINE] = {0}, B0[LOCALS] = {0}, B01[LOCALS] = {0};
    for (int a = 1; a < AFFINE; a++) {
        px[a] = f[FIELD_PX][potential_local[a]];
        B0[potential_local[a]] = u->B0[a];
        B01[potential_local[a]] = u->B01[a];
    }
    for (int i = 0; i < STRESSES; i++) {
        double bend[AFFINE];
        for (int a = 0; a < AFFINE; a++)
            bend[a] = u->Mz[i][a] + u->My[i] * px[a];
        add_product(out->b[i], out->b_linear[i], w, u->T[i], f[FIELD_PX1]);
        add_product(out->b[i], out->b_linear[i], w, bend, f[FIELD_UY2]);
        add_product(out->b[i], out->b_linear[i], -w / k->GJ, u->T[i], B01);
        if (k->warps) {
            add_product(out->b[i], out->b_linear[i], w, u->B[i], f[FIELD_PX2]);
            add_product(out->b[i], out->b_linear[i], -w / k->EIw, u->B[i], B0);
        }
    }
    for (int a = 0; a < LOCALS; a++)
        for (int b = 0; b < LOCALS; b++) {
            out->b[0][a][b] += w * f[FIELD_UY1][a] * f[FIELD_UY1][b];
            if (k->warps)
                out->P0[a][b] += w * (B01[a] * f[FIELD_PX1][b] + f[FIELD_PX1][a] * B01[b] + B0[a] * f[FIELD_PX2][b] +
                                      f[FIELD_PX2][a] * B0[b] - B01[a] * B01[b] / k->GJ - B0[a] * B0[b] / k->EIw);
        }
}

static status add_wagner(const element_request *request, int warps, potential *out, fault *f)
{
    double x[5], w[5], field[FIELD_COUNT][LOCALS];
    const status made = quadrature_points(5, x, w, f);
    for (int i = 0; i < 5 && made == STATUS_OK; i++) {
        relations_fields(request->length, 0, 0, warps, x[i], field);
        out->wagner_weight[i] = w[i] * request->length * request->section->young * request->section->wagner_torque;
        out->wagner[i][0] = field[FIELD_PX1][LOCAL_PX];
        out->wagner[i][1] = field[FIELD_PX1][LOCAL_WP];
        out->wagner[i][2] = field[FIELD_PX1][LOCAL_WQ];
    }
    return made;
}

status potential_prepare(const element_request *request, int printed, potential *out, fault *f)
{
    const section *c = request->section;
    double x[QUADRATURE_MAX_GRADED], w[QUADRATURE_MAX_GRADED];
    int n = 0;
    stiffnesses k = {.L = request->length,
                     .GJ = c->shear_modulus * c->It,
                     .EIw = c->young * c->Iw,
                     .EIy = c->young * c->Iy,
                     .EIz = c->young * c->Iz,
                     .EA = c->young * c->A,
                     .fz = request->features & FEATURE_SHEAR ? c->F[4] / c->shear_modulus : 0,
                     .printed = printed};
    memset(out, 0, sizeof *out);
    k.warps = (request->features & FEATURE_WARPING) != 0 && k.EIw > 0;
    k.lambda = k.warps ? k.L * sqrt(k.GJ / k.EIw) : 1;
    if (!(k.GJ > 0))
        return fault_set(f, STATUS_REFUSED, "section: G It = %g N m^2; this formulation needs a torsional stiffness", k.GJ);
    status made = quadrature_graded(k.warps ? fmin(0.25, 1 / k.lambda) : 0.25, &n, x, w, f);
    for (int i = 0; i < n && made == STATUS_OK; i++) {
        double field[FIELD_COUNT][LOCALS];
        unit_fields u;
        relations_fields(k.L, 0, 0, k.warps, x[i], field);
        unit_fields_at(&k, x[i], field, &u);
        add_compliance(&k, &u, w[i] * k.L, out);
        add_work(&k, &u, field, w[i] * k.L, out);
    }
    out->A[0][0][0][0] += 2 * k.L / k.EA;
    for (int i = 2; i < 4; i++)
        for (int j = 2; j < 4; j++)
            out->A[i][j][0][0] += 2 * k.fz / k.L;
    out->b_linear[0][LOCAL_U] += 1;
    out->b_linear[2][LOCAL_YP] += 1;
    out->b_linear[3][LOCAL_YQ] += 1;
    if (made == STATUS_OK && (request->features & FEATURE_WAGNER_TORQUE))
        made = add_wagner(request, k.warps, out, f);
    return made;
}

enum { PAIRS = STRESSES * (STRESSES + 1) / 2 };

/* A at y, and row[pair][a] = dA_ij/dy_a. */
static void evaluate_compliance(const potential *p, const double y[AFFINE], double A[STRESSES * STRESSES],
                                double row[PAIRS][AFFINE])
{
    for (int i = 0, k = 0; i < STRESSES; i++)
        for (int j = i; j < STRESSES; j++, k++) {
            double sum = 0;
            for (int a = 0; a < AFFINE; a++) {
                row[k][a] = 0;
                for (int b = 0; b < AFFINE; b++)
                    row[k][a] += p->A[i][j][a][b] * y[b];
                sum += row[k][a] * y[a];
            }
            A[STRESSES * i + j] = A[STRESSES * j + i] = sum / 2;
        }
}

/* As[a][i] = sum_j dA_ij/dy_a s_j;  sAs[a][b] = s^T d2A/dy_a dy_b s. */
static void compliance_derivatives(const potential *p, double row[PAIRS][AFFINE], const double s[STRESSES],
                                   double As[AFFINE][STRESSES], double sAs[AFFINE][AFFINE])
{
    memset(As, 0, AFFINE * sizeof As[0]);
    memset(sAs, 0, AFFINE * sizeof sAs[0]);
    for (int i = 0, k = 0; i < STRESSES; i++)
        for (int j = i; j < STRESSES; j++, k++) {
            const double both = (i == j ? 1 : 2) * s[i] * s[j];
            for (int a = 1; a < AFFINE; a++) {
                As[a][i] += row[k][a] * s[j];
                As[a][j] += i == j ? 0 : row[k][a] * s[i];
                for (int b = 0; b < AFFINE; b++)
                    sAs[a][b] += both * p->A[i][j][a][b];
            }
        }
}

static void add_wagner_terms(const potential *p, const double x[LOCALS], double *P, double g[LOCALS], double h[LOCALS * LOCALS])
{
    static const int local[3] = {LOCAL_PX, LOCAL_WP, LOCAL_WQ};
    for (int q = 0; q < 5; q++) {
        const double w = p->wagner_weight[q];
        double twist = 0;
        for (int i = 0; i < 3; i++)
            twist += p->wagner[q][i] * x[local[i]];
        *P += w * twist * twist * twist * twist;
        for (int i = 0; i < 3; i++) {
            g[local[i]] += 4 * w * twist * twist * twist * p->wagner[q][i];
            for (int j = 0; j < 3; j++)
                h[LOCALS * local[i] + local[j]] += 12 * w * twist * twist * p->wagner[q][i] * p->wagner[q][j];
        }
    }
}

/* P = P0 + b.s - s^T A s/2 with A s = b:  P,k = P0,k + s.b,k - s^T A,k s/2,
 * P,kl = P0,kl + s.b,kl - s^T A,kl s/2 + (b,k - A,k s)^T A^-1 (b,l - A,l s). */
status potential_evaluate(const potential *p, const double x[LOCALS], double *P, double g[LOCALS], double h[LOCALS * LOCALS])
{
    double y[AFFINE] = {1}, A[STRESSES * STRESSES], b1[STRESSES][LOCALS], s[STRESSES], b[STRESSES], As[AFFINE][STRESSES],
           sAs[AFFINE][AFFINE], row[PAIRS][AFFINE];
    for (int a = 1; a < AFFINE; a++)
        y[a] = x[potential_local[a]];
    evaluate_compliance(p, y, A, row);
    for (int i = 0; i < STRESSES; i++) {
        double half = 0, linear = 0;
        for (int k = 0; k < LOCALS; k++) {
            double slope = 0;
            for (int m = 0; m < LOCALS; m++)
                slope += p->b[i][k][m] * x[m];
            b1[i][k] = p->b_linear[i][k] + slope;
            half += slope * x[k] / 2;
            linear += p->b_linear[i][k] * x[k];
        }
        s[i] = b[i] = linear + half;
    }
    if (dense_cholesky(STRESSES, A) != 0)
        return STATUS_SINGULAR;
    dense_cholesky_solve(STRESSES, 1, A, s);
    compliance_derivatives(p, row, s, As, sAs);

    double R[STRESSES][LOCALS], AR[STRESSES][LOCALS];
    memcpy(R, b1, sizeof R);
    *P = 0;
    for (int i = 0; i < STRESSES; i++)
        *P += b[i] * s[i] / 2;
    for (int k = 0; k < LOCALS; k++) {
        double P0x = 0, sb = 0;
        for (int m = 0; m < LOCALS; m++)
            P0x += p->P0[k][m] * x[m];
        for (int i = 0; i < STRESSES; i++)
            sb += s[i] * b1[i][k];
        g[k] = P0x + sb;
        *P += P0x * x[k] / 2;
        for (int m = 0; m < LOCALS; m++) {
            double sum = p->P0[k][m];
            for (int i = 0; i < STRESSES; i++)
                sum += s[i] * p->b[i][k][m];
            h[LOCALS * k + m] = sum;
        }
    }
    for (int a = 1; a < AFFINE; a++) {
        const int k = potential_local[a];
        for (int i = 0; i < STRESSES; i++) {
            g[k] -= s[i] * As[a][i] / 2;
            R[i][k] -= As[a][i];
        }
        for (int c = 1; c < AFFINE; c++)
            h[LOCALS * k + potential_local[c]] -= sAs[a][c] / 2;
    }
    memcpy(AR, R, sizeof R);
    dense_cholesky_solve(STRESSES, LOCALS, A, &AR[0][0]);
    dense_add_transpose_mul(LOCALS, STRESSES, LOCALS, &R[0][0], &AR[0][0], h);
    add_wagner_terms(p, x, P, g, h);
    return STATUS_OK;
}
