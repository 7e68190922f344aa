/* Resultant of the stresses on a cross-section of a member. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"member", ENTRY_NAME, .needed = 1, .summary = "name of a member",
     ENTRY_IN(scene_quantity, what.of.internal.member), .of = SCENE_MEMBERS},
    /* this key must precede `end`, which is also a position */
    {"where", ENTRY_NUMBER, .needed = 1, .group = 2,
     .summary = "position within the member, from 0 at the start to 1 at the end of the member",
     ENTRY_IN(scene_quantity, what.of.internal.place), .most = 1,
     .range = "a fraction of the member's length, from 0 to 1"},
    {"end", ENTRY_WORD, .needed = 1, .group = 2, .words = "from|to", .summary = "end of the member",
     ENTRY_IN(scene_quantity, what.of.internal.place)},
    {"along", ENTRY_WORD, .needed = 1, .group = 2, .words = "max|min|largest",
     .summary = "statistic along the member: maximum, minimum or largest magnitude without sign",
     ENTRY_IN(scene_quantity, what.of.internal.along), .first = SCENE_ALONG_MAX},
    QUANTITY_SIDE(internal.before),
    {"resultant", ENTRY_WORD, .needed = 1, .words = SCENE_RESULTANT_CHOICES,
     .summary = "action of the part towards 'to' on the part towards 'from', along the principal "
                "axes of the rotated section",
     ENTRY_IN(scene_quantity, what.of.internal.resultant)},
    QUANTITY_ACTING,
    QUANTITY_TAKEN,
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.internal.resultant == SCENE_BIMOMENT ? "N m^2"
           : q->what.of.internal.resultant < SCENE_MX      ? "N"
                                                           : "N m";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const resultant[SCENE_RESULTANTS] = {
        [SCENE_N] = "normal force",
        [SCENE_QY] = "shear force along the section's y",
        [SCENE_QZ] = "shear force along the section's z",
        [SCENE_MX] = "torque",
        [SCENE_MY] = "bending moment about the section's y",
        [SCENE_MZ] = "bending moment about the section's z",
        [SCENE_BIMOMENT] = "bimoment",
        [SCENE_MX_SAINT_VENANT] = "Saint-Venant torque",
        [SCENE_MX_WARPING] = "torque due to restrained warping",
        [SCENE_MX_WAGNER] = "torque of the axial stresses along twisted fibres"};
    static const char *const along[] = {[SCENE_ALONG_PLACE] = "",
                                        [SCENE_ALONG_MAX] = "largest ",
                                        [SCENE_ALONG_MIN] = "least ",
                                        [SCENE_ALONG_LARGEST] = "largest magnitude of the "};
    const scene_internal *c = &q->what.of.internal;
    fprintf(to, "%s%s", along[c->along], resultant[c->resultant]);
    if (c->along == SCENE_ALONG_PLACE)
        meaning_place(to, c->place, c->before);
    else
        fputs(" along the length", to);
    meaning_member(to, s, c->member);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    scene_internal what = q->what.of.internal;
    if (q->factor < 0 && (what.along == SCENE_ALONG_MAX || what.along == SCENE_ALONG_MIN))
        what.along = what.along == SCENE_ALONG_MAX ? SCENE_ALONG_MIN : SCENE_ALONG_MAX;
    return state->internal(state, &what);
}

const quantity_type quantity_internal = {.key = "internal",
                                         .summary =
                                             "stress resultant on a cross-section of a member",
                                         .kind = SCENE_INTERNAL,
                                         .field = fields,
                                         .analyses = 1u << SCENE_LINEAR | QUANTITY_ALL_STATES,
                                         .between = 1,
                                         .unit = unit,
                                         .meaning = meaning,
                                         .read = read};
