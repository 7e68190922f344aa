#include "harness/study/interrupt.h"

#include <stddef.h>
#include <sys/signalfd.h>
#include <unistd.h>

static int is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

void interrupt_begin(interrupt *out)
{
    static const int number[] = {SIGINT, SIGTERM, SIGHUP};
    sigset_t wanted;
    sigemptyset(&wanted);
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++)
        if (!is_ignored(number[i]))
            sigaddset(&wanted, number[i]);
    sigprocmask(SIG_BLOCK, &wanted, &out->before);
    out->descriptor = signalfd(-1, &wanted, SFD_CLOEXEC | SFD_NONBLOCK);
    if (out->descriptor < 0)
        sigprocmask(SIG_SETMASK, &out->before, NULL);
}

void interrupt_end(interrupt *out)
{
    struct signalfd_siginfo asked;
    if (out->descriptor < 0)
        return;
    while (read(out->descriptor, &asked, sizeof asked) > 0) /* the ones already answered */
        ;
    close(out->descriptor);
    out->descriptor = -1;
    sigprocmask(SIG_SETMASK, &out->before, NULL);
}
