/* Outputs of the functions of an element (element.h) with n nodes and 7n coordinates. Matrices are
 * row-major. Outputs that are NULL are not computed. */
#ifndef BEAMWORK_ELEMENT_OUTPUT_H
#define BEAMWORK_ELEMENT_OUTPUT_H

/* Outputs of `strain`. */
typedef struct strain_output {
    double *e;       /* [strains] [m] */
    double *J;       /* [strains x 7 nodes] de/dx */
    const double *s; /* in: [strains] stresses for H; NULL: H not needed */
    double *H;       /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2, overwritten */
} strain_output;

/* Outputs of `stress`. */
typedef struct stress_output {
    double *energy;   /* [1] [J] */
    double *sigma;    /* [strains] [N]; with inner unknowns: after elimination of their residual */
    double *C;        /* [strains x strains] dsigma/de [N/m], inner unknowns eliminated */
    double *residual; /* [1] dimensionless size of the inner residual (0 without inner unknowns) */
    double *memory; /* [memory] filled by stress, read by update: the eliminated inner equations */
} stress_output;

/* Outputs of `inertia`. */
typedef struct inertia_output {
    double *M; /* [7n x 7n] mass matrix: translations [kg]; with `rate`, the mass matrix for
                  transient analysis */
    /* Only in a rotating frame; zero without rotation. */
    double *potential; /* [1] centrifugal: -1/2 int |Omega x r|^2 dm [J] */
    double *force;     /* [7n] centrifugal, outward: -d potential/dx [N, N m, N m^2] */
    double *N;         /* [7n x 7n] d2 potential/dx2, symmetric: centrifugal softening */
    double *G;         /* [7n x 7n] gyroscopic, skew: M x'' + G x' + (K + N) x = 0 */
    /* In transient analysis, for types with consistent mass (element_type.spreads), without a
     * rotating frame. */
    const double
        *rate; /* in: [7n] x', angular velocities spatial; NULL: not a transient analysis */
    const double *acceleration; /* in: [7n] its derivative x''; NULL: zero */
    double *taken; /* [7n] M x'' + h(x, x'): inertia forces, derived from the kinetic energy */
    double *C;     /* [7n x 7n] d taken/dx' */
    double *K; /* [7n x 7n] d taken/dx at fixed x' and x'', in the exponential chart; omitted terms
                  only increase the number of iterations */
} inertia_output;

/* Outputs of `force`, which replaces strain and stress functions. */
typedef struct force_output {
    double *energy; /* [1] [J] */
    double
        *F; /* [7 nodes] d energy/dx: forces on the nodes [N], moments [N m], bimoments [N m^2] */
    double *K; /* [7 nodes x 7 nodes] dF/dx. Only its symmetric part is used, so that it may be the
                  derivative of F along spatial increments or the second derivative of the energy in
                  the exponential chart */
} force_output;

/* Number of points of a load along an element, and number of coordinates of its two nodes. */
enum { ELEMENT_ALONG_POINTS = 8, ELEMENT_ALONG_COORDINATES = 14 };

/* Input and outputs of `along`: a dead force per length along an element of two nodes. All forces
 * in a state are
 *   J^T sigma + turn^T (moment + mixed^T (D(x) - e)) - ends,
 * where the frame of the strains rotates by turn dx in its own axes. */
typedef struct along_output {
    const double *force; /* in: [8 x 3] at Gauss points of [0, 1], global axes [N/m] */
    const double *rate;  /* in: like force; if not NULL, sigma, moment and ends are derivatives with
                          * respect to the size of `rate`, and other outputs are not used */
    const double *e;     /* in: [strains]; NULL: for the undeformed element, linear in the force */
    const double *inner; /* in: [inner] */
    double *sigma;       /* as `stress`, under the force; linear case: for fixed nodes */
    double *
        C; /* as `stress`; linear case: geometric stiffness of that prestress [strains x strains] */
    double *memory;   /* as `stress` */
    double *mixed;    /* [strains x 3] derivative of sigma with respect to the rotation [N]; linear
                         case: only with H */
    double *followed; /* [inner x 3] derivative of the inner unknowns with respect to the rotation,
                       * which `update` does not include; may be NULL */
    double *H; /* [14 x 14] second derivative of the energy due to the rotations of the nodes,
                * without turn^T second turn, in the exponential chart; may be NULL */
    double turn[3 * ELEMENT_ALONG_COORDINATES]; /* [3 x 14] */
    double ends[ELEMENT_ALONG_COORDINATES];     /* forces acting directly on the nodes [N, N m] */
    double moment[3]; /* derivative of the energy with respect to the rotation [N m] */
    double second[9]; /* [3 x 3] second derivative [N m]; linear case: zero */
} along_output;

/* Outputs of `equations_many`: the mixed equations of an element, condensed (N section 4). */
typedef struct equations_output {
    double *J;               /* [strains x 7 nodes] de/dx */
    double *C;               /* [strains x strains] dsigma/de [N/m] */
    double *memory;          /* [memory] as from stress */
    double *incompatibility; /* [strains] D(x) - e [m] */
    double *sigma;           /* [strains] stress(e) + C (D(x) - e) [N] */
    double *force;           /* [7 nodes] J^T sigma */
    double *present;         /* [7 nodes] J^T s */
    double *K;               /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2 + J^T C J; may be NULL */
} equations_output;

#endif
