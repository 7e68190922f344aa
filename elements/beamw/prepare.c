#include "elements/beamw/prepare.h"

#include <math.h>
#include <string.h>

#include "elements/beamw/inertia.h"
#include "elements/beamw/modified.h"
#include "elements/beamw/screw.h"

enum { OPTION_MASS };

const element_option prepare_options[] = {
    [OPTION_MASS] = {"mass", "lumped|consistent|averaged", INERTIA_CONSISTENT, 0, 2,
                     "mass matrix: J Eq. 73, from the shape functions, or the mean of the two", FEATURE_MASS},
    {NULL, NULL, 0, 0, 0, NULL, 0},
};

status prepare_form(const element_request *request, stiffness_shear shear, prepare_modes modes, element_data *out, fault *f)
{
    const section *c = request->section;
    if (!(request->length > 0) || !isfinite(request->length))
        return fault_set(f, STATUS_REFUSED, "element length %g m: it must be positive", request->length);
    stiffness_fields fields;
    memset(out, 0, sizeof *out);
    out->l0 = request->length;
    stiffness_of(c, request->length, request->features & FEATURE_SHEAR ? shear : STIFFNESS_RIGID, &fields, out->S);
    if (modes == PREPARE_PRINTED)
        modified_printed(c, request->features, out);
    else if (modes == PREPARE_CONSISTENT) {
        screw_prepare(out);
        const status made = modified_consistent(c, request->features, &fields, out, f);
        if (made != STATUS_OK)
            return made;
    }
    if (request->features & FEATURE_MASS)
        inertia_prepare(c, request->features, (inertia_kind)request->options[OPTION_MASS], &fields, out);
    if (!(request->features & FEATURE_WARPING))
        forms_drop_warping(out);
    for (int i = 0; i < 64; i++)
        if (!isfinite(out->S[i]))
            return fault_set(f, STATUS_REFUSED, "element of length %g m: its stiffness overflows; use fewer elements",
                             request->length);
    return STATUS_OK;
}
