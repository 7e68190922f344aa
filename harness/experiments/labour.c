#include "harness/experiments/labour.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

/* Of this process and those that it has waited for. */
static double processor_seconds(void)
{
    static const int whose[] = {RUSAGE_SELF, RUSAGE_CHILDREN};
    double all = 0;
    for (int i = 0; i < 2; i++) {
        struct rusage used;
        getrusage(whose[i], &used);
        all += (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
               1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    }
    return all;
}

/* One batch, from nothing to its file. */
static status compute(const labour *c, int batch, double *seconds, fault *f)
{
    const shard_work *w = c->w;
    char *bytes = NULL;
    size_t size = 0;
    digest content = digest_begin();
    batch_label label = {.batch = batch,
                         .batches = w->batches,
                         .shard = c->request->index,
                         .shards = c->request->count,
                         .node = c->here};
    const double begun = clock_wall_seconds(), worked = processor_seconds();
    FILE *to = open_memstream(&bytes, &size);
    if (to == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a batch");
    status outcome = w->run(w->context, batch, to, &content, f);
    if (fclose(to) != 0 && outcome == STATUS_OK)
        outcome = fault_set(f, STATUS_FAULT, "out of memory for a batch");
    *seconds = clock_wall_seconds() - begun;
    if (outcome == STATUS_OK) {
        snprintf(label.verb, sizeof label.verb, "%s", w->verb);
        snprintf(label.build, sizeof label.build, "%s", w->build);
        snprintf(label.request, sizeof label.request, "%s", w->request);
        snprintf(label.plan, sizeof label.plan, "%s", w->plan);
        label.seconds = *seconds;
        label.processor_seconds = processor_seconds() - worked;
        label.origin = w->origin != NULL ? json_loads(w->origin, 0, NULL) : NULL;
        digest_text(&content, label.content);
        outcome = batch_write(c->request->into, &label, bytes, size, f);
        batch_label_free(&label);
    }
    free(bytes);
    return outcome;
}

void labour_work(const labour *c, int self, int to)
{
    labour_shelf *s = c->shelf;
    for (;;) {
        const int i = atomic_fetch_add(&s->next, 1);
        if (i >= c->count)
            break;
        labour_notice said;
        fault f = {""};
        memset(&said, 0, sizeof said);
        said.batch = c->list[i];
        s->at[self] = said.batch;
        said.status = compute(c, said.batch, &said.seconds, &f);
        memcpy(said.text, f.text, sizeof said.text);
        if (write(to, &said, sizeof said) != (ssize_t)sizeof said)
            break;
        s->at[self] = -1;
        if (said.status != STATUS_OK)
            break;
    }
    _exit(0);
}
