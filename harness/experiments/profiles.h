/* Sections of the elements that are checked. */
#ifndef BEAMWORK_PROFILES_H
#define BEAMWORK_PROFILES_H

#include "elements/section/section.h"

typedef enum profiles_form {
    PROFILES_RECTANGLE,   /* what every formulation can do */
    PROFILES_UNSYMMETRIC, /* an open section of three walls, its shear centre off the centroid */
    PROFILES_MATRICES     /* every entry of its matrices of a size that matters */
} profiles_form;

/* Lengths in units of `unit` metres, force in newtons, time in seconds of the same mass. */
status profiles_section(profiles_form form, double unit, section *out, fault *f);
section_spec profiles_matrices(double unit);

#endif
