#include "harness/experiments/pace_drift.h"

#include <math.h>

/* Steps of the motion of a run, with its begin. */
typedef struct track {
    int count;
    const motion_record *record;
} track;

static track track_of(const solve_result *r, int analysis)
{
    track t = {0, r->motion};
    while (t.record != NULL && t.record < r->motion + r->motions && t.record->analysis != analysis)
        t.record++;
    while (t.record + t.count < r->motion + r->motions && t.record[t.count].analysis == analysis)
        t.count++;
    return t;
}

static double balance_at(const track *t, int i, scene_balance what)
{
    return t->record[i].at.balance[what];
}

/* The first step that ends where nothing acts; where loads end, accelerations and what has no mass
 * are found anew, so that the end of the step before is not yet one of them. */
static int first_alone(const track *t, double from)
{
    int i = 0;
    while (from > 0 && i < t->count && t->record[i].at.time <= from * (1 + 1e-12))
        i++;
    return i;
}

/* Against the first step: the run may have stopped before the last one. */
static void take_energy(const track *t, int first, pace_run *r)
{
    const double before = balance_at(t, first, SCENE_ENERGY);
    r->largest = r->last = 1;
    r->energy = 0;
    for (int i = first; i < t->count; i++) {
        r->last = balance_at(t, i, SCENE_ENERGY) / before;
        r->largest = fmax(r->largest, r->last);
        r->energy = fmax(r->energy, fabs(r->last - 1));
    }
}

/* Of a momentum: its size, or that of its change since `first`. */
static double vector_at(const track *t, scene_balance x, int i, int first)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const scene_balance which = (scene_balance)(x + k);
        const double d = balance_at(t, i, which) - (first != i ? balance_at(t, first, which) : 0);
        square += d * d;
    }
    return sqrt(square);
}

/* Of both momenta, against their size; what is at rest has none. */
static double momentum_drift(const track *t, int first)
{
    static const scene_balance both[] = {SCENE_PX, SCENE_LX};
    double largest = 0;
    for (int b = 0; b < 2; b++) {
        const double size = vector_at(t, both[b], first, first);
        for (int i = first + 1; i < t->count && size > 0; i++)
            largest = fmax(largest, vector_at(t, both[b], i, first) / size);
    }
    return largest;
}

/* Energy that no work explains, in parts of the largest. */
static double unexplained(const track *t)
{
    double most = 0, size = 0;
    for (int i = 0; i < t->count; i++) {
        const double drift = fabs(balance_at(t, i, SCENE_DRIFT));
        if (isnan(drift))
            return NAN;
        most = fmax(most, drift);
        size = fmax(size, fabs(balance_at(t, i, SCENE_ENERGY)));
    }
    return size > 0 ? most / size : NAN;
}

static pace_fate fate_of(const pace_run *r)
{
    if (r->status != STATUS_OK)
        return PACE_STOPS;
    if (isnan(r->largest))
        return PACE_UNJUDGED;
    if (!(r->largest <= 1 + pace_growth))
        return PACE_GROWS;
    return r->energy <= pace_energy && r->momentum <= pace_momentum ? PACE_EXACT : PACE_BOUNDED;
}

void pace_drift(const pace *p, pace_run *r)
{
    const pace_group *g = &p->group[r->group];
    const track t = track_of(&pace_cell_of(p, r->series)->solve, g->analysis);
    const int first = first_alone(&t, g->from);
    r->momentum = r->largest = r->last = NAN;
    r->energy = unexplained(&t);
    if (first < t.count && balance_at(&t, first, SCENE_ENERGY) > 0) {
        take_energy(&t, first, r);
        r->momentum = momentum_drift(&t, first);
    }
    r->fate = isfinite(g->from) || r->status != STATUS_OK ? fate_of(r) : PACE_UNJUDGED;
}
