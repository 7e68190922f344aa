/* Common preparation of the BEAMW variants: a stiffness, modified modes and a mass are chosen. */
#ifndef BEAMWORK_BEAMW_PREPARE_H
#define BEAMWORK_BEAMW_PREPARE_H

#include "elements/beamw/condensed.h"
#include "elements/beamw/inertia.h"
#include "elements/shared/lanes.h"

typedef enum beamw_prepare_modes {
    BEAMW_PREPARE_FIRST_ORDER, /* ebar = e */
    BEAMW_PREPARE_PRINTED      /* J Eq. 66 */
} beamw_prepare_modes;

/* Without FEATURE_SHEAR in the request the stiffness is shear-rigid, whatever `shear` says. */
status beamw_prepare_variant(const element_request *request, beamw_stiffness_shear shear,
                             beamw_prepare_modes modes, element_data *out, fault *f);

/* beamw_modified_consistent; `variant` is first, so that a pointer to the whole is one to it. */
typedef struct beamw_consistent_data {
    element_data variant;
    int condensed;
    beamw_condensed internal;
} beamw_consistent_data;

static inline const beamw_consistent_data *beamw_prepare_whole(const element_data *d)
{
    return (const beamw_consistent_data *)(const void *)d;
}

status beamw_prepare_consistent(const element_request *request, beamw_consistent_data *out,
                                fault *f);

/* The option of beamw_prepare_variant, and those that beamw_prepare_consistent has beside it. */
extern const parameter_type beamw_prepare_mass[], beamw_prepare_inside[];
/* Common to all of them. */
int beamw_prepare_mass_of_field(const double options[]);
element_order beamw_prepare_order(element_analysis, const double options[]);
/* element_type.judged of both. */
extern const unsigned beamw_prepare_judged[];

/* In an element_type: what those that beamw_prepare_variant prepares have; and what they offer
 * beside theories of shear. */
#define BEAMW_VARIANT_TYPE                                                                         \
    .family = "beamw", .abi = ELEMENT_ABI, .limits = LIMIT_QUARTER_TURN | LIMIT_EIGHTH_TWIST,      \
    .options = {beamw_prepare_mass}, .judged = beamw_prepare_judged,                               \
    .data_size = beamw_variants_data_size, .strain = beamw_variants_strain,                        \
    .stress = beamw_variants_stress, .geometric = beamw_variants_geometric,                        \
    .strain_many = beamw_variants_strain_many, .stress_many = beamw_variants_stress_many,          \
    .lanes = LANES_TOGETHER, .inertia = beamw_inertia_of, .spreads = 1,                            \
    .mass_of_field = beamw_prepare_mass_of_field, .order = beamw_prepare_order
enum {
    BEAMW_OFFERS = FEATURE_TRAPEZE | FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_GEOMETRIC |
                   FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA
};

#endif
