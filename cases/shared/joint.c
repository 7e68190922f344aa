#include "cases/shared/joint.h"

#include <stddef.h>

#include <math.h>

#include "cases/shared/sheet.h"

const parameter_type joint_parameters[] = {
    [JOINT_LENGTH] = {"length", "m", 0.0681, 1e-6, 1e3, NULL, "length of a sheet"},
    [JOINT_WIDTH] = {"width", "m", 0.0282, 1e-6, 1e3, NULL,
                     "width of a sheet, along the fold line"},
    [JOINT_THICKNESS] = {"thickness", "m", 0.000838, 1e-9, 1e3, NULL, "thickness of a sheet"},
    [JOINT_YOUNG] = {"young", "Pa", 210e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [JOINT_POISSON] = {"poisson", "1", 0.3, -0.99, 0.49, NULL, "Poisson's ratio"},
    [JOINT_FOLD_ANGLE] = {"fold_angle", "rad", 86.2 * JOINT_DEGREE, 0.01, 3.13, NULL,
                          "angle between the two sheets of a fold"},
    [JOINT_RADIUS] = {"radius", "m", 0.0343, 1e-6, 1e3, NULL,
                      "distance of a fold line's outer end from the centre"},
    [JOINT_POLAR] = {"polar_angle", "rad", 40.2 * JOINT_DEGREE, 0.01, 1.56, NULL,
                     "angle between a fold line and the z axis"},
    [JOINT_AZIMUTH] = {"azimuth", "rad", 0.0, -6.3, 6.3, NULL, "azimuth of the first fold"},
    [JOINT_FOLD_WARPING] = {"fold_warping", "", 0, 0, 0, "shared|free|fixed",
                            "warping of the two sheets at their fold"},
    [JOINT_WAGNER] = {"wagner", "1", 1, 0, 1, NULL, "1: Wagner torque (N Eq. 46)"},
    [JOINT_DIRECTION] = {"element_direction", "", 0, 0, 0, "bodies|chained",
                         "elements begin at the bodies, or run base - fold - body"},
    {0},
};

enum { FOLDS = 3 };

status joint_prepare(const double value[], scene *s, int *profile, fault *f)
{
    if (value[JOINT_RADIUS] <= value[JOINT_WIDTH])
        return fault_set(f, STATUS_REFUSED,
                         "radius = %g m: a fold line of width %g m would reach through the centre; "
                         "give a larger radius",
                         value[JOINT_RADIUS], value[JOINT_WIDTH]);
    section_spec spec;
    sheet_section(value[JOINT_WIDTH], value[JOINT_THICKNESS], value[JOINT_YOUNG],
                  value[JOINT_POISSON], 0, &spec);
    *profile = scene_add_section(s, &spec);
    if (value[JOINT_WAGNER] == 0)
        scene_omit(s, FEATURE_WAGNER_TORQUE);
    return STATUS_OK;
}

/* A point given in the joint's axes, in global coordinates. */
static void to_global(const double centre[3], const double axes[9], const double local[3],
                      double global[3])
{
    for (int i = 0; i < 3; i++)
        global[i] = centre[i] + axes[3 * i] * local[0] + axes[3 * i + 1] * local[1] +
                    axes[3 * i + 2] * local[2];
}

/* The direction of its elements matters to formulations that do not treat both ends alike. */
static void add_sheet(const double value[], scene *s, int profile, int body, const double end[3],
                      int fold, const double normal[3], int side)
{
    const int clamp = scene_add_attached(s, body, end[0], end[1], end[2]);
    const int from_fold = value[JOINT_DIRECTION] != 0 && side == 1;
    scene_member *sheet =
        scene_member_at(s, scene_add_member(s, from_fold ? fold : clamp, from_fold ? clamp : fold,
                                            profile, normal));
    const int at_fold[] = {fold, SCENE_WARP_FREE, SCENE_WARP_FIXED};
    *(from_fold ? &sheet->warp_q : &sheet->warp_p) = SCENE_WARP_FIXED;
    *(from_fold ? &sheet->warp_p : &sheet->warp_q) = at_fold[(int)value[JOINT_FOLD_WARPING]];
}

/* Fold at one azimuth; up = +1: first set (fold line above the centre), -1: its mirror image in the
 * xy plane. The sheet on the +azimuth side goes to body[0], the other to body[1]. */
static void add_fold(const double value[], scene *s, int profile, const double centre[3],
                     const double axes[9], double azimuth, int up, const int body[2])
{
    static const double origin[3] = {0, 0, 0};
    const double polar = value[JOINT_POLAR], half = value[JOINT_FOLD_ANGLE] / 2;
    const double radial[3] = {cos(azimuth), sin(azimuth), 0},
                 tangent[3] = {-sin(azimuth), cos(azimuth), 0};
    const double middle = value[JOINT_RADIUS] - value[JOINT_WIDTH] / 2;
    double centre_line[3], outward[3];
    for (int i = 0; i < 3; i++) {
        const double z = i == 2 ? up : 0;
        centre_line[i] = sin(polar) * radial[i] + cos(polar) * z; /* of the fold */
        outward[i] =
            cos(polar) * radial[i] - sin(polar) * z; /* bisects the sheets, across the fold line */
    }
    double point[3], global[3];
    for (int i = 0; i < 3; i++)
        point[i] = middle * centre_line[i];
    to_global(centre, axes, point, global);
    const int fold = scene_add_node(s, global[0], global[1], global[2]);
    for (int side = 0; side < 2; side++) {
        const double sign = side == 0 ? 1 : -1;
        double end[3], across[3], end_global[3], normal[3];
        for (int i = 0; i < 3; i++) {
            end[i] = point[i] +
                     value[JOINT_LENGTH] * (cos(half) * outward[i] + sign * sin(half) * tangent[i]);
            across[i] = -sin(half) * outward[i] + sign * cos(half) * tangent[i];
        }
        to_global(centre, axes, end, end_global);
        to_global(origin, axes, across, normal);
        add_sheet(value, s, profile, body[side], end_global, fold, normal, side);
    }
}

int joint_add(const double value[], scene *s, int profile, const double centre[3],
              const double axes[9], int base, int effector)
{
    const double third = 120 * JOINT_DEGREE;
    const int intermediate = scene_add_node(s, centre[0], centre[1], centre[2]);
    const int first[2] = {base, intermediate}, second[2] = {intermediate, effector};
    for (int k = 0; k < FOLDS; k++)
        add_fold(value, s, profile, centre, axes, value[JOINT_AZIMUTH] + k * third, 1, first);
    for (int k = 0; k < FOLDS; k++)
        add_fold(value, s, profile, centre, axes, value[JOINT_AZIMUTH] + (k + 0.5) * third, -1,
                 second);
    return intermediate;
}
