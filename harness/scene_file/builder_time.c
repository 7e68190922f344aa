/* Functions of time: one expression of t, or pieces of them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/scene_file/builder.h"

enum { MOST_TEXT = 4000 };

static int is_own_name(const char *text, size_t length)
{
    static const char *const own[] = {"t",    "pi",   "deg",  "sin",  "cos", "tan", "asin", "acos",
                                      "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt"};
    for (size_t i = 0; i < sizeof own / sizeof own[0]; i++)
        if (strlen(own[i]) == length && strncmp(own[i], text, length) == 0)
            return 1;
    return 0;
}

/* The expression with the values of its names in their places; 0 after a mistake. */
static int with_values(const fields *f, const document_node *n, char out[MOST_TEXT])
{
    size_t used = 0;
    for (const char *at = n->text; *at != '\0';) {
        const size_t length = scope_name_length(at);
        /* the e of 1e-3 belongs to its number */
        const int behind = at > n->text && (at[-1] == '.' || (at[-1] >= '0' && at[-1] <= '9'));
        const scope *name = length > 0 && !behind && !is_own_name(at, length)
                                ? scope_find(f->names, at, length)
                                : NULL;
        if (used + length + 40 >= MOST_TEXT) {
            document_mistake(f->b->mistakes, n, 0, "too long; split it into pieces");
            return 0;
        }
        if (name != NULL && name->word == NULL && name->constants == NULL) {
            used += (size_t)snprintf(out + used, MOST_TEXT - used, "(%.17g)", name->number);
            at += length;
        } else {
            const size_t taken = length > 0 ? length : 1;
            memcpy(out + used, at, taken);
            used += taken;
            at += taken;
        }
    }
    out[used] = '\0';
    return 1;
}

static void add_piece(const fields *f, const document_node *n, double until, int index,
                      builder_piece *add)
{
    char text[MOST_TEXT];
    formula *read = NULL;
    fault why = {""};
    if (n == NULL || !with_values(f, n, text))
        return;
    if (formula_read(text, &read, &why) != STATUS_OK)
        document_mistake(f->b->mistakes, n, 0, "%s", why.text);
    else
        add(f->b->scene, index, until, text);
    formula_free(read);
}

int builder_function(const fields *f, int index, builder_piece *add)
{
    const document_node *one = document_find(f->map, "time"),
                        *list = document_find(f->map, "pieces");
    if (one != NULL)
        add_piece(f, one, 0, index, add);
    double before = -INFINITY;
    for (int i = 0; list != NULL && i < list->count; i++) {
        fields piece = *f;
        piece.map = list->item[i];
        const int last = i == list->count - 1;
        const double until = fields_number(&piece, "until", 0);
        if (!last && !(fields_have(&piece, "until") && until > before))
            document_mistake(f->b->mistakes, piece.map, 0,
                             "a piece ends behind the one before it; give until: [s]");
        before = until;
        add_piece(&piece, document_find(piece.map, "is"), until, index, add);
    }
    return one != NULL || list != NULL;
}
