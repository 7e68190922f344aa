/* Where the time of Newton's iterations goes. A clock is read only when it is wanted, and only
 * inside an iteration. */
#ifndef BEAMWORK_PHASES_H
#define BEAMWORK_PHASES_H

#include "harness/algebra/clock.h"

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

static inline void phases_start(phases *p)
{
    p->running = p->wanted;
    if (p->running)
        p->last = clock_wall_seconds();
}

/* What has passed since the last reading belongs to k. */
static inline void phases_lap(phases *p, phase k)
{
    if (!p->running)
        return;
    const double now = clock_wall_seconds();
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
