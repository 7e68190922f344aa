#include "harness/formulations/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

enum { TO_READ, TO_WRITE };

static void close_both(const int ends[2])
{
    close(ends[TO_READ]);
    close(ends[TO_WRITE]);
}

/* In the new process: becomes the command, or writes why not. */
static void become(char *const words[], int in, int out, int why, pid_t parent)
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    signal(SIGPIPE, SIG_DFL);
    setpgid(0, 0); /* Ctrl-C is for beamwork, which then ends it */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() == parent && dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0)
        execvp(words[0], words);
    const int number = errno;
    if (write(why, &number, sizeof number) != sizeof number)
        _exit(126);
    _exit(127);
}

/* The channels of the new process are none of 0, 1, 2, so that dup2 keeps what is duplicated. */
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
    return fault_set(f, STATUS_FAULT, "cannot start '%.100s': %s", command, strerror(errno));
}

status child_start(char *const words[], child *out, fault *f)
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
    return fault_set(f, STATUS_REFUSED, "exec: cannot run '%.100s': %s", words[0],
                     strerror(number));
}

int child_runs(const child *c)
{
    siginfo_t how = {.si_pid = 0};
    return c->process > 0 && c->owner == getpid() &&
           waitid(P_PID, (id_t)c->process, &how, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           how.si_pid == 0;
}

int child_end(child *c, int now)
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

/* Waits for either channel; 0: the time is up. */
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

/* write() that gives EPIPE and no signal. */
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

child_event child_write(const child *c, const void *bytes, size_t count, int limit)
{
    const char *from = bytes;
    const double end = end_of(limit);
    while (count > 0) {
        struct pollfd spoken = {.fd = c->from, .events = POLLIN};
        if (poll(&spoken, 1, 0) > 0)
            return spoken.revents & POLLIN ? CHILD_SPOKE : CHILD_ENDED;
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

child_event child_read(const child *c, void *bytes, size_t least, size_t most, size_t *count,
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
