/* Rotation or displacement of a member end relative to its node, for a released component. */
#include "cases/scene/scene.h"

enum { MEMBER, COMPONENT = 0, END };

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"member", ENTRY_NAME, .needed = 1, .summary = "name of a member",
     ENTRY_IN(scene_quantity, what.of.reading.node[MEMBER]), .of = SCENE_MEMBERS},
    {"end", ENTRY_WORD, .needed = 1, .words = "from|to", .summary = "end of the member",
     ENTRY_IN(scene_quantity, what.of.reading.component[END])},
    {"component", ENTRY_WORD, .needed = 1, .words = ENTRY_COMPONENTS,
     .summary = "released component, in the member's axes",
     ENTRY_IN(scene_quantity, what.of.reading.component[COMPONENT])},
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.reading.component[COMPONENT] <= SCENE_UZ ? "m" : "rad";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_reading *what = &q->what.of.reading;
    const int turn = what->component[COMPONENT] >= SCENE_RX;
    fprintf(to, "%s relative to its node", turn ? "rotation" : "displacement");
    meaning_place(to, what->component[END], 0);
    meaning_member(to, s, what->node[MEMBER]);
    fprintf(to, " %s the member's %c", turn ? "about" : "along",
            meaning_axis(what->component[COMPONENT]));
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    static const char *const component[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
    const scene_reading *what = &q->what.of.reading;
    const scene_release *there = &s->member[what->node[MEMBER]].release[what->component[END]];
    for (int i = 0; i < there->count; i++)
        if (there->component[i] == what->component[COMPONENT])
            return STATUS_OK;
    return fault_set(
        f, STATUS_REFUSED,
        "quantity %s: %s does not release %s at its end '%s'; name a released component, "
        "or request the deflection of that end",
        q->name, scene_called(s, SCENE_MEMBERS, what->node[MEMBER]).text,
        component[what->component[COMPONENT]], what->component[END] ? "to" : "from");
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    const scene_reading *what = &q->what.of.reading;
    return state->released(state, what->node[MEMBER], what->component[END],
                           what->component[COMPONENT]);
}

const quantity_type quantity_hinge = {
    .key = "hinge",
    .summary = "rotation or displacement of a released end of a member relative to its node",
    .kind = SCENE_READING,
    .field = fields,
    .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
    .between = 1,
    .unit = unit,
    .meaning = meaning,
    .read = read,
    .check = check};
