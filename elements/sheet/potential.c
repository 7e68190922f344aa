#include "elements/sheet/potential.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/sheet/sheet.h"

enum { N = SHEET_LOCAL_COORDINATES, V = 1 + N };

status sheet_potential_evaluate(const sheet_potential *p, const double x[N], double *P,
                                double *gradient, double *hessian)
{
    return sheet_stationary_evaluate(p, x, P, gradient, hessian) ? STATUS_OK : STATUS_SINGULAR;
}

/* With s_k = A^-1 W_k, W_k = b,k - A,k s, and a direction d: P,kld = s_d.(b,kl - A,kl s) +
 * s_l.W_k,d + s_k.W_l,d - s_k^T A,d s_l, where W_k,d = b,kd - A,kd s - A,k s_d. */
status sheet_potential_third(const sheet_potential *p, const double x[N], const double dx[N],
                             double T[N * N])
{
    sheet_stationary at;
    double g[V] = {0}, h[V * V] = {0}, d[V] = {0}, sd[SHEET_STRESSES] = {0}, S[SHEET_STRESSES][V],
           Wd[SHEET_STRESSES][V] = {{0}}, Ad[SHEET_STRESSES][SHEET_STRESSES] = {{0}};
    if (!sheet_stationary_solve(p, x, &at))
        return STATUS_SINGULAR;
    sheet_stationary_add_explicit(p, &at, g, h);
    memcpy(d + 1, dx, N * sizeof *d);
    memcpy(S, at.W, sizeof S);
    dense_cholesky_solve(SHEET_STRESSES, V, at.L, &S[0][0]);
    for (int i = 0; i < SHEET_STRESSES; i++)
        for (int a = 0; a < V; a++)
            sd[i] += S[i][a] * d[a];
    memset(h, 0, sizeof h);
    for (int k = 0; k < p->terms_b; k++) {
        const sheet_potential_term *t = &p->b[k];
        h[V * t->a + t->b] += t->c * sd[t->i];
        h[V * t->b + t->a] += t->c * sd[t->i];
        Wd[t->i][t->a] += t->c * d[t->b];
        Wd[t->i][t->b] += t->c * d[t->a];
    }
    for (int k = 0; k < p->terms_A; k++) {
        const sheet_potential_term *t = &p->A[k];
        const double c = t->i == t->j ? t->c / 2 : t->c, va = at.v[t->a], vb = at.v[t->b],
                     da = d[t->a], db = d[t->b];
        const double si = at.s[t->i], sj = at.s[t->j], di = sd[t->i], dj = sd[t->j],
                     along = c * (va * db + vb * da), work = c * (si * dj + sj * di);
        h[V * t->a + t->b] -= work;
        h[V * t->b + t->a] -= work;
        Wd[t->i][t->a] -= c * (db * sj + vb * dj);
        Wd[t->j][t->a] -= c * (db * si + vb * di);
        Wd[t->i][t->b] -= c * (da * sj + va * dj);
        Wd[t->j][t->b] -= c * (da * si + va * di);
        Ad[t->i][t->j] += along;
        Ad[t->j][t->i] += along;
    }
    for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++) {
            double sum = h[V * (k + 1) + l + 1];
            for (int i = 0; i < SHEET_STRESSES; i++) {
                sum += S[i][k + 1] * Wd[i][l + 1] + S[i][l + 1] * Wd[i][k + 1];
                for (int j = 0; j < SHEET_STRESSES; j++)
                    sum -= S[i][k + 1] * Ad[i][j] * S[j][l + 1];
            }
            T[N * k + l] = sum;
        }
    return STATUS_OK;
}

/* Coefficients of the potential:
 *   A_ij = int [(Mx_i + B_i')(Mx_j + B_j')/GJ + B_i B_j/EIw + My_i My_j/EIy + Mz_i Mz_j/EIz
 *               + Fx_i Fx_j/EA + Fz_i Fz_j/kGA] ds,
 *   b_i = int [(Mx_i + B_i')(phi_x' - k0) + B_i (phi_x' - k0)' + My_i phi_x u_y'' + Mz_i u_y''
 *               - (Mx_i + B_i') kx - My_i ky - Mz_i kz] ds
 *          + (u + int u_y'^2/2 for F~x, yp for M~yp, yq for M~yq),
 *   P0 = int [B_0' phi_x' + B_0 phi_x'' - B_0'^2/2GJ - B_0^2/2EIw - B_0' kx] ds,
 * where Mx, Mz are given by N Eq. 49. B_0 = EIw k0' is the bimoment due to the twist rates of the
 * ends, k0(0) = Wp and k0(L) = Wq. kx, ky, kz are the initial torsion and curvatures (N Eq. 52).
 * Integration by parts, with the twist rates of sheet.h, gives
 *   int [(Mx_i + B_i')(Mx_j + B_j')/GJ + B_i B_j/EIw] ds = (L/GJ) lambda^2 int Mx_i g_j dx,
 *   int [(Mx_i + B_i')(phi_x' - k0) + B_i (phi_x' - k0)'] ds = L int Mx_i (phi_x' - k0) dx,
 *   P0 = (EIw/2L) int (lambda^2 k0^2 + k0'^2) dx - kx EIw [k0'].
 * My_i phi_x u_y'' cancels the same term of Mz_i u_y''. */

