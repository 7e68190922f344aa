/* Displacement of a node, or a component of its rotation vector. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(component.node),
    QUANTITY_COMPONENT("coordinate of the node", component.component),
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.component.component <= SCENE_UZ ? "m" : "rad";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    meaning_coordinate(to, s, q->what.of.component.node, q->what.of.component.component);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->component(state, q->what.of.component.node, q->what.of.component.component);
}

static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    *out = q->what.of.component;
    return i < 1;
}

const quantity_type quantity_displacement = {.key = "displacement",
                                             .summary = "displacement or rotation of a node",
                                             .kind = SCENE_COORDINATE,
                                             .field = fields,
                                             .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
                                             .between = 1,
                                             .unit = unit,
                                             .meaning = meaning,
                                             .read = read,
                                             .turns = turns};
