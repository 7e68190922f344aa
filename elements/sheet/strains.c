/* The generalized strains are weighted integrals of the second-order strains of N Eq. 7,
 *   kx = phi_x' + phi_y' phi_z, ky = phi_y' + phi_z' phi_x, kz = phi_z' - phi_y' phi_x,
 *   gx = u_x' - phi_y (phi_y/2 + u_z') - phi_z (phi_z/2 - u_y') + Ite phi_x'^2/2,
 *   gy = gy0 + phi_x (phi_y + u_z'), gz = gz0 + phi_x (phi_z - u_y'),
 * with Ite = Ip/A, over the linear solution of N Eqs. 14-19:
 *   e1 = int gx, e2 = L int kx, e3 = int [(L-s) ky - gz], e4 = int [s ky + gz],
 *   e5 = int [(L-s) kz + gy], e6 = int [s kz - gy],
 *   e7 = L^2 Wp + L int phi_y' phi_z, e8 = L^2 Wq + L int phi_y' phi_z.
 * If Phi = 0, the strains are those of N Eq. 37, where the last term of e1 is misprinted with L^2
 * instead of L. */
#include "elements/sheet/sheet.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "elements/shared/beam_constants.h"
#include "elements/sheet/deformation.h"

/* With the antisymmetric cubic c = x - 3x^2 + 2x^3 and r = Phi/(2 + 2 Phi), the deflection for end
 * rotations a and b is v = l0 [a (x-2x^2+x^3) + b (-x^2+x^3) - r (a+b) c]. The rotation of the
 * cross-section is v'/l0 + r (a+b), where ' = d/dx. */
static void bending(double l0, double x, double Phi, int at, double sign, double v[], double dv[],
                    double phi[], double dphi[])
{
    const double r = Phi / (2 + 2 * Phi), c = x * (1 - x) * (1 - 2 * x), dc = 1 - 6 * x * (1 - x),
                 ddc = 12 * x - 6;
    const double shape[2] = {x * (1 - x) * (1 - x), -x * x * (1 - x)};
    const double slope[2] = {(1 - x) * (1 - 3 * x), x * (3 * x - 2)},
                 second[2] = {6 * x - 4, 6 * x - 2};
    for (int i = 0; i < 2; i++) {
        if (v != NULL)
            v[at + i] = sign * l0 * (shape[i] - r * c);
        dv[at + i] = sign * (slope[i] - r * dc);
        phi[at + i] = slope[i] - r * dc + r;
        dphi[at + i] = (second[i] - r * ddc) / l0;
    }
}

int sheet_fields_warp(const element_request *request)
{
    return (request->features & FEATURE_WARPING) != 0 && request->section->Iw > 0;
}

sheet_fields sheet_fields_at(double l0, double x, double Phi_y, double Phi_z, int warp)
{
    sheet_fields f;
    memset(&f, 0, sizeof f);
    bending(l0, x, Phi_y, SHEET_LOCAL_ZP, 1, f.uy, f.duy, f.phi_z, f.dphi_z);
    bending(l0, x, Phi_z, SHEET_LOCAL_YP, -1, NULL, f.duz, f.phi_y, f.dphi_y);
    if (warp) {
        f.phi_x[SHEET_LOCAL_PX] = x * x * (3 - 2 * x);
        f.phi_x[SHEET_LOCAL_WP] = l0 * x * (1 - x) * (1 - x);
        f.phi_x[SHEET_LOCAL_WQ] = -l0 * x * x * (1 - x);
        f.dphi_x[SHEET_LOCAL_PX] = 6 * x * (1 - x) / l0;
        f.dphi_x[SHEET_LOCAL_WP] = (1 - x) * (1 - 3 * x);
        f.dphi_x[SHEET_LOCAL_WQ] = x * (3 * x - 2);
    } else {
        f.phi_x[SHEET_LOCAL_PX] = x;
        f.dphi_x[SHEET_LOCAL_PX] = 1 / l0;
    }
    return f;
}

enum { N = SHEET_LOCAL_COORDINATES, POINTS = 4 }; /* exact for products of degree 7 or lower */

static void add_product(double c, const double a[N], const double b[N], double Q[N * N])
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            Q[N * i + j] += c * (a[i] * b[j] + b[i] * a[j]);
}

