/* What a state of a model consists of, for those who advance one. */
#ifndef BEAMWORK_MODEL_STATE_H
#define BEAMWORK_MODEL_STATE_H

#include <stddef.h>

#include "harness/model/model.h"

struct model_state {
    double path;
    size_t size; /* doubles in block */
    double *block;
    double *u;      /* [vertices x 3] displacement */
    double *q;      /* [vertices x 4] orientation */
    double *angle;  /* [vertices x 3] of sequences; accumulated spatial increments otherwise */
    double *shift;  /* [releases x 3] along slides */
    double *warp;   /* [warps] */
    double *driver; /* [drivers] present value */
    double *e, *sigma, *inner; /* [elements x strains], [.. inner] */
    double *turn;              /* [turns x 3] rotation vectors that have been followed: turns.h */
};

#endif
