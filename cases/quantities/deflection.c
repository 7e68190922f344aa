/* Displacement of the centroidal axis of a member, or rotation of a cross-section, at a
 * position. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"member", ENTRY_NAME, .needed = 1, .summary = "name of a member",
     ENTRY_IN(scene_quantity, what.of.deflection.member), .of = SCENE_MEMBERS},
    /* this key must precede `end`, which is also a position */
    {"where", ENTRY_NUMBER, .needed = 1, .group = 2,
     .summary = "position within the member, from 0 at the start to 1 at the end of the member",
     ENTRY_IN(scene_quantity, what.of.deflection.place), .most = 1,
     .range = "a fraction of the member's length, from 0 to 1"},
    {"end", ENTRY_WORD, .needed = 1, .group = 2, .words = "from|to",
     .summary = "end of the member, including the relative displacement of the released end",
     ENTRY_IN(scene_quantity, what.of.deflection.place)},
    QUANTITY_COMPONENT("component along or about an axis fixed in space", deflection.component),
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.deflection.component <= SCENE_UZ ? "m" : "rad";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_deflection *what = &q->what.of.deflection;
    fputs(what->component <= SCENE_UZ ? "displacement" : "rotation", to);
    meaning_place(to, what->place, 0);
    meaning_member(to, s, what->member);
    fprintf(to, " %s %c", what->component <= SCENE_UZ ? "along" : "about",
            meaning_axis(what->component));
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->deflection(state, &q->what.of.deflection);
}

const quantity_type quantity_deflection = {
    .key = "deflection",
    .summary = "displacement or rotation within a member, or of a released end of a member",
    .kind = SCENE_DEFLECTION,
    .field = fields,
    .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
    .between = 1,
    .unit = unit,
    .meaning = meaning,
    .read = read};
