#include "cases/shared/channel.h"

#include <stddef.h>

void channel_section(const channel *c, section_spec *out)
{
    const double half = c->height / 2, flange = c->flange_thickness;
    const double point[4][2] = {{-c->width, half}, {0, half}, {0, -half}, {-c->width, -half}};
    const double thickness[3] = {flange, c->web_thickness, flange};
    *out = section_spec_walls(c->young, c->shear_modulus, 3, point, NULL, thickness);
    out->density = c->density;
}

void channel_print_constants(int data, section_spec *out)
{
    if (data == CHANNEL_SHEAR_FLOW)
        return;
    out->given.Iw = 1.3886e-4;
    out->given.ys = 0.4571;
    out->given.Dy = 2.79e-2;
    out->given.Dz = 1.58e-2;
    out->given.Dzw = -3.70e-3;
    /* Printed as 3.65e6 mm^4, for which D is indefinite: 3.65e9 mm^4 is meant. */
    out->given.Dw = data == CHANNEL_PRINTED ? 3.65e-3 : 3.65e-6;
}

channel channel_of_cantilever(int centreline)
{
    const double flange = 0.016, web = 0.010, outer_height = 0.30, outer_width = 0.10;
    return (channel){.height = centreline ? outer_height : outer_height - flange,
                     .width = centreline ? outer_width : outer_width - web / 2,
                     .flange_thickness = flange,
                     .web_thickness = web,
                     .young = 210e9,
                     .shear_modulus = 80.77e9,
                     .density = 7800};
}
