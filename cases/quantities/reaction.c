/* Reaction force or moment of a fixed or prescribed component of a node. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(component.node),
    {"component", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS "|turn_1",
     .summary =
         "coordinate of the node; turn_1: the rotation about the first axis of the node's sequence",
     ENTRY_IN(scene_quantity, what.of.component.component), .turns = ENTRY_COMPONENT},
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.component.component <= SCENE_UZ ? "N" : "N m";
}

static int is_driven(const scene_node *n, int component)
{
    if (component < SCENE_RX)
        return n->translation[component] >= 0;
    if (n->rotation == SCENE_ROTATION_SPATIAL)
        return n->angle[component - SCENE_RX] >= 0;
    return n->angle[0] >= 0 || n->angle[1] >= 0 || n->angle[2] >= 0;
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_component *what = &q->what.of.component;
    fprintf(to, "%s %c", what->component >= SCENE_RX ? "moment about" : "force along",
            meaning_axis(what->component));
    double R[9];
    if (what->node >= 0 && what->node < s->nodes && scene_node_axes(&s->node[what->node], R))
        fputs(" of its axes", to);
    meaning_node(to, s,
                 is_driven(&s->node[what->node], what->component) ? "that drives" : "that holds",
                 what->node);
}

/* Only the first rotation axis of a sequence does not rotate, so turn_1 is the only moment about an
 * axis of a sequence. */
static const char *complete(const scene *s, scene_quantity *q, const char **key)
{
    enum { TURN_1 = SCENE_RZ + 1 };
    scene_component *what = &q->what.of.component;
    if (what->component != TURN_1)
        return NULL;
    what->component = SCENE_RX;
    if (what->node < 0 || what->node >= s->nodes)
        return NULL;
    const scene_node *n = &s->node[what->node];
    const double *axis = n->axis[0];
    for (int i = 0; i < 3 && n->rotation == SCENE_ROTATION_SEQUENCE; i++)
        if (axis[i] > 0 && axis[(i + 1) % 3] == 0 && axis[(i + 2) % 3] == 0) {
            what->component = SCENE_RX + i;
            return NULL;
        }
    *key = "component";
    return "turn_1 requires a node with a sequence whose first axis is x, y or z; use rx, ry or rz";
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->reaction(state, q->what.of.component.node, q->what.of.component.component);
}

const quantity_type quantity_reaction = {.key = "reaction",
                                         .summary = "reaction of a fixed or driven component",
                                         .kind = SCENE_REACTION,
                                         .field = fields,
                                         .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
                                         .between = 1,
                                         .unit = unit,
                                         .meaning = meaning,
                                         .read = read,
                                         .complete = complete};
