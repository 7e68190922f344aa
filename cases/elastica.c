/* The elastica: cantilever under a dead transverse tip force. L = 1 m, EI = 1 N m^2; EA large and finite. */
#include "cases/shared/cantilever.h"

#include <stddef.h>

enum { LOAD, AXIAL };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "1", 1.0, -1e3, 1e3, NULL, "tip force P L^2/EI"},
    [AXIAL] = {"axial", "1", 1e8, 1e2, 1e14, NULL, "EA L^2/EI"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const cantilever_stiffness k = {.EA = value[AXIAL], .GJ = 1, .EI = 1};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    scene_add_load(s, SCENE_FORCE, tip, 0, value[LOAD], 0);
    const int path = cantilever_path(s, 4);
    cantilever_quantity(s, "w_over_L", "1", path, tip, SCENE_UY, 1, 0);
    cantilever_quantity(s, "u_over_L", "1", path, tip, SCENE_UX, -1, 0);
    cantilever_quantity(s, "theta", "rad", path, tip, SCENE_RZ, 1, 0);
    return STATUS_OK;
}

const case_type case_elastica = {
    .name = "elastica",
    .summary = "cantilever under a transverse tip force, large rotation",
    .source = "elliptic integrals",
    .parameters = {parameters},
    .build = build,
};
