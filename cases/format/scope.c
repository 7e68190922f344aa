#include "cases/format/scope.h"

#include <string.h>

#include "cases/scene/functions.h"
#include "elements/shared/choice.h"

static const scope *add(const scope *names, const char *name, double number, const char *word,
                        arena *a)
{
    scope *one = arena_take(a, sizeof *one);
    if (one == NULL)
        return names;
    one->name = name;
    one->number = number;
    one->word = word;
    one->before = names;
    return one;
}

const scope *scope_number(const scope *names, const char *name, double number, arena *a)
{
    return add(names, name, number, NULL, a);
}

const scope *scope_word(const scope *names, const char *name, const char *word, arena *a)
{
    return add(names, name, 0, word, a);
}

const scope *scope_choice(const scope *names, const char *name, const char *word,
                          const char *choices, arena *a)
{
    scope *one = arena_take(a, sizeof *one);
    if (one == NULL)
        return names;
    *one = (scope){.name = name, .word = word, .choices = choices, .before = names};
    return one;
}

const scope *scope_constants(const scope *names, const char *name, const double value[], arena *a)
{
    scope *one = arena_take(a, sizeof *one);
    if (one == NULL)
        return names;
    *one = (scope){.name = name, .constants = value, .before = names};
    return one;
}

const scope *scope_find(const scope *names, const char *name, size_t length)
{
    for (const scope *at = names; at != NULL; at = at->before)
        if (strncmp(at->name, name, length) == 0 && at->name[length] == '\0')
            return at;
    return NULL;
}

static const char *name_at(const void *context, int i)
{
    const scope *at = context;
    for (; at != NULL && i > 0; i--)
        at = at->before;
    return at != NULL ? at->name : functions_name(i);
}

const char *scope_nearest(const scope *names, const char *name)
{
    return choice_nearest(name, name_at, names);
}

size_t scope_name_length(const char *text)
{
    static const char digits[] = "0123456789",
                      letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                  "0123456789";
    return strspn(text, digits) > 0 ? 0 : strspn(text, letters);
}

int scope_accepts(const scope *names, const document_node *key, mistakes *m)
{
    const size_t length = strlen(key->text);
    if (length == 0 || scope_name_length(key->text) != length || length > 40) {
        document_mistake(
            m, key, 0,
            "'%.60s' is not a valid name of a value; use at most 40 letters, digits and _, a "
            "letter first",
            key->text);
        return 0;
    }
    for (int i = 0; functions_name(i) != NULL; i++)
        if (strcmp(functions_name(i), key->text) == 0) {
            document_mistake(m, key, 0, "'%s' is a function or constant; choose another name",
                             key->text);
            return 0;
        }
    if (scope_find(names, key->text, length) != NULL) {
        document_mistake(m, key, 0, "the name '%s' is taken already; choose another", key->text);
        return 0;
    }
    return 1;
}
