/* Corrected BEAMW. The stiffness is computed with the full matrix D. The strains represent uniform
 * shear of any size (elements/beamw/screw.h). The modified modes are derived from the strains of
 * the Simo-Reissner beam in the full linear solution (elements/beamw/condensed.c). */
#include "elements/beamw/screw.h"
#include "elements/beamw/variants.h"

static size_t data_size(const element_request *request)
{
    (void)request;
    return sizeof(beamw_consistent_data);
}

static status prepare(const element_request *request, element_data *out, fault *f)
{
    return beamw_prepare_consistent(request, (beamw_consistent_data *)(void *)out, f);
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    beamw_helicoidal_evaluate(d->l0, x, out);
}

static void strain_many(int count, const element_data *const data[], const node_state x[],
                        strain_output out[])
{
    REAL_CHOSEN(beamw_lanes_helicoidal)(count, data, x, out);
}

static void stress_many(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[])
{
    REAL_CHOSEN(beamw_lanes_consistent)(count, data, e, inner, out, outcome);
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    return beamw_prepare_whole(d)->condensed
               ? beamw_condensed_stress(&beamw_prepare_whole(d)->internal, e, out)
               : beamw_variants_stress(d, e, inner, out);
}

const element_type element_beamw_consistent = {
    .name = "beamw_consistent",
    .summary = "BEAMW with coupled shear stiffness and modified modes that are consistent with "
               "that stiffness",
    .source = "J; stiffness and modes: reference/ERRATA.md, J 58/62/66, App. A",
    .family = "beamw",
    .abi = ELEMENT_ABI,
    .limits = LIMIT_HALF_TURN,
    .offers =
        BEAMW_OFFERS | FEATURE_SHEAR | FEATURE_ENGESSER | FEATURE_HARINGX | FEATURE_WAGNER_MOMENTS,
    .shear_theories = SHEAR_ENGESSER | SHEAR_HARINGX,
    .options = {beamw_prepare_mass, beamw_prepare_inside},
    .judged = beamw_prepare_judged,
    .data_size = data_size,
    .prepare = prepare,
    .strain = strain,
    .stress = stress,
    .strain_many = strain_many,
    .stress_many = stress_many,
    .lanes = LANES_TOGETHER,
    .geometric = beamw_variants_geometric,
    .inertia = beamw_inertia_of,
    .spreads = 1,
    .mass_of_field = beamw_prepare_mass_of_field,
    .order = beamw_prepare_order,
};
