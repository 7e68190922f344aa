#include "cases/shared/shared.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

const parameter_type sheet_parameters[] = {
    [SHEET_LENGTH] = {"length", "m", 0.1, 1e-9, 1e6, NULL, "length of the sheet"},
    [SHEET_WIDTH] = {"width", "m", 0.1, 1e-9, 1e6, NULL, "width, along z"},
    [SHEET_THICKNESS] = {"thickness", "m", 0.00225, 1e-12, 1e5, NULL, "thickness, along y"},
    [SHEET_YOUNG] = {"young", "Pa", 200e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [SHEET_POISSON] = {"poisson", "1", 0.3, -0.99, 0.49, NULL, "Poisson's ratio"},
    [SHEET_DEFLECTION] = {"tip_deflection", "m", 0.015, -1e6, 1e6, NULL,
                          "prescribed tip displacement along y"},
    [SHEET_TIP_WARPING] = {"tip_warping", "1", 0, 0, 1, NULL,
                           "warping at the tip; 0: fixed, 1: free"},
    [SHEET_WARPING] = {"warping", "1", 1, 0, 1, NULL, "1: warping restrained, 0: uniform torsion"},
    [SHEET_SHEAR] = {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, 0: rigid in shear"},
    [SHEET_TRAPEZE] = {"trapeze", "1", 1, 0, 1, NULL, "1: shortening of a twisted sheet (N Eq. 8)"},
    [SHEET_WAGNER] = {"wagner", "1", 0, 0, 1, NULL, "1: Wagner torque (N Eq. 46)"},
    [SHEET_SHEAR_FACTOR] = {"shear_factor", "1", 0, 0, 10, NULL,
                            "k of the shear stiffness; 0: 10 (1 + nu)/(12 + 11 nu)"},
    [SHEET_MOMENTS] = {"moment_convention", "", SCENE_MOMENTS_SPATIAL, 0, 0, SCENE_MOMENTS_CHOICES,
                       "convention for the tip moments in C_* while the tip rotates"},
    {0},
};

void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out)
{
    *out = section_spec_rectangle(young, young / (2 * (1 + poisson)), width, thickness);
    const double k = shear_factor > 0 ? shear_factor : 10 * (1 + poisson) / (12 + 11 * poisson);
    out->shear_factor[0] = out->shear_factor[1] = k;
    /* thin-sheet values: N Eq. 46, and (w t)^3/144 */
    out->given.wagner_torque = pow(width, 5) * thickness / 1440;
    out->given.Iw = width * width * width * thickness * thickness * thickness / 144;
}

status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f)
{
    const double length = value[SHEET_LENGTH];
    if (fabs(value[SHEET_DEFLECTION]) >= length)
        return fault_set(
            f, STATUS_REFUSED,
            "tip_deflection = %g m cannot be reached by a sheet of length %g m; give a smaller one",
            value[SHEET_DEFLECTION], length);
    section_spec spec;
    sheet_section(value[SHEET_WIDTH], value[SHEET_THICKNESS], value[SHEET_YOUNG],
                  value[SHEET_POISSON], value[SHEET_SHEAR_FACTOR], &spec);
    if (value[SHEET_WARPING] == 0)
        spec.given.Iw = 0;
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    *root = scene_add_node(s, 0, 0, 0);
    *tip = scene_add_node(s, length, 0, 0);
    scene_member *sheet = scene_member_at(s, scene_add_member(s, *root, *tip, profile, y_axis));
    sheet->warp_p = SCENE_WARP_FIXED;
    sheet->warp_q = value[SHEET_TIP_WARPING] == 0 ? SCENE_WARP_FIXED : SCENE_WARP_FREE;
    scene_hold_all(s, *root);
    scene_omit(s, (value[SHEET_SHEAR] == 0 ? FEATURE_SHEAR : 0) |
                      (value[SHEET_TRAPEZE] == 0 ? FEATURE_TRAPEZE : 0) |
                      (value[SHEET_WAGNER] == 0 ? FEATURE_WAGNER_TORQUE : 0));
    const int meshes[] = {1, 2, 3, 4, 8, 16, 32, 64, 128, 256},
              is_narrow = length >= 10 * value[SHEET_WIDTH];
    scene_meshes(s, is_narrow ? 10 : 8, meshes);
    return STATUS_OK;
}

