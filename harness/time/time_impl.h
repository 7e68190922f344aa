/* Internal interfaces of time/. */
#ifndef BEAMWORK_TIME_IMPL_H
#define BEAMWORK_TIME_IMPL_H

#include <gsl/gsl_odeiv2.h>

#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time.h"

/* Copy the convergence history of Newton's method between a motion_state and newton_convergence.
 * Call motion_state_recall before a step, and motion_state_store after the step. */
void motion_state_recall(const motion_state *from, newton_convergence *);
void motion_state_store(const newton_convergence *, motion_state *to);

status dense_output_alloc(const equations *, dense_output *, fault *);
void dense_output_free(dense_output *);
/* Sets the step. The states at both ends must remain unchanged while the polynomial is used. */
void dense_output_set(dense_output *, dense_output_degree, const motion_state *from,
                      const motion_state *to);
/* Returns a kinematic quantity at a time inside the step. at: work space. A jerk is the derivative
 * of the polynomial of degree four through five accelerations in the step. */
double dense_output_reading(const dense_output *, const scene_quantity *, double time,
                            motion_state *at);

/* Returns the power [W] of external forces if `along` contains the rates v, or their work [J] if
 * `along` contains increments, with rotation vectors in the axes of the frames. The forces are
 * those in the state with rates v and accelerations a at `time`. */
double work_power(outer_work *, const model_state *, const double v[], const double a[],
                  double time, const double along[]);
/* Returns the work [J] of external forces in a step, the mean of the forces at both ends times the
 * increment inc[free + driven], plus the work of free strains. The error is of second order;
 * constant forces have none. */
double work_trapezoid(outer_work *, const motion_state *from, const motion_state *to,
                      const double inc[]);

/* Returns the allowed energy-balance error [J]: the given fraction of account_size, plus
 * rounding. */
double account_most(const account *, double part, double rounding);

/* Checks the energy balance. NOT_CONVERGED: the unexplained gain exceeds account_gained, or the
 * loss exceeds account_lost although steps are not fixed and rho is at least 0.9. rounding [J]:
 * see balance_rounding. */
status account_check(const account *, const scene_motion *, double time,
                     const double balance[SCENE_BALANCES], double rounding, fault *);

/* Damping adds V e' to the stresses of elements, where e' are the strain rates and V is eta S0 plus
 * the damping matrix of the formulation. eta [s] is the damping of the member, and S0 is the
 * stiffness of the undeformed element. For dashpots, e' are the deformation rates of the spring,
 * and V is given. */

/* Sets the strain rates to known + g (e - strains of `from`) with known[model_stresses]. `from` may
 * be NULL if g is 0. */
void damping_follow(const equations *, double g, const double known[], const model_state *from);
/* Copies the strains of elements and springs to e[model_stresses]. */
void damping_strains(const model *, const model_state *, double e[]);
/* Computes the strain rates e' = J v for the rates v[free + driven]: rate[model_stresses]. */
status damping_rates(const model *, const model_state *, const double v[], double rate[], fault *);
/* dashpots_subtract subtracts the forces of dashpots for the rates v from out[free + driven], and
 * returns the dissipated power [W]. room[dashpots_room]: work space. */
size_t dashpots_room(const model *);
double dashpots_subtract(const model *, const model_state *, const double v[], double room[],
                         double out[]);
/* Returns the power [W] absorbed by springs without a potential. room[dashpots_room]: work
 * space. */
double springs_circulating_power(const model *, const model_state *, const double v[],
                                 double room[]);
/* Adds the force and the moment of dashpots on the frame of a node to F[6]. */
status dashpots_at_node(const model *, const model_state *, const double v[], int node, double F[6],
                        fault *);
/* Computes the strain rates of a motion_state from the rates of its coordinates. Changes nothing
 * without damping. */
status damping_now(const equations *, motion_state *, fault *);
/* Returns the power dissipated by strain rates [W]. */
double damping_power(const equations *, const double rate[]);

/* Generalized-alpha on the group of rotations (Chung & Hulbert 1993; Bruls, Cardona & Arnold 2012):
 *   inc = h v + h^2 [(1/2 - beta) a + beta a1],  v1 = v + h [(1 - gamma) a + gamma a1],
 *   (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) v1' + alpha_f v'. The true accelerations v1'
 * satisfy equilibrium at the end of the step. Increments of rotations are in the axes of the frame.
 */

/* Allocates the scheme. The error estimate of a step is the error of its positions, h^2 |beta +
 * (alpha_m - alpha_f)/2 - 1/6| (a1 - a). */
status alpha_alloc(const scheme_request *, motion_scheme **, fault *);

/* Makes a probe step from the start of the step. */
status probe_step(analysis_context *, motion_scheme *, const motion_state *from, double time,
                  motion_state *at, fault *);
typedef struct probe_point {
    const motion_state *at;
    const double *balance; /* [SCENE_BALANCES]; NULL: not computed */
    int before;            /* 1: before a jump of the loads at this instant */
} probe_point;
status probe_read(const analysis_context *, const frame_masses *, const outcome_motion *,
                  const scene_quantity *, const probe_point *, double *out, fault *);

enum { PROBE_STEPS = 4 }; /* number of stored probe steps in a step: the first three and the last */

typedef struct probe_steps {
    analysis_context *c;
    motion_scheme *scheme;
    const frame_masses *masses;
    const outcome_motion *out;
    const motion_state *from, *to; /* ends of the step */
    motion_state at[PROBE_STEPS];
    int made;       /* number of stored probe steps */
    status outcome; /* last failure since probe_steps_set; a FAULT is retained */
    fault why;
} probe_steps;

status probe_steps_alloc(probe_steps *, fault *);
void probe_steps_free(probe_steps *);
void probe_steps_set(probe_steps *, const motion_state *from, const motion_state *to);
/* Returns the value at a time of the step, without factor and offset; NAN: no solution was found,
 * and `outcome` is the status. */
double probe_steps_reading(probe_steps *, const scene_quantity *, double time);

/* Computes out[SCENE_BALANCES]. */
status balance_of(const equations *, const frame_masses *, const motion_state *,
                  double out[SCENE_BALANCES], fault *);
/* Returns the strain energy [J] due to rounding errors of all coordinates. */
double balance_rounding(const model *);

/* Mass matrix of a body, of bodies that constraints connect to it, and of all nodes that move with
 * them. The rows are the coordinates of the bodies and of member ends released from them. */

typedef struct body_mass {
    int count, *index; /* [count] free coordinates of the body */
    /* [count x count] mass matrix for spatial increments; rotations are scaled by the length of the
     * model */
    double *M;
    /* [count] scale of a coordinate: 1 for a translation, 1/length of the model [rad/m] for a
     * rotation */
    double *unit;
    int *used;            /* [count] work space */
    double *rest, *value; /* work space: [count x count] and [count] */
    double *zero;         /* [free + driven] zeros, used as rates */
} body_mass;

status body_mass_alloc(const model *, body_mass *, fault *);
void body_mass_free(body_mass *);
/* Computes the mass matrix of a body in a state. If several bodies are connected, computes the
 * matrix of all of them for the first body. Returns the largest mass of a frame, or three times the
 * mass of a node with consistent mass if this is larger [kg]. */
double body_mass_of(const model *, const frame_masses *, int body, const model_state *,
                    body_mass *);
/* Returns the mass of a warping amplitude [kg m^4]. */
double body_mass_warps(const model *, const frame_masses *, int warp, const model_state *);
/* Returns the rank of M. Values up to `none` count as zero. */
int body_mass_rank(body_mass *, double none);

/* Splits the step of one element into a common rotation, which is removed exactly, and a relative
 * motion. Node j moves by dr_j and rotates by the Cayley vector c_j, R_1 = cay(c) R_n. With the
 * mean c, kappa = 1/sqrt(1 + c.c/4), b = kappa^2/(4 (1 + kappa)), S = kappa 1 + b c c^T, T = 1 - b
 * c c^T, G half the common rotation and D_j = r_j - mean r, which changes by dD_j from D_n to D_1
 * and has the mean Dm_j,
 *   r(s) = (1 - s) G D_n + s G^T D_1,   R(s) = exp(s phi) G R_n,   a(s) = a_n + s da,
 *   dr^_j = S (dD_j - c x Dm_j),   c^_j = T (c_j - c)/(kappa (1 + c.c_j/4)),   phi_j = psi_j c^_j.
 *   Rigid motions have no relative motion. A spring to the ground has no common rotation: c = 0,
 *   D_j = r_j. */

