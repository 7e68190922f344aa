#include "cases/format/choose.h"

#include <string.h>

#include "cases/format/expression.h"
#include "elements/shared/choice.h"

static const scope *find(const document_node *key, const scope *names, mistakes *m)
{
    const scope *known = scope_find(names, key->text, strlen(key->text));
    char remedy[FAULT_TEXT];
    if (known == NULL)
        document_mistake(m, key, 0, "unknown name '%.40s'%s", key->text,
                         mistakes_remedy(scope_nearest(names, key->text),
                                         "; a name of 'parameters', 'let' or 'for' is expected",
                                         remedy));
    return known;
}

/* Is this its value? -1 after a mistake. */
static int has_value(const scope *known, const document_node *n, const scope *names, mistakes *m)
{
    double value;
    if (known->word == NULL)
        return expression_number(n, names, m, &value) ? value == known->number : -1;
    const int is_text = n->kind == DOCUMENT_TEXT;
    if (is_text && (known->choices == NULL || choice_index(known->choices, n->text) >= 0))
        return strcmp(known->word, n->text) == 0;
    document_mistake(m, n, 0, "%s has no such value; give one of %s", known->name,
                     known->choices != NULL ? known->choices : "its words");
    return -1;
}

static int has_one_of(const scope *known, const document_node *n, const scope *names, mistakes *m)
{
    int has = n->kind == DOCUMENT_LIST ? 0 : has_value(known, n, names, m);
    for (int i = 0; n->kind == DOCUMENT_LIST && i < n->count; i++) {
        const int one = has_value(known, n->item[i], names, m);
        has = one < 0 ? one : has | one;
    }
    return has > 0;
}

int choose_holds(const document_node *conditions, const scope *names, mistakes *m)
{
    if (conditions != NULL && conditions->kind != DOCUMENT_MAP)
        document_mistake(m, conditions, 0, "'if' is a map: if: {NAME: VALUE, NAME: [VALUE, ...]}");
    int holds = conditions == NULL || conditions->kind == DOCUMENT_MAP;
    for (int i = 0; holds && conditions != NULL && i < conditions->count; i++) {
        const scope *known = find(conditions->key[i], names, m);
        holds = known != NULL && has_one_of(known, conditions->item[i], names, m);
    }
    return holds;
}

/* Behind the key that is its value, or behind else; NULL: behind none, or after a mistake. */
static const document_node *entry_of(const scope *known, const document_node *map,
                                     const scope *names, mistakes *m)
{
    const document_node *found = document_find(map, "else");
    for (int i = 0; i < map->count; i++) {
        if (strcmp(map->key[i]->text, "else") == 0)
            continue;
        const int has = has_value(known, map->key[i], names, m);
        if (has != 0)
            found = has > 0 ? map->item[i] : NULL;
    }
    return found;
}

const document_node *choose_value(const document_node *n, const scope *names, mistakes *m)
{
    if (n->kind != DOCUMENT_MAP)
        return n;
    if (n->count != 1 || n->item[0]->kind != DOCUMENT_MAP) {
        document_mistake(m, n, 0, "a choice is one name: {NAME: {VALUE: ..., else: ...}}");
        return NULL;
    }
    const int before = m->count;
    const scope *known = find(n->key[0], names, m);
    const document_node *found = known != NULL ? entry_of(known, n->item[0], names, m) : NULL;
    if (found == NULL && m->count == before)
        document_mistake(m, n->key[0], 0,
                         "nothing is said of the value that %s has; add it, or else: ...",
                         n->key[0]->text);
    return found != NULL ? choose_value(found, names, m) : NULL;
}