void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count)
{
    static const char *const response[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    for (int i = 0; i < count; i++) {
        const int row = entries[i][0], column = entries[i][1];
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "C_%s_%s", response[row], load[column]);
        scene_quantity *q = scene_add_quantity(s, name, scene_compliance_unit(row, column),
                                               analysis, scene_compliance_entry(row, column));
        q->least_order = 1.8;
    }
}

/* Let zp and zq be the end angles in the frame of the chord, a = (zp + zq)/2 and c = (zq - zp)/2.
 * After elimination of the stresses of N Eq. 49, the potential in the plane of bending is V = 6 EIz
 * a^2/L + 2 EIz c^2/L + g^2/2k, g = u + L (a^2/10 + c^2/6), k = L/EA + (L^3/EIz) (a^2/700 +
 * c^2/180), where the axial force is F = g/k. Out of this plane, M_x = M~x - u_y (M~yp + M~yq)/L +
 * u_y' M_y (N Eq. 49 with the sign corrected) and M_y = M~yp (x - 1) + M~yq x, where x = s/L. The
 * terms of N Eq. 50 reduce to sum M~y y + int [M_x phi_x' + M_y phi_x M_z/EIz - M_x kappa_x/2 -
 * M_y^2/2EIy - F_z^2/2kGA] ds with the twist rate kappa_x of N Eq. 51. */

enum { IN_PLANE = 3, STRESSES = 3, LOCAL = 4, POINTS = 20 };

const char sheet_prediction_source[] = "N Eq. 54";

typedef struct plane {
    double EA, EIz, L;
    double V, gradient[IN_PLANE], hessian[IN_PLANE * IN_PLANE];
    double F;
} plane;

/* Computes V and its derivatives at (u, zp, zq). */
static void energy(plane *p, double u, double zp, double zq)
{
    const double L = p->L, a = (zp + zq) / 2, c = (zq - zp) / 2, flexible = L * L * L / p->EIz;
    const double g = u + L * (a * a / 10 + c * c / 6),
                 k = L / p->EA + flexible * (a * a / 700 + c * c / 180);
    const double dg[3] = {1, L * a / 5, L * c / 3},
                 dk[3] = {0, flexible * a / 350, flexible * c / 90};
    const double d2g[3] = {0, L / 5, L / 3}, d2k[3] = {0, flexible / 350, flexible / 90},
                 V0[3] = {0, 12 * p->EIz / L, 4 * p->EIz / L};
    const double T[3][3] = {{1, 0, 0}, {0, 0.5, 0.5}, {0, -0.5, 0.5}}, at[3] = {0, a, c};
    double gradient[3], hessian[3][3];
    p->F = g / k;
    for (int i = 0; i < 3; i++) {
        gradient[i] = p->F * dg[i] - p->F * p->F * dk[i] / 2 + V0[i] * at[i];
        for (int j = 0; j < 3; j++)
            hessian[i][j] = (dg[i] - p->F * dk[i]) * (dg[j] - p->F * dk[j]) / k +
                            (i == j ? p->F * d2g[i] - p->F * p->F * d2k[i] / 2 + V0[i] : 0);
    }
    for (int i = 0; i < 3; i++) {
        p->gradient[i] = 0;
        for (int m = 0; m < 3; m++)
            p->gradient[i] += T[m][i] * gradient[m];
        for (int j = 0; j < 3; j++) {
            p->hessian[3 * i + j] = 0;
            for (int m = 0; m < 3; m++)
                for (int n = 0; n < 3; n++)
                    p->hessian[3 * i + j] += T[m][i] * hessian[m][n] * T[n][j];
        }
    }
}

/* Computes the forces and the stiffness for X = L + w, Y and the rotation of the tip. With the
 * angle alpha of the chord, u = sqrt(X^2 + Y^2) - L, zp = -alpha and zq = rotation - alpha. */
