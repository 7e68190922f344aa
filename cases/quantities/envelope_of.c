/* The largest or smallest value, or that with the largest magnitude, of other quantities, which may
 * belong to different analyses. */
#include "cases/scene/scene.h"

#include <string.h>

static const entry_field fields[] = {
    {"quantities", ENTRY_FORMS, .needed = 1,
     .summary = "[NAME, NAME, ...]: quantities with the same unit"},
    {"select", ENTRY_WORD, .needed = 1, .words = SCENE_ENVELOPE_CHOICES,
     .summary = "largest or smallest value, or value with the largest magnitude",
     ENTRY_IN(scene_quantity, what.of.envelope), .first = SCENE_ENVELOPE_MAX},
    {.name = NULL}};

/* Returns "1", because the values of the other quantities are already in their reported units. */
static const char *unit(const scene *s, const scene_quantity *q)
{
    (void)s;
    (void)q;
    return "1";
}

static void meaning(FILE *to, const scene *s, const scene_quantity *q)
{
    static const char *const of[] = {"", "largest of", "least of",
                                     "value with the largest magnitude among"};
    fputs(of[q->what.of.envelope], to);
    for (int i = 0; i < q->overs; i++)
        fprintf(to, "%s %s", i > 0 ? "," : "", s->quantity[q->over[i]].name);
}

static status check(const scene *s, const scene_quantity *q, fault *f)
{
    if (q->overs == 0)
        return fault_set(f, STATUS_REFUSED,
                         "quantity %s: the envelope has no quantities; name at least one", q->name);
    for (int i = 0; i < q->overs; i++) {
        if (q->over[i] < 0 || q->over[i] >= s->quantities)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: quantity %d does not exist; add it first", q->name,
                             q->over[i]);
        const scene_quantity *one = &s->quantity[q->over[i]];
        if (one->what.kind == SCENE_ENVELOPE_OF || one->reduction == SCENE_CURVE)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: %s is %s; name quantities that have a single value",
                             q->name, one->name,
                             one->reduction == SCENE_CURVE ? "a curve" : "an envelope");
        if (strcmp(one->unit, s->quantity[q->over[0]].unit) != 0)
            return fault_set(f, STATUS_REFUSED,
                             "quantity %s: the unit of %s is %s and that of %s is %s; name "
                             "quantities with the same unit",
                             q->name, s->quantity[q->over[0]].name, s->quantity[q->over[0]].unit,
                             one->name, one->unit);
    }
    return STATUS_OK;
}

const quantity_type quantity_envelope_of = {
    .key = "envelope_of",
    .summary = "largest or smallest value of several quantities, from any analyses",
    .kind = SCENE_ENVELOPE_OF,
    .field = fields,
    .analyses = ~0u,
    .unit = unit,
    .meaning = meaning,
    .names_analysis = 1,
    .check = check};
