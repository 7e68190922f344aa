#include "cases/format/key_list.h"

#include <string.h>

#include "cases/format/keys.h"

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
        return "[WORD, ...]";
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

/* "summary [unit] (word, word); left out: 0", or "... *". */
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
        take(context, depth, table->name, form_of(table, form), text);
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
    "Scene files, version 1. *: must be there. EXPR: number, + - * / ^ ( ), names, pi, deg, abs "
    "sign sqrt exp log sin cos tan asin acos atan sinh cosh tanh atan2 hypot floor ceil mod min "
    "max; "
    "SI only. "
    "[EXPR, ...] may be a range: a..b, a..b step c, a..b/n. A word may be the name of a parameter.",
    "Every entry (NAME: {...}, - {...}) may have these; $i in its name and texts is replaced:"};

typedef struct key_rows {
    FILE *to;
    int depth; /* of what stands at the root of what is walked */
    key_list_say *say;
} key_rows;

static void write_key(void *context, int depth, const char *name, const char *form,
                      const char *text)
{
    const key_rows *l = context;
    const int indent = 2 * (l->depth + depth);
    const int at = fprintf(l->to, "%*s%-*s %-12s ", indent, "", 26 - indent, name, form);
    l->say(l->to, at, at, text);
}

void key_list_write(FILE *to, key_list_say *say)
{
    key_rows loops = {to, 1, say}, all = {to, 0, say};
    for (int i = 0; i < 2; i++)
        say(to, 0, 2, key_list_head[i]);
    key_list_loops(write_key, &loops);
    key_list_all(write_key, &all);
}
