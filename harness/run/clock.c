#include "harness/run/clock.h"

#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST = 3, MOST = 200 };

void clock_pin(void)
{
    cpu_set_t only;
    const int here = sched_getcpu();
    CPU_ZERO(&only);
    CPU_SET(here >= 0 ? here : 0, &only);
    sched_setaffinity(0, sizeof only, &only); /* without it the readings are only noisier */
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

status clock_cell(const cell_request *request, double floor, clock_reading *out, cell_result *last, fault *f)
{
    double total[MOST], spent = 0;
    status outcome = STATUS_OK;
    *out = (clock_reading){INFINITY, INFINITY, 0, 0};
    memset(last, 0, sizeof *last);
    while (out->repeats < MOST && (out->repeats < LEAST || spent < floor)) {
        if (out->repeats > 0)
            cell_result_free(last);
        outcome = cell_run(request, last, f);
        out->setup = fmin(out->setup, last->solve.seconds_setup);
        out->solve = fmin(out->solve, last->solve.seconds_solve);
        total[out->repeats] = last->solve.seconds_setup + last->solve.seconds_solve;
        spent += total[out->repeats++];
        if (outcome != STATUS_OK)
            break; /* a failure is not worth repeating */
    }
    qsort(total, (size_t)out->repeats, sizeof *total, ascending);
    out->spread = total[0] > 0 ? total[out->repeats / 2] / total[0] - 1 : 0;
    return outcome;
}
