#include "cases/format/unroll.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/choose.h"
#include "cases/format/expression.h"
#include "cases/format/range.h"
#include "cases/format/substitute.h"

typedef struct unroller {
    arena *arena;
    mistakes *mistakes;
    unrolled *list;
    int count, failed;
    const document_node *key, *value; /* of the present entry; key NULL: of a list */
} unroller;

static void add(unroller *u, const scope *names)
{
    const document_node *place = u->key != NULL ? u->key : u->value;
    if (u->count == UNROLL_MOST) {
        document_mistake(u->mistakes, place, 0, "more than %d entries when loops are written out",
                         UNROLL_MOST);
        u->failed = 1;
        return;
    }
    const scope *inner = unroll_let(document_find(u->value, "let"), names, u->arena, u->mistakes);
    if (!choose_holds(document_find(u->value, "if"), inner, u->mistakes))
        return;
    u->list = arena_grow(u->arena, u->list, u->count, sizeof *u->list);
    const document_node *value = substitute_node(u->value, inner, u->arena, u->mistakes);
    const document_node *name =
        u->key != NULL ? substitute_node(u->key, inner, u->arena, u->mistakes) : NULL;
    if (u->list == NULL || value == NULL || (u->key != NULL && name == NULL)) {
        u->mistakes->out_of_memory |= u->arena->failed;
        u->failed = 1;
        u->count = 0;
        return;
    }
    u->list[u->count++] =
        (unrolled){name != NULL ? name->text : NULL, place, value, u->value, inner, NULL};
}

static void unroll_loops(unroller *u, const document_node *loops, int depth, const scope *names);

/* A word of a loop's list: it is no expression with known names. */
static int is_word(const document_node *n, const scope *names)
{
    const size_t length = n->kind == DOCUMENT_TEXT ? scope_name_length(n->text) : 0;
    return length > 0 && n->text[length] == '\0' && scope_find(names, n->text, length) == NULL;
}

static void loop_list(unroller *u, const document_node *loops, int depth, const scope *names)
{
    const document_node *list = loops->item[depth];
    const char *name = loops->key[depth]->text;
    for (int i = 0; i < list->count && !u->failed; i++) {
        const document_node *one = list->item[i];
        double value = 0;
        if (is_word(one, names))
            unroll_loops(u, loops, depth + 1, scope_word(names, name, one->text, u->arena));
        else if (expression_number(one, names, u->mistakes, &value))
            unroll_loops(u, loops, depth + 1, scope_number(names, name, value, u->arena));
        else
            u->failed = 1;
    }
}

static void loop_range(unroller *u, const document_node *loops, int depth, const scope *names)
{
    double *value;
    const int count = range_values(loops->item[depth], names, u->arena, u->mistakes, &value);
    u->failed |= count < 0;
    for (int i = 0; i < count && !u->failed; i++)
        unroll_loops(u, loops, depth + 1,
                     scope_number(names, loops->key[depth]->text, value[i], u->arena));
}

static void unroll_loops(unroller *u, const document_node *loops, int depth, const scope *names)
{
    if (loops == NULL || depth == loops->count) {
        add(u, names);
        return;
    }
    if (!scope_accepts(names, loops->key[depth], u->mistakes))
        u->failed = 1;
    else if (loops->item[depth]->kind == DOCUMENT_LIST)
        loop_list(u, loops, depth, names);
    else
        loop_range(u, loops, depth, names);
}

int unroll_entries(const document_node *collection, const scope *names, arena *a, mistakes *m,
                   unrolled **out)
{
    unroller u = {.arena = a, .mistakes = m};
    const int entries =
        collection != NULL && collection->kind != DOCUMENT_TEXT ? collection->count : 0;
    for (int i = 0; i < entries && u.count < UNROLL_MOST && !m->out_of_memory; i++) {
        u.key = collection->kind == DOCUMENT_MAP ? collection->key[i] : NULL;
        u.value = collection->item[i];
        u.failed = 0;
        const document_node *loops = document_find(u.value, "for");
        if (loops != NULL && loops->kind != DOCUMENT_MAP)
            document_mistake(m, loops, 0, "'for' is a map: for: {i: 0..5}");
        else
            unroll_loops(&u, loops, 0, names);
    }
    *out = u.list;
    return u.count;
}

/* NAME: EXPR, or a choice among such and words. After a mistake a name is known all the same: it is
 * not told again wherever it is used. */
static const scope *add_let(const document_node *key, const document_node *said, const scope *names,
                            arena *a, mistakes *m)
{
    double value;
    const document_node *n = choose_value(said, names, m);
    if (n != NULL && n != said && is_word(n, names))
        return scope_word(names, key->text, n->text, a);
    if (n == NULL || !expression_number(n, names, m, &value))
        value = NAN;
    return scope_number(names, key->text, value, a);
}

const scope *unroll_let(const document_node *let, const scope *names, arena *a, mistakes *m)
{
    if (let != NULL && let->kind != DOCUMENT_MAP)
        document_mistake(m, let, 0, "'let' is a map: let: {name: expression}");
    if (let == NULL || let->kind != DOCUMENT_MAP)
        return names;
    for (int i = 0; i < let->count; i++) {
        const int accepted = scope_accepts(names, let->key[i], m);
        const scope *with = add_let(let->key[i], let->item[i], names, a, m);
        names = accepted ? with : names;
    }
    return names;
}
