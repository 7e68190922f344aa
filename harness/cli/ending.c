#include "harness/cli/ending.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/command.h"
#include "harness/records/output.h"

static pid_t program; /* that these are for: its children end by themselves */

static void say(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0) {
        /* the exit status says it still */
    }
}

/* By the same signal, so that whoever waits sees it. */
static void end_by(int number)
{
    signal(number, SIG_DFL);
    raise(number);
}

static void asked(int number)
{
    if (getpid() == program)
        output_abandon();
    end_by(number);
}

static void crashed(int number)
{
    if (getpid() == program) {
        say("beamwork: crashed; an element that is at fault shows in 'beamwork element-test', and "
            "libraries end so where memory is short\n");
        output_abandon();
    }
    end_by(number);
}

/* exit() with a status that none of ours is. */
static void ended(int code, void *unused)
{
    (void)unused;
    if (getpid() != program || (code >= EXIT_AS_EXPECTED && code <= EXIT_INTERRUPTED))
        return;
    say("beamwork: a library or an element ended the program; libraries do so where memory is "
        "short\n");
    output_abandon();
    _exit(EXIT_FAULT);
}

/* Where nobody else has: a sanitizer, or who ignores it. */
static void attend(int number, void (*handler)(int))
{
    struct sigaction action, before;
    if (sigaction(number, NULL, &before) != 0 || before.sa_handler != SIG_DFL)
        return;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

static void fill_streams(void)
{
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0 && open("/dev/null", i == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
}

void ending_begin(void)
{
    static const int asking[] = {SIGTERM, SIGHUP, SIGINT},
                     crashing[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
    static char stack[1 << 16]; /* a stack that is full ends so, too */
    const stack_t other = {.ss_sp = stack, .ss_size = sizeof stack};
    program = getpid();
    fill_streams();
    sigaltstack(&other, NULL);
    for (size_t i = 0; i < sizeof asking / sizeof asking[0]; i++)
        attend(asking[i], asked);
    for (size_t i = 0; i < sizeof crashing / sizeof crashing[0]; i++)
        attend(crashing[i], crashed);
    on_exit(ended, NULL);
}
