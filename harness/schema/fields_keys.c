#include "harness/schema/fields_keys.h"

static void get_case(const subject *s, field_value *out)
{
    field_text(out, s->point->type->name);
}

static void get_point(const subject *s, field_value *out)
{
    field_text(out, s->point->name);
}

static void get_parameters(const subject *s, field_value *out)
{
    field_text(out, s->point->text);
}

static void get_formulation(const subject *s, field_value *out)
{
    field_text(out, s->series->formulation.key);
}

static void get_elements(const subject *s, field_value *out)
{
    out->whole = s->series->mesh[s->mesh];
}

static void get_quantity(const subject *s, field_value *out)
{
    field_text(out, subject_quantity(s)->name);
}

static void get_unit(const subject *s, field_value *out)
{
    field_text(out, subject_quantity(s)->unit);
}

const schema_field keys_of_point[] = {
    {"case", "", FIELD_TEXT, "name of the case", .get = get_case, .key = KEY_AROUND},
    {"point", "", FIELD_TEXT, "default, or the first digits of the parameters' hash", .get = get_point, .key = KEY},
    {0}};

const schema_field keys_of_series[] = {
    {"parameters", "", FIELD_TEXT, "where they differ from the defaults", .get = get_parameters, .key = KEY_AROUND},
    {"formulation", "", FIELD_TEXT, "name, options that differ from their defaults", .get = get_formulation, .key = KEY},
    {0}};

const schema_field key_of_mesh[] = {{"elements", "1", FIELD_INT, "elements of each member", .get = get_elements, .key = KEY}, {0}};

const schema_field names_of_quantity[] = {{"quantity", "", FIELD_TEXT, "name of the quantity", .get = get_quantity},
                                          {"unit", "", FIELD_TEXT, "of its value", .get = get_unit},
                                          {0}};

const char *word_of_status(int value)
{
    return status_name((status)value);
}

const char *word_of_moments(int convention)
{
    return scene_moments_name((scene_moments)convention);
}

const scene_quantity *subject_quantity(const subject *s)
{
    return &s->point->scene.quantity[s->index];
}

const cell_result *subject_cell(const subject *s)
{
    return &s->series->cell[s->mesh];
}
