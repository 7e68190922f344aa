#include "cases/shared/hexapod.h"

#include <math.h>
#include <stddef.h>

/* In the order of the enumeration. */
const parameter_type hexapod_parameters[] = {
    {"base_radius", "m", 0.40, 1e-3, 1e3, NULL, "radius of the crank pivots"},
    {"crank_length", "m", 0.20, 1e-3, 1e3, NULL, "length of a crank, pointing inwards"},
    {"crank_azimuth", "rad", 12 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a crank from the middle of its pair"},
    {"platform_radius", "m", 0.16, 1e-3, 1e3, NULL, "radius of the platform's joint centres"},
    {"platform_azimuth", "rad", 48 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a platform joint from the middle of its pair"},
    {"height", "m", 0.30, 1e-3, 1e3, NULL, "height of the platform above the cranks' plane"},
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
    const double pivot = value[HEXAPOD_BASE_RADIUS];
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

static hexapod_leg add_leg(const double value[], scene *s, int profile, int leg, int angle,
                           int platform)
{
    const double side = leg % 2 == 0 ? -1 : 1, middle = 120 * JOINT_DEGREE * (leg >> 1);
    const double below = middle + side * value[HEXAPOD_CRANK_AZIMUTH],
                 above = middle + side * value[HEXAPOD_PLATFORM_AZIMUTH];
    const double tip_radius = value[HEXAPOD_BASE_RADIUS] - value[HEXAPOD_CRANK_LENGTH];
    const double low[3] = {tip_radius * cos(below), tip_radius * sin(below), 0};
    const double high[3] = {value[HEXAPOD_PLATFORM_RADIUS] * cos(above),
                            value[HEXAPOD_PLATFORM_RADIUS] * sin(above), value[HEXAPOD_HEIGHT]};
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
    hexapod_leg out = {.rod = rod};
    joint_axes(back, axes);
    out.joint[0] = joint_add(value, s, profile, low, axes, rod, crank);
    joint_axes(along, axes);
    out.joint[1] = joint_add(value, s, profile, high, axes, rod, platform);
    return out;
}

int hexapod_platform(const double value[], scene *s)
{
    return scene_add_node(s, 0, 0, value[HEXAPOD_HEIGHT]);
}

status hexapod_add(const double value[], scene *s, int angle, int platform, int *profile,
                   hexapod_leg legs[HEXAPOD_LEGS], fault *f)
{
    TRY(joint_prepare(value, s, profile, f));
    if (value[HEXAPOD_CRANK_LENGTH] >= value[HEXAPOD_BASE_RADIUS])
        return fault_set(
            f, STATUS_REFUSED,
            "crank_length = %g m reaches beyond the centre; give less than base_radius = %g m",
            value[HEXAPOD_CRANK_LENGTH], value[HEXAPOD_BASE_RADIUS]);
    for (int leg = 0; leg < HEXAPOD_LEGS; leg++)
        legs[leg] = add_leg(value, s, *profile, leg, angle, platform);
    return STATUS_OK;
}
