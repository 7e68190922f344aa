#include "harness/schema/schema.h"

int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS])
{
    int count = 0;
    for (int p = 0; p < RECORD_PARTS && type->part[p] != NULL; p++)
        for (const schema_field *one = type->part[p]; one->name != NULL && count < SCHEMA_MOST_FIELDS; one++)
            if (one->key <= keys)
                out[count++] = one;
    return count;
}

void field_text(field_value *out, const char *text)
{
    out->text = text != NULL ? text : "";
}

void field_number(field_value *out, double number)
{
    out->number = number;
    out->numbers = &out->number;
}

static void read_member(const void *at, field_kind kind, field_value *out)
{
    switch (kind) {
    case FIELD_LONG:
        out->whole = *(const long *)at;
        break;
    case FIELD_DOUBLE:
        out->numbers = at;
        break;
    case FIELD_TEXT:
        out->text = at;
        break;
    case FIELD_INT:
    case FIELD_FLAG:
    case FIELD_ENUM:
    case FIELD_KINDS:
        out->whole = *(const int *)at;
    }
}

void field_read(const subject *s, const schema_field *which, field_value *out)
{
    out->of = which;
    if (which->get != NULL)
        which->get(s, out);
    else
        read_member((const char *)s->record + which->offset, which->kind, out);
    if (which->kind == FIELD_ENUM)
        out->text = out->whole >= 0 && out->whole < which->words ? which->word((int)out->whole) : "?";
}

const char *field_kind_name(field_kind kind)
{
    static const char *const name[FIELD_KINDS] = {"int", "long", "double", "flag", "text", "enum"};
    return kind < FIELD_KINDS ? name[kind] : "?";
}
