/* Flexure-based hexapod: six cranks, six rods, twelve spherical flexure joints, a platform that
 * moves along z; support stiffness along z with the cranks held.  N section 4.3, Fig. 10; the
 * published sizes are not in the paper: synthetic. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "cases/shared/joint.h"

enum {
    BASE_RADIUS = JOINT_PARAMETERS,
    CRANK_LENGTH,
    CRANK_AZIMUTH,
    PLATFORM_RADIUS,
    PLATFORM_AZIMUTH,
    HEIGHT,
    STROKE,
    STEPS
};
enum { LEGS = 6, MAX_STEPS = 101 };

/* In the order of the enumeration. */
static const parameter_type parameters[] = {
    {"base_radius", "m", 0.40, 1e-3, 1e3, NULL, "radius of the crank pivots"},
    {"crank_length", "m", 0.20, 1e-3, 1e3, NULL, "length of a crank, pointing inwards"},
    {"crank_azimuth", "rad", 12 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a crank from the middle of its pair"},
    {"platform_radius", "m", 0.16, 1e-3, 1e3, NULL, "radius of the platform's joint centres"},
    {"platform_azimuth", "rad", 48 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a platform joint from the middle of its pair"},
    {"height", "m", 0.30, 1e-3, 1e3, NULL, "height of the platform above the cranks' plane"},
    {"stroke", "m", 0.05, 0, 1e2, NULL, "the platform moves from -stroke to +stroke"},
    {"steps", "1", 11, 2, MAX_STEPS, NULL, "positions of the platform"},
    {0},
};

/* Joint axes for a rod: z along `direction`, x in the plane of the rod and the global z axis on the
 * upper side. */
static void joint_axes(const double direction[3], double axes[9])
{
    double x[3] = {-direction[2] * direction[0], -direction[2] * direction[1],
                   1 - direction[2] * direction[2]};
    const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; i++)
        x[i] /= length;
    const double *z = direction;
    const double y[3] = {z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2],
                         z[0] * x[1] - z[1] * x[0]};
    for (int i = 0; i < 3; i++) {
        axes[3 * i] = x[i];
        axes[3 * i + 1] = y[i];
        axes[3 * i + 2] = z[i];
    }
}

static int add_crank(const double value[], scene *s, double azimuth, int angle)
{
    const double pivot = value[BASE_RADIUS];
    const int crank = scene_add_node(s, pivot * cos(azimuth), pivot * sin(azimuth), 0);
    scene_hold(s, crank, SCENE_UX, SCENE_UZ);
    scene_node *n = scene_node_at(s, crank);
    n->rotation =
        SCENE_ROTATION_SEQUENCE; /* about the horizontal tangent: a positive angle lifts the tip */
    n->axis[0][0] = -sin(azimuth);
    n->axis[0][1] = cos(azimuth);
    n->angle[0] = angle;
    return crank;
}

static void add_leg(const double value[], scene *s, int profile, int leg, int angle, int platform)
{
    const double side = leg % 2 == 0 ? -1 : 1, middle = 120 * JOINT_DEGREE * (leg >> 1);
    const double below = middle + side * value[CRANK_AZIMUTH],
                 above = middle + side * value[PLATFORM_AZIMUTH];
    const double tip_radius = value[BASE_RADIUS] - value[CRANK_LENGTH];
    const double low[3] = {tip_radius * cos(below), tip_radius * sin(below), 0};
    const double high[3] = {value[PLATFORM_RADIUS] * cos(above),
                            value[PLATFORM_RADIUS] * sin(above), value[HEIGHT]};
    double along[3], length = 0;
    for (int i = 0; i < 3; i++)
        length += (high[i] - low[i]) * (high[i] - low[i]);
    length = sqrt(length);
    for (int i = 0; i < 3; i++)
        along[i] = (high[i] - low[i]) / length;
    const double back[3] = {-along[0], -along[1], -along[2]};
    const int crank = add_crank(value, s, below, angle);
    const int rod = scene_add_node(s, low[0], low[1], low[2]);
    double axes[9];
    joint_axes(back, axes);
    joint_add(value, s, profile, low, axes, rod, crank);
    joint_axes(along, axes);
    joint_add(value, s, profile, high, axes, rod, platform);
}

static void add_stiffnesses(scene *s, int compliance, const double station[], int steps)
{
    for (int i = 0; i <= steps; i++) {
        char name[SCENE_NAME] = "support_stiffness_curve";
        if (i < steps)
            snprintf(name, sizeof name, "support_stiffness_%d", i + 1);
        scene_quantity *q =
            scene_add_quantity(s, name, "N/m", compliance, scene_stiffness_entry(SCENE_UZ));
        q->least_order = 1.5;
        if (i < steps)
            scene_set_at(q, station[i]);
        else
            scene_set_curve(q, "position", "1", 1, 0);
    }
}

static status build(const double value[], scene *s, fault *f)
{
    int profile;
    TRY(joint_prepare(value, s, &profile, f));
    if (value[CRANK_LENGTH] >= value[BASE_RADIUS])
        return fault_set(
            f, STATUS_REFUSED,
            "crank_length = %g m reaches beyond the centre; give less than base_radius = %g m",
            value[CRANK_LENGTH], value[BASE_RADIUS]);
    const int platform = scene_add_node(s, 0, 0, value[HEIGHT]);
    const int steps = (int)value[STEPS];
    double station[MAX_STEPS + 1], height[MAX_STEPS + 1];
    for (int k = 0; k <= steps; k++) {
        station[k] = k;
        height[k] = k == 0 ? 0 : value[STROKE] * (2.0 * (k - 1) / (steps - 1) - 1);
    }
    const int lift = scene_add_driver(s, "platform_height", steps + 1, station, height);
    scene_drive(s, platform, SCENE_UZ, lift);
    const int angle = scene_add_unknown_driver(s, "crank_angle", platform, SCENE_UZ, lift);
    for (int leg = 0; leg < LEGS; leg++)
        add_leg(value, s, profile, leg, angle, platform);

    const int lifting = scene_add_static(s, steps, station + 1, 1);
    /* The condition ends: the cranks hold their angle. */
    const int compliance = scene_add_compliance(
        s, lifting, (scene_compliance){.node = platform, .released = 1u << SCENE_UZ});
    add_stiffnesses(s, compliance, station + 1, steps);
    scene_add_quantity(s, "crank_angle", "rad", lifting, scene_driver_value(angle));
    scene_meshes_doubled(s, 1, 8);
    return STATUS_OK;
}

const case_type case_hexapod = {
    .name = "hexapod",
    .summary = "flexure hexapod of twelve spherical joints: support stiffness along its stroke",
    .source = "N section 4.3, Fig. 10; synthetic sizes",
    .parameters = {joint_parameters, parameters},
    .build = build,
};
