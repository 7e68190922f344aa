/* Hinged frame of two deep thin strips under end moments in its plane: lateral buckling through the
 * corner.  Argyris et al. (1979), right angle; the first critical moment is pi/L sqrt(EI GJ) for
 * every angle, EI about the weak axis, J = b t^3/3; the second depends on the angle and on EI/GJ.
 */
#include "cases/case.h"

#include <math.h>
#include <stddef.h>

enum { LEG, DEPTH, THICKNESS, YOUNG, POISSON, ANGLE };

static const parameter_type parameters[] = {
    [LEG] = {"leg", "m", 0.24, 1e-6, 1e6, NULL, "length of a leg"},
    [DEPTH] = {"depth", "m", 0.03, 1e-9, 1e3, NULL,
               "depth of the strip, in the plane of the frame"},
    [THICKNESS] = {"thickness", "m", 0.0006, 1e-12, 1e3, NULL, "thickness of the strip"},
    [YOUNG] = {"young", "Pa", 71.24e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [POISSON] = {"poisson", "1", 0.31, -0.99, 0.49, NULL, "Poisson's ratio"},
    [ANGLE] = {"angle", "rad", 1.5707963267948966, 0.1, 3.1, NULL, "between the legs"},
    {0},
};

/* Hinge about z that can slide along x. */
static void hinge(scene *s, int node)
{
    scene_hold(s, node, SCENE_UY, SCENE_UZ);
    scene_hold(s, node, SCENE_RX, SCENE_RY);
}

static void add_moment(scene *s, int buckling, const char *name, int order)
{
    scene_quantity *q =
        scene_add_quantity(s, name, "N m", buckling, scene_critical_factor(1, order));
    q->least_order = 1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    /* its depth lies along the local z, in the plane */
    section_spec spec = section_spec_rectangle(
        value[YOUNG], value[YOUNG] / (2 * (1 + value[POISSON])), value[DEPTH], value[THICKNESS]);
    spec.given.Iw = 0;
    spec.given.It = value[DEPTH] * pow(value[THICKNESS], 3) / 3;
    scene_omit(s, FEATURE_SHEAR | FEATURE_TRAPEZE);
    const int profile = scene_add_section(s, &spec);
    const double half = value[LEG] * sin(value[ANGLE] / 2),
                 rise = value[LEG] * cos(value[ANGLE] / 2), y_axis[3] = {0, 0, 1};
    const int left = scene_add_node(s, -half, 0, 0), corner = scene_add_node(s, 0, rise, 0),
              right = scene_add_node(s, half, 0, 0);
    scene_add_member(s, left, corner, profile, y_axis);
    scene_add_member(s, corner, right, profile, y_axis);
    hinge(s, left);
    hinge(s, right);
    scene_hold(s, corner, SCENE_UX, SCENE_UX);
    scene_add_load(s, SCENE_MOMENT, left, 0, 0, 1);
    scene_add_load(s, SCENE_MOMENT, right, 0, 0, -1);
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    add_moment(s, buckling, "critical_moment", 0);
    add_moment(s, buckling, "critical_moment_2", 1);
    scene_meshes_doubled(s, 2, 64);
    return STATUS_OK;
}

const case_type case_right_angle_frame = {
    .name = "right_angle_frame",
    .summary = "hinged right-angle frame under end moments: lateral buckling",
    .source = "Argyris et al., Comput. Meth. Appl. Mech. Eng. 17/18 (1979)",
    .parameters = {parameters, case_omit},
    .build = build,
};
