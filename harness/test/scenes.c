#include "harness/test/scenes.h"

int scenes_cantilever(scene *s, const section_spec *spec)
{
    const double y_axis[3] = {0, 1, 0};
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, 1, 0, 0);
    scene_hold_all(s, root);
    scene_add_member(s, root, tip, scene_add_section(s, spec), y_axis);
    return tip;
}
