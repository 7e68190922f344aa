/* What a bw_result is. */
#ifndef BEAMWORK_RESULT_HANDLE_H
#define BEAMWORK_RESULT_HANDLE_H

#include "harness/library/source.h"
#include "harness/records/records.h"

enum { RESULT_COLUMNS = 32 };

struct bw_result {
    source *from;
    sweep sweep;                    /* of one point, series and mesh */
    truths own;                     /* of a scene file */
    const truths *truths;           /* NULL: none are known */
    double *error;                  /* [quantities] NAN: there is no truth */
    double *step[RESULT_COLUMNS];   /* [steps] of the fields of a step, once they are asked for */
    double *motion[RESULT_COLUMNS]; /* [motions] of those of a motion, likewise */
    double *position;               /* [states x points x 3], likewise */
};

static inline const solve_result *result_handle_solution(const struct bw_result *r)
{
    return &r->sweep.series[0].cell[0].solve;
}

static inline const scene *result_handle_scene(const struct bw_result *r)
{
    return &r->sweep.point[0].scene;
}

#endif
