/* Cantilever in bending with shear under a transverse tip force of 600 kN. L = 5 m. */
#include "cases/shared/cantilever.h"

#include <stddef.h>

enum { LOAD };

static const parameter_type parameters[] = {
    [LOAD] = {"load", "N", 600e3, -1e7, 1e7, NULL, "tip force"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const cantilever_stiffness k = {.EA = 4.8e8, .GA = 3.231e8, .GJ = 1e6, .EI = 9.346e6};
    int root, tip;
    const double length = 5;
    cantilever_build(length, &k, s, &root, &tip);
    scene_add_load(s, SCENE_FORCE, tip, 0, -value[LOAD], 0);
    const int path = cantilever_path(s);
    cantilever_quantity(s, "tip_x", "m", path, tip, SCENE_UX, 1, length);
    cantilever_quantity(s, "tip_y", "m", path, tip, SCENE_UY, 1, 0);
    cantilever_quantity(s, "theta", "rad", path, tip, SCENE_RZ, -1, 0);
    return STATUS_OK;
}

const case_type case_geradin_cardona = {
    .name = "geradin_cardona",
    .summary = "cantilever in bending with shear, large displacement",
    .source = "Geradin and Cardona, Flexible Multibody Dynamics (2001); quadrature of the "
              "Simo-Reissner beam",
    .parameters = {parameters, case_omit},
    .build = build,
};
