#include "harness/records/fields_keys.h"

#include <stdio.h>

#include "cases/scene/omission.h"
#include "harness/model/model.h"
#include "harness/records/assumptions.h"

static void get_elements(const subject *s, field_value *out)
{
    out->whole = s->series->mesh[s->mesh];
}

const schema_field keys_of_point[] = {
    {"case", "", FIELD_TEXT, "name of the case", TEXT_OF(CASE, case_type, name), .key = KEY_AROUND},
    {"point", "", FIELD_TEXT, "default, or the first digits of the parameters' hash",
     OF(POINT, sweep_point, name), .key = KEY},
    {0}};

const schema_field keys_of_series[] = {
    {"parameters", "", FIELD_TEXT, "where they differ from the defaults",
     OF(POINT, sweep_point, text), .key = KEY_AROUND},
    {"formulation", "", FIELD_TEXT, "name, options that differ from their defaults",
     OF(SERIES, series, formulation.key), .key = KEY},
    {0}};

const schema_field key_of_mesh[] = {
    {"elements", "1", FIELD_INT, "elements of each member", .get = get_elements, .key = KEY}, {0}};

const schema_field names_of_quantity[] = {
    {"quantity", "", FIELD_TEXT, "name of the quantity", OF(QUANTITY, scene_quantity, name)},
    {"unit", "", FIELD_TEXT, "of its value", OF(QUANTITY, scene_quantity, unit)},
    {0}};

const char *fields_keys_word_of_status(int value)
{
    return status_name((status)value);
}

const char *fields_keys_word_of_moments(int convention)
{
    return scene_moments_name((scene_moments)convention);
}

const scene_quantity *fields_keys_quantity(const subject *s)
{
    return &s->point->scene.quantity[s->index];
}

const cell_result *fields_keys_cell(const subject *s)
{
    return &s->series->cell[s->mesh];
}

void fields_keys_omitted(const subject *s, field_value *out)
{
    char words[SCENE_OMISSION_WORDS] = "";
    if (s->point->status == STATUS_OK)
        scene_omission_words(features_omitted(&s->point->scene), words);
    snprintf(out->room, sizeof out->room, "%s", words);
    out->text = out->room;
}

void fields_keys_assumed(const subject *s, field_value *out)
{
    assumptions_words(s->point, sizeof out->room, out->room);
    out->text = out->room;
}

static const schema_field field_omitted[] = {
    {"omitted", "", FIELD_TEXT, "physics that the scene would call for and leaves out",
     .get = fields_keys_omitted},
    {"assumed", "", FIELD_TEXT, "of its sections: see the table 'assumptions'",
     .get = fields_keys_assumed},
    {0}};
const record_type record_omission = {
    "omission",
    "",
    "what the scene of a value leaves out, and what is assumed of it",
    {field_omitted}};
