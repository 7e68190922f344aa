/* Whether states are stable whose tangent is not symmetric: with a mass by the frequencies of small
 * motions about them, without by the eigenvalues of the tangent that have passed zero. */
#ifndef BEAMWORK_JUDGE_H
#define BEAMWORK_JUDGE_H

#include "harness/analysis/flutter.h"

/* Of one analysis; all zero at first. */
typedef struct flutter_judge {
    int begun;
    newton_run n; /* with a tangent of all coordinates, which that of a path need not have */
    flutter_system of;
} flutter_judge;

/* Into the record of the step that ended at the state. What is not known stays open. It is not
 * counted as work. */
status flutter_judge_state(flutter_judge *, analysis_context *, const model_state *, step_record *,
                           fault *);
/* The same of the state that j->n has; negative_pivots of the record become those of the state, -1:
 * not symmetric, or singular. */
status flutter_judge_begin(flutter_judge *, analysis_context *, fault *);
status flutter_judge_here(flutter_judge *, step_record *, fault *);
void flutter_judge_free(flutter_judge *);

#endif
