/* Quantities of a scene. */
#include <stdio.h>
#include <string.h>

#include "harness/language/units.h"
#include "harness/scene_file/builder.h"

enum { MOST_ORDER = 100000 };

static int order_of(const fields *f)
{
    return fields_whole(f, "which", 0, 0, MOST_ORDER);
}

static scene_extract displacement(const fields *f)
{
    return scene_coordinate(fields_entry(f, "node", LIST_NODES),
                            fields_word(f, "component", fields_components, 0));
}

/* Component of a reaction; turn_1: the moment about the first axis of a sequence, which is fixed in
 * space. */
static int reaction_component(const fields *f, int node)
{
    enum { TURN_1 = SCENE_RZ + 1 };
    const int component = fields_word(f, "component", "ux|uy|uz|rx|ry|rz|turn_1", 0);
    if (component != TURN_1 || node < 0 || node >= f->b->scene->nodes)
        return component < TURN_1 ? component : SCENE_RX;
    const scene_node *n = &f->b->scene->node[node];
    if (n->rotation == SCENE_ROTATION_SEQUENCE)
        for (int i = 0; i < 3; i++)
            if (n->axis[0][i] != 0 && n->axis[0][(i + 1) % 3] == 0 &&
                n->axis[0][(i + 2) % 3] == 0 && n->axis[0][i] > 0)
                return SCENE_RX + i;
    document_mistake(f->b->mistakes, document_find(f->map, "component"), 0,
                     "turn_1 is of a node with a sequence whose first axis is x, y or z; take rx, "
                     "ry or rz");
    return SCENE_RX;
}

static scene_extract reaction(const fields *f)
{
    const int node = fields_entry(f, "node", LIST_NODES);
    return scene_reaction(node, reaction_component(f, node));
}

static scene_extract compliance(const fields *f)
{
    return scene_compliance_entry(fields_word(f, "row", fields_components, 0),
                                  fields_word(f, "column", fields_components, 0));
}

static scene_extract stiffness(const fields *f)
{
    return scene_stiffness_entry(fields_word(f, "component", fields_components, 0));
}

static scene_extract critical_factor(const fields *f)
{
    return scene_critical_factor(fields_word(f, "sign", "positive|negative", 0) == 0 ? 1 : -1,
                                 order_of(f));
}

static scene_extract frequency(const fields *f)
{
    static const char families[] = "any|not_axial|axial|bending_y|bending_z|torsion";
    const int order = order_of(f);
    const scene_family family = (scene_family)fields_word(f, "family", families, 0);
    return scene_frequency_of(order, family, fields_whole(f, "half_waves", 0, 0, MOST_ORDER));
}

static scene_extract growth(const fields *f)
{
    (void)f;
    return scene_growth();
}

static scene_extract factor_at(const fields *f)
{
    (void)f;
    return scene_factor_at();
}

static scene_extract critical_point(const fields *f)
{
    return scene_critical_point((scene_critical)fields_word(f, "kind", "limit|bifurcation", 0),
                                order_of(f),
                                (scene_ordinate)fields_word(f, "value", "factor|coordinate", 0));
}

static scene_extract motion(const fields *f)
{
    return scene_driver_value(fields_entry(f, "motion", LIST_MOTIONS));
}

/* Of a member's length. */
static double place_of(const fields *f)
{
    const double place = fields_number(f, "where", 0);
    if (place >= 0 && place <= 1)
        return place;
    document_mistake(f->b->mistakes, document_find(f->map, "where"), 0,
                     "where = %g; give a part of the member's length, from 0 to 1", place);
    return 0;
}

static scene_extract internal(const fields *f)
{
    const int member = fields_entry(f, "member", LIST_MEMBERS);
    const scene_resultant what =
        (scene_resultant)fields_word(f, "resultant", SCENE_RESULTANT_CHOICES, 0);
    if (fields_have(f, "along"))
        return scene_internal_along(
            member, (scene_along)(SCENE_ALONG_MAX + fields_word(f, "along", "max|min|largest", 0)),
            what);
    return scene_internal_at(
        member, fields_have(f, "where") ? place_of(f) : fields_word(f, "end", "from|to", 0), what);
}

/* Given constants have no points. */
static void check_points(const fields *f, int member)
{
    const scene *s = f->b->scene;
    if (member < 0 || member >= s->members || s->member[member].section < 0 ||
        s->member[member].section >= s->sections ||
        (s->section[s->member[member].section].kind != SECTION_CONSTANTS &&
         s->section[s->member[member].section].kind != SECTION_MATRICES))
        return;
    document_mistake(f->b->mistakes, document_find(f->map, "member"), 0,
                     "its section is given by numbers and has no points; describe it by sizes "
                     "or walls, or ask for 'internal'");
}

