#include <poll.h>

#include "harness/numerics/numerics.h"

static _Thread_local int observed;

void stop_observe(int descriptor)
{
    observed = descriptor;
}

status stop_check(fault *f)
{
    struct pollfd request = {.fd = observed, .events = POLLIN};
    if (observed <= 0 || poll(&request, 1, 0) <= 0)
        return STATUS_OK;
    return fault_set(f, STATUS_FAULT, "stopped before the solution was finished");
}
