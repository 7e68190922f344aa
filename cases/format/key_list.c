#include "cases/format/format_impl.h"

#include <jansson.h>
#include <string.h>

enum { DESCRIPTION = 1000 };

static const char *form_of(const entry_field *k, char text[32])
{
    switch (k->kind) {
    case ENTRY_TEXT:
        return "TEXT";
    case ENTRY_NAME:
        return "NAME";
    case ENTRY_WORD:
    case ENTRY_FLAG:
        return "WORD";
    case ENTRY_WORDS:
        return k->words != NULL ? "[WORD, ...]" : "[NAME, ...]";
    case ENTRY_NUMBER:
    case ENTRY_WHOLE:
        return "EXPR";
    case ENTRY_VECTOR:
    case ENTRY_DIRECTION:
    case ENTRY_POSITION:
        snprintf(text, 32, "[EXPR x%d]", k->count);
        return text;
    case ENTRY_NUMBERS:
        return "[EXPR, ...]";
    case ENTRY_MAP:
        return "{...}";
    case ENTRY_ENTRIES:
        return "NAME: {...}";
    case ENTRY_LIST:
        return "- {...}";
    case ENTRY_NAMES:
        return "NAME: VALUE";
    case ENTRY_FORMS:
    case ENTRY_LATER:
        break;
    }
    return "...";
}

/* Describes a key, for example "summary [unit] (word, word); default: 0" or "... *". */
static void describe(const entry_field *k, char text[DESCRIPTION])
{
    int used =
        snprintf(text, DESCRIPTION, "%s%s%s%s", entry_summary(k), k->unit != NULL ? " [" : "",
                 k->unit != NULL ? k->unit : "", k->unit != NULL ? "]" : "");
    const char *joint = " (";
    for (const char *at = k->words; at != NULL && used < DESCRIPTION; joint = ", ") {
        const size_t length = strcspn(at, "|");
        used +=
            snprintf(text + used, (size_t)(DESCRIPTION - used), "%s%.*s", joint, (int)length, at);
        at = at[length] != '\0' ? at + length + 1 : NULL;
    }
    const char *without = k->usual != NULL ? k->usual : k->left_out;
    if (used < DESCRIPTION)
        snprintf(text + used, (size_t)(DESCRIPTION - used), "%s%s%s%s", k->words != NULL ? ")" : "",
                 without != NULL ? "; default: " : "", without != NULL ? without : "",
                 !k->needed     ? ""
                 : k->group > 0 ? "; one of these *"
                                : " *");
}

static void walk(const entry_field *table, int depth, key_list_take *take, void *context)
{
    for (; table != NULL && table->name != NULL; table++) {
        char form[32], text[DESCRIPTION];
        if (table->kind == ENTRY_LATER)
            continue;
        describe(table, text);
        take(context, depth, keys_any(table) != NULL ? "NAME" : table->name, form_of(table, form),
             text);
        if (table->kind == ENTRY_MAP || table->kind == ENTRY_ENTRIES || table->kind == ENTRY_LIST)
            walk(entry_below(table), depth + 1, take, context);
    }
}

void key_list_loops(key_list_take *take, void *context)
{
    walk(keys_loop, 0, take, context);
}

void key_list_all(key_list_take *take, void *context)
{
    walk(keys_root, 0, take, context);
}

const char *const key_list_head[2] = {
    "Scene files, version 1. *: required. EXPR: number, + - * / ^ ( ), names, pi, deg, abs sign "
    "sqrt exp log sin cos tan asin acos atan sinh cosh tanh atan2 hypot floor ceil mod min max; SI "
    "units, or those of 'units'. [EXPR, ...] may be a range: a..b, a..b step c, a..b/n, a..b/n:log "
    "(equal ratios). A "
    "word may be the name of a parameter.",
    "Keys of every entry (NAME: {...}, - {...}), except those of parameters, parts and refuse; "
    "$NAME "
    "is replaced by its value in names and strings:"};

typedef struct key_rows {
    FILE *to;
    int depth;
    key_list_print *print;
} key_rows;

static void write_key(void *context, int depth, const char *name, const char *form,
                      const char *text)
{
    const key_rows *l = context;
    const int indent = 2 * (l->depth + depth);
    const int at = fprintf(l->to, "%*s%-*s %-12s ", indent, "", 26 - indent, name, form);
    l->print(l->to, at, at, text);
}

void key_list_write(FILE *to, key_list_print *print)
{
    key_rows loops = {to, 1, print}, all = {to, 0, print};
    for (int i = 0; i < 2; i++)
        print(to, 0, 2, key_list_head[i]);
    key_list_loops(write_key, &loops);
    key_list_all(write_key, &all);
}

static json_t *map_of(const entry_field *table, const entry_field *loop);

static json_t *scalar(void)
{
    return json_pack("{s:[s, s]}", "type", "number", "string");
}

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
    if (k->words == NULL) /* user-defined names */
        return json_pack("{s:s}", "type", "string");
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
    const entry_field *any = keys_any(table);
    add_keys(properties, required, any == NULL ? table : NULL);
    add_keys(properties, required, loop);
    return json_pack("{s:s, s:o, s:o, s:o}", "type", "object", "properties", properties, "required",
                     required, "additionalProperties", any != NULL ? value_of(any) : json_false());
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
