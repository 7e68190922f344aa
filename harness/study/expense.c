#include "harness/study/expense.h"

#include <stdlib.h>

/* Evaluations of each element, counted in `verify` and rounded. */
static const double of_load_step = 4, of_compliance = 5, of_eigenvalues = 10, of_modes = 20,
                    of_curve = 60;
static const double beginning = 4; /* elements that what a cell takes without any is worth */

/* Of the path that an analysis walks, or that of the one it follows. */
static double stations_of(const scene *s, const scene_analysis *a)
{
    while (scene_path_of(a) == NULL && a->follows != SCENE_NONE)
        a = &s->analysis[a->follows];
    return scene_path_of(a) != NULL ? scene_path_of(a)->stations : 1;
}

static double steps_of(const point *p, const scene_analysis *a)
{
    const int between = p->steps > 0 ? p->steps : scene_walk_of(a)->steps_between;
    return scene_path_of(a)->stations * (double)between;
}

static double times_of(const point *p, const scene_analysis *a)
{
    switch (a->kind) {
    case SCENE_LINEAR:
        return 1;
    case SCENE_BUCKLING: /* about a loaded state a path to the critical point */
        return a->follows != SCENE_NONE ? of_curve : of_eigenvalues;
    case SCENE_MODAL:
        return of_eigenvalues;
    case SCENE_STATIC:
        return of_load_step * steps_of(p, a);
    case SCENE_COMPLIANCE:
        return of_compliance * stations_of(&p->scene, a);
    case SCENE_CONTINUATION:
        return of_curve;
    case SCENE_ROTATION:
        return of_load_step * steps_of(p, a) + of_modes * stations_of(&p->scene, a);
    }
    return 0;
}

double expense_of_cell(const sweep *s, int series_index, int mesh)
{
    const series *one = &s->series[series_index];
    const point *p = &s->point[one->point];
    double times = 1;
    for (int i = 0; i < p->scene.analyses; i++)
        times += times_of(p, &p->scene.analysis[i]);
    return times * (beginning + (double)one->mesh[mesh] * p->scene.members);
}

/* A series that is run. */
typedef struct expense {
    double all;
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

int expense_order(const sweep *s, task tasks[])
{
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
        count++;
    }
    qsort(list, (size_t)count, sizeof *list, dearest);
    for (int i = 0; i < count; i++)
        for (int k = s->series[list[i].series].meshes - 1; k >= 0; k--)
            tasks[n++] = (task){list[i].series, k};
    free(list);
    return 0;
}
