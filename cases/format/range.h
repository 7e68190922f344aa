/* Lists of numbers, written out or as a range. */
#ifndef BEAMWORK_RANGE_H
#define BEAMWORK_RANGE_H

#include "cases/format/scope.h"

/* A list of numbers, or a range: a..b (steps of 1), a..b step c, a..b/n (n equal parts; the last /
 * behind .. always divides so, else put b in parentheses). Both ends are values. The count, or -1
 * after a mistake; *out is the arena's. */
int range_values(const document_node *n, const scope *names, arena *a, mistakes *m, double **out);
/* Is the text a range? */
int range_is(const document_node *n);

#endif
