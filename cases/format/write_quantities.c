/* Quantities of a scene file. */
#include "cases/format/write_impl.h"

/* The place of a resultant; what is all along a member has none. */
static void write_end(writer *w, const void *entry)
{
    const scene_internal *c = scene_internal_of(entry);
    if (c->along != SCENE_ALONG_PLACE)
        return;
    if (c->place == 0 || c->place == 1) {
        write_values_key(w, "end");
        write_values_word(w, "from|to", c->place == 1);
    } else {
        write_values_key(w, "where");
        write_values_number(w, c->place);
    }
}

static void write_where(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->what.kind != SCENE_STRESS || scene_stress_of(q)->whole)
        return;
    write_values_key(w, "where");
    write_values_number(w, scene_stress_of(q)->place);
}

/* Where the place says it. */
static void write_side(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    const int stress = q->what.kind == SCENE_STRESS;
    const double place = stress ? scene_stress_of(q)->place : scene_internal_of(q)->place;
    const int before = stress ? scene_stress_of(q)->before : scene_internal_of(q)->before,
              said = stress ? !scene_stress_of(q)->whole : place > 0 && place < 1;
    if (said && before) {
        write_values_key(w, "side");
        write_values_word(w, "from|to", 0);
    }
}

static void write_taken(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->reduction == SCENE_LAST)
        return;
    write_values_key(w, q->reduction == SCENE_AT ? "at" : "take");
    if (q->reduction == SCENE_AT)
        write_values_number(w, q->at);
    else
        write_values_word(w, SCENE_TAKE_CHOICES, (int)q->reduction - (q->reduction > SCENE_AT));
}

static void write_unit(writer *w, const void *entry)
{
    write_values_key(w, "unit");
    write_values_quoted(w, ((const scene_quantity *)entry)->unit);
}

static void write_abscissa(writer *w, const void *entry)
{
    const scene_quantity *q = entry;
    if (q->reduction != SCENE_CURVE)
        return;
    write_values_key(w, "x");
    fputs(q->x.is_quantity ? "{quantity: " : "{name: ", w->to);
    write_values_quoted(w, q->x.name);
    if (!q->x.is_quantity) {
        write_values_key(w, "unit");
        write_values_quoted(w, q->x.unit);
        write_values_if(w, "factor", q->x.factor, 1);
        write_values_if(w, "offset", q->x.offset, 0);
    }
    fputc('}', w->to);
}

static void write_prediction(writer *w, const void *entry)
{
    const scene_prediction *p = &((const scene_quantity *)entry)->prediction;
    if (p->source == NULL)
        return;
    write_values_key(w, "prediction");
    fputs("{value: ", w->to);
    write_values_number(w, p->value);
    write_values_key(w, "source");
    write_values_quoted(w, p->source);
    fputc('}', w->to);
}

void write_quantities(writer *w)
{
    static const write_own own[] = {{"end", write_end},
                                    {"where", write_where},
                                    {"side", write_side},
                                    {"at", write_taken},
                                    {"unit", write_unit},
                                    {"x", write_abscissa},
                                    {"prediction", write_prediction},
                                    {NULL, NULL}};
    fputs(w->scene->quantities > 0 ? "quantities:\n" : "", w->to);
    for (int i = 0; i < w->scene->quantities; i++) {
        const scene_quantity *q = &w->scene->quantity[i];
        fputs("  ", w->to);
        write_values_quoted(w, q->name);
        fputs(": ", w->to);
        write_entry(w, entry_quantity, q, own);
        fputc('\n', w->to);
    }
}
