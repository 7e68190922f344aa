/* Quantities of a scene. */
#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"

static const char *usual_unit(const scene *s, const scene_quantity *q)
{
    if (q->reduction == SCENE_PER_SECOND)
        return "Hz";
    if (scene_is_timed(q->reduction))
        return "s";
    return quantity_type_of(q)->unit(s, q);
}

/* Changes a unit to that of a power spectral density, such as "m^2/Hz" or "(m/s)^2/Hz". */
static void make_density(char unit[SCENE_UNIT])
{
    char of[SCENE_UNIT];
    memcpy(of, unit, sizeof of);
    const int plain = strpbrk(of, " /^") == NULL;
    if (strcmp(of, "1") == 0)
        snprintf(unit, SCENE_UNIT, "1/Hz");
    else
        snprintf(unit, SCENE_UNIT, "%s%.8s%s^2/Hz", plain ? "" : "(", of, plain ? "" : ")");
}

/* Returns 1 for K and rad, which are the same in all unit systems. */
static int is_kept(const unit_system *u, const char *unit)
{
    char own[SCENE_UNIT];
    units_translate(u, unit, sizeof own, own);
    return strcmp(own, unit) == 0 && (strcmp(unit, "K") == 0 || strcmp(unit, "rad") == 0);
}

static void mistake_unit(const fields *f, const document_node *unit, const char *own)
{
    if (strcmp(own, "1") == 0)
        document_mistake(f->b->mistakes, unit, 0,
                         "unit '%.40s': the quantity is a plain number; remove 'unit', or give a "
                         "'factor' in this unit, such as the load that a load factor multiplies",
                         unit->text);
    else
        document_mistake(f->b->mistakes, unit, 0,
                         "unit '%.40s': the value is in %s%s; write 'unit: %s', or give a "
                         "'factor' that converts the value",
                         unit->text, own, f->b->units.given ? ", in the units of this scene" : "",
                         own);
}

static void read_unit(const fields *f, scene_quantity *q)
{
    const document_node *unit = document_find(f->map, "unit");
    char own[SCENE_UNIT];
    units_translate(&f->b->units, usual_unit(f->b->scene, q), sizeof own, own);
    if (q->transform == SCENE_PSD)
        make_density(own);
    if (unit != NULL && !fields_have(f, "factor") && q->what.kind != SCENE_ENVELOPE_OF) {
        const int factor = strcmp(own, "1") == 0,
                  kept = factor && is_kept(&f->b->units, unit->text);
        if (factor && !f->b->units.given)
            units_check(unit, f->b->mistakes);
        if (strcmp(unit->text, own) != 0 && !kept && (f->b->units.given || !factor))
            mistake_unit(f, unit, own);
    }
    if (unit != NULL && strlen(unit->text) >= sizeof q->unit)
        document_mistake(f->b->mistakes, unit, 0,
                         "the unit has more than %zu characters; shorten it", sizeof q->unit - 1);
    snprintf(q->unit, sizeof q->unit, "%s", unit != NULL ? unit->text : own);
}

static void read_abscissa_of(const fields *x, scene_quantity *q)
{
    static const char *const own[] = {"name", "unit", "factor", "offset"};
    const int over = fields_entry(x, "quantity", SCENE_QUANTITIES);
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        if (fields_have(x, own[i]))
            document_mistake(x->b->mistakes, document_find(x->map, own[i]), 0,
                             "x: the curve uses the %s of the quantity on its abscissa; remove "
                             "'%s', and set it there",
                             own[i], own[i]);
    scene_set_curve_over(q, over >= 0 ? x->b->list[SCENE_QUANTITIES].entry[over].name : "", "");
}

static void take_abscissa_units(scene *s)
{
    for (int i = 0; i < s->quantities; i++) {
        const int over = scene_abscissa_of(s, &s->quantity[i]);
        if (over != SCENE_NONE)
            memcpy(s->quantity[i].x.unit, s->quantity[over].unit, SCENE_UNIT);
    }
}

