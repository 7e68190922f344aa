#include "harness/scene_file/key_list.h"

#include <string.h>

#include "harness/scene_file/keys.h"

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

static void write_table(FILE *to, const scene_key *table, int depth)
{
    for (; table != NULL && table->name != NULL; table++) {
        char form[32];
        if (table->kind == KEY_LATER)
            continue;
        const int indent = 2 * depth;
        fprintf(to, "%*s%-*s %-12s %s%s%s%s", indent, "", 26 - indent, table->name,
                form_of(table, form), table->summary, table->unit != NULL ? " [" : "",
                table->unit != NULL ? table->unit : "", table->unit != NULL ? "]" : "");
        if (table->words != NULL)
            fprintf(to, " (%s)", table->words);
        if (table->needed)
            fputs(table->group > 0 ? "; one of these *" : " *", to);
        fputc('\n', to);
        if (table->kind == KEY_MAP || table->kind == KEY_ENTRIES || table->kind == KEY_LIST)
            write_table(to, table->below, depth + 1);
    }
}

void key_list_write(FILE *to)
{
    fputs(
        "Scene files, version 1. *: must be there. EXPR: number, + - * / ^ ( ), names, pi, deg, "
        "abs sign sqrt exp log sin cos tan asin acos atan\n"
        "atan2 hypot floor ceil mod min max; SI only. [EXPR, ...] may be a range: a..b, a..b step "
        "c, a..b/n. A word may be the name of a parameter.\n"
        "Every entry (NAME: {...}, - {...}) may have these; $i in its name and texts is "
        "replaced:\n",
        to);
    write_table(to, keys_loop, 1);
    write_table(to, keys_root, 0);
}