/* Compute the Cayley vector 2 tan(|t|/2) t/|t| of a rotation vector t, and t from the Cayley
 * vector. */
void cayley_of_vector(const double t[3], double c[3]);
void cayley_to_vector(const double c[3], double t[3]);
/* Computes T = (1 + c~/2)/(1 + c.c/4). The spatial rotation increment at the end of the step is T
 * dc. */
void cayley_tangent(const double c[3], double T[9]);
/* Computes A = v~, the matrix of the cross product with v. */
void cayley_skew(const double v[3], double A[9]);

typedef struct cayley_step {
    int nodes;
    double share; /* weight of a node in the means: 1/nodes; 0 for a spring to the ground */
    double mean[3], kappa, b, S[9], T[9], G[9];
    double Dn[ELEMENT_MAX_NODES][3], D1[ELEMENT_MAX_NODES][3], Dm[ELEMENT_MAX_NODES][3];
    double dD[ELEMENT_MAX_NODES][3];
    double c[ELEMENT_MAX_NODES][3], relative[ELEMENT_MAX_NODES][3]; /* c_j; c^_j */
    double divisor[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], z[ELEMENT_MAX_NODES];
    double y[ELEMENT_MAX_COORDINATES]; /* dr^, phi, da */
    const node_state *from;
} cayley_step;

/* Computes the members of cayley_step from the increments dr[nodes x 3], c[nodes x 3] and
 * da[nodes]. The memory of `from` must remain valid while the structure is used. */
void cayley_begin(int nodes, int ground, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *);

/* State at s in [0, 1] of the step: r(s), R(s), a(s) and exp(s phi) of every node. */
typedef struct cayley_point {
    double at;
    double turn[ELEMENT_MAX_NODES][9];
    node_state x[ELEMENT_MAX_NODES];
} cayley_point;
void cayley_between(const cayley_step *, double at, cayley_point *);

/* Transforms the columns of f[7 nodes x columns], forces on the relative motion, to forces on dr, c
 * and da: F_j = S f_j, M_j = z_j T m_j - mean (z_i T m_i + Dm_i x S f_i), z_j = psi_j/(kappa (1 +
 * c.c_j/4)). */
void cayley_forces(const cayley_step *, int columns, double f[]);

/* Updates the strains to match the stresses of the state, if the stress function P' of elements is
 * nonlinear. Newton's increment de gives sigma = P'(e) + P''(e) de; at the new strains, P' differs
 * from sigma by P''' de^2 / 2. In a member that is stiff in elongation, this difference can be
 * thousands of times the axial force, and it would enter the next tangent. Therefore the strains
 * are changed to satisfy P'(e) = sigma, and D(x) - e contains the difference. */

typedef struct strain_update strain_update; /* data for one state */

/* Allocates the data of the update. Sets *out to NULL if there are no updates: stresses are linear
 * in the strains, they depend on inner unknowns or on a history, or a type in another process
 * evaluates all elements in one call. */
status strain_update_alloc(const equations *, strain_update **out, fault *);
void strain_update_free(strain_update *);

/* Call it before advance_state. It does nothing if the data are NULL. */
void strain_update_begin(strain_update *, const model_state *);
/* Changes e of each element so that its stresses become sigma. Call it after advance_state. An
 * element does not change if its stresses agree to 10 %, or if no such strains are found.
 * iteration: starts at 1. correction: size of Newton's correction. */
void strain_update_apply(strain_update *, model_state *, int iteration, double correction);

/* Derivatives of rates and accelerations with respect to the state: dv = g dx and da = b dx for
 * translations, warping and angles. For a rotation in the axes of the frame, dx is replaced by d
 * inc, which is X R^T times the spatial increment, where X = rotation_rates_inverse at inc[free +
 * driven]. */
typedef struct inertia_relation {
    double b, g; /* [1/s^2], [1/s] */
    const double *inc;
} inertia_relation;
/* Computes N[3 x 3], the derivative of inc of a vertex with respect to its rotation coordinates, in
 * the state after inc. R: orientation of the vertex in this state. */
void inertia_chart(const model *, int vertex, const double inc[], const double R[9], double N[9]);

/* Computes E = R N, the same derivative in global axes. */
void inertia_turn(const model *, int vertex, const model_state *, const double inc[], double E[9]);

/* Computes two matrices of a body. Each column of `turn` is the spatial rotation per unit of a
 * rotation coordinate, and each column of `rate` is the angular velocity per unit rate of this
 * coordinate. */
void inertia_turns(const model *, const model_state *, int vertex, double turn[9], double rate[9]);

/* Forms of the rates of frames and of all coordinates. For translations, warping amplitudes and
 * angles, the rates are derivatives. For a rotation that is free or given by a vector, they are the
 * angular velocity in axes that rotate with the frame. */

typedef enum rotation_form {
    FORM_BODY, /* three coordinates whose rates are the angular velocity in the axes of the frame */
    FORM_AXIS, /* rotation about at most one fixed axis, by an angle */
    FORM_SEQUENCE /* successive angles */
} rotation_form;

/* Checks the rotations of all nodes. REFUSED: the coordinates of a node are rotations about fixed
 * axes that do not determine its orientation. */
status forms_check(const model *, fault *);
rotation_form forms_of(const model *, int vertex);

/* Velocity and acceleration of the frame of a node in global axes [m/s, rad/s, m/s^2, rad/s^2],
 * computed from the rates v[free + driven] and their derivatives a, which are zero if a is NULL. */
typedef struct frame_rates {
    double R[9];
    double v[3], w[3], a[3], wd[3];
} frame_rates;
void forms_rates(const model *, const model_state *, int vertex, const double v[], const double a[],
                 frame_rates *out);

/* Adds the force and moment F[6] on the frame of a node to the rows of the coordinates that move
 * the frame. */
void forms_add_force(const model *, const model_state *, int vertex, const double F[6],
                     double out[]);

/* Inertia forces of masses at frames, in global axes. For a mass with first moment c and tensor J
 * about the frame, the force is m a + w' x c + w x (w x c), and the moment is c x a + J w' + w x J
 * w. */

/* Computes the force and the moment about the frame that accelerate a mass: F[6]. */
void inertia_force_at(const frame_mass *, const frame_rates *, double F[6]);
void inertia_force(const model *, const frame_mass *, const model_state *, const double v[],
                   const double a[], double F[6]);
/* Subtracts from out[free + driven] the inertia forces for the rates v and their derivatives a. If
 * a is NULL, subtracts only the terms due to v. */
void inertia_subtract(const model *, const frame_masses *, const model_state *, const double v[],
                      const double a[], double out[]);

/* Adds the derivative of the inertia forces with respect to the coordinates to S. Rotations are in
 * the exponential chart, as in all parts of a tangent. */
void inertia_add_tangent(const equations *, const frame_masses *, const model_state *,
                         const double v[], const double a[], const inertia_relation *, sparse *S);

/* Frame on the arm of a diaphragm, which rotates by the first angle of the frame: v = v_master +
 * moved angle', a = a_master + moved angle'' + inward angle'^2. */
typedef struct inertia_swing {
    int led;          /* 0: no arm; the other members are not set */
    double moved[3];  /* derivative of the position with respect to the angle [m] */
    double inward[3]; /* derivative of `moved` */
    double rate;      /* [rad/s] rate of the angle */
    double change[3]; /* derivative of the acceleration with respect to the angle [m/s^2] */
} inertia_swing;
/* Computes the data of a frame on an arm. If a is NULL, accelerations are zero. */
void inertia_swing_of(const model *, const model_state *, int vertex, const double v[],
                      const double a[], inertia_swing *out);
