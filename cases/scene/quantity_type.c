#include "cases/scene/quantity_type.h"

#define LISTED(name) &quantity_##name,
static const quantity_type *const types[] = {QUANTITY_TYPES(LISTED)};
enum { TYPES = sizeof types / sizeof types[0] };

static const quantity_type *type_of(scene_quantity_kind kind)
{
    int i = 0;
    while (i < TYPES - 1 && types[i]->kind != kind)
        i++;
    return types[i];
}

const quantity_type *quantity_type_of(const scene_quantity *q)
{
    for (int i = 0; i < TYPES; i++)
        if (types[i]->kind == q->what.kind && (types[i]->is == NULL || types[i]->is(q)))
            return types[i];
    return type_of(q->what.kind);
}

int scene_gives(scene_analysis_kind analysis, scene_quantity_kind kind)
{
    return type_of(kind)->analyses >> analysis & 1u;
}

int scene_is_passed(const scene_quantity *q, scene_analysis_kind analysis)
{
    const quantity_passing passing = type_of(q->what.kind)->passing;
    const int extreme = q->reduction == SCENE_MAX || q->reduction == SCENE_MIN ||
                        q->reduction == SCENE_MAX_TIME || q->reduction == SCENE_MIN_TIME;
    if (analysis != SCENE_MOTION || passing == QUANTITY_AT_STATIONS)
        return 0;
    return extreme || (passing == QUANTITY_CROSSINGS && q->reduction > SCENE_CURVE);
}
