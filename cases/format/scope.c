#include "cases/format/format_impl.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
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
    return at != NULL ? at->name : expression_word(i);
}

const char *scope_nearest(const scope *names, const char *name)
{
    return choice_nearest(name, name_at, names);
}

int scope_accepts(const scope *names, const document_node *key, mistakes *m)
{
    const size_t length = strlen(key->text);
    if (length == 0 || expression_name_length(key->text) != length || length > 40) {
        document_mistake(m, key, 0,
                         "'%.60s' is not a valid name for a value; use at most 40 letters, digits "
                         "and _, beginning with a letter",
                         key->text);
        return 0;
    }
    if (expression_is_word(key->text, length)) {
        document_mistake(m, key, 0, "'%s' is a function or constant; choose another name",
                         key->text);
        return 0;
    }
    if (scope_find(names, key->text, length) != NULL) {
        document_mistake(m, key, 0, "the name '%s' is already defined; choose another one",
                         key->text);
        return 0;
    }
    return 1;
}

enum { LONGEST = 4096 };

static int has_name(const document_node *n)
{
    if (n->kind == DOCUMENT_TEXT)
        return strchr(n->text, '$') != NULL;
    for (int i = 0; i < n->count; i++)
        if (has_name(n->item[i]) || (n->key != NULL && has_name(n->key[i])))
            return 1;
    return 0;
}

/* Returns the length of the loop name that follows $ or ${ at the start of the text, or 0. */
static size_t substitute_name_at(const char *at, int *braces)
{
    *braces = at[0] == '$' && at[1] == '{';
    const size_t length = *at == '$' ? expression_name_length(at + 1 + *braces) : 0;
    return *braces && at[2 + length] != '}' ? 0 : length;
}

int substitute_is_left(const char *text)
{
    int braces;
    for (const char *at = text; *at != '\0'; at++)
        if (substitute_name_at(at, &braces) > 0)
            return 1;
    return 0;
}

/* Writes the value of a name as text. Returns 0 after an error, which is reported. */
static int value_text(const document_node *n, int at, size_t length, int for_message,
                      const scope *names, mistakes *m, char out[64])
{
    const char *name = n->text + at + (n->text[at + 1] == '{' ? 2 : 1);
    const scope *known = scope_find(names, name, length);
    char word[48], remedy[FAULT_TEXT];
    if (known != NULL && known->word != NULL) {
        snprintf(out, 64, "%s", known->word);
        return 1;
    }
    if (known != NULL && for_message) {
        snprintf(out, 64, "%g", known->number);
        return 1;
    }
    if (known != NULL && known->number == floor(known->number) && fabs(known->number) < 1e9) {
        snprintf(out, 64, "%.0f", known->number);
        return 1;
    }
    if (known != NULL) {
        document_mistake(m, n, at,
                         "$%s is %g, but only whole numbers and words can be inserted; count "
                         "with a loop name, and compute the value with 'let'",
                         known->name, known->number);
        return 0;
    }
    snprintf(word, sizeof word, "%.*s", (int)(length < 40 ? length : 40), name);
    document_mistake(
        m, n, at, "unknown loop name '$%s'%s", word,
        mistakes_remedy(scope_nearest(names, word), "; define it under 'for'", remedy));
    return 0;
}

static const char *substitute_text(const document_node *n, int for_message, const scope *names,
                                   arena *a, mistakes *m)
{
    char text[LONGEST];
    size_t used = 0;
    for (const char *at = n->text; *at != '\0' && used + 64 < sizeof text;) {
        int braces;
        const size_t length = substitute_name_at(at, &braces);
        char value[64];
        if (length > 0 &&
            value_text(n, (int)(at - n->text), length, for_message, names, m, value)) {
            used += (size_t)snprintf(text + used, sizeof text - used, "%s", value);
            at += 1 + length + 2 * (size_t)braces;
        } else {
            text[used++] = *at++;
        }
    }
    return arena_copy(a, text, used);
}

const char *substitute_for_message(const document_node *n, const scope *names, arena *a,
                                   mistakes *m)
{
    return substitute_text(n, 1, names, a, m);
}

static document_node *substituted(document_node *n, const scope *names, arena *a, mistakes *m);

static document_node *copy_of(const document_node *n, const scope *names, arena *a, mistakes *m)
{
    document_node *copy = arena_take(a, sizeof *copy);
    if (copy == NULL)
        return NULL;
    *copy = *n;
    if (n->kind == DOCUMENT_TEXT) {
        copy->text = substitute_text(n, 0, names, a, m);
        copy->inset = strcmp(n->text, copy->text != NULL ? copy->text : "") == 0 ? n->inset : -1;
        return copy->text != NULL ? copy : NULL;
    }
    copy->item = arena_take(a, (size_t)n->count * sizeof(document_node *));
    if (n->key != NULL)
        copy->key = arena_take(a, (size_t)n->count * sizeof(document_node *));
    if (copy->item == NULL || (n->key != NULL && copy->key == NULL))
        return NULL;
    for (int i = 0; i < n->count; i++) {
        copy->item[i] = substituted(n->item[i], names, a, m);
        if (n->key != NULL)
            copy->key[i] = substituted(n->key[i], names, a, m);
        if (copy->item[i] == NULL || (n->key != NULL && copy->key[i] == NULL))
            return NULL;
    }
    return copy;
}

static document_node *substituted(document_node *n, const scope *names, arena *a, mistakes *m)
{
    return has_name(n) ? copy_of(n, names, a, m) : n;
}

const document_node *substitute_node(const document_node *n, const scope *names, arena *a,
                                     mistakes *m)
{
    return has_name(n) ? copy_of(n, names, a, m) : n;
}
