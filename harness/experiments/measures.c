#include "harness/experiments/measures.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

element_measure *measures_add(measures *m, const char *name)
{
    assert(m->count < MEASURES_MOST);
    element_measure *one = &m->measure[m->count++];
    memset(one, 0, sizeof *one);
    snprintf(one->name, sizeof one->name, "%s", name);
    one->order = NAN;
    return one;
}

void measures_point(element_measure *one, double at, double error)
{
    assert(one->points < MEASURE_POINTS);
    one->at[one->points] = at;
    one->error[one->points++] = error;
}

int measures_astray(const measures *m)
{
    int count = 0;
    for (int i = 0; i < m->count; i++)
        count += m->measure[i].astray;
    return count;
}

int measures_hopeless(const element_measure *one)
{
    for (int i = 0; i < one->points; i++)
        if (!isnan(one->error[i]))
            return 0;
    return one->points >= 3;
}
