/* Work for tests. Each batch consists of some numbers. The result is the sum of all numbers in the
 * order of the batches. */
#ifndef BEAMWORK_TEST_NUMBER_WORK_H
#define BEAMWORK_TEST_NUMBER_WORK_H

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/experiments/experiments.h"
#include "harness/numerics/numerics.h"
#include "harness/records/test/folder.h"

enum { NUMBERS_BATCHES = 40 };

typedef struct numbers {
    int crashes; /* number of the batch whose process ends early, or -1 */
    int fails;   /* number of the batch whose computation fails, or -1 */
    int wait;    /* [us] duration of a batch */
    double busy;
    double sign; /* sign of the numbers; -1 gives other results */
    int taken, next;
    double sum;
} numbers;

static inline int numbers_in(int batch)
{
    return 1 + batch * 7 % 5;
}

static inline status numbers_run(void *context, int batch, FILE *to, digest *content, fault *f)
{
    const numbers *n = context;
    const double begun = clock_processor_seconds();
    while (clock_processor_seconds() - begun < n->busy)
        ;
    if (n->wait > 0)
        usleep((useconds_t)n->wait);
    if (batch == n->crashes)
        kill(getpid(), SIGKILL);
    if (batch == n->fails)
        return fault_set(f, STATUS_FAULT, "batch %d has no room", batch);
    for (int i = 0; i < numbers_in(batch); i++) {
        const double value = n->sign * sin(100.0 * batch + i);
        fwrite(&value, sizeof value, 1, to);
        digest_add_number(content, value);
    }
    return STATUS_OK;
}

/* Adds the numbers of a batch. The sum is changed before each addition, so the result depends on
 * the order. */
static inline status numbers_take(void *context, int batch, FILE *from, fault *f)
{
    numbers *n = context;
    gsl_test(batch < n->next, "batch %d comes in order", batch);
    for (int i = 0; i < numbers_in(batch); i++) {
        double value = NAN;
        if (fread(&value, sizeof value, 1, from) != 1)
            return fault_set(f, STATUS_FAULT, "a batch is incomplete");
        n->sum = 0.9 * n->sum + value;
    }
    n->taken++;
    n->next = batch + 1;
    return STATUS_OK;
}

typedef struct numbers_work {
    numbers n;
    double cost[NUMBERS_BATCHES];
    shard_work w;
} numbers_work;

/* Prepares the work. The structure contains a pointer to itself, so it must not be copied. */
static inline void numbers_begin(numbers_work *out)
{
    out->n = (numbers){.crashes = -1, .fails = -1, .sign = 1};
    for (int i = 0; i < NUMBERS_BATCHES; i++)
        out->cost[i] = 1 + i * 5 % 7;
    out->w = (shard_work){.verb = "numbers",
                          .build = "build 1",
                          .request = "all",
                          .plan = "0123456789abcdef",
                          .origin = "{\"arguments\": [\"numbers\"]}",
                          .batches = NUMBERS_BATCHES,
                          .cost = out->cost,
                          .context = &out->n,
                          .run = numbers_run,
                          .take = numbers_take};
}

/* Returns the result of all batches if this process computes them alone. */
static inline double numbers_alone(void)
{
    numbers_work here;
    double sum = 0;
    numbers_begin(&here);
    for (int b = 0; b < NUMBERS_BATCHES; b++)
        for (int i = 0; i < numbers_in(b); i++)
            sum = 0.9 * sum + sin(100.0 * b + i);
    return sum;
}

static inline status numbers_shard(const numbers_work *of, const char *into, int index, int count,
                                   shard_outcome *out, fault *f)
{
    const shard_request request = {.index = index, .count = count, .into = into, .jobs = 3};
    return shard_run(&of->w, &request, out, f);
}

static inline status numbers_merge(numbers_work *of, const char *const folder[], int folders,
                                   batch_store *s, fault *f)
{
    of->n.taken = of->n.next = 0;
    of->n.sum = 0;
    TRY(batch_store_read(&of->w, folder, folders, NULL, NULL, s, f));
    return merge_read(&of->w, s, f);
}

static inline void numbers_are_whole(numbers_work *of, const char *const folder[], int folders,
                                     const char *what)
{
    batch_store s = {0};
    fault f = {""};
    gsl_test(numbers_merge(of, folder, folders, &s, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test_int(of->n.taken, NUMBERS_BATCHES, "%s: each once", what);
    gsl_test(of->n.sum != numbers_alone(), "%s: the same bits as in one process", what);
    batch_store_free(&s);
}

#endif
