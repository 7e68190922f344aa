/* Integrators as a command line names them. */
#ifndef BEAMWORK_PACE_METHOD_H
#define BEAMWORK_PACE_METHOD_H

#include "cases/scene/scene.h"

enum { PACE_METHOD_NAME = 32, PACE_REFERENCE_ORDER = 5 }; /* the reference is radau */

typedef struct pace_method {
    char name[PACE_METHOD_NAME]; /* as it was given */
    scene_scheme scheme;
    scene_alpha alpha;
    int order;    /* in time, of what is resolved */
    int estimate; /* 1: it estimates the error of a step */
} pace_method;

#define PACE_METHODS                                                                               \
    "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit"

/* What is taken where none is named. */
extern const char pace_method_all[];
/* One of PACE_METHODS, R in [0, 1], A in [0, 1/3]. REFUSED: the culprit. */
status pace_method_read(const char *text, int length, pace_method *out, fault *f);
/* "NAME,NAME,...", each once, behind those that there are. */
status pace_method_read_list(const char *text, int most, pace_method list[], int *count, fault *f);

#endif
