/* The names that expressions may use: parameters, derived values, loop names. */
#ifndef BEAMWORK_SCOPE_H
#define BEAMWORK_SCOPE_H

#include "cases/format/arena.h"
#include "cases/format/document.h"

/* The name added last; those before it stay visible. NULL: no name is known. */
typedef struct scope {
    const char *name;
    double number;           /* NAN: its expression has a mistake, which is told */
    const char *word;        /* of a choice; NULL: a number */
    const char *choices;     /* "a|b|c" of a parameter; NULL: not known */
    const double *constants; /* of a section, whose name ends in a point; NULL: it is none */
    const struct scope *before;
} scope;

/* The scope with one name more, a number or a word; the scope itself where memory ran out. */
const scope *scope_number(const scope *names, const char *name, double number, arena *a);
const scope *scope_word(const scope *names, const char *name, const char *word, arena *a);
/* A word of a parameter that has these. */
const scope *scope_choice(const scope *names, const char *name, const char *word,
                          const char *choices, arena *a);
/* With the constants of a section: see section_names.h. */
const scope *scope_constants(const scope *names, const char *name, const double value[], arena *a);
/* The entry of a name of that length, or NULL. */
const scope *scope_find(const scope *names, const char *name, size_t length);
/* The known name, constant or function nearest to a misspelt one, or NULL. */
const char *scope_nearest(const scope *names, const char *name);
/* Can `key` be a new name: a letter, then letters, digits and _, not taken by another or by a
 * function? Else a mistake. */
int scope_accepts(const scope *names, const document_node *key, mistakes *m);
/* Length of the name that the text begins with: letters, digits, _, not a digit first; 0: none. */
size_t scope_name_length(const char *text);

#endif
