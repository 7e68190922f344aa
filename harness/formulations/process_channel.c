#include "harness/formulations/formulations_impl.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

/* Ends a child of this process: immediately if `now` is 1, otherwise after a short time in which it
 * may exit. Returns its status from waitpid; -1: this function killed the child, or there is no
 * child of this process. For a child of another process, only the channels are closed. */
static int child_end(child *, int now);

enum { TO_READ, TO_WRITE };

static void close_both(const int ends[2])
{
    close(ends[TO_READ]);
    close(ends[TO_WRITE]);
}

static void become(char *const words[], int in, int out, int why, pid_t parent)
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    signal(SIGPIPE, SIG_DFL);
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0)
        execvp(words[0], words);
    const int number = errno;
    if (write(why, &number, sizeof number) != sizeof number)
        _exit(126);
    _exit(127);
}

/* Opens a pipe whose descriptors are not 0, 1 or 2. */
static int pipe_above(int ends[2])
{
    int low[2];
    if (pipe2(low, O_CLOEXEC) != 0)
        return -1;
    for (int i = 0; i < 2; i++)
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 3);
    close_both(low);
    if (ends[0] >= 0 && ends[1] >= 0)
        return 0;
    for (int i = 0; i < 2; i++)
        if (ends[i] >= 0)
            close(ends[i]);
    return -1;
}

static status no_process(const char *command, fault *f)
{
    return fault_set(
        f, STATUS_FAULT,
        "exec: '%.100s' cannot be started (%s); close other programs, and run the command again",
        command, strerror(errno));
}

static status child_start(char *const words[], child *out, fault *f)
{
    int in[2], from[2], why[2], number = 0;
    const pid_t parent = getpid();
    if (pipe_above(in) != 0)
        return no_process(words[0], f);
    if (pipe_above(from) != 0) {
        close_both(in);
        return no_process(words[0], f);
    }
    if (pipe_above(why) != 0) {
        close_both(in);
        close_both(from);
        return no_process(words[0], f);
    }
    const pid_t made = fork();
    if (made == 0)
        become(words, in[TO_READ], from[TO_WRITE], why[TO_WRITE], parent);
    close(in[TO_READ]);
    close(from[TO_WRITE]);
    close(why[TO_WRITE]);
    *out = (child){made > 0 ? made : 0, parent, in[TO_WRITE], from[TO_READ]};
    fcntl(out->to, F_SETFL, O_NONBLOCK);
    fcntl(out->from, F_SETFL, O_NONBLOCK);
    const int refused =
        made > 0 && read(why[TO_READ], &number, sizeof number) == (ssize_t)sizeof number;
    close(why[TO_READ]);
    if (made > 0 && !refused)
        return STATUS_OK;
    child_end(out, 1);
    if (made < 0)
        return no_process(words[0], f);
    return fault_set(f, STATUS_REFUSED,
                     "exec: '%.100s' cannot be run (%s); give an existing, executable program, as "
                     "in 'exec:python3 my_beam.py'",
                     words[0], strerror(number));
}

