#include "harness/cli/verification_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/cli/cells.h"
#include "harness/cli/spread.h"
#include "harness/experiments/experiments.h"

/* About, on the reference machine; little work is cut finer, so that there is some for everybody.
 */
static const double batch_most = 0.5, batch_least = 0.02, batch_share = 1.0 / 32;

/* The sweep cut into batches. An item is a series that is run. */
typedef struct cut {
    const sweep_request *request;
    truths *t; /* of the doubts that noise is measured for */
    sweep *s;
    int items;
    int *begin;   /* [items + 1] series that the item begins with; the last: of all */
    double *each; /* [items] what it costs */
    int *first;   /* [batches + 1] item that the batch begins with */
    double *cost; /* [batches] */
    shard_work w;
} cut;

static void add_item(cut *c, int index, double cost)
{
    c->begin[c->items] = index;
    c->each[c->items++] = cost;
}

/* The series of a batch: first[0] to first[1] - 1. Those that are not run may stand among them. */
static void series_of(const cut *c, int batch, int from_to[2])
{
    from_to[0] = c->begin[c->first[batch]];
    from_to[1] = c->begin[c->first[batch + 1]];
}

static status compute(void *context, int batch, FILE *to, digest *content, fault *f)
{
    const cut *c = context;
    int range[2];
    series_of(c, batch, range);
    sweep part = *c->s;
    sweep_request alone = *c->request; /* in a process of its own, which nobody asks to end */
    alone.jobs = alone.together = 1;
    alone.interruptible = 0;
    alone.progress = NULL;
    part.series = &c->s->series[range[0]];
    part.seriess = range[1] - range[0];
    TRY(verification_cells(&alone, c->t, &part, f));
    for (int i = range[0]; i < range[1]; i++) {
        if (!cells_runs(c->s, i))
            continue;
        TRY(cells_write(to, c->s, i, content, f));
        cells_forget(&c->s->series[i]);
    }
    return STATUS_OK;
}

static status take(void *context, int batch, FILE *from, fault *f)
{
    const cut *c = context;
    int range[2];
    series_of(c, batch, range);
    for (int i = range[0]; i < range[1]; i++)
        if (cells_runs(c->s, i))
            TRY(cells_read(from, c->s, i, f));
    return STATUS_OK;
}

static int alloc(cut *c)
{
    const size_t count = (size_t)c->s->seriess + 2;
    c->begin = malloc(count * sizeof *c->begin);
    c->each = malloc(count * sizeof *c->each);
    c->first = malloc(count * sizeof *c->first);
    c->cost = malloc(count * sizeof *c->cost);
    return c->begin != NULL && c->each != NULL && c->first != NULL && c->cost != NULL;
}

static void sum_costs(int batches, const int first[], const double each[], double cost[])
{
    for (int b = 0; b < batches; b++) {
        cost[b] = 0;
        for (int i = first[b]; i < first[b + 1]; i++)
            cost[b] += each[i];
    }
}

/* deal_cut, with the cost of each batch; returns their number. */
static int cut_items(int items, const double each[], int first[], double cost[])
{
    double all = 0;
    for (int i = 0; i < items; i++)
        all += each[i];
    const double most = fmin(fmax(batch_share * all, batch_least), batch_most);
    const int batches = deal_cut(items, each, most, first);
    sum_costs(batches, first, each, cost);
    return batches;
}

static void make_batches(cut *c)
{
    for (int i = 0; i < c->s->seriess; i++)
        if (cells_runs(c->s, i))
            add_item(c, i, cells_expense(c->s, i));
    c->begin[c->items] = c->s->seriess;
    c->w.batches = cut_items(c->items, c->each, c->first, c->cost);
}

/* Series of batches that are not there are taken out. */
static status leave_out(const cut *c, const spread_end *end, fault *f)
{
    char *keep = malloc((size_t)c->s->seriess + 1);
    if (keep == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for series");
    memset(keep, 1, (size_t)c->s->seriess);
    for (int b = 0; b < c->w.batches; b++) {
        int range[2];
        series_of(c, b, range);
        for (int i = range[0]; i < range[1] && !end->taken[b]; i++)
            keep[i] = (char)!cells_runs(c->s, i);
    }
    cells_keep(c->s, keep);
    free(keep);
    return STATUS_OK;
}

/* With what verification_work_run frees. */
static status spread(cut *c, const shard_options *r, identity_texts *texts, spread_end *out,
                     fault *f)
{
    digest plan;
    TRY(identity_make(r->line, texts, &plan, f));
    if (!alloc(c))
        return fault_set(f, STATUS_FAULT, "out of memory for batches");
    c->w.cost = c->cost;
    make_batches(c);
    identity_add_sweep(&plan, c->s);
    digest_add(&plan, c->cost, (size_t)c->w.batches * sizeof *c->cost);
    identity_set(texts, &plan, &c->w);
    TRY(spread_work(r, &c->w, out, f));
    return out->ended || out->taken == NULL ? STATUS_OK : leave_out(c, out, f);
}

status verification_work_run(const shard_options *r, const sweep_request *request, truths *t,
                             sweep *s, spread_end *out, fault *f)
{
    identity_texts texts = {.origin = NULL};
    cut c = {.request = request, .t = t, .s = s};
    *out = (spread_end){.ended = 0};
    c.s->shapes = request->shapes;
    c.w = (shard_work){.verb = "verify", .context = &c, .run = compute, .take = take};
    const status outcome = spread(&c, r, &texts, out, f);
    identity_free(&texts);
    free(c.begin);
    free(c.each);
    free(c.first);
    free(c.cost);
    return outcome;
}
