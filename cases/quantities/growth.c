/* Largest growth rate of all modes, or 0 if the state is stable. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {QUANTITY_ANALYSIS, QUANTITY_TAKEN, {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "1/s";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    fputs("largest growth rate of small motions; 0 if no small motion grows", to);
}

const quantity_type quantity_growth = {.key = "growth",
                                       .summary = "largest growth rate of a small motion",
                                       .kind = SCENE_GROWTH,
                                       .field = fields,
                                       .analyses = 1u << SCENE_MODAL | 1u << SCENE_ROTATION,
                                       .unit = unit,
                                       .meaning = meaning};
