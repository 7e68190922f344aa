#include "harness/experiments/merge.h"

static status take(const shard_work *w, const stock *s, int batch, fault *f)
{
    char path[PATH_MAX];
    batch_label label;
    FILE *from = NULL;
    long end = 0;
    TRY(stock_path(s, batch, path, f));
    TRY(batch_open(path, &label, &from, &end, f));
    batch_label_free(&label);
    status outcome = w->take(w->context, batch, from, f);
    if (outcome == STATUS_OK && ftell(from) != end)
        outcome = fault_set(f, STATUS_FAULT, "%.200s: has other bytes than the batch takes", path);
    fclose(from);
    return outcome;
}

status merge_take(const shard_work *w, const stock *s, fault *f)
{
    for (int i = 0; i < s->batches; i++)
        if (s->where[i] >= 0)
            TRY(take(w, s, i, f));
    return STATUS_OK;
}