static void read_members(const fields *what, scene_quantity *q)
{
    const document_node *n = document_find(what->map, "quantities");
    if (n == NULL)
        return;
    if (n->kind != DOCUMENT_LIST || n->count == 0) {
        document_mistake(what->b->mistakes, n, 0, "quantities: give a list of names of quantities");
        return;
    }
    for (int i = 0; i < n->count; i++) {
        const int at = scene_grow(what->b->scene, &q->over, &q->overs, sizeof *q->over);
        if (at >= 0)
            q->over[at] = fields_entry_of(what, n->item[i], SCENE_QUANTITIES);
    }
}

static void take_envelopes(builder *b)
{
    scene *s = b->scene;
    for (int i = 0; i < s->quantities; i++) {
        scene_quantity *q = &s->quantity[i];
        if (q->what.kind != SCENE_ENVELOPE_OF)
            continue;
        const int first = q->overs > 0 && q->over[0] < s->quantities ? q->over[0] : SCENE_NONE;
        q->analysis = first >= 0 ? s->quantity[first].analysis : 0;
        const fields f = fields_of(b, &b->list[SCENE_QUANTITIES].entry[i]);
        if (fields_have(&f, "when"))
            document_mistake(b->mistakes, document_find(f.map, "when"), 0,
                             "when: this key is only for quantities of motions; add it to the "
                             "quantities of the envelope, or remove it");
        if (!fields_have(&f, "unit") && first >= 0)
            memcpy(q->unit, s->quantity[first].unit, sizeof q->unit);
        else if (first >= 0 && !fields_have(&f, "factor") &&
                 strcmp(q->unit, s->quantity[first].unit) != 0)
            document_mistake(b->mistakes, document_find(f.map, "unit"), 0,
                             "unit '%.40s': the quantities of the envelope are in %s; write "
                             "this unit, or remove 'unit'",
                             q->unit, s->quantity[first].unit);
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
    const int steady = q->analysis >= 0 && q->analysis < s->analyses &&
                       s->analysis[q->analysis].kind == SCENE_HARMONIC;
    const int hertz = steady || q->transform != SCENE_HISTORY;
    const int seconds = (timed || steady) && !(fabs(fields_number(&x, "factor", 1) - 1) > 0);
    scene_set_curve(q,
                    fields_text(&x, "name",
                                hertz   ? "frequency"
                                : timed ? "time"
                                        : "path"),
                    fields_text(&x, "unit",
                                !seconds ? "1"
                                : hertz  ? "Hz"
                                         : "s"),
                    fields_number(&x, "factor", 1), fields_number(&x, "offset", 0));
}

static void read_stations(const fields *entry, const fields *what, scene_quantity *q)
{
    const int taken = fields_word(what, "take", SCENE_TAKE_CHOICES, 0),
              word = taken + (taken >= SCENE_AT), transformed = word >= SCENE_REDUCTIONS;
    q->reduction = transformed ? SCENE_CURVE : (scene_reduction)word;
    if (transformed)
        q->transform = word == SCENE_REDUCTIONS ? SCENE_SPECTRUM : SCENE_PSD;
    if (fields_have(what, "at"))
        scene_set_at(q, fields_number(what, "at", 0));
    if (q->reduction == SCENE_CURVE)
        read_abscissa(entry, q);
    else if (fields_have(entry, "x"))
        document_mistake(entry->b->mistakes, document_find(entry->map, "x"), 0,
                         "x: an abscissa requires a curve; add 'take: curve', or remove 'x'");
}

static void check_when(const fields *f, const scene_quantity *q)
{
    static const char *const crossing[] = {"direction", "level", "which"};
    const scene *s = f->b->scene;
    const fields when = fields_below(f, "when");
    if (!fields_have(f, "when") || q->what.kind == SCENE_ENVELOPE_OF || q->analysis < 0 ||
        q->analysis >= s->analyses)
        return;
    if (s->analysis[q->analysis].kind != SCENE_MOTION)
        document_mistake(f->b->mistakes, document_find(f->map, "when"), 0,
                         "when: this key gives the window of a motion, but %s is not a motion; "
                         "remove the key, or name a motion",
                         scene_called(s, SCENE_ANALYSES, q->analysis).text);
    else if (q->transform == SCENE_HISTORY && !scene_is_passed(q, SCENE_MOTION))
        document_mistake(f->b->mistakes, document_find(f->map, "when"), 0,
                         "when: this key gives the window of crossings, means, spectra, maxima and "
                         "minima, but this quantity is none of these; remove it, or change 'take'");
    else
        for (int i = q->passing.direction == SCENE_RISING; i < 3; i++)
            if (fields_have(&when, crossing[i]) && q->reduction != SCENE_CROSSING &&
                q->reduction != SCENE_PERIOD && q->reduction != SCENE_PER_SECOND)
                document_mistake(f->b->mistakes, document_find(when.map, crossing[i]), 0,
                                 "%s: this key is only for crossings; remove it, or write take: "
                                 "crossing, period or per_second",
                                 crossing[i]);
}

static void read_prediction(const fields *f, const unrolled *entry, scene_quantity *q)
{
    const fields prediction = fields_below(f, "prediction");
    if (prediction.map == NULL)
        return;
    const document_node *written = document_find(entry->written, "prediction");
    q->prediction.source = document_find(written, "source")->text;
}

static int requested_of(const scene *s, int analysis)
{
    int most = 0;
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        int order = -1;
        if (scene_requests(q, analysis, SCENE_CRITICAL_FACTOR))
            order = scene_critical_load_of(q)->order;
        if (scene_requests(q, analysis, SCENE_FREQUENCY) ||
            scene_requests(q, analysis, SCENE_DAMPING_RATIO))
            order = scene_mode_of(q)->order;
        most = order >= most ? order + 1 : most;
    }
    return most;
}

