#include "harness/study/study_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

typedef struct requested {
    const workload *w;
    const cell_request *request;
    scene_edit edit;
    int task, same;
} requested;

static void add_request(identity *out, const workload *w, const requested *a)
{
    const sweep_point *p = &w->s->point[w->s->series[w->tasks[a->task].series].point];
    const solve_options *o = &a->request->solve;
    const void *const type = p->type;
    const double amount = a->edit.amount;
    const int count = parameters_count(p->type);
    const int numbers[] = {a->edit.kind,
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
    requested *a = context;
    identity what = identity_begin();
    add_request(&what, a->w, a);
    if (!identity_add_model(&what, m))
        return 0;
    const int first = task_locks_acquire(a->w->known, &what, a->task);
    a->same = first != a->task ? first : -1;
    return a->same >= 0;
}

static void run_again(const workload *w, const requested *a, cell_request *request,
                      cell_result *out)
{
    const sweep_point *p = &w->s->point[w->s->series[w->tasks[a->task].series].point];
    scene edited;
    fault f = {""};
    request->scene = &edited;
    request->solve.values_only = 1;
    request->solve.condition = request->solve.shapes = 0;
    *out = (cell_result){.solve.status = STATUS_OK};
    if (cell_scene(p->type, p->parameter, &a->edit, &edited, &f) == STATUS_OK) {
        scene_keep_quantities(&edited, &p->scene);
        cell_run(request, out, &f);
    }
    scene_free(&edited);
}

/* Runs a task. Returns -1 if *out has the results; otherwise, the task that has the same
 * results. */
static int run_task(const workload *w, int i, int alone, cell_result *out)
{
    cell_request request = sweep_cell(w->s, w->tasks[i].series, w->tasks[i].mesh);
    requested a = {w, &request, workload_edit(w, i), i, -1};
    fault f = {""};
    if (w->known != NULL && !alone) {
        request.is_known = is_known;
        request.context = &a;
    }
    child_alarm(w->time_limit);
    if (w->tasks[i].again > 0)
        run_again(w, &a, &request, out);
    else
        cell_run(&request, out, &f);
    child_alarm(0);
    return a.same;
}

typedef struct heading {
    int task, same;
    size_t bytes;
} heading;

static int write_all(int to, const char *bytes, size_t count)
{
    while (count > 0) {
        const ssize_t done = write(to, bytes, count);
        if (done < 0 && errno != EINTR)
            return -1;
        bytes += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
    return 0;
}

/* Sends a result or a reference to a task with the same results. Returns 0, or -1 if the pipe has
 * no reader. */
static int send_result(int to, int i, int same, const cell_result *cell)
{
    heading head = {.task = i, .same = same};
    char *bytes = NULL;
    size_t size = 0;
    FILE *text = open_memstream(&bytes, &size);
    int bad = text == NULL || fwrite(&head, sizeof head, 1, text) != 1 ||
              (same < 0 && serialise_write(text, cell) != 0);
    if (text != NULL)
        bad |= fclose(text) != 0;
    if (!bad) {
        head.bytes = size - sizeof head;
        memcpy(bytes, &head, sizeof head);
        bad = write_all(to, bytes, size) != 0;
    }
    free(bytes);
    return bad ? -1 : 0;
}

static void work(const workload *w, int self, int to)
{
    int alone, i, bad = 0;
    while (!bad && (i = workload_take(w, self, &alone)) >= 0) {
        cell_result cell;
        const int same = run_task(w, i, alone, &cell);
        bad = send_result(to, i, same, &cell) != 0;
        if (!bad)
            w->board->at[self] = -1;
        cell_result_free(&cell);
    }
    _exit(bad);
}

status worker_start(const workload *w, int self, worker *out, fault *f)
{
    int ends[2];
    const pid_t parent = getpid();
    if (pipe2(ends, O_CLOEXEC) != 0)
        return child_not_started(f);
    w->board->at[self] = -1;
    *out = (worker){.from = -1};
    out->process = fork();
    if (out->process < 0) {
        close(ends[0]);
        close(ends[1]);
        return child_not_started(f);
    }
    if (out->process == 0) {
        child_begin(parent);
        close(ends[0]);
        work(w, self, ends[1]);
    }
    close(ends[1]);
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    out->from = ends[0];
    return STATUS_OK;
}

static int grow(worker *from)
{
    enum { LEAST = 1 << 16 };
    if (from->room - from->count >= LEAST)
        return 0;
    const size_t room = 2 * from->room + LEAST;
    char *more = realloc(from->bytes, room);
    if (more == NULL)
        return -1;
    from->bytes = more;
    from->room = room;
    return 0;
}

/* Stores a result that has been received. Returns 0, SERIALISE_DAMAGED or SERIALISE_NO_MEMORY. */
static int take_result(workload *w, const heading *head, char *bytes)
{
    if (head->same >= 0) {
        workload_same(w, head->task, head->same);
        return 0;
    }
    FILE *in = fmemopen(bytes, head->bytes, "rb");
    const int bad =
        in == NULL ? SERIALISE_NO_MEMORY : serialise_read(in, workload_cell(w, head->task));
    if (in != NULL)
        fclose(in);
    if (bad == 0)
        workload_done(w, head->task);
    return bad;
}

static int is_heading(const workload *w, const heading *head)
{
    enum { LARGEST = 1 << 30 }; /* [bytes] */
    return head->task >= 0 && head->task < w->all && !w->done[head->task] && head->same < w->all &&
           head->bytes <= LARGEST && (head->same >= 0 ? head->bytes == 0 : head->bytes > 0);
}

static int corrupted(worker *from)
{
    from->damaged = 1;
    kill(from->process, SIGKILL);
    return WORKER_ENDED;
}

/* Reads all complete results. */
static int take_whole(workload *w, worker *from)
{
    size_t at = 0;
    int last = WORKER_NOTHING;
    heading head;
    while (from->count - at >= sizeof head) {
        memcpy(&head, from->bytes + at, sizeof head);
        if (!is_heading(w, &head))
            return corrupted(from);
        if (from->count - at - sizeof head < head.bytes)
            break;
        const int bad = take_result(w, &head, from->bytes + at + sizeof head);
        if (bad != 0)
            return bad == SERIALISE_NO_MEMORY ? WORKER_NO_MEMORY : corrupted(from);
        last = head.task;
        at += sizeof head + head.bytes;
    }
    memmove(from->bytes, from->bytes + at, from->count - at);
    from->count -= at;
    return last;
}

int worker_receive(workload *w, worker *from)
{
    ssize_t got;
    const int ended = child_has_ended(from->process);
    if (grow(from) != 0)
        return WORKER_NO_MEMORY;
    do
        got = read(from->from, from->bytes + from->count, from->room - from->count);
    while (got < 0 && errno == EINTR);
    if (got < 0 && errno == EAGAIN && !ended)
        return WORKER_NOTHING;
    if (got <= 0)
        return WORKER_ENDED;
    from->count += (size_t)got;
    return take_whole(w, from);
}

static int wait_for_end(worker *w)
{
    close(w->from);
    free(w->bytes);
    w->from = -1;
    w->bytes = NULL;
    return child_reap(w->process);
}

int worker_handle_end(workload *w, int self, worker *dead)
{
    const int how = wait_for_end(dead), i = w->board->at[self];
    if (w->together && !dead->stopped && !dead->damaged && WIFSIGNALED(how) &&
        WTERMSIG(how) == SIGKILL)
        kill(getpid(), SIGKILL);
    sem_post(&w->board->changed);
    if (i < 0 || w->done[i])
        return dead->stopped || i >= 0;
    solve_result *r = &workload_cell(w, i)->solve;
    const int late = child_ended(how, dead->stopped, w->time_limit, r->reason, sizeof r->reason);
    if (dead->damaged)
        snprintf(r->reason, sizeof r->reason, "the worker process wrote an invalid result");
    r->status = late ? STATUS_TIME_LIMIT : STATUS_FAULT;
    workload_done(w, i);
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
    int got;
    kill(one->process, SIGKILL);
    do
        got = worker_receive(w, one);
    while (got >= 0 || got == WORKER_NOTHING);
    wait_for_end(one);
}

static void default_alarm(void)
{
    sigset_t alarm_only;
    sigemptyset(&alarm_only);
    sigaddset(&alarm_only, SIGALRM);
    signal(SIGALRM, SIG_DFL);
    sigprocmask(SIG_UNBLOCK, &alarm_only, NULL);
}

status child_not_started(fault *f)
{
    return fault_set(f, STATUS_FAULT, "cannot start a process (%s); use fewer processes (--jobs)",
                     strerror(errno));
}

void child_begin(pid_t parent)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(0);
    default_alarm();
}

void child_alarm(int seconds)
{
    const struct itimerval limit = {.it_value = {.tv_sec = seconds}};
    setitimer(ITIMER_REAL, &limit, NULL);
}

int child_has_ended(pid_t process)
{
    siginfo_t how = {.si_pid = 0};
    return waitid(P_PID, (id_t)process, &how, WEXITED | WNOHANG | WNOWAIT) != 0 || how.si_pid != 0;
}

int child_reap(pid_t process)
{
    enum { POLLS = 200 };
    int how = 0;
    for (int i = 0; i < POLLS && !child_has_ended(process); i++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    if (!child_has_ended(process))
        kill(process, SIGKILL);
    waitpid(process, &how, 0);
    return how;
}

int child_ended(int how, int late, int seconds, char *words, size_t size)
{
    const int over = late || (WIFSIGNALED(how) && WTERMSIG(how) == SIGALRM);
    if (over)
        snprintf(words, size, "time limit: there was no result within %d s", seconds);
    else if (WIFSIGNALED(how))
        snprintf(words, size, "crashed with signal %d", WTERMSIG(how));
    else
        snprintf(words, size, "the worker process ended with status %d", WEXITSTATUS(how));
    return over;
}
