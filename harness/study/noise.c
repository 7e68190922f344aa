#include "harness/study/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/adapters/adapters.h"
#include "harness/study/plan.h"
#include "harness/study/run.h"

enum { REPETITIONS = 2 };
/* the larger of two differences, twice: the standard deviation or more, nineteen times of twenty */
static const double cover = 2;

/* In what other words. */
static scene_edit words_of(const formulation *chosen, int repetition)
{
    if (repetition == 0)
        return (scene_edit){SCENE_EDIT_UNIT, 1000};
    if (chosen->type->limits & LIMIT_ORDER_DEPENDENT)
        return (scene_edit){SCENE_EDIT_UNIT, 0.3};
    return (scene_edit){SCENE_EDIT_REVERSE, 0};
}

static status add_repetitions(const sweep *s, const series *one, sweep *again, fault *f)
{
    const point *p = &s->point[one->point];
    for (int k = 0; k < REPETITIONS; k++) {
        const scene_edit edit = words_of(&one->formulation, k);
        TRY(plan_add(again, p->type, p->parameter, &edit, &one->mesh[one->meshes - 1], 1, f));
        again->point[again->points - 1].steps = p->steps;
        TRY(plan_extend(again, &one->formulation, 1, f));
    }
    return STATUS_OK;
}

static double value_of(const cell_result *cell, int quantity)
{
    const solve_result *r = &cell->solve;
    return quantity < r->quantities && r->quantity[quantity].status == STATUS_OK
               ? r->quantity[quantity].value
               : NAN;
}

/* Twice the larger difference; NAN when one is not known. */
static double noise_of(const scene_quantity *q, double value, const double again[REPETITIONS])
{
    double largest = 0;
    for (int k = 0; k < REPETITIONS; k++) {
        const double scale = fmax(fabs(value), q->near_zero), apart = fabs(again[k] - value);
        if (!isfinite(apart))
            return NAN;
        largest = fmax(largest, apart > 0 ? apart / scale : 0);
    }
    return cover * largest;
}

static status take(const sweep *again, int first, const point *p, series *one, fault *f)
{
    const int quantities = p->scene.quantities;
    free(one->noise);
    one->noise = calloc((size_t)quantities + 1, sizeof *one->noise);
    if (one->noise == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for noise");
    for (int q = 0; q < quantities; q++) {
        double value[REPETITIONS];
        for (int k = 0; k < REPETITIONS; k++)
            value[k] = value_of(again->series[first + k].cell, q);
        const double measured =
            noise_of(&p->scene.quantity[q], value_of(&one->cell[one->meshes - 1], q), value);
        /* differences are off by the same on every mesh: in other words, too */
        one->noise[q] =
            isnan(measured) ? measured : fmax(measured, adapters_error(one->formulation.type));
    }
    return STATUS_OK;
}

static int can_repeat(const sweep *s, int i, const char wanted[])
{
    const series *one = &s->series[i];
    return wanted[i] && one->missing[0] == '\0' && one->meshes > 0 &&
           s->point[one->point].status == STATUS_OK;
}

static status run_again(const sweep_request *request, const char wanted[], const sweep *s,
                        sweep *again, fault *f)
{
    sweep_request quiet = *request;
    quiet.shapes = 0;
    again->values_only = 1;
    quiet.things = "finest meshes again:";
    for (int i = 0; i < s->seriess; i++)
        if (can_repeat(s, i, wanted))
            TRY(add_repetitions(s, &s->series[i], again, f));
    return again->seriess > 0 ? run_sweep(&quiet, again, f) : STATUS_OK;
}

static status take_all(const sweep *again, const char wanted[], sweep *s, fault *f)
{
    int next = 0;
    for (int i = 0; i < s->seriess; i++)
        if (can_repeat(s, i, wanted)) {
            TRY(take(again, next, &s->point[s->series[i].point], &s->series[i], f));
            next += REPETITIONS;
        }
    return STATUS_OK;
}

/* With a sweep that noise_measure frees. */
static status measure(const sweep_request *request, const char wanted[], sweep *s, sweep *again,
                      fault *f)
{
    const status ran = run_again(request, wanted, s, again, f);
    s->unfinished += again->unfinished;
    TRY(ran);
    if (again->unfinished > 0) /* then nothing is measured: series are missing */
        return STATUS_OK;
    return take_all(again, wanted, s, f);
}

status noise_measure(const sweep_request *request, const char wanted[], sweep *s, fault *f)
{
    sweep again = {0};
    const status outcome = measure(request, wanted, s, &again, f);
    sweep_free(&again);
    return outcome;
}

int noise_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].noise != NULL ? REPETITIONS : 0;
    return cells;
}
