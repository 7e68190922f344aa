/* A motion that goes on from where another one stopped, as if there had been one only. */
#ifndef BEAMWORK_RESUME_H
#define BEAMWORK_RESUME_H

#include "harness/newton/newton.h"
#include "harness/time/account.h"
#include "harness/time/extent.h"
#include "harness/time/instant.h"

/* What its steps depend on. */
typedef struct resume_control {
    double step; /* [s] the next one */
    account account;
    double origin; /* [J] energy at the begin */
    int quiet;     /* steps since what acts was last smooth no longer */
    extent extent;
} resume_control;

/* For a motion of the scene that goes on from this one, or, of the last one, for another run
 * (solve_options.keep_ends); else nothing is kept. */
status resume_keep(const analysis_context *, int analysis, const instant *now,
                   const resume_control *, outcome_motion *, fault *);
/* Where the motion begins that another run stopped; NULL: it does not go on from one. */
const outcome_end *resume_given(const analysis_context *, int analysis);
/* Of a motion before it. NOT_CONVERGED: that stopped early. */
status resume_before(const analysis_context *, int before, const outcome_end **, fault *);
/* REFUSED: it is of another mesh. */
status resume_take(const analysis_context *, const outcome_end *, instant *now, resume_control *,
                   fault *);

#endif
