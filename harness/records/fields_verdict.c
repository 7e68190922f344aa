/* Records of the judge: verdicts and agreements with stored discrete values. */
#include <math.h>

#include "harness/model/model.h"
#include "harness/records/fields_keys.h"
#include "harness/study/study.h"

static const char *word_of_verdict(int kind)
{
    return verdict_name((verdict_kind)kind);
}

static void get_message(const subject *s, field_value *out)
{
    sentence_of_verdict(s->verdict, fields_keys_quantity(s)->least_order, out->room,
                        sizeof out->room);
    out->text = out->room;
}

static void get_finding(const subject *s, field_value *out)
{
    schema_set_text(out, s->verdict->rule != NULL ? s->verdict->rule->name : "");
}

static void get_cause(const subject *s, field_value *out)
{
    schema_set_text(out, s->verdict->rule != NULL ? s->verdict->rule->cause : "");
}

static void get_proof(const subject *s, field_value *out)
{
    schema_set_text(out, s->verdict->rule != NULL ? s->verdict->rule->proof : "");
}

static const char *word_of_limit(int kind)
{
    return limit_kind_name((limit_kind)kind);
}

static void get_predicted(const subject *s, field_value *out)
{
    schema_set_number(out, s->verdict->predicted != NULL ? s->verdict->predicted->value : NAN);
}

static void get_contradicted(const subject *s, field_value *out)
{
    schema_set_number(out,
                      s->verdict->contradicted != NULL ? s->verdict->contradicted->value : NAN);
}

static void get_noise_measured(const subject *s, field_value *out)
{
    out->whole = s->series->noise != NULL && isfinite(s->series->noise[s->index]);
}

/* The offset is the index of the level. */
static void get_reach(const subject *s, field_value *out)
{
    const int mesh = reach_mesh(s->sweep, s->verdict, reach_level[out->of->offset]);
    out->whole = mesh >= 0 ? s->series->mesh[mesh] : 0;
}

/* A new field of a verdict is one line here. */
static const schema_field fields_of_verdict[] = {
    {"verdict", "", FIELD_ENUM, "of the judge", AT(verdict, kind), .word = word_of_verdict,
     .words = VERDICT_KINDS},
    {"expected", "", FIELD_ENUM, "of it: pass, or what a finding says", AT(verdict, expected),
     .word = word_of_verdict, .words = VERDICT_KINDS},
    {"as_expected", "", FIELD_FLAG, "the exit status is 1 where it is not", AT(verdict, matches)},
    {"message", "", FIELD_TEXT, "the verdict in words", .get = get_message},
    {"reason", "", FIELD_TEXT, "why it was skipped, refused, has no value", AT(verdict, reason)},
    {"finding", "", FIELD_TEXT, "the known deviation that explains it", .get = get_finding},
    {"cause", "", FIELD_TEXT, "that the finding names", .get = get_cause},
    {"proof", "", FIELD_TEXT, "of the cause", .get = get_proof},
    {"value", OWN_UNIT, FIELD_DOUBLE, "on the finest mesh", AT(verdict, finest)},
    {"limit", OWN_UNIT, FIELD_DOUBLE, "for infinitely many elements", AT(verdict, fit.limit)},
    {"limit_uncertainty", OWN_UNIT, FIELD_DOUBLE, "of it", AT(verdict, fit.limit_uncertainty)},
    {"order", "1", FIELD_DOUBLE, "of convergence in the number of elements",
     AT(verdict, fit.order)},
    {"order_uncertainty", "1", FIELD_DOUBLE, "of it", AT(verdict, fit.order_uncertainty)},
    {"limit_kind", "", FIELD_ENUM, "what the meshes look like", AT(verdict, fit.kind),
     .word = word_of_limit, .words = LIMIT_KINDS},
    {"asymptotic_from", "1", FIELD_INT, "coarsest mesh that the limit rests on; 0: none",
     AT(verdict, fit.from)},
    {"noise", OWN_UNIT, FIELD_DOUBLE, "of the value on the finest mesh, as reckoned with",
     AT(verdict, fit.noise)},
    {"noise_measured", "", FIELD_FLAG, "the finest mesh was run again in other words",
     .get = get_noise_measured},
    {"truth", OWN_UNIT, FIELD_DOUBLE, "of the same continuum model", OF(TRUTH, truth, value)},
    {"truth_uncertainty", OWN_UNIT, FIELD_DOUBLE, "of it", OF(TRUTH, truth, uncertainty)},
    {"truth_kind", "", FIELD_TEXT, "exact, independent, ...", TEXT_OF(TRUTH, truth, kind)},
    {"theory", "", FIELD_TEXT, "of shear in stability that the truth follows",
     TEXT_OF(TRUTH, truth, theory)},
    {"source", "", FIELD_TEXT, "of the truth", TEXT_OF(TRUTH, truth, source)},
    {"below_digits", "", FIELD_FLAG, "the error is less than the truth is uncertain",
     AT(verdict, below_digits)},
    {"predicted", OWN_UNIT, FIELD_DOUBLE, "limit that was derived for the formulation",
     .get = get_predicted},
    {"contradicted", OWN_UNIT, FIELD_DOUBLE, "published value that the limit cannot be",
     .get = get_contradicted},
    {"error", "1", FIELD_DOUBLE, "of the limit against the truth", AT(verdict, error)},
    {"tolerance", OWN_UNIT, FIELD_DOUBLE, "of it, uncertainty included", AT(verdict, tolerance)},
    {"model_truth", OWN_UNIT, FIELD_DOUBLE, "of another model or theory: never judged by",
     OF(MODEL_TRUTH, truth, value)},
    {"model_truth_kind", "", FIELD_TEXT, "exact, independent, ...",
     TEXT_OF(MODEL_TRUTH, truth, kind)},
    {"model_theory", "", FIELD_TEXT, "of shear in stability that it follows",
     TEXT_OF(MODEL_TRUTH, truth, theory)},
    {"model_error", "1", FIELD_DOUBLE, "of the limit against it", AT(verdict, model_error)},
    {"omitted", "", FIELD_TEXT, "physics that the scene would call for and leaves out",
     .get = fields_keys_omitted},
    {"assumed", "", FIELD_TEXT, "of its sections: see the table 'assumptions'",
     .get = fields_keys_assumed},
    {"reach_10", "1", FIELD_INT, "elements from which on every mesh is within 10 %; 0: none",
     .get = get_reach},
    {"reach_1", "1", FIELD_INT, "the same, 1 %", .offset = 1, .get = get_reach},
    {"reach_0.1", "1", FIELD_INT, "the same, 0.1 %", .offset = 2, .get = get_reach},
    {"reach_0.01", "1", FIELD_INT, "the same, 0.01 %", .offset = 3, .get = get_reach},
    {0}};