static scene_extract stress(const fields *f)
{
    const int member = fields_entry(f, "member", LIST_MEMBERS);
    const scene_stress_measure what =
        (scene_stress_measure)fields_word(f, "measure", SCENE_STRESS_CHOICES, 0);
    check_points(f, member);
    return fields_have(f, "where") ? scene_stress_at(member, place_of(f), what)
                                   : scene_stress_along(member, what);
}

static int axis_word(const fields *f, const char *key)
{
    return fields_word(f, key, "x|y|z", 0);
}

static scene_extract rate(const fields *f)
{
    return scene_rate(fields_entry(f, "node", LIST_NODES),
                      fields_word(f, "component", fields_components, 0));
}

static scene_extract orientation(const fields *f)
{
    return scene_orientation_entry(fields_entry(f, "node", LIST_NODES), axis_word(f, "row"),
                                   axis_word(f, "column"));
}

static scene_extract relative(const fields *f)
{
    return scene_relative_to(fields_entry(f, "node", LIST_NODES),
                             fields_word(f, "component", fields_components, 0),
                             fields_entry(f, "from", LIST_NODES));
}

static scene_extract energy(const fields *f)
{
    return scene_balance_of(
        (scene_balance)fields_word(f, "of", "kinetic|strain|energy|work|dissipated|drift", 0));
}

static scene_extract momentum(const fields *f)
{
    return scene_balance_of(
        (scene_balance)(SCENE_PX + fields_word(f, "component", "px|py|pz|lx|ly|lz", 0)));
}

static const struct {
    const char *key;
    scene_extract (*read)(const fields *);
} kinds[] = {{"displacement", displacement},
             {"reaction", reaction},
             {"compliance", compliance},
             {"stiffness", stiffness},
             {"critical_factor", critical_factor},
             {"frequency", frequency},
             {"growth", growth},
             {"factor_at", factor_at},
             {"critical_point", critical_point},
             {"motion", motion},
             {"internal", internal},
             {"stress", stress},
             {"rate", rate},
             {"orientation", orientation},
             {"relative", relative},
             {"energy", energy},
             {"momentum", momentum}};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

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
    /* a factor may make any unit of it */
    if (unit != NULL && !fields_have(f, "factor"))
        units_check(unit, f->b->mistakes);
    if (unit != NULL && strlen(unit->text) >= sizeof q->unit)
        document_mistake(f->b->mistakes, unit, 0, "a unit of more than %zu characters; shorten it",
                         sizeof q->unit - 1);
    snprintf(q->unit, sizeof q->unit, "%s", unit != NULL ? unit->text : usual_unit(f->b->scene, q));
}

static void read_abscissa(const fields *f, scene_quantity *q)
{
    const fields x = fields_below(f, "x");
    scene_set_curve(q, fields_text(&x, "name", "path"), fields_text(&x, "unit", "1"),
                    fields_number(&x, "factor", 1), fields_number(&x, "offset", 0));
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
        .order = fields_whole(&f, "which", 0, 0, MOST_ORDER),
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
    for (int i = 0; i < b->list[LIST_ANALYSES].count; i++) {
        const fields entry = fields_of(b, &b->list[LIST_ANALYSES].entry[i]);
        const fields f = fields_below(&entry, fields_have(&entry, "modal") ? "modal" : "buckling");
        const int asked = asked_of(b->scene, i);
        if (fields_have(&f, "wanted") && fields_whole(&f, "wanted", 0, 1, MOST_ORDER) < asked)
            document_mistake(b->mistakes, document_find(f.map, "wanted"), 0,
                             "quantities ask for %d of this analysis; write %d, or leave it out",
                             asked, asked);
    }
}

void builder_quantities(builder *b)
{
    for (int i = 0; i < b->list[LIST_QUANTITIES].count; i++) {
        const unrolled *entry = &b->list[LIST_QUANTITIES].entry[i];
        const fields f = fields_of(b, entry);
        int k = 0;
        while (k < KINDS - 1 && !fields_have(&f, kinds[k].key))
            k++;
        const fields what = fields_below(&f, kinds[k].key);
        const int analysis = fields_entry(&what, "analysis", LIST_ANALYSES);
        const scene_extract extract = kinds[k].read(&what);
        if (analysis >= 0 && analysis < b->scene->analyses &&
            !scene_gives(b->scene->analysis[analysis].kind, extract.kind))
            builder_no_quantity(&what, b->list[LIST_ANALYSES].entry[analysis].name, kinds[k].key,
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
    check_wanted(b);
}
