/* A motion that goes on from where another one stopped, as if there had been one only. */
#ifndef BEAMWORK_RESUME_H
#define BEAMWORK_RESUME_H

#include "harness/scheme/instant.h"
#include "harness/solver/context.h"

/* What its steps depend on. */
typedef struct resume_control {
    double step;    /* [s] the next one */
    double largest; /* [J] energy so far */
    int quiet;      /* steps since what acts was last smooth no longer */
} resume_control;

/* Nothing is kept where no analysis follows. */
status resume_keep(const analysis_context *, int analysis, const instant *now,
                   const resume_control *, outcome_motion *, fault *);
/* NOT_CONVERGED: the motion before stopped early. */
status resume_take(const analysis_context *, int before, instant *now, resume_control *, fault *);

#endif
