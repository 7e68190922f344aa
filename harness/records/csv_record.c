#include "harness/records/csv_record.h"

#include <math.h>
#include <string.h>

enum { MOST_COLUMNS = 2 * SCHEMA_MOST_FIELDS };

typedef struct record_column {
    const schema_field *field;
    int part;
} record_column;

static void csv_field(FILE *to, const char *text)
{
    fputc('"', to);
    for (; *text != '\0'; text++) {
        if (*text == '"')
            fputc('"', to);
        fputc(*text, to);
    }
    fputc('"', to);
}

void csv_record_text(FILE *to, const char *text)
{
    if (text[strcspn(text, "\",\r\n")] == '\0')
        fputs(text, to);
    else
        csv_field(to, text);
}

static int known(const record_column out[], int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(out[i].field->name, name) == 0)
            return 1;
    return 0;
}

static int columns_of(int parts, const csv_part part[], record_column out[MOST_COLUMNS])
{
    int count = 0;
    for (int p = 0; p < parts; p++) {
        const schema_field *list[SCHEMA_MOST_FIELDS];
        const int fields = schema_fields(part[p].type, KEY_AROUND, list);
        for (int i = 0; i < fields && count < MOST_COLUMNS; i++)
            if (list[i]->count == 0 && !known(out, count, list[i]->name))
                out[count++] = (record_column){list[i], p};
    }
    return count;
}

static void write_value(FILE *to, const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_TEXT)
        csv_field(to, v->text);
    else if (which->kind == FIELD_ENUM)
        fputs(v->text, to);
    else if (which->kind != FIELD_DOUBLE)
        fprintf(to, "%ld", v->whole);
    else if (isfinite(*v->numbers))
        fprintf(to, "%.17g", *v->numbers);
}

void csv_record_head(FILE *to, int parts, const csv_part part[])
{
    record_column list[MOST_COLUMNS];
    const int count = columns_of(parts, part, list);
    for (int i = 0; i < count; i++)
        fprintf(to, "%s%s", i > 0 ? "," : "", list[i].field->name);
    fputc('\n', to);
}

void csv_record_line(FILE *to, int parts, const csv_part part[])
{
    record_column list[MOST_COLUMNS];
    const int count = columns_of(parts, part, list);
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(&part[list[i].part].s, list[i].field, &v);
        if (i > 0)
            fputc(',', to);
        write_value(to, list[i].field, &v);
    }
    fputc('\n', to);
}
