/* Simply supported C-shaped column: buckling under an axial force at the centroid, and natural
 * frequencies. J section 5.1, Tables 1-3. */
#include "cases/shared/column.h"
#include "cases/shared/frequencies.h"

enum { ROTARY_INERTIA = COLUMN_PARAMETERS };
enum { FREQUENCIES = 13 };

/* In the order of the enumeration. */
static const parameter_type parameters[] = {
    {"rotary_inertia", "1", 1, 0, 1, NULL, "1: rotary and warping inertia, 0: translations only"},
    {0},
};

static status build(const double value[], scene *s, fault *f)
{
    int ends[2];
    TRY(column_build(value, s, ends, f));
    scene_omit(s,
               FEATURE_WAGNER_MOMENTS | (value[ROTARY_INERTIA] == 0 ? FEATURE_ROTARY_INERTIA : 0));
    scene_add_load(s, SCENE_FORCE, ends[1], -1, 0, 0);

    const int buckling = scene_add_buckling(s, SCENE_NONE);
    scene_quantity *load =
        scene_add_quantity(s, "buckling_load", "N", buckling, scene_critical_factor(1, 0));
    load->least_order = 1.8;

    const int modal = scene_add_modal(s, SCENE_NONE);
    frequencies_add(s, "frequency", modal, SCENE_NOT_AXIAL, FREQUENCIES);
    return STATUS_OK;
}

const case_type case_c_column = {
    .name = "c_column",
    .summary = "simply supported C-shaped column: buckling load and natural frequencies",
    .source = "J section 5.1, Tables 1-3",
    .parameters = {column_parameters, column_flexible, column_stability, parameters,
                   case_mass_omit},
    .build = build,
};
