/* A cantilever rolled up by an end moment into full circles. L = 1 m, EI = 1 N m^2. */
#include "cases/shared/cantilever.h"
#include "elements/math/pi.h"

#include <stddef.h>

enum { TURNS };

static const parameter_type parameters[] = {
    [TURNS] = {"turns", "1", 1.0, -2.0, 2.0, NULL, "full turns of the tip"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    (void)f;
    const cantilever_stiffness k = {.EA = 1e6, .GJ = 1, .EI = 1};
    int root, tip;
    cantilever_build(1, &k, s, &root, &tip);
    scene_add_load(s, SCENE_MOMENT, tip, 0, 0, 2 * PI * value[TURNS]);
    const int path = cantilever_path(s);
    cantilever_quantity(s, "tip_gap", "1", path, tip, SCENE_UX, 1, 1);
    s->quantity[s->quantities - 1].near_zero = 1;
    /* a full turn needs more than four elements where a quarter turn is the limit */
    scene_meshes_doubled(s, 1, 128);
    return STATUS_OK;
}

const case_type case_roll_up = {
    .name = "roll_up",
    .summary = "cantilever rolled into a circle by an end moment",
    .source = "exact: a circle",
    .parameters = {parameters, case_omit},
    .build = build,
};