static void check_wanted(builder *b)
{
    for (int i = 0; i < b->list[SCENE_ANALYSES].count; i++) {
        const fields entry = fields_of(b, &b->list[SCENE_ANALYSES].entry[i]);
        const fields f = fields_below(&entry, fields_have(&entry, "modal") ? "modal" : "buckling");
        const int requested = requested_of(b->scene, i);
        if (fields_have(&f, "wanted") &&
            fields_whole(&f, "wanted", 0, 1, ENTRY_MOST_ORDER) < requested)
            document_mistake(
                b->mistakes, document_find(f.map, "wanted"), 0,
                "wanted: the quantities require %d modes of this analysis; give at least %d, or "
                "remove the key",
                requested, requested);
    }
}

static void read_overs(const fields *what, scene_quantity *q)
{
    const document_node *n = document_find(what->map, "combinations");
    const int count = n == NULL ? 0 : n->kind == DOCUMENT_LIST ? n->count : 1;
    if (n != NULL && (q->envelope == SCENE_ENVELOPE_NONE || count == 0))
        document_mistake(what->b->mistakes, n, 0,
                         "combinations: this key lists the combinations of an envelope; %s",
                         q->envelope == SCENE_ENVELOPE_NONE
                             ? count == 0 ? "add 'envelope', or remove the key"
                                          : "add 'envelope', or give one 'combination'"
                             : "name a combination, or remove the key to include all "
                               "combinations");
    for (int i = 0; i < count; i++) {
        const int over =
            fields_entry_of(what, n->kind == DOCUMENT_LIST ? n->item[i] : n, SCENE_COMBINATIONS);
        const int at = scene_grow(what->b->scene, &q->over, &q->overs, sizeof *q->over);
        if (at >= 0)
            q->over[at] = over;
    }
}

static void complete(const fields *what, const quantity_type *type, scene_quantity *q)
{
    const scene *s = what->b->scene;
    const char *key = "", *wrong = type->complete != NULL ? type->complete(s, q, &key) : NULL;
    if (wrong != NULL)
        document_mistake(what->b->mistakes, document_find(what->map, key), 0, "%s", wrong);
    if (fields_have(what, "side") && !fields_have(what, "where"))
        document_mistake(what->b->mistakes, document_find(what->map, "side"), 0,
                         "side: this key selects the side of the position 'where' at which a load "
                         "acts; add 'where', or remove 'side'");
    if (q->analysis >= 0 && !scene_gives(s->analysis[q->analysis].kind, q))
        builder_no_quantity(what, type->key, q);
}

