/* A strip of 200 x 10 mm twisted at its tip, free to shorten: Wagner torque and shortening in
 * uniform torsion. Exact: M = GJ phi/L + E I_n (phi/L)^3/2 with I_n = t b^5/180 and J = b t^3/3;
 * shortening L (b^2 + t^2)/24 (phi/L)^2. */
#include "cases/case.h"

#include <math.h>
#include <stddef.h>

enum { ANGLE };

static const parameter_type parameters[] = {
    [ANGLE] = {"angle", "rad", 1.0, -3.0, 3.0, NULL, "twist of the tip"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double length = 1.0, b = 0.2, t = 0.01;
    section_spec spec = section_spec_rectangle(2e11, 8e10, b, t);
    spec.given.Iw = 0;
    spec.given.It = b * t * t * t / 3;
    spec.given.wagner_torque = pow(b, 5) * t / 1440; /* both of a thin strip */
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, profile, y_axis);
    scene_hold_all(s, root);
    scene_hold(s, tip, SCENE_UY, SCENE_UZ);
    scene_hold(s, tip, SCENE_RY, SCENE_RZ);
    const double path[2] = {0, 1}, angle[2] = {0, value[ANGLE]};
    scene_drive(s, tip, SCENE_RX, scene_add_driver(s, "angle", 2, path, angle));
    scene_omit(s, FEATURE_SHEAR); /* which uniform torsion has none of */

    const double end = 1;
    const int twisting = scene_add_static(s, 1, &end, 1);
    scene_add_quantity(s, "moment", "N m", twisting, scene_reaction(tip, SCENE_RX));
    scene_quantity *shortening =
        scene_add_quantity(s, "shortening", "m", twisting, scene_coordinate(tip, SCENE_UX));
    shortening->factor = -1;
    scene_meshes_doubled(s, 1, 8);
    return STATUS_OK;
}

const case_type case_wagner_torsion = {
    .name = "wagner_torsion",
    .summary = "twisted strip, free to shorten: Wagner torque",
    .source = "exact solution of uniform torsion with the Wagner torque",
    .parameters = {parameters, case_omit},
    .build = build,
};
