/* What a formulation declares, at the options that it runs with. */
#include <stdio.h>
#include <string.h>

#include "elements/feature.h"
#include "harness/formulations/formulations.h"
#include "harness/records/fields_keys.h"

static const element_type *type_of(const subject *s)
{
    return s->series->formulation.type;
}

static void get_offers(const subject *s, field_value *out)
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;
    feature_words(type_of(s)->offers & ~theories, out->room, sizeof out->room);
    out->text = out->room;
}

static void get_limits(const subject *s, field_value *out)
{
    static const struct {
        unsigned bit;
        const char *words;
    } limit[] = {
        {LIMIT_DOUBLY_SYMMETRIC, "shear centre at the centroid, no coupled shear"},
        {LIMIT_ORDER_DEPENDENT, "exchanging the ends of an element changes the answer, by an error "
                                "that vanishes with more elements"},
        {LIMIT_QUARTER_TURN, "less than a quarter turn between the ends of an element"},
        {LIMIT_HALF_TURN, "less than half a turn between the ends of an element"},
        {LIMIT_TENSION, "no element that is too long for the axial force in it, which its "
                        "stiffness across it does not bear"},
        {LIMIT_EIGHTH_TWIST, "less than an eighth of a turn of twist in an element"},
        {LIMIT_WARPING_RIGID, "warping does not shear: no closed cells that warp"},
        {LIMIT_FLAT_ARC, "the arc of a curved element rises by less than 2 radii of gyration of "
                         "its section (of a leaf: 0.58 thicknesses)"},
    };
    size_t used = 0;
    out->room[0] = '\0';
    for (size_t i = 0; i < sizeof limit / sizeof limit[0]; i++)
        if (type_of(s)->limits & limit[i].bit)
            used += (size_t)snprintf(out->room + used, sizeof out->room - used, "%s%s",
                                     used > 0 ? "; " : "", limit[i].words);
    out->text = out->room;
}

static void get_lacks(const subject *s, field_value *out)
{
    out->room[0] = '\0';
    if (type_of(s)->lacks & LACKS_SHEAR_Y)
        snprintf(out->room, sizeof out->room, "shear flexibility along y (%s)",
                 type_of(s)->lacks_by);
    out->text = out->room;
}

static void get_theory(const subject *s, field_value *out)
{
    const unsigned theories = type_of(s)->shear_theories;
    const char *words = "none: rigid in shear";
    if (theories == (SHEAR_ENGESSER | SHEAR_HARINGX))
        words = "engesser or haringx";
    else if (theories == SHEAR_ENGESSER)
        words = "engesser";
    else if (theories == SHEAR_HARINGX)
        words = "haringx";
    else if (theories != 0)
        words = type_of(s)->own_theory;
    schema_set_text(out, words);
}

/* The offset counts: least and highest of each analysis. */
static void get_order(const subject *s, field_value *out)
{
    const size_t i = out->of->offset;
    const element_order order =
        element_order_in(type_of(s), (element_analysis)(i / 2), s->series->formulation.option);
    out->whole = i % 2 == 0 ? order.least : order.highest;
}

/* The offset: 0 least, 1 highest. */
static void get_motion(const subject *s, field_value *out)
{
    const element_order order = element_order_of_motion();
    (void)s;
    out->whole = out->of->offset == 0 ? order.least : order.highest;
}

static void get_nodes(const subject *s, field_value *out)
{
    out->whole = element_nodes(type_of(s), s->series->formulation.option);
}

static void get_strains(const subject *s, field_value *out)
{
    out->whole = element_strains(type_of(s), s->series->formulation.option);
}

static void get_inner(const subject *s, field_value *out)
{
    out->whole = element_inner(type_of(s), s->series->formulation.option);
}

