#include "harness/shards/deal.h"

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

static int least(int count, const double sum[])
{
    int found = 0;
    for (int i = 1; i < count; i++)
        if (sum[i] < sum[found])
            found = i;
    return found;
}

int deal_out(int batches, const double cost[], int shards, int shard[])
{
    int *order = malloc(((size_t)batches + 1) * sizeof *order);
    double *sum = calloc((size_t)shards + 1, sizeof *sum);
    const int good = order != NULL && sum != NULL;
    if (good) {
        deal_order(batches, cost, order);
        for (int i = 0; i < batches; i++) {
            const int to = least(shards, sum);
            shard[order[i]] = to;
            sum[to] += cost[order[i]];
        }
    }
    free(order);
    free(sum);
    return good ? 0 : -1;
}