/* Two functions add the terms of a frame on an arm to K[n x n], before the rows of K are
 * transformed to coordinates. The coordinates of the frame start at index `at`.
 * inertia_swing_column adds the terms due to the change of `moved` with the angle to a column
 * out[n]. A and C [n x n] are the derivatives of the force with respect to accelerations and
 * velocities; `rate` and `place` are the factors of the derivatives with respect to the rate of the
 * angle and to the angle. inertia_swing_row adds the row of the angle for a force[3] on the frame.
 */
void inertia_swing_column(const inertia_swing *, int n, int at, const double A[], const double C[],
                          double rate, double place, double out[]);
void inertia_swing_row(const inertia_swing *, int n, int at, const double force[3], double place,
                       double K[]);

/* Derivatives [6 x 6, row-major] of the inertia force and moment on a frame. */
typedef struct inertia_parts {
    /* derivatives with respect to spatial increments (exponential chart), at fixed rates in the
     * axes of the frame */
    double place[36];
    /* derivatives with respect to velocities and to accelerations in global axes */
    double velocity[36], acceleration[36];
    double turn[9];  /* columns: spatial rotation per unit of each rotation coordinate */
    double rate[9];  /* columns: angular velocity per unit rate of each rotation coordinate */
    double force[3]; /* inertia force */
    inertia_swing swing;
} inertia_parts;
void inertia_frame(const model *, const frame_masses *, int index, const model_state *,
                   const double v[], const double a[], inertia_parts *out);
/* inertia_times computes out = A diag(translation 1, B). K is the sum of such products.
 * inertia_finish transforms the rows of K from global axes to coordinates of the frame, and adds
 * the terms of a frame on an arm (inertia_swing). For rate and place, see inertia_swing_column. */
void inertia_times(const double A[36], double translation, const double B[9], double out[36]);
void inertia_finish(const model *, const frame_masses *, int index, const inertia_parts *,
                    double rate, double place, double K[36]);
typedef struct inertia_balance {
    double kinetic;     /* [J] */
    double momentum[3]; /* [kg m/s] */
    double angular[3];  /* [kg m^2/s] angular momentum about the origin */
} inertia_balance;
void inertia_of(const model *, const frame_masses *, const model_state *, const double v[],
                const double ends[], inertia_balance *out);

/* Returns the power [W] that mass-proportional damping dissipates at the rates v. */
double inertia_damping_power(const model *, const frame_masses *, const model_state *,
                             const double v[]);

/* Projection onto motions with inertia, for error estimates. Accelerations of massless coordinates
 * are differences of positions divided by the square of the step, so estimates must not contain
 * them. */

typedef struct massive {
    int ready;
    /* [vertices without released ends x 2 x 9] projections onto translations and onto rotations
     * without inertia, with rotations in the axes of the frames; NULL: all motions have inertia */
    double *light;
} massive;

/* Evaluates the lumped masses in a state, for the functions below. */
status massive_of(const model *, const frame_masses *, const model_state *, massive *, fault *);
void massive_free(massive *);
/* Removes motions without inertia from e. Returns the square root of the sum of weight[c] e[c]^2
 * over the free coordinates. */
double massive_norm(const massive *, const model *, const double weight[], double e[]);

typedef struct deformable_values deformable_values;

typedef struct conserving {
    motion_scheme base;
    scheme_request of;
    frame_masses masses; /* frame_masses_diaphragms */
    int free, all;
    sparse S;
    matrix_factor *factor;
    /* [free + driven] dr, Cayley vectors c, and da; increments of single angles and of released
     * coordinates; c of ball joints */
    double *step;
    double *residual, *column, *row, *dx; /* [free + driven] the tangent is S + column row^T */
    double *weight;
    massive massive;
    int strains;    /* largest number of strains of an element or a spring */
    double *W;      /* [deformables x strains^2] mean of P'' at the two ends of the step */
    double *C;      /* [deformables x strains^2] P''(e_n) */
    double *energy; /* [deformables] P(e_n) */
    double *d;      /* [deformables x strains] */
    /* [elements x strains] P'(e_n) for damped members, whose stresses in the state include damping;
     * NULL: there is no damping */
    double *elastic;
    /* [masses x 9] projection onto rotations without inertia, in the axes of the frames */
    double *massless;
    /* [springs x 4 x SPRING_STRAINS] e and sigma at the end of the step, sigma_n and e_n */
    double *spring;
    double *slot; /* [deformables x slot_size] data that the evaluation stores for the update */
    int slot_size;
    strain_update *strain_update;
    deformable_values *deformable_values; /* [CHUNK_MOST] work space */
    double h;                             /* [s] size of the step */
    double k, denominator,
        /* missing: residual of the equation for k, sum of k_e . gap_e + k_d . gap_d */
        missing;
    int settled;
    int wild; /* 1: k was too large although energy is missing; the step is rejected */
    double largest, change; /* stresses */
    newton_convergence newton_convergence;
    long counted;
} conserving;

/* Computes the energies and the data of the springs at the start of the step. */
status conserving_begin(conserving *, const motion_state *from, fault *);
/* Computes the stresses for the current strains, and k. k is 0 in iterations 1 and 2. It is also 0
 * if nothing moves or if k would be too large. */
status conserving_stresses(conserving *, const motion_state *from, model_state *now, int iteration,
                           fault *);
/* Updates d and the strains at the end of the step by the increments dx. Returns the largest change
 * of an inner unknown. */
double conserving_update(conserving *, const motion_state *from, model_state *now);

void conserving_forces(conserving *, const motion_state *from, model_state *now,
                       double *incompatibility);

/* Subtracts the inertia forces from the residual and adds their tangent to S
 * (conserving_strain.c). */
void conserving_inertia(conserving *, const motion_state *from, const model_state *now, double h);

void conserving_loads(conserving *, const motion_state *from, const model_state *now, double h,
                      double out[]);

void conserving_predict(conserving *, const motion_state *from, double h);
void conserving_increment(const conserving *, const model_state *from, double inc[]);

status conserving_work(conserving *, const motion_state *from, motion_state *to, double h, fault *);
/* Computes the strain rates e' at the end of the step, and adds V e' to the stresses of damped
 * members. */
void conserving_damped(const conserving *, const motion_state *from, double h, motion_state *to);

/* Prescribed coordinates have their prescribed rates at the end of a step, which differ from the
 * rates during the step. The difference is due to impulses on the prescribed masses
 * (conserving_driven.c). */
/* Changes the rates of free coordinates so that these impulses do not change the momenta of the
 * free coordinates. */
void conserving_free_rates(conserving *, const motion_state *from, double h, motion_state *to);
/* Returns the work [J] of the impulses. */
double conserving_impulses(const conserving *, const motion_state *from, double h,
                           const motion_state *to);

typedef struct frame_mass_step {
    double Rn[9], R1[9];
    double centre[3], before[3], after[3],
        /* position of the centre relative to the frame: in the axes of the frame; in global axes at
         * the start and at the end of the step; mean of the last two */
        mean[3];
    double J[9]; /* moment of inertia about the centre, in the axes of the frame */
    /* velocities of the centre, and angular velocities in the axes of the frame, at the start (0)
     * and at the end (1) of the step */
    double v0[3], v1[3], W0[3], W1[3];
    double c[3];
    int partly_fixed; /* 1: some but not all translations of the frame are fixed */
    double held[9];   /* projection onto the fixed translations */
    /* terms due to fixed translations (see frame_masses.c) */
    double g[3], behind[3], turned[3], late[3];
} frame_mass_step;

/* Computes the centre of a mass relative to the frame, and its tensor about the centre, both in the
 * axes of the frame. If the frame can only rotate, its origin replaces the centre. */
void frame_mass_step_centre(const model *, const frame_mass *, double centre[3], double J[9]);
void frame_mass_step_of(const conserving *, const motion_state *from, const model_state *now,
                        double h, const frame_mass *, frame_mass_step *);

/* Computes v1 in the directions of the fixed translations, and `late`, the moment of the forces in
 * these directions. */