static int child_runs(const child *c)
{
    siginfo_t how = {.si_pid = 0};
    return c->process > 0 && c->owner == getpid() &&
           waitid(P_PID, (id_t)c->process, &how, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           how.si_pid == 0;
}

static int child_end(child *c, int now)
{
    int how = -1;
    const child was = *c;
    *c = (child){.process = 0};
    if (was.owner == 0)
        return -1;
    close(was.to);
    close(was.from);
    if (was.process == 0 || was.owner != getpid())
        return -1;
    for (int i = 0; i < 100 && !now; i++) {
        if (waitpid(was.process, &how, WNOHANG) != 0)
            return how;
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    }
    kill(-was.process, SIGKILL);
    kill(was.process, SIGKILL);
    waitpid(was.process, &how, 0);
    return -1;
}

/* Waits until the child has written or has closed its output, or, if `to` is POLLOUT, accepts
 * input. end: time of clock_wall_seconds at which the time limit expires; 0: no limit. Returns 0
 * after the time limit. */
static int await(const child *c, short to, double end)
{
    struct pollfd at[2] = {{.fd = to ? c->to : -1, .events = to},
                           {.fd = c->from, .events = POLLIN}};
    int wait = -1, found;
    do {
        if (end > 0) {
            const double left = end - clock_wall_seconds();
            if (left <= 0)
                return 0;
            wait = left < 1e6 ? (int)(1e3 * left) + 1 : 1000000000;
        }
        found = poll(at, 2, wait);
    } while (found == 0 || (found < 0 && errno == EINTR));
    return found;
}

static double end_of(int limit)
{
    return limit > 0 ? clock_wall_seconds() + limit : 0;
}

/* Like write(), but returns EPIPE without raising a signal. */
static ssize_t write_quietly(int to, const void *bytes, size_t count)
{
    sigset_t pipe_only, before, pending;
    sigemptyset(&pipe_only);
    sigaddset(&pipe_only, SIGPIPE);
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, &pipe_only, &before);
    const ssize_t written = write(to, bytes, count);
    const int number = errno;
    if (written < 0 && number == EPIPE && !sigismember(&pending, SIGPIPE))
        sigtimedwait(&pipe_only, NULL, &(struct timespec){0});
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    errno = number;
    return written;
}

/* Writes all bytes. limit: time limit [s] for all of them; 0: none. Returns CHILD_WROTE if the
 * child writes before they are written. */
static child_event child_write(const child *c, const void *bytes, size_t count, int limit)
{
    const char *from = bytes;
    const double end = end_of(limit);
    while (count > 0) {
        struct pollfd readable_end = {.fd = c->from, .events = POLLIN};
        if (poll(&readable_end, 1, 0) > 0)
            return readable_end.revents & POLLIN ? CHILD_WROTE : CHILD_ENDED;
        const ssize_t written = write_quietly(c->to, from, count);
        if (written < 0 && errno == EAGAIN) {
            if (!await(c, POLLOUT, end))
                return CHILD_LATE;
        } else if (written < 0 && errno != EINTR) {
            return CHILD_ENDED;
        } else if (written > 0) {
            from += written;
            count -= (size_t)written;
        }
    }
    return CHILD_DONE;
}

/* Reads at least `least` and at most `most` bytes. *count: number of bytes that were read, also if
 * the child has ended or is late. */
static child_event child_read(const child *c, void *bytes, size_t least, size_t most, size_t *count,
                              int limit)
{
    char *to = bytes;
    const double end = end_of(limit);
    *count = 0;
    while (*count < least) {
        if (!await(c, 0, end))
            return CHILD_LATE;
        const ssize_t found = read(c->from, to + *count, most - *count);
        if (found == 0 || (found < 0 && errno != EAGAIN && errno != EINTR))
            return CHILD_ENDED;
        *count += found > 0 ? (size_t)found : 0;
    }
    return CHILD_DONE;
}

static const char mark[8] = {'b', 'e', 'a', 'm', 'w', 'o', 'r', 'k'};
enum { MESSAGE = 300 };

status channel_init(channel *c, const char *command, fault *f)
{
    const size_t room = strlen(command) + 80;
    *c = (channel){.program_name = malloc(room), .limit = 120};
    if (c->program_name == NULL)
        return fault_memory(f, "a formulation");
    snprintf(c->program_name, room, "exec:%s", command);
    pthread_mutex_init(&c->lock, NULL);
    return words_split(command, &c->words, f);
}

status channel_call(channel *c, const char *name, fault *f)
{
    const size_t room = strlen(name) + 20;
    char *program_name = malloc(room);
    if (program_name == NULL)
        return fault_memory(f, "a formulation");
    snprintf(program_name, room, "formulation %s", name);
    free(c->program_name);
    c->program_name = program_name;
    return STATUS_OK;
}

