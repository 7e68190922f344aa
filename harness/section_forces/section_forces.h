/* section_forces/: forces and moments inside an element, its line and its torque. */
#ifndef BEAMWORK_SECTION_FORCES_H
#define BEAMWORK_SECTION_FORCES_H

#include "elements/element.h"

/* Chebyshev's points of an element, ends included, and what is done with functions through them:
 * integrals, derivatives, values between.  Along [0, 1]. */

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

/* share[SPAN_GRID_POINTS]: weight of each grid point in the value at x. */
void span_grid_at(const span_grid *g, double x, double share[]);

/* out[i][k] = integral from 0 to x[i] of component k; values [points x count], row-major. */
void span_grid_integrate(const span_grid *g, int count, const double values[], double out[]);

/* The line of centroids and the sections' triads between two frames, from its strains. */

typedef struct span_curve {
    double r[SPAN_GRID_POINTS][3], R[SPAN_GRID_POINTS][9]; /* columns: x along the line, y and z */
} span_curve;

typedef struct span_frame {
    double r[3], R[9];
} span_frame;

/* R' = R kappa~, r' = R (e_x + gamma) over [0, 1] in units of the length, kappa[points x 3] and
 * gamma[points x 3] in section axes: Magnus' series of order six between the points.  The curve
 * meets both ends: its gap, an error of discretisation, is distributed in proportion to x. */
void span_curve_between(const span_grid *g, const span_frame *p, const span_frame *q,
                        const double kappa[], const double gamma[], span_curve *out);

/* Section forces of an element, from the forces at its ends and the loads between.
 *
 * Whatever a formulation assumes inside, its elements' ends are in equilibrium.  Between them the
 * line is the one of the exact beam (Simo-Reissner with warping, the section's constants, the
 * physics that is active) that runs from end frame to end frame under F' = -q, m' = -r' x F - mu, N
 * = R^T F, M = R^T m, and the torsion of section_forces_impl.h, from p with the forces at p,
 * which pass in proportion to x into those from q with the forces at q.  An error of the end forces
 * is the only one that is left: a value inside converges as they do, and meets them at the ends. */

/* In the principal axes of the turned section, of what lies towards q on what lies towards p;
 * moments about the centroid. */
enum span_value {
    SPAN_N,
    SPAN_QY,
    SPAN_QZ,
    SPAN_MX,
    SPAN_MY,
    SPAN_MZ,
    SPAN_BIMOMENT,
    /* Parts of the torque about the shear centre, M_x - (ys Qz - zs Qy): G It kappa_x, -B', and
     * what stresses along the turned fibres add, (rho^2 N + bending terms) kappa_x + 4 E c
     * kappa_x^3 */
    SPAN_MX_SAINT_VENANT,
    SPAN_MX_WARPING,
    SPAN_MX_WAGNER,
    SPAN_TWIST, /* kappa_x without the initial one [1/m] */
    SPAN_VALUES
};

typedef struct span_end {
    span_frame frame;           /* [m] */
    double force[3], moment[3]; /* in fixed axes [N, N m] */
    double bimoment, amplitude; /* [N m^2, 1/m] */
} span_end;

typedef struct span_load {
    double force[3], moment[3]; /* per initial length, in fixed axes [N/m, N m/m] */
} span_load;

typedef struct span_problem {
    const element_request
        *request; /* section, length, active physics, initial curvature and strain */
    span_end end[2];
    int linear; /* 1: the frames are those of the undeformed element, where equilibrium is */
    /* Load at x in [0, 1], at r with the triad R; NULL: none. */
    void (*load)(void *context, double x, const span_frame *, span_load *out);
    void *context;
} span_problem;

typedef struct span_fields {
    double value[SPAN_GRID_POINTS][SPAN_VALUES];
} span_fields;

/* NOT_CONVERGED: no line between the ends was found. */
status span_recover(const span_grid *g, const span_problem *problem, span_fields *out, fault *f);

/* out[SPAN_VALUES] at x in [0, 1]. */
void span_at(const span_grid *g, const span_fields *fields, double x, double out[]);

#endif
