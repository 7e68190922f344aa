/* Quantities of a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/builder.h"
#include "cases/format/units.h"
#include "cases/scene/quantity_type.h"

/* Unit of a value where the file gives none. */
static const char *usual_unit(const scene *s, const scene_quantity *q)
{
    if (q->reduction == SCENE_PER_SECOND)
        return "Hz";
    if (q->reduction > SCENE_CURVE && q->reduction != SCENE_MEAN)
        return "s";
    return quantity_type_of(q)->unit(s, q);
}

static void read_unit(const fields *f, scene_quantity *q)
{
    const document_node *unit = document_find(f->map, "unit");
    char own[SCENE_UNIT];
    units_translate(&f->b->units, usual_unit(f->b->scene, q), sizeof own, own);
    /* a factor may make any unit of it */
    if (unit != NULL && !fields_have(f, "factor")) {
        if (!f->b->units.given)
            units_check(unit, f->b->mistakes);
        /* a load factor may have the unit of its load */
        if (strcmp(unit->text, own) != 0 && (f->b->units.given || strcmp(own, "1") != 0))
            document_mistake(f->b->mistakes, unit, 0,
                             "unit '%.40s': %sthe value is in %s; write that, remove it, or give "
                             "a factor",
                             unit->text, f->b->units.given ? "with the units of this scene " : "",
                             own);
    }
    if (unit != NULL && strlen(unit->text) >= sizeof q->unit)
        document_mistake(f->b->mistakes, unit, 0, "a unit of more than %zu characters; shorten it",
                         sizeof q->unit - 1);
    snprintf(q->unit, sizeof q->unit, "%s", unit != NULL ? unit->text : own);
}

/* A quantity with a curve, too. */
static void read_abscissa_of(const fields *x, scene_quantity *q)
{
    static const char *const own[] = {"name", "unit", "factor", "offset"};
    const int over = fields_entry(x, "quantity", SCENE_QUANTITIES);
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        if (fields_have(x, own[i]))
            document_mistake(x->b->mistakes, document_find(x->map, own[i]), 0,
                             "a curve over a quantity has its %s; say it there", own[i]);
    scene_set_curve_over(q, over >= 0 ? x->b->list[SCENE_QUANTITIES].entry[over].name : "", "");
}

/* Known when all quantities are. */
static void take_abscissa_units(scene *s)
{
    for (int i = 0; i < s->quantities; i++) {
        const int over = scene_abscissa_of(s, &s->quantity[i]);
        if (over != SCENE_NONE)
            memcpy(s->quantity[i].x.unit, s->quantity[over].unit, SCENE_UNIT);
    }
}

static void read_abscissa(const fields *f, scene_quantity *q)
{
    const fields x = fields_below(f, "x");
    if (fields_have(&x, "quantity")) {
        read_abscissa_of(&x, q);
        return;
    }
    const scene *s = f->b->scene;
    const int timed = q->analysis >= 0 && q->analysis < s->analyses &&
                      s->analysis[q->analysis].kind == SCENE_MOTION;
    const int seconds = timed && !(fabs(fields_number(&x, "factor", 1) - 1) > 0);
    scene_set_curve(q, fields_text(&x, "name", timed ? "time" : "path"),
                    fields_text(&x, "unit", seconds ? "s" : "1"), fields_number(&x, "factor", 1),
                    fields_number(&x, "offset", 0));
}

/* Which stations: `at` a value, or last, max, min, curve. */
static void read_stations(const fields *entry, const fields *what, scene_quantity *q)
{
    const int taken = fields_word(what, "take", SCENE_TAKE_CHOICES, 0);
    q->reduction = (scene_reduction)(taken + (taken >= SCENE_AT));
    if (fields_have(what, "at"))
        scene_set_at(q, fields_number(what, "at", 0));
    if (q->reduction == SCENE_CURVE)
        read_abscissa(entry, q);
    else if (fields_have(entry, "x"))
        document_mistake(entry->b->mistakes, document_find(entry->map, "x"), 0,
                         "an abscissa is of a curve; add take: curve, or remove it");
}

/* The prediction's source stays when the scene is built anew: as it stands in the file. */
static void read_prediction(const fields *f, const unrolled *entry, scene_quantity *q)
{
    const fields prediction = fields_below(f, "prediction");
    if (prediction.map == NULL)
        return;
    const document_node *written = document_find(entry->written, "prediction");
    q->prediction.source = document_find(written, "source")->text;
}

/* How many eigenvalues the quantities ask of an analysis. */
static int asked_of(const scene *s, int analysis)
{
    int most = 0;
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        int order = -1;
        if (scene_asks(q, analysis, SCENE_CRITICAL_FACTOR))
            order = scene_critical_load_of(q)->order;
        if (scene_asks(q, analysis, SCENE_FREQUENCY))
            order = scene_mode_of(q)->order;
        most = order >= most ? order + 1 : most;
    }
    return most;
}

/* The quantities say how many are computed; `wanted` may say so too, and must not contradict. */
static void check_wanted(builder *b)
{
    for (int i = 0; i < b->list[SCENE_ANALYSES].count; i++) {
        const fields entry = fields_of(b, &b->list[SCENE_ANALYSES].entry[i]);
        const fields f = fields_below(&entry, fields_have(&entry, "modal") ? "modal" : "buckling");
        const int asked = asked_of(b->scene, i);
        if (fields_have(&f, "wanted") && fields_whole(&f, "wanted", 0, 1, ENTRY_MOST_ORDER) < asked)
            document_mistake(b->mistakes, document_find(f.map, "wanted"), 0,
                             "quantities ask for %d of this analysis; write %d, or remove it",
                             asked, asked);
    }
}

/* What its table does not say of its kind. */
static void settle(const fields *what, const quantity_type *type, scene_quantity *q)
{
    const scene *s = what->b->scene;
    const char *key = "", *wrong = type->settle != NULL ? type->settle(s, q, &key) : NULL;
    if (wrong != NULL)
        document_mistake(what->b->mistakes, document_find(what->map, key), 0, "%s", wrong);
    if (fields_have(what, "side") && !fields_have(what, "where"))
        document_mistake(what->b->mistakes, document_find(what->map, "side"), 0,
                         "side: of a place of the member, at which a load acts; say which, with "
                         "'where', or take it away");
    if (q->analysis >= 0 && !scene_gives(s->analysis[q->analysis].kind, q))
        builder_no_quantity(what, type->key, q);
}

void builder_quantities(builder *b)
{
    for (int i = 0; i < b->list[SCENE_QUANTITIES].count; i++) {
        const unrolled *entry = &b->list[SCENE_QUANTITIES].entry[i];
        const fields f = fields_of(b, entry);
        scene_quantity *q = scene_add_quantity(b->scene, entry->name, "", SCENE_NONE,
                                               (scene_extract){.kind = SCENE_COORDINATE});
        fields_read(&f, entry_quantity, q);
        const quantity_type *type = quantity_type_of(q);
        const fields what = fields_below(&f, type->key);
        settle(&what, type, q);
        read_stations(&f, &what, q);
        read_unit(&f, q);
        read_prediction(&f, entry, q);
    }
    take_abscissa_units(b->scene);
    check_wanted(b);
}