void frame_mass_step_follow(const frame_mass *, frame_mass_step *);
/* Computes sway[9]: `swept`, with the rows along fixed translations replaced by the rows of -h/2
 * dv1/dc. swept: minus d(centre)/dc. T: see cayley_tangent. */
void frame_mass_step_sway(const frame_mass_step *, double h, const double T[9],
                          const double swept[9], double sway[9]);
/* Adds the derivative of `late` to K[6 x 6]. */
void frame_mass_step_late(const frame_mass *, const frame_mass_step *, double h, const double T[9],
                          const double sway[9], double K[36]);

/* Derivatives: d phi_j = own_j dc_j + common_j dc, where c is the mean, and d z_j in the same form.
 * spin dc is the change of G. */
typedef struct cayley_slopes {
    double kappa[3], b[3], spin[9];
    double own[ELEMENT_MAX_NODES][9], common[ELEMENT_MAX_NODES][9];
    double z_own[ELEMENT_MAX_NODES][3], z_common[ELEMENT_MAX_NODES][3];
} cayley_slopes;
void cayley_slopes_of(const cayley_step *, cayley_slopes *);

/* Adds `weight` A Y to `out`. Y transforms A[rows x 7 nodes] from spatial increments of x(s) to dr,
 * c and da. */
void cayley_slopes_columns(const cayley_step *, const cayley_slopes *, const cayley_point *,
                           double weight, int rows, const double A[], double out[]);
/* Derivatives of x(s) at a node: of the rotation with respect to phi of the node, and of position
 * and rotation with respect to the mean of c. Rows of four numbers, the last of which is zero. */
typedef struct cayley_columns {
    double by_phi[12], r_common[12], phi_common[12];
} cayley_columns;
/* Computes the rows of cayley_slopes_columns. `back` contains rows of four numbers of G^T. The
 * second function is for processors with AVX2 and gives bit-for-bit identical results. */
typedef void cayley_rows_function(int nodes, double share, double at, double weight,
                                  const cayley_columns[], const double back[12], int rows,
                                  const double A[], double out[]);
cayley_rows_function cayley_rows_plain, cayley_rows_avx2;
/* The two versions of cayley_forces. */
typedef void cayley_forces_function(const cayley_step *, int columns, double f[]);
cayley_forces_function cayley_turn_forces_plain, cayley_turn_forces_avx2;
/* Adds to K[7 nodes x 7 nodes] the derivative of cayley_forces at fixed f[7 nodes]. */
void cayley_slopes_forces(const cayley_step *, const cayley_slopes *, const double f[], double K[]);

/* Checks whether the scheme allows massless coordinates. REFUSED: there are massless coordinates,
 * and the scheme is generalized-alpha with alpha_f <= alpha_m, for example with rho = 1. */
status checks_massless(const analysis_context *, const frame_masses *, const scene_motion *,
                       const model_state *begin, fault *);

/* Integrator that conserves energy and both momenta for any formulation. A step evaluates `strain`
 * in three states, and `stress` at its end. With the strain energy P(e), the strains e_n and e_1 at
 * the ends of the step, and Gauss points s_g with weights w_g, s = (sigma_n + sigma_1)/2,   W =
 * (P''(e_n) + P''(e_1))/2, d = sum_g w_g J(x(s_g)) (dr^, phi, da) = A (dr, c, da),   sigma_m = s +
 * k W d, k = sum [P(e_1) - P(e_n) - s.d]/sum d.W d. The number k is common to the whole structure.
 * Then sum sigma_m.d is the change of energy, and the forces A^T sigma_m do no work in a rigid
 * motion (cayley_step). Translations of a mass follow from mass (v1 - v)/h = external minus
 * internal force, with dr = h (v + v1)/2. Rotations follow from the Cayley vector c with R_n^T c =
 * h (w_n + w_1)/2 and from (R_1 J w_1 - R_n J w_n)/h = external minus internal moment, where w_n
 * and w_1 are the angular velocities in the axes of the frame. The method follows Simo, Tarnow &
 * Doblare (1995), Gonzalez (1996) and Sansour et al. (2004). */

/* Allocates the integrator. REFUSED: the integrator does not support the model; the message gives
 * the reason. */
status conserving_alloc(const scheme_request *, motion_scheme **, fault *);

enum {
    DEFORMABLE_POINTS = 2, /* number of points between the ends of the step */
    DEFORMABLE_STRAINS = ELEMENT_MAX_STRAINS,
    DEFORMABLE_COORDINATES = MODEL_MAX_COORDINATES
};

typedef struct deformable {
    const mesh_element *el;
    const mesh_discrete *spring; /* NULL: an element */
    int index;                   /* index of the element or spring */
    int strains, coordinates;    /* coordinates: 7 nodes */
    const double *before;        /* sigma_n, the stresses at the start of the step */
    double *W, *C_before;        /* mean of P'' at the two ends of the step, and P''(e_n) */
    double *e, *sigma, *d;       /* values of the current iteration */
    double *first;               /* [strains] e_n of a spring; NULL: an element */
    /* [strains x coordinates] de/dx at the end of the step, with respect to dr, c and da */
    double *J;
    double *C, *memory;    /* [strains x strains] P''(e), and the memory of the stress function */
    double *present;       /* [strains] P'(e) */
    double *gap_e, *gap_d; /* [strains] D(x_1) - e and A (dr, c, da) - d */
    const double *V;       /* damping matrix; NULL: there is no damping */
    double length;         /* [m] reference length for incompatibilities */
} deformable;

/* deformable_count returns the number of deformables, which are first all elements, then all
 * springs. deformable_at returns the data of one of them. */
int deformable_count(const conserving *);
deformable deformable_at(const conserving *, const motion_state *from, model_state *now, int i);
int deformable_together(const conserving *, int first);

