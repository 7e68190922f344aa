#include "harness/cli/guard.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/command.h"
#include "harness/formulations/formulations.h"
#include "harness/records/output.h"

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
