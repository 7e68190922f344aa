/* Cantilever that is flexible in bending and shear under a dead transverse tip force of 10 N.
 * L = 1 m, EI = 10 N m^2; EA large and finite. */
#include "cases/shared/cantilever.h"

#include <stddef.h>

enum { GA, AXIAL };

static const parameter_type parameters[] = {
    [GA] = {"GA", "N", 500.0, 1.0, 1e12, NULL, "shear stiffness"},
    [AXIAL] = {"axial", "N", 1e9, 1e3, 1e15, NULL, "EA"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const cantilever_stiffness k = {.EA = value[AXIAL], .GA = value[GA], .GJ = 10, .EI = 10};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    scene_add_load(s, SCENE_FORCE, tip, 0, 10, 0);
    const int path = cantilever_path(s);
    cantilever_quantity(s, "u", "m", path, tip, SCENE_UX, 1, 0);
    cantilever_quantity(s, "v", "m", path, tip, SCENE_UY, 1, 0);
    return STATUS_OK;
}

const case_type case_shear_elastica = {
    .name = "shear_elastica",
    .summary = "cantilever flexible in shear under a transverse tip force",
    .source = "quadrature of the Simo-Reissner beam",
    .parameters = {parameters, case_omit},
    .build = build,
};
