/* Lateral-torsional buckling of a beam bent about its strong axis, load at the shear centre.
 * Prebuckling deflection neglected: linear prestress; included: the critical point of the nonlinear
 * path, which the deflection raises by weak EI/strong EI.  L = 1 m, weak EI = GJ = 1 N m^2;
 * load_factor = P L^2/sqrt(EI GJ), a distributed load as its total. */
#include "cases/case.h"

#include <stddef.h>

enum { LOAD, K, PREBUCKLING, RATIO };
enum { TIP, DISTRIBUTED, MID, MID_DISTRIBUTED };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "", TIP, 0, 0, "tip|distributed|mid|mid_distributed",
              "cantilever with a tip or a distributed load; simply supported beam with a mid or a "
              "distributed load"},
    [K] = {"K", "1", 0, 0, 1e6, NULL, "L^2 GJ/EIw; 0: nothing warps"},
    [PREBUCKLING] = {"prebuckling", "", 0, 0, 0, "neglected|included",
                     "deflection before buckling"},
    [RATIO] = {"ratio", "1", 1e4, 1, 1e8, NULL, "strong EI/weak EI"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const int load = (int)value[LOAD], supported = load == MID || load == MID_DISTRIBUTED;
    /* only the products matter */
    section_spec spec = section_spec_constants(1, 1);
    spec.constants.A = 1e6;
    spec.constants.Iy = value[RATIO];
    spec.constants.Iz = spec.constants.It = 1;
    spec.constants.Ip = value[RATIO] + 1;
    spec.constants.Iw = value[K] > 0 ? 1 / value[K] : 0;
    const int profile = scene_add_section(s, &spec);
    scene_omit(s, FEATURE_TRAPEZE);
    const double y_axis[3] = {0, 1, 0};
    const int start = scene_add_node(s, 0, 0, 0), middle = scene_add_node(s, 0.5, 0, 0),
              end = scene_add_node(s, 1, 0, 0);
    const int first = scene_add_member(s, start, middle, profile, y_axis),
              second = scene_add_member(s, middle, end, profile, y_axis);
    scene_member_at(s, first)->warp_p = supported ? SCENE_WARP_FREE : SCENE_WARP_FIXED;
    scene_member_at(s, first)->warp_q = scene_member_at(s, second)->warp_p = middle;
    if (supported) {
        const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};
        scene_hold(s, start, SCENE_UX, SCENE_UZ);
        scene_hold(s, end, SCENE_UY, SCENE_UZ);
        scene_fork(s, start, x_axis, z_axis);
        scene_fork(s, end, x_axis, z_axis);
    } else {
        scene_hold_all(s, start);
    }
    if (load == TIP || load == MID) {
        scene_add_load(s, SCENE_FORCE, load == TIP ? end : middle, 0, 0, -1);
    } else {
        scene_add_load(s, SCENE_DISTRIBUTED, first, 0, 0, -1);
        scene_add_load(s, SCENE_DISTRIBUTED, second, 0, 0, -1);
    }
    int path = SCENE_NONE;
    if (value[PREBUCKLING] != 0) {
        const double one = 1; /* well below every critical load */
        path = scene_add_static(s, 1, &one, 1);
    }
    const int buckling = scene_add_buckling(s, path);
    scene_quantity *q =
        scene_add_quantity(s, "load_factor", "1", buckling, scene_critical_factor(1, 0));
    q->least_order = 1.8;
    scene_meshes_doubled(s, 1, 32);
    return STATUS_OK;
}

const case_type case_lateral_buckling = {
    .name = "lateral_buckling",
    .summary = "lateral-torsional buckling of cantilevers and simply supported beams",
    .source =
        "Timoshenko and Gere, Theory of Elastic Stability; boundary-value problem of thin beams",
    .parameters = {parameters, case_omit},
    .build = build,
};
