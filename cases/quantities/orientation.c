/* Entry of the rotation matrix of a node. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(reading.node[0]),
    {"row", ENTRY_WORD, .needed = 1, .words = "x|y|z", .summary = "row of the rotation matrix",
     ENTRY_IN(scene_quantity, what.of.reading.component[0]), .turns = ENTRY_AXIS},
    {"column", ENTRY_WORD, .needed = 1, .words = "x|y|z",
     .summary = "column of the rotation matrix",
     ENTRY_IN(scene_quantity, what.of.reading.component[1]), .turns = ENTRY_AXIS},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_reading *what = &q->what.of.reading;
    fprintf(to, "entry %c%c of the rotation matrix", "xyz"[what->component[0]],
            "xyz"[what->component[1]]);
    meaning_node(to, s, "of", what->node[0]);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    const scene_reading *what = &q->what.of.reading;
    double place[3], R[9];
    state->frame(state, what->node[0], place, R);
    return R[3 * what->component[0] + what->component[1]];
}

static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    (void)s;
    *out = (scene_component){q->what.of.reading.node[0], SCENE_RX + i};
    return i < 3;
}

const quantity_type quantity_orientation = {.key = "orientation",
                                            .summary = "entry of a node's rotation matrix",
                                            .kind = SCENE_READING,
                                            .field = fields,
                                            .analyses = 1u << SCENE_MOTION,
                                            .between = 1,
                                            .unit = unit,
                                            .meaning = meaning,
                                            .read = read,
                                            .turns = turns};
