/* Largest stress in a member or in one of its cross-sections. */
#include <math.h>

#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"member", ENTRY_NAME, .needed = 1,
     .summary = "member, whose section is given by dimensions or walls",
     ENTRY_IN(scene_quantity, what.of.stress.member), .of = SCENE_MEMBERS},
    {"where", ENTRY_NUMBER,
     .summary = "position within the member, from 0 at the start to 1 at the end of the member",
     ENTRY_IN(scene_quantity, what.of.stress.place), .otherwise = NAN,
     .left_out = "the whole member", .most = 1,
     .range = "a fraction of the member's length, from 0 to 1"},
    QUANTITY_SIDE(stress.before),
    {"measure", ENTRY_WORD, .words = SCENE_STRESS_CHOICES,
     .summary = "stress component or equivalent stress at the points of the section",
     .usual = "von_mises", ENTRY_IN(scene_quantity, what.of.stress.measure), .always = 1},
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "Pa";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const measure[] = {
        [SCENE_VON_MISES] = "largest von Mises stress",
        [SCENE_NORMAL_MAX] = "largest normal stress (tension is positive)",
        [SCENE_NORMAL_MIN] = "smallest normal stress (compression is negative)"};
    const scene_stress *c = &q->what.of.stress;
    fputs(measure[c->measure], to);
    if (c->whole)
        fputs(" of all sections", to);
    else
        meaning_place(to, c->place, c->before);
    meaning_member(to, s, c->member);
}

static const char no_points[] =
    "the section is given by constants or matrices and has no stress points; describe it by "
    "dimensions or walls, or request 'internal'";

/* Returns 0 if the section of the member is given by constants or matrices and has no stress
 * points. */
static int has_points(const scene *s, int member)
{
    const int profile = member >= 0 && member < s->members ? s->member[member].section : SCENE_NONE;
    return profile < 0 || profile >= s->sections ||
           (s->section[profile].kind != SECTION_CONSTANTS &&
            s->section[profile].kind != SECTION_MATRICES);
}

static const char *complete(const scene *s, scene_quantity *q, const char **key)
{
    scene_stress *c = &q->what.of.stress;
    c->whole = isnan(c->place);
    c->place = c->whole ? 0 : c->place;
    *key = "member";
    return has_points(s, c->member) ? NULL : no_points;
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    if (has_points(s, q->what.of.stress.member))
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED, "quantity %s, %s: %s", q->name,
                     scene_called(s, SCENE_MEMBERS, q->what.of.stress.member).text, no_points);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    return state->stress(state, &q->what.of.stress);
}

const quantity_type quantity_stress = {.key = "stress",
                                       .summary =
                                           "largest stress of a member or of one of its sections",
                                       .kind = SCENE_STRESS,
                                       .field = fields,
                                       .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
                                       .between = 1,
                                       .unit = unit,
                                       .meaning = meaning,
                                       .read = read,
                                       .complete = complete,
                                       .check = check};
