#include "harness/records/schema.h"

#include <math.h>

int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS])
{
    int count = 0;
    for (int p = 0; p < RECORD_PARTS && type->part[p] != NULL; p++)
        for (const schema_field *one = type->part[p];
             one->name != NULL && count < SCHEMA_MOST_FIELDS; one++)
            if (one->key <= keys)
                out[count++] = one;
    return count;
}

void schema_set_text(field_value *out, const char *text)
{
    out->text = text != NULL ? text : "";
}

void schema_set_number(field_value *out, double number)
{
    out->number = number;
    out->numbers = &out->number;
}

static const void *base_of(const subject *s, field_base base)
{
    switch (base) {
    case BASE_RECORD:
        return s->record;
    case BASE_SUBJECT:
        return s;
    case BASE_POINT:
        return s->point;
    case BASE_CASE:
        return s->point->type;
    case BASE_SERIES:
        return s->series;
    case BASE_FORMULATION:
        return s->series->formulation.type;
    case BASE_CELL:
        return &s->series->cell[s->mesh];
    case BASE_QUANTITY:
        return &s->point->scene.quantity[s->index];
    case BASE_TRUTH:
        return s->truth;
    case BASE_MODEL_TRUTH:
        return s->model_truth;
    }
    return NULL;
}

static void read_member(const char *at, const schema_field *which, field_value *out)
{
    if (which->kind == FIELD_DOUBLE)
        out->numbers = (const double *)at;
    else if (which->kind == FIELD_TEXT)
        schema_set_text(out, which->address ? *(const char *const *)at : at);
    else
        out->whole = which->kind == FIELD_LONG ? *(const long *)at : *(const int *)at;
}

static void no_value(field_value *out)
{
    out->whole = 0;
    schema_set_text(out, "");
    schema_set_number(out, NAN);
}

void schema_read(const subject *s, const schema_field *which, field_value *out)
{
    const char *base = which->get == NULL ? base_of(s, which->base) : NULL;
    out->of = which;
    if (which->get != NULL)
        which->get(s, out);
    else if (base != NULL)
        read_member(base + which->offset, which, out);
    else
        no_value(out);
    if (which->kind == FIELD_ENUM)
        out->text =
            out->whole >= 0 && out->whole < which->words ? which->word((int)out->whole) : "?";
}

const char *schema_kind_name(field_kind kind)
{
    static const char *const name[FIELD_KINDS] = {"int", "long", "double", "flag", "text", "enum"};
    return kind < FIELD_KINDS ? name[kind] : "?";
}
