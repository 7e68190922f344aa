#include "harness/study/worker.h"

#include <signal.h>
#include <stdlib.h>
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

/* A task, and the one with the same answers. */
typedef struct asked {
    const workload *w;
    const cell_request *request;
    int task, same;
} asked;

/* What a cell's answers depend on, beside its model: the words that its scene is made from, and
 * what of it is asked for. */
static void add_request(identity *out, const workload *w, const asked *a)
{
    const point *p = &w->s->point[w->s->series[w->tasks[a->task].series].point];
    const solve_options *o = &a->request->solve;
    const void *const type = p->type;
    const double amount = p->edit.amount;
    const int count = parameters_count(p->type);
    const int numbers[] = {p->edit.kind,
                           o->newton,
                           o->max_iterations,
                           o->steps_between,
                           o->condition,
                           o->phases,
                           o->sample,
                           o->shapes,
                           o->systems,
                           o->values_only,
                           a->request->elements,
                           a->request->keep_all,
                           a->request->threads,
                           p->scene.quantities};
    identity_add(out, &type, sizeof type);
    identity_add(out, p->parameter, (size_t)count * sizeof *p->parameter);
    identity_add(out, &amount, sizeof amount);
    identity_add(out, &o->criterion, sizeof o->criterion);
    identity_add(out, numbers, sizeof numbers);
}

static int is_known(void *context, const model *m)
{
    asked *a = context;
    identity what = identity_begin();
    add_request(&what, a->w, a);
    if (!identity_add_model(&what, m))
        return 0;
    const int first = claims_take(a->w->known, &what, a->task);
    a->same = first != a->task ? first : -1;
    return a->same >= 0;
}

/* The task with the same answers, or -1: then *out has them. */
static int run_task(const workload *w, int i, cell_result *out)
{
    cell_request request = sweep_cell(w->s, w->tasks[i].series, w->tasks[i].mesh);
    asked a = {w, &request, i, -1};
    fault f = {""};
    if (w->known != NULL) {
        request.is_known = is_known;
        request.context = &a;
    }
    child_alarm(w->time_limit);
    cell_run(&request, out, &f);
    child_alarm(0);
    return a.same;
}

/* Which task, whose answers it has where they are another's, and else the answers. */
static int tell(FILE *to, int i, int same, const cell_result *cell)
{
    const int head[] = {i, same};
    if (fwrite(head, sizeof head, 1, to) != 1)
        return -1;
    return same < 0 ? serialise_write(to, cell) : fflush(to);
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
        if (w->done[i])
            continue;
        b->since[self] = clock_wall_seconds();
        b->at[self] = i;
        const int same = run_task(w, i, &cell);
        if (tell(out, i, same, &cell) != 0)
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
    int head[2];
    if (fread(head, sizeof head, 1, from->from) != 1)
        return -1;
    const int i = head[0], same = head[1];
    if (i < 0 || i >= w->count || same >= w->count)
        return -1;
    if (same >= 0) {
        w->same[i] = same;
        return i;
    }
    if (serialise_read(from->from, cell_of(w, i)) != 0)
        return -1;
    mark_done(w, i);
    return i;
}

/* 0: copied. */
static int copy(const cell_result *from, cell_result *to)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&bytes, &size);
    int bad = out == NULL || serialise_write(out, from) != 0;
    if (out != NULL)
        bad |= fclose(out) != 0;
    FILE *in = bad ? NULL : fmemopen(bytes, size, "rb");
    bad |= in == NULL || serialise_read(in, to) != 0;
    if (in != NULL)
        fclose(in);
    free(bytes);
    return bad;
}

void worker_settle(workload *w)
{
    for (int i = 0; i < w->count; i++) {
        const int same = w->same[i];
        if (w->done[i] || same < 0 || !w->done[same] || cell_of(w, same)->solve.status != STATUS_OK)
            continue;
        if (copy(cell_of(w, same), cell_of(w, i)) == 0)
            mark_done(w, i);
    }
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
    if (w->together && !dead->stopped && WIFSIGNALED(how) && WTERMSIG(how) == SIGKILL)
        kill(getpid(), SIGKILL);
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
