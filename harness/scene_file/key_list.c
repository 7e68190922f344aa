#include "harness/scene_file/key_list.h"

#include <string.h>

#include "harness/scene_file/keys.h"

enum { DESCRIPTION = 1000 };

static const char *form_of(const scene_key *k, char text[32])
{
    switch (k->kind) {
    case KEY_TEXT:
        return "TEXT";
    case KEY_NAME:
        return "NAME";
    case KEY_WORD:
        return "WORD";
    case KEY_WORDS:
        return "[WORD, ...]";
    case KEY_NUMBER:
        return "EXPR";
    case KEY_VECTOR:
        snprintf(text, 32, "[EXPR x%d]", k->count);
        return text;
    case KEY_NUMBERS:
        return "[EXPR, ...]";
    case KEY_MAP:
        return "{...}";
    case KEY_ENTRIES:
        return "NAME: {...}";
    case KEY_LIST:
        return "- {...}";
    case KEY_NAMES:
        return "NAME: VALUE";
    case KEY_FORMS:
    case KEY_LATER:
        break;
    }
    return "...";
}

/* "summary [unit] (word, word) *". */
static void describe(const scene_key *k, char text[DESCRIPTION])
{
    int used = snprintf(text, DESCRIPTION, "%s%s%s%s", k->summary, k->unit != NULL ? " [" : "",
                        k->unit != NULL ? k->unit : "", k->unit != NULL ? "]" : "");
    const char *joint = " (";
    for (const char *at = k->words; at != NULL && used < DESCRIPTION; joint = ", ") {
        const size_t length = strcspn(at, "|");
        used +=
            snprintf(text + used, (size_t)(DESCRIPTION - used), "%s%.*s", joint, (int)length, at);
        at = at[length] != '\0' ? at + length + 1 : NULL;
    }
    if (used < DESCRIPTION)
        snprintf(text + used, (size_t)(DESCRIPTION - used), "%s%s", k->words != NULL ? ")" : "",
                 !k->needed     ? ""
                 : k->group > 0 ? "; one of these *"
                                : " *");
}

static void write_table(FILE *to, const scene_key *table, int depth, key_list_say *say)
{
    for (; table != NULL && table->name != NULL; table++) {
        char form[32], text[DESCRIPTION];
        if (table->kind == KEY_LATER)
            continue;
        const int indent = 2 * depth;
        describe(table, text);
        const int at = fprintf(to, "%*s%-*s %-12s ", indent, "", 26 - indent, table->name,
                               form_of(table, form));
        say(to, at, at, text);
        if (table->kind == KEY_MAP || table->kind == KEY_ENTRIES || table->kind == KEY_LIST)
            write_table(to, table->below, depth + 1, say);
    }
}

void key_list_write(FILE *to, key_list_say *say)
{
    say(to, fprintf(to, "Scene files, version 1. "), 2,
        "*: must be there. EXPR: number, + - * / ^ ( ), names, pi, deg, "
        "abs sign sqrt exp log sin cos tan asin acos atan "
        "atan2 hypot floor ceil mod min max; SI only. [EXPR, ...] may be a range: a..b, a..b step "
        "c, a..b/n. A word may be the name of a parameter.");
    say(to, fprintf(to, "Every entry "), 2,
        "(NAME: {...}, - {...}) may have these; $i in its name and texts is "
        "replaced:");
    write_table(to, keys_loop, 1, say);
    write_table(to, keys_root, 0, say);
}
