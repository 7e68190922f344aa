#include "harness/experiments/deal.h"

#include <stdlib.h>

int deal_cut(int items, const double cost[], double most, int first[])
{
    int batches = 0;
    double all = 0;
    for (int i = 0; i < items; i++) {
        if (i == 0 || all + cost[i] > most) {
            first[batches++] = i;
            all = 0;
        }
        all += cost[i];
    }
    first[batches] = items;
    return batches;
}

static int dearest(const void *left, const void *right, void *context)
{
    const double *cost = context;
    const int a = *(const int *)left, b = *(const int *)right;
    if (cost[a] != cost[b])
        return cost[a] > cost[b] ? -1 : 1;
    return a < b ? -1 : 1;
}

void deal_order(int batches, const double cost[], int order[])
{
    for (int i = 0; i < batches; i++)
        order[i] = i;
    qsort_r(order, (size_t)batches, sizeof *order, dearest, (void *)cost);
}

/* What a shard has so far; a heap of them has the one with the least on top, of two the first. */
typedef struct hand {
    double sum;
    int shard;
} hand;

static int is_before(const hand *a, const hand *b)
{
    return a->sum < b->sum || (a->sum == b->sum && a->shard < b->shard);
}

/* The top has changed. */
static void sift(hand heap[], int count)
{
    const hand moved = heap[0];
    int at = 0;
    for (int below = 1; below < count; below = 2 * at + 1) {
        if (below + 1 < count && is_before(&heap[below + 1], &heap[below]))
            below++;
        if (!is_before(&heap[below], &moved))
            break;
        heap[at] = heap[below];
        at = below;
    }
    heap[at] = moved;
}

int deal_out(int batches, const double cost[], int shards, int shard[])
{
    int *order = malloc(((size_t)batches + 1) * sizeof *order);
    hand *heap = malloc(((size_t)shards + 1) * sizeof *heap);
    const int good = order != NULL && heap != NULL;
    if (good) {
        deal_order(batches, cost, order);
        for (int k = 0; k < shards; k++)
            heap[k] = (hand){0, k};
        for (int i = 0; i < batches; i++) {
            shard[order[i]] = heap[0].shard;
            heap[0].sum += cost[order[i]];
            sift(heap, shards);
        }
    }
    free(order);
    free(heap);
    return good ? 0 : -1;
}
