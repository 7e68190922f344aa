/* No process may outlive the process that started it, and an interrupted run must keep its finished
 * results. */
#include <gsl/gsl_test.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "harness/study/study.h"
#include "harness/study/test/ending.h"

enum { END = 900, WAIT = 120 }; /* [s] time limits of a test and of one event */

typedef struct family {
    pid_t parent;
    int output;
} family;

static int run_endless(const sweep_request *request, int complete, int output)
{
    static const int mesh[] = {1, 2, 3};
    const formulation good = ending_good(), endless = ending_bad(HANGING, output);
    double value[CASE_MAX_PARAMETERS] = {0};
    sweep s = {0};
    fault f = {""};
    parameters_default(registry_cases[0], value);
    status outcome = plan_add(&s, registry_cases[0], value, NULL, mesh, 3, &f);
    if (outcome == STATUS_OK && complete)
        outcome = plan_extend(&s, &good, 1, &f);
    if (outcome == STATUS_OK)
        outcome = plan_extend(&s, &endless, 1, &f);
    if (outcome != STATUS_OK || run_sweep(request, &s, &f) != STATUS_OK)
        return 1;
    int right = request->interruptible ? s.seriess == complete && s.unfinished == 3
                                       : s.seriess == 1 + complete && s.unfinished == 0;
    for (int i = 0; i < s.seriess; i++)
        for (int k = 0; k < 3; k++)
            right = right &&
                    (s.series[i].cell[k].solve.status == STATUS_TIME_LIMIT) == (i >= complete) &&
                    (s.series[i].cell[k].solve.quantities > 0) == (i < complete);
    sweep_free(&s);
    return right ? 0 : 2;
}

static family begin_family(const sweep_request *request, int complete)
{
    int ends[2];
    family out = {-1, -1};
    if (pipe(ends) != 0 || (out.parent = fork()) < 0)
        return out;
    if (out.parent == 0) {
        close(ends[0]);
        _exit(run_endless(request, complete, ends[1]));
    }
    close(ends[1]);
    out.output = ends[0];
    return out;
}

/* Returns the process number of the next cell that has started; 0: no process can report any more;
 * -1: nothing happened within WAIT. */
static pid_t next_cell(const family *of)
{
    struct pollfd end = {.fd = of->output, .events = POLLIN};
    pid_t process = 0;
    if (poll(&end, 1, 1000 * WAIT) <= 0)
        return -1;
    return read(of->output, &process, sizeof process) == (ssize_t)sizeof process ? process : 0;
}

static int exit_code(pid_t process)
{
    int how = 0;
    return waitpid(process, &how, 0) == process && WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static void orphans(void)
{
    const sweep_request request = {.jobs = 2};
    const family of = begin_family(&request, 0);
    const pid_t first = next_cell(&of), second = next_cell(&of);
    gsl_test(first <= 0 || second <= 0 || first == second, "two workers are at their cells");
    kill(of.parent, SIGKILL);
    exit_code(of.parent);
    const int has_ended = next_cell(&of) == 0;
    gsl_test(!has_ended, "nobody holds the pipe any more: the workers went with their parent");
    if (!has_ended && first > 0 && second > 0) {
        kill(first, SIGKILL);
        kill(second, SIGKILL);
    }
    close(of.output);
}

static char state_of(pid_t process)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (file == NULL || fscanf(file, "%*d (%*[^)]) %c", &state) != 1)
        state = 'X';
    if (file != NULL)
        fclose(file);
    return state;
}

static void own_limit(void)
{
    const sweep_request request = {.jobs = 1, .time_limit = 1};
    const family of = begin_family(&request, 0);
    const pid_t cell = next_cell(&of);
    gsl_test(cell <= 0, "a worker is at its cell");
    kill(of.parent, SIGSTOP);
    char state = 'R';
    for (int i = 0; i < 100 * WAIT && cell > 0 && state != 'X' && state != 'Z'; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
        state = state_of(cell);
    }
    gsl_test(state != 'X' && state != 'Z', "it has ended while its parent is stopped (%c)", state);
    if (state != 'X' && state != 'Z' && cell > 0)
        kill(cell, SIGKILL);
    kill(of.parent, SIGCONT);
    gsl_test_int(exit_code(of.parent), 0, "and its parent says that the limit was reached");
    close(of.output);
}

static void interrupted(int number)
{
    const sweep_request request = {.jobs = 1, .interruptible = 1};
    const family of = begin_family(&request, 1);
    gsl_test(next_cell(&of) <= 0, "three cells are done, the fourth has begun");
    kill(of.parent, number);
    gsl_test_int(exit_code(of.parent), 0,
                 "signal %d: one series of two is left, three cells are not done", number);
    gsl_test_int(next_cell(&of), 0, "signal %d: no worker is left", number);
    close(of.output);
}

static int is_requested(const interrupt *i)
{
    struct pollfd end = {.fd = i->descriptor, .events = POLLIN};
    return poll(&end, 1, 0) > 0;
}

static void requests(void)
{
    interrupt i;
    sigset_t after;
    interrupt_begin(&i);
    gsl_test(i.descriptor < 0 || is_requested(&i), "nobody asks");
    raise(SIGTERM);
    gsl_test(!is_requested(&i), "somebody does, and is not obeyed at once");
    interrupt_end(&i);
    signal(SIGHUP, SIG_IGN);
    interrupt_begin(&i);
    raise(SIGHUP);
    gsl_test(is_requested(&i), "an ignored signal is no request");
    interrupt_end(&i);
    signal(SIGHUP, SIG_DFL);
    sigprocmask(SIG_SETMASK, NULL, &after);
    gsl_test(sigismember(&after, SIGINT) || sigismember(&after, SIGTERM),
             "the mask is the one of before");
}

int main(void)
{
    signal(SIGINT, SIG_DFL);
    alarm(END);
    orphans();
    own_limit();
    interrupted(SIGINT);
    interrupted(SIGTERM);
    requests();
    return gsl_test_summary();
}
