/* Fork-ended column, an equal angle of 120 x 120 x 8 mm: flexural-torsional buckling under an axial
 * force at its centroid, its shear centre or the tip of a leg, and under end moments. code_aster
 * V3.01.103 (SSLL103); constants as printed there. */
#include "cases/case.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

enum { LOAD, WARPING };
enum { CENTROID, SHEAR_CENTRE, LEG, MOMENT };
enum { LOADS = 3 };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "", 0, 0, 0, "centroid|shear_centre|leg|moment",
              "axial force at the centroid, the shear centre or the axis through the legs' tips; "
              "end moments about the strong axis"},
    [WARPING] = {"warping", "1", 1, 0, 1, NULL, "1: with the warping constant, 0: without"},
    {0},
};

static const double shear_centre = 41.012e-3,
                    length = 1.2; /* [m]; the y axis is that of symmetry */

static int angle(const double value[], scene *s)
{
    section_spec spec = section_spec_constants(2.1e11, 2.1e11 / 2.6);
    section *c = &spec.constants;
    c->A = 1856e-6;
    c->Iy = 4167339e-12;
    c->Iz = 1045547e-12;
    c->Ip = c->Iy + c->Iz;
    c->It = 39595e-12;
    c->Iw = value[WARPING] != 0 ? 44398819e-18 : 0;
    c->ys = shear_centre;
    c->wagner_y = -84948392e-15;
    return scene_add_section(s, &spec);
}

static void add_loads(scene *s, int load, int foot, int head)
{
    if (load == MOMENT) {
        scene_add_load(s, SCENE_MOMENT, foot, 0, 1, 0);
        scene_add_load(s, SCENE_MOMENT, head, 0, -1, 0);
        return;
    }
    const double y = load == SHEAR_CENTRE ? shear_centre : 0, z = load == LEG ? shear_centre : 0;
    const int low = load == CENTROID ? foot : scene_add_attached(s, foot, 0, y, z);
    const int high = load == CENTROID ? head : scene_add_attached(s, head, length, y, z);
    scene_add_load(s, SCENE_FORCE, low, 1, 0, 0);
    scene_add_load(s, SCENE_FORCE, high, -1, 0, 0);
}

static void add_quantities(scene *s, int load)
{
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    for (int i = 0; i < LOADS; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "critical_%s_%d", load == MOMENT ? "moment" : "load", i + 1);
        scene_quantity *q = scene_add_quantity(s, name, load == MOMENT ? "N m" : "N", buckling,
                                               scene_critical_factor(1, i));
        q->least_order = 1.8;
    }
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double y_axis[3] = {0, 1, 0};
    const int load = (int)value[LOAD], profile = angle(value, s);
    const int foot = scene_add_node(s, 0, 0, 0), head = scene_add_node(s, length, 0, 0);
    scene_add_member(s, foot, head, profile, y_axis);
    scene_hold(s, foot, SCENE_UX, SCENE_RX);
    scene_hold(s, head, SCENE_UY, SCENE_RX);
    add_loads(s, load, foot, head);
    add_quantities(s, load);
    if (load != SHEAR_CENTRE) /* whose moments are about the axis of symmetry */
        scene_omit(s, FEATURE_WAGNER_MOMENTS);
    scene_meshes_doubled(s, 2, 64);
    return STATUS_OK;
}

const case_type case_angle_column = {
    .name = "angle_column",
    .summary = "fork-ended equal angle: flexural-torsional buckling under eccentric axial force "
               "and end moments",
    .source = "code_aster V3.01.103 (SSLL103); closed form of the thin-walled column, one "
              "half-wave at a time",
    .parameters = {parameters, case_omit},
    .build = build,
};
