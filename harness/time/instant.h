/* What a motion is at one instant. */
#ifndef BEAMWORK_INSTANT_H
#define BEAMWORK_INSTANT_H

#include "harness/newton/newton.h"

typedef struct instant {
    double time; /* [s] */
    model_state *state;
    double *v, *a;           /* [free + driven] rates and their derivatives: see forms.h */
    double work, dissipated; /* [J] since the begin: by what acts from outside; by damping */
    double *strain,
        *strain2; /* [elements x strains] rates of the strains of what is damped, and
                     their derivatives as generalized-alpha has them; NULL: nothing is */
    double stress,
        contraction;   /* largest stress so far, and how Newton contracted last: newton.h */
    double *ends;      /* [released ends x 6] of their masses as conserving steps go on with them:
                          velocity of the centre, angular one in the end's axes; NULL: none is */
    int ends_known;    /* 0: they are those of v */
    double *algorithm; /* [free + driven] of generalized-alpha: the acceleration it averages */
} instant;

status instant_alloc(const model *, instant *, fault *);
void instant_free(instant *);
void instant_copy(const model *, const instant *from, instant *to);
/* Numbers in `ends`. */
size_t instant_ends(const model *);
/* What Newton's arrivals know of the motion so far belongs to it: a step that was tried in vain
 * leaves nothing behind. To be said before a step, and with the instant it has come to. */
void instant_recall(const instant *from, arrival *);
void instant_remember(const arrival *, instant *to);

#endif
