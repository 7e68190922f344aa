#include "harness/study/study_impl.h"

#include <errno.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

static void report(progress *p, const workload *w, int last)
{
    const double now = clock_wall_seconds();
    const workload_task *t = &w->tasks[last];
    const series *one = &w->s->series[t->series];
    char what[SCENE_NAME + FORMULATION_KEY + 32];
    if (!progress_is_due(p, now))
        return;
    snprintf(what, sizeof what, "%s, %s, n = %d", w->s->point[one->point].type->name,
             one->formulation.key, one->mesh[t->mesh]);
    p->count = w->due;
    progress_show(p, now, w->finished, workload_share(w), what);
}

static status attend(progress *p, workload *w, int self, worker *one, int *running, fault *f)
{
    const int i = worker_receive(w, one);
    if (i >= 0)
        report(p, w, i);
    if (i == WORKER_NO_MEMORY)
        return fault_memory(f, "results");
    if (i != WORKER_ENDED)
        return STATUS_OK;
    if (worker_handle_end(w, self, one))
        return worker_start(w, self, one, f);
    --*running;
    return STATUS_OK;
}

/* Waits for workers or for a request to stop. Returns 1 if the run must stop. */
static int wait_for_any(const workload *w, int jobs, const worker workers[], int requested,
                        struct pollfd ends[])
{
    const int interval = workload_can_pass(w) ? 0 : w->time_limit > 0 ? 100 : 1000;
    for (int i = 0; i < jobs; i++)
        ends[i] = (struct pollfd){.fd = workers[i].from, .events = POLLIN};
    ends[jobs] = (struct pollfd){.fd = requested, .events = POLLIN};
    while (poll(ends, (nfds_t)jobs + 1, interval) < 0 && errno == EINTR)
        ;
    return ends[jobs].revents != 0;
}

typedef struct cell_pool {
    int jobs, running, interrupted;
    int requested; /* becomes readable when a stop is requested; -1: none */
    worker workers[WORKERS_MOST];
} cell_pool;

static status start_all(const workload *w, cell_pool *c, fault *f)
{
    for (int i = 0; i < c->jobs; i++) {
        TRY(worker_start(w, i, &c->workers[i], f));
        c->running++;
    }
    return STATUS_OK;
}

static status attend_all(progress *p, workload *w, cell_pool *c, const struct pollfd ends[],
                         fault *f)
{
    for (int i = 0; i < c->jobs; i++) {
        worker *one = &c->workers[i];
        if (one->from < 0)
            continue;
        if (ends[i].revents != 0 || child_has_ended(one->process))
            TRY(attend(p, w, i, one, &c->running, f));
        else
            worker_stop_late(w, i, one);
    }
    return STATUS_OK;
}

static status work_off(progress *p, workload *w, cell_pool *c, fault *f)
{
    struct pollfd ends[WORKERS_MOST + 1];
    TRY(start_all(w, c, f));
    while (c->running > 0) {
        c->interrupted = wait_for_any(w, c->jobs, c->workers, c->requested, ends);
        if (c->interrupted)
            break;
        TRY(attend_all(p, w, c, ends, f));
        if (workload_can_pass(w))
            TRY(workload_pass(w, f));
    }
    return STATUS_OK;
}

static status run_parallel(const sweep_request *request, workload *w, cell_pool *c, fault *f)
{
    progress p =
        progress_begin(request->progress, request->things != NULL ? request->things : "runs",
                       w->count, clock_wall_seconds());
    const status outcome = work_off(&p, w, c, f);
    progress_end(&p);
    for (int i = 0; i < c->jobs; i++)
        if (c->workers[i].from >= 0)
            worker_end(w, &c->workers[i]);
    return outcome;
}

