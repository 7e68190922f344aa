#include "harness/experiments/certificate_record.h"

#include "harness/experiments/certificate_text.h"
#include "harness/formulations/formulations.h"

/* Records are part of a certificate; the index counts its parts. */
static const certificate *certificate_of(const subject *s)
{
    return s->owner;
}

static void get_formulation(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.key);
}

static void get_family(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_part_name(s->index));
}

static void get_what(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_part_words(s->index));
}

static void get_summary(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.type->summary);
}

static void get_source(const subject *s, field_value *out)
{
    schema_set_text(out, certificate_of(s)->chosen.type->source);
}

static void get_leaves(const subject *s, field_value *out)
{
    schema_set_text(out, adapters_words(certificate_of(s)->chosen.type));
}

static void get_kept(const subject *s, field_value *out)
{
    out->whole = certificate_holds(certificate_of(s));
}

static void get_compared(const subject *s, field_value *out)
{
    out->whole = certificate_compared(certificate_of(s));
}

static const schema_field key_of_formulation[] = {{"formulation", "", FIELD_TEXT,
                                                   "name, options that differ from their defaults",
                                                   .get = get_formulation, .key = KEY},
                                                  {0}};
static const schema_field key_of_family[] = {
    {"family", "", FIELD_TEXT, "of checks, or of what is measured", .get = get_family, .key = KEY},
    {0}};
static const schema_field fields_of_certificate[] = {
    {"summary", "", FIELD_TEXT, "of the formulation", .get = get_summary},
    {"source", "", FIELD_TEXT, "of the formulation", .get = get_source},
    {"leaves", "", FIELD_TEXT, "what it leaves to the adapters", .get = get_leaves},
    {"kept", "", FIELD_FLAG, "no claim is broken", .get = get_kept},
    {"compared", "1", FIELD_INT, "numbers, and questions of yes and no", .get = get_compared},
    {0}};
static const record_type record_certificate = {"certificate",
                                               "formulations",
                                               "how a formulation stands to the interface",
                                               {key_of_formulation, fields_of_certificate}};

static const schema_field fields_of_part[] = {
    {"what", "", FIELD_TEXT, "what holds, in a line", .get = get_what}, {0}};
static const record_type record_part = {
    "part", "parts", "a family of checks, or of what is measured", {key_of_family, fields_of_part}};

static const char *word_of_claim(int outcome)
{
    static const char *const word[CLAIM_OUTCOMES] = {"holds", "broken", "not claimed"};
    return word[outcome];
}

static const schema_field fields_of_claim[] = {
    {"claim", "", FIELD_TEXT, "name of it", AT(claim, name), .key = KEY},
    {"outcome", "", FIELD_ENUM, "of it", AT(claim, outcome), .word = word_of_claim,
     .words = CLAIM_OUTCOMES},
    {"compared", "1", FIELD_INT, "numbers, or questions of yes and no", AT(claim, compared)},
    {"worst", "1", FIELD_DOUBLE, "largest departure; infinite: a question's no", AT(claim, worst)},
    {"allowed", "1", FIELD_DOUBLE, "departure", AT(claim, allowed)},
    {"sentence", "", FIELD_TEXT, "of the worst departure that is not allowed", AT(claim, sentence)},
    {0}};
static const record_type record_claim = {
    "claim",
    "claims",
    "a claim of the interface, and how far a formulation departs from it",
    {key_of_formulation, key_of_family, fields_of_claim}};

static const schema_field key_of_measure[] = {
    {"name", "", FIELD_TEXT, "of what is measured", AT(element_measure, name), .key = KEY}, {0}};
static const schema_field fields_of_measure[] = {
    {"order", "1", FIELD_DOUBLE, "of the errors", AT(element_measure, order)},
    {"least", "1", FIELD_INT, "order that the formulation declares; 0: not asked for",
     AT(element_measure, least)},
    {"highest", "1", FIELD_INT, "order that it declares", AT(element_measure, highest)},
    {"locks", "", FIELD_FLAG, "the errors grow where it becomes thin", AT(element_measure, locks)},
    {"wrong_limit", "", FIELD_FLAG,
     "the error of a linear state is that of one element with every "
     "mesh",
     AT(element_measure, astray)},
    {"words", "", FIELD_TEXT, "why there is nothing, or what it comes to",
     AT(element_measure, words)},
    {0}};
static const record_type record_measure = {
    "measure",
    "measured",
    "errors over meshes or thicknesses",
    {key_of_formulation, key_of_family, key_of_measure, fields_of_measure}};

/* Of a measure: the group counts its points. */
static void get_at(const subject *s, field_value *out)
{
    out->numbers = &((const element_measure *)s->record)->at[s->group];
}

static void get_error(const subject *s, field_value *out)
{
    out->numbers = &((const element_measure *)s->record)->error[s->group];
}

static const schema_field fields_of_point[] = {
    {"at", "1", FIELD_DOUBLE, "number of elements, or thickness by length", .get = get_at},
    {"error", "1", FIELD_DOUBLE, "relative to the exact value", .get = get_error},
    {0}};
static const record_type record_measured_point = {
    "measured_point",
    "measured_points",
    "an error of what is measured",
    {key_of_formulation, key_of_family, key_of_measure, fields_of_point}};

static void gather_points(const element_measure *m, subject one, subjects *out)
{
    one.record = m;
    for (one.group = 0; one.group < m->points; one.group++)
        gather_add(out, &one);
}

static void gather_part(const certificate_part *part, const record_type *type, subject one,
                        subjects *out)
{
    for (int i = 0; type == &record_claim && i < part->claims.count; i++) {
        one.record = &part->claims.claim[i];
        gather_add(out, &one);
    }
    for (int i = 0; type == &record_measure && i < part->measures.count; i++) {
        one.record = &part->measures.measure[i];
        gather_add(out, &one);
    }
    for (int i = 0; type == &record_measured_point && i < part->measures.count; i++)
        gather_points(&part->measures.measure[i], one, out);
}

static void gather_element_test(const void *found, const record_type *type, subjects *out)
{
    const certificates *c = found;
    for (int k = 0; type == &record_part && k < CERTIFICATE_PARTS; k++)
        gather_add(out, &(subject){.index = k});
    for (int i = 0; i < c->count; i++) {
        const subject one = {.owner = &c->all[i]};
        if (type == &record_certificate)
            gather_add(out, &one);
        for (int k = 0; k < CERTIFICATE_PARTS; k++)
            gather_part(&c->all[i].part[k], type, (subject){.owner = one.owner, .index = k}, out);
    }
}

static const record_type *const records_of_element_test[] = {
    &record_certificate, &record_part,           &record_claim,
    &record_measure,     &record_measured_point, NULL};
static void print_element_test(FILE *to, const void *found)
{
    const certificates *c = found;
    certificate_text(to, screen_of(to), c->all, c->count, c->verbose, c->quiet);
}

static status run(const void *asked, void *found, fault *f)
{
    const certificate_request *r = asked;
    certificates *c = found;
    c->count = r->count;
    return certificate_find(r, &c->all, f);
}

const experiment_type experiment_element_test = {.name = "element-test",
                                                 .run = run,
                                                 .records = records_of_element_test,
                                                 .gather = gather_element_test,
                                                 .print = print_element_test};
