/* Quantities of a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/builder.h"
#include "cases/format/units.h"

/* Unit of a value where the file gives none. */
static const char *usual_unit(const scene *s, const scene_quantity *q)
{
    if (q->reduction == SCENE_PER_SECOND)
        return "Hz";
    if (q->reduction > SCENE_CURVE && q->reduction != SCENE_MEAN)
        return "s";
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        return scene_component_of(q)->component <= SCENE_UZ ? "m" : "rad";
    case SCENE_REACTION:
        return scene_component_of(q)->component <= SCENE_UZ ? "N" : "N m";
    case SCENE_COMPLIANCE_ENTRY:
        return scene_compliance_unit(scene_entry_of(q)->row, scene_entry_of(q)->column);
    case SCENE_STIFFNESS_ENTRY:
        return scene_entry_of(q)->row <= SCENE_UZ ? "N/m" : "N m/rad";
    case SCENE_FREQUENCY:
        return "Hz";
    case SCENE_GROWTH:
        return "1/s";
    case SCENE_CRITICAL_POINT:
        return scene_point_of(q)->ordinate == SCENE_CONTROL ? "m" : "1";
    case SCENE_DRIVER_VALUE:
        for (int i = 0; i < s->nodes; i++)
            for (int k = 0; k < 3; k++)
                if (s->node[i].angle[k] == scene_driver_of(q))
                    return "rad";
        return "m";
    case SCENE_INTERNAL:
        if (scene_internal_of(q)->resultant == SCENE_BIMOMENT)
            return "N m^2";
        return scene_internal_of(q)->resultant < SCENE_MX ? "N" : "N m";
    case SCENE_RELATIVE:
        return scene_relative_of(q)->component <= SCENE_UZ ? "m" : "rad";
    case SCENE_RATE:
        return scene_component_of(q)->component <= SCENE_UZ ? "m/s" : "rad/s";
    case SCENE_BALANCE:
        if (scene_balance_in(q) < SCENE_PX)
            return "J";
        return scene_balance_in(q) < SCENE_LX ? "kg m/s" : "kg m^2/s";
    case SCENE_STRESS:
        return "Pa";
    case SCENE_ORIENTATION:
    case SCENE_CRITICAL_FACTOR:
    case SCENE_FACTOR_AT:
        break;
    }
    return "1";
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
            document_mistake(
                f->b->mistakes, unit, 0,
                "unit '%.40s': %sthe value is in %s; write that, leave it out, or give "
                "a factor",
                unit->text, f->b->units.given ? "with the units of this scene " : "", own);
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
    static const scene_reduction taken[] = {
        SCENE_LAST,     SCENE_MAX,      SCENE_MIN,    SCENE_CURVE,      SCENE_MAX_TIME,
        SCENE_MIN_TIME, SCENE_CROSSING, SCENE_PERIOD, SCENE_PER_SECOND, SCENE_MEAN};
    q->reduction = taken[fields_word(what, "take", SCENE_TAKE_CHOICES, 0)];
    if (fields_have(what, "at"))
        scene_set_at(q, fields_number(what, "at", 0));
    if (q->reduction == SCENE_CURVE)
        read_abscissa(entry, q);
    else if (fields_have(entry, "x"))
        document_mistake(entry->b->mistakes, document_find(entry->map, "x"), 0,
                         "an abscissa is of a curve; add take: curve, or leave it out");
}

/* Which crossing of a motion, and in which window. */
static void read_passing(const fields *entry, scene_quantity *q)
{
    const fields f = fields_below(entry, "when");
    if (f.map == NULL)
        return;
    q->passing = (scene_passing){
        .level = fields_number(&f, "level", 0),
        .direction = (scene_direction)fields_word(&f, "direction", SCENE_DIRECTION_CHOICES, 0),
        .order = fields_whole(&f, "which", 0, 0, BUILDER_MOST_ORDER),
        .from = fields_number(&f, "from", 0),
        .until = fields_number(&f, "until", 0)};
}

/* The prediction's source stays when the scene is built anew: as it stands in the file. */
static void read_prediction(const fields *f, const unrolled *entry, scene_quantity *q)
{
    const fields prediction = fields_below(f, "prediction");
    if (prediction.map == NULL)
        return;
    const document_node *written = document_find(entry->written, "prediction");
    q->prediction.value = fields_number(&prediction, "value", 0);
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
        if (fields_have(&f, "wanted") &&
            fields_whole(&f, "wanted", 0, 1, BUILDER_MOST_ORDER) < asked)
            document_mistake(b->mistakes, document_find(f.map, "wanted"), 0,
                             "quantities ask for %d of this analysis; write %d, or leave it out",
                             asked, asked);
    }
}

void builder_quantities(builder *b)
{
    for (int i = 0; i < b->list[SCENE_QUANTITIES].count; i++) {
        const unrolled *entry = &b->list[SCENE_QUANTITIES].entry[i];
        const fields f = fields_of(b, entry);
        const builder_extract *kind = builder_extract_of(&f);
        const fields what = fields_below(&f, kind->key);
        const int analysis = fields_entry(&what, "analysis", SCENE_ANALYSES);
        const scene_extract extract = kind->read(&what);
        if (analysis >= 0 && analysis < b->scene->analyses &&
            !scene_gives(b->scene->analysis[analysis].kind, extract.kind))
            builder_no_quantity(&what, b->list[SCENE_ANALYSES].entry[analysis].name, kind->key,
                                b->scene->analysis[analysis].kind, extract.kind);
        scene_quantity *q = scene_add_quantity(b->scene, entry->name, "", analysis, extract);
        read_stations(&f, &what, q);
        read_passing(&f, q);
        read_unit(&f, q);
        q->factor = fields_number(&f, "factor", 1);
        q->offset = fields_number(&f, "offset", 0);
        q->near_zero = fields_number(&f, "near_zero", 0);
        q->tolerance = fields_number(&f, "tolerance", SCENE_TOLERANCE);
        q->least_order = fields_number(&f, "order", 0);
        read_prediction(&f, entry, q);
    }
    take_abscissa_units(b->scene);
    check_wanted(b);
}
