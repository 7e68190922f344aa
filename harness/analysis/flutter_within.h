/* Whether stability is lost and regained within a step of a static path, as far as that lasts a
 * fifth of the step: its state is looked at after every sixth. */
#ifndef BEAMWORK_WITHIN_H
#define BEAMWORK_WITHIN_H

#include "harness/analysis/flutter_judge.h"

/* The step led from one state to the other. *found: path of a part of it whose stability is not
 * between those of the ends; INFINITY: there is none that could be reached. It is not counted as
 * work. */
status within_step(flutter_judge *, analysis_context *, const model_state *from,
                   const model_state *to, double *found, fault *);

#endif
