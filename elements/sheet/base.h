/* Common base of the sheet-flexure formulations: generalized strains, linear stiffness, Wagner
 * torque and mass. */
#ifndef BEAMWORK_SHEET_BASE_H
#define BEAMWORK_SHEET_BASE_H

#include "elements/field/field_mass.h"
#include "elements/sheet/lanes.h"
#include "elements/sheet/strains.h"
#include "elements/sheet/wagner.h"

typedef enum sheet_base_shear {
    SHEET_BASE_PRINTED,   /* N Eq. 37: shear is omitted from the strains */
    SHEET_BASE_CONSISTENT /* the same integrals of the whole linear solution (derived here) */
} sheet_base_shear;

typedef struct sheet_base_data {
    double S[SHEET_STRAINS * SHEET_STRAINS]; /* N Eqs. 33-36 [N/m] */
    field_mass mass;
    sheet_strains_table table;
    sheet_wagner_term wagner;
} sheet_base_data;

/* Features and restrictions that are common to all of them. */
enum {
    SHEET_BASE_OFFERS = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE |
                        FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA |
                        FEATURE_CURVATURE,
    SHEET_BASE_LIMITS =
        LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT | LIMIT_QUARTER_TURN | LIMIT_WARPING_RIGID
};

status sheet_base_prepare(const element_request *request, sheet_base_shear shear,
                          sheet_base_data *out, fault *f);

/* Members of element_type; the data begin with sheet_base_data. */
void sheet_base_strain(const element_data *d, const node_state x[], strain_output *out);
void sheet_base_strain_many(int count, const element_data *const data[], const node_state x[],
                            strain_output out[]);
status sheet_base_inertia(const element_data *d, const node_state x[],
                          const element_rotating_frame *frame, inertia_output *out);
int sheet_base_mass_of_field(const double options[]);
element_order sheet_base_order(element_analysis, const double options[]);

/* In an element_type: what every sheet element has; and those whose strains see no shear. */
#define SHEET_BASE_TYPE                                                                            \
    .family = "sheet", .abi = ELEMENT_ABI, .order = sheet_base_order, .strain = sheet_base_strain, \
    .inertia = sheet_base_inertia, .spreads = 1, .mass_of_field = sheet_base_mass_of_field,        \
    .lanes = LANES_TOGETHER, .strain_many = sheet_base_strain_many
#define SHEET_BASE_WITHOUT_SHEAR                                                                   \
    .offers = SHEET_BASE_OFFERS, .shear_theories = SHEAR_OWN,                                      \
    .own_theory = "N Eq. 37: generalized strains that see no shear (reference/ERRATA.md, N 37)"

#endif
