#include "harness/study/expense.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the path that an analysis walks, or that of the one it follows. */
static double stations_of(const scene *s, const scene_analysis *a)
{
    while (scene_path_of(a) == NULL && a->follows != SCENE_NONE)
        a = &s->analysis[a->follows];
    return scene_path_of(a) != NULL ? scene_path_of(a)->stations : 1;
}

/* Steps that were shorter to begin with become whole ones. */
static double steps_of(const scene_analysis *a, int steps)
{
    const int between = steps > 0 ? steps : scene_walk_of(a)->steps_between;
    return scene_path_of(a)->stations + between - 1;
}

/* Steps of a motion. Those that adapt to a tolerance are about as many whatever the motion, which
 * is posed at its own pace, and more by a power of the tolerance: measured on four motions. */
static double motion_steps(const scene_motion *m)
{
    static const double usual = 1e-4, steps[] = {80, 40}, power[] = {0.45, 0.3};
    const int high = m->scheme == SCENE_RADAU;
    if (m->tolerance > 0 && m->scheme != SCENE_EXPLICIT)
        return steps[high] * pow(usual / m->tolerance, power[high]);
    return ceil(m->path.value[m->path.stations - 1] / m->step * (1 - 1e-9));
}

static void count_analysis(const scene *s, const scene_analysis *a, int steps, double times[])
{
    switch (a->kind) {
    case SCENE_LINEAR:
        times[EXPENSE_linear]++;
        break;
    case SCENE_BUCKLING:
        times[a->follows != SCENE_NONE ? EXPENSE_loaded_buckling : EXPENSE_buckling]++;
        break;
    case SCENE_MODAL:
        times[EXPENSE_modal]++;
        break;
    case SCENE_MOTION:
        times[EXPENSE_alpha_step + (int)scene_motion_of(a)->scheme] +=
            motion_steps(scene_motion_of(a));
        break;
    case SCENE_STATIC:
        times[EXPENSE_load_step] += steps_of(a, steps);
        break;
    case SCENE_COMPLIANCE:
        times[EXPENSE_compliance] += stations_of(s, a);
        break;
    case SCENE_CONTINUATION:
        times[EXPENSE_continuation]++;
        break;
    case SCENE_ROTATION:
        times[EXPENSE_rotation_step] += steps_of(a, steps);
        times[EXPENSE_rotation_station] += stations_of(s, a);
        break;
    }
}

void expense_count(const scene *s, int steps, double times[EXPENSE_KINDS])
{
    for (int k = 0; k < EXPENSE_KINDS; k++)
        times[k] = k == EXPENSE_cell;
    for (int i = 0; i < s->analyses; i++)
        if (scene_reads(s, i))
            count_analysis(s, &s->analysis[i], steps, times);
}

static expense_price own_factor(const element_type *type)
{
    const expense_factor *row = expense_factors;
    while (row->formulation != NULL && strcmp(row->formulation, type->name) != 0)
        row++;
    return row->factor;
}

double expense_of_scene(const scene *s, int steps, const element_type *type, int elements)
{
    const expense_price own = own_factor(type);
    const double all = (double)elements * s->members;
    double times[EXPENSE_KINDS], sum = 0;
    expense_count(s, steps, times);
    for (int k = 0; k < EXPENSE_KINDS; k++)
        sum += times[k] *
               (expense_work[k].once * own.once + expense_work[k].element * own.element * all);
    return sum;
}

double expense_of_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    return expense_of_scene(&p->scene, p->steps, one->formulation.type, one->mesh[mesh]);
}

/* Of the share of one process: what costs less is no matter at the end. */
static const double dear_share = 0.01;

/* A series that is run. */
typedef struct expense {
    double all; /* 0: not dear */
    int series;
} expense;

/* Of two that cost the same, the first. */
static int dearest(const void *left, const void *right)
{
    const expense *a = left, *b = right;
    if (a->all != b->all)
        return a->all > b->all ? -1 : 1;
    return a->series < b->series ? -1 : 1;
}

int expense_order(const sweep *s, int jobs, workload_task tasks[])
{
    double sum = 0;
    expense *list = malloc(((size_t)s->seriess + 1) * sizeof *list);
    int count = 0, n = 0;
    if (list == NULL)
        return -1;
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        if (one->missing[0] != '\0' || one->imported != NULL ||
            s->point[one->point].status != STATUS_OK)
            continue;
        list[count] = (expense){0, i};
        for (int k = 0; k < one->meshes; k++)
            list[count].all += expense_of_cell(s, i, k);
        sum += list[count++].all;
    }
    for (int i = 0; i < count; i++)
        if (list[i].all * jobs < dear_share * sum)
            list[i].all = 0;
    qsort(list, (size_t)count, sizeof *list, dearest);
    for (int i = 0; i < count; i++)
        for (int k = s->series[list[i].series].meshes - 1; k >= 0; k--)
            tasks[n++] = (workload_task){.series = list[i].series, .mesh = k};
    free(list);
    return 0;
}
