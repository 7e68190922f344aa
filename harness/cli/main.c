/* beamwork VERB ...: what the process needs before a verb runs. */
#include <gsl/gsl_errno.h>
#include <hdf5.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/cli/cli.h"

/* Not inlined: what it needs of the stack is taken once the stack is known to suffice. */
static __attribute__((noinline)) int run(int count, char **arguments)
{
    return verb_table_run(count, arguments);
}

/* A stack that is too small ends a program without a word: it is raised as far as we may. 1: it is
 * large enough. */
static int stack_suffices(void)
{
    enum { LEAST = 1 << 20, USUAL = 1 << 23 }; /* [bytes] */
    struct rlimit stack;
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= LEAST)
        return 1;
    stack.rlim_cur = stack.rlim_max < USUAL ? stack.rlim_max : USUAL;
    return setrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur >= LEAST;
}

/* Without stdio, whose buffer for standard error lies on the stack: what starts at all says it. */
static _Noreturn void refuse_stack(void)
{
    static const char text[] = "beamwork: the stack is limited to less than 1 MB; allow more with "
                               "'ulimit -s 8192'\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) {
        /* the exit status says it still */
    }
    _exit(EXIT_FAULT);
}

int main(int count, char **arguments)
{
    if (!stack_suffices())
        refuse_stack();
    ending_begin();
    gsl_set_error_handler_off();
    /* it closes nothing of its own accord: what we open we close, and where memory was short its
     * own end crashes or fills the screen */
    H5dont_atexit();
    /* a file that reached its size limit is a write error, reported in one line */
    signal(SIGXFSZ, SIG_IGN);
    return message_finish(run(count, arguments));
}
