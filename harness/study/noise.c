#include "harness/study/noise.h"

#include <math.h>
#include <stdlib.h>

#include "harness/formulations/formulations.h"

/* the larger of two differences, twice: the standard deviation or more, nineteen times of twenty */
static const double cover = 2;

scene_edit noise_words(const formulation *chosen, int repetition)
{
    if (repetition == 0)
        return (scene_edit){SCENE_EDIT_UNIT, 1000};
    if (chosen->type->limits & LIMIT_ORDER_DEPENDENT)
        return (scene_edit){SCENE_EDIT_UNIT, 0.3};
    return (scene_edit){SCENE_EDIT_REVERSE, 0};
}

static double value_of(const cell_result *cell, int quantity)
{
    const solve_result *r = &cell->solve;
    return quantity < r->quantities && r->quantity[quantity].status == STATUS_OK
               ? r->quantity[quantity].value
               : NAN;
}

/* Twice the larger difference; NAN when one is not known. */
static double noise_of(const scene_quantity *q, double value, const double again[NOISE_REPETITIONS])
{
    double largest = 0;
    for (int k = 0; k < NOISE_REPETITIONS; k++) {
        const double scale = fmax(fabs(value), q->near_zero), apart = fabs(again[k] - value);
        if (!isfinite(apart))
            return NAN;
        largest = fmax(largest, apart > 0 ? apart / scale : 0);
    }
    return cover * largest;
}

int noise_take(const sweep_point *p, const cell_result again[NOISE_REPETITIONS], series *one)
{
    const int quantities = p->scene.quantities;
    free(one->noise);
    one->noise = calloc((size_t)quantities + 1, sizeof *one->noise);
    if (one->noise == NULL)
        return -1;
    for (int q = 0; q < quantities; q++) {
        double value[NOISE_REPETITIONS];
        for (int k = 0; k < NOISE_REPETITIONS; k++)
            value[k] = value_of(&again[k], q);
        const double measured =
            noise_of(&p->scene.quantity[q], value_of(&one->cell[one->meshes - 1], q), value);
        /* differences are off by the same on every mesh: in other words, too */
        one->noise[q] =
            isnan(measured) ? measured : fmax(measured, adapters_error(one->formulation.type));
    }
    return 0;
}

int noise_cells(const sweep *s)
{
    int cells = 0;
    for (int i = 0; i < s->seriess; i++)
        cells += s->series[i].noise != NULL ? NOISE_REPETITIONS : 0;
    return cells;
}
