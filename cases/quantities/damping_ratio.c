/* Damping ratio of a mode, or its rate of decay. */
#include <math.h>

#include "cases/scene/scene.h"

static const entry_field fields[] = {
    QUANTITY_ANALYSIS,
    QUANTITY_MODE,
    {"of", ENTRY_WORD, .words = "ratio|decay",
     .summary = "measure of damping: -Re s/|s| of the eigenvalue s, or -Re s [1/s]",
     .usual = "ratio", ENTRY_IN(scene_quantity, what.of.mode.decay)},
    {.name = NULL}};

static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    return q->what.of.mode.decay ? "1/s" : "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    (void)s;
    fputs(q->what.of.mode.decay ? "rate of decay of the " : "damping ratio of the ", to);
    meaning_ordinal(to, q->what.of.mode.order);
    fputs(" damped mode", to);
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    if (s->analysis[q->analysis].damped)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "quantity %s: the modes of %s are undamped; add damped: yes to that analysis",
                     q->name, scene_called(s, SCENE_ANALYSES, q->analysis).text);
}

static double eigenvalue(const scene_quantity *q, const quantity_eigenvalue *found, double *part)
{
    *part = found->decay;
    return q->what.of.mode.decay ? found->decay : found->decay / hypot(found->decay, found->value);
}

const quantity_type quantity_damping_ratio = {.key = "damping_ratio",
                                              .summary = "damping ratio of a mode",
                                              .kind = SCENE_DAMPING_RATIO,
                                              .field = fields,
                                              .analyses = 1u << SCENE_MODAL,
                                              .unit = unit,
                                              .meaning = meaning,
                                              .eigenvalue = eigenvalue,
                                              .check = check};
