/* Modes followed over a parameter of a case.
 *
 * Those of neighbouring values are matched by the modal assurance criterion of the mass matrix M at
 * the new one, (v^T M w)^2/((v^T M v)(w^T M w)), which is 1 of the same shape.  Where a match is
 * below 0.9 the step is halved.  Equal frequencies have no shapes of their own: the shape of before
 * is projected into their space.  Frequencies of followed modes then cross, or avoid each other
 * (veer) while their shapes change places. */
#ifndef BEAMWORK_FOLLOW_H
#define BEAMWORK_FOLLOW_H

#include "harness/study/cell.h"

typedef struct follow_request {
    cell_request cell; /* with the type and its parameters; what of it is solved is set here */
    int parameter;     /* index of the one that varies */
    double from, to;
    int parts; /* equal ones at least */
} follow_request;

typedef struct follow_sample {
    double value;      /* of the parameter */
    int asked;         /* 0: between two values that were asked for */
    double *frequency; /* [modes] [Hz] */
    double *match;     /* [modes] with the sample before; of the first: 1 */
} follow_sample;

typedef struct follow_event {
    int crossing; /* 0: a veering */
    int mode[2];
    double value;     /* of the parameter */
    double frequency; /* [Hz] mean of both */
    double gap;       /* of a veering: least distance of the two, in parts of it */
} follow_event;

typedef struct follow_curves {
    int modes, samples, events;
    follow_sample *sample; /* [samples] from `from` to `to` */
    follow_event *event;   /* [events] */
} follow_curves;

/* As many modes as the first modal analysis has frequencies as quantities, the lowest at `from`.
 * REFUSED: no modal analysis, or coordinates that change with the parameter; NOT_CONVERGED: a mode
 * is lost however small the step. */
status follow_run(const follow_request *, follow_curves *, fault *);
void follow_free(follow_curves *);

#endif