void channel_end(channel *c)
{
    child_end(&c->process, 1);
    free(c->program_name);
    free(c->words);
    free(c->in.at);
    free(c->out.at);
    *c = (channel){.program_name = NULL};
}

void channel_note(channel *c, status outcome, const fault *why)
{
    if (outcome < STATUS_REFUSED || (c->trouble[0] != '\0' && !c->reported))
        return;
    memcpy(c->trouble, why->text, sizeof c->trouble);
    c->reported = 0;
}

static void on_one_line(char text[])
{
    for (; *text != '\0'; text++)
        if ((unsigned char)*text < ' ' || *text == 127)
            *text = '.';
}

static void how_it_ended(int how, char words[], size_t size)
{
    if (how == -1)
        snprintf(words, size, "closed its standard output");
    else if (WIFSIGNALED(how))
        snprintf(words, size, "ended by signal %d (%s)", WTERMSIG(how), strsignal(WTERMSIG(how)));
    else
        snprintf(words, size, "ended with status %d", WEXITSTATUS(how));
}

status channel_break(channel *c, const char *why, fault *f)
{
    child_end(&c->process, 1);
    snprintf(c->trouble, sizeof c->trouble, "%.100s: %.200s", c->program_name, why);
    on_one_line(c->trouble);
    c->reported = 0;
    return fault_set(f, STATUS_FAULT, "%s", c->trouble);
}

static status breach(channel *c, child_event what, const char *when, fault *f)
{
    char why[200], how[100];
    if (what == CHILD_LATE) {
        snprintf(
            why, sizeof why,
            "its process did not answer within %d s%s; make it faster, or increase --time-limit",
            c->limit, when);
    } else if (what == CHILD_WROTE) {
        snprintf(why, sizeof why,
                 "its process wrote more than an answer to standard output%s; print other text to "
                 "standard error",
                 when);
    } else {
        how_it_ended(child_end(&c->process, 0), how, sizeof how);
        snprintf(why, sizeof why,
                 "its process %s%s; correct the program (its error messages are on standard error)",
                 how, when);
    }
    return channel_break(c, why, f);
}

static status first_line(channel *c, char line[], fault *f)
{
    size_t count = 0;
    while (memchr(line, '\n', count) == NULL) {
        size_t more = 0;
        const child_event what = child_read(&c->process, line + count, 1,
                                            (size_t)HANDSHAKE_MOST - count, &more, c->limit);
        count += more;
        if (what != CHILD_DONE)
            return breach(c, what, " before its first line", f);
        if (count == HANDSHAKE_MOST && memchr(line, '\n', count) == NULL)
            return channel_break(
                c,
                "the output of its process did not begin with a line of JSON; print other "
                "text to standard error",
                f);
    }
    char *end = memchr(line, '\n', count);
    if (end != line + count - 1 && line[0] == '{')
        return breach(c, CHILD_WROTE, " after its first line", f);
    *end = '\0';
    on_one_line(line);
    return STATUS_OK;
}

status channel_start(channel *c, char line[], fault *f)
{
    child_end(&c->process, 1);
    c->trouble[0] = '\0';
    c->started++;
    TRY(child_start(c->words, &c->process, f));
    return first_line(c, line, f) == STATUS_OK ? STATUS_OK : STATUS_REFUSED;
}

int channel_runs(const channel *c)
{
    return child_runs(&c->process);
}

static int make_room(channel_bytes *b, size_t count)
{
    if (count <= b->room)
        return 1;
    char *more = realloc(b->at, count + b->room);
    if (more == NULL)
        return 0;
    b->at = more;
    b->room += count;
    return 1;
}

void channel_begin(channel *c)
{
    c->out.count = CHANNEL_HEADER;
}

void *channel_add(channel *c, size_t count)
{
    if (!make_room(&c->out, c->out.count + count))
        return NULL;
    void *to = c->out.at + c->out.count;
    c->out.count += count;
    return to;
}

