#include "harness/study/run.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "harness/algebra/clock.h"
#include "harness/study/expense.h"
#include "harness/study/interrupt.h"
#include "harness/study/progress.h"
#include "harness/study/worker.h"

/* Of the whole work, by what cells cost. */
static double share_done(const workload *w)
{
    double done = 0, all = 0;
    for (int i = 0; i < w->count; i++) {
        const double cost = expense_of_cell(w->s, w->tasks[i].series, w->tasks[i].mesh);
        all += cost;
        done += w->done[i] || w->same[i] >= 0 ? cost : 0;
    }
    return all > 0 ? done / all : 0;
}

static void report(progress *p, const workload *w, int last)
{
    const double now = clock_wall_seconds();
    const task *t = &w->tasks[last];
    const series *one = &w->s->series[t->series];
    char what[SCENE_NAME + FORMULATION_KEY + 32];
    if (!progress_is_due(p, now))
        return;
    snprintf(what, sizeof what, "%s, %s, n = %d", w->s->point[one->point].type->name,
             one->formulation.key, one->mesh[t->mesh]);
    progress_show(p, now, w->finished, share_done(w), what);
}

/* One worker that has something to say, or has ended. *running: workers there are. */
static status attend(progress *p, workload *w, int self, worker *one, int *running, fault *f)
{
    const int i = worker_receive(w, one);
    if (i >= 0) {
        report(p, w, i);
        return STATUS_OK;
    }
    if (worker_bury(w, self, one))
        return worker_start(w, self, one, f);
    --*running;
    return STATUS_OK;
}

/* Waits for the workers and for whoever asks to end. 1: somebody did. */
static int wait_for_any(const workload *w, int jobs, const worker workers[], int asked,
                        struct pollfd ends[])
{
    /* [ms] the clocks of the workers are looked at so often */
    const int interval = w->time_limit > 0 ? 100 : -1;
    for (int i = 0; i < jobs; i++)
        ends[i] = (struct pollfd){.fd = workers[i].from != NULL ? fileno(workers[i].from) : -1,
                                  .events = POLLIN};
    ends[jobs] = (struct pollfd){.fd = asked, .events = POLLIN};
    while (poll(ends, (nfds_t)jobs + 1, interval) < 0 && errno == EINTR)
        ;
    return ends[jobs].revents != 0;
}

/* The processes that run, and who may ask them to end. */
typedef struct crew {
    int jobs, running, interrupted;
    int asked; /* descriptor that can be read once somebody asks to end; -1: nobody can */
    worker workers[WORKERS_MOST];
} crew;

static status start_all(const workload *w, crew *c, fault *f)
{
    for (int i = 0; i < c->jobs; i++) {
        TRY(worker_start(w, i, &c->workers[i], f));
        c->running++;
    }
    return STATUS_OK;
}

/* Those that have something to say; the others may be late. */
static status attend_all(progress *p, workload *w, crew *c, const struct pollfd ends[], fault *f)
{
    for (int i = 0; i < c->jobs; i++) {
        worker *one = &c->workers[i];
        if (one->from == NULL)
            continue;
        if (ends[i].revents != 0)
            TRY(attend(p, w, i, one, &c->running, f));
        else
            worker_stop_late(w, i, one);
    }
    return STATUS_OK;
}

static status work_off(progress *p, workload *w, crew *c, fault *f)
{
    struct pollfd ends[WORKERS_MOST + 1];
    TRY(start_all(w, c, f));
    while (c->running > 0) {
        c->interrupted = wait_for_any(w, c->jobs, c->workers, c->asked, ends);
        if (c->interrupted)
            break;
        TRY(attend_all(p, w, c, ends, f));
    }
    return STATUS_OK;
}

static status run_parallel(const sweep_request *request, workload *w, crew *c, fault *f)
{
    progress p =
        progress_begin(request->progress, request->things != NULL ? request->things : "cells",
                       w->count, clock_wall_seconds());
    const status outcome = work_off(&p, w, c, f);
    progress_end(&p);
    for (int i = 0; i < c->jobs; i++)
        if (c->workers[i].from != NULL)
            worker_end(w, &c->workers[i]);
    worker_settle(w);
    return outcome;
}

/* Those whose answers are another's which then had none are run by themselves. */
static status run_rounds(const sweep_request *request, workload *w, crew *c, fault *f)
{
    TRY(run_parallel(request, w, c, f));
    if (!c->interrupted && w->finished < w->count && w->known != NULL) {
        w->known = NULL;
        atomic_store(&w->board->next, 0);
        TRY(run_parallel(request, w, c, f));
    }
    if (!c->interrupted && w->finished < w->count)
        return fault_set(f, STATUS_FAULT,
                         "the worker processes ended before all cells were done (%d of %d)",
                         w->finished, w->count);
    return STATUS_OK;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* Series with a cell that was not run are taken out: they show nothing. */
static void keep_finished(sweep *s, const workload *w)
{
    char *open = calloc((size_t)s->seriess + 1, 1);
    int kept = 0;
    s->unfinished = w->count - w->finished;
    if (open != NULL)
        for (int i = 0; i < w->count; i++)
            open[w->tasks[i].series] |= !w->done[i];
    for (int i = 0; i < s->seriess; i++)
        if (open == NULL || open[i])
            sweep_series_free(&s->series[i]);
        else
            s->series[kept++] = s->series[i];
    s->seriess = kept;
    free(open);
}

static status run_all(const sweep_request *request, workload *w, fault *f)
{
    interrupt asked = {.descriptor = -1};
    if (request->interruptible)
        interrupt_begin(&asked);
    else if (request->stop > 0)
        asked.descriptor = request->stop;
    crew c = {.jobs = smaller(smaller(request->jobs, WORKERS_MOST), w->count),
              .asked = asked.descriptor};
    const status outcome = run_rounds(request, w, &c, f);
    if (c.interrupted)
        keep_finished(w->s, w);
    if (request->interruptible)
        interrupt_end(&asked);
    return outcome;
}

/* Even one job runs in a process of its own, so that a crash is a result and answers do not depend
 * on the number. */
status run_sweep(const sweep_request *request, sweep *s, fault *f)
{
    const size_t count = (size_t)sweep_cells(s);
    board *b = mmap(NULL, sizeof *b, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    workload w = {.s = s,
                  .time_limit = request->time_limit,
                  .together = request->together,
                  .count = (int)count,
                  .tasks = calloc(count + 1, sizeof *w.tasks),
                  .done = calloc(count + 1, 1),
                  .same = malloc((count + 1) * sizeof *w.same),
                  .board = b};
    claims *known = request->share ? claims_alloc((int)count) : NULL;
    status outcome = fault_set(f, STATUS_FAULT, "out of memory for the sweep");
    w.known = known;
    if (w.tasks != NULL && w.done != NULL && w.same != NULL && b != MAP_FAILED &&
        expense_order(s, w.tasks) == 0) {
        for (int i = 0; i < w.count; i++)
            w.same[i] = -1;
        s->shapes = request->shapes;
        s->unfinished = 0;
        outcome = run_all(request, &w, f);
    }
    if (b != MAP_FAILED)
        munmap(b, sizeof *b);
    claims_free(known);
    free(w.tasks);
    free(w.done);
    free(w.same);
    return outcome;
}
