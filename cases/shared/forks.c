#include "cases/shared/forks.h"

void forks_column(scene *s, const section_spec *spec, double length, int ends[2])
{
    const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0};
    const int profile = scene_add_section(s, spec);
    ends[0] = scene_add_node(s, 0, 0, 0);
    ends[1] = scene_add_node(s, length, 0, 0);
    scene_add_member(s, ends[0], ends[1], profile, y_axis);
    scene_hold(s, ends[0], SCENE_UX, SCENE_UZ);
    scene_hold(s, ends[1], SCENE_UY, SCENE_UZ);
    for (int i = 0; i < 2; i++)
        scene_fork(s, ends[i], x_axis, y_axis);
}