static status check_all_done(const workload *w, fault *f)
{
    if (w->out_of_memory)
        return fault_memory(f, "measuring rounding scatter");
    if (w->finished < w->due)
        return fault_set(
            f, STATUS_FAULT,
            "all worker processes ended after %d of %d runs; use fewer processes (--jobs)",
            w->finished, w->due);
    return STATUS_OK;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static status pass_all(workload *w, fault *f)
{
    while (workload_can_pass(w))
        TRY(workload_pass(w, f));
    return STATUS_OK;
}

static status run_all(const sweep_request *request, workload *w, fault *f)
{
    interrupt requested = {.descriptor = -1};
    if (request->interruptible)
        interrupt_begin(&requested);
    else if (request->stop > 0)
        requested.descriptor = request->stop;
    cell_pool c = {.jobs = smaller(smaller(request->jobs, WORKERS_MOST), w->count),
                   .requested = requested.descriptor};
    for (int i = 0; i < c.jobs; i++)
        c.workers[i].from = -1;
    status outcome = run_parallel(request, w, &c, f);
    if (c.interrupted)
        workload_keep_whole(w);
    else if (outcome == STATUS_OK)
        outcome = check_all_done(w, f);
    if (request->interruptible)
        interrupt_end(&requested);
    return outcome == STATUS_OK ? pass_all(w, f) : outcome;
}

/* Cells run in separate processes even if there is only one job. */
status run_sweep(const sweep_request *request, sweep *s, fault *f)
{
    workload w;
    status outcome = workload_begin(request, s, &w, f);
    if (outcome == STATUS_OK) {
        s->shapes = request->shapes;
        s->unfinished = 0;
        outcome = run_all(request, &w, f);
    }
    workload_end(&w);
    return outcome;
}

enum { COLUMNS = 79, LINE = 400 };
/* [s] time between two outputs, and time before the remaining time is first estimated */
static const double interval = 0.2, first_word = 1;
/* smallest completed fraction from which the remaining time is estimated */
static const double least_share = 0.01;

progress progress_begin(FILE *to, const char *things, int count, double now)
{
    return (progress){.to = to, .things = things, .count = count, .begun = now, .last = now};
}

int progress_is_due(const progress *p, double now)
{
    return p->to != NULL && now - p->last >= interval;
}

static int columns_of(FILE *to)
{
    struct winsize size = {0};
    if (ioctl(fileno(to), TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return COLUMNS;
    return size.ws_col - 1;
}

static void write_time(double seconds, char *text, size_t size)
{
    const int minutes = (int)(seconds / 60 + 0.5);
    if (seconds < 90)
        snprintf(text, size, "%.0f s", seconds);
    else if (minutes < 60)
        snprintf(text, size, "%d min", minutes);
    else
        snprintf(text, size, "%d h %d min", minutes / 60, minutes % 60);
}

static void write_over(progress *p, const char *line)
{
    const int most = columns_of(p->to);
    const int width = fprintf(p->to, "\r%.*s", most, line) - 1;
    for (int i = width; i < p->width; i++)
        fputc(' ', p->to);
    fputc('\r', p->to);
    fflush(p->to);
    p->width = width;
}

void progress_show(progress *p, double now, int done, double share, const char *what)
{
    char line[LINE], left[64], words[96] = "";
    const double spent = now - p->begun;
    if (p->to == NULL)
        return;
    if (share >= least_share && spent >= first_word) {
        write_time(spent * (1 - share) / share, left, sizeof left);
        snprintf(words, sizeof words, ", about %s left", left);
    }
    snprintf(line, sizeof line, "%s %d of %d, %.0f %%%s: %s", p->things, done, p->count,
             100 * share, words, what);
    write_over(p, line);
    p->last = now;
}

void progress_end(progress *p)
{
    if (p->to != NULL && p->width > 0)
        write_over(p, "");
}

static int is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

void interrupt_begin(interrupt *out)
{
    static const int number[] = {SIGINT, SIGTERM, SIGHUP};
    sigset_t wanted;
    sigemptyset(&wanted);
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++)
        if (!is_ignored(number[i]))
            sigaddset(&wanted, number[i]);
    sigprocmask(SIG_BLOCK, &wanted, &out->before);
    out->descriptor = signalfd(-1, &wanted, SFD_CLOEXEC | SFD_NONBLOCK);
    if (out->descriptor < 0)
        sigprocmask(SIG_SETMASK, &out->before, NULL);
}

void interrupt_end(interrupt *out)
{
    struct signalfd_siginfo requested;
    if (out->descriptor < 0)
        return;
    while (read(out->descriptor, &requested, sizeof requested) > 0)
        ;
    close(out->descriptor);
    out->descriptor = -1;
    sigprocmask(SIG_SETMASK, &out->before, NULL);
}
