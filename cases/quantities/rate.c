/* Velocity of a node, or its angular velocity in its own axes. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {QUANTITY_ANALYSIS,
                                     QUANTITY_NODE(component.node),
                                     QUANTITY_COMPONENT("of its coordinates", component.component),
                                     QUANTITY_TAKEN,
                                     {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.component.component <= SCENE_UZ ? "m/s" : "rad/s";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const int turn = q->what.of.component.component >= SCENE_RX;
    fputs(turn ? "angular velocity" : "velocity", to);
    meaning_node(to, s, "of", q->what.of.component.node);
    fprintf(to, turn ? " about its own %c axis" : " along %c",
            meaning_axis(q->what.of.component.component));
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->rate(state, q->what.of.component.node, q->what.of.component.component);
}

/* Its own turn. */
static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    *out = q->what.of.component;
    return i < 1;
}

const quantity_type quantity_rate = {.key = "rate",
                                     .summary =
                                         "velocity of a node, or angular velocity in its own axes",
                                     .kind = SCENE_RATE,
                                     .field = fields,
                                     .analyses = 1u << SCENE_MOTION,
                                     .passing = QUANTITY_CROSSINGS,
                                     .unit = unit,
                                     .meaning = meaning,
                                     .read = read,
                                     .turns = turns};
