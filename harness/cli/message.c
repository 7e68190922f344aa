#include "harness/cli/message.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/command.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"

int message_finish(int code)
{
    const int told = code == EXIT_REFUSED || code == EXIT_FAULT; /* that line is enough */
    if ((fflush(stdout) == 0 && !ferror(stdout)) || told)
        return code;
    return message_fail(STATUS_FAULT, "standard output cannot be written");
}

int message_exit(status s, const fault *f)
{
    return s == STATUS_OK ? EXIT_AS_EXPECTED : message_fail(s, f->text);
}

int message_fail(status s, const char *text)
{
    fprintf(stderr, "beamwork: %s\n", text);
    switch (s) {
    case STATUS_OK:
        return EXIT_AS_EXPECTED;
    case STATUS_NOT_CONVERGED:
    case STATUS_SINGULAR:
    case STATUS_TIME_LIMIT:
    case STATUS_NO_VALUE:
        return EXIT_DIFFERS;
    case STATUS_REFUSED:
        return EXIT_REFUSED;
    case STATUS_FAULT:
        break;
    }
    return EXIT_FAULT;
}

void message_refuse(const char *text)
{
    exit(message_fail(STATUS_REFUSED, text));
}

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

/* What can happen, and the line for each, written before it does. */
static struct {
    int signal;
    const char *what;
    char line[200];
} mishap[] = {{SIGSEGV, "reaches for memory that is not its own", ""},
              {SIGBUS, "reaches for memory that is not there", ""},
              {SIGFPE, "divides whole numbers by zero", ""},
              {SIGILL, "runs into what is no instruction", ""},
              {SIGABRT, "aborts", ""},
              {SIGALRM, "did not come back within the time limit (--time-limit)", ""}};

enum { MISHAPS = sizeof mishap / sizeof mishap[0] };

static void tell(int which)
{
    for (int i = 0; i < MISHAPS; i++)
        if (mishap[i].signal == which &&
            write(STDERR_FILENO, mishap[i].line, strlen(mishap[i].line)) > 0)
            break;
    output_abandon();
    _exit(EXIT_DIFFERS);
}

/* Also where the stack is what has run out. */
static void stand_on_another_stack(void)
{
    static char stack[1 << 16];
    const stack_t other = {.ss_sp = stack, .ss_size = sizeof stack};
    sigaltstack(&other, NULL);
}

void guard_formulation(const formulation *chosen, int seconds)
{
    if (!formulations_is_loaded(chosen->type))
        return;
    struct sigaction action = {.sa_handler = tell, .sa_flags = SA_ONSTACK | SA_RESETHAND};
    stand_on_another_stack();
    for (int i = 0; i < MISHAPS; i++) {
        snprintf(mishap[i].line, sizeof mishap[i].line, "beamwork: formulation %.60s %s\n",
                 chosen->type->name, mishap[i].what);
        sigaction(mishap[i].signal, &action, NULL);
    }
    alarm((unsigned)seconds);
}
