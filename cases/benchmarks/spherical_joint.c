/* Spherical flexure joint whose end effector is tilted about an axis in the xy plane. The axis
 * rotates once about z. The case computes the support stiffness along z with the rotations fixed (N
 * section 4.2, Fig. 8, Table 1). */
#include "cases/shared/shared.h"
#include "elements/math/scalar.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

enum { TILT = JOINT_PARAMETERS, STEPS };
enum { MAX_STEPS = 1000 };

static const parameter_type parameters[] = {
    {"tilt", "rad", 15 * JOINT_DEGREE, 0, 1, NULL, "rotation of the end effector"},
    {"steps", "1", 50, 1, MAX_STEPS, NULL, "number of azimuths of the tilt axis in one revolution"},
    {0},
};

/* Prescribes the rotation. At station k = 1 .. steps, the axis is at the azimuth 2 pi (k -
 * 1)/steps. At path parameter 0, the joint is undeformed. */
static void prescribe_rotation(const double value[], scene *s, int effector, double station[])
{
    static const char *const name[3] = {"rotation_x", "rotation_y", "rotation_z"};
    const int steps = (int)value[STEPS];
    scene_node *node = scene_node_at(s, effector);
    node->rotation = SCENE_ROTATION_VECTOR;
    double component[MAX_STEPS + 1];
    for (int k = 0; k <= steps; k++)
        station[k] = k;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k <= steps; k++) {
            const double azimuth = 2 * PI * (k - 1) / steps;
            const double axis[3] = {cos(azimuth), sin(azimuth), 0};
            component[k] = k == 0 ? 0 : value[TILT] * axis[i];
        }
        const int driver = scene_add_driver(s, name[i], steps + 1, station, component);
        scene_node_at(s, effector)->angle[i] = driver;
    }
}

static scene_quantity *add_stiffness(scene *s, const char *name, int analysis,
                                     scene_reduction reduction)
{
    scene_quantity *q =
        scene_add_quantity(s, name, "N/m", analysis, scene_stiffness_entry(SCENE_UZ));
    q->reduction = reduction;
    q->least_order = 1.5;
    return q;
}

static status build(const double value[], scene *s, fault *f)
{
    int profile;
    TRY(joint_prepare(value, s, &profile, f));
    const double centre[3] = {0, 0, 0}, axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int base = scene_add_node(s, 0, 0, 0), effector = scene_add_node(s, 0, 0, 0);
    scene_hold_all(s, base);
    joint_add(value, s, profile, centre, axes, base, effector);
    double station[MAX_STEPS + 1];
    prescribe_rotation(value, s, effector, station);

    const int tilting = scene_add_static(s, (int)value[STEPS], station + 1, 1);
    const scene_compliance of_effector = {.node = effector};
    const int tilted = scene_add_compliance(s, tilting, of_effector),
              rest = scene_add_compliance(s, SCENE_NONE, of_effector);
    add_stiffness(s, "support_stiffness_max", tilted, SCENE_MAX);
    add_stiffness(s, "support_stiffness_min", tilted, SCENE_MIN);
    add_stiffness(s, "support_stiffness_undeformed", rest, SCENE_LAST);
    scene_quantity *curve = add_stiffness(s, "support_stiffness_curve", tilted, SCENE_CURVE);
    const double step = 2 * PI / value[STEPS];
    scene_set_curve(curve, "azimuth", "rad", step, -step); /* the azimuth is 0 at station 1 */
    scene_meshes_doubled(s, 1, 16);
    return STATUS_OK;
}

const case_type case_spherical_joint = {
    .name = "spherical_joint",
    .summary = "spherical flexure joint of six folded sheets: support "
               "stiffness over one revolution of its tilt axis",
    .source = "N, section 4.2, Fig. 8, Table 1; reconstructed geometry",
    .parameters = {joint_parameters, parameters, case_omit},
    .build = build,
};