void builder_quantities(builder *b)
{
    for (int i = 0; i < b->list[SCENE_QUANTITIES].count; i++) {
        const unrolled *entry = &b->list[SCENE_QUANTITIES].entry[i];
        const fields f = fields_of(b, entry);
        scene_quantity *q =
            scene_add_quantity(b->scene, entry->name, "", SCENE_NONE, scene_coordinate(0, 0));
        fields_read(&f, entry_quantity, q);
        const quantity_type *type = quantity_type_of(q);
        const fields what = fields_below(&f, type->key);
        complete(&what, type, q);
        if (q->what.kind == SCENE_ENVELOPE_OF)
            read_members(&what, q);
        else
            read_overs(&what, q);
        read_stations(&f, &what, q);
        check_when(&f, q);
        read_unit(&f, q);
        read_prediction(&f, entry, q);
    }
    take_abscissa_units(b->scene);
    take_envelopes(b);
    check_wanted(b);
}

static int add_analysis(builder *b)
{
    double end = 0;
    for (int i = 0; i < b->scene->drivers; i++) {
        const scene_driver *d = &b->scene->driver[i];
        if (d->value != NULL && d->path != NULL && d->stations > 0)
            end = fmax(end, d->path[d->stations - 1]);
    }
    return end > 0 ? scene_add_static(b->scene, 1, &end, 1) : scene_add_linear(b->scene);
}

static int is_requested(const scene *s, int node)
{
    for (int i = 0; i < s->loads; i++)
        if (!scene_load_along(&s->load[i]) && s->load[i].where == node)
            return 1;
    for (int k = 0; k < 3; k++)
        if (s->node[node].translation[k] >= 0)
            return 1;
    return 0;
}

/* Returns the diagonal [m] of the smallest box that contains all nodes. */
static double size_of(const scene *s)
{
    double least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int i = 0; i < s->nodes; i++)
        for (int k = 0; k < 3; k++) {
            least[k] = fmin(least[k], s->node[i].position[k]);
            most[k] = fmax(most[k], s->node[i].position[k]);
        }
    return s->nodes > 0 ? hypot(hypot(most[0] - least[0], most[1] - least[1]), most[2] - least[2])
                        : 0;
}

static void add_displacements(builder *b, int analysis, int node, int prefixed)
{
    static const char *const component[] = {"ux", "uy", "uz"};
    scene *s = b->scene;
    for (int k = 0; k < 3; k++) {
        char name[2 * SCENE_NAME + 8];
        if (s->node[node].translation[k] != SCENE_FREE)
            continue;
        snprintf(name, sizeof name, "%s%s%s_%s",
                 prefixed ? b->list[SCENE_ANALYSES].entry[analysis].name : "", prefixed ? "_" : "",
                 b->list[SCENE_NODES].entry[node].name, component[k]);
        scene_quantity *q =
            scene_add_quantity(s, name, "m", analysis, scene_coordinate(node, SCENE_UX + k));
        q->near_zero = 1e-6 * size_of(s);
    }
}

static void add_states(builder *b, int analysis, int prefixed)
{
    const scene *s = b->scene;
    const int first = s->quantities;
    int requested = 0;
    for (int i = 0; i < s->nodes; i++)
        requested += is_requested(s, i);
    for (int i = 0; i < s->nodes; i++)
        if (requested > 0 ? is_requested(s, i) : s->node[i].attached == SCENE_NONE)
            add_displacements(b, analysis, i, prefixed);
    for (int i = first; i < s->quantities && scene_solves_all(s, analysis); i++)
        s->quantity[i].envelope = SCENE_ENVELOPE_LARGEST;
}

static void add_energy(builder *b, int analysis, int prefixed)
{
    char name[SCENE_NAME + 8];
    snprintf(name, sizeof name, "%s%senergy",
             prefixed ? b->list[SCENE_ANALYSES].entry[analysis].name : "", prefixed ? "_" : "");
    scene_add_quantity(b->scene, name, "J", analysis, scene_balance_of(SCENE_ENERGY));
}