static status no_memory(fault *f)
{
    return fault_memory(f, "a mesh in a request");
}

static status refused(channel *c, status outcome, size_t bytes, size_t had, fault *f)
{
    char text[MESSAGE + 1] = "", *rest = c->in.at + CHANNEL_ANSWER;
    size_t more = 0;
    const size_t here = had - CHANNEL_ANSWER;
    if (bytes > MESSAGE || here > bytes)
        return channel_break(c, "the reason for its rejection is longer than 300 bytes; shorten it",
                             f);
    memcpy(text, rest, here);
    if (here < bytes) {
        const child_event what =
            child_read(&c->process, text + here, bytes - here, bytes - here, &more, c->limit);
        if (what != CHILD_DONE)
            return breach(c, what, " in the middle of an answer", f);
    }
    on_one_line(text);
    return fault_set(f, outcome, "%.100s: %.200s", c->program_name,
                     text[0] != '\0' ? text : "refused");
}

static status rest_of(channel *c, enum channel_request what, size_t least, size_t most, size_t had,
                      size_t *count, fault *f)
{
    int64_t head[2];
    char why[200];
    size_t more = 0;
    memcpy(head, c->in.at + sizeof mark, sizeof head);
    if (memcmp(c->in.at, mark, sizeof mark) != 0) {
        snprintf(
            why, sizeof why,
            "its process wrote '%.*s' instead of an answer; print other text to standard error",
            (int)(had < 40 ? had : 40), c->in.at);
        return channel_break(c, why, f);
    }
    if (head[0] < STATUS_OK || head[0] > STATUS_REFUSED || head[1] < 0)
        return channel_break(
            c, "an answer has an outcome outside 0 to 3; write one of these numbers", f);
    if (head[0] != STATUS_OK)
        return refused(c, (status)head[0], (size_t)head[1], had, f);
    *count = (size_t)head[1];
    if (*count != least && *count != most) {
        const int damped = what == CHANNEL_PREPARE && least == most && most > 0;
        snprintf(why, sizeof why, "an answer has %zu bytes instead of %zu%s", *count, most,
                 damped ? "; with 'damping' true, answer prepare with C, then V; with 'only V', "
                          "answer with V"
                        : "; write the arrays that harness/formulations/protocol.md requires");
        return channel_break(c, why, f);
    }
    if (had > CHANNEL_ANSWER + *count)
        return breach(c, CHILD_WROTE, "", f);
    const size_t left = CHANNEL_ANSWER + *count - had;
    const child_event event = child_read(&c->process, c->in.at + had, left, left, &more, c->limit);
    return event == CHILD_DONE ? STATUS_OK : breach(c, event, " in the middle of an answer", f);
}

status channel_ask(channel *c, enum channel_request what, int mask, int elements, size_t least,
                   size_t most, const char **body, size_t *count, fault *f)
{
    const int64_t head[4] = {what, mask, elements, (int64_t)(c->out.count - CHANNEL_HEADER)};
    size_t had = 0;
    if (!make_room(&c->in, CHANNEL_ANSWER + most + 1) || !make_room(&c->out, c->out.count))
        return no_memory(f);
    memcpy(c->out.at, mark, sizeof mark);
    memcpy(c->out.at + sizeof mark, head, sizeof head);
    child_event event = child_write(&c->process, c->out.at, c->out.count, c->limit);
    if (event == CHILD_DONE)
        event = child_read(&c->process, c->in.at, CHANNEL_ANSWER, CHANNEL_ANSWER + most + 1, &had,
                           c->limit);
    if (event == CHILD_ENDED && had > 0 && had < CHANNEL_ANSWER)
        return breach(c, event, " in the middle of an answer", f);
    if (event != CHILD_DONE)
        return breach(c, event, event == CHILD_ENDED ? " and gave no answer" : "", f);
    TRY(rest_of(c, what, least, most, had, count, f));
    *body = c->in.at + CHANNEL_ANSWER;
    return STATUS_OK;
}
