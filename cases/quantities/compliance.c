/* Entry of the compliance matrix of a node. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"row", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS, .summary = "response",
     ENTRY_IN(scene_quantity, what.of.entry.row), .turns = ENTRY_COMPONENT},
    {"column", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS, .summary = "force or moment",
     ENTRY_IN(scene_quantity, what.of.entry.column), .turns = ENTRY_COMPONENT},
    QUANTITY_TAKEN,
    {.name = NULL}};

const char *scene_compliance_unit(int row, int column)
{
    static const char *const unit[2][2] = {{"m/N", "1/N"}, {"rad/N", "rad/(N m)"}};
    return unit[row > SCENE_UZ][column > SCENE_UZ];
}

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return scene_compliance_unit(q->what.of.entry.row, q->what.of.entry.column);
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_entry *e = &q->what.of.entry;
    fputs(e->row < SCENE_RX ? "displacement" : "rotation", to);
    meaning_node(to, s, "of", scene_compliance_of(&s->analysis[q->analysis])->node);
    fprintf(to, " %s %c for a unit %s %c there, linearised", e->row < SCENE_RX ? "along" : "about",
            meaning_axis(e->row), meaning_load(e->column), meaning_axis(e->column));
}

static int turns(const scene *s, const scene_quantity *q, int i, scene_component *out)
{
    const scene_entry *what = &q->what.of.entry;
    *out = (scene_component){scene_compliance_of(&s->analysis[q->analysis])->node,
                             i == 0 ? what->row : what->column};
    return i < 2;
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->compliance(state, q->what.of.entry.row, q->what.of.entry.column);
}

const quantity_type quantity_compliance = {.key = "compliance",
                                           .summary = "entry of the compliance matrix",
                                           .kind = SCENE_COMPLIANCE_ENTRY,
                                           .field = fields,
                                           .analyses = 1u << SCENE_COMPLIANCE,
                                           .unit = unit,
                                           .meaning = meaning,
                                           .read = read,
                                           .turns = turns};
