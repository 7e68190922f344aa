/* Natural frequency. */
#include "cases/scene/scene.h"
#include "elements/math/scalar.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS, QUANTITY_MODE, QUANTITY_TAKEN, {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "Hz";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    static const char *const family[] = {
        [SCENE_ANY] = "",
        [SCENE_NOT_AXIAL] = ", without stretching modes",
        [SCENE_AXIAL] = " of the stretching modes",
        [SCENE_BENDING_Y] = " of the modes that bend along the section's y",
        [SCENE_BENDING_Z] = " of the modes that bend along the section's z",
        [SCENE_TORSION] = " of the modes that twist"};
    const scene_mode *mode = &q->what.of.mode;
    meaning_ordinal(to, mode->order);
    fprintf(to, " natural frequency%s", family[mode->family]);
    if (mode->half_waves > 0)
        fprintf(to, " with %d half-wave%s", mode->half_waves, mode->half_waves > 1 ? "s" : "");
}

static double eigenvalue(const scene_quantity *q, const quantity_eigenvalue *found, double *part)
{
    (void)q;
    *part = found->value;
    return found->value / (2 * PI);
}

const quantity_type quantity_frequency = {.key = "frequency",
                                          .summary = "natural frequency",
                                          .kind = SCENE_FREQUENCY,
                                          .field = fields,
                                          .analyses = 1u << SCENE_MODAL | 1u << SCENE_ROTATION,
                                          .unit = unit,
                                          .meaning = meaning,
                                          .eigenvalue = eigenvalue};