struct deformable_values {
    deformable of;
    cayley_step step;
    cayley_point point[DEFORMABLE_POINTS];
    node_state first[ELEMENT_MAX_NODES], last[ELEMENT_MAX_NODES];
    /* rotation vectors of a spring at the points and at the end of the step */
    double turn[DEFORMABLE_POINTS + 1][3];
    double middle[DEFORMABLE_STRAINS]; /* (sigma_n + P'(e))/2 + k W d */
    double D[DEFORMABLE_STRAINS];
    double J[DEFORMABLE_POINTS][DEFORMABLE_STRAINS * ELEMENT_MAX_COORDINATES];
    /* second derivatives at the points between the ends */
    double H[DEFORMABLE_POINTS][ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    /* Equations of a deformable: forces conjugate to dr, c and da, their tangent, the column A^T W
     * d and the row k_e + k_d. */
    double force[DEFORMABLE_COORDINATES], column[DEFORMABLE_COORDINATES],
        row[DEFORMABLE_COORDINATES];
    double K[DEFORMABLE_COORDINATES * DEFORMABLE_COORDINATES];
};

/* Evaluates the strains and their derivatives of `count` deformables. */
void deformable_evaluate(const conserving *, const motion_state *from, const model_state *now,
                         int count, deformable_values[]);

/* Checks the drivers. REFUSED: the value of a driver is unknown. */
status drive_check(const model *, fault *);
/* Computes the entries [free, free + driven) of v, a and inc (the increment from the state) at
 * `time`. An array that is NULL is not requested. */
void drive_at(const equations *, const model_state *from, double time, double inc[], double v[],
              double a[]);

/* Runge-Kutta method of order 8 with an error estimate of order 7 (Prince & Dormand 1981, rk8pd of
 * GSL). The equations are inc' = X v and v' = M^-1 (f - h - J^T sigma), where f are the loads and h
 * the inertia forces due to v, and X is rotation_rates_inverse for rotations in the axes of the
 * frame, and 1 otherwise. */

/* Allocates the integrator. REFUSED: a coordinate has no inertia, or a member has an offset or a
 * released end. */
status explicit_alloc(const scheme_request *, motion_scheme **, fault *);

typedef struct explicit_scheme {
    motion_scheme base;
    scheme_request of;
    gsl_odeiv2_step *stepper;
    int free, all;
    /* [2 x free + 2 + feedback_count] increments, rates, work, dissipated energy and integrals of
     * feedback; their error estimates from GSL; their derivatives at the end of the step */
    double *y, *error, *dydt;
    double *inc, *residual; /* [free + driven] */
    /* memory of one element, whose type defines the size; zeros, used as increments of strains */
    double *memory, *still;
    double power;   /* [W] power absorbed by dashpots and by springs without a potential */
    double *weight; /* [free + driven] weights as in model.h */
    const motion_state *from; /* start of the current step */
    double end;               /* [s] latest time at which loads are read */
    motion_state *at;         /* state of the last evaluation */
    status outcome;
    fault why;
} explicit_scheme;

/* Extent and rate of the motion so far. Tolerances of steps are relative to the largest motion so
 * far (at most the size of the structure), or to an estimate of the largest motion if this is
 * larger. The first estimate is 2 % of the size of the structure. */

typedef struct extent {
    model_state *begin; /* initial state */
    /* distance of the initial state from the undeformed state, the reference of its rounding
     * errors */
    double bent;
    /* estimate of the largest motion, with the norm of model.h; 1 is the size of the structure */
    double scale;
    double largest; /* largest distance from `begin` so far, over coordinates with inertia */
    double rate;    /* [1/s] largest mean rate of a step, over coordinates with inertia */
    double
        /* error of a step divided by the power of its size given by the order of the scheme
         * (extent_error) */
        density;
    double worst; /* largest error of an accepted step, divided by the share of the step in the
                     whole motion if errors add up */
} extent;

/* Initial estimate of the largest motion. */
extern const double extent_guess;

void extent_begin(extent *, const model *);
/* Returns the extent after a step of h [s]. */
extent extent_with(const extent *, const model *, const motion_scheme *, const motion_state *from,
                   const motion_state *to, double h, double error);
/* Returns the estimated error of a step of h [s]. If errors add up, it is computed from the largest
 * previous estimate, which decays exponentially over a phase of ten radians. At a change of sign of
 * the rates, the error of positions is zero, but the error of the rates is largest. */
double extent_error(const extent *, const motion_scheme *, double h, double error);
/* Returns the allowed error of a part of the motion for the tolerance of the whole motion. It is at
 * least the rounding error of the coordinates. */
double extent_allows(const extent *, double part, double tolerance);
/* Returns 1 if the completed motion was less than half of the estimate and exceeds the rounding
 * error of its initial state, and its steps are too long for a tolerance relative to its size. Sets
 * *scale to a better estimate. */
int extent_is_less(const extent *, double tolerance, double *scale);

typedef struct frames {
    const equations *eq;
    const model *m;
    outcome_path *to;
    double begin, end; /* [s] start and end of the motion */
    dense_output inside;
    motion_state at;
} frames;

/* Allocates memory for `count` frames; 0: no frames are requested. The caller sets m, to, begin and
 * end. */
status frames_alloc(frames *, int count, fault *);
void frames_free(frames *);
/* Stores the initial state. */
status frames_begin(frames *, const motion_state *now, fault *);
status frames_step(frames *, dense_output_degree, const motion_state *from, const motion_state *to,
                   fault *);

/* Increment between the states at two times: inc[free + driven]. It is a difference for
 * translations, warping and angles, and a rotation vector in the axes of the frame for rotations of
 * FORM_BODY. */

/* Moves the frames of `to`, starting from the frames of `from`, by inc. Strains, stresses and inner
 * unknowns do not change. */
void increment_apply(const model *, const model_state *from, const double inc[], double time,
                     model_state *to);
/* Composes inc with the spatial increments dx. `now` is the state before dx. */
void increment_add(const model *, const model_state *now, const double dx[], double inc[]);

/* The requested integrator. */

/* Allocates the requested integrator. REFUSED: the integrator does not support this model; the
 * message gives the reason. */
status integrator_alloc(const scheme_request *, motion_scheme **, fault *);
void integrator_free(motion_scheme *);

/* Returns the time of the first discontinuity after `time` [s]; INFINITY: none. */
double discontinuities_next(const model *, double time);
/* Returns the largest number below `time` if there is a discontinuity at `time`, otherwise `time`.
 * A step that ends at a discontinuity evaluates its loads at the returned time. */
double discontinuities_before(const model *, double time);

/* Computation of the state at a time from the previous state by a mixed Newton iteration (Nijenhuis
 * et al., section 4). The state is in equilibrium with the inertia forces of rates that follow the
 * increment, v = v0 + g inc, a = a0 + b inc. */

/* Returns 1 if the last factors may be used again: the corrections of coordinates and stresses are
 * at most 1e-4, and those of coordinates are at most a tenth of the previous ones. */
int stage_stands(const newton_convergence *);

typedef struct motion_stage {
    analysis_context *c;
    const frame_masses *masses;
    sparse S;
    matrix_factor *factor;
    double *residual, *dx; /* [free + driven] */
    newton_convergence newton_convergence;
    strain_update *strain_update;
    int all, free;
    int begins; /* at a discontinuity, 1: loads after it; 0: loads before it */
    long counted;
} motion_stage;

status stage_alloc(analysis_context *, const frame_masses *, motion_stage *, fault *);
void stage_free(motion_stage *);

/* Solves S dx = residual. If `fresh` is 0, uses the existing factors. */
status stage_direction(motion_stage *, int fresh, fault *);

/* All arrays have [free + driven] entries. h [s]: step size of the trapezoidal rule for the
 * integrals of feedback. */
typedef struct stage_rates {
    double b, g, h;
    const double *a0, *v0;
    /* inc contains the initial increments on entry, which are exact for prescribed coordinates */
    double *inc, *v, *a;
} stage_rates;
/* Computes the state at `time`. On entry, `now` contains the strains and stresses of `from` or
 * extrapolated ones; on return, it contains the state. NOT_CONVERGED: the fault gives the reason,
 * and `now` is invalid. */
status stage_solve(motion_stage *, const model_state *from, double time, stage_rates *,
                   model_state *now, step_record *, fault *);

/* Computes consistent accelerations and massless coordinates after a discontinuity of the loads.
 * Velocities of free coordinates with inertia do not change. REFUSED: the value of a driver differs
 * from its coordinate. */
status consistent_restart(analysis_context *, const frame_masses *, const scene_motion *,
                          motion_state *now, motion_state *room, fault *);
/* Sets the initial rates to those of a structure at rest in rotating axes, plus the requested
 * velocities. `now` contains the state and the time; `room` is work space. frame: angular velocity
 * [rad/s] and centre [m] of the axes, which do not rotate if omega is zero. REFUSED: a fixed or
 * prescribed coordinate does not follow this rotation, the velocities violate a constraint, or the
 * value of a driver differs from its coordinate. */
status initial_conditions_rotating(analysis_context *, const frame_masses *, const scene_motion *,
                                   const scene_rotating_frame *frame, motion_state *now,
                                   motion_state *room, fault *);
/* Like initial_conditions_rotating, for axes at rest. */
status initial_conditions(analysis_context *, const frame_masses *, const scene_motion *,
                          motion_state *now, motion_state *room, fault *);

/* Computes the number of free coordinates minus the rank of their masses in the state. */
status massless_count(const model *, const frame_masses *, const model_state *, int *count,
                      fault *);
/* Removes the motions with inertia from force[free], or from dx[free] with spatial increments of
 * rotations. */
status massless_forces(const model *, const frame_masses *, const model_state *, double force[],
                       fault *);
status massless_motion(const model *, const frame_masses *, const model_state *, double dx[],
                       fault *);
/* Finds the quantities of the analysis that read the acceleration or the jerk of a node that moves
 * without inertia: *undefined[quantities of the scene], which the caller frees. Accelerations of
 * massless coordinates are unknown (see consistent_massless). REFUSED: the analysis has no other
 * quantities, and no analysis follows it. */
status massless_readings(const model *, const frame_masses *, const model_state *, int analysis,
                         unsigned char **undefined, fault *);
/* Removes motions without inertia from a[free], given in the coordinates of forms_rates. */
status massless_drop(const model *, const frame_masses *, const model_state *, double a[], fault *);
/* Computes the acceleration a[free] due to forces, in the coordinates of forms_rates. The
 * acceleration of coordinates without inertia is 0. */
status massless_accelerate(const model *, const frame_masses *, const model_state *,
                           const double force[], double a[], fault *);

/* Extrema of reactions, resultants, stresses, energies and momenta during a motion. The values at
 * the ends of steps are those of the scheme. Between the ends, a cubic through four consecutive
 * ends (order 4) gives the time and the value of an extremum, and a probe step to this time gives
 * the error of the value. */

enum { EXTREMA_ENDS = 4 }; /* number of consecutive ends of steps */

/* One quantity. */
typedef struct extremum {
    const scene_quantity *q;
    outcome_passing *out;
    double sign, from, until;
    double value[EXTREMA_ENDS]; /* values at the last ends of steps */
} extremum;

typedef struct extrema {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    const frame_masses *masses;
    outcome_motion *out;
    /* number of quantities, and number of ends since the start or since the last discontinuity of
     * the loads */
    int count, ends;
    extremum *one; /* [count] */
    motion_state last[EXTREMA_ENDS], at;
} extrema;

/* Allocates the search for extrema, if a quantity needs it. The caller sets c, analysis, scheme,
 * masses and out. */
status extrema_alloc(extrema *, fault *);
void extrema_free(extrema *);
/* Adds the end of a step, with its energies. last 1: a discontinuity of the loads or the end of the
 * motion follows the step. */
status extrema_here(extrema *, const motion_state *, const double balance[SCENE_BALANCES], int last,
                    fault *);
/* Restarts the search after a discontinuity of the loads. */
void extrema_jump(extrema *);
void extrema_end(extrema *);

/* Motion of a frame during a step, from the coordinates of its body and of a released end.
 * Subscript m denotes the mean of the values at the two ends of the step, subscripts n and 1 denote
 * the start and the end. A frame at the vector rho from the body that moves it has dr = dr_b + c x
 * rho_m, and its force f and moment m act on the body as f and m + rho_m x f. Angles and released
 * rotations, each about an axis b, with tau = 2 tan(d angle/2): c_k = c_(k-1) + tau_k x_k, x = [b +
 * c x b/2 + c (c.b)/4]/(1 - tau c.b/4), where b is taken at the start; x lies along the mean axis,
 * about which no moment acts. Released sliding s along an axis a adds c x (a s)_m + [a_m - c x (a_1
 * - a_n)/4] ds to dr. */

enum { FRAME_MOTION_MOST = 6 + SCENE_RELEASED };

typedef struct frame_motion {
    /* number of coordinates: six of the body, then released rotations, then released slides */
    int columns;
    /* [6 x columns] forces F on the frame become work^T F in these coordinates */
    double work[6 * FRAME_MOTION_MOST];
    /* derivative of (dr, c) of the frame with respect to the coordinates */
    double moved[6 * FRAME_MOTION_MOST];
    double curved[FRAME_MOTION_MOST * FRAME_MOTION_MOST]; /* derivative of work^T F at fixed F */
    /* coordinates from which `work` computes (dr, c); they are conjugate to the forces */
    double measure[FRAME_MOTION_MOST];
} frame_motion;

/* Returns 1 if dr and c of the frame are coordinates. */
int frame_motion_is_plain(const model *, int vertex);
/* Computes the transformations of any frame. F[6]: force on the frame; NULL: zero. */
void frame_motion_of(const conserving *, const model_state *from, const model_state *now,
                     int vertex, const double F[6], frame_motion *);
/* Computes dr and c of a frame. */
void frame_motion_step(const conserving *, const model_state *from, const model_state *now,
                       int vertex, double dr[3], double c[3]);

/* Transforms forces[n] of a frame to its coordinates. The six coordinates of its body start at
 * index `at`, and the released coordinates start at index `own`. frame_motion_row transforms a row,
 * and frame_motion_matrix transforms the rows and columns of K[n x n]. */
void frame_motion_forces(const frame_motion *, int at, int own, double forces[]);
void frame_motion_row(const frame_motion *, int at, int own, double row[]);
void frame_motion_matrix(const frame_motion *, int n, int at, int own, double K[]);
/* Adds forces F[6] on a frame to out[free + driven], and K[6 x 6] = -dF/d(dr, c) to the tangent. */
void frame_motion_add(conserving *, const model_state *from, const model_state *now, int vertex,
                      const double F[6], const double K[36], double out[]);

/* Radau IIA with three stages (Hairer & Wanner II, IV.8) and order 5, for q' = v, v' = a. The
 * unknowns are the positions of the stages, where rotations are vectors in the axes of the frame:
 *     t_i' = 1/h sum_j B_ij t_j,  W_i = Jr(t_i) t_i',  a_i = 1/h sum_j B_ij (v_j - v),  B = A^-1,
 * where A is the matrix of the scheme and Jr is that of rotation_rates_jacobian. The mixed Newton
 * iteration (Nijenhuis et al., section 4) solves all three stages together. */

/* Allocates the integrator. An additional factorisation in each step gives an error estimate of
 * order 3. */
status radau_alloc(const scheme_request *, motion_scheme **, fault *);

/* Matrix of the three stages of a step, with 3 x 3 blocks [n x n]. Off-diagonal blocks contain
 * masses, damping and feedback, but no stiffness. */

enum { STAGES = 3 };

typedef struct stages_matrix {
    sparse whole; /* matrix with 3 n rows, which owns its pattern */
    int n;
    int *diagonal; /* [STAGES x n] index of the first entry of the column in the diagonal block */
} stages_matrix;

/* Creates the pattern of all three stages. single: pattern of one block. */
status stages_alloc(const equations *, const frame_masses *, const sparse *single, stages_matrix *,
                    fault *);
void stages_free(stages_matrix *);
/* Sets the diagonal block of a stage to K. */
void stages_put(stages_matrix *, int stage, const sparse *K);
void stages_zero(stages_matrix *);
/* Adds entries K[columns x columns] of an element to block (i, k), if off-diagonal blocks are full
 * (damping, consistent masses). pattern: pattern of one block. */
void stages_add_element(stages_matrix *, int i, int k, const mesh_pattern *pattern, int element,
                        const double K[]);
/* Adds a value to entry (row, column) of block (i, k). Rows and columns of coordinates that are not
 * free are skipped. */
void stages_add(stages_matrix *, int i, int k, int row, int column, double value);
/* Adds block[count x count] to the rows and columns index[count] of block (i, k). */
void stages_add_block(stages_matrix *, int i, int k, int count, const int index[],
                      const double block[]);

/* One stage. */
typedef struct radau_stage {
    model_state *state;
    double *inc, *rate, *v, *a; /* [free + driven] rate: derivative of inc */
    linear_memory memory;       /* memory of its linearisation */
    strain_update *strain_update;
} radau_stage;

typedef struct radau {
    motion_scheme base;
    const scheme_request of;
    double node[STAGES], weights[STAGES], B[STAGES * STAGES], A[STAGES * STAGES]; /* B = A^-1 */
    radau_stage stage[STAGES];
    sparse K;
    stages_matrix S;
    /* factors of S, and factors of the matrix of the error estimate */
    matrix_factor *factor, *single;
    double *residual; /* [STAGES x free] */
    double *dx;       /* [free + driven] */
    double *weight;   /* [free + driven] */
    double *errors;   /* [STAGES x feedback_count] */
    /* [vertices x STAGES x 18] for vertices that turn freely: Jr(t) (set by radau_rates), and
     * d(Jr(t) t')/dt (set by radau_equations if fresh) */
    double *turn;
    newton_convergence newton_convergence;
    int free, all;
    long counted, counted_single;
} radau;
/* Computes the integrals of feedback in all stages. */
void radau_integrate(radau *, const motion_state *from, double h, const step_record *);

/* Functions of radau_equations.c. */
/* Sets the nodes, the weights and B of the scheme. */
void radau_coefficients(radau *);
/* Returns the time of a stage [s]. For the last stage, it is exactly the end of the step. */
double radau_time(const radau *, const motion_state *from, double h, int stage,
                  const step_record *);
/* Computes v and a of all stages from their increments. */
void radau_rates(radau *, const motion_state *from, double h);
/* Derivatives of the rates (rate) and of the accelerations of stage i with respect to spatial
 * increments of a vertex in stage k: scalars for translations, and [3 x 3] matrices for its
 * rotation, in the axes of its rates. */
typedef struct radau_relation {
    double rate, acceleration, turn_rate[9], turn_acceleration[9];
} radau_relation;
void radau_relate(const radau *, int vertex, double h, int i, int k, radau_relation *);

/* Computes the residual of all stages in their current states; fresh 1: also S. */
status radau_equations(radau *, int fresh, const motion_state *from, double h, step_record *,
                       fault *);

/* Returns the energy [J] that damping dissipates in a completed step. room[elements x strains]:
 * work space. */
double radau_dissipated(const radau *, const motion_state *from, double h, double room[]);
/* Adds damping to the stresses for radau_error, until damping_follow is called. The strain rates
 * are -sum e_i (increase of strains)/h, with the tangent g. room[elements x strains]: work
 * space. */
void radau_damp_error(const radau *, const motion_state *from, double h, const double e[STAGES],
                      double g, double room[]);

/* Masses of member ends that are released from their nodes. These masses move with the coordinates
 * of the node's body and with the released rotations and shifts (harness/model/model.h). */

/* Coordinates on which the motion of a released end, or of another vertex, depends. */
typedef struct released_masses {
    int count, own; /* own: index of the first released coordinate */
    /* index of the first of three rotations whose rates are an angular velocity, in the axes of the
     * body (`body`) or of the end (`ball`); -1: none */
    int body, ball;
    int index[KINEMATICS_MOST]; /* [count] coordinates */
    /* [6 x count] spatial motion of the end per unit of each coordinate */
    double T[6 * KINEMATICS_MOST];
} released_masses;
void released_columns(const model *, const model_state *, int vertex, released_masses *);

/* Like forms_rates and forms_add_force, for released ends. */
void released_rates(const model *, const model_state *, int vertex, const double v[],
                    const double a[], frame_rates *);
void released_add_force(const model *, const model_state *, int vertex, const double F[6],
                        double out[]);

/* Computes the velocities of the frame from own[6] of its mass (velocity of the centre, and angular
 * velocity in the axes of the frame) and from the first moment of the mass [kg m]. */
void released_moving(const double own[6], double mass, const double moment[3], frame_rates *);

/* Computes out[6 x count]: the columns of T multiplied by `plain`. The columns of rotations in the
 * axes of the body and of the end are instead multiplied from the right by matrices [3 x 3]. */
void released_motion(const released_masses *, double plain, const double body[9],
                     const double ball[9], double out[6 * KINEMATICS_MOST]);
/* Adds T^T A motion to out[count x count]. */
void released_project(const released_masses *, const double A[36], const double motion[],
                      double out[KINEMATICS_MOST * KINEMATICS_MOST]);

/* Step-control data with which a motion continues. */
typedef struct resume_control {
    double step; /* [s] size of the next step */
    account account;
    double origin;
    int quiet; /* number of steps since the last discontinuity of the loads */
    extent extent;
} resume_control;

/* Stores the end of a motion for a later motion of the scene that continues it. The end of a last
 * motion is stored for another run if solve_options.keep_ends is 1. */
status resume_keep(const analysis_context *, int analysis, const motion_state *now,
                   const resume_control *, outcome_motion *, fault *);
/* Sets *out to the end of an earlier motion of the scene. NOT_CONVERGED: that motion stopped
 * prematurely. */
status resume_before(const analysis_context *, int before, const outcome_end **, fault *);
/* Sets the state and the step control to those at the end of an earlier motion. REFUSED: that
 * motion has another mesh. */
status resume_take(const analysis_context *, const outcome_end *, motion_state *now,
                   resume_control *, fault *);

/* Consistent state of coordinates without inertia, computed from positions and rates at one
 * time. */

/* Brings massless coordinates into equilibrium with the loads and with the gyroscopic moments due
 * to the rates of the other coordinates. Then computes accelerations, which are 0 for massless
 * coordinates. Coordinates whose relaxation time exceeds a fraction of the step h [s] keep their
 * positions; their rates follow from equilibrium. zero[free + driven]: zeros. NOT_CONVERGED: no
 * equilibrium was found. */
status consistent_massless(motion_stage *, const double zero[], double h, motion_state *now,
                           fault *);

/* The motion that causes inertia forces. */
typedef struct inertia_resultants_motion {
    const double *v, *a; /* [free + driven] */
    int spread;          /* 1: consistent masses of elements (element_spreads) */
} inertia_resultants_motion;

/* Adds to F[6] the force, and the moment about the frame of the node, that accelerate the masses
 * moved by the node. */
status inertia_resultants_node(const model *, const model_state *,
                               const inertia_resultants_motion *, int node, double F[6], fault *);
/* Computes density[nodes][6]: for each node, force per initial length, and moment about the node,
 * that accelerate the mass of an element if the whole element has the motion of the node. */
void inertia_resultants_along(const model *, const model_state *, const inertia_resultants_motion *,
                              int element, double density[ELEMENT_MAX_NODES][6]);
/* Adds to ends[e][7] the inertia force of the share of an element's mass at its first (0) and last
 * (1) node, including warping. */
void inertia_resultants_ends(const model *, const model_state *, const inertia_resultants_motion *,
                             int element, double ends[2][7]);

/* Consistent masses of elements (element_type.spreads) instead of lumped masses. The inertia forces
 * at the nodes of an element are transferred to the bodies that move the nodes, and to released
 * ends. If an element cannot be evaluated, all of its values are NaN. */

struct mesh_element;

/* Computes the inertia forces F[7 nodes] on the nodes of an element. */
void consistent_mass_force(const model *, int element, const model_state *, const double v[],
                           const double a[], double F[]);
/* Like inertia_subtract, inertia_add_tangent and inertia_of, for consistent masses of elements. */
void consistent_mass_subtract(const model *, const model_state *, const double v[],
                              const double a[], double damping, double out[]);
void consistent_mass_add_tangent(const equations *, const model_state *, const double v[],
                                 const double a[], double damping, const inertia_relation *,
                                 sparse *S);
/* Adds to S the terms that K of the elements omits (inertia_output). */
void consistent_mass_add_omitted(const equations *, const model_state *, const double v[],
                                 const double a[], double damping, sparse *S);
void consistent_mass_add_balance(const model *, const model_state *, const double v[],
                                 double *kinetic, double momentum[3], double angular[3]);

/* Derivatives of the inertia forces of an element with respect to the motions of the bodies that
 * move its nodes (7 coordinates per node), and with respect to those of its released ends. */
typedef struct consistent_mass_parts {
    const struct mesh_element *el;
    const model_state *state;
    int columns; /* number of coordinates of the element: 7 per node, then those of released ends */
    int wide;    /* 1: the element has a released end, or the body of a node has translations in own
                    axes or an arm (mesh_vertex.turned, led) */
    double place[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], /* as in inertia_parts */
        velocity[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES],
        acceleration[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    double turn[ELEMENT_MAX_NODES][9], rate[ELEMENT_MAX_NODES][9];
    double force[ELEMENT_MAX_NODES]
                [3]; /* inertia forces on the nodes; set only by consistent_mass_element */
    inertia_swing swing[ELEMENT_MAX_NODES];
} consistent_mass_parts;
void consistent_mass_element(const model *, int element, const model_state *, const double v[],
                             const double a[], double damping, consistent_mass_parts *);
/* Computes only the mass matrix, p->acceleration, and p->turn, in the given state. */
void consistent_mass_masses(const model *, int element, const model_state *,
                            consistent_mass_parts *);
/* Motion of a body per unit of its coordinates: a factor for translations and warping (`plain`),
 * and a matrix for rotations (`turn`). A released end has matrices for the spatial rotations of its
 * body and of a ball joint (`turn`, `ball`), and the factor for the other coordinates. */
typedef struct consistent_mass_motion {
    double plain, turn[9], ball[9];
} consistent_mass_motion;
/* Computes the motions due to spatial increments of the coordinates. */
void consistent_mass_place(const model *, const consistent_mass_parts *,
                           consistent_mass_motion place[]);
/* consistent_mass_times adds A diag(motions) to out[columns x columns]. consistent_mass_rows
 * transforms the rows of rotations to their coordinates. */
void consistent_mass_times(const model *, const consistent_mass_parts *, const double A[],
                           const consistent_mass_motion motion[], double out[]);
void consistent_mass_rows(const consistent_mass_parts *, double K[]);
/* Adds the terms of inertia_swing_column, and the term of `inward` of inertia_swing_row. The motion
 * on the arm is part of consistent_mass_times. */
void consistent_mass_swing(const model *, const consistent_mass_parts *, double rate, double place,
                           double K[]);

/* Computes the matrices of small motions about a state during a motion, on all coordinates.
 * out: zero except for its time on entry; freed with the outcome, also after a failure. */
status small_motions_of(const equations *, const frame_masses *, motion_state *now,
                        outcome_about *out, fault *);

typedef struct abouts {
    analysis_context *c;
    int analysis, next; /* next: index of the next time in the outcome */
    const frame_masses *masses;
    const scene_motion *how;
    motion_scheme *scheme;
    outcome_motion *out;
    /* [s] distance to the end of a step below which a time counts as this end */
    double near;
    motion_state at, room;
} abouts;

/* Allocates the data if the motion has times at which other analyses need the state. The caller
 * sets c, analysis, masses, how, scheme and out. */
status abouts_alloc(abouts *, fault *);
void abouts_free(abouts *);
/* Computes the states at the times inside a step, without its end. */
status abouts_inside(abouts *, const motion_state *from, const motion_state *to, fault *);
/* Stores `now` as the state at each requested time that it reaches. REFUSED: such a time is before
 * the start of this run, which continues another motion. */
status abouts_here(abouts *, const motion_state *now, fault *);

/* Output of a motion at the requested times, which are independent of the ends of steps. If forces
 * or energies are read, a probe step computes the state. */

typedef struct stations {
    analysis_context *c;
    int analysis;
    const frame_masses *masses;
    motion_scheme *scheme;
    outcome_motion *out;
    int slopes, sloped;
    dense_output inside;
    motion_state at;
} stations;

/* Allocates the data. The caller sets c, analysis, masses, scheme and out. */
status stations_alloc(stations *, fault *);
void stations_free(stations *);
/* Writes the stations inside a step, without its end. */
status stations_inside(stations *, const motion_state *from, const motion_state *to, fault *);
status stations_here(stations *, const motion_state *now, const double balance[SCENE_BALANCES],
                     fault *);

/* Rotation vectors of a frame between two times, and their rates. With R = R_n exp(t~), the body
 * rates W of R'(t) = R W~ follow from t': W = Jr(t) t', Jr(t) = 1 - (1 - cos |t|)/|t|^2 t~ + (|t| -
 * sin |t|)/|t|^3 t~ t~. 3 x 3 matrices are row-major. */

void rotation_rates_jacobian(const double t[3], double Jr[9]);
/* Computes the inverse of Jr, 1 + t~/2 + (1 - |t|/2 cot(|t|/2))/|t|^2 t~ t~, for |t| < 2 pi. */
void rotation_rates_inverse(const double t[3], double inverse[9]);
/* Computes d(Jr(t) y)/dt at fixed y. */
void rotation_rates_derivative(const double t[3], const double y[3], double D[9]);
/* Replaces t by the rotation vector of exp(t~) exp(d~). */
void rotation_rates_add(double t[3], const double d[3]);

/* Computes the rates of the frame of a node or of a released end, as given by forms_rates. */
void inertia_rates(const model *, const model_state *, int vertex, const double v[],
                   const double a[], frame_rates *);
/* Like inertia_rates, for any vertex. */
void vertex_rates(const model *, const model_state *, int vertex, const double v[],
                  const double a[], frame_rates *);

/* Loads with feedback. */

status feedback_begin(const equations *, fault *);
/* Returns the number of loads of the scene if at least one of them has feedback, otherwise 0. */
int feedback_count(const equations *);
/* Computes the factors for this state, including its integrals. v NULL: the structure is at
 * rest. */
void feedback_take(const equations *, const model_state *, const double v[], double time);
/* Computes the errors (reference value minus measured value): out[feedback_count]. */
void feedback_errors(const equations *, const model_state *, double time, double out[]);
/* Size of a step [s], and the times at which reference values are read for its ends. If the step
 * ends at a jump, the values before the jump are read. */
typedef struct feedback_step {
    double h, begin, end;
} feedback_step;
/* Computes the integrals at the end of a step with the trapezoidal rule: out[feedback_count]. */
void feedback_integrate(const equations *, const model_state *from, const model_state *now,
                        const feedback_step *, double out[]);
/* Derivatives of the position, the rate and the integral of a measured component with respect to
 * the component. */
typedef struct feedback_gains {
    double place, rate, integral;
} feedback_gains;
typedef void feedback_entry(void *to, int row, int column, double value);
/* Passes minus the derivatives of the loads to `take`, entry by entry. The pattern is that of
 * motions. Call feedback_take first. */
void feedback_tangent(const equations *, const model_state *, const feedback_gains *,
                      feedback_entry *take, void *to);

/* Extrema, level crossings and means of a motion between its stations. For reactions, resultants,
 * stresses, energies and momenta, level crossings and means are computed from probe steps. */

/* Number of values in a step from which a mean is computed. */
enum { MEANS_NODES = 5 };
typedef struct means_part {
    double time[MEANS_NODES], value[MEANS_NODES];
} means_part;

/* One quantity. */
typedef struct observer {
    const scene_quantity *q;
    outcome_passing *out;
    double from, until; /* [s] */
    /* largest distance from the level at which a value still counts as on the level */
    double noise;
    int side;           /* side of the level of the last value; 0: no value yet */
    int crossings;      /* number of counted crossings in the window, in the requested direction */
    double first, last; /* [s] first and last crossing */
    double error;       /* [s] errors of `first` and of `last` */
    int by_probe;       /* 1: values come from probe steps */
    double blur;        /* rounding error of a rate in the current step */
    double blurred;     /* time integral of `blur`, for a mean */
    double sum, span; /* time integral of values, or of squares relative to `largest`; length of the
                         interval [s] */
    double largest;   /* largest magnitude so far */
    /* data for the error of a mean. parts: number of steps that used the polynomial; with probe
     * steps, 1 for one step and 2 for at least one pair. holds 1: `past` is the first step of a
     * pair */
    int parts, holds;
    means_part past;
    double add_error, worst; /* error of `sum`, and its largest magnitude */
    double apart;            /* largest difference between probe steps and the polynomial */
} observer;

typedef struct observers {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    outcome_motion *out;
    int count;
    observer *one; /* [count] */
    dense_output inside;
    motion_state at;
    const frame_masses *masses;
    int by_probe; /* 1: a quantity needs probe steps */
    probe_steps probe_steps;
} observers;

/* Allocates the data. The caller sets c, analysis, scheme, masses and out. */
status observers_alloc(observers *, fault *);
void observers_free(observers *);
status observers_step(observers *, const motion_state *from, const motion_state *to, fault *);
/* Completes the data at the end of the motion. */
void observers_end(observers *);
/* Returns the value of the quantity at a time of the step, without factor and offset; NAN: none. */
double observer_value(observers *, const observer *, double time);
/* Computes the difference between a probe step to the given time and the polynomial. The difference
 * is 0 for jerks, for quantities that do not use the polynomial, at the ends of the step, and if
 * the probe step fails. */
status observer_disagreement(observers *, const observer *, const motion_state *from, double time,
                             double *out, fault *);
/* Returns the time of point i of Lobatto's rule from a to b. */
double means_node(double a, double b, int i);
/* Adds the part from a to b of the step to a mean, or to a root mean square. */
status means_add(observers *, observer *, const motion_state *from, double a, double b, fault *);

#endif
