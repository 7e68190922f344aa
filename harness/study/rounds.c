#include "harness/study/rounds.h"

#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void rounds_run(const cell_request *request, double floor, rounds_reading *out)
{
    double least = INFINITY, spent = 0;
    for (int i = 0; out->rounds < ROUNDS_COUNT && (i == 0 || spent < floor); i++) {
        cell_result cell;
        fault f = {""};
        cell_run(request, &cell, &f);
        const double total = cell.solve.seconds_setup + cell.solve.seconds_solve;
        if (total < fmin(least, rounds_least(out))) {
            out->setup = cell.solve.seconds_setup;
            out->solve = cell.solve.seconds_solve;
        }
        least = fmin(least, total);
        spent += fmax(total, 1e-6);
        out->repeats++;
        cell_result_free(&cell);
    }
    if (out->rounds < ROUNDS_COUNT)
        out->round[out->rounds++] = least;
}

double rounds_least(const rounds_reading *c)
{
    double least = INFINITY;
    for (int i = 0; i < c->rounds; i++)
        least = fmin(least, c->round[i]);
    return least;
}

double rounds_most(const rounds_reading *c)
{
    double most = 0;
    for (int i = 0; i < c->rounds; i++)
        most = fmax(most, c->round[i]);
    return c->rounds > 0 ? most : INFINITY;
}

int rounds_compare(const rounds_reading *a, const rounds_reading *b)
{
    return (rounds_most(b) < rounds_least(a)) - (rounds_most(a) < rounds_least(b));
}

void rounds_pin(void)
{
    const int here = sched_getcpu();
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(here >= 0 ? here : 0, &only);
    sched_setaffinity(0, sizeof only, &only); /* without it the readings are only noisier */
}

void rounds_single_thread(char **arguments)
{
    static const char *const threads[] = {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS",
                                          "MKL_NUM_THREADS", "BLIS_NUM_THREADS"};
    enum { LIBRARIES = sizeof threads / sizeof threads[0] };
    int single = 1;
    for (int i = 0; i < LIBRARIES; i++) {
        single &= getenv(threads[i]) != NULL && strcmp(getenv(threads[i]), "1") == 0;
        setenv(threads[i], "1", 1);
    }
    if (!single)
        /* returns only where there is no /proc: then libraries decide */
        execv("/proc/self/exe", arguments);
}
