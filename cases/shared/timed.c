#include "cases/shared/timed.h"

#include <stdio.h>

int timed_add(scene *s, const double value[], int follows, scene_start start)
{
    const scene_motion how = {.scheme = (scene_scheme)value[TIMED_INTEGRATOR],
                              .alpha = scene_alpha_of_radius(0.9),
                              .step = value[TIMED_STEP],
                              .tolerance = value[TIMED_TOLERANCE],
                              .start = start};
    scene_meshes_doubled(s, 4, 32);
    return scene_add_motion(s, follows, 1, &value[TIMED_TIME], how);
}

void timed_places(scene *s, int motion, int node, double size, const char *const name[3])
{
    for (int i = 0; i < 3; i++)
        if (name[i] != NULL) {
            scene_quantity *q =
                scene_add_quantity(s, name[i], "m", motion, scene_coordinate(node, SCENE_UX + i));
            q->offset = scene_node_at(s, node)->position[i];
            q->near_zero = size;
        }
}

int timed_driver(scene *s, double end, double duration)
{
    char text[200];
    const int drive = scene_add_moving_driver(s, "drive");
    snprintf(text, sizeof text, "%.17g*(10*(t/%.17g)^3 - 15*(t/%.17g)^4 + 6*(t/%.17g)^5)", end,
             duration, duration, duration);
    scene_drive_piece(s, drive, duration, text);
    snprintf(text, sizeof text, "%.17g", end);
    scene_drive_piece(s, drive, 0, text);
    return drive;
}
