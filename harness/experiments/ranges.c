#include "harness/experiments/ranges.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/survey.h"
#include "harness/formulations/formulations.h"

static const double batch_cost = 0.5; /* [s] */
enum { MOST_POINTS_IN_BATCH = 8192, MOST_BATCHES = 100000000 };

/* No parameter twice, in the axes or beside them. */
static status add_axis(parameter_ranges *r, const char *text, fault *f)
{
    if (r->design.axes == CASE_MAX_PARAMETERS)
        return fault_set(f, STATUS_REFUSED, "more than %d --vary; give fewer", CASE_MAX_PARAMETERS);
    sweep_axis *a = &r->axis[r->design.axes];
    TRY(axis_read(r->request.type, text, a, f));
    r->design.axes++;
    for (int i = 0; i < r->design.axes - 1; i++)
        if (r->axis[i].index == a->index)
            return fault_set(f, STATUS_REFUSED, "--vary %s is given twice; give it once",
                             a->of->name);
    return STATUS_OK;
}

static status read_axes(parameter_ranges *r, fault *f)
{
    const assignment_list list = parameters_list(r->request.type);
    char shown[ASSIGNMENT_SHOWN];
    assignment_shown(&list, shown);
    if (r->request.varies == 0)
        return fault_set(f, STATUS_REFUSED,
                         "what varies? give --vary NAME=A..B/N; 'beamwork list %.170s' shows names",
                         shown);
    for (int i = 0; i < r->request.varies; i++)
        TRY(add_axis(r, r->request.vary[i], f));
    const int axes = r->design.axes;
    const status outcome = design_make(r->request.design, axes, r->axis, r->request.points,
                                       r->request.seed, &r->design, f);
    r->design.axes = axes; /* to be freed */
    return outcome;
}

static status cut(parameter_ranges *r, fault *f)
{
    const double fits = floor(batch_cost / fmax(r->point_cost, 1e-9));
    const long most =
        r->design.points < MOST_POINTS_IN_BATCH ? r->design.points : MOST_POINTS_IN_BATCH;
    r->points_in_batch = fits < 1 ? 1 : (long)fmin(fits, (double)most);
    const long batches = (r->design.points + r->points_in_batch - 1) / r->points_in_batch;
    if (batches > MOST_BATCHES)
        return fault_set(f, STATUS_REFUSED,
                         "%ld points of about %.2g s each are too many for a "
                         "sweep; give fewer",
                         r->design.points, r->point_cost);
    r->batches = (int)batches;
    return STATUS_OK;
}

status ranges_make(const ranges_request *request, parameter_ranges *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->request = *request;
    memcpy(out->base, request->base,
           (size_t)parameters_count(request->type) * sizeof *request->base);
    TRY(read_axes(out, f));
    TRY(survey(out, f));
    return cut(out, f);
}

void ranges_free(parameter_ranges *r)
{
    for (int i = 0; i < r->design.axes; i++)
        axis_free(&r->axis[i]);
    design_free(&r->design);
}

rows_shape ranges_shape(const parameter_ranges *r)
{
    return (rows_shape){r->formulations, r->meshes, r->quantities};
}

int ranges_batch(const parameter_ranges *r, int batch, long *first)
{
    *first = batch * r->points_in_batch;
    const long left = r->design.points - *first;
    return (int)(left < r->points_in_batch ? left : r->points_in_batch);
}
