#include "harness/experiments/forecast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/batch.h"
#include "harness/experiments/deal.h"
#include "harness/experiments/shard.h"

static status no_memory(fault *f)
{
    return fault_set(f, STATUS_FAULT, "out of memory for a plan");
}

static int first_free(int jobs, const double until[])
{
    int found = 0;
    for (int i = 1; i < jobs; i++)
        if (until[i] < until[found])
            found = i;
    return found;
}

/* until[shards * jobs]: when each process is free; shard and order: of each batch. */
static void walk(const work *w, const double seconds[], const int shard[], const int order[],
                 int jobs, double until[], forecast *out)
{
    double all = 0;
    for (int i = 0; i < w->batches; i++) {
        double *own = &until[(size_t)shard[order[i]] * (size_t)jobs];
        own[first_free(jobs, own)] += seconds[order[i]];
        all += seconds[order[i]];
    }
    out->longest = 0;
    for (int i = 0; i < out->shards * jobs; i++)
        out->longest = fmax(out->longest, until[i]);
    out->efficiency = out->longest > 0 ? all / (out->longest * out->shards * jobs) : 1;
}

static void count_most(const work *w, const int shard[], int count[], forecast *out)
{
    out->most = 0;
    for (int i = 0; i < w->batches; i++)
        if (++count[shard[i]] > out->most)
            out->most = count[shard[i]];
}

status forecast_of(const work *w, const double seconds[], int shards, int jobs, forecast *out,
                   fault *f)
{
    const size_t batches = (size_t)w->batches + 1, processes = (size_t)shards * (size_t)jobs;
    int *shard = malloc(batches * sizeof *shard), *order = malloc(batches * sizeof *order);
    int *count = calloc((size_t)shards, sizeof *count);
    double *until = calloc(processes, sizeof *until);
    const int good = shard != NULL && order != NULL && count != NULL && until != NULL &&
                     deal_out(w->batches, w->cost, shards, shard) == 0;
    *out = (forecast){.shards = shards};
    if (good) {
        deal_order(w->batches, w->cost, order);
        walk(w, seconds, shard, order, jobs, until, out);
        count_most(w, shard, count, out);
    }
    free(shard);
    free(order);
    free(count);
    free(until);
    return good ? STATUS_OK : no_memory(f);
}

/* seconds[batch] of one that is there, else it stays below zero. */
static status read_batch(const work *w, const char *folder, int batch, double seconds[], fault *f)
{
    char stem[BATCH_STEM], name[BATCH_NAME], path[PATH_MAX];
    batch_label label;
    batch_stem(w, stem);
    batch_name(stem, batch, name);
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path ||
        batch_read_label(path, &label, NULL) != STATUS_OK)
        return STATUS_OK;
    const status outcome = batch_belongs(&label, w, path, f);
    if (outcome == STATUS_OK)
        seconds[batch] = label.processor_seconds;
    batch_label_free(&label);
    return outcome;
}

static int ascending(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Of the batches that are there: the common factor, and how far single ones are from it. */
static status compare(const work *w, forecast_seconds *out, fault *f)
{
    double cost = 0, all = 0;
    int count = 0;
    double *off = malloc(((size_t)w->batches + 1) * sizeof *off);
    if (off == NULL)
        return no_memory(f);
    for (int i = 0; i < w->batches; i++)
        if (out->seconds[i] >= 0) {
            out->measured++;
            cost += w->cost[i];
            all += out->seconds[i];
        }
    out->factor = cost > 0 && all > 0 ? all / cost : 1;
    for (int i = 0; i < w->batches; i++)
        if (out->seconds[i] > 0 && w->cost[i] > 0)
            off[count++] = fabs(log(out->seconds[i] / (w->cost[i] * out->factor)));
    qsort(off, (size_t)count, sizeof *off, ascending);
    out->median = count > 0 ? exp(off[count / 2]) : 1;
    out->tenth = count > 0 ? exp(off[(int)(0.9 * (count - 1))]) : 1;
    free(off);
    return STATUS_OK;
}

status forecast_read(const work *w, const char *folder, forecast_seconds *out, fault *f)
{
    *out = (forecast_seconds){.seconds = malloc(((size_t)w->batches + 1) * sizeof(double))};
    if (out->seconds == NULL)
        return no_memory(f);
    for (int i = 0; i < w->batches; i++)
        out->seconds[i] = -1;
    for (int i = 0; i < w->batches && folder != NULL; i++)
        TRY(read_batch(w, folder, i, out->seconds, f));
    TRY(compare(w, out, f));
    if (folder != NULL && out->measured == 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s: no batches of this %s, asked so and of this build, are in it",
                         folder, w->verb);
    for (int i = 0; i < w->batches; i++)
        if (out->seconds[i] < 0)
            out->seconds[i] = w->cost[i] * out->factor;
    return STATUS_OK;
}

void forecast_free(forecast_seconds *s)
{
    free(s->seconds);
    *s = (forecast_seconds){.measured = 0};
}

static void tell_batches(const work *w, const forecast_seconds *s, const char *folder, int jobs,
                         FILE *to)
{
    double all = 0, dearest = 0;
    for (int i = 0; i < w->batches; i++) {
        all += s->seconds[i];
        dearest = fmax(dearest, s->seconds[i]);
    }
    fprintf(
        to,
        "%s: %d batch%s, about %.3g s of one processor, the dearest %.3g s; %d process%s a shard\n",
        w->verb, w->batches, w->batches == 1 ? "" : "es", all, dearest, jobs,
        jobs == 1 ? "" : "es");
    if (s->measured > 0)
        fprintf(to,
                "%d of them as measured in %s: %.3g times what was expected; single batches differ "
                "from that by a factor %.2f in the median, %.2f for nine of ten\n",
                s->measured, folder, s->factor, s->median, s->tenth);
}

static status tell_rows(const work *w, const forecast_seconds *s, int shards, int jobs, FILE *to,
                        fault *f)
{
    fprintf(to, "%8s %10s %13s %12s %11s\n", "shards", "processes", "most batches", "longest [s]",
            "efficiency");
    for (long n = 1;; n = n * 2 < shards ? n * 2 : shards) {
        forecast row;
        TRY(forecast_of(w, s->seconds, (int)n, jobs, &row, f));
        fprintf(to, "%8ld %10ld %13d %12.3g %11.2f\n", n, n * jobs, row.most, row.longest,
                row.efficiency);
        if (n == shards)
            return STATUS_OK;
    }
}

status forecast_tell(const work *w, const char *folder, int shards, int jobs, FILE *to, fault *f)
{
    forecast_seconds s;
    status outcome = forecast_read(w, folder, &s, f);
    if (outcome == STATUS_OK) {
        tell_batches(w, &s, folder, jobs, to);
        outcome = tell_rows(w, &s, shards, jobs, to, f);
    }
    forecast_free(&s);
    return outcome;
}
