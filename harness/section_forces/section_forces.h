/* section_forces/: forces and moments inside an element, its centre line and its torque. */
#ifndef BEAMWORK_SECTION_FORCES_H
#define BEAMWORK_SECTION_FORCES_H

#include "elements/element.h"

/* Chebyshev points of an element, including its ends, on [0, 1]: integrals, derivatives and
 * interpolation of functions given there. */

enum {
    SPAN_GRID_POINTS = 24,
    SPAN_GRID_GAUSS = 3 /* Gauss points between two neighbouring points */
};

typedef struct span_grid {
    double x[SPAN_GRID_POINTS];
    double weight[SPAN_GRID_POINTS];                       /* barycentric */
    double integral[SPAN_GRID_POINTS][SPAN_GRID_POINTS];   /* integral from 0 to x[i] */
    double derivative[SPAN_GRID_POINTS][SPAN_GRID_POINTS]; /* at x[i] */
    double gauss[SPAN_GRID_POINTS - 1][SPAN_GRID_GAUSS][SPAN_GRID_POINTS]; /* values there */
} span_grid;

void span_grid_make(span_grid *g);

/* Line of centroids and triads of the sections between two frames, computed from the strains. */

typedef struct span_curve {
    double r[SPAN_GRID_POINTS][3], R[SPAN_GRID_POINTS][9]; /* columns: x along the line, y and z */
} span_curve;

typedef struct span_frame {
    double r[3], R[9];
} span_frame;

/* Section forces of an element, from the forces at its ends and the loads between.
 *
 * The ends of elements are in equilibrium, whatever a formulation assumes inside. Between them the
 * line is that of the exact beam (Simo-Reissner with warping, the constants of the section, the
 * active physics) between the end frames. It satisfies F' = -q, m' = -r' x F - mu, N = R^T F, M =
 * R^T m, and the torsion equations of section_forces_impl.h. The solution that starts at p with the
 * forces at p is blended, in proportion to x, with the solution that starts at q with the forces at
 * q. The only error is that of the end forces: values inside converge like the end forces, and
 * agree with them at the ends. */

/* Action of the part towards q on the part towards p, in the principal axes of the rotated section;
 * moments about the centroid. */
enum span_value {
    SPAN_N,
    SPAN_QY,
    SPAN_QZ,
    SPAN_MX,
    SPAN_MY,
    SPAN_MZ,
    SPAN_BIMOMENT,
    /* Parts of the torque about the shear centre, M_x - (ys Qz - zs Qy): G It kappa_x, -B', and the
       contribution of stresses along the rotated fibres, (rho^2 N + bending terms) kappa_x + 4 E c
       kappa_x^3 */
    SPAN_MX_SAINT_VENANT,
    SPAN_MX_WARPING,
    SPAN_MX_WAGNER,
    SPAN_TWIST, /* kappa_x minus the initial value of kappa_x [1/m] */
    SPAN_VALUES
};

typedef struct span_end {
    span_frame frame;           /* [m] */
    double force[3], moment[3]; /* in global axes [N, N m] */
    double bimoment, amplitude; /* [N m^2, 1/m] */
} span_end;

typedef struct span_load {
    double force[3], moment[3]; /* per initial length, in global axes [N/m, N m/m] */
} span_load;

typedef struct span_problem {
    const element_request
        *request; /* section, length, active physics, initial curvature and strain */
    span_end end[2];
    int linear; /* 1: equilibrium on the frames of the undeformed element */
    /* Load at x in [0, 1], at position r with triad R; NULL: none. */
    void (*load)(void *context, double x, const span_frame *, span_load *out);
    void *context;
} span_problem;

typedef struct span_fields {
    double value[SPAN_GRID_POINTS][SPAN_VALUES];
    span_curve curve; /* in lengths of the element, from p */
    double shear[SPAN_GRID_POINTS][3], bend[SPAN_GRID_POINTS][3]; /* strains, of that length */
} span_fields;

/* Since the undeformed state, in fixed axes. */
typedef struct span_move {
    double displacement[3]; /* [m] */
    double turn[3];         /* rotation vector [rad] */
} span_move;

/* NOT_CONVERGED: no line between the ends was found. */
status span_recover(const span_grid *g, const span_problem *problem, span_fields *out, fault *f);

/* Displacement and rotation of the section at x, from those of the ends. begin: the undeformed
 * frames of the ends, with the initial curvature between. */
void span_moved(const span_grid *, const span_problem *, const span_fields *,
                const span_frame begin[2], const double curvature[3], const span_move end[2],
                double x, span_move *out);

/* out[SPAN_VALUES] at x in [0, 1]. */
void span_at(const span_grid *g, const span_fields *fields, double x, double out[]);

#endif
