/* Cross-flexure hinge: three leaves cross at their middles, the outer two in the same direction;
 * the arm turns about z.  Its support stiffness in the turned state, whichever way the turn is
 * prescribed: the turn alone, with the two tilts held or free, and as a rotation vector. */
#include "cases/case.h"
#include "cases/shared/sheet.h"
#include "elements/math/pi.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { LENGTH, WIDTH, THICKNESS, PITCH, HALF, YOUNG, POISSON, ANGLE, ROTATION, MOMENTS };
enum { HINGE, VECTOR, FIRST, LAST, BETWEEN }; /* of ROTATION */
enum { LEAVES = 3, STATIONS = 4 };

static const parameter_type parameters[] = {
    [LENGTH] = {"length", "m", 0.06, 1e-4, 10, NULL, "length of a leaf"},
    [WIDTH] = {"width", "m", 0.01, 1e-5, 10, NULL, "width of a leaf, along z"},
    [THICKNESS] = {"thickness", "m", 0.3e-3, 1e-7, 0.1, NULL, "thickness of a leaf"},
    [PITCH] = {"pitch", "m", 0.012, 0, 1, NULL, "between the middle planes of the leaves, along z"},
    [HALF] = {"half_angle", "rad", 0.78539816339744831, 0.1, 1.5, NULL,
              "half the angle between the leaves, from x"},
    [YOUNG] = {"young", "Pa", 200e9, 1, 1e13, NULL, "modulus of elasticity"},
    [POISSON] = {"poisson", "1", 0.3, 0, 0.49, NULL, "Poisson's ratio"},
    [ANGLE] = {"angle", "rad", 0.35, -1, 1, NULL, "turn of the arm about z"},
    [ROTATION] = {"rotation", "", HINGE, 0, 0, "hinge|vector|first|last|between",
                  "the turn about z alone, tilts held (hinge, vector), or with tilts about x and y "
                  "free, as the first, last or "
                  "middle of three"},
    [MOMENTS] = {"moment_convention", "", SCENE_MOMENTS_SPATIAL, 0, 0, SCENE_MOMENTS_CHOICES,
                 "moment of the drive while the arm tilts, in k_z, k_tilt_x and k_tilt_y"},
    {0},
};

static int has_free_tilts(const double value[])
{
    return value[ROTATION] >= FIRST;
}

static void add_leaves(const double value[], scene *s, int arm)
{
    section_spec spec;
    sheet_section(value[WIDTH], value[THICKNESS], value[YOUNG], value[POISSON], 0, &spec);
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < LEAVES; i++) {
        const double angle = i == 1 ? value[HALF] : PI - value[HALF], z = (i - 1) * value[PITCH];
        const double x = value[LENGTH] / 2 * cos(angle), y = value[LENGTH] / 2 * sin(angle);
        const double across[3] = {-sin(angle), cos(angle), 0};
        const int base = scene_add_node(s, -x, -y, z), end = scene_add_attached(s, arm, x, y, z);
        scene_hold_all(s, base);
        scene_member *leaf = scene_member_at(s, scene_add_member(s, base, end, profile, across));
        leaf->warp_p = leaf->warp_q = SCENE_WARP_FIXED;
    }
}

/* The drive's turn, as one of three or alone. */
static void turn_in_sequence(const double value[], scene *s, int arm, int driver)
{
    static const double axes[][3][3] = {[HINGE] = {{0, 0, 1}},
                                        [FIRST] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                        [LAST] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                        [BETWEEN] = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
    static const int place_of[] = {[FIRST] = 0, [BETWEEN] = 1, [LAST] = 2};
    const int kind = (int)value[ROTATION], place = place_of[kind];
    scene_node *n = scene_node_at(s, arm);
    n->rotation = SCENE_ROTATION_SEQUENCE;
    memcpy(n->axis, axes[kind], sizeof n->axis);
    n->angle[place] = driver;
}

static void turn_arm(const double value[], scene *s, int arm)
{
    const double path[2] = {0, 1}, turn[2] = {0, value[ANGLE]}, none[2] = {0, 0};
    const int driver = scene_add_driver(s, "angle", 2, path, turn);
    if (value[ROTATION] != VECTOR) {
        turn_in_sequence(value, s, arm, driver);
        return;
    }
    const int x = scene_add_driver(s, "tilt_x", 2, path, none),
              y = scene_add_driver(s, "tilt_y", 2, path, none);
    scene_node *n = scene_node_at(s, arm);
    n->rotation = SCENE_ROTATION_VECTOR;
    memcpy(n->angle, (const int[3]){x, y, driver}, sizeof n->angle);
}

static void add_path_quantities(scene *s, int path, int arm)
{
    static const struct {
        const char *name;
        int component;
    } shift[] = {{"shift_x", SCENE_UX}, {"shift_y", SCENE_UY}};
    scene_add_quantity(s, "moment", "N m", path, scene_reaction(arm, SCENE_RZ))->least_order = 1.8;
    for (int i = 0; i < 2; i++) {
        scene_quantity *q = scene_add_quantity(s, shift[i].name, "m", path,
                                               scene_coordinate(arm, shift[i].component));
        q->least_order = 1.8;
        q->near_zero = 1e-4;
    }
}

static void add_stiffnesses(scene *s, int turned, int count)
{
    static const char *const name[] = {"k_x", "k_y", "k_z", "k_tilt_x", "k_tilt_y"};
    for (int i = 0; i < count; i++) {
        scene_quantity *q = scene_add_quantity(s, name[i], i < 3 ? "N/m" : "N m/rad", turned,
                                               scene_stiffness_entry(i));
        q->least_order = 1.5;
    }
}

static status build(const double value[], scene *s, fault *f)
{
    if (value[THICKNESS] > value[WIDTH])
        return fault_set(f, STATUS_REFUSED,
                         "thickness %g m: a leaf is not thicker than wide; make it %g m at most",
                         value[THICKNESS], value[WIDTH]);
    const int arm = scene_add_node(s, 0, 0, 0);
    double station[STATIONS];
    add_leaves(value, s, arm);
    turn_arm(value, s, arm);
    scene_omit(s, FEATURE_WAGNER_TORQUE);
    for (int i = 0; i < STATIONS; i++)
        station[i] = (i + 1.0) / STATIONS;
    const int path = scene_add_static(s, STATIONS, station, 1);
    const int turned = scene_add_compliance(
        s, path, (scene_compliance){.node = arm, .moments = (scene_moments)value[MOMENTS]});
    add_path_quantities(s, path, arm);
    add_stiffnesses(s, turned, has_free_tilts(value) ? 5 : 3);
    scene_meshes_doubled(s, 1, 64);
    return STATUS_OK;
}

const case_type case_cross_flexure = {
    .name = "cross_flexure",
    .summary = "cross-flexure hinge: moment, shift and support stiffness of the turned arm",
    .source = "geometrically exact beams between rigid bodies (reference/derive/network.py)",
    .parameters = {parameters, case_omit},
    .build = build,
};
