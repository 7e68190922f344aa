#include "harness/study/sweep.h"

#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/study/wire.h"

enum { MAX_JOBS = 64 };

typedef struct task {
    int series, mesh;
} task;

/* Shared by all processes: the next task, and what each worker is at. */
typedef struct board {
    int next;
    int at[MAX_JOBS];
    double since[MAX_JOBS]; /* [s] of a clock that only goes forward: when the worker took it */
} board;

typedef struct worker {
    pid_t process;
    FILE *from;
    int stopped; /* by the clock */
} worker;

cell_request sweep_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const point *p = &s->point[one->point];
    cell_request out = {.type = p->type, .formulation = one->formulation.type, .elements = one->mesh[mesh]};
    memcpy(out.parameter, p->parameter, sizeof out.parameter);
    memcpy(out.option, one->formulation.option, sizeof out.option);
    out.solve.newton = one->formulation.newton;
    out.solve.steps_between = p->steps;
    out.solve.condition = p->condition;
    out.edit = p->edit;
    out.threads = s->threads;
    if (p->text[0] == '\0' && mesh == one->meshes - 1)
        out.solve.shapes = s->shapes;
    return out;
}

static void run_task(const sweep *s, const task *t, cell_result *out)
{
    const cell_request request = sweep_cell(s, t->series, t->mesh);
    fault f = {""};
    cell_run(&request, out, &f);
    scene_free(&out->scene);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Child: takes tasks until none is left. */
static void work(const sweep *s, const task *tasks, int count, board *b, int self, int to)
{
    FILE *out = fdopen(to, "wb");
    for (;;) {
        const int i = __atomic_fetch_add(&b->next, 1, __ATOMIC_SEQ_CST);
        cell_result cell;
        if (i >= count || out == NULL)
            break;
        b->since[self] = now();
        b->at[self] = i;
        run_task(s, &tasks[i], &cell);
        if (fwrite(&i, sizeof i, 1, out) != 1 || wire_write(out, &cell) != 0)
            break;
        b->at[self] = -1;
        cell_result_free(&cell);
    }
    if (out != NULL)
        fclose(out);
    _exit(0);
}

static status start(const sweep *s, const task *tasks, int count, board *b, int self, worker *w, fault *f)
{
    int ends[2];
    if (pipe(ends) != 0)
        return fault_set(f, STATUS_FAULT, "cannot start a worker: no pipe");
    b->at[self] = -1;
    w->stopped = 0;
    w->process = fork();
    if (w->process < 0)
        return fault_set(f, STATUS_FAULT, "cannot start a worker process");
    if (w->process == 0) {
        close(ends[0]);
        work(s, tasks, count, b, self, ends[1]);
    }
    close(ends[1]);
    w->from = fdopen(ends[0], "rb");
    return w->from != NULL ? STATUS_OK : fault_set(f, STATUS_FAULT, "cannot read from a worker");
}

static cell_result *cell_of(sweep *s, const task *t)
{
    return &s->series[t->series].cell[t->mesh];
}

/* A worker that ended while it had a task: that cell failed, another worker takes over. Returns 1 when it must be replaced. */
static int bury(const sweep_request *request, sweep *s, const task *tasks, const board *b, int self, worker *w)
{
    int how = 0;
    fclose(w->from);
    w->from = NULL;
    waitpid(w->process, &how, 0);
    if (b->at[self] < 0)
        return 0;
    cell_result *cell = cell_of(s, &tasks[b->at[self]]);
    cell->solve.status = w->stopped ? STATUS_TIME_LIMIT : STATUS_FAULT;
    if (w->stopped)
        snprintf(cell->solve.reason, sizeof cell->solve.reason, "time limit: no result after %d s", request->time_limit);
    else if (WIFSIGNALED(how))
        snprintf(cell->solve.reason, sizeof cell->solve.reason, "crashed with signal %d", WTERMSIG(how));
    else
        snprintf(cell->solve.reason, sizeof cell->solve.reason, "its process ended with status %d", WEXITSTATUS(how));
    return 1;
}

static void report(const sweep_request *request, const sweep *s, const task *t, int done, int count)
{
    if (request->progress == NULL)
        return;
    const series *one = &s->series[t->series];
    fprintf(request->progress, "\r\033[K%d/%d %s %s n=%d", done, count, s->point[one->point].type->name, one->formulation.key,
            one->mesh[t->mesh]);
    if (done == count)
        fprintf(request->progress, "\r\033[K");
    fflush(request->progress);
}

/* Takes one result from worker `self`; 1: it has ended and is gone. */
static int receive(sweep *s, const task *tasks, int count, worker *w, int *last)
{
    int i = 0;
    if (fread(&i, sizeof i, 1, w->from) != 1 || i < 0 || i >= count || wire_read(w->from, cell_of(s, &tasks[i])) != 0)
        return 1;
    *last = i;
    return 0;
}

/* Ends workers that have been at one cell for too long and have nothing to say; their pipes close. */
static void stop_late(const sweep_request *request, const board *b, int jobs, worker workers[], const struct pollfd ends[])
{
    for (int i = 0; i < jobs && request->time_limit > 0; i++)
        if (workers[i].from != NULL && !workers[i].stopped && ends[i].revents == 0 && b->at[i] >= 0 &&
            now() - b->since[i] > request->time_limit) {
            workers[i].stopped = 1;
            kill(workers[i].process, SIGKILL);
        }
}

static status run_parallel(const sweep_request *request, sweep *s, const task *tasks, int count, board *b, fault *f)
{
    worker workers[MAX_JOBS] = {{0}};
    const int jobs = request->jobs < count ? request->jobs : count;
    int running = 0, done = 0;
    status outcome = STATUS_OK;
    for (int i = 0; i < jobs && outcome == STATUS_OK; i++, running++)
        outcome = start(s, tasks, count, b, i, &workers[i], f);
    while (running > 0 && outcome == STATUS_OK) {
        struct pollfd ends[MAX_JOBS];
        for (int i = 0; i < jobs; i++)
            ends[i] = (struct pollfd){.fd = workers[i].from != NULL ? fileno(workers[i].from) : -1, .events = POLLIN};
        if (poll(ends, (nfds_t)jobs, request->time_limit > 0 ? 100 : -1) < 0)
            continue;
        stop_late(request, b, jobs, workers, ends);
        for (int i = 0; i < jobs && outcome == STATUS_OK; i++) {
            int last = 0;
            if (workers[i].from == NULL || !(ends[i].revents & (POLLIN | POLLHUP)))
                continue;
            if (!receive(s, tasks, count, &workers[i], &last)) {
                report(request, s, &tasks[last], ++done, count);
            } else {
                const int lost = bury(request, s, tasks, b, i, &workers[i]);
                done += lost;
                if (lost || workers[i].stopped)
                    outcome = start(s, tasks, count, b, i, &workers[i], f);
                else
                    running--;
            }
        }
    }
    for (int i = 0; i < jobs; i++)
        if (workers[i].from != NULL) {
            kill(workers[i].process, SIGKILL);
            bury(request, s, tasks, b, i, &workers[i]);
        }
    if (outcome == STATUS_OK && done < count)
        outcome = fault_set(f, STATUS_FAULT, "the worker processes ended before all cells were done (%d of %d)", done, count);
    return outcome;
}

status sweep_run(const sweep_request *request, sweep *s, fault *f)
{
    const int count = sweep_cells(s);
    task *tasks = calloc((size_t)count + 1, sizeof *tasks);
    board *b = mmap(NULL, sizeof *b, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    status outcome = STATUS_OK;
    if (tasks == NULL || b == MAP_FAILED) {
        free(tasks);
        return fault_set(f, STATUS_FAULT, "out of memory for the sweep");
    }
    int n = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0;
             k < s->series[i].meshes && s->series[i].missing[0] == '\0' && s->point[s->series[i].point].status == STATUS_OK; k++)
            tasks[n++] = (task){i, k};
    /* Even one job runs in a process of its own, so that a crash is a result and answers do not depend on the number. */
    s->shapes = request->shapes;
    sweep_request bounded = *request;
    bounded.jobs = request->jobs < MAX_JOBS ? request->jobs : MAX_JOBS;
    outcome = run_parallel(&bounded, s, tasks, count, b, f);
    munmap(b, sizeof *b);
    free(tasks);
    return outcome;
}
