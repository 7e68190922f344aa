/* The elastica: cantilever under a dead transverse tip force. L = 1 m, EI = 1 N m^2; EA large and
 * finite. */
#include "cases/shared/cantilever.h"

#include <stddef.h>

enum { LOAD, AXIAL };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "1", 1.0, -1e3, 1e3, NULL, "tip force P L^2/EI"},
    [AXIAL] = {"axial", "1", 1e8, 1e2, 1e14, NULL, "EA L^2/EI"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const cantilever_stiffness k = {.EA = value[AXIAL], .GJ = 1, .EI = 1};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    scene_add_load(s, SCENE_FORCE, tip, 0, value[LOAD], 0);
    cantilever_bent(s, tip);
    return STATUS_OK;
}

const case_type case_elastica = {
    .name = "elastica",
    .summary = "cantilever under a transverse tip force, large rotation",
    .source = "elliptic integrals",
    .parameters = {parameters, case_omit},
    .build = build,
};
