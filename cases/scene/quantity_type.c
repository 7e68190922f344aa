#include "cases/scene/scene.h"
#include "quantities.h" /* by the build: QUANTITY_TYPES, a word for each file of cases/quantities */

#define DECLARED(name) extern const quantity_type quantity_##name;
QUANTITY_TYPES(DECLARED)

static const entry_field abscissa[] = {
    {"quantity", ENTRY_NAME, .summary = "whose curve, of the same path, it is",
     .left_out = "the path, time or frequency"},
    {"name", ENTRY_TEXT, .summary = "its name", .left_out = "path, time or frequency"},
    {"unit", ENTRY_TEXT, .summary = "its unit",
     .left_out = "1; with factor 1 over time s, over frequency Hz"},
    {"factor", ENTRY_NUMBER, .summary = "times the path parameter", .usual = "1"},
    {"offset", ENTRY_NUMBER, .summary = "added to it", .usual = "0"},
    {.name = NULL}};

static const entry_field when[] = {
    {"direction", ENTRY_WORD, .words = SCENE_DIRECTION_CHOICES, .summary = "of the crossing",
     .usual = "rising", ENTRY_IN(scene_quantity, passing.direction), .always = 1},
    {"level", ENTRY_NUMBER, .summary = "that is crossed, in SI units before factor and offset",
     .usual = "0", ENTRY_IN(scene_quantity, passing.level)},
    {"which", ENTRY_WHOLE, .summary = "crossing, counted from 0", .usual = "0",
     ENTRY_IN(scene_quantity, passing.order), .most = ENTRY_MOST_ORDER},
    {"from", ENTRY_NUMBER, .summary = "begin of the window [s]", .usual = "0",
     ENTRY_IN(scene_quantity, passing.from)},
    {"until", ENTRY_NUMBER, .summary = "its end [s]", .left_out = "that of the motion",
     ENTRY_IN(scene_quantity, passing.until)},
    {"taper", ENTRY_WORD, .words = SCENE_TAPER_CHOICES,
     .summary = "of a spectrum: hann weights its history with sin^2 from end to end",
     .usual = "none", ENTRY_IN(scene_quantity, passing.taper)},
    {.name = NULL}};

static const entry_field prediction[] = {
    {"value", ENTRY_NUMBER, .needed = 1, .summary = "of a model with its own error",
     ENTRY_IN(scene_quantity, prediction.value)},
    {"source", ENTRY_TEXT, .needed = 1, .summary = "of the model"},
    {.name = NULL}};

#define KIND(key)                                                                                  \
    {#key,                                                                                         \
     ENTRY_MAP,                                                                                    \
     .needed = 1,                                                                                  \
     .group = 1,                                                                                   \
     .type = &quantity_##key,                                                                      \
     ENTRY_IN(scene_quantity, what.kind)},
const entry_field entry_quantity[] = {
    QUANTITY_TYPES(KIND) /* one of them */
    {"unit", ENTRY_TEXT, .summary = "SI unit", .left_out = "that of the kind"},
    {"factor", ENTRY_NUMBER, .summary = "reported value = factor value + offset", .usual = "1",
     ENTRY_IN(scene_quantity, factor), .always = 1},
    {"offset", ENTRY_NUMBER, .summary = "in the same unit", .usual = "0",
     ENTRY_IN(scene_quantity, offset)},
    {"near_zero", ENTRY_NUMBER, .summary = "scale of errors of values near zero", .usual = "0",
     ENTRY_IN(scene_quantity, near_zero)},
    {"tolerance", ENTRY_NUMBER, .summary = "relative, of the limit", .usual = "1e-3",
     ENTRY_IN(scene_quantity, tolerance)},
    {"order", ENTRY_NUMBER, .summary = "least order of convergence", .usual = "0",
     ENTRY_IN(scene_quantity, least_order)},
    {"x", ENTRY_MAP, .below = abscissa, .summary = "abscissa of a curve",
     .left_out = "the path or time"},
    {"when", ENTRY_MAP, .below = when, .summary = "of a motion: which crossing; its window",
     .left_out = "the first that rises through 0"},
    {"prediction", ENTRY_MAP, .below = prediction, .summary = "shown, never judged",
     .left_out = "none"},
    {.name = NULL}};

void quantity_type_begin(const quantity_type *type, scene_quantity *q)
{
    q->what.kind = type->kind;
    q->what.type = type;
}

const quantity_type *quantity_type_of(const scene_quantity *q)
{
    return q->what.type;
}

int scene_gives(scene_analysis_kind analysis, const scene_quantity *q)
{
    return quantity_type_of(q)->analyses >> analysis & 1u;
}

int scene_is_passed(const scene_quantity *q, scene_analysis_kind analysis)
{
    const quantity_passing passing = quantity_type_of(q)->passing;
    const int extreme = q->reduction == SCENE_MAX || q->reduction == SCENE_MIN ||
                        q->reduction == SCENE_MAX_TIME || q->reduction == SCENE_MIN_TIME;
    if (analysis != SCENE_MOTION || passing == QUANTITY_AT_STATIONS)
        return 0;
    return extreme || (passing == QUANTITY_CROSSINGS && q->reduction > SCENE_CURVE);
}
