#include "harness/experiments/experiments_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

status shard_parse(const char *text, int *index, int *count, fault *f)
{
    int used = 0;
    if (strlen(text) < 20 && text[0] >= '0' && text[0] <= '9' &&
        sscanf(text, "%d/%d%n", index, count, &used) == 2 && text[used] == '\0' && *count >= 1 &&
        *count <= SHARD_MOST && *index >= 1 && *index <= *count) {
        --*index;
        return STATUS_OK;
    }
    return fault_set(f, STATUS_REFUSED,
                     "--shard '%.40s' is not valid; give K/N for shard K of N shards, such as 1/4 "
                     "for the first of four",
                     text);
}

typedef struct shard_process {
    pid_t process;
    int from; /* end of the pipe that is read; -1: no process is running */
} shard_process;

typedef struct worker_pool {
    batch_worker todo;
    shard_outcome *out;
    shard_process worker[SHARD_MOST_JOBS];
    int jobs, running;
    double cost, cost_done;
    progress line;
} worker_pool;

static status start_process(worker_pool *c, int self, fault *f)
{
    int ends[2];
    const pid_t parent = getpid();
    c->todo.queue->at[self] = -1;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return child_not_started(f);
    c->worker[self].process = fork();
    if (c->worker[self].process == 0) {
        child_begin(parent);
        close(ends[0]);
        batch_worker_run(&c->todo, self, ends[1]);
    }
    close(ends[1]);
    if (c->worker[self].process < 0) {
        close(ends[0]);
        return child_not_started(f);
    }
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    c->worker[self].from = ends[0];
    c->running++;
    return STATUS_OK;
}

/* Closes the pipe of a process and waits for the end of the process. A process that does not end
 * within two seconds is killed. Returns the status from waitpid. */
static int end_process(worker_pool *c, int self)
{
    close(c->worker[self].from);
    c->worker[self].from = -1;
    c->running--;
    return child_reap(c->worker[self].process);
}

static void print_lost(const worker_pool *c, int batch, int how)
{
    char words[80];
    child_ended(how, 0, 0, words, sizeof words);
    if (c->todo.request->messages != NULL)
        fprintf(c->todo.request->messages,
                "beamwork: batch %d is lost, because its process %s; start the shard again with "
                "the same command\n",
                batch + 1, WIFSIGNALED(how) ? words : "ended before the batch was complete");
}

static void clean(const worker_pool *c, int batch, int ended)
{
    char stem[BATCH_STEM], name[BATCH_NAME];
    if (batch < 0)
        return;
    batch_stem(c->todo.w, stem);
    batch_name(stem, batch, name);
    batch_clean(c->todo.request->into, name, ended);
}

static status handle_process(worker_pool *c, int self, fault *f)
{
    batch_report report;
    const int ended = child_has_ended(c->worker[self].process);
    const ssize_t got = read(c->worker[self].from, &report, sizeof report);
    if (got < 0 && (errno == EINTR || errno == EAGAIN) && !ended)
        return STATUS_OK;
    if (got == (ssize_t)sizeof report) {
        if (report.status != STATUS_OK)
            return fault_set(f, report.status, "%s", report.text);
        c->out->done++;
        c->out->seconds += report.seconds;
        c->cost_done += c->todo.w->cost[report.batch];
        char what[40];
        snprintf(what, sizeof what, "batch %d", report.batch + 1);
        if (progress_is_due(&c->line, clock_wall_seconds()))
            progress_show(&c->line, clock_wall_seconds(), c->out->done,
                          c->cost > 0 ? c->cost_done / c->cost : 0, what);
        return STATUS_OK;
    }
    const int how = end_process(c, self), batch = c->todo.queue->at[self];
    if (batch < 0)
        return STATUS_OK;
    c->out->lost++;
    print_lost(c, batch, how);
    clean(c, batch, 1);
    return start_process(c, self, f);
}

static status work_off(worker_pool *c, int requested, fault *f)
{
    struct pollfd ends[SHARD_MOST_JOBS + 1];
    for (int i = 0; i < c->jobs; i++)
        TRY(start_process(c, i, f));
    while (c->running > 0) {
        for (int i = 0; i < c->jobs; i++)
            ends[i] = (struct pollfd){.fd = c->worker[i].from, .events = POLLIN};
        ends[c->jobs] = (struct pollfd){.fd = requested, .events = POLLIN};
        while (poll(ends, (nfds_t)c->jobs + 1, 1000) < 0 && errno == EINTR)
            ;
        if (ends[c->jobs].revents != 0) {
            c->out->interrupted = 1;
            return STATUS_OK;
        }
        for (int i = 0; i < c->jobs; i++)
            if (ends[i].fd >= 0 && (ends[i].revents != 0 || child_has_ended(c->worker[i].process)))
                TRY(handle_process(c, i, f));
    }
    return STATUS_OK;
}

