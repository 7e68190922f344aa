#include "harness/records/outline.h"

#include <math.h>

#include "elements/math/pi.h"

enum { RING = 24 }; /* sides of a tube */

/* Corners of a wall of thickness t whose mid-line runs from a to b. */
static void add_wall(outline *out, const double a[2], const double b[2], double t)
{
    const double length = hypot(b[0] - a[0], b[1] - a[1]);
    const double across[2] = {-(b[1] - a[1]) / length * t / 2, (b[0] - a[0]) / length * t / 2};
    double(*corner)[2] = out->corner[out->walls++];
    for (int i = 0; i < 2; i++) {
        corner[0][i] = a[i] + across[i];
        corner[1][i] = a[i] - across[i];
        corner[2][i] = b[i] - across[i];
        corner[3][i] = b[i] + across[i];
    }
}

/* Side k of a tube drawn as a polygon: corners lie on its circles, from inside to outside at either
 * end. */
static void add_side(outline *out, const section_spec *spec, int k)
{
    double(*corner)[2] = out->corner[out->walls++];
    for (int i = 0; i < 4; i++) {
        const int at = i < 2 ? k : k + 1;
        const double angle = 2 * PI * at / RING,
                     r = spec->diameter / 2 - (i == 0 || i == 3 ? spec->wall_thickness : 0);
        corner[i][0] = r * cos(angle);
        corner[i][1] = r * sin(angle);
    }
}

static void principal(const section *s, const double point[2], double out[2])
{
    const double y = point[0] - s->centroid[0], z = point[1] - s->centroid[1],
                 c = cos(s->axes_angle), d = sin(s->axes_angle);
    out[0] = c * y + d * z;
    out[1] = c * z - d * y;
}

/* Sides along y and z of a rectangle that stands for a section. */
static void sides_of(const section_spec *spec, const section *c, double side[2])
{
    const double ratio = sqrt(c->Iy / c->Iz); /* of width to height: Iy/Iz = (w/h)^2 */
    side[0] = spec->kind == SECTION_MATRICES ? sqrt(12 * c->Iz / c->A) : sqrt(c->A / ratio);
    side[1] = spec->kind == SECTION_MATRICES ? sqrt(12 * c->Iy / c->A) : sqrt(c->A * ratio);
    if (c->rectangle) {
        side[0] = c->height;
        side[1] = c->width;
    }
}

/* The mid-line is along y or along z. */
static void add_rectangle(outline *out, const double side[2], int along_y)
{
    const double to[2] = {along_y ? side[0] / 2 : 0, along_y ? 0 : side[1] / 2};
    add_wall(out, (double[2]){-to[0], -to[1]}, to, side[along_y]);
}

void outline_of_far_end(const section_spec *spec, const section *c, const section *near,
                        outline *out)
{
    double side[2];
    out->walls = 0;
    out->equivalent =
        spec->kind == SECTION_MATRICES || (spec->kind == SECTION_CONSTANTS && !c->rectangle);
    if (spec->kind == SECTION_TUBE) {
        for (int k = 0; k < RING; k++)
            add_side(out, spec, k);
        return;
    }
    if (spec->kind == SECTION_WALLS) {
        for (int w = 0; w < spec->walls; w++) {
            double a[2], b[2];
            principal(c, spec->point[spec->wall[w].from], a);
            principal(c, spec->point[spec->wall[w].to], b);
            add_wall(out, a, b, spec->wall[w].thickness);
        }
        return;
    }
    sides_of(spec, near, side);
    const int along_y = side[1] < side[0]; /* the longer one */
    sides_of(spec, c, side);
    add_rectangle(out, side, along_y);
}

void outline_of(const section_spec *spec, const section *c, outline *out)
{
    outline_of_far_end(spec, c, c, out);
}

void outline_between(const outline *near, const outline *far, double x, outline *out)
{
    *out = *near;
    for (int w = 0; w < near->walls; w++)
        for (int k = 0; k < 4; k++)
            for (int i = 0; i < 2; i++)
                out->corner[w][k][i] += x * (far->corner[w][k][i] - near->corner[w][k][i]);
}