const record_type record_verdict = {
    "verdict",
    "verdicts",
    "what the judge says of a quantity over the meshes",
    {keys_of_point, keys_of_series, names_of_quantity, fields_of_verdict}};

static const schema_field fields_of_agreement[] = {
    {"value", OWN_UNIT, FIELD_DOUBLE, "of the cell", AT(agreement, value)},
    {"truth", OWN_UNIT, FIELD_DOUBLE, "stored for this formulation and mesh",
     OF(TRUTH, truth, value)},
    {"source", "", FIELD_TEXT, "of the truth", TEXT_OF(TRUTH, truth, source)},
    {"agrees", "", FIELD_FLAG, "within the truth's uncertainty", AT(agreement, good)},
    {0}};
const record_type record_agreement = {
    "agreement",
    "agreements",
    "a value of one mesh against its own stored value",
    {keys_of_point, keys_of_series, key_of_mesh, names_of_quantity, fields_of_agreement}};

static void get_formulation(const subject *s, field_value *out)
{
    schema_set_text(out, ((const coverage *)s->record)->type->name);
}

static void get_series(const subject *s, field_value *out)
{
    out->whole = ((const coverage *)s->record)->series[s->index];
}

static void get_covered(const subject *s, field_value *out)
{
    out->whole = ((const coverage *)s->record)->covered[s->index];
}

static const schema_field fields_of_coverage[] = {
    {"case", "", FIELD_TEXT, "name of the case", TEXT_OF(CASE, case_type, name), .key = KEY_AROUND},
    {"formulation", "", FIELD_TEXT, "name, whatever its options", .get = get_formulation,
     .key = KEY},
    {"left_out", "1", FIELD_INT, "finest meshes that were not used", OF(SUBJECT, subject, index),
     .key = KEY},
    {"series", "1", FIELD_INT, "with an exact truth and three meshes", .get = get_series},
    {"covered", "1", FIELD_INT, "of them, whose limit is within its uncertainty of the truth",
     .get = get_covered},
    {0}};
const record_type record_coverage = {
    "coverage",
    "coverages",
    "how often limits lie within their uncertainty of exact truths",
    {fields_of_coverage}};
