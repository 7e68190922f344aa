#include "harness/cli/extreme_work.h"

#include <stdlib.h>
#include <string.h>

#include "harness/cli/cells.h"
#include "harness/cli/spread.h"
#include "harness/cli/sweep_work.h"
#include "harness/experiments/deal.h"
#include "harness/study/run.h"

typedef struct extreme_work {
    const extreme_request *request;
    const char *truths;
    extreme_sweep plan; /* its first cells are filled when batches are taken ... */
    sweep more;         /* ... and here the neighbouring meshes, in their order */
    point none;         /* of these: nothing is known of it */
    int items;          /* extremes that are asked for */
    int *extreme;       /* [items + 1] their index, and behind them that of all */
    int *series;        /* [items + 1] first of their series */
    double *each;       /* [items] cost */
    int *first;         /* [batches + 1] item that a batch begins with */
    double *cost;       /* [batches] */
    work w;
} extreme_work;

/* In the process of a batch: one worker; who kills it from outside kills the batch. */
static status run_alone(void *context, const sweep_request *request, sweep *s, fault *f)
{
    sweep_request alone = *request;
    (void)context;
    alone.jobs = 1;
    alone.together = 1;
    alone.progress = NULL;
    return run_sweep(&alone, s, f);
}

static status write_sweep(FILE *to, const sweep *s, digest *content, fault *f)
{
    if (fwrite(&s->seriess, sizeof s->seriess, 1, to) != 1)
        return fault_set(f, STATUS_FAULT, "out of memory for a batch");
    for (int i = 0; i < s->seriess; i++)
        if (cells_runs(s, i))
            TRY(cells_write(to, s, i, content, f));
    return STATUS_OK;
}

static status compute(void *context, int batch, FILE *to, digest *content, fault *f)
{
    const extreme_work *c = context;
    extreme_request part = *c->request;
    extreme_sweep s = {0};
    part.first = c->extreme[c->first[batch]];
    part.last = c->extreme[c->first[batch + 1]];
    part.cells = run_alone;
    TRY(extreme_run(&part, c->truths, &s, f));
    status outcome = write_sweep(to, &s.first, content, f);
    if (outcome == STATUS_OK)
        outcome = write_sweep(to, &s.neighbours, content, f);
    extreme_sweep_free(&s);
    return outcome;
}

