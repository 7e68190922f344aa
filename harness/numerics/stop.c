/* Requests that a solution stops. */
#include <poll.h>

#include "harness/numerics/numerics.h"

static _Thread_local int watched;

void stop_watch(int descriptor)
{
    watched = descriptor;
}

status stop_check(fault *f)
{
    struct pollfd asked = {.fd = watched, .events = POLLIN};
    if (watched <= 0 || poll(&asked, 1, 0) <= 0)
        return STATUS_OK;
    return fault_set(f, STATUS_FAULT, "stopped before the solution was finished");
}
