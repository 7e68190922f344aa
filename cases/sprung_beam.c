/* A beam that turns against rotational springs.  L = 1 m, EI = 1 N m^2, rho A = 1 kg/m.  Between
 * two supports with equal springs: deflection under a force in the middle, lowest frequency,
 * buckling load.  On one support with a spring: rolled up by a moment. No shear, no rotary inertia.
 */
#include <stddef.h>

#include "cases/shared/cantilever.h"
#include "elements/math/pi.h"

enum { LOAD, SPRING, MOMENT };
enum { TRANSVERSE, AXIAL, ROLL };
enum { SLENDERNESS = 1000 };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "", 0, 0, 0, "transverse|axial|moment", "how it is loaded"},
    [SPRING] = {"spring", "1", 4, 1e-6, 1e6, NULL, "rotational stiffness of each, in EI/L"},
    [MOMENT] = {"moment", "1", 2, -6, 6, NULL, "at the end, in EI/L"},
    {0},
};

static void add_spring(scene *s, int node, double k)
{
    double stiffness[36] = {0};
    stiffness[21] = stiffness[28] = stiffness[35] = k;
    scene_add_spring(s, SCENE_NONE, node, stiffness);
}

static void roll_up(scene *s, int end, double moment)
{
    scene_add_load(s, SCENE_MOMENT, end, 0, 0, moment);
    const int path = cantilever_path(s);
    cantilever_quantity(s, "x", "m", path, end, SCENE_UX, 1, 1);
    cantilever_quantity(s, "y", "m", path, end, SCENE_UY, 1, 0);
}

static void bend(scene *s, int middle)
{
    scene_add_load(s, SCENE_FORCE, middle, 0, 1, 0);
    cantilever_quantity(s, "deflection", "m", scene_add_linear(s), middle, SCENE_UY, 1, 0);
    scene_quantity *q = scene_add_quantity(s, "frequency", "1", scene_add_modal(s, SCENE_NONE),
                                           scene_frequency(0, SCENE_BENDING_Y));
    q->factor = 2 * PI; /* Hz -> rad/s */
    q->least_order = 1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const double area = (double)SLENDERNESS * SLENDERNESS, y_axis[3] = {0, 1, 0};
    const cantilever_stiffness k = {.EA = area, .GJ = 1, .EI = 1, .density = 1 / area};
    int root, end;
    cantilever_build(1, &k, s, &root, &end);
    scene_meshes_doubled(s, 2, 64);
    scene_node_at(s, root)->angle[0] = scene_node_at(s, root)->angle[1] =
        scene_node_at(s, root)->angle[2] = SCENE_FREE;
    add_spring(s, root, value[SPRING]);
    if (value[LOAD] == ROLL) {
        roll_up(s, end, value[MOMENT]);
        return STATUS_OK;
    }
    const int middle = scene_add_node(s, 0.5, 0, 0);
    scene_member_at(s, 0)->q = middle;
    scene_add_member(s, middle, end, 0, y_axis);
    scene_hold(s, end, SCENE_UY, SCENE_UZ);
    add_spring(s, end, value[SPRING]);
    if (value[LOAD] == TRANSVERSE) {
        bend(s, middle);
        return STATUS_OK;
    }
    scene_add_load(s, SCENE_FORCE, end, -1, 0, 0);
    scene_add_quantity(s, "buckling_load", "N", scene_add_buckling(s, SCENE_NONE),
                       scene_critical_factor(1, 0))
        ->least_order = 1.8;
    return STATUS_OK;
}

const case_type case_sprung_beam = {
    .name = "sprung_beam",
    .summary = "beam on rotational springs: deflection, frequency, buckling load, rolled up",
    .source = "closed forms of the beam on such supports (reference/derive/sprung_beam.py)",
    .parameters = {parameters, case_mass_omit},
    .build = build,
};
