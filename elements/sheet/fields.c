#include "elements/sheet/fields.h"

#include <string.h>

/* With the antisymmetric cubic c = x - 3x^2 + 2x^3 and the shear share r = Phi/(2 + 2 Phi):
 * a deflection v with end slopes a, b is l0 [a (x-2x^2+x^3) + b (-x^2+x^3) - r (a+b) c], the
 * rotation v' + r (a+b). */
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
