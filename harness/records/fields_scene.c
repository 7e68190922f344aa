#include "harness/records/records_impl.h"

#include <float.h>
#include <math.h>

#include "cases/format/format.h"
#include "cases/scene/scene.h"
#include "harness/model/model.h"

static const schema_field fields_of_scene[] = {
    {"scene", "", FIELD_TEXT,
     "scene file with loops and expressions expanded; its solution is the same, bit for bit",
     .address = 1},
    {0}};
const record_type record_scene = {
    "scene", "scenes", "a parameter point as a scene file", {keys_of_point, fields_of_scene}};

static const parameter_type *parameter(const subject *s)
{
    return parameter_at(s->point->type->parameters, s->index);
}

static void get_name(const subject *s, field_value *out)
{
    schema_set_text(out, parameter(s)->name);
}

static void get_unit(const subject *s, field_value *out)
{
    schema_set_text(out, parameter(s)->unit);
}

static void get_default(const subject *s, field_value *out)
{
    assignment_value_text(parameter(s), parameter(s)->value, out->room, ASSIGNMENT_VALUE);
    out->text = out->room;
}

static int bounded(const parameter_type *p)
{
    return p->choices == NULL && (p->min != -DBL_MAX || p->max != DBL_MAX);
}

static void get_min(const subject *s, field_value *out)
{
    schema_set_number(out, bounded(parameter(s)) ? parameter(s)->min : NAN);
}

static void get_max(const subject *s, field_value *out)
{
    schema_set_number(out, bounded(parameter(s)) ? parameter(s)->max : NAN);
}

static void get_choices(const subject *s, field_value *out)
{
    schema_set_text(out, parameter(s)->choices);
}

static void get_summary(const subject *s, field_value *out)
{
    schema_set_text(out, parameter(s)->summary);
}

static const schema_field key_of_case[] = {
    {"case", "", FIELD_TEXT, "name of the case", TEXT_OF(CASE, case_type, name), .key = KEY_AROUND},
    {0}};
static const schema_field fields_of_parameter[] = {
    {"parameter", "", FIELD_TEXT, "name of the parameter", .get = get_name},
    {"unit", "", FIELD_TEXT, "unit of the value; 1: dimensionless", .get = get_unit},
    {"default", "", FIELD_TEXT, "default value", .get = get_default},
    {"min", OWN_UNIT, FIELD_DOUBLE, "minimum", .get = get_min},
    {"max", OWN_UNIT, FIELD_DOUBLE, "maximum", .get = get_max},
    {"choices", "", FIELD_TEXT, "allowed words, separated by bars", .get = get_choices},
    {"summary", "", FIELD_TEXT, "description in one line", .get = get_summary},
    {0}};
const record_type record_parameter = {
    "parameter", "parameters", "parameters of a case", {key_of_case, fields_of_parameter}};

static void get_kind(const subject *s, field_value *out)
{
    assumption a = {.kind = ASSUMPTION_KINDS};
    assumptions_at(s->point, s->index, &a);
    out->whole = (long)a.kind;
}

static void get_section(const subject *s, field_value *out)
{
    assumption a;
    const int found = assumptions_at(s->point, s->index, &a);
    snprintf(out->room, sizeof out->room, "%s",
             found ? scene_name(&s->point->scene, SCENE_SECTIONS, a.section).text : "");
    out->text = out->room;
}

static void get_physics(const subject *s, field_value *out)
{
    assumption a = {.physics = ""};
    assumptions_at(s->point, s->index, &a);
    snprintf(out->room, sizeof out->room, "%s", a.physics);
    out->text = out->room;
}

static void get_assumption(const subject *s, field_value *out)
{
    assumption a = {.text = ""};
    assumptions_at(s->point, s->index, &a);
    snprintf(out->room, sizeof out->room, "%s", a.text);
    out->text = out->room;
}

static const schema_field fields_of_assumption[] = {
    {"kind", "", FIELD_ENUM,
     "not known: the constants of the section do not determine the physics; not modelled: no "
     "formulation supports the physics",
     .get = get_kind, .word = assumptions_kind, .words = ASSUMPTION_KINDS},
    {"section", "", FIELD_TEXT, "name of the section", .get = get_section},
    {"physics", "", FIELD_TEXT, "physics, as named by 'omit'; empty if 'omit' has no name for it",
     .get = get_physics},
    {"text", "", FIELD_TEXT, "assumption in words", .get = get_assumption},
    {0}};
