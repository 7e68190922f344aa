#include "harness/exchange/map_keys.h"

#include <math.h>
#include <string.h>

#include "cases/format/line.h"
#include "elements/shared/choice.h"

static const char *name_at(const void *context, int i)
{
    return ((const char *const *)context)[i];
}

void map_keys_check(const document_node *map, const char *const known[], mistakes *m)
{
    for (int i = 0; i < map->count; i++) {
        int found = 0;
        for (int k = 0; known[k] != NULL; k++)
            found |= strcmp(known[k], map->key[i]->text) == 0;
        const char *near = found ? NULL : choice_nearest(map->key[i]->text, name_at, known);
        if (!found)
            document_mistake(m, map->key[i], 0, "unknown key '%.40s'%s%s%s", map->key[i]->text,
                             near != NULL ? "; did you mean '" : "", near != NULL ? near : "",
                             near != NULL ? "'?" : "");
    }
}

/* The text of an entry; `otherwise` where there is none. */
const char *map_keys_text(mistakes *m, const document_node *map, const char *key,
                          const char *otherwise)
{
    const document_node *n = document_find(map, key);
    if (n == NULL)
        return otherwise;
    if (n->kind == DOCUMENT_TEXT)
        return n->text;
    document_mistake(m, n, 0, "%s: a text", key);
    return otherwise;
}

double map_keys_number(mistakes *m, const document_node *map, const char *key, double otherwise)
{
    const char *text = map_keys_text(m, map, key, NULL);
    double value;
    if (text == NULL)
        return otherwise;
    if (line_number(text, &value))
        return value;
    document_mistake(m, document_find(map, key), 0, "%s '%.40s' is not a number", key, text);
    return otherwise;
}

int map_keys_count(mistakes *m, const document_node *map, const char *key, int otherwise)
{
    const double value = map_keys_number(m, map, key, otherwise);
    if (value == floor(value) && value >= 0 && value <= 10000000)
        return (int)value;
    document_mistake(m, document_find(map, key), 0, "%s: a whole number", key);
    return otherwise;
}
