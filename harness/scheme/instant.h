/* What a motion is at one instant. */
#ifndef BEAMWORK_INSTANT_H
#define BEAMWORK_INSTANT_H

#include "harness/model/model.h"

typedef struct instant {
    double time; /* [s] */
    model_state *state;
    double *v, *a;           /* [free + driven] rates and their derivatives: see forms.h */
    double work, dissipated; /* [J] since the begin: by what acts from outside; by damping */
    double *strain,
        *strain2;      /* [elements x strains] rates of the strains of what is damped, and
                          their derivatives as generalized-alpha has them; NULL: nothing is */
    double *algorithm; /* [free + driven] of generalized-alpha: the acceleration it averages */
} instant;

status instant_alloc(const model *, instant *, fault *);
void instant_free(instant *);
void instant_copy(const model *, const instant *from, instant *to);

#endif
