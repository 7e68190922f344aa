#include "cases/shared/column.h"

#include <stddef.h>

#include "cases/shared/forks.h"

const parameter_type column_parameters[] = {
    [COLUMN_LENGTH] = {"length", "m", 6.0, 1e-6, 1e6, NULL, "length of the beam"},
    [COLUMN_HEIGHT] = {"height", "m", 0.6, 1e-6, 1e6, NULL, "centre-line height of the web"},
    [COLUMN_WIDTH] = {"width", "m", 0.6, 1e-6, 1e6, NULL, "centre-line width of the flanges"},
    [COLUMN_FLANGE] = {"flange_thickness", "m", 0.03, 1e-9, 1e3, NULL, "thickness of the flanges"},
    [COLUMN_WEB] = {"web_thickness", "m", 0.03, 1e-9, 1e3, NULL, "thickness of the web"},
    [COLUMN_YOUNG] = {"young", "Pa", 144e9, 1e-3, 1e15, NULL, "modulus of elasticity"},
    [COLUMN_SHEAR_MODULUS] = {"shear_modulus", "Pa", 4.14e9, 1e-6, 1e15, NULL, "shear modulus"},
    [COLUMN_DENSITY] = {"density", "kg/m^3", 1389.0, 1e-9, 1e9, NULL, "density"},
    [COLUMN_DATA] =
        {"section_data", "", CHANNEL_SHEAR_FLOW, 0, 0, CHANNEL_DATA_CHOICES,
         "constants computed from the walls, or as printed (of the default sizes only)"},
    {0},
};

#define SHEAR(is_default)                                                                          \
    {"shear", "1", is_default, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"}
const parameter_type column_flexible[] = {SHEAR(1), {0}}, column_rigid[] = {SHEAR(0), {0}};

const parameter_type column_stability[] = {
    {"shear_stability", "", 0, 0, 0, "engesser|haringx", "theory of shear in stability"},
    {0},
};

static const char *first_changed_size(const double value[])
{
    for (int i = COLUMN_HEIGHT; i <= COLUMN_WEB; i++)
        if (value[i] != column_parameters[i].value)
            return column_parameters[i].name;
    return NULL;
}

status column_build(const double value[], scene *s, int ends[2], fault *f)
{
    const channel c = {value[COLUMN_HEIGHT], value[COLUMN_WIDTH], value[COLUMN_FLANGE],
                       value[COLUMN_WEB],    value[COLUMN_YOUNG], value[COLUMN_SHEAR_MODULUS],
                       value[COLUMN_DENSITY]};
    const int data = (int)value[COLUMN_DATA];
    const char *changed = first_changed_size(value);
    if (data != CHANNEL_SHEAR_FLOW && changed != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "section_data: the printed constants belong to the default sizes, but %s "
                         "was changed; use section_data=shear_flow",
                         changed);
    section_spec spec;
    channel_section(&c, &spec);
    channel_print_constants(data, &spec);
    forks_column(s, &spec, value[COLUMN_LENGTH], ends);
    scene_omit(s, value[COLUMN_SHEAR] == 0 ? FEATURE_SHEAR : 0);
    s->shear_theory = value[COLUMN_STABILITY] == 0 ? SCENE_SHEAR_ENGESSER : SCENE_SHEAR_HARINGX;
    scene_meshes_doubled(s, 2, 128);
    return STATUS_OK;
}
