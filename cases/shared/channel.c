#include "cases/shared/channel.h"

void channel_section(const channel *c, section_spec *out)
{
    section_spec_init(out);
    out->kind = SECTION_WALLS;
    out->young = c->young;
    out->shear_modulus = c->shear_modulus;
    out->density = c->density;
    const double half = c->height / 2;
    const double point[4][2] = {{-c->width, half}, {0, half}, {0, -half}, {-c->width, -half}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            out->point[i][k] = point[i][k];
    for (int i = 0; i < 3; i++) {
        out->wall[i].from = i;
        out->wall[i].to = i + 1;
        out->wall[i].thickness = i == 1 ? c->web_thickness : c->flange_thickness;
    }
    out->points = 4;
    out->walls = 3;
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
