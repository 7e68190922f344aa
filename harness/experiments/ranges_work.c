#include "harness/experiments/ranges_work.h"

#include <stdlib.h>

#include "harness/experiments/ranges_csv.h"
#include "harness/experiments/ranges_solve.h"

static void add_numbers(digest *to, const double value[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        digest_add_number(to, value[i]);
}

/* All but the times. */
static void add_content(digest *to, const rows *w)
{
    const size_t points = (size_t)w->points, known = points * (size_t)w->shape.quantities,
                 cells = points * (size_t)w->shape.formulations * (size_t)w->shape.meshes,
                 values = cells * (size_t)w->shape.quantities,
                 leasts = known * (size_t)w->shape.formulations;
    add_numbers(to, w->reference, known);
    add_numbers(to, w->doubt, known);
    add_numbers(to, w->value, values);
    add_numbers(to, w->error, values);
    add_numbers(to, w->cost, cells);
    digest_add(to, w->least, leasts * sizeof *w->least);
    digest_add(to, w->kind, known);
    digest_add(to, w->status, cells);
}

static status run(void *context, int batch, FILE *to, digest *content, fault *f)
{
    const ranges_work *own = context;
    rows w;
    status outcome = ranges_solve(own->of, batch, &w, f);
    if (outcome == STATUS_OK && rows_write(to, &w) != 0)
        outcome = fault_set(f, STATUS_FAULT, "batch %d cannot be handed on", batch + 1);
    if (outcome == STATUS_OK)
        add_content(content, &w);
    rows_free(&w);
    return outcome;
}

static status keep(ranges_work *own, int batch, FILE *from, rows *w, fault *f)
{
    long first;
    const rows_shape shape = ranges_shape(own->of);
    const int points = ranges_batch(own->of, batch, &first);
    TRY(rows_alloc(&shape, points, w, f));
    if (rows_read(from, w) != 0)
        return fault_set(f, STATUS_FAULT, "batch %d cannot be read", batch + 1);
    add_content(&own->content, w);
    if (own->tally != NULL)
        TRY(tally_add(own->tally, first, w, f));
    if (own->csv != NULL && !own->csv_begun)
        ranges_csv_head(own->csv, own->of);
    own->csv_begun = 1;
    if (own->csv != NULL)
        TRY(ranges_csv_add(own->csv, own->of, first, w, f));
    return own->file != NULL ? ranges_file_add(own->file, first, w, f) : STATUS_OK;
}

static status take(void *context, int batch, FILE *from, fault *f)
{
    rows w = {.first = NULL};
    const status outcome = keep(context, batch, from, &w, f);
    rows_free(&w);
    return outcome;
}

status ranges_work_make(const parameter_ranges *r, ranges_work *out, fault *f)
{
    *out = (ranges_work){.of = r, .content = digest_begin()};
    out->cost = calloc((size_t)r->batches + 1, sizeof *out->cost);
    if (out->cost == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for batches");
    for (int i = 0; i < r->batches; i++) {
        long first;
        out->cost[i] = ranges_batch(r, i, &first) * r->point_cost;
    }
    return STATUS_OK;
}

void ranges_work_free(ranges_work *w)
{
    free(w->cost);
    w->cost = NULL;
}

shard_work ranges_work_of(ranges_work *w)
{
    return (shard_work){.verb = "sweep",
                        .batches = w->of->batches,
                        .cost = w->cost,
                        .context = w,
                        .run = run,
                        .take = take};
}
