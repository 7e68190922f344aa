/* Outputs of the functions of an element (element.h) with n nodes and 7n coordinates. Matrices are
 * row-major. Outputs that are NULL are not computed. */
#ifndef BEAMWORK_ELEMENT_OUTPUT_H
#define BEAMWORK_ELEMENT_OUTPUT_H

/* Outputs of `strain`. */
typedef struct strain_output {
    double *e;       /* [strains] [m] */
    double *J;       /* [strains x 7 nodes] de/dx */
    const double *s; /* in: [strains] stresses for H, or NULL if H is not requested */
    double *H;       /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2, overwritten */
    const double
        *history; /* in: [history] values of the last accepted state, or NULL without a history */
} strain_output;

/* Outputs of `stress`. */
typedef struct stress_output {
    double *energy; /* [1] [J] */
    double *
        sigma; /* [strains] [N] stresses, after elimination of the residual of any inner unknowns */
    double *C; /* [strains x strains] dsigma/de [N/m], after elimination of the inner unknowns */
    double *residual; /* [1] dimensionless size of the residual of the inner equations (0 without
                         inner unknowns) */
    double
        *memory; /* [memory] eliminated inner equations, which `stress` writes and `update` reads */
    /* in: [history] values of the last accepted state, or NULL; used only by `stress` of a type
     * that the program completes from `force` */
    const double *history;
    /* in: [strains] stresses of the iteration, which differ from those of e until Newton's method
     * has converged, or NULL: those of e. The part of C that depends on stresses may use them */
    const double *state;
} stress_output;

/* Outputs of `inertia`. */
typedef struct inertia_output {
    double *M; /* [7n x 7n] mass matrix (translations in kg), or the mass matrix for transient
                  analysis if `rate` is given */
    /* Only in a rotating frame, and otherwise zero. */
    double *potential; /* [1] centrifugal potential -1/2 int |Omega x r|^2 dm [J] */
    double *force; /* [7n] centrifugal forces, directed outward: -d potential/dx [N, N m, N m^2] */
    double *N;     /* [7n x 7n] d2 potential/dx2, symmetric: centrifugal softening */
    double *G;     /* [7n x 7n] skew-symmetric gyroscopic matrix in M x'' + G x' + (K + N) x = 0 */
    /* Only in transient analysis in a frame that does not rotate, for types with consistent mass
     * (element_type.spreads). */
    const double *rate; /* in: [7n] x', with spatial angular velocities, or NULL if the analysis is
                           not transient */
    const double
        *acceleration; /* in: [7n] x'', the time derivative of `rate`, or NULL if it is zero */
    double *taken;     /* [7n] inertia forces M x'' + h(x, x'), derived from the kinetic energy */
    double *C;         /* [7n x 7n] d taken/dx' */
    double *K; /* [7n x 7n] d taken/dx at constant x' and x'', in the exponential chart. Omitted
                  terms only increase the number of iterations */
} inertia_output;

/* Outputs of `force`, which replaces the functions `strain` and `stress`. */
typedef struct force_output {
    double *energy; /* [1] [J]. Not requested with a history */
    double
        *F; /* [7 nodes] d energy/dx: forces on the nodes [N], moments [N m], bimoments [N m^2] */
    double *K; /* [7 nodes x 7 nodes] dF/dx. Without a history, only the symmetric part is used.
                  Therefore K may be the derivative of F along spatial increments or the second
                  derivative of the energy in the exponential chart. With a history, K is the
                  derivative of F along spatial increments, and may be unsymmetric */
    const double
        *history; /* in: [history] values of the last accepted state, or NULL without a history */
} force_output;

/* Number of points of a load along an element, and number of coordinates of its two nodes. */
enum { ELEMENT_ALONG_POINTS = 8, ELEMENT_ALONG_COORDINATES = 14 };

/* Input and outputs of `along`: a dead force per length along an element of two nodes. The total
 * nodal forces in a state are
 *   J^T sigma + turn^T (moment + mixed^T (D(x) - e)) - ends,
 * where turn dx is the rotation of the frame of the strains due to dx, in the axes of that
 * frame. */
typedef struct along_output {
    const double *force; /* in: [8 x 3] at the Gauss points of [0, 1], in global axes [N/m] */
    const double *rate;  /* in: direction in which the force changes, with the layout of `force`, or
                            NULL. If it is not NULL, sigma, moment and ends are derivatives with
                            respect to the size of `rate`, and other outputs are not used */
    const double *e; /* in: [strains], or NULL for an undeformed element, whose outputs are linear
                        in the force */
    const double *inner; /* in: [inner] */
    double
        *sigma; /* output sigma of `stress` under the force; in the linear case, for fixed nodes */
    double *C; /* output C of `stress`; in the linear case, the geometric stiffness of the prestress
                  [strains x strains] */
    double *memory;   /* as `stress` */
    double *mixed;    /* [strains x 3] derivative of sigma with respect to the rotation of the frame
                         [N]; in the linear case only if H is requested */
    double *followed; /* [inner x 3] derivative of the inner unknowns with respect to the rotation
                         of the frame, which `update` does not include; may be NULL */
    double *H; /* [14 x 14] second derivative of the energy due to the rotations of the nodes, in
                  the exponential chart and without turn^T second turn; may be NULL */
    double turn[3 * ELEMENT_ALONG_COORDINATES]; /* [3 x 14] */
    double ends[ELEMENT_ALONG_COORDINATES];     /* forces acting directly on the nodes [N, N m] */
    double moment[3]; /* derivative of the energy with respect to the rotation of the frame [N m] */
    double second[9]; /* [3 x 3] second derivative of the energy with respect to that rotation [N
                         m], or zero in the linear case */
} along_output;

/* Input and outputs of `line` at one point of an element with n nodes. A force f and a moment m in
 * global axes at the point have the generalised forces P^T f + T^T m. */
typedef struct line_output {
    double at; /* in: position in the undeformed element divided by its length, 0 to 1 */
    double force[3], moment[3]; /* in: f [N] and m [N m], for H */
    double r[3];                /* position of the line [m] */
    double R[9]; /* axes of the section as columns, in the undeformed state those of the element */
    double *P;   /* [3 x 7n] dr/dx */
    double *T;   /* [3 x 7n] rotation of the section about global axes per coordinate: dR R^T is the
                    cross product with T dx */
    double *H;   /* [7n x 7n] derivative of P^T f + T^T m with respect to x at constant f and m, in
                    the exponential chart: d2(f . r)/dx2 for a force */
} line_output;

/* Outputs of `equations_many`: the condensed mixed equations of an element (N section 4). */
typedef struct equations_output {
    double *J;               /* [strains x 7 nodes] de/dx */
    double *C;               /* [strains x strains] dsigma/de [N/m] */
    double *memory;          /* [memory] the memory that `stress` writes */
    double *incompatibility; /* [strains] D(x) - e [m] */
    double *sigma;           /* [strains] stress(e) + C (D(x) - e) [N] */
    double *force;           /* [7 nodes] J^T sigma */
    double *present;         /* [7 nodes] J^T s */
    double *K;               /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2 + J^T C J, or NULL */
} equations_output;

#endif
