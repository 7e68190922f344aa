/* Where the time of a solution goes: the parts of Newton's iterations, and the rest. The clock is
 * that of the whole, the processor's: where several threads share the elements, that of the thread
 * that leads, with its waiting for the others. It is read only when it is wanted and only inside an
 * iteration; what the readings themselves take, 0.4 us each, belongs to no part. */
#ifndef BEAMWORK_PHASES_H
#define BEAMWORK_PHASES_H

#include "harness/numerics/clock.h"

typedef enum newton_phase {
    PHASE_ELEMENTS,
    PHASE_ASSEMBLY,
    PHASE_FACTORISATION,
    PHASE_SOLUTION,
    PHASE_REST, /* outside of the iterations; from here on no part of one */
    PHASES
} newton_phase;

typedef struct phases {
    int wanted, running;
    double last;            /* [s] last reading */
    double reading;         /* [s] that one takes */
    long readings;          /* between two of an iteration */
    double seconds[PHASES]; /* [s] */
} phases;

/* From nothing; what a reading takes is the least of a few. */
static inline void phases_want(phases *p, int wanted)
{
    enum { FEW = 50 };
    *p = (phases){.wanted = wanted, .reading = 1};
    for (int i = 0; wanted && i < FEW; i++) {
        const double start = clock_processor_seconds(), took = clock_processor_seconds() - start;
        if (took < p->reading)
            p->reading = took;
    }
}

static inline void phases_start(phases *p)
{
    p->running = p->wanted;
    if (p->running)
        p->last = clock_processor_seconds();
}

/* What has passed since the last reading belongs to k. */
static inline void phases_lap(phases *p, newton_phase k)
{
    if (!p->running)
        return;
    const double now = clock_processor_seconds();
    p->seconds[k] += now - p->last - p->reading;
    p->readings++;
    p->last = now;
}

static inline void phases_stop(phases *p)
{
    p->running = 0;
}

/* All parts, which are `whole` [s] together, but for the readings. */
static inline void phases_of_whole(const phases *p, double whole, double part[PHASES])
{
    part[PHASE_REST] = whole - (double)p->readings * p->reading;
    for (int k = 0; k < PHASE_REST; k++) {
        part[k] = p->seconds[k];
        part[PHASE_REST] -= part[k];
    }
}

static inline const char *phase_name(newton_phase k)
{
    static const char *const name[PHASES] = {"elements", "assembly", "factorisation", "solution",
                                             "rest"};
    return name[k];
}

#endif
