/* Loops and local names: the entries of a map or list with `for` and `let` written out. */
#ifndef BEAMWORK_UNROLL_H
#define BEAMWORK_UNROLL_H

#include "cases/format/scope.h"

/* One entry as it was meant: $i in its name and texts is replaced, and its names are known. */
typedef struct unrolled {
    const char *name;           /* of an entry of a map; of a list NULL */
    const document_node *place; /* where messages point to: its key, or itself */
    const document_node *value;
    const document_node *written; /* the value as it stands in the file */
    const scope *names;
    const struct placement *placed; /* of an instance of a part; NULL: of the scene itself */
} unrolled;

enum { UNROLL_MOST = 10000 };

/* Entries in the file's order, the first loop of an entry outermost: their count. What is wrong
 * with a loop is a mistake, and the entry is left out. */
int unroll_entries(const document_node *collection, const scope *names, arena *a, mistakes *m,
                   unrolled **out);
/* NAME: EXPR, in order, each known to those after it. */
const scope *unroll_let(const document_node *let, const scope *names, arena *a, mistakes *m);

#endif
