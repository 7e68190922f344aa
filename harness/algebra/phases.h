/* Where the time of Newton's iterations goes. A clock is read only when it is wanted, and only
 * inside an iteration. */
#ifndef BEAMWORK_PHASES_H
#define BEAMWORK_PHASES_H

#include <time.h>

typedef enum phase {
    PHASE_ELEMENTS,
    PHASE_ASSEMBLY,
    PHASE_FACTORISATION,
    PHASE_SOLUTION,
    PHASES
} phase;

typedef struct phases {
    int wanted, running;
    double last;            /* [s] last reading */
    double seconds[PHASES]; /* [s] */
} phases;

static inline double phases_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline void phases_start(phases *p)
{
    p->running = p->wanted;
    if (p->running)
        p->last = phases_now();
}

/* What has passed since the last reading belongs to k. */
static inline void phases_lap(phases *p, phase k)
{
    if (!p->running)
        return;
    const double now = phases_now();
    p->seconds[k] += now - p->last;
    p->last = now;
}

static inline void phases_stop(phases *p)
{
    p->running = 0;
}

static inline const char *phase_name(phase k)
{
    static const char *const name[PHASES] = {"elements", "assembly", "factorisation", "solution"};
    return name[k];
}

#endif
