#include "elements/beamw/variants.h"

#include <math.h>
#include <string.h>

#include "elements/shared/beam_constants.h"

enum { OPTION_MASS, OPTION_TORSION, OPTION_INSIDE };

const parameter_type beamw_prepare_mass[] = {
    [OPTION_MASS] =
        {"mass", "", BEAMW_INERTIA_CONSISTENT, 0, 0, "lumped|consistent|averaged",
         "mass matrix: J Eq. 73, the matrix of the shape functions, or the mean of both matrices"},
    {0},
};

const parameter_type beamw_prepare_inside[] = {
    {"torsion", "", BEAMW_TWIST_CUBIC, 0, 0, "cubic|hyperbolic",
     "shape functions of twist: those of J Eq. 38, or the exact functions of non-uniform torsion"},
    {"inside", "", 1, 0, 0, "linear|following",
     "shape functions of bending, shear and warping: those of the stress-free element, or those in "
     "equilibrium under the stresses"},
    {0},
};

const unsigned beamw_prepare_judged[] = {
    [OPTION_MASS] = FEATURE_MASS, [OPTION_TORSION] = FEATURE_WARPING, [OPTION_INSIDE] = 0};

int beamw_prepare_mass_of_field(const double options[])
{
    return options[OPTION_MASS] == BEAMW_INERTIA_CONSISTENT;
}

element_order beamw_prepare_order(element_analysis analysis, const double options[])
{
    return analysis == ELEMENT_VIBRATION && beamw_prepare_mass_of_field(options)
               ? (element_order){4, 8}
               : (element_order){2, 4};
}

/* Returns REFUSED if the stiffness overflows. */
static status finish(const element_request *request, const beamw_stiffness_fields *fields,
                     element_data *out, fault *f)
{
    if (request->features & FEATURE_MASS)
        beamw_inertia_prepare(request->section, request->features,
                              (beamw_inertia_kind)request->options[OPTION_MASS], fields, out);
    if (!(request->features & FEATURE_WARPING))
        beamw_variants_drop_warping(out);
    beamw_variants_list(out);
    for (int i = 0; i < 64; i++)
        if (!isfinite(out->S[i]))
            return beam_overflow(request->length, f);
    return STATUS_OK;
}

status beamw_prepare_variant(const element_request *request, beamw_stiffness_shear shear,
                             beamw_prepare_modes modes, element_data *out, fault *f)
{
    const section *c = request->section;
    TRY(beam_length_check(request->length, f));
    beamw_stiffness_fields fields;
    memset(out, 0, sizeof *out);
    out->l0 = request->length;
    const int flexible = (request->features & FEATURE_SHEAR) != 0;
    const beamw_twist t = beamw_twist_of(c, request->length, flexible, BEAMW_TWIST_CUBIC);
    beamw_stiffness_of(c, request->length, flexible ? shear : BEAMW_STIFFNESS_RIGID, &t, &fields,
                       out->S);
    if (modes == BEAMW_PREPARE_PRINTED)
        beamw_modified_printed(c, request->features, out);
    return finish(request, &fields, out, f);
}

status beamw_prepare_consistent(const element_request *request, beamw_consistent_data *out,
                                fault *f)
{
    const section *c = request->section;
    TRY(beam_length_check(request->length, f));
    const int flexible = (request->features & FEATURE_SHEAR) != 0,
              warping = (request->features & FEATURE_WARPING) != 0;
    const beamw_twist t = beamw_twist_of(c, request->length, flexible,
                                         (beamw_twist_kind)request->options[OPTION_TORSION]);
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES];
    beamw_stiffness_fields fields;
    memset(out, 0, sizeof *out);
    out->variant.l0 = request->length;
    out->condensed = request->options[OPTION_INSIDE] != 0;
    beamw_stiffness_of(c, request->length,
                       flexible ? BEAMW_STIFFNESS_COUPLED : BEAMW_STIFFNESS_RIGID, &t, &fields,
                       out->variant.S);
    beamw_modified_consistent(c, request->features, request->length, &t, &fields, Q);
    beamw_modified_reduce(&fields, Q, &out->variant);
    beamw_condensed_prepare(c, request->length, flexible, warping, &t, &fields, Q, &out->internal);
    return finish(request, &fields, &out->variant, f);
}
