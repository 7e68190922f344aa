/* What the calls of an element fill (element.h): n nodes, 7n coordinates; matrices are row-major,
 * what is NULL is not wanted. */
#ifndef BEAMWORK_ELEMENT_OUTPUT_H
#define BEAMWORK_ELEMENT_OUTPUT_H

/* What `strain` fills. */
typedef struct strain_output {
    double *e;       /* [strains] [m] */
    double *J;       /* [strains x 7 nodes] de/dx */
    const double *s; /* in: [strains] stresses for H; NULL: H not wanted */
    double *H;       /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2, overwritten */
} strain_output;

/* What `stress` fills. */
typedef struct stress_output {
    double *energy;   /* [1] [J] */
    double *sigma;    /* [strains] [N]; with inner unknowns: after eliminating their residual */
    double *C;        /* [strains x strains] dsigma/de [N/m], inner unknowns eliminated */
    double *residual; /* [1] dimensionless size of the inner residual (0 without inner unknowns) */
    double *memory; /* [memory] filled by stress, read by update: the eliminated inner equations */
} stress_output;

/* What `inertia` fills. */
typedef struct inertia_output {
    double *M; /* [7n x 7n] mass matrix: translations [kg] */
    /* In a rotating frame; zero without one. */
    double *potential; /* [1] centrifugal: -1/2 int |Omega x r|^2 dm [J] */
    double *force;     /* [7n] centrifugal, outward: -d potential/dx [N, N m, N m^2] */
    double *N;         /* [7n x 7n] d2 potential/dx2, symmetric: centrifugal softening */
    double *G;         /* [7n x 7n] gyroscopic, skew: M x'' + G x' + (K + N) x = 0 */
    /* In time, of types that spread their mass (element_type.spreads); without a rotating frame. */
    const double *rate;         /* in: [7n] x', angular velocities spatial; NULL: not in time */
    const double *acceleration; /* in: [7n] its derivative x''; NULL: zero */
    double
        *taken; /* [7n] M x'' + h(x, x'): forces that the motion takes; from the kinetic energy */
    double *C;  /* [7n x 7n] d taken/dx' */
    double *K;  /* [7n x 7n] d taken/dx at fixed x' and x'', in the exponential chart; what is left
                   out of it costs iterations only */
} inertia_output;

/* Of the whole element, for types without strains and stresses of their own. */
typedef struct force_output {
    double *energy; /* [1] [J] */
    double
        *F; /* [7 nodes] d energy/dx: forces on the nodes [N], moments [N m], bimoments [N m^2] */
    double *K; /* [7 nodes x 7 nodes] dF/dx; only its symmetric part counts, so that it may be the
                  derivative of F along spatial increments or the second one of the energy in the
                  exponential chart */
} force_output;

/* What `equations_many` fills: the mixed equations of an element, condensed (N section 4). */
typedef struct equations_output {
    double *J;               /* [strains x 7 nodes] de/dx */
    double *C;               /* [strains x strains] dsigma/de [N/m] */
    double *memory;          /* [memory] as stress gives it */
    double *incompatibility; /* [strains] D(x) - e [m] */
    double *sigma;           /* [strains] stress(e) + C (D(x) - e) [N] */
    double *force;           /* [7 nodes] J^T sigma */
    double *present;         /* [7 nodes] J^T s */
    double *K; /* [7 nodes x 7 nodes] sum_i s_i d2e_i/dx2 + J^T C J; NULL: not wanted */
} equations_output;

#endif