static void end_all(worker_pool *c)
{
    for (int i = 0; i < c->jobs; i++)
        if (c->worker[i].from >= 0) {
            kill(c->worker[i].process, SIGKILL);
            end_process(c, i);
            clean(c, c->todo.queue->at[i], 1);
        }
}

static status run_pool(worker_pool *c, fault *f)
{
    const int own = c->todo.request->stop <= 0;
    interrupt requested = {.descriptor = -1};
    if (own)
        interrupt_begin(&requested);
    c->line =
        progress_begin(c->todo.request->progress, "batches", c->todo.count, clock_wall_seconds());
    const status outcome = work_off(c, own ? requested.descriptor : c->todo.request->stop, f);
    progress_end(&c->line);
    end_all(c);
    if (own)
        interrupt_end(&requested);
    return outcome;
}

static status make_folder(const char *into, fault *f)
{
    if (mkdir(into, 0777) == 0 || errno == EEXIST)
        return STATUS_OK;
    return fault_set(f, STATUS_FAULT,
                     "%.200s: the folder cannot be created (%s); give --into a path in an "
                     "existing, writable folder",
                     into, strerror(errno));
}

/* Lists the missing batches of the shard in decreasing order of cost. mine[batches]: 1 for the
 * batches of the shard. */
static status make_list(worker_pool *c, char mine[], fault *f)
{
    const shard_work *w = c->todo.w;
    batch_store s;
    status outcome =
        batch_store_read(w, &c->todo.request->into, 1, mine, c->todo.request->messages, &s, f);
    if (outcome == STATUS_OK)
        batches_order(w->batches, w->cost, c->todo.list);
    for (int i = 0; outcome == STATUS_OK && i < w->batches; i++) {
        const int batch = c->todo.list[i];
        if (!mine[batch])
            continue;
        c->out->mine++;
        if (s.where[batch] >= 0) {
            c->out->before++;
            continue;
        }
        clean(c, batch, 0);
        c->todo.list[c->todo.count++] = batch;
        c->cost += w->cost[batch];
    }
    batch_store_free(&s);
    return outcome;
}

static status run(worker_pool *c, int shard[], char mine[], fault *f)
{
    const shard_work *w = c->todo.w;
    if (c->todo.list == NULL || shard == NULL || mine == NULL || c->todo.queue == MAP_FAILED ||
        batches_assign(w->batches, w->cost, c->todo.request->count, shard) != 0)
        return fault_memory(f, "batches");
    for (int i = 0; i < w->batches; i++)
        mine[i] = shard[i] == c->todo.request->index;
    TRY(make_folder(c->todo.request->into, f));
    TRY(make_list(c, mine, f));
    c->todo.here = node_here();
    if (c->jobs > SHARD_MOST_JOBS)
        c->jobs = SHARD_MOST_JOBS;
    if (c->jobs > c->todo.count)
        c->jobs = c->todo.count;
    for (int i = 0; i < c->jobs; i++)
        c->worker[i].from = -1;
    return c->todo.count > 0 ? run_pool(c, f) : STATUS_OK;
}

status shard_run(const shard_work *w, const shard_request *request, shard_outcome *out, fault *f)
{
    const size_t count = (size_t)w->batches + 1;
    int *shard = malloc(count * sizeof *shard);
    char *mine = calloc(count, 1);
    worker_pool c = {.todo = {.w = w,
                              .request = request,
                              .list = malloc(count * sizeof *c.todo.list),
                              .queue = mmap(NULL, sizeof *c.todo.queue, PROT_READ | PROT_WRITE,
                                            MAP_SHARED | MAP_ANONYMOUS, -1, 0)},
                     .out = out,
                     .jobs = request->jobs};
    *out = (shard_outcome){.mine = 0};
    const status outcome = run(&c, shard, mine, f);
    if (c.todo.queue != MAP_FAILED)
        munmap(c.todo.queue, sizeof *c.todo.queue);
    free(c.todo.list);
    free(shard);
    free(mine);
    return outcome;
}