static void add_quantities(builder *b)
{
    scene *s = b->scene;
    for (int i = 0; i < s->analyses; i++)
        switch (s->analysis[i].kind) {
        case SCENE_LINEAR:
        case SCENE_STATIC:
            add_states(b, i, s->analyses > 1);
            break;
        case SCENE_BUCKLING:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "1", i,
                               scene_critical_factor(1, 0));
            break;
        case SCENE_MOTION:
            add_states(b, i, s->analyses > 1);
            add_energy(b, i, s->analyses > 1);
            break;
        case SCENE_MODAL:
        case SCENE_ROTATION:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "Hz", i,
                               scene_frequency(0, SCENE_ANY));
            break;
        case SCENE_COMPLIANCE:
            for (int k = 0; k < 3; k++) {
                char name[SCENE_NAME + 8];
                snprintf(name, sizeof name, "%s_k_%c", b->list[SCENE_ANALYSES].entry[i].name,
                         "xyz"[k]);
                scene_add_quantity(s, name, "N/m", i, scene_stiffness_entry(SCENE_UX + k));
            }
            break;
        case SCENE_HARMONIC:
            break;
        case SCENE_CONTINUATION:
            scene_add_quantity(s, b->list[SCENE_ANALYSES].entry[i].name, "1", i, scene_factor_at());
            break;
        }
}

void builder_defaults(builder *b)
{
    if (b->mistakes->count > 0)
        return;
    if (b->scene->analyses == 0 && add_analysis(b) < 0)
        return;
    if (b->scene->quantities == 0)
        add_quantities(b);
}

static const char *word_end(const char *at)
{
    static const char *const si[] = {"1", "m", "rad", "s", "kg", "N", "Pa", "J", "W", "Hz", "K"};
    const size_t length = strcspn(at, " /^()");
    for (size_t i = 0; i < sizeof si / sizeof si[0]; i++)
        if (strlen(si[i]) == length && strncmp(si[i], at, length) == 0) {
            at += length;
            return at[0] == '^' && at[1] >= '2' && at[1] <= '9' ? at + 2 : at;
        }
    return NULL;
}

static const char *product_end(const char *at)
{
    at = word_end(at);
    while (at != NULL && *at == ' ')
        at = word_end(at + 1);
    return at;
}

/* Returns 1 for a unit such as "N m", "kg/m^3" or "rad/(N m)". After a slash, several units must be
 * in parentheses. */
static int is_si(const char *unit)
{
    const char *at = product_end(unit);
    if (at == NULL || *at != '/')
        return at != NULL && *at == '\0';
    const int several = at[1] == '(';
    at = several ? product_end(at + 2) : word_end(at + 1);
    return at != NULL && strcmp(at, several ? ")" : "") == 0;
}

static const struct {
    const char *unit, *remedy;
} foreign[] = {{"mm", "write 20 mm as 20e-3 with unit: m"},
               {"cm", "write 20 cm as 0.2 with unit: m"},
               {"km", "write 2 km as 2e3 with unit: m"},
               {"in", "write 2 in as 2*25.4e-3 with unit: m"},
               {"mm^2", "write 2 mm^2 as 2e-6 with unit: m^2"},
               {"mm^4", "write 2 mm^4 as 2e-12 with unit: m^4"},
               {"kN", "write 2 kN as 2e3 with unit: N"},
               {"MN", "write 2 MN as 2e6 with unit: N"},
               {"kNm", "write 2 kNm as 2e3 with unit: N m"},
               {"Nm", "write unit: N m"},
               {"m2", "write unit: m^2"},
               {"m3", "write unit: m^3"},
               {"m4", "write unit: m^4"},
               {"kg/m3", "write unit: kg/m^3"},
               {"N/m2", "write unit: Pa"},
               {"kN m", "write 2 kN m as 2e3 with unit: N m"},
               {"kJ", "write 2 kJ as 2e3 with unit: J"},
               {"kW", "write 2 kW as 2e3 with unit: W"},
               {"deg/s", "write 45 deg/s as 45*deg with unit: rad/s"},
               {"N mm", "write 2 N mm as 2e-3 with unit: N m"},
               {"N/mm", "write 2 N/mm as 2e3 with unit: N/m"},
               {"kN/m", "write 2 kN/m as 2e3 with unit: N/m"},
               {"MPa", "write 210 MPa as 210e6 with unit: Pa"},
               {"N/mm^2", "write 210 N/mm^2 as 210e6 with unit: Pa"},
               {"GPa", "write 210 GPa as 210e9 with unit: Pa"},
               {"deg", "write 45 deg as 45*deg with unit: rad"},
               {"degree", "write 45 degrees as 45*deg with unit: rad"},
               {"degC", "a temperature change is in K; write unit: K"},
               {"°C", "a temperature change is in K; write unit: K"},
               {"g", "write 2 g as 2e-3 with unit: kg"},
               {"t", "write 2 t as 2e3 with unit: kg"},
               {"ms", "write 2 ms as 2e-3 with unit: s"},
               {"kHz", "write 2 kHz as 2e3 with unit: Hz"},
               {"rpm", "write 60 rpm as 60*2*pi/60 with unit: rad/s"},
               {"-", "write unit: 1"},
               {"", "write unit: 1"}};

