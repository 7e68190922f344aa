#include "harness/experiments/design.h"

#include <stdlib.h>

const char *design_name(design_kind kind)
{
    static const char *const names[] = {"grid", "sobol", "halton", "random"};
    return names[kind];
}

static status count_grid(design *d, fault *f)
{
    d->points = 1;
    for (int i = 0; i < d->axes; i++) {
        const sweep_axis *a = &d->axis[i];
        if (a->count == 0)
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s: how many parts? write %s=%g..%g/N, or --design sobol "
                             "--points N",
                             a->of->name, a->of->name, a->from, a->to);
        if (d->points > DESIGN_MOST_POINTS / a->count)
            return fault_set(f, STATUS_REFUSED,
                             "more than %d points; give fewer parts, or --design sobol --points N",
                             DESIGN_MOST_POINTS);
        d->points *= a->count;
    }
    return STATUS_OK;
}

static status check_box(const design *d, fault *f)
{
    const int most = d->kind == DESIGN_SOBOL ? (int)gsl_qrng_sobol->max_dimension
                                             : (int)gsl_qrng_halton->max_dimension;
    for (int i = 0; i < d->axes; i++)
        if (d->axis[i].count > 0 && d->axis[i].value == NULL)
            return fault_set(f, STATUS_REFUSED,
                             "--vary %s: parts belong to a grid; leave out '/%d', --points says "
                             "how many points there are",
                             d->axis[i].of->name, d->axis[i].count - 1);
    if (d->kind != DESIGN_RANDOM && d->axes > most)
        return fault_set(f, STATUS_REFUSED, "--design %s has at most %d parameters; take random",
                         design_name(d->kind), most);
    return STATUS_OK;
}

/* One more point of the sequence, each share 0 <= share < 1. */
static void next(const design *d, const design_mark *m, double share[])
{
    if (m->quasi != NULL)
        gsl_qrng_get(m->quasi, share);
    else
        for (int i = 0; i < d->axes; i++)
            share[i] = gsl_rng_uniform(m->random);
}

static design_mark begin(const design *d)
{
    design_mark m = {NULL, NULL};
    if (d->kind == DESIGN_RANDOM) {
        m.random = gsl_rng_alloc(gsl_rng_mt19937);
        if (m.random != NULL)
            gsl_rng_set(m.random, d->seed);
        return m;
    }
    m.quasi = gsl_qrng_alloc(d->kind == DESIGN_SOBOL ? gsl_qrng_sobol : gsl_qrng_halton,
                             (unsigned)d->axes);
    return m;
}

static design_mark copy(const design_mark *m)
{
    return (design_mark){m->quasi != NULL ? gsl_qrng_clone(m->quasi) : NULL,
                         m->random != NULL ? gsl_rng_clone(m->random) : NULL};
}

static int is_there(const design_mark *m)
{
    return m->quasi != NULL || m->random != NULL;
}

static void end(design_mark *m)
{
    if (m->quasi != NULL)
        gsl_qrng_free(m->quasi);
    if (m->random != NULL)
        gsl_rng_free(m->random);
    *m = (design_mark){NULL, NULL};
}

/* A mark at every stride. */
static status set_marks(design *d, fault *f)
{
    const long least = (d->points + DESIGN_MARKS - 1) / DESIGN_MARKS;
    d->stride = least > DESIGN_STRIDE ? least : DESIGN_STRIDE;
    const long wanted = (d->points + d->stride - 1) / d->stride;
    double share[CASE_MAX_PARAMETERS];
    d->mark = calloc((size_t)wanted, sizeof *d->mark);
    if (d->mark == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for the points of a sweep");
    for (; d->marks < wanted; d->marks++) {
        design_mark *here = &d->mark[d->marks];
        *here = d->marks == 0 ? begin(d) : copy(here - 1);
        if (!is_there(here))
            return fault_set(f, STATUS_FAULT, "out of memory for the points of a sweep");
        for (long i = 0; d->marks > 0 && i < d->stride; i++)
            next(d, here, share);
    }
    return STATUS_OK;
}

static status fill_box(design *d, long points, fault *f)
{
    if (points < 1 || points > DESIGN_MOST_POINTS)
        return fault_set(f, STATUS_REFUSED, "--design %s: how many points? give --points N",
                         design_name(d->kind));
    d->points = points;
    TRY(check_box(d, f));
    return set_marks(d, f);
}

status design_make(design_kind kind, int axes, const sweep_axis list[], long points,
                   unsigned long seed, design *out, fault *f)
{
    *out = (design){.kind = kind, .axes = axes, .axis = list, .seed = seed};
    const status outcome = kind == DESIGN_GRID ? count_grid(out, f) : fill_box(out, points, f);
    if (outcome != STATUS_OK)
        design_free(out);
    return outcome;
}

void design_free(design *d)
{
    for (long i = 0; i < d->marks; i++)
        end(&d->mark[i]);
    free(d->mark);
    d->mark = NULL;
    d->marks = 0;
}

static void grid_point(const design *d, long index, double out[])
{
    for (int i = d->axes - 1; i >= 0; i--) {
        out[i] = axis_value(&d->axis[i], (int)(index % d->axis[i].count));
        index /= d->axis[i].count;
    }
}

static status box_points(const design *d, long first, long count, double out[], fault *f)
{
    double share[CASE_MAX_PARAMETERS];
    design_mark at = copy(&d->mark[first / d->stride]);
    if (!is_there(&at))
        return fault_set(f, STATUS_FAULT, "out of memory for the points of a sweep");
    for (long i = 0; i < first % d->stride; i++)
        next(d, &at, share);
    for (long i = 0; i < count; i++) {
        next(d, &at, share);
        for (int k = 0; k < d->axes; k++)
            out[i * d->axes + k] = axis_at(&d->axis[k], share[k]);
    }
    end(&at);
    return STATUS_OK;
}

status design_points(const design *d, long first, long count, double out[], fault *f)
{
    if (d->kind != DESIGN_GRID)
        return box_points(d, first, count, out, f);
    for (long i = 0; i < count; i++)
        grid_point(d, first + i, out + i * d->axes);
    return STATUS_OK;
}