static void add_point(double x, double ds, double l0, double trapeze, const sheet_fields *f,
                      double Q[SHEET_STRAINS_LISTED][N * N])
{
    double lag_y[N], lag_z[N];
    for (int i = 0; i < N; i++) {
        lag_y[i] = f->phi_y[i] + f->duz[i];
        lag_z[i] = f->phi_z[i] - f->duy[i];
    }
    const double from_p = x * l0, to_q = (1 - x) * l0;
    add_product(-ds / 2, f->phi_y, f->phi_y, Q[0]);
    add_product(-ds, f->phi_y, f->duz, Q[0]);
    add_product(-ds / 2, f->phi_z, f->phi_z, Q[0]);
    add_product(ds, f->phi_z, f->duy, Q[0]);
    add_product(ds * trapeze / 2, f->dphi_x, f->dphi_x, Q[0]);
    add_product(ds * l0, f->dphi_y, f->phi_z, Q[1]);
    add_product(ds * to_q, f->dphi_z, f->phi_x, Q[2]);
    add_product(-ds, f->phi_x, lag_z, Q[2]);
    add_product(ds * from_p, f->dphi_z, f->phi_x, Q[3]);
    add_product(ds, f->phi_x, lag_z, Q[3]);
    add_product(-ds * to_q, f->dphi_y, f->phi_x, Q[4]);
    add_product(ds, f->phi_x, lag_y, Q[4]);
    add_product(-ds * from_p, f->dphi_y, f->phi_x, Q[5]);
    add_product(-ds, f->phi_x, lag_y, Q[5]);
}

static void list_terms(double Q[SHEET_STRAINS_LISTED][N * N], sheet_strains_table *out)
{
    for (int i = 0; i < SHEET_STRAINS_LISTED; i++)
        for (int j = 0; j < N; j++)
            for (int k = j; k < N; k++)
                if (Q[i][N * j + k] != 0) {
                    out->term[out->terms].c = Q[i][N * j + k];
                    out->term[out->terms].i = i;
                    out->term[out->terms].j = j;
                    out->term[out->terms++].k = k;
                }
}

status sheet_strains_prepare(const element_request *request, double Phi_y, double Phi_z,
                             sheet_strains_table *out, fault *f)
{
    const section *c = request->section;
    const double l0 = request->length,
                 trapeze = request->features & FEATURE_TRAPEZE ? c->Ip / c->A : 0;
    const int amplitude = (request->features & FEATURE_WARPING) != 0;
    double x[POINTS], w[POINTS], Q[SHEET_STRAINS_LISTED][N * N] = {{0}};
    memset(out, 0, sizeof *out);
    TRY(beam_length_check(l0, f));
    quadrature_points(POINTS, x, w);
    out->Lambda[N * 0 + SHEET_LOCAL_U] = 1;
    out->Lambda[N * 1 + SHEET_LOCAL_PX] = l0;
    out->Lambda[N * 2 + SHEET_LOCAL_YP] = -l0;
    out->Lambda[N * 3 + SHEET_LOCAL_YQ] = l0;
    out->Lambda[N * 4 + SHEET_LOCAL_ZP] = -l0;
    out->Lambda[N * 5 + SHEET_LOCAL_ZQ] = l0;
    /* without amplitudes, the twist is uniform: Wp = Wq = px/l0 */
    out->Lambda[N * 6 + (amplitude ? SHEET_LOCAL_WP : SHEET_LOCAL_PX)] = amplitude ? l0 * l0 : l0;
    out->Lambda[N * 7 + (amplitude ? SHEET_LOCAL_WQ : SHEET_LOCAL_PX)] = amplitude ? l0 * l0 : l0;
    for (int i = 0; i < POINTS; i++) {
        const sheet_fields at = sheet_fields_at(l0, x[i], Phi_y, Phi_z, sheet_fields_warp(request));
        add_point(x[i], w[i] * l0, l0, trapeze, &at, Q);
    }
    list_terms(Q, out);
    return STATUS_OK;
}

void sheet_strains_evaluate(const sheet_strains_table *table, const node_state x[2],
                            strain_output *out)
{
    sheet_deformation_evaluate(table, x, out);
}

void sheet_strains_set_rest(const element_request *request, sheet_strains_table *out)
{
    const double l0 = request->length, *k = request->curvature, *g = request->strain;
    const double rotation[3] = {k[0] * l0, k[1] * l0, k[2] * l0}, along[3] = {1, 0, 0},
                 strained[3] = {1 + g[0], g[1], g[2]};
    double arc[3], unstressed[3], q[4], rest[SHEET_STRAINS];
    node_state x[2];
    memset(x, 0, sizeof x);
    arc_at(rotation, along, 1, arc, q);
    arc_at(rotation, strained, 1, unstressed, q);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] = l0 * unstressed[i];
        x[1].u[i] = l0 * (unstressed[i] - arc[i]);
        x[0].R[4 * i] = 1;
    }
    rotation_matrix(q, x[1].R);
    out->chord = l0 * vec3_norm(arc);
    out->torsion = k[0];
    sheet_strains_evaluate(out, x, &(strain_output){.e = rest});
    memcpy(out->rest, rest, sizeof rest);
}
