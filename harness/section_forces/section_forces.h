#ifndef BEAMWORK_SECTION_FORCES_H
#define BEAMWORK_SECTION_FORCES_H

#include "elements/element.h"

/* Grid of Chebyshev points on an element, including its ends, on [0, 1]. */

enum {
    SPAN_GRID_POINTS = 24,
    SPAN_GRID_GAUSS = 3 /* number of Gauss points between two neighbouring grid points */
};

typedef struct span_grid {
    double x[SPAN_GRID_POINTS];
    double weight[SPAN_GRID_POINTS];                       /* barycentric weights */
    double integral[SPAN_GRID_POINTS][SPAN_GRID_POINTS];   /* [i][j] weight of the value at x[j] in
                                                              the integral from 0 to x[i] */
    double derivative[SPAN_GRID_POINTS][SPAN_GRID_POINTS]; /* [i][j] weight of the value at x[j] in
                                                              the derivative at x[i] */
    double gauss[SPAN_GRID_POINTS - 1][SPAN_GRID_GAUSS]
                [SPAN_GRID_POINTS]; /* [i][k][j] weight of the value at x[j] in the value at Gauss
                                       point k between x[i] and x[i + 1] */
} span_grid;

void span_grid_make(span_grid *g);

/* Line of centroids of an element and triads of its sections, between two frames. */

typedef struct span_curve {
    /* r: centroid; columns of R: axes x (along the line), y and z of the section */
    double r[SPAN_GRID_POINTS][3], R[SPAN_GRID_POINTS][9];
} span_curve;

typedef struct span_frame {
    double r[3], R[9];
} span_frame;

/* Section forces of an element, from the forces at its ends and the loads between the ends. The end
 * forces of elements are in equilibrium, regardless of the assumptions of a formulation. Between
 * the ends, the line is that of the exact beam between the end frames (Simo-Reissner with warping,
 * the constants of the section, and the active physics). */

/* Action of the part towards q on the part towards p (the end and the start of the element), in the
 * principal axes of the rotated section. Moments are about the centroid. */
enum span_value {
    SPAN_N,
    SPAN_QY,
    SPAN_QZ,
    SPAN_MX,
    SPAN_MY,
    SPAN_MZ,
    SPAN_BIMOMENT,
    /* Parts of the torque about the shear centre, M_x - (ys Qz - zs Qy): G It kappa_x, -B', and the
     * contribution of stresses along the rotated fibres, (rho^2 N + bending terms) kappa_x + 4 E c
     * kappa_x^3 (rho: polar radius of gyration about the shear centre, c: Wagner constant). */
    SPAN_MX_SAINT_VENANT,
    SPAN_MX_WARPING,
    SPAN_MX_WAGNER,
    SPAN_TWIST, /* [1/m] kappa_x minus its initial value */
    SPAN_VALUES
};

typedef struct span_end {
    span_frame frame; /* frame of an end, including its position [m] */
    double force[3],
        moment[3]; /* action of the part towards q on the part towards p, in global axes [N, N m] */
    double bimoment, amplitude; /* [N m^2, 1/m] */
} span_end;

typedef struct span_load {
    /* force and moment per initial length, in global axes [N/m, N m/m] */
    double force[3], moment[3];
} span_load;

typedef struct span_problem {
    const element_request
        *request; /* section, length, active physics, initial curvature and initial strain */
    span_end end[2];
    int linear; /* 1: equilibrium is formulated for the undeformed element */
    /* Computes the load at x in [0, 1] on a section with this frame; NULL: there is no load. */
    void (*load)(void *context, double x, const span_frame *, span_load *out);
    void *context;
} span_problem;

typedef struct span_fields {
    double value[SPAN_GRID_POINTS][SPAN_VALUES];
    span_curve curve; /* lengths relative to the length of the element, with p as origin */
    /* strains; curvatures are multiplied by the length of the element */
    double shear[SPAN_GRID_POINTS][3], bend[SPAN_GRID_POINTS][3];
} span_fields;

/* Motion of a section from the undeformed state, in fixed axes. */
typedef struct span_move {
    double displacement[3];
    double turn[3]; /* rotation vector [rad] */
} span_move;

/* Computes the section forces. NOT_CONVERGED: no line between the ends was found. SINGULAR: the
 * torsion of a linear problem is singular. Other statuses: the section cannot be used
 * (beam_constants_of). */
status span_recover(const span_grid *g, const span_problem *problem, span_fields *out, fault *f);

/* Computes the displacement and the rotation of the section at x from those of the ends. begin:
 * undeformed frames of the ends. The line between them has the initial curvature. */
void span_moved(const span_grid *, const span_problem *, const span_fields *,
                const span_frame begin[2], const double curvature[3], const span_move end[2],
                double x, span_move *out);

/* Computes the values at x in [0, 1]: out[SPAN_VALUES]. */
void span_at(const span_grid *g, const span_fields *fields, double x, double out[]);

#endif