/* Variables on which the stress fields depend linearly, as indices of v. */
enum {
    ONE,
    PX = 1 + SHEET_LOCAL_PX,
    ZP = 1 + SHEET_LOCAL_ZP,
    ZQ = 1 + SHEET_LOCAL_ZQ,
    WP = 1 + SHEET_LOCAL_WP,
    WQ = 1 + SHEET_LOCAL_WQ
};
enum { FX, MX, MYP, MYQ, MZP, MZQ };
enum { POINTS = 5 }; /* exact for (phi_x (x - 1))^2, which has degree 8 */

typedef struct sums {
    double A[SHEET_STRESSES][SHEET_STRESSES][V][V], b[SHEET_STRESSES][V][V], P0[V][V];
} sums;

/* Modes of the torque M_x: M~x, and M~yn z_j times -+ u_y/L + u_y' (x - 1 or x), where u_y = L [x
 * (1-x)^2 zp - x^2 (1-x) zq]. */
static const struct {
    int stress, variable;
} mode[SHEET_TORSION_MODES] = {{MX, ONE}, {MYP, ZP}, {MYP, ZQ}, {MYQ, ZP}, {MYQ, ZQ}};
static const double corrected_torque[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1] = {
    {1}, {-1, 4, -5, 2}, {0, 2, -4, 2}, {0, 0, -2, 2}, {0, 0, -1, 2}};
static const double printed_torque[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1] = {
    {1}, {-1, 6, -9, 4}, {0, 2, -6, 4}, {0, 2, -6, 4}, {0, 0, -3, 4}};

static void add_bending(const element_request *r, double x, double ds, const sheet_fields *f,
                        sums *out)
{
    const section *c = r->section;
    const double EIz = c->young * c->Iz, EIy = c->young * c->Iy, shape[2] = {x - 1, x};
    const double My[SHEET_STRESSES] = {[MYP] = shape[0], [MYQ] = shape[1]};
    const int initial = (r->features & FEATURE_CURVATURE) != 0;
    double Mz[SHEET_STRESSES][V] = {[MZP] = {shape[0]}, [MZQ] = {shape[1]}};
    for (int k = 0; k < SHEET_LOCAL_COORDINATES; k++) {
        Mz[FX][1 + k] = f->uy[k];
        Mz[MYP][1 + k] = -f->phi_x[k] * shape[0];
        Mz[MYQ][1 + k] = -f->phi_x[k] * shape[1];
        for (int m = 0; m < SHEET_LOCAL_COORDINATES; m++)
            out->b[FX][1 + k][1 + m] -=
                ds * f->duy[k] * f->duy[m] / 2; /* integrand of int (u_y u_y'' + u_y'^2/2) ds */
    }
    for (int i = 0; i < SHEET_STRESSES; i++) {
        for (int j = 0; j < SHEET_STRESSES; j++) {
            out->A[i][j][ONE][ONE] += ds * My[i] * My[j] / EIy;
            for (int a = 0; a < V; a++)
                for (int b = 0; b < V && Mz[i][a] != 0; b++)
                    out->A[i][j][a][b] += ds * Mz[i][a] * Mz[j][b] / EIz;
        }
        if (initial)
            for (int a = 0; a < V; a++)
                out->b[i][ONE][a] -=
                    ds * (Mz[i][a] * r->curvature[2] + (a == ONE ? My[i] * r->curvature[1] : 0));
    }
    if (initial) { /* F_x = F~x and F_z = (M~yp + M~yq)/L; there is no F_y */
        out->b[FX][ONE][ONE] -= ds * r->strain[0];
        out->b[MYP][ONE][ONE] -= ds / r->length * r->strain[2];
        out->b[MYQ][ONE][ONE] -= ds / r->length * r->strain[2];
    }
}

static void add_torsion(const element_request *r,
                        const double t[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1], sums *out)
{
    const section *c = r->section;
    const double L = r->length, GJ = c->shear_modulus * c->It,
                 EIw = sheet_fields_warp(r) ? c->young * c->Iw : 0;
    const double kx = r->features & FEATURE_CURVATURE ? r->curvature[0] : 0;
    sheet_torsion_integrals integral;
    sheet_torsion_integrate(EIw > 0 ? L * sqrt(GJ / EIw) : INFINITY, t, &integral);
    for (int k = 0; k < SHEET_TORSION_MODES; k++) {
        double(*b)[V] = out->b[mode[k].stress];
        for (int l = 0; l < SHEET_TORSION_MODES; l++)
            out->A[mode[k].stress][mode[l].stress][mode[k].variable][mode[l].variable] +=
                L / GJ * integral.compliance[k][l];
        b[mode[k].variable][PX] += integral.work[k][SHEET_TORSION_PX];
        b[mode[k].variable][WP] += L * integral.work[k][SHEET_TORSION_WP];
        b[mode[k].variable][WQ] += L * integral.work[k][SHEET_TORSION_WQ];
        b[mode[k].variable][ONE] -= L * integral.compliance[k][0] * kx;
    }
    out->P0[WP][WP] = out->P0[WQ][WQ] = EIw / (2 * L) * integral.same;
    out->P0[WP][WQ] = EIw / L * integral.other;
    out->P0[ONE][WP] = out->P0[ONE][WQ] = -kx * EIw / L * (integral.same + integral.other);
}

