#include "elements/field/field.h"

#include <string.h>

#include "elements/math/scalar.h"
#include "elements/shared/masses.h"

section field_section(const element_request *request)
{
    section c = *request->section;
    if (request->type != NULL && request->type->lacks & LACKS_SHEAR_Y)
        for (int i = 0; i < 3; i++)
            c.F[i] = c.F[3 * i] = 0;
    return c;
}

static void places_of(const element_request *request, int nodes, double place[])
{
    if (request->type != NULL && nodes > 2)
        element_places(request->type, request->options, place);
    else
        for (int k = 0; k < nodes; k++)
            place[k] = (double)k / (nodes - 1);
}

static void integrate_whole(displacement_field *f)
{
    double x[FIELD_MOST_POINTS], weight[FIELD_MOST_POINTS];
    const int count = field_points(f, 0, 1, x, weight);
    for (int g = 0; g < count; g++) {
        field_rows at;
        field_at(f, x[g], &at);
        field_gather(weight[g], &at, &f->whole);
    }
}

void field_prepare(const element_request *request, int nodes, displacement_field *out)
{
    const section c = field_section(request);
    const int flexible = (request->features & FEATURE_SHEAR) != 0;
    double S[FIELD_MODES * FIELD_MODES];
    memset(out, 0, sizeof *out);
    out->nodes = nodes;
    places_of(request, nodes, out->place);
    out->l0 = request->length;
    out->ys = c.ys;
    out->zs = c.zs;
    out->warps = (request->features & FEATURE_WARPING) != 0;
    if (nodes == 2) {
        out->twist = beamw_twist_of(&c, out->l0, flexible,
                                    out->warps ? BEAMW_TWIST_HYPERBOLIC : BEAMW_TWIST_CUBIC);
        beamw_stiffness_of(&c, out->l0, flexible ? BEAMW_STIFFNESS_COUPLED : BEAMW_STIFFNESS_RIGID,
                           &out->twist, &out->linear, S);
    }
    integrate_whole(out);
}

static void functionals_at(const displacement_field *f, double x,
                           double out[FIELD_FUNCTIONALS][FIELD_MODES])
{
    static const double mean[3][FIELD_MODES] = {{0, 1}, {0, 0, 1, 1}, {0, 0, 0, 0, 1, 1}};
    const beamw_stiffness_fields *s = &f->linear;
    const beamw_twist_shapes twist = beamw_twist_at(&f->twist, x);
    const double l = f->l0, b = x * (1 - x), cubic = b * (1 - 2 * x), db = 1 - 2 * x,
                 dcubic = 1 - 6 * b;
    /* slope of the chord minus lin(theta) */
    const double bend_y[FIELD_MODES] = {0, 0, 1 - x, -x},
                 bend_z[FIELD_MODES] = {0, 0, 0, 0, 1 - x, -x};
    for (int k = 0; k < FIELD_MODES; k++) {
        const double chi_x = (twist.odd_integral * s->A[k] + twist.even_integral * s->tw[k]) / l;
        out[FIELD_CHI_X][k] = chi_x;
        out[FIELD_NU_Y][k] =
            (f->zs - f->twist.lag[0]) * chi_x - b / 2 * mean[2][k] - l * cubic * s->hg[0][k];
        out[FIELD_NU_Z][k] =
            -(f->ys + f->twist.lag[1]) * chi_x + b / 2 * mean[1][k] - l * cubic * s->hg[1][k];
        out[FIELD_CHI_Z][k] = (bend_z[k] - db / 2 * mean[2][k]) / l - f->zs * mean[0][k] / (l * l) -
                              dcubic * s->hg[0][k] - s->g[0][k];
        out[FIELD_CHI_Y][k] = (bend_y[k] - db / 2 * mean[1][k]) / l - f->ys * mean[0][k] / (l * l) +
                              dcubic * s->hg[1][k] + s->g[1][k];
    }
    for (int i = 0; i < FIELD_FUNCTIONALS && !f->warps; i++) {
        out[i][1] += out[i][6] + out[i][7];
        out[i][6] = out[i][7] = 0;
    }
}

void field_at(const displacement_field *f, double x, field_rows *out)
{
    memset(out, 0, sizeof *out);
    if (f->nodes == 2) {
        out->part[0] = 1 - x;
        out->part[1] = x;
        functionals_at(f, x, out->functional);
        return;
    }
    lagrange_at(f->nodes, f->place, x, out->part, NULL);
    for (int k = 0; k < f->nodes; k++) {
        out->lean[k] = f->l0 / f->nodes * (x - f->place[k]);
        for (int j = 0; j < f->nodes; j++)
            out->lean[k] *= j == k ? 1 : (x - f->place[j]) / (f->place[k] - f->place[j]);
    }
}

/* the amplitude is a = kx - (f (Q, Mw))_w, where Mw is computed from the twist (beamw/fields.h) */
void field_warping_at(const displacement_field *f, double x, double psi[FIELD_MODES])
{
    const beamw_stiffness_fields *s = &f->linear;
    const beamw_twist_shapes twist = beamw_twist_at(&f->twist, x);
    for (int k = 0; k < FIELD_MODES; k++)
        psi[k] = ((k == 1) + f->twist.soft * (twist.odd * s->A[k] + twist.even * s->tw[k])) /
                     (f->l0 * f->l0) -
                 s->g[2][k];
}

void field_gather(double size, const field_rows *at, field_rows *out)
{
    for (int node = 0; node < ELEMENT_MAX_NODES; node++) {
        out->part[node] += size * at->part[node];
        out->lean[node] += size * at->lean[node];
    }
    for (int i = 0; i < FIELD_FUNCTIONALS; i++)
        for (int k = 0; k < FIELD_MODES; k++)
            out->functional[i][k] += size * at->functional[i][k];
}

int field_points(const displacement_field *f, double from, double to, double x[FIELD_MOST_POINTS],
                 double weight[FIELD_MOST_POINTS])
{
    if (f->nodes == 2)
        return beamw_twist_points(&f->twist, from, to, x, weight);
    quadrature_points(f->nodes + 1, x, weight);
    for (int k = 0; k < f->nodes + 1; k++) {
        x[k] = from + (to - from) * x[k];
        weight[k] *= to - from;
    }
    return f->nodes + 1;
}

enum { PSI = FIELD_FUNCTIONALS };
/* Numbers of points. The first is exact for the square of a cubic. The second integrates hyperbolic
 * twist with an error below 1e-9 for elements up to ten boundary layers long. */
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
    else {
        double place[ELEMENT_MAX_NODES];
        out->lumped = lumped_of(request->section, request->features, request->length);
        places_of(request, nodes, place);
        lumped_shares(nodes, place, out->share);
    }
}

status field_mass_inertia(const field_mass *m, const node_state x[],
                          const element_rotating_frame *frame, inertia_output *out)
{
    return m->nodes == 2 ? beamw_spread_inertia(&m->spread, x, frame, out)
                         : lumped_element(&m->lumped, m->nodes, m->share, x, frame, out);
}
