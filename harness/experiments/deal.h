/* Work cut into batches, and the batches dealt to shards. Both depend on the costs alone. */
#ifndef BEAMWORK_DEAL_H
#define BEAMWORK_DEAL_H

/* Consecutive items of at most `most` together; one that is dearer stands alone. first[items + 1]:
 * of each batch, and behind the last one `items`. Returns the number of batches. */
int deal_cut(int items, const double cost[], double most, int first[]);
/* shard[batches]: to which of 0..shards-1 each goes. The dearest first, each to the shard with the
 * least so far. 0, or -1: out of memory. */
int deal_out(int batches, const double cost[], int shards, int shard[]);
/* order[batches]: the dearest first; of two that cost the same, the first. */
void deal_order(int batches, const double cost[], int order[]);

#endif
