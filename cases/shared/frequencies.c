#include "cases/shared/frequencies.h"

#include <stdio.h>

#include "elements/math/pi.h"

static void add(scene *s, const char *stem, const char *unit, double factor, int analysis,
                scene_family family, int count)
{
    for (int i = 0; i < count; i++) {
        char name[SCENE_NAME];
        snprintf(name, sizeof name, "%s_%d", stem, i + 1);
        scene_quantity *q = scene_add_quantity(s, name, unit, analysis, scene_frequency(i, family));
        q->factor = factor;
        q->least_order = 1.8;
    }
}

void frequencies_add(scene *s, const char *stem, int analysis, scene_family family, int count)
{
    add(s, stem, "Hz", 1, analysis, family, count);
}

void frequencies_add_angular(scene *s, const char *stem, int analysis, scene_family family,
                             int count)
{
    add(s, stem, "1", 2 * PI, analysis, family, count);
}
