/* Chebyshev's points of an element, ends included, and what is done with functions through them:
 * integrals, derivatives, values between.  Along [0, 1]. */
#ifndef BEAMWORK_SPAN_GRID_H
#define BEAMWORK_SPAN_GRID_H

enum {
    SPAN_GRID_POINTS = 24,
    SPAN_GRID_GAUSS = 3 /* within each gap between two points */
};

typedef struct span_grid {
    double x[SPAN_GRID_POINTS];
    double weight[SPAN_GRID_POINTS];                                       /* barycentric */
    double integral[SPAN_GRID_POINTS][SPAN_GRID_POINTS];                   /* from 0 to x[i] */
    double derivative[SPAN_GRID_POINTS][SPAN_GRID_POINTS];                 /* at x[i] */
    double gauss[SPAN_GRID_POINTS - 1][SPAN_GRID_GAUSS][SPAN_GRID_POINTS]; /* values there */
} span_grid;

void span_grid_make(span_grid *g);

/* What each point counts for in the value at x: share[SPAN_GRID_POINTS]. */
void span_grid_at(const span_grid *g, double x, double share[]);

/* out[i][k] = integral from 0 to x[i] of component k; values [points x count], row-major. */
void span_grid_integrate(const span_grid *g, int count, const double values[], double out[]);

#endif
