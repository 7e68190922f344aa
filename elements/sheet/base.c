#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "elements/shared/beam_constants.h"
#include "elements/sheet/potential.h"
#include "elements/sheet/sheet.h"

enum { N = SHEET_STRAINS };

double sheet_elastic_phi_y(const section *c, double l0)
{
    return 12 * c->young * c->Iz * c->F[0] / (c->shear_modulus * l0 * l0);
}

double sheet_elastic_phi_z(const section *c, double l0)
{
    return 12 * c->young * c->Iy * c->F[4] / (c->shear_modulus * l0 * l0);
}

/* Sets the bending stiffness of N Eqs. 35, 36, where (4 + Phi)/(1 + Phi) = 1 + 3/(1 + Phi) and (-2
 * + Phi)/(1 + Phi) = 1 - 3/(1 + Phi). */
static void bending_stiffness(double EI, double l0, double Phi, int at, double S[N * N])
{
    const double k = EI / (l0 * l0 * l0), antisymmetric = 3 / (1 + Phi);
    S[N * at + at] = S[N * (at + 1) + at + 1] = k * (1 + antisymmetric);
    S[N * at + at + 1] = S[N * (at + 1) + at] = k * (1 - antisymmetric);
}

void sheet_elastic_stiffness(const section *c, double l0, double Phi_y, double Phi_z,
                             double S[N * N])
{
    static const int torsion[3] = {1, 6, 7};
    static const double saint_venant[3][3] = {{36, -3, -3}, {-3, 4, -1}, {-3, -1, 4}};
    static const double warping[3][3] = {{12, -6, -6}, {-6, 4, 2}, {-6, 2, 4}};
    const double l3 = l0 * l0 * l0, GJ = c->shear_modulus * c->It / (30 * l3),
                 EIw = c->young * c->Iw / (l3 * l0 * l0);
    memset(S, 0, N * N * sizeof(double));
    S[0] = c->young * c->A / l0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            S[N * torsion[i] + torsion[j]] = GJ * saint_venant[i][j] + EIw * warping[i][j];
    bending_stiffness(c->young * c->Iy, l0, Phi_z, 2, S);
    bending_stiffness(c->young * c->Iz, l0, Phi_y, 4, S);
}

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
                         "initial torsion %g 1/m: the Wagner torque is not defined with initial "
                         "torsion; remove the torsion, or omit wagner_torque",
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

static const sheet_base_data *data_of(const element_data *d)
{
    return (const sheet_base_data *)(const void *)d;
}

status sheet_base_prepare(const element_request *request, sheet_base_shear shear,
                          sheet_base_data *out, fault *f)
{
    const double l0 = request->length;
    const int flexible = (request->features & FEATURE_SHEAR) != 0,
              whole = shear == SHEET_BASE_CONSISTENT;
    section c = *request->section;
    memset(out, 0, sizeof *out);
    if (!sheet_fields_warp(request))
        c.Iw = 0;
    const double Phi_y = flexible ? sheet_elastic_phi_y(&c, l0) : 0,
                 Phi_z = flexible ? sheet_elastic_phi_z(&c, l0) : 0;
    TRY(sheet_strains_prepare(request, whole ? Phi_y : 0, whole ? Phi_z : 0, &out->table, f));
    TRY(sheet_wagner_prepare(request, &out->wagner, f));
    sheet_elastic_stiffness(&c, l0, Phi_y, Phi_z, out->S);
    for (int i = 0; i < SHEET_STRAINS * SHEET_STRAINS; i++)
        if (!isfinite(out->S[i]))
            return beam_overflow(l0, f);
    sheet_strains_set_rest(request, &out->table);
    field_mass_prepare(request, 2, &out->mass);
    return STATUS_OK;
}

void sheet_base_strain(const element_data *d, const node_state x[], strain_output *out)
{
    sheet_strains_evaluate(&data_of(d)->table, x, out);
}

void sheet_base_strain_many(int count, const element_data *const data[], const node_state x[],
                            strain_output out[])
{
    REAL_CHOSEN(sheet_lanes_strain)(count, data, x, out);
}

status sheet_base_inertia(const element_data *d, const node_state x[],
                          const element_rotating_frame *frame, inertia_output *out)
{
    return field_mass_inertia(&data_of(d)->mass, x, frame, out);
}

element_order sheet_base_order(element_analysis analysis, const double options[])
{
    (void)options;
    return analysis == ELEMENT_VIBRATION ? FIELD_MASS_ORDER : (element_order){2, 4};
}

int sheet_base_mass_of_field(const double options[])
{
    (void)options;
    return 1;
}

size_t sheet_second_data_size(const element_request *request)
{
    (void)request;
    return sizeof(sheet_base_data);
}

status sheet_second_prepare(const element_request *request, sheet_base_shear shear,
                            element_data *out, fault *f)
{
    return sheet_base_prepare(request, shear, (sheet_base_data *)(void *)out, f);
}

status sheet_second_stress(const element_data *d, const double e[], const double inner[],
                           stress_output *out)
{
    (void)inner;
    sheet_linear_stress((const sheet_base_data *)(const void *)d, e, out);
    return STATUS_OK;
}

void sheet_second_stress_many(int count, const element_data *const data[], const double *const e[],
                              const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_second)(count, data, e, inner, out, outcome);
}

void sheet_second_equations_many(int count, const element_data *const data[], const node_state x[],
                                 const double *const e[], const double *const inner[],
                                 const double *const s[], equations_output out[], status outcome[])
{
    REAL_CHOSEN(sheet_lanes_second_equations)(count, data, x, e, inner, s, out, outcome);
}
