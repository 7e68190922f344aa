#include "elements/sheet/wagner.h"

#include <string.h>

#include "elements/math/quadrature.h"

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
