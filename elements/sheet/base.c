#include "elements/sheet/base.h"

#include <math.h>
#include <string.h>

#include "elements/sheet/elastic.h"
#include "elements/sheet/fields.h"

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
            return fault_set(f, STATUS_REFUSED,
                             "element of length %g m: its stiffness overflows; use fewer elements",
                             l0);
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
