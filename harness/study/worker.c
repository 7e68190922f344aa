#include "harness/study/worker.h"

#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/algebra/clock.h"
#include "harness/study/child.h"
#include "harness/study/serialise.h"

static cell_result *cell_of(const workload *w, int i)
{
    return &w->s->series[w->tasks[i].series].cell[w->tasks[i].mesh];
}

static void run_task(const workload *w, int i, cell_result *out)
{
    const cell_request request = sweep_cell(w->s, w->tasks[i].series, w->tasks[i].mesh);
    fault f = {""};
    child_alarm(w->time_limit);
    cell_run(&request, out, &f);
    child_alarm(0);
}

/* Child: takes tasks until none is left. */
static void work(const workload *w, int self, int to)
{
    FILE *out = fdopen(to, "wb");
    board *b = w->board;
    while (out != NULL) {
        const int i = atomic_fetch_add(&b->next, 1);
        cell_result cell;
        if (i >= w->count)
            break;
        b->since[self] = clock_wall_seconds();
        b->at[self] = i;
        run_task(w, i, &cell);
        if (fwrite(&i, sizeof i, 1, out) != 1 || serialise_write(out, &cell) != 0)
            break;
        b->at[self] = -1;
        cell_result_free(&cell);
    }
    if (out != NULL)
        fclose(out);
    _exit(0);
}

status worker_start(const workload *w, int self, worker *out, fault *f)
{
    int ends[2];
    const pid_t parent = getpid();
    if (pipe(ends) != 0)
        return fault_set(f, STATUS_FAULT, "cannot start a worker: no pipe");
    w->board->at[self] = -1;
    out->stopped = 0;
    out->process = fork();
    if (out->process < 0) {
        close(ends[0]);
        close(ends[1]);
        return fault_set(f, STATUS_FAULT, "cannot start a worker process");
    }
    if (out->process == 0) {
        child_begin(parent);
        close(ends[0]);
        work(w, self, ends[1]);
    }
    close(ends[1]);
    out->from = fdopen(ends[0], "rb");
    return out->from != NULL ? STATUS_OK : fault_set(f, STATUS_FAULT, "cannot read from a worker");
}

static void mark_done(workload *w, int i)
{
    w->finished += !w->done[i];
    w->done[i] = 1;
}

int worker_receive(workload *w, worker *from)
{
    int i = 0;
    if (fread(&i, sizeof i, 1, from->from) != 1 || i < 0 || i >= w->count ||
        serialise_read(from->from, cell_of(w, i)) != 0)
        return -1;
    mark_done(w, i);
    return i;
}

static int reap(worker *w)
{
    int how = 0;
    fclose(w->from);
    w->from = NULL;
    waitpid(w->process, &how, 0);
    return how;
}

int worker_bury(workload *w, int self, worker *dead)
{
    const int how = reap(dead), i = w->board->at[self];
    if (i < 0)
        return dead->stopped;
    solve_result *r = &cell_of(w, i)->solve;
    const int late = child_ended(how, dead->stopped, w->time_limit, r->reason, sizeof r->reason);
    r->status = late ? STATUS_TIME_LIMIT : STATUS_FAULT;
    mark_done(w, i);
    return 1;
}

void worker_stop_late(const workload *w, int self, worker *one)
{
    const board *b = w->board;
    if (w->time_limit <= 0 || one->stopped || b->at[self] < 0 ||
        clock_wall_seconds() - b->since[self] <= w->time_limit)
        return;
    one->stopped = 1;
    kill(one->process, SIGKILL);
}

void worker_end(workload *w, worker *one)
{
    kill(one->process, SIGKILL);
    while (worker_receive(w, one) >= 0)
        ;
    reap(one);
}
