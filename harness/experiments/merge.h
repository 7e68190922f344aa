/* The batches of one or several folders, taken in canonical order, one at a time in memory. */
#ifndef BEAMWORK_MERGE_H
#define BEAMWORK_MERGE_H

#include "harness/experiments/stock.h"

/* Takes every batch that is there. s: of stock_take. FAULT: one cannot be read (any more). */
status merge_take(const shard_work *w, const stock *s, fault *f);

#endif
