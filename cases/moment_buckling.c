/* The C-shaped column of c_column under equal and opposite end moments about its strong axis of
 * bending in the plane of symmetry (z): buckling moments of both signs, where the monosymmetric
 * Wagner moments matter. Closed forms: reference/derive; c_column's section and fork ends. */
#include "cases/shared/column.h"

#include <stddef.h>

enum { WAGNER_MOMENTS = COLUMN_PARAMETERS };

/* In the order of the enumeration. */
static const parameter_type parameters[] = {
    {"wagner_moments", "1", 1, 0, 1, NULL, "1: with int y(y^2+z^2) dA and int z(y^2+z^2) dA"},
    {0},
};

static void add_moment(scene *s, int buckling, const char *name, int sign)
{
    scene_quantity *q =
        scene_add_quantity(s, name, "N m", buckling, scene_critical_factor(sign, 0));
    q->least_order = 1.8;
}

static status build(const double value[], scene *s, fault *f)
{
    int ends[2];
    TRY(column_build(value, s, ends, f));
    if (value[WAGNER_MOMENTS] == 0)
        scene_omit(s, FEATURE_WAGNER_MOMENTS);
    scene_add_load(s, SCENE_MOMENT, ends[0], 0, 0, -1);
    scene_add_load(s, SCENE_MOMENT, ends[1], 0, 0, 1);
    const int buckling = scene_add_buckling(s, SCENE_NONE);
    add_moment(s, buckling, "buckling_moment_negative", -1);
    add_moment(s, buckling, "buckling_moment_positive", 1);
    return STATUS_OK;
}

const case_type case_moment_buckling = {
    .name = "moment_buckling",
    .summary =
        "C-shaped beam with fork ends under uniform end moment: buckling moments of both signs",
    .source = "J section 5.1 (section and length); closed form of the monosymmetric beam",
    .parameters = {column_parameters, column_rigid, column_stability, parameters, case_omit},
    .build = build,
};
