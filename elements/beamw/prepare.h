/* What the BEAMW forms have in common when an element is prepared: a stiffness, modified modes and a mass are chosen. */
#ifndef BEAMWORK_BEAMW_PREPARE_H
#define BEAMWORK_BEAMW_PREPARE_H

#include "elements/beamw/stiffness.h"

typedef enum prepare_modes {
    PREPARE_FIRST_ORDER, /* ebar = e */
    PREPARE_PRINTED,     /* J Eq. 66 */
    PREPARE_CONSISTENT   /* modified_consistent */
} prepare_modes;

/* Without FEATURE_SHEAR in the request the stiffness is shear-rigid, whatever `shear` says. */
status prepare_form(const element_request *request, stiffness_shear shear, prepare_modes modes, element_data *out, fault *f);

/* Options in the order prepare_form reads them; those of PREPARE_CONSISTENT are more. */
extern const element_option prepare_options[], prepare_options_consistent[];

#endif
