/* Parameters that are common to all built-in cases: the omitted physics (as in the source, or none)
 * and, if quantities depend on the mass, lumped or consistent mass of members. */
#include "cases/shared/shared.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

static const char omitted[] =
    "omitted physics. source: the physics that the source of the case omits; none: nothing is "
    "omitted, and the values of the source do not apply";

const parameter_type case_omit[] = {
    {"omit", "", 0, 0, 0, "source|none", omitted},
    {0},
};
const parameter_type case_mass_omit[] = {
    {"mass", "", SCENE_MASS_USUAL, 0, 0, "usual|" SCENE_MASS_CHOICES,
     "mass of members. usual: consistent if the formulation and the integrator support it, "
     "otherwise lumped; lumped: at the nodes; consistent: rejected if not supported"},
    {"omit", "", 0, 0, 0, "source|none", omitted},
    {0},
};

int case_is_omit(const parameter_type *p)
{
    return p == case_omit || p == case_mass_omit + 1;
}

int case_is_mass(const parameter_type *p)
{
    return p == case_mass_omit;
}

int case_omits_nothing(const case_type *c, const double value[])
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        if (case_is_omit(p))
            return value[i] != 0;
    return 0;
}

static void place_mass(scene *s, scene_mass mass)
{
    s->lumped = mass == SCENE_LUMPED;
    for (int i = 0; i < s->analyses && mass == SCENE_CONSISTENT; i++)
        if (s->analysis[i].kind == SCENE_MOTION)
            s->analysis[i].of.motion.mass = mass;
}

static void choose_mass(const case_type *c, const double value[], scene *s)
{
    const parameter_type *p;
    for (int i = 0; (p = parameter_at(c->parameters, i)) != NULL; i++)
        if (case_is_mass(p))
            place_mass(s, (scene_mass)value[i]);
}

status case_build(const case_type *c, const double value[], scene *s, fault *f)
{
    TRY(c->build != NULL ? c->build(value, s, f) : c->build_from(c->context, value, s, f));
    if (case_omits_nothing(c, value))
        s->omits = 0;
    choose_mass(c, value, s);
    return STATUS_OK;
}

const parameter_type hexapod_parameters[] = {
    {"base_radius", "m", 0.40, 1e-3, 1e3, NULL, "radius of the crank pivots"},
    {"crank_length", "m", 0.20, 1e-3, 1e3, NULL, "length of a crank, pointing inwards"},
    {"crank_azimuth", "rad", 12 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a crank, measured from the middle of its pair"},
    {"platform_radius", "m", 0.16, 1e-3, 1e3, NULL, "radius of the platform's joint centres"},
    {"platform_azimuth", "rad", 48 * JOINT_DEGREE, 0, 1.04, NULL,
     "azimuth of a platform joint, measured from the middle of its pair"},
    {"height", "m", 0.30, 1e-3, 1e3, NULL, "height of the platform above the cranks' plane"},
    {0},
};

/* Computes joint axes for a rod: z along `direction`, and x in the plane of the rod and the global
 * z axis, on the upper side. */
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
    n->rotation = SCENE_ROTATION_SEQUENCE;
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
                         "direction of the elements: away from the bodies, or from the base via "
                         "the fold to the body"},
    {0},
};

enum { FOLDS = 3 };

status joint_prepare(const double value[], scene *s, int *profile, fault *f)
{
    if (value[JOINT_RADIUS] <= value[JOINT_WIDTH])
        return fault_set(f, STATUS_REFUSED,
                         "radius = %g m: a fold line %g m long would extend beyond the centre; "
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

static void to_global(const double centre[3], const double axes[9], const double local[3],
                      double global[3])
{
    for (int i = 0; i < 3; i++)
        global[i] = centre[i] + axes[3 * i] * local[0] + axes[3 * i + 1] * local[1] +
                    axes[3 * i + 2] * local[2];
}

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

/* Adds a fold at one azimuth. If `up` is +1, the fold belongs to the first set, with the fold line
 * above the centre. If `up` is -1, the fold is the mirror image in the xy plane. The sheet on the
 * side of larger azimuth is attached to body[0], the other sheet to body[1]. */
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
        centre_line[i] = sin(polar) * radial[i] + cos(polar) * z; /* direction of the fold line */
        outward[i] = cos(polar) * radial[i] - sin(polar) * z; /* bisector of the sheets, normal to
                                                               * the fold line */
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

int timed_add(scene *s, const double value[], int follows, scene_start start)
{
    const scene_motion how = {.scheme = (scene_scheme)value[TIMED_INTEGRATOR],
                              .alpha = scene_alpha_of_radius(0.9),
                              .step = value[TIMED_STEP],
                              .tolerance = value[TIMED_TOLERANCE],
                              .start = start};
    scene_meshes_doubled(s, 4, 32);
    return scene_add_motion(s, follows, 1, &value[TIMED_TIME], how);
}

void timed_places(scene *s, int motion, int node, double size, const char *const name[3])
{
    for (int i = 0; i < 3; i++)
        if (name[i] != NULL) {
            scene_quantity *q =
                scene_add_quantity(s, name[i], "m", motion, scene_coordinate(node, SCENE_UX + i));
            q->offset = scene_node_at(s, node)->position[i];
            q->near_zero = size;
        }
}

int timed_driver(scene *s, double end, double duration)
{
    char text[200];
    const int drive = scene_add_moving_driver(s, "drive");
    snprintf(text, sizeof text, "%.17g*(10*(t/%.17g)^3 - 15*(t/%.17g)^4 + 6*(t/%.17g)^5)", end,
             duration, duration, duration);
    scene_drive_piece(s, drive, duration, text);
    snprintf(text, sizeof text, "%.17g", end);
    scene_drive_piece(s, drive, 0, text);
    return drive;
}