void units_check(const document_node *unit, mistakes *m)
{
    if (is_si(unit->text))
        return;
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        if (strcmp(foreign[i].unit, unit->text) == 0) {
            document_mistake(m, unit, 0, "unit '%s': values are in SI units; %s", unit->text,
                             foreign[i].remedy);
            return;
        }
    document_mistake(m, unit, 0,
                     "unit '%.40s' is unknown; values are in SI units, such as m, rad, N, N m, "
                     "N/m, Pa, kg/m^3, Hz, 1",
                     unit->text);
}

typedef struct named_unit {
    const char *name;
    double value;
} named_unit;

static const named_unit lengths[] = {{"m", 1},       {"cm", 1e-2},   {"mm", 1e-3}, {"um", 1e-6},
                                     {"in", 0.0254}, {"ft", 0.3048}, {NULL, 0}},
                        forces[] = {{"N", 1},
                                    {"mN", 1e-3},
                                    {"kN", 1e3},
                                    {"MN", 1e6},
                                    {"lbf", 4.4482216152605},
                                    {NULL, 0}},
                        stresses[] = {{"Pa", 1},
                                      {"kPa", 1e3},
                                      {"MPa", 1e6},
                                      {"GPa", 1e9},
                                      {"psi", 4.4482216152605 / (0.0254 * 0.0254)},
                                      {NULL, 0}};

static const named_unit *find_unit(const named_unit list[], const char *text, size_t length)
{
    for (; list->name != NULL; list++)
        if (strlen(list->name) == length && strncmp(list->name, text, length) == 0)
            return list;
    return NULL;
}

/* Reads one of the three words of a unit system. Reports an error and returns 0 if the word is
 * invalid. */
static int units_read_unit(const document_node *n, const char *word, size_t length,
                           unit_system *out, double *stress, mistakes *m)
{
    const named_unit *L = find_unit(lengths, word, length), *F = find_unit(forces, word, length),
                     *S = find_unit(stresses, word, length);
    if (L != NULL && out->name_of_length == NULL) {
        out->length = L->value;
        out->name_of_length = L->name;
    } else if (F != NULL && out->name_of_force == NULL) {
        out->force = F->value;
        out->name_of_force = F->name;
    } else if (S != NULL && *stress == 0) {
        *stress = S->value;
        snprintf(out->name_of_stress, sizeof out->name_of_stress, "%s", S->name);
    } else {
        document_mistake(
            m, n, 0,
            "units: '%.*s' is %s; give one of m, cm, mm, um, in, ft and one of N, mN, kN, MN, lbf, "
            "and for stress Pa, kPa, MPa, GPa or psi, such as mm, N, MPa",
            (int)length, word,
            L != NULL || F != NULL || S != NULL ? "the second unit of its kind" : "unknown");
        return 0;
    }
    return 1;
}

