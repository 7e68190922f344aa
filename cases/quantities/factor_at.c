/* Load factor of a continuation. */
#include "cases/scene/scene.h"

static const entry_field fields[] = {QUANTITY_ANALYSIS, QUANTITY_TAKEN, {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    fputs("load factor", to);
}

static double read(const scene_quantity *q, const quantity_state *state)
{
    (void)q;
    return state->path;
}

const quantity_type quantity_factor_at = {.key = "factor_at",
                                          .summary =
                                              "load factor at a value of the control coordinate",
                                          .kind = SCENE_FACTOR_AT,
                                          .field = fields,
                                          .analyses = 1u << SCENE_CONTINUATION,
                                          .unit = unit,
                                          .meaning = meaning,
                                          .read = read};
