#include "cases/format/schema_file.h"

#include <jansson.h>
#include <string.h>

#include "cases/format/keys.h"

static json_t *map_of(const entry_field *table, const entry_field *loop);

/* An expression is a text or a number; a word may also be the name of a parameter. */
static json_t *scalar(void)
{
    return json_pack("{s:[s, s]}", "type", "number", "string");
}

/* "a|b|c" -> examples: what an editor offers. */
static json_t *words_of(const char *words)
{
    json_t *list = json_array();
    for (const char *at = words; at != NULL;) {
        const size_t length = strcspn(at, "|");
        json_array_append_new(list, json_stringn(at, length));
        at = at[length] == '|' ? at + length + 1 : NULL;
    }
    return list;
}

static json_t *word(const entry_field *k)
{
    return json_pack("{s:s, s:o}", "type", "string", "examples", words_of(k->words));
}

static json_t *value_of(const entry_field *k)
{
    switch (k->kind) {
    case ENTRY_TEXT:
    case ENTRY_NAME:
    case ENTRY_NUMBER:
    case ENTRY_WHOLE:
        return scalar();
    case ENTRY_WORD:
    case ENTRY_FLAG:
        return word(k);
    case ENTRY_WORDS:
        return json_pack("{s:[o, {s:s, s:o}]}", "anyOf", word(k), "type", "array", "items",
                         word(k));
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        return json_pack("{s:s, s:i, s:i, s:o}", "type", "array", "minItems", k->count, "maxItems",
                         k->count, "items", scalar());
    case ENTRY_NUMBERS:
        return json_pack("{s:[{s:s}, {s:s, s:o}]}", "anyOf", "type", "string", "type", "array",
                         "items", scalar());
    case ENTRY_MAP:
        return map_of(entry_below(k), NULL);
    case ENTRY_ENTRIES:
        return json_pack("{s:s, s:o}", "type", "object", "additionalProperties",
                         map_of(k->below, keys_loops(k->below) ? keys_loop : NULL));
    case ENTRY_LIST:
        return json_pack("{s:s, s:o}", "type", "array", "items",
                         map_of(k->below, keys_loops(k->below) ? keys_loop : NULL));
    case ENTRY_NAMES:
        return json_pack("{s:s, s:o}", "type", "object", "additionalProperties",
                         k->below->name != NULL ? value_of(k->below) : scalar());
    case ENTRY_FORMS:
    case ENTRY_LATER:
        break;
    }
    return json_object();
}

/* A number, a list of them, or a word. */
static json_t *usual_of(const entry_field *k)
{
    json_t *value = json_loads(k->usual, JSON_DECODE_ANY, NULL);
    return value != NULL ? value : json_string(k->usual);
}

static void add_keys(json_t *properties, json_t *required, const entry_field *table)
{
    for (; table != NULL && table->name != NULL; table++) {
        if (table->kind == ENTRY_LATER)
            continue;
        json_t *value = value_of(table);
        char text[500];
        const char *without = table->usual != NULL ? table->usual : table->left_out;
        snprintf(text, sizeof text, "%s%s%s%s%s%s", entry_summary(table),
                 table->unit != NULL ? " [" : "", table->unit != NULL ? table->unit : "",
                 table->unit != NULL ? "]" : "", without != NULL ? "; default: " : "",
                 without != NULL ? without : "");
        json_object_set_new(value, "description", json_string(text));
        if (table->usual != NULL)
            json_object_set_new(value, "default", usual_of(table));
        json_object_set_new(properties, table->name, value);
        if (table->needed && table->group == 0)
            json_array_append_new(required, json_string(table->name));
    }
}

static json_t *map_of(const entry_field *table, const entry_field *loop)
{
    json_t *properties = json_object(), *required = json_array();
    add_keys(properties, required, table);
    add_keys(properties, required, loop);
    return json_pack("{s:s, s:o, s:o, s:b}", "type", "object", "properties", properties, "required",
                     required, "additionalProperties", 0);
}

status schema_file_write(FILE *to, fault *f)
{
    json_t *root = map_of(keys_root, NULL);
    json_object_set_new(root, "$schema", json_string("http://json-schema.org/draft-07/schema#"));
    json_object_set_new(root, "title", json_string("beamwork scene file, version 1"));
    const int written = root != NULL && json_dumpf(root, to, JSON_INDENT(1)) == 0;
    json_decref(root);
    if (!written)
        return fault_set(f, STATUS_FAULT, "the schema cannot be written");
    fputc('\n', to);
    return STATUS_OK;
}
