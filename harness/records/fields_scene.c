/* Records of what a case is made of: its scenes, parameters, what its quantities mean,
 * and what is assumed of its sections. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "cases/format/meaning.h"
#include "cases/scene/names.h"
#include "harness/formulations/formulations.h"
#include "harness/records/assumptions.h"
#include "harness/records/fields_keys.h"

static const schema_field fields_of_scene[] = {
    {"scene", "", FIELD_TEXT,
     "scene file that solves to the same bits, loops and expressions written out", .address = 1},
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
    {"parameter", "", FIELD_TEXT, "its name", .get = get_name},
    {"unit", "", FIELD_TEXT, "of its value; 1: a number", .get = get_unit},
    {"default", "", FIELD_TEXT, "the value where nothing else is said", .get = get_default},
    {"min", OWN_UNIT, FIELD_DOUBLE, "least value", .get = get_min},
    {"max", OWN_UNIT, FIELD_DOUBLE, "largest value", .get = get_max},
    {"choices", "", FIELD_TEXT, "words that it can be, with bars between", .get = get_choices},
    {"summary", "", FIELD_TEXT, "what it is, in one line", .get = get_summary},
    {0}};
const record_type record_parameter = {
    "parameter", "parameters", "what can be set of a case", {key_of_case, fields_of_parameter}};

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
     "not known: the numbers of the section do not say it; not modelled: no formulation has it",
     .get = get_kind, .word = assumptions_kind, .words = ASSUMPTION_KINDS},
    {"section", "", FIELD_TEXT, "name of the section", .get = get_section},
    {"physics", "", FIELD_TEXT, "of what, in words of 'omit'; empty: none of these",
     .get = get_physics},
    {"text", "", FIELD_TEXT, "what is assumed, in words", .get = get_assumption},
    {0}};
const record_type record_assumption = {"assumption",
                                       "assumptions",
                                       "what is assumed of a section of your scene",
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
    {"meaning", "", FIELD_TEXT, "what it is, in one line", .get = get_meaning},
    {"curve", "", FIELD_FLAG, "it has a value at every station of a path", .get = get_curve},
    {0}};
const record_type record_meaning = {"meaning",
                                    "meanings",
                                    "what a quantity of a point is",
                                    {keys_of_point, names_of_quantity, fields_of_meaning}};