void units_read(const document_node *n, mistakes *m, unit_system *out)
{
    double stress = 0;
    int good = 1;
    *out = (unit_system){.length = 1, .force = 1};
    if (n == NULL)
        return;
    if (n->kind == DOCUMENT_MAP) {
        document_mistake(m, n, 0, "units: a string is expected, such as mm, N, MPa");
        return;
    }
    for (int i = 0; n->kind == DOCUMENT_LIST && good && i < n->count; i++) {
        const char *word = n->item[i]->kind == DOCUMENT_TEXT ? n->item[i]->text : "?";
        good = units_read_unit(n, word, strlen(word), out, &stress, m);
    }
    for (const char *at = n->text; n->kind == DOCUMENT_TEXT && good && *at != '\0';) {
        at += strspn(at, ", ");
        const size_t length = strcspn(at, ", ");
        good = length == 0 || units_read_unit(n, at, length, out, &stress, m);
        at += length;
    }
    if (!good)
        return;
    if (out->name_of_length == NULL || out->name_of_force == NULL) {
        document_mistake(m, n, 0,
                         "units: give a unit of length and one of force, such as mm, N, MPa");
        return;
    }
    const double own = out->force / (out->length * out->length);
    if (stress == 0)
        snprintf(out->name_of_stress, sizeof out->name_of_stress, "%s/%s^2", out->name_of_force,
                 out->name_of_length);
    else if (!(stress > own * (1 - 1e-9) && stress < own * (1 + 1e-9))) {
        document_mistake(m, n, 0,
                         "units: %s is not %s/%s^2, but the units of a scene must be consistent; "
                         "remove the stress, and give moduli in %s/%s^2",
                         out->name_of_stress, out->name_of_force, out->name_of_length,
                         out->name_of_force, out->name_of_length);
        return;
    }
    out->given = 1;
}

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

void units_translate(const unit_system *s, const char *unit, size_t size, char out[])
{
    static const char *const whole[][2] = {{"kg m/s", "N s"},
                                           {"kg m^2/s", "N m s"},
                                           {"J", "N m"},
                                           {"1/kg", "m/(N s^2)"},
                                           {"1/(kg s)", "m/(N s^3)"},
                                           {"1/(kg s^2)", "m/(N s^4)"},
                                           {"rad/(kg m)", "rad/(N s^2)"},
                                           {"rad/(kg m s)", "rad/(N s^3)"},
                                           {"rad/(kg m s^2)", "rad/(N s^4)"}};
    size_t used = 0;
    for (size_t i = 0; s->given && i < sizeof whole / sizeof whole[0]; i++)
        if (strcmp(unit, whole[i][0]) == 0)
            unit = whole[i][1];
    out[0] = '\0';
    while (*unit != '\0' && used + 1 < size) {
        const size_t word = strspn(unit, letters), length = word > 0 ? word : 1;
        const char *put = unit;
        size_t room = length;
        if (s->given && word == 1 && (*unit == 'm' || *unit == 'N')) {
            put = *unit == 'm' ? s->name_of_length : s->name_of_force;
            room = strlen(put);
        } else if (s->given && word == 2 && strncmp(unit, "Pa", 2) == 0) {
            put = s->name_of_stress;
            room = strlen(put);
        }
        room = room < size - 1 - used ? room : size - 1 - used;
        memcpy(out + used, put, room);
        used += room;
        out[used] = '\0';
        unit += length;
    }
}

void units_check_own(const document_node *unit, const unit_system *s, mistakes *m)
{
    const struct {
        const named_unit *list;
        const char *what, *name;
        double value;
    } kinds[] = {{lengths, "lengths", s->name_of_length, s->length},
                 {forces, "forces", s->name_of_force, s->force},
                 {stresses, "stresses", s->name_of_stress, s->force / (s->length * s->length)}};
    static const char *const never[] = {"deg", "degree", "ms", "kHz", "rpm"};
    for (const char *at = unit->text; *at != '\0';) {
        const size_t word = strspn(at, letters), length = word > 0 ? word : 1;
        for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
            const named_unit *known = find_unit(kinds[i].list, at, word);
            if (known != NULL && fabs(known->value - kinds[i].value) > 1e-9 * kinds[i].value)
                document_mistake(m, unit, 0,
                                 "unit '%.40s': the %s of this scene are in %s (key 'units'); use "
                                 "this unit, and convert the value",
                                 unit->text, kinds[i].what, kinds[i].name);
        }
        for (size_t i = 0; i < sizeof never / sizeof never[0]; i++)
            if (strlen(never[i]) == word && strncmp(never[i], at, word) == 0)
                document_mistake(m, unit, 0,
                                 "unit '%.40s': angles are in rad, times in s and frequencies in "
                                 "Hz or rad/s; use one of these units, and convert the value (45 "
                                 "deg: 45*deg)",
                                 unit->text);
        at += length;
    }
}
