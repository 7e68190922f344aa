/* A cantilever whose section changes linearly from root to tip: a wedge, an I with narrowing
 * flanges, a channel whose shear centre and a Z whose principal axes turn along it.  L = 1 m, E =
 * 210 GPa, G = 81 GPa, rho = 7800 kg/m^3.
 *
 * Under forces at the centroid of the tip and a torque: all its displacements; the wedge also with
 * shear, its buckling load and its frequencies.  Only the I warps, held at the root. */
#include <stddef.h>

#include "cases/case.h"

enum { SECTION, RATIO, ASKED, SHEAR };
enum { WEDGE, I_SHAPE, CHANNEL, ZED };
enum { DISPLACEMENTS, WAVES };

static const parameter_type parameters[] = {
    [SECTION] = {"section", "", 0, 0, 0, "wedge|i|channel|zed", "what it is at both ends"},
    [RATIO] = {"ratio", "1", 0.5, 0.05, 2, NULL,
               "tip to root: thickness of the wedge, width of the flanges of the others"},
    [ASKED] = {"asked", "", 0, 0, 0, "displacements|waves",
               "under loads at the tip, or buckling load and frequencies (wedge)"},
    [SHEAR] = {"shear", "1", 0, 0, 1, NULL, "1: displacements of the wedge with shear, k = 5/6"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

/* [m], of mid-lines */
static const double width = 0.03, thickness = 0.02, depth = 0.1, flange = 0.06, wall = 2e-3;

static section_spec wedge(double ratio)
{
    section_spec spec = section_spec_rectangle(210e9, 81e9, width, ratio * thickness);
    spec.given.Iw = 0;
    return spec;
}

/* Flanges along y, which reach that far to either side of the web at depth/2 and at -depth/2. */
static section_spec flanged(const double upper[2], const double lower[2])
{
    const double h = depth / 2, point[][2] = {{upper[0], h},  {0, h},  {upper[1], h},
                                              {lower[0], -h}, {0, -h}, {lower[1], -h}},
                 thick[] = {wall, wall, wall, wall, wall};
    static const int ends[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    return section_spec_walls(210e9, 81e9, 5, point, ends, thick);
}

/* An open line of three walls. */
static section_spec line(double upper, double lower)
{
    const double h = depth / 2, point[][2] = {{upper, h}, {0, h}, {0, -h}, {lower, -h}},
                 thick[] = {wall, wall, wall};
    section_spec spec = section_spec_walls(210e9, 81e9, 3, point, NULL, thick);
    spec.given.Iw = 0; /* its sectorial coordinate changes along the member */
    return spec;
}

static section_spec spec_of(int form, double ratio)
{
    const double b = flange * ratio, sides[] = {-b / 2, b / 2};
    switch (form) {
    case I_SHAPE:
        return flanged(sides, sides);
    case CHANNEL:
        return line(-b, -b);
    case ZED:
        return line(-b, b);
    default:
        return wedge(ratio);
    }
}

/* Not the deflection along y with shear: what lacks shear in that direction is judged elsewhere. */
static void add_statics(scene *s, int tip, int shear)
{
    static const struct {
        const char *name, *unit;
        int row;
    } wanted[] = {{"stretch", "m", SCENE_UX},      {"deflection_y", "m", SCENE_UY},
                  {"deflection_z", "m", SCENE_UZ}, {"twist", "rad", SCENE_RX},
                  {"slope_y", "rad", SCENE_RY},    {"slope_z", "rad", SCENE_RZ}};
    const int analysis = scene_add_linear(s);
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; i++)
        if (!shear || wanted[i].row != SCENE_UY)
            scene_add_quantity(s, wanted[i].name, wanted[i].unit, analysis,
                               scene_coordinate(tip, wanted[i].row))
                ->least_order = 1.8;
}

static void add_waves(scene *s, int tip)
{
    static const char *const name[] = {"bending_1", "bending_2"};
    scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    const int buckling = scene_add_buckling(s, SCENE_NONE), modal = scene_add_modal(s, SCENE_NONE);
    scene_add_quantity(s, "buckling_load", "N", buckling, scene_critical_factor(1, 0))
        ->least_order = 1.8;
    for (int i = 0; i < 2; i++)
        scene_add_quantity(s, name[i], "Hz", modal, scene_frequency(i, SCENE_BENDING_Y))
            ->least_order = 1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    if ((value[SECTION] != WEDGE && (value[ASKED] == WAVES || value[SHEAR] != 0)) ||
        (value[ASKED] == WAVES && value[SHEAR] != 0))
        return fault_set(f, STATUS_REFUSED,
                         "waves, and shear of what is displaced, are asked of the wedge only; "
                         "leave section or the other one as it is");
    const int form = (int)value[SECTION];
    const double y_axis[3] = {0, 1, 0};
    section_spec at_root = spec_of(form, 1), at_tip = spec_of(form, value[RATIO]);
    at_root.density = at_tip.density = 7800;
    const int first = scene_add_section(s, &at_root), last = scene_add_section(s, &at_tip);
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1, 0, 0);
    scene_member *m = scene_member_at(s, scene_add_member(s, root, tip, first, y_axis));
    m->section_q = last;
    m->warp_p = SCENE_WARP_FIXED;
    scene_hold_all(s, root);
    if (value[ASKED] == WAVES) {
        add_waves(s, tip);
    } else {
        scene_add_load(s, SCENE_FORCE, tip, 1000, 100, 100);
        scene_add_load(s, SCENE_MOMENT, tip, 10, 0, 0);
        add_statics(s, tip, value[SHEAR] != 0);
    }
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS | FEATURE_ROTARY_INERTIA |
                      (value[SHEAR] == 0 ? FEATURE_SHEAR : 0));
    const int meshes[] = {2, 4, 8, 16, 32, 64};
    scene_meshes(s, 6, meshes);
    return STATUS_OK;
}

const case_type case_tapered_cantilever = {
    .name = "tapered_cantilever",
    .summary =
        "cantilever whose section changes along it: displacements, buckling load, frequencies",
    .source = "integrals over the flexibility; G. Kirchhoff, Monatsber. Berlin (1879): the wedge "
              "(reference/derive/tapered_cantilever.py)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