/* Adds the energy of N Eq. 34 for W - px/L to the sums. The minimum of this energy is at Wp = Wq =
 * px/L, so that warping amplitudes that are requested although Iw = 0 are determined. */
static void add_idle_amplitudes(const element_request *r, sums *out)
{
    const double L = r->length, k = r->section->shear_modulus * r->section->It * L / 30;
    const double p[V] = {[WP] = 1, [PX] = -1 / L}, q[V] = {[WQ] = 1, [PX] = -1 / L};
    for (int a = 0; a < V; a++)
        for (int b = 0; b < V; b++)
            out->P0[a][b] += k * (2 * p[a] * p[b] + 2 * q[a] * q[b] - p[a] * q[b]);
}

static void append(int degree, sheet_potential_term terms[], int most, int *count, int i, int j,
                   double table[V][V])
{
    for (int a = 0; a < V; a++)
        for (int b = a; b < V; b++) {
            const double c = a == b ? table[a][a] : table[a][b] + table[b][a];
            if (c == 0 || (a != ONE) + (b != ONE) != degree)
                continue;
            assert(*count < most);
            (void)most;
            terms[(*count)++] = (sheet_potential_term){c, i, j, a, b};
        }
}

static void list_terms(sums *total, sheet_potential *out)
{
    int *const linear[3] = {&out->linear_A, &out->linear_b, &out->linear_P0},
               *const quadratic[3] = {&out->quadratic_A, &out->quadratic_b, &out->quadratic_P0};
    for (int degree = 0; degree <= 2; degree++) {
        for (int i = 0; i < SHEET_STRESSES; i++) {
            append(degree, out->b, SHEET_TERMS_B, &out->terms_b, i, 0, total->b[i]);
            for (int j = 0; j <= i; j++)
                append(degree, out->A, SHEET_TERMS_A, &out->terms_A, i, j, total->A[i][j]);
        }
        append(degree, out->P0, SHEET_TERMS_P0, &out->terms_P0, 0, 0, total->P0);
        const int ends[3] = {out->terms_A, out->terms_b, out->terms_P0};
        if (degree < 2)
            for (int k = 0; k < 3; k++)
                *(degree == 0 ? linear : quadratic)[k] = ends[k];
    }
}

status sheet_coefficients_prepare(const element_request *r, int printed, sheet_potential *out,
                                  fault *f)
{
    const section *c = r->section;
    const double L = r->length,
                 shear = r->features & FEATURE_SHEAR ? c->F[4] / c->shear_modulus : 0;
    const double(*torque)[SHEET_TORSION_DEGREE + 1] = printed ? printed_torque : corrected_torque;
    double x[POINTS], w[POINTS];
    sums total;
    memset(&total, 0, sizeof total);
    memset(out, 0, sizeof *out);
    if (!(c->shear_modulus * c->It > 0))
        return fault_set(f, STATUS_REFUSED,
                         "section: It = %g m^4, but the third-order element requires a torsional "
                         "stiffness; give a positive It",
                         c->It);
    quadrature_points(POINTS, x, w);
    for (int i = 0; i < POINTS; i++) {
        const sheet_fields at = sheet_fields_at(L, x[i], 0, 0, sheet_fields_warp(r));
        add_bending(r, x[i], w[i] * L, &at, &total);
    }
    add_torsion(r, torque, &total);
    if ((r->features & FEATURE_WARPING) && !sheet_fields_warp(r))
        add_idle_amplitudes(r, &total);
    total.A[FX][FX][ONE][ONE] += L / (c->young * c->A);
    total.A[MYP][MYP][ONE][ONE] += shear / L;
    total.A[MYQ][MYP][ONE][ONE] += shear / L;
    total.A[MYQ][MYQ][ONE][ONE] += shear / L;
    total.b[FX][ONE][1 + SHEET_LOCAL_U] += 1;
    total.b[MYP][ONE][1 + SHEET_LOCAL_YP] += 1;
    total.b[MYQ][ONE][1 + SHEET_LOCAL_YQ] += 1;
    total.b[MZP][ONE][ZP] += 1; /* int (x - 1) u_y'' ds */
    total.b[MZQ][ONE][ZQ] += 1;
    list_terms(&total, out);
    return STATUS_OK;
}
