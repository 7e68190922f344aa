#include "cases/shared/column.h"

#include <stddef.h>

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
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

const parameter_type column_flexible[] = {
    {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

const parameter_type column_rigid[] = {
    {"shear", "1", 0, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};

const parameter_type column_stability[] = {
    {"shear_stability", "", 0, 0, 0, "engesser|haringx", "theory of shear in stability"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
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
    const int profile = scene_add_section(s, &spec);
    const double y_axis[3] = {0, 1, 0};
    ends[0] = scene_add_node(s, 0, 0, 0);
    ends[1] = scene_add_node(s, value[COLUMN_LENGTH], 0, 0);
    scene_add_member(s, ends[0], ends[1], profile, y_axis);
    const double x_axis[3] = {1, 0, 0};
    scene_hold(s, ends[0], SCENE_UX, SCENE_UZ);
    scene_hold(s, ends[1], SCENE_UY, SCENE_UZ);
    for (int i = 0; i < 2; i++)
        scene_fork(s, ends[i], x_axis, y_axis); /* moments are about z */
    if (value[COLUMN_SHEAR] != 0)
        scene_need(s, FEATURE_SHEAR |
                          (value[COLUMN_STABILITY] == 0 ? FEATURE_ENGESSER : FEATURE_HARINGX));
    scene_need(s, FEATURE_TRAPEZE);
    const int meshes[] = {2, 4, 8, 16, 32, 64, 128};
    scene_meshes(s, 7, meshes);
    return STATUS_OK;
}
