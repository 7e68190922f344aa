/* Displacement or rotation of a node relative to another node, in the axes of the latter. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(relative.node),
    {"from", ENTRY_NAME, .needed = 1,
     .summary = "reference node, along whose axes the displacement or rotation is measured",
     ENTRY_IN(scene_quantity, what.of.relative.from), .of = SCENE_NODES},
    QUANTITY_COMPONENT("component of the relative displacement or rotation", relative.component),
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.relative.component <= SCENE_UZ ? "m" : "rad";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    meaning_coordinate(to, s, q->what.of.relative.node, q->what.of.relative.component);
    meaning_node(to, s, "as seen from", q->what.of.relative.from);
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    (void)s;
    return q->what.of.relative.node != q->what.of.relative.from
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "quantity %s: 'node' and 'from' are the same node, whose relative "
                           "motion is 0; name two nodes",
                           q->name);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    const scene_relative *what = &q->what.of.relative;
    return state->relative(state, what->from, what->node, what->component);
}

/* Lists the component of the node, then the three rotations of the node whose axes are used. */
static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    const scene_relative *what = &q->what.of.relative;
    *out = i == 0 ? (scene_component){what->node, what->component}
                  : (scene_component){what->from, SCENE_RX + i - 1};
    return i < 4;
}

const quantity_type quantity_relative = {.key = "relative",
                                         .summary =
                                             "displacement or rotation relative to another node",
                                         .kind = SCENE_RELATIVE,
                                         .field = fields,
                                         .analyses = QUANTITY_ALL_STATES,
                                         .between = 1,
                                         .unit = unit,
                                         .meaning = meaning,
                                         .read = read,
                                         .turns = turns,
                                         .check = check};
