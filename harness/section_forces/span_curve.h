/* The line of centroids and the sections' triads between two frames, from its strains. */
#ifndef BEAMWORK_SPAN_CURVE_H
#define BEAMWORK_SPAN_CURVE_H

#include "harness/section_forces/span_grid.h"

typedef struct span_curve {
    double r[SPAN_GRID_POINTS][3], R[SPAN_GRID_POINTS][9]; /* columns: x along the line, y and z */
} span_curve;

typedef struct span_frame {
    double r[3], R[9];
} span_frame;

/* R' = R kappa~, r' = R (e_x + gamma) over [0, 1] in units of the length, kappa[points x 3] and
 * gamma[points x 3] in section axes: Magnus' series of order six between the points.  Both ends are
 * met: what is left over, which is an error of discretisation, is spread in proportion to x. */
void span_curve_between(const span_grid *g, const span_frame *p, const span_frame *q,
                        const double kappa[], const double gamma[], span_curve *out);

#endif