static void tip(plane *p, double w, double Y, double force[3], double K[9])
{
    const double X = p->L + w, l = hypot(X, Y), alpha = atan2(Y, X), n[2] = {X / l, Y / l},
                 t[2] = {-Y / l, X / l};
    const double J[3][3] = {{n[0], n[1], 0}, {-t[0] / l, -t[1] / l, 0}, {-t[0] / l, -t[1] / l, 1}};
    energy(p, (w * (2 * p->L + w) + Y * Y) / (l + p->L), -alpha, -alpha);
    for (int i = 0; i < 3; i++) {
        force[i] = 0;
        for (int m = 0; m < 3; m++)
            force[i] += J[m][i] * p->gradient[m];
        for (int j = 0; j < 3; j++) {
            K[3 * i + j] = 0;
            for (int m = 0; m < 3; m++)
                for (int q = 0; q < 3; q++)
                    K[3 * i + j] += J[m][i] * p->hessian[3 * m + q] * J[q][j];
            if (i < 2 && j < 2)
                K[3 * i + j] +=
                    p->gradient[0] * t[i] * t[j] / l +
                    (p->gradient[1] + p->gradient[2]) * (n[i] * t[j] + t[i] * n[j]) / (l * l);
        }
    }
}

/* Returns sinh(lambda x)/sinh(lambda). If there is no warping, lambda is infinite. */
static double hyperbolic(double lambda, double x)
{
    return isinf(lambda) ? 0 : exp(lambda * (x - 1)) * expm1(-2 * lambda * x) / expm1(-2 * lambda);
}

/* Returns the twist rate times GJ at x for the polynomial m[4] of M_x. The twist rate is zero at
 * both ends. */
static double twist(double lambda, const double m[4], double x)
{
    const double more = isinf(lambda) ? 0 : 1 / (lambda * lambda);
    const double value =
        m[0] + x * (m[1] + x * (m[2] + x * m[3])) + more * (2 * m[2] + 6 * m[3] * x);
    const double start = m[0] + more * 2 * m[2],
                 end = m[0] + m[1] + m[2] + m[3] + more * (2 * m[2] + 6 * m[3]);
    return value - start * hyperbolic(lambda, 1 - x) - end * hyperbolic(lambda, x);
}

/* Computes K[4 x 4] with respect to (phi_x, yp, yq, Wq) about the plane state. */
static status local_stiffness(const section *s, const plane *p, double zp, double shear,
                              double K[LOCAL * LOCAL])
{
    const double L = p->L, E = s->young, G = s->shear_modulus, GJ = G * s->It,
                 lambda = s->Iw > 0 ? L * sqrt(GJ / (E * s->Iw)) : INFINITY;
    /* u_y = L zp (x - 3 x^2 + 2 x^3) for zp = zq; M_x of unit M~x, M~yp, M~yq */
    const double m[STRESSES][4] = {
        {1, 0, 0, 0}, {-zp, 6 * zp, -9 * zp, 4 * zp}, {0, 0, -3 * zp, 4 * zp}};
    const double M = 6 * p->EIz * zp / L + zp * L * p->F / 10; /* M~zp = M~zq */
    double D[STRESSES * STRESSES] = {0}, B[STRESSES * LOCAL] = {0}, S[STRESSES * LOCAL],
                        W[LOCAL * LOCAL] = {0};
    double at[POINTS], weight[POINTS];
    int pivot[STRESSES];
    quadrature_points(POINTS, at, weight);
    for (int point = 0; point < POINTS; point++) {
        const double x = at[point], ds = weight[point] * L;
        const double My[STRESSES] = {0, x - 1, x},
                     phi[2] = {x * x * (3 - 2 * x), -L * x * x * (1 - x)};
        const double rate[2] = {6 * x * (1 - x) / L, -x * (2 - 3 * x) - hyperbolic(lambda, x)};
        const double curvature =
            (M * (2 * x - 1) + L * zp * x * (1 - x) * (1 - 2 * x) * p->F) / p->EIz;
        for (int i = 0; i < STRESSES; i++) {
            const double Mx = m[i][0] + x * (m[i][1] + x * (m[i][2] + x * m[i][3]));
            for (int j = 0; j < STRESSES; j++)
                D[STRESSES * i + j] +=
                    ds * (Mx * twist(lambda, m[j], x) / GJ + My[i] * My[j] / (E * s->Iy));
            for (int j = 0; j < 2; j++)
                B[LOCAL * i + 3 * j] += ds * (Mx * rate[j] + My[i] * phi[j] * curvature);
        }
    }
    B[LOCAL * 1 + 1] = B[LOCAL * 2 + 2] = 1;
    for (int i = 1; i < STRESSES; i++)
        for (int j = 1; j < STRESSES; j++)
            D[STRESSES * i + j] += shear * s->F[4] / (G * L);
    if (!isinf(lambda))
        W[LOCAL * LOCAL - 1] = E * s->Iw * lambda / (L * tanh(lambda));
    memcpy(S, B, sizeof S);
    if (dense_lu(STRESSES, D, pivot) != 0)
        return STATUS_SINGULAR;
    dense_lu_solve(STRESSES, LOCAL, D, pivot, S);
    memcpy(K, W, sizeof W);
    dense_add_transpose_mul(LOCAL, STRESSES, LOCAL, B, S, K);
    return STATUS_OK;
}

