/* Entry of the rotation matrix of a node. */
#include "cases/scene/meaning_words.h"
#include "cases/scene/quantity_type.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_NODE(orientation.node),
    {"row", ENTRY_WORD, .needed = 1, .words = "x|y|z", .summary = "of its rotation matrix",
     ENTRY_IN(scene_quantity, what.of.orientation.row), .turns = ENTRY_AXIS},
    {"column", ENTRY_WORD, .needed = 1, .words = "x|y|z", .summary = "of it",
     ENTRY_IN(scene_quantity, what.of.orientation.column), .turns = ENTRY_AXIS},
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
    const scene_orientation *what = &q->what.of.orientation;
    fprintf(to, "entry %c%c of the rotation matrix", "xyz"[what->row], "xyz"[what->column]);
    meaning_node(to, s, "of", what->node);
}

const quantity_type quantity_orientation = {.key = "orientation",
                                            .summary = "entry of a node's rotation matrix",
                                            .kind = SCENE_ORIENTATION,
                                            .field = fields,
                                            .analyses = 1u << SCENE_MOTION,
                                            .passing = QUANTITY_CROSSINGS,
                                            .unit = unit,
                                            .meaning = meaning};
