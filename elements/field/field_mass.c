#include "elements/field/field_mass.h"

#include <string.h>

#include "elements/math/quadrature.h"

enum { PSI = FIELD_FUNCTIONALS }; /* warping amplitude, behind the others */
/* Exact for the square of a cubic; hyperbolic twist within 1e-9 up to ten lengths of its layer. */
enum { CUBIC_POINTS = 4, HYPERBOLIC_POINTS = BEAMW_GAUSS };

static void prepare_two(const element_request *request, beamw_spread *out)
{
    displacement_field f;
    field_prepare(request, 2, &f);
    out->l0 = request->length;
    out->lumped = lumped_of(request->section, request->features, request->length / 2);
    out->share = 1;
    out->points = f.twist.lambda > 0 ? HYPERBOLIC_POINTS : CUBIC_POINTS;
    quadrature_points(out->points, out->at, out->weight);
    for (int g = 0; g < out->points; g++) {
        field_rows at;
        field_at(&f, out->at[g], &at);
        memcpy(out->field[g], at.functional, sizeof at.functional);
        field_warping_at(&f, out->at[g], out->field[g][PSI]);
    }
}

void field_mass_prepare(const element_request *request, int nodes, field_mass *out)
{
    memset(out, 0, sizeof *out);
    out->nodes = nodes;
    if (nodes == 2)
        prepare_two(request, &out->spread);
    else
        out->lumped = lumped_of(request->section, request->features, request->length);
}

status field_mass_inertia(const field_mass *m, const node_state x[],
                          const element_rotating_frame *frame, inertia_output *out)
{
    return m->nodes == 2
               ? beamw_spread_inertia(&m->spread, x, frame, out)
               : lumped_element(&m->lumped, m->nodes, lumped_shares(m->nodes), x, frame, out);
}
