/* What the BEAMW forms have in common when an element is prepared: a stiffness, modified modes and a mass are chosen. */
#ifndef BEAMWORK_BEAMW_PREPARE_H
#define BEAMWORK_BEAMW_PREPARE_H

#include "elements/beamw/follow.h"

typedef enum prepare_modes {
    PREPARE_FIRST_ORDER, /* ebar = e */
    PREPARE_PRINTED      /* J Eq. 66 */
} prepare_modes;

/* Without FEATURE_SHEAR in the request the stiffness is shear-rigid, whatever `shear` says. */
status prepare_form(const element_request *request, stiffness_shear shear, prepare_modes modes,
                    element_data *out, fault *f);

/* modified_consistent; `form` is first, so that a pointer to the whole is one to it. */
typedef struct consistent_data {
    element_data form;
    int following;
    follow inside;
} consistent_data;

status prepare_consistent(const element_request *request, consistent_data *out, fault *f);

/* Options in the order prepare_form reads them; those of prepare_consistent are more. */
extern const element_option prepare_options[], prepare_options_consistent[];

#endif
