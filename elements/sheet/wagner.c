#include "elements/sheet/wagner.h"

#include <string.h>

#include "elements/math/quadrature.h"

static const int strain_of[SHEET_WAGNER_STRAINS] = {1, 6, 7};

status sheet_wagner_prepare(const element_request *request, sheet_wagner_term *out, fault *f)
{
    const double l0 = request->length,
                 stiffness = request->section->young * request->section->wagner_torque;
    double x[SHEET_WAGNER_POINTS], w[SHEET_WAGNER_POINTS];
    memset(out, 0, sizeof *out);
    out->active = (request->features & FEATURE_WAGNER_TORQUE) != 0 && stiffness != 0;
    if (!out->active)
        return STATUS_OK;
    if ((request->features & FEATURE_CURVATURE) && request->curvature[0] != 0)
        return fault_set(f, STATUS_REFUSED,
                         "initial torsion %g 1/m: the Wagner torque is known without it only; "
                         "leave one of them out",
                         request->curvature[0]);
    quadrature_points(SHEET_WAGNER_POINTS, x, w);
    for (int i = 0; i < SHEET_WAGNER_POINTS; i++) {
        out->weight[i] = stiffness * w[i] * l0;
        out->rate[i][0] = 6 * x[i] * (1 - x[i]) / (l0 * l0);
        out->rate[i][1] = (1 - x[i]) * (1 - 3 * x[i]) / (l0 * l0);
        out->rate[i][2] = x[i] * (3 * x[i] - 2) / (l0 * l0);
    }
    return STATUS_OK;
}

void sheet_wagner_add(const sheet_wagner_term *w, const double e[SHEET_STRAINS], double *energy,
                      double *sigma, double *C)
{
    if (w->active)
        for (int i = 0; i < SHEET_WAGNER_POINTS; i++) {
            const double *rate = w->rate[i], kx = rate[0] * e[1] + rate[1] * e[6] + rate[2] * e[7],
                         square = w->weight[i] * kx * kx;
            if (energy != NULL)
                *energy += square * kx * kx;
            for (int k = 0; k < SHEET_WAGNER_STRAINS; k++) {
                if (sigma != NULL)
                    sigma[strain_of[k]] += 4 * square * kx * rate[k];
                if (C != NULL)
                    for (int m = 0; m < SHEET_WAGNER_STRAINS; m++)
                        C[SHEET_STRAINS * strain_of[k] + strain_of[m]] +=
                            12 * square * rate[k] * rate[m];
            }
        }
}