const record_type record_assumption = {"assumption",
                                       "assumptions",
                                       "an assumption about a section of the scene",
                                       {keys_of_point, fields_of_assumption}};

static void get_meaning(const subject *s, field_value *out)
{
    meaning_of_quantity(&s->point->scene, s->index, out->room, sizeof out->room);
    out->text = out->room;
}

static void get_curve(const subject *s, field_value *out)
{
    out->whole = fields_keys_quantity(s)->reduction == SCENE_CURVE;
}

static const schema_field fields_of_meaning[] = {
    {"meaning", "", FIELD_TEXT, "description in one line", .get = get_meaning},
    {"curve", "", FIELD_FLAG, "1 if the quantity has a value at every station of a path",
     .get = get_curve},
    {0}};
const record_type record_meaning = {"meaning",
                                    "meanings",
                                    "description of a quantity of a point",
                                    {keys_of_point, names_of_quantity, fields_of_meaning}};

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

static void get_deviation(const subject *s, field_value *out)
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

/* Gives the number of elements for a level. The offset is the index of the level. */
static void get_reach(const subject *s, field_value *out)
{
    const int mesh = reach_mesh(s->sweep, s->verdict, reach_level[out->of->offset]);
    out->whole = mesh >= 0 ? s->series->mesh[mesh] : 0;
}

/* Add new fields of a verdict here, in one line each. */
static const schema_field fields_of_verdict[] = {
    {"verdict", "", FIELD_ENUM, "verdict", AT(verdict, kind), .word = word_of_verdict,
     .words = VERDICT_KINDS},
    {"expected", "", FIELD_ENUM, "expected verdict: pass, or as given by a known deviation",
     AT(verdict, expected), .word = word_of_verdict, .words = VERDICT_KINDS},
    {"as_expected", "", FIELD_FLAG, "1 if the verdict is as expected", AT(verdict, matches)},
    {"message", "", FIELD_TEXT, "description of the verdict", .get = get_message},
    {"reason", "", FIELD_TEXT, "reason for a missing value", AT(verdict, reason)},
    {"finding", "", FIELD_TEXT, "known deviation that explains the verdict", .get = get_deviation},
    {"cause", "", FIELD_TEXT, "cause of the known deviation", .get = get_cause},
    {"proof", "", FIELD_TEXT, "proof of the cause", .get = get_proof},
    {"value", OWN_UNIT, FIELD_DOUBLE, "value on the finest mesh", AT(verdict, finest)},
    {"limit", OWN_UNIT, FIELD_DOUBLE, "limit for infinitely many elements", AT(verdict, fit.limit)},
    {"limit_uncertainty", OWN_UNIT, FIELD_DOUBLE, "uncertainty of the limit",
     AT(verdict, fit.limit_uncertainty)},
    {"order", "1", FIELD_DOUBLE, "order of convergence", AT(verdict, fit.order)},
    {"order_uncertainty", "1", FIELD_DOUBLE, "uncertainty of the order",
     AT(verdict, fit.order_uncertainty)},
    {"limit_kind", "", FIELD_ENUM, "convergence over the meshes", AT(verdict, fit.kind),
     .word = word_of_limit, .words = LIMIT_KINDS},
    {"asymptotic_from", "1", FIELD_INT, "coarsest mesh used for the limit; 0: none",
     AT(verdict, fit.from)},
    {"noise", OWN_UNIT, FIELD_DOUBLE,
     "rounding scatter of the value on the finest mesh, as used for the verdict",
     AT(verdict, fit.noise)},
    {"noise_measured", "", FIELD_FLAG,
     "1 if the scatter was measured by an equivalent second run of the finest mesh",
     .get = get_noise_measured},
    {"truth", OWN_UNIT, FIELD_DOUBLE, "reference value for the same continuum model",
     OF(TRUTH, truth, value)},
    {"truth_uncertainty", OWN_UNIT, FIELD_DOUBLE, "uncertainty of the reference value",
     OF(TRUTH, truth, uncertainty)},
    {"truth_kind", "", FIELD_TEXT, "exact, independent, ...", TEXT_OF(TRUTH, truth, kind)},
    {"theory", "", FIELD_TEXT, "shear theory of the reference value in stability problems",
     TEXT_OF(TRUTH, truth, theory)},
    {"source", "", FIELD_TEXT, "source of the reference value", TEXT_OF(TRUTH, truth, source)},
    {"below_digits", "", FIELD_FLAG,
     "1 if the error is below the uncertainty of the reference value", AT(verdict, below_digits)},
    {"predicted", OWN_UNIT, FIELD_DOUBLE,
     "limit derived for the formulation from its published equations", .get = get_predicted},
    {"contradicted", OWN_UNIT, FIELD_DOUBLE,
     "published value that is outside the uncertainty of the limit", .get = get_contradicted},
    {"error", "1", FIELD_DOUBLE, "relative error of the limit", AT(verdict, error)},
    {"tolerance", OWN_UNIT, FIELD_DOUBLE, "tolerance of the limit, including the uncertainty",
     AT(verdict, tolerance)},
    {"model_truth", OWN_UNIT, FIELD_DOUBLE,
     "reference value for another model or theory; not used for verdicts",
     OF(MODEL_TRUTH, truth, value)},
    {"model_truth_kind", "", FIELD_TEXT, "exact, independent, ...",
     TEXT_OF(MODEL_TRUTH, truth, kind)},
    {"model_theory", "", FIELD_TEXT, "shear theory of model_truth in stability problems",
     TEXT_OF(MODEL_TRUTH, truth, theory)},
    {"model_error", "1", FIELD_DOUBLE, "relative difference of the limit from model_truth",
     AT(verdict, model_error)},
    {"omitted", "", FIELD_TEXT, "physics that the structure requires but the scene omits",
     .get = fields_keys_omitted},
    {"assumed", "", FIELD_TEXT, "assumptions about sections: see the table 'assumptions'",
     .get = fields_keys_assumed},
    {"reach_10", "1", FIELD_INT,
     "smallest number of elements at and above which every mesh is within 10 %; 0: none",
     .get = get_reach},
    {"reach_1", "1", FIELD_INT,
     "smallest number of elements at and above which every mesh is within 1 %; 0: none",
     .offset = 1, .get = get_reach},
    {"reach_0.1", "1", FIELD_INT,
     "smallest number of elements at and above which every mesh is within 0.1 %; 0: none",
     .offset = 2, .get = get_reach},
    {"reach_0.01", "1", FIELD_INT,
     "smallest number of elements at and above which every mesh is within 0.01 %; 0: none",
     .offset = 3, .get = get_reach},
    {0}};