/* Returns C_zz from the out-of-plane stiffness with respect to (u_z, theta_x, theta_y) of the
 * tip. */
static double compliance_zz(const section *s, const plane *p, double X, double Y,
                            const double force[3], int tip_warps, double shear,
                            scene_moments moments)
{
    const double l = hypot(X, Y), alpha = atan2(Y, X), sine = Y / l, cosine = X / l;
    double K[LOCAL * LOCAL], H[9] = {0}, C[3] = {1, 0, 0};
    int pivot[3];
    if (local_stiffness(s, p, -alpha, shear, K) != STATUS_OK)
        return NAN;
    const double WW = K[LOCAL * LOCAL - 1];
    if (tip_warps && WW > 0)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                K[LOCAL * i + j] -= K[LOCAL * i + 3] * K[LOCAL * 3 + j] / WW;
    const double T[3][3] = {
        {0, 1, sine / cosine}, {1 / l, 0, 0}, {1 / l, 0, cosine + sine * sine / cosine}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int m = 0; m < 3; m++)
                for (int n = 0; n < 3; n++)
                    H[3 * i + j] += T[m][i] * K[LOCAL * m + n] * T[n][j];
    const double turned = moments == SCENE_MOMENTS_SPATIAL ? force[2] / 2 : 0;
    H[0] += p->gradient[0] / l;
    H[8] += p->gradient[2] * sine / cosine;
    H[5] += p->gradient[2] / 2 + turned;
    H[7] += p->gradient[2] / 2 - turned;
    if (dense_lu(3, H, pivot) != 0)
        return NAN;
    dense_lu_solve(3, 1, H, pivot, C);
    return C[0];
}

sheet_prediction sheet_prediction_of(const section *c, double length, double deflection,
                                     int tip_warps, int shear, scene_moments moments)
{
    plane p = {.EA = c->young * c->A, .EIz = c->young * c->Iz, .L = length};
    double w = 0, force[3], K[9], C[3] = {1, 0, 0};
    int pivot[3];
    sheet_prediction out = {NAN, NAN, NAN, NAN, NAN};
    for (int i = 0; i < 50; i++) {
        tip(&p, w, deflection, force, K);
        const double step = force[0] / K[0];
        w -= step;
        if (!(fabs(step) > 1e-16 * length))
            break;
    }
    tip(&p, w, deflection, force, K);
    if (!(w > -length) || !(K[0] > 0))
        return out;
    out.u_x = w;
    out.F_y = force[1];
    out.M_z = force[2];
    out.C_zz = compliance_zz(c, &p, length + w, deflection, force, tip_warps, shear, moments);
    if (dense_lu(3, K, pivot) == 0) {
        dense_lu_solve(3, 1, K, pivot, C);
        out.C_xx = C[0];
    }
    return out;
}
