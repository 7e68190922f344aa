/* The C-shaped section that several scenes share. */
#ifndef BEAMWORK_CASES_CHANNEL_H
#define BEAMWORK_CASES_CHANNEL_H

#include "elements/section/section.h"

/* Where the section's constants come from. */
enum { CHANNEL_SHEAR_FLOW, CHANNEL_PRINTED, CHANNEL_MISPRINTED };
#define CHANNEL_DATA_CHOICES "shear_flow|printed|misprinted"

typedef struct channel {
    double height, width;                   /* of the centre line [m] */
    double flange_thickness, web_thickness; /* [m] */
    double young, shear_modulus, density;   /* [Pa, Pa, kg/m^3] */
} channel;

/* Walls of a C whose web is on the +y side, parallel to z. */
void channel_section(const channel *c, section_spec *out);

/* The rounded constants printed for the C of 600 mm (J Table 1; D_w corrected, or as misprinted).
 */
void channel_print_constants(int data, section_spec *out);

/* That of the cantilever of J section 5.2, of steel; centreline: 30 x 10 cm are sizes of the centre
 * line, else outer ones. */
channel channel_of_cantilever(int centreline);

#endif