static void get_options(const subject *s, field_value *out)
{
    const assignment_list list = formulation_options(type_of(s));
    const parameter_type *p;
    size_t used = 0;
    out->room[0] = '\0';
    for (int i = 0; (p = parameter_at(list.part, i)) != NULL && used < sizeof out->room; i++) {
        char value[ASSIGNMENT_VALUE], range[2 * ASSIGNMENT_VALUE];
        assignment_value_text(p, p->value, value, sizeof value);
        snprintf(range, sizeof range, "%g..%g", p->min, p->max);
        used += (size_t)snprintf(out->room + used, sizeof out->room - used, "%s%s\t%s\t%s\t%s",
                                 i > 0 ? "\n" : "", p->name,
                                 p->choices != NULL ? p->choices : range, value, p->summary);
    }
    out->text = out->room;
}

static void get_differences(const subject *s, field_value *out)
{
    schema_set_text(out, adapters_words(type_of(s)));
}

static void get_process(const subject *s, field_value *out)
{
    out->whole = process_serves(type_of(s));
}

static void get_is_new(const subject *s, field_value *out)
{
    out->whole = s->sweep != NULL ? s->series->imported == NULL && !sweep_gates(s->sweep, s->series)
                                  : formulations_is_new(type_of(s));
}

static const schema_field fields[] = {
    {"formulation", "", FIELD_TEXT, "name, options that differ from their defaults",
     OF(SERIES, series, formulation.key), .key = KEY},
    {"type", "", FIELD_TEXT, "name without options", TEXT_OF(FORMULATION, element_type, name)},
    {"summary", "", FIELD_TEXT, "what it is", TEXT_OF(FORMULATION, element_type, summary)},
    {"source", "", FIELD_TEXT, "where it is published", TEXT_OF(FORMULATION, element_type, source)},
    {"family", "", FIELD_TEXT, "those of one family share code or theory",
     TEXT_OF(FORMULATION, element_type, family)},
    {"offers", "", FIELD_TEXT, "physics that it has, between commas", .get = get_offers},
    {"limits", "", FIELD_TEXT, "what it is restricted to", .get = get_limits},
    {"lacks", "", FIELD_TEXT, "what it offers in one direction only", .get = get_lacks},
    {"differences", "", FIELD_TEXT, "what it leaves to differences: its times rank nothing",
     .get = get_differences},
    {"misprint", "", FIELD_TEXT,
     "what is misprinted in the equations that it keeps: it is not ranked",
     TEXT_OF(FORMULATION, element_type, misprint)},
    {"process", "", FIELD_FLAG, "computed by another process: its times rank nothing",
     .get = get_process},
    {"is_new", "", FIELD_FLAG, "not accepted yet: its verdicts do not affect the exit status",
     .get = get_is_new},
    {"shear_theory", "", FIELD_TEXT, "of shear in stability", .get = get_theory},
    {"statics_least", "1", FIELD_INT, "order of convergence in statics", .get = get_order},
    {"statics_highest", "1", FIELD_INT, "the same where leading terms vanish", .offset = 1,
     .get = get_order},
    {"vibration_least", "1", FIELD_INT, "order in vibration", .offset = 2, .get = get_order},
    {"vibration_highest", "1", FIELD_INT, "the same where leading terms vanish", .offset = 3,
     .get = get_order},
    {"motion_least", "1", FIELD_INT, "order in motions in time", .get = get_motion},
    {"motion_highest", "1", FIELD_INT, "the same where leading terms vanish", .offset = 1,
     .get = get_motion},
    {"buckling_least", "1", FIELD_INT, "order in linear buckling", .offset = 4, .get = get_order},
    {"buckling_highest", "1", FIELD_INT, "the same where leading terms vanish", .offset = 5,
     .get = get_order},
    {"nodes", "1", FIELD_INT, "of an element", .get = get_nodes},
    {"strains", "1", FIELD_INT, "generalized strains of an element", .get = get_strains},
    {"inner", "1", FIELD_INT, "unknowns inside an element", .get = get_inner},
    {"options", "", FIELD_TEXT, "a line each; between tabs name, choices, default and summary",
     .get = get_options},
    {0}};

const record_type record_declaration = {
    "declaration", "declarations", "what a formulation says of itself", {fields}};
