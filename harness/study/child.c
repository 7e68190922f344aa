#include "harness/study/child.h"

#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static void default_alarm(void)
{
    sigset_t alarm_only;
    sigemptyset(&alarm_only);
    sigaddset(&alarm_only, SIGALRM);
    signal(SIGALRM, SIG_DFL);
    sigprocmask(SIG_UNBLOCK, &alarm_only, NULL);
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

int child_is_gone(pid_t process)
{
    siginfo_t how = {.si_pid = 0};
    return waitid(P_PID, (id_t)process, &how, WEXITED | WNOHANG | WNOWAIT) != 0 || how.si_pid != 0;
}

int child_reap(pid_t process)
{
    enum { LOOKS = 200 };
    int how = 0;
    for (int i = 0; i < LOOKS && !child_is_gone(process); i++)
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    if (!child_is_gone(process))
        kill(process, SIGKILL);
    waitpid(process, &how, 0);
    return how;
}

int child_ended(int how, int late, int seconds, char *words, size_t size)
{
    const int over = late || (WIFSIGNALED(how) && WTERMSIG(how) == SIGALRM);
    if (over)
        snprintf(words, size, "time limit: no result after %d s", seconds);
    else if (WIFSIGNALED(how))
        snprintf(words, size, "crashed with signal %d", WTERMSIG(how));
    else
        snprintf(words, size, "its process ended with status %d", WEXITSTATUS(how));
    return over;
}
