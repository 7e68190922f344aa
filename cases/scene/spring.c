#include "cases/scene/scene_impl.h"

#include <math.h>
#include <string.h>

#include "elements/math/dense.h"

/* Copies `given` to A and returns 0. If the matrix is unsymmetric only due to rounding, copies its
 * symmetric part and returns the asymmetry relative to the diagonal. */
static double take_matrix(const double given[36], double A[36])
{
    memcpy(A, given, 36 * sizeof *A);
    const double apart = dense_symmetrise(6, A);
    if (apart <= SECTION_MATRICES_SYMMETRIC)
        return apart;
    memcpy(A, given, 36 * sizeof *A);
    return 0;
}

static int is_symmetric(const double A[36])
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < i; j++)
            if (A[6 * i + j] != A[6 * j + i])
                return 0;
    return 1;
}

int scene_spring_circulates(const scene_spring *p)
{
    return !is_symmetric(p->stiffness);
}

int scene_spring_gyrates(const scene_spring *p)
{
    return !is_symmetric(p->damping);
}

void scene_damp_spring(scene *s, int spring, const double damping[36])
{
    s->spring[spring].damping_asymmetry = take_matrix(damping, s->spring[spring].damping);
}

int scene_spring_damps(const scene_spring *p)
{
    for (int k = 0; k < 36; k++)
        if (p->damping[k] != 0)
            return 1;
    return 0;
}

int scene_add_spring(scene *s, int p, int q, const double stiffness[36])
{
    const int i = scene_grow(s, &s->spring, &s->springs, sizeof *s->spring);
    if (i >= 0) {
        s->spring[i].p = p;
        s->spring[i].q = q;
        s->spring[i].asymmetry = take_matrix(stiffness, s->spring[i].stiffness);
    }
    return i;
}

void scene_set_table(scene *s, int spring, int component, int points, const double at[],
                     const double value[])
{
    if (spring < 0)
        return;
    scene_table *t = &s->spring[spring].table[component];
    t->at = (scene_path){points, scene_copy(s, points, at)};
    t->value = (scene_path){points, scene_copy(s, points, value)};
}

/* Returns i such that x is between points i and i + 1; beyond the table, the first or the last such
 * i. */
static int line_of(const scene_table *t, double x)
{
    int i = 0;
    while (i + 2 < t->at.stations && x >= t->at.value[i + 1])
        i++;
    return i;
}

double scene_table_at(const scene_table *t, double x, double *slope)
{
    *slope = 0;
    if (t->at.stations < 2)
        return 0;
    const int i = line_of(t, x);
    const double *at = t->at.value + i, *value = t->value.value + i;
    *slope = (value[1] - value[0]) / (at[1] - at[0]);
    return fabs(x - at[0]) <= fabs(x - at[1]) ? value[0] + *slope * (x - at[0])
                                              : value[1] + *slope * (x - at[1]);
}

double scene_table_work(const scene_table *t, double from, double to)
{
    const double end = fmax(from, to);
    double x = fmin(from, to), sum = 0, slope;
    for (int i = 1; i < t->at.stations && x < end; i++) {
        const double last = i + 1 < t->at.stations ? fmin(end, t->at.value[i]) : end;
        if (last <= x)
            continue;
        sum += (scene_table_at(t, x, &slope) + scene_table_at(t, last, &slope)) / 2 * (last - x);
        x = last;
    }
    return from <= to ? sum : -sum;
}

int scene_spring_kink(const scene_spring *p)
{
    for (int k = 0; k < 6; k++) {
        const scene_table *t = &p->table[k];
        double before, behind;
        for (int i = 1; i + 1 < t->at.stations; i++) {
            scene_table_at(t, t->at.value[i - 1], &before);
            scene_table_at(t, t->at.value[i], &behind);
            if (t->at.value[i] == 0 && fabs(behind - before) > 1e-9 * fmax(behind, before))
                return k;
        }
    }
    return SCENE_NONE;
}
