#include "harness/tools/kit/scenes.h"

#include <stdio.h>

section_spec timed_profile(const timed_section *of)
{
    const double stiffness[6] = {of->EA, of->GA, of->GA, of->GJ, of->EI, of->EI},
                 mass[6] = {of->mass, of->mass, of->mass, of->polar, of->rotary, of->rotary};
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    for (int i = 0; i < 6; i++) {
        spec.constants.stiffness[7 * i] = stiffness[i];
        spec.constants.mass[7 * i] = mass[i];
    }
    return spec;
}

int scenes_cantilever(scene *s, const section_spec *spec)
{
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1, 0, 0);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, scene_add_section(s, spec), y_axis);
    return tip;
}

void scenes_ask_frequencies(scene *s, const char *name, int analysis, int count)
{
    for (int i = 0; i < count; i++) {
        char text[SCENE_NAME];
        snprintf(text, sizeof text, "%s_%d", name, i);
        scene_add_quantity(s, text, "Hz", analysis, scene_frequency(i, SCENE_ANY));
    }
}

void scenes_ask_motion(scene *s, const char *name, int analysis, int node)
{
    for (int i = 0; i < 3; i++) {
        char text[SCENE_NAME];
        snprintf(text, sizeof text, "%s_%d", name, i);
        scene_add_quantity(s, text, "m", analysis, scene_coordinate(node, i));
    }
}
