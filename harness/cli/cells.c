#include "harness/cli/cli_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int cells_runs(const sweep *s, int index)
{
    const series *one = &s->series[index];
    return one->missing[0] == '\0' && one->imported == NULL &&
           s->point[one->point].status == STATUS_OK;
}

static double cells_expense(const sweep *s, int index)
{
    double all = 0;
    for (int k = 0; k < s->series[index].meshes; k++)
        all += run_cost_of_cell(s, index, k);
    return all;
}

static void add_numbers(digest *to, const double *value, int count)
{
    for (int i = 0; value != NULL && i < count; i++)
        digest_add_number(to, value[i]);
}

static void add_quantity(digest *to, const quantity_result *q)
{
    digest_add_number(to, q->status);
    digest_add_number(to, q->value);
    digest_add_number(to, q->x);
    add_numbers(to, q->curve.x, q->curve.points);
    add_numbers(to, q->curve.value, q->curve.points);
}

static void add_cell(digest *to, const cell_result *cell)
{
    const solve_result *r = &cell->solve;
    const counters *c = &cell->counters;
    const double work[] = {(double)c->iterations,         (double)c->steps,
                           (double)c->rejected_steps,     (double)c->factorisations,
                           (double)c->strain_evaluations, (double)c->stress_evaluations,
                           (double)cell->size.free,       (double)cell->size.elements};
    digest_add_number(to, r->status);
    digest_add_text(to, r->reason);
    for (int q = 0; q < r->quantities; q++)
        add_quantity(to, &r->quantity[q]);
    for (int k = 0; k < r->matrix_sets; k++) {
        add_numbers(to, r->matrices[k].compliance, 36 * r->matrices[k].stations);
        add_numbers(to, r->matrices[k].stiffness, 36 * r->matrices[k].stations);
    }
    add_numbers(to, work, sizeof work / sizeof work[0]);
}

static int put_array(FILE *to, const void *array, size_t size)
{
    const int there = array != NULL;
    return fwrite(&there, sizeof there, 1, to) == 1 &&
           (!there || size == 0 || fwrite(array, size, 1, to) == 1);
}

static int get_array(FILE *from, void **array, size_t size)
{
    int there;
    *array = NULL;
    if (fread(&there, sizeof there, 1, from) != 1)
        return 0;
    if (!there)
        return 1;
    *array = calloc(size + 1, 1);
    return *array != NULL && (size == 0 || fread(*array, size, 1, from) == 1);
}

static size_t noise_size(const sweep *s, const series *one)
{
    return (size_t)s->point[one->point].scene.quantities * sizeof *one->noise;
}

status cells_write(FILE *to, const sweep *s, int index, digest *content, fault *f)
{
    const series *one = &s->series[index];
    const size_t meshes = (size_t)one->meshes;
    int good = 1;
    digest_add_text(content, one->formulation.key);
    for (int k = 0; k < one->meshes; k++) {
        add_cell(content, &one->cell[k]);
        good = good && serialise_write(to, &one->cell[k]) == 0;
    }
    add_numbers(content, one->noise, s->point[one->point].scene.quantities);
    good = good && put_array(to, one->noise, noise_size(s, one)) &&
           put_array(to, one->timing, meshes * sizeof *one->timing);
    return good ? STATUS_OK : fault_memory(f, "a batch");
}

status cells_read(FILE *from, sweep *s, int index, fault *f)
{
    series *one = &s->series[index];
    const size_t meshes = (size_t)one->meshes;
    void *noise = NULL, *timing = NULL;
    int good = 1;
    for (int k = 0; k < one->meshes && good; k++) {
        cell_result_free(&one->cell[k]);
        good = serialise_read(from, &one->cell[k]) == 0;
    }
    good = good && get_array(from, &noise, noise_size(s, one)) &&
           get_array(from, &timing, meshes * sizeof *one->timing);
    one->noise = noise;
    one->timing = timing;
    return good ? STATUS_OK : fault_set(f, STATUS_FAULT, "a batch is incomplete; compute it again");
}

void cells_free_results(series *one)
{
    for (int k = 0; k < one->meshes; k++)
        cell_result_free(&one->cell[k]);
    free(one->noise);
    free(one->timing);
    one->noise = NULL;
    one->timing = NULL;
}

void cells_keep(sweep *s, const char keep[])
{
    int kept = 0;
    for (int i = 0; i < s->seriess; i++) {
        if (!keep[i]) {
            s->unfinished += s->series[i].meshes;
            sweep_series_free(&s->series[i]);
        } else
            s->series[kept++] = s->series[i];
    }
    s->seriess = kept;
    s->partial = s->unfinished > 0;
}

/* The estimated cost of a batch on the reference machine is at most batch_share times all work, but
 * this bound is not below batch_least or above batch_most [s]. */
static const double batch_most = 0.5, batch_least = 0.02, batch_share = 1.0 / 32;

typedef struct cut {
    const sweep_request *request;
    truths *t;
    sweep *s;
    int items;
    int *begin;   /* [items + 1] first series of each item, followed by the number of series */
    double *each; /* [items] cost of each item */
    int *first;   /* [batches + 1] first item of each batch */
    double *cost; /* [batches] cost of each batch */
    shard_work w;
} cut;

static void add_item(cut *c, int index, double cost)
{
    c->begin[c->items] = index;
    c->each[c->items++] = cost;
}

/* Sets from_to to the range of series of a batch, from_to[0] to from_to[1] - 1. */
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
    sweep_request alone = *c->request;
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
        cells_free_results(&c->s->series[i]);
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

/* Divides the items into batches: sets the first item of each batch (batches_cut) and the cost of
 * each batch. Returns the number of batches. */
static int cut_items(int items, const double each[], int first[], double cost[])
{
    double all = 0;
    for (int i = 0; i < items; i++)
        all += each[i];
    const double most = fmin(fmax(batch_share * all, batch_least), batch_most);
    const int batches = batches_cut(items, each, most, first);
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

static status leave_out(const cut *c, const spread_end *end, fault *f)
{
    char *keep = malloc((size_t)c->s->seriess + 1);
    if (keep == NULL)
        return fault_memory(f, "series");
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

static status spread(cut *c, const shard_options *r, identity_texts *texts, spread_end *out,
                     fault *f)
{
    digest plan;
    TRY(identity_make(r->line, texts, &plan, f));
    if (!alloc(c))
        return fault_memory(f, "batches");
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
