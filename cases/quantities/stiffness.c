/* Reciprocal of a diagonal entry of the compliance matrix. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"component", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS,
     .summary = "component of the stiffness", ENTRY_IN(scene_quantity, what.of.entry.row),
     .turns = ENTRY_DIAGONAL},
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.entry.row <= SCENE_UZ ? "N/m" : "N m/rad";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const int component = q->what.of.entry.row;
    fputs("stiffness", to);
    meaning_node(to, s, "of", scene_compliance_of(&s->analysis[q->analysis])->node);
    fprintf(to, ": %s %c per small %s, with the other components unloaded", meaning_load(component),
            meaning_axis(component), component < SCENE_RX ? "displacement" : "rotation");
}

static const char *complete(const scene *s, scene_quantity *q, const char **key)
{
    (void)s;
    (void)key;
    q->what.of.entry.column = q->what.of.entry.row;
    return NULL;
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
    return 1 / state->compliance(state, q->what.of.entry.row, q->what.of.entry.row);
}

const quantity_type quantity_stiffness = {
    .key = "stiffness",
    .summary = "reciprocal of a compliance: stiffness with the other components unloaded",
    .kind = SCENE_STIFFNESS_ENTRY,
    .field = fields,
    .analyses = 1u << SCENE_COMPLIANCE,
    .unit = unit,
    .meaning = meaning,
    .read = read,
    .turns = turns,
    .complete = complete};