const record_type record_verdict = {
    "verdict",
    "verdicts",
    "verdict on a quantity, from its values on all meshes",
    {keys_of_point, keys_of_series, names_of_quantity, fields_of_verdict}};

static const schema_field fields_of_agreement[] = {
    {"value", OWN_UNIT, FIELD_DOUBLE, "computed value", AT(agreement, value)},
    {"truth", OWN_UNIT, FIELD_DOUBLE, "value stored for this formulation and mesh",
     OF(TRUTH, truth, value)},
    {"source", "", FIELD_TEXT, "source of the reference value", TEXT_OF(TRUTH, truth, source)},
    {"agrees", "", FIELD_FLAG, "1 if the value is within the uncertainty of the reference value",
     AT(agreement, good)},
    {0}};
const record_type record_agreement = {
    "agreement",
    "agreements",
    "a value of one mesh, compared with the stored value of this mesh",
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
    {"formulation", "", FIELD_TEXT, "name without options", .get = get_formulation, .key = KEY},
    {"left_out", "1", FIELD_INT, "number of finest meshes that were not used",
     OF(SUBJECT, subject, index), .key = KEY},
    {"series", "1", FIELD_INT,
     "number of mesh series with an exact reference value and at least three meshes",
     .get = get_series},
    {"covered", "1", FIELD_INT,
     "number of mesh series whose limit agrees with the reference value within the uncertainty of "
     "the limit",
     .get = get_covered},
    {0}};
const record_type record_coverage = {
    "coverage",
    "coverages",
    "frequency with which limits agree with exact reference values within their uncertainty",
    {fields_of_coverage}};

const record_type *const record_types[] = {
    &record_point,  &record_series,    &record_cell,      &record_quantity,   &record_curve,
    &record_step,   &record_iteration, &record_event,     &record_motion,     &record_matrix,
    &record_timing, &record_verdict,   &record_agreement, &record_coverage,   &record_import,
    &record_scene,  &record_parameter, &record_meaning,   &record_assumption, NULL};
