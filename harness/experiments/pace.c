#include "harness/experiments/pace.h"

#include <stdlib.h>
#include <string.h>

const double pace_growth = 0.01, pace_energy = 1e-11, pace_momentum = 1e-12,
             pace_reference[1 + PACE_CHECKS] = {1e-10, 1e-8, 1e-6};

void pace_free(pace *p)
{
    for (int i = 0; i < p->runs; i++)
        free(p->run[i].values);
    sweep_free(&p->sweep);
    free(p->group);
    free(p->run);
    memset(p, 0, sizeof *p);
}

const char *pace_fate_name(pace_fate fate)
{
    static const char *const name[PACE_FATES] = {"", "grows", "stops", "bounded", "exact"};
    return name[fate];
}

const sweep_point *pace_point_of(const pace *p, const pace_run *r)
{
    return &p->sweep.point[p->sweep.series[r->series].point];
}

const cell_result *pace_cell_of(const pace *p, int index)
{
    return &p->sweep.series[index].cell[0];
}
