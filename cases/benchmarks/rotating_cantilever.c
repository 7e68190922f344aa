/* A cantilever in steady rotation: flap and lag frequencies, axial displacement of the end, and
 * force on the root [EI/L^2]. L = 1 m, EI = 1 N m^2 and rho A = 1 kg/m, so frequencies are in
 * sqrt(EI/(rho A L^4)). The root may be offset from the rotation axis, which is normal to the beam
 * or inclined. Flap is motion in the plane of the beam and the axis, and lag is motion normal to
 * this plane. Shear deformation and rotary inertia are neglected. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "cases/case.h"
#include "elements/math/scalar.h"

enum { OMEGA, SLENDERNESS, HUB_RADIUS, AXIS, STIFFNESS_RATIO, STATIONS };
enum { MODES = 3, LOWEST = 4, MOST_STATIONS = 200 };

static const parameter_type parameters[] = {
    [OMEGA] = {"omega_star", "1", 6.0, 0, 1e4, NULL,
               "angular velocity in units of sqrt(EI/(rho A L^4))"},
    [SLENDERNESS] = {"slenderness", "1", 1000.0, 1, 1e7, NULL, "L/sqrt(I/A)"},
    [HUB_RADIUS] =
        {"hub_radius", "1", 0, -100, 100, NULL,
         "distance of the root from the axis, in units of L; negative: the beam points inward"},
    [AXIS] = {"axis", "rad", 0, 0, 1.57079632679489661923, NULL,
              "direction of the axis; 0: normal to the beam, pi/2: along the beam"},
    [STIFFNESS_RATIO] = {"stiffness_ratio", "1", 1, 1e-6, 1e6, NULL,
                         "ratio of the bending stiffness in lag to that in flap"},
    [STATIONS] = {"stations", "1", 1, 1, MOST_STATIONS, NULL,
                  "number of angular velocities for the frequency curves, from zero; 1: no curves"},
    {0},
};

static const double two_pi = 2 * PI; /* rad/s per Hz */

static scene_quantity *add_frequency(scene *s, const char *stem, int order, const char *ending,
                                     int rotation, scene_family family)
{
    char name[SCENE_NAME];
    snprintf(name, sizeof name, "%s_%d%s", stem, order + 1, ending);
    scene_quantity *q = scene_add_quantity(s, name, "1", rotation, scene_frequency(order, family));
    q->factor = two_pi;
    q->least_order = 1.8;
    return q;
}

static void make_curve(scene_quantity *q, double omega)
{
    scene_set_curve(q, "angular velocity", "1", omega, 0);
}

/* If the rotation axis is along the beam, the modes are whirling modes, which are numbered
 * together. */
static void add_frequencies(scene *s, int rotation, double omega, int curves, int whirl)
{
    static const struct {
        const char *name;
        scene_family family;
    } kind[] = {{"flap", SCENE_BENDING_Z}, {"lag", SCENE_BENDING_Y}};
    const int names = whirl ? 1 : 2, lowest = whirl ? LOWEST : MODES;
    for (int k = 0; k < names; k++)
        for (int i = 0; i < lowest; i++) {
            const char *name = whirl ? "whirl" : kind[k].name;
            const scene_family family = whirl ? SCENE_ANY : kind[k].family;
            add_frequency(s, name, i, "", rotation, family);
            if (curves)
                make_curve(add_frequency(s, name, i, "_curve", rotation, family), omega);
        }
}

/* Results depend only on the products EA, EIy, EIz, GIt and rho A, so E = G = 1 Pa. */
static void add_beam(scene *s, double area, double stiffness_ratio, int *root, int *tip)
{
    const double y_axis[3] = {0, 1, 0};
    section_spec spec = section_spec_constants(1, 1);
    spec.density = 1 / area;
    section *c = &spec.constants;
    c->A = area;
    c->Iy = c->It = 1;
    c->Iz = stiffness_ratio;
    c->Ip = c->Iy + c->Iz;
    const int profile = scene_add_section(s, &spec);
    *root = scene_add_node(s, 0, 0, 0);
    *tip = scene_add_node(s, 1, 0, 0);
    scene_add_member(s, *root, *tip, profile, y_axis);
    scene_hold_all(s, *root);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_ROTARY_INERTIA);
}

static void add_turning(scene *s, int rotation, int root, int tip)
{
    scene_add_quantity(s, "stretch", "1", rotation, scene_coordinate(tip, SCENE_UX))->least_order =
        1.8;
    scene_quantity *pull =
        scene_add_quantity(s, "root_force", "1", rotation, scene_reaction(root, SCENE_UX));
    pull->factor = -1;
    pull->least_order = 1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double area = value[SLENDERNESS] * value[SLENDERNESS], omega = value[OMEGA];
    int root, tip;
    add_beam(s, area, value[STIFFNESS_RATIO], &root, &tip);
    const int intervals = omega > 0 ? (int)value[STATIONS] - 1 : 0;
    double path[MOST_STATIONS + 1];
    for (int i = 0; i <= intervals; i++)
        path[i] = intervals > 0 ? (double)i / intervals : 1;
    const int steps = value[AXIS] > 0 ? 8 : 1;
    const int rotation = scene_add_rotation(
        s, intervals + 1, path, steps, 2 * MODES,
        (scene_rotating_frame){.omega = {omega * sin(value[AXIS]), 0, omega * cos(value[AXIS])},
                               .centre = {-value[HUB_RADIUS], 0, 0}});
    add_frequencies(s, rotation, omega, intervals > 0, value[AXIS] > 1.5);
    scene_quantity *growth = scene_add_quantity(s, "growth", "1", rotation, scene_growth());
    growth->near_zero = 1;
    growth->least_order = 1.8;
    if (intervals > 0)
        make_curve(scene_add_quantity(s, "growth_curve", "1", rotation, scene_growth()), omega);
    add_turning(s, rotation, root, tip);
    scene_meshes_doubled(s, 2, 64);
    return STATUS_OK;
}

const case_type case_rotating_cantilever = {
    .name = "rotating_cantilever",
    .summary = "cantilever in steady rotation: flap and lag frequencies and elongation",
    .source = "exact flap and lag frequencies of the stretched beam "
              "(reference/derive/rotating.py); its elongation is tan k/k - 1",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
