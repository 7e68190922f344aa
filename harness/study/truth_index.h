/* Rows of truths by their case and quantity: thousands are asked about for every verdict. */
#ifndef BEAMWORK_TRUTH_INDEX_H
#define BEAMWORK_TRUTH_INDEX_H

#include "harness/study/truths.h"

/* Of all rows that there are; truths_read makes it. Rows added later are found too, and more
 * slowly until it is made again. FAULT: out of memory; what was found before still is. */
status truth_index_make(truths *t, fault *f);
void truth_index_free(truths *t);

/* The first row that speaks of the quantity of the case, in the order of the rows; t->rows: none.
 */
int truth_index_first(const truths *t, const case_type *type, const char *quantity);
/* The next one behind row i that speaks of the same. */
int truth_index_next(const truths *t, int i);

#endif