/* One more series of neighbouring meshes, without cells. */
static status add_series(extreme_work *c, fault *f)
{
    series *more = realloc(c->more.series, ((size_t)c->more.seriess + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for series");
    c->more.series = more;
    memset(&more[c->more.seriess], 0, sizeof *more);
    more[c->more.seriess].meshes = OUTCOME_NEIGHBOURS;
    more[c->more.seriess].cell = calloc(OUTCOME_NEIGHBOURS, sizeof *more->cell);
    return more[c->more.seriess++].cell != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for results");
}

static status take(void *context, int batch, FILE *from, fault *f)
{
    extreme_work *c = context;
    const int begin = c->series[c->first[batch]], end = c->series[c->first[batch + 1]];
    int count = 0;
    if (fread(&count, sizeof count, 1, from) != 1 || count != end - begin)
        return fault_set(f, STATUS_FAULT, "batch %d is of other extremes", batch + 1);
    for (int i = begin; i < end; i++)
        if (cells_runs(&c->plan.first, i))
            TRY(cells_read(from, &c->plan.first, i, f));
    if (fread(&count, sizeof count, 1, from) != 1)
        return fault_set(f, STATUS_FAULT, "a batch ends too soon");
    for (int i = 0; i < count; i++) {
        TRY(add_series(c, f));
        TRY(cells_read(from, &c->more, c->more.seriess - 1, f));
    }
    return STATUS_OK;
}

/* The cells of batches in the place of those that would be run: first all, then the neighbours. */
static status fill(void *context, const sweep_request *request, sweep *s, fault *f)
{
    extreme_work *c = context;
    (void)request;
    sweep *from = c->plan.first.seriess > 0 ? &c->plan.first : &c->more;
    if (s->seriess != from->seriess)
        return fault_set(f, STATUS_FAULT, "the batches have the cells of %d series, not of %d",
                         from->seriess, s->seriess);
    for (int i = 0; i < s->seriess; i++) {
        cell_result *const cells = s->series[i].cell;
        s->series[i].cell = from->series[i].cell;
        from->series[i].cell = cells;
    }
    if (from == &c->plan.first)
        sweep_free(from);
    return STATUS_OK;
}

static int alloc(extreme_work *c)
{
    size_t count = 2;
    while (extremes[count - 2].name != NULL)
        count++;
    c->extreme = malloc(count * sizeof *c->extreme);
    c->series = malloc(count * sizeof *c->series);
    c->each = malloc(count * sizeof *c->each);
    c->first = malloc(count * sizeof *c->first);
    c->cost = malloc(count * sizeof *c->cost);
    return c->extreme != NULL && c->series != NULL && c->each != NULL && c->first != NULL &&
           c->cost != NULL;
}

/* Outcomes of one series, and of one extreme, follow each other. */
static void make_items(extreme_work *c)
{
    const extreme_sweep *s = &c->plan;
    for (int i = 0; i < s->outcomes; i++) {
        const extreme_outcome *o = &s->outcome[i];
        if (i == 0 || o[-1].extreme != o->extreme) {
            c->extreme[c->items] = o->extreme;
            c->series[c->items] = o->series;
            c->each[c->items++] = 0;
        }
        if ((i == 0 || o[-1].series != o->series) && cells_runs(&s->first, o->series))
            c->each[c->items - 1] += cells_expense(&s->first, o->series);
    }
    c->extreme[c->items] = c->items > 0 ? c->extreme[c->items - 1] + 1 : 0;
    c->series[c->items] = s->first.seriess;
}

/* With what extreme_work_run frees. */
static status spread(extreme_work *c, const shard_options *r, identity_texts *texts,
                     spread_end *out, fault *f)
{
    digest plan;
    TRY(identity_make(r->line, texts, &plan, f));
    TRY(extreme_plan(c->request, &c->plan, f));
    if (!alloc(c))
        return fault_set(f, STATUS_FAULT, "out of memory for batches");
    make_items(c);
    c->w.batches = sweep_work_cut(c->items, c->each, c->first, c->cost);
    c->w.cost = c->cost;
    identity_add_sweep(&plan, &c->plan.first);
    identity_set(texts, &plan, &c->w);
    return spread_work(r, &c->w, 0, out, f);
}

static void free_all(extreme_work *c)
{
    extreme_sweep_free(&c->plan);
    c->more.points = 0;
    c->more.point = NULL;
    sweep_free(&c->more);
    free(c->extreme);
    free(c->series);
    free(c->each);
    free(c->first);
    free(c->cost);
}

status extreme_work_run(const shard_options *r, const extreme_request *request, const char *path,
                        extreme_sweep *s, spread_end *out, fault *f)
{
    int asked;
    *out = (spread_end){.ended = 0};
    TRY(spread_asked(r, &asked, f));
    if (!asked)
        return extreme_run(request, path, s, f);
    if (r->partial)
        return fault_set(f, STATUS_REFUSED,
                         "stress judges all extremes together: compute the batches that are "
                         "missing, and leave --partial away");
    identity_texts texts = {.origin = NULL};
    extreme_work c = {.request = request, .truths = path};
    c.w = (work){.verb = "stress", .context = &c, .run = compute, .take = take};
    c.more.points = 1;
    c.more.point = &c.none;
    status outcome = spread(&c, r, &texts, out, f);
    extreme_request merged = *request;
    merged.cells = fill;
    merged.context = &c;
    if (outcome == STATUS_OK && !out->ended)
        outcome = extreme_run(&merged, path, s, f);
    identity_free(&texts);
    free_all(&c);
    return outcome;
}
