/* Point of a continuation at which the tangent stiffness is singular. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    {"analysis", ENTRY_NAME, .needed = 1, .summary = "continuation",
     ENTRY_IN(scene_quantity, analysis), .of = SCENE_ANALYSES},
    {"kind", ENTRY_WORD, .needed = 1, .words = "limit|bifurcation", .summary = "kind of the point",
     ENTRY_IN(scene_quantity, what.of.point.kind)},
    {"value", ENTRY_WORD, .words = "factor|coordinate",
     .summary = "load factor or coordinate of the point", .usual = "factor",
     ENTRY_IN(scene_quantity, what.of.point.ordinate), .always = 1},
    {"which", ENTRY_WHOLE, .summary = "counted from 0", .usual = "0",
     ENTRY_IN(scene_quantity, what.of.point.order), .most = ENTRY_MOST_ORDER},
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.point.ordinate == SCENE_CONTROL ? "m" : "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    const scene_point *p = &q->what.of.point;
    const scene_control *control = &scene_continuation_of(&s->analysis[q->analysis])->control;
    if (p->ordinate == SCENE_LOAD_FACTOR)
        fputs("load factor", to);
    else
        meaning_coordinate(to, s, control->node, control->component);
    fputs(" at the ", to);
    meaning_ordinal(to, p->order);
    fputs(p->kind == SCENE_LIMIT_POINT ? " limit point" : " bifurcation", to);
    fputs(" of the path of the load factor", to);
}

const quantity_type quantity_critical_point = {
    .key = "critical_point",
    .summary = "point at which the tangent stiffness is singular",
    .kind = SCENE_CRITICAL_POINT,
    .field = fields,
    .analyses = 1u << SCENE_CONTINUATION,
    .unit = unit,
    .meaning = meaning,
    .names_analysis = 1};
