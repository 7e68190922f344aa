/* Value of an unknown driver. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"motion", ENTRY_NAME, .needed = 1, .summary = "unknown motion",
     ENTRY_IN(scene_quantity, what.of.driver), .of = SCENE_DRIVERS},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++)
            if (s->node[i].angle[k] == q->what.of.driver)
                return "rad";
    return "m";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_driver *d = &s->driver[q->what.of.driver];
    fprintf(to, "value of the motion %s", d->name);
    if (d->condition_driver == SCENE_NONE)
        return;
    fputs(" for which the ", to);
    meaning_coordinate(to, s, d->condition_node, d->condition_component);
    fprintf(to, " equals that of the motion %s", s->driver[d->condition_driver].name);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->driver(state, q->what.of.driver);
}

const quantity_type quantity_motion = {.key = "motion",
                                       .summary = "value of an unknown motion",
                                       .kind = SCENE_DRIVER_VALUE,
                                       .field = fields,
                                       .analyses = QUANTITY_ALL_STATES,
                                       .between = 1,
                                       .unit = unit,
                                       .meaning = meaning,
                                       .read = read};
