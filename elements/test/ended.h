#ifndef BEAMWORK_ENDED_H
#define BEAMWORK_ENDED_H

#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

/* Calls the function in a child process. Returns the signal that ended this process, or its exit
 * status, which is 0 if the function returns. */
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
