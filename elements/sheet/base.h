/* What every sheet-flexure formulation begins with: generalized strains, linear stiffness, Wagner torque and lumped mass. */
#ifndef BEAMWORK_SHEET_BASE_H
#define BEAMWORK_SHEET_BASE_H

#include "elements/shared/lumped.h"
#include "elements/sheet/strains.h"
#include "elements/sheet/wagner.h"

typedef enum base_shear {
    BASE_PRINTED,   /* N Eq. 37: shear is left out of the strains */
    BASE_CONSISTENT /* the same integrals of the whole linear solution, ours */
} base_shear;

typedef struct base_data {
    double S[SHEET_STRAINS * SHEET_STRAINS]; /* N Eqs. 33-36 [N/m] */
    lumped_mass lumped;                      /* of the whole element */
    strains_table table;
    wagner_term wagner;
} base_data;

/* What every one of them offers and is limited to. */
enum {
    BASE_OFFERS = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE |
                  FEATURE_HARINGX | FEATURE_ENGESSER | FEATURE_GEOMETRIC | FEATURE_LARGE |
                  FEATURE_MASS | FEATURE_ROTARY_INERTIA | FEATURE_CURVATURE,
    BASE_LIMITS = LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT | LIMIT_QUARTER_TURN
};

status base_prepare(const element_request *request, base_shear shear, base_data *out, fault *f);

/* Members of element_type; the data begin with base_data. */
void base_strain(const element_data *d, const node_state x[], strain_output *out);
status base_inertia(const element_data *d, const node_state x[], const element_spin *spin,
                    inertia_output *out);

#endif
