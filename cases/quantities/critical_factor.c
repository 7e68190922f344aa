/* Load factor of linear buckling. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    {"sign", ENTRY_WORD, .words = "positive|negative", .summary = "sign of the load factor",
     .usual = "positive", ENTRY_IN(scene_quantity, what.of.load.sign), .first = 1, .falls = 2},
    {"which", ENTRY_WHOLE, .summary = "index of the critical factor, counted from 0", .usual = "0",
     ENTRY_IN(scene_quantity, what.of.load.order), .most = ENTRY_MOST_ORDER},
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    meaning_ordinal(to, q->what.of.load.order);
    fprintf(to, " %s factor of the loads at which the structure buckles",
            q->what.of.load.sign > 0 ? "positive" : "negative");
}

static double eigenvalue(const scene_quantity *q, const quantity_eigenvalue *found, double *part)
{
    (void)q;
    *part = found->value;
    return found->value;
}

const quantity_type quantity_critical_factor = {.key = "critical_factor",
                                                .summary = "critical load factor",
                                                .kind = SCENE_CRITICAL_FACTOR,
                                                .field = fields,
                                                .analyses = 1u << SCENE_BUCKLING,
                                                .unit = unit,
                                                .meaning = meaning,
                                                .eigenvalue = eigenvalue};
