/* Calls a function in a separate process, for tests of functions that end the program. */
#ifndef BEAMWORK_ENDED_H
#define BEAMWORK_ENDED_H

#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

/* Returns the signal that ends a process which calls the function, or otherwise the exit status of
 * the process, which is 0 if the function returns. */
static inline int ended_by(void (*call)(const void *), const void *given)
{
    int how = -1;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        if (freopen("/dev/null", "w", stderr) != NULL)
            call(given);
        _exit(0);
    }
    waitpid(child, &how, 0);
    return WIFSIGNALED(how) ? WTERMSIG(how) : WEXITSTATUS(how);
}

#endif
