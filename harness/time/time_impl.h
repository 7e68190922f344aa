/* Internal interfaces of time/.
 *
 * Sections, in this order: alpha; aside (a step next to those of the motion); balance; body
 * mass; cayley; complement; inertia (relations of rates); forms; carried masses; massive;
 * conserving; deformable; drive; explicit; extent; frames; increment; integrator; kinks; stage;
 * launch; massless; peaks; place; radau; released; resume; settle; shares; spread; stations;
 * turning; vertex rates; watches. */
#ifndef BEAMWORK_TIME_IMPL_H
#define BEAMWORK_TIME_IMPL_H

#include <gsl/gsl_odeiv2.h>

#include "elements/element.h"
#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time.h"

/* Generalized-alpha on the group of rotations (Chung & Hulbert 1993; Bruls, Cardona & Arnold 2012):
 *   inc = h v + h^2 [(1/2 - beta) a + beta a1],  v1 = v + h [(1 - gamma) a + gamma a1],
 *   (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) v1' + alpha_f v',
 * equilibrium with the true accelerations v1' at the end; rotations in the frame's axes. */

/* The error of a step is that of its positions, h^2 |beta + (alpha_m - alpha_f)/2 - 1/6| (a1 - a).
 */
status alpha_alloc(const scheme_request *, motion_scheme **, fault *);

/* A separate step, from which the motion does not continue: the scheme's own values at an instant
 * inside a step. */

/* From the start of the motion's step; its work is counted, its iterations are not recorded. */
status aside_step(analysis_context *, motion_scheme *, const instant *from, double time,
                  instant *at, fault *);

/* Energies and momenta of a motion at an instant. */

/* out[SCENE_BALANCES]; the initial energy is not yet subtracted from the energy-balance error. */
status balance_of(const equations *, const carried_masses *, const instant *,
                  double out[SCENE_BALANCES], fault *);
/* Strain energy [J] of rounding errors in all coordinates: a smaller one counts as zero. */
double balance_rounding(const model *);

/* The mass matrix of what moves with one body: its coordinates and those of the ends of members
 * that are released from it. */

typedef struct body_mass {
    int count, *index;    /* free coordinates [count] */
    double *M;            /* [count x count] by spatial increments; turns in lengths of the model */
    double *unit;         /* [count] 1; of a turn that makes the length of the model [rad/m] */
    int *used;            /* room [count] */
    double *rest, *value; /* room [count x count], [count] */
    double *zero;         /* [free + driven] rates */
} body_mass;

/* Allocates room for any body of the model. */
status body_mass_alloc(const model *, body_mass *, fault *);
void body_mass_free(body_mass *);
/* Fills the mass of one body in a state; returns the largest mass in it [kg]. */
double body_mass_of(const model *, const carried_masses *, int body, const model_state *,
                    body_mass *);
/* Returns the mass of a warping amplitude [kg m^4]. */
double body_mass_warps(const model *, const carried_masses *, int warp, const model_state *);
/* Rank of M, in which `none` is zero. */
int body_mass_rank(body_mass *, double none);

/* A step of one element as a common turn, which is taken out of it exactly, and a motion relative
 * to that: nodes j move by dr_j and turn by the Cayley vectors c_j, R_1 = cay(c) R_n. With the mean
 * c, kappa = 1/sqrt(1 + c.c/4),  b = kappa^2/(4 (1 + kappa)),  S = kappa 1 + b c c^T,  T = 1 - b c
 * c^T, G half the common turn and D_j = r_j - mean r,
 *   r(s) = (1 - s) G D_n + s G^T D_1,   R(s) = exp(s phi) G R_n,   a(s) = a_n + s da,
 *   dr^_j = S (dD_j - c x Dm_j),   c^_j = T (c_j - c)/(kappa (1 + c.c_j/4)),   phi_j = psi_j c^_j:
 * zero for every rigid motion. What is fixed to the ground turns with nothing: c = 0, D_j = r_j. */

/* Cayley vector 2 tan(|t|/2) t/|t| of a rotation vector, and back. */
void cayley_of_vector(const double t[3], double c[3]);
void cayley_to_vector(const double c[3], double t[3]);
/* T_c = (1 + c~/2)/(1 + c.c/4): the spatial turn at the end is T_c dc. */
void cayley_tangent(const double c[3], double T[9]);
/* v~ */
void cayley_skew(const double v[3], double A[9]);

typedef struct cayley_step {
    int nodes;
    double share; /* of a node in the means: 1/nodes, on the ground 0 */
    double mean[3], kappa, b, S[9], T[9], G[9];
    double Dn[ELEMENT_MAX_NODES][3], D1[ELEMENT_MAX_NODES][3], Dm[ELEMENT_MAX_NODES][3];
    double dD[ELEMENT_MAX_NODES][3];
    double c[ELEMENT_MAX_NODES][3], relative[ELEMENT_MAX_NODES][3]; /* c_j; c^_j */
    double divisor[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], z[ELEMENT_MAX_NODES];
    double y[ELEMENT_MAX_COORDINATES]; /* dr^, phi, da */
    const node_state *from;
} cayley_step;

/* dr, c of the nodes [nodes x 3], da[nodes]; `from` stays where it is. */
void cayley_begin(int nodes, int ground, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *);

/* The relative motion at s in [0, 1]: r(s), R(s), a(s), and exp(s phi) of every node. */
typedef struct cayley_point {
    double at;
    double turn[ELEMENT_MAX_NODES][9];
    node_state x[ELEMENT_MAX_NODES];
} cayley_point;
void cayley_between(const cayley_step *, double at, cayley_point *);

/* Forces f on the relative motion, columns of f[7 nodes x columns], become those on dr, c, da:
 * F_j = S f_j, M_j = z_j T m_j - mean (z_i T m_i + Dm_i x S f_i). */
void cayley_forces(const cayley_step *, int columns, double f[]);

/* Strains that belong to the stresses of the state, where the stress function P' of elements is not
 * linear. Newton's increment de leaves sigma = P'(e) + P''(e) de, yet at the new strains P' differs
 * by P''' de^2 / 2: in a member that is stiff in elongation thousands of times its force, which the
 * next tangent would treat as a force in it. So the strains are changed instead, to P'(e) = sigma,
 * and D(x) - e holds the difference: the same equations in complementary form (Hellinger-Reissner).
 * Their solution does not change. */

typedef struct complement complement; /* of one state */

/* NULL: nothing to do: stresses of all kinds of elements are linear in their strains; they depend
 * on inner unknowns of the element, too; or the type evaluates all elements at once (another
 * process), which would need many requests. */
status complement_alloc(const equations *, complement **out, fault *);
void complement_free(complement *);

/* Before advance_state. NULL: nothing. */
void complement_keep(complement *, const model_state *);
/* After it: sets e of every element, along the stresses from those that were kept to sigma, which
 * does not change. An element does not change where its stresses agree to a tenth already, or where
 * no strains are found that have them. iteration: from 1; once all elements agree, corrections that
 * are no larger are not checked in the same step. NULL: nothing. */
void complement_strains(complement *, model_state *, int iteration, double correction);

/* Relation of increments, rates and their derivatives while a state moves. */

/* Change of the rates and their derivatives while a state moves: for translations, warping and
 * angles dv = g dx, da = b dx; for a rotation in the frame's axes the same with d inc in place of
 * dx, which is X R^T times the spatial increment, X = turning_inverse at inc[free + driven]. */
typedef struct inertia_relation {
    double b, g; /* [1/s^2], [1/s] */
    const double *inc;
} inertia_relation;
/* N[3 x 3]: what inc of a vertex gains by increments of its coordinates of rotation in the state
 * that it leads to, whose orientation is R. */
void inertia_chart(const model *, int vertex, const double inc[], const double R[9], double N[9]);

/* R N: the same in spatial axes. */
void inertia_turn(const model *, int vertex, const model_state *, const double inc[], double E[9]);

/* Columns: spatial turn of a body by each coordinate of its rotation; angular velocity by the rate
 * of each. */
void inertia_turns(const model *, const model_state *, int vertex, double turn[9], double rate[9]);

/* Rates of a frame's rotation, and the meaning of the rates of a model's coordinates: translations,
 * warping amplitudes and angles have their derivatives, a rotation that is free or given by a
 * vector has the angular velocity in axes that rotate with the frame. */

typedef enum rotation_form {
    FORM_BODY,    /* three coordinates: components of the angular velocity in the frame's axes */
    FORM_AXIS,    /* about one fixed axis at most: an angle */
    FORM_SEQUENCE /* angles one after the other */
} rotation_form;

/* REFUSED: two turns about fixed axes that move while the third is fixed or moves otherwise,
 * whether its row is kept or eliminated. They fix a component of the angular velocity at zero,
 * which has no integral: exp(-b e_j~) exp(-a e_i~) exp(b e_j~) exp(a e_i~) = 1 - a b e_k~ + ..., so
 * that no state of the coordinates says where the node is. */
status forms_check(const model *, fault *);
rotation_form forms_of(const model *, int vertex);

/* Velocity and acceleration of a node's frame, spatial [m/s, rad/s, m/s^2,
 * rad/s^2], from rates v[free + driven] and their derivatives a (NULL: zero). */
typedef struct frame_rates {
    double R[9];
    double v[3], w[3], a[3], wd[3];
} frame_rates;
void forms_rates(const model *, const model_state *, int vertex, const double v[], const double a[],
                 frame_rates *out);

/* F[6] (force, moment) on a node's frame into the rows of the coordinates that move it. */
void forms_add_force(const model *, const model_state *, int vertex, const double F[6],
                     double out[]);

/* Forces of inertia of the masses at frames, in inertial axes; with a mass, its first
 * moment c and tensor J about the frame, in spatial axes: force  m a + w' x c + w x (w x c), moment
 * c x a + J w' + w x J w. */

/* F[6]: force and moment about the frame that the motion of a mass takes. */
void inertia_force_at(const carried_mass *, const frame_rates *, double F[6]);
void inertia_force(const model *, const carried_mass *, const model_state *, const double v[],
                   const double a[], double F[6]);
/* out[free + driven] -= forces of inertia at rates v and their derivatives a (NULL: zero, which
 * leaves those of the velocities). */
void inertia_subtract(const model *, const carried_masses *, const model_state *, const double v[],
                      const double a[], double out[]);

/* S += derivative of the forces of inertia by the coordinates; of rotations in the exponential
 * chart, like every other part of a tangent. */
void inertia_add_tangent(const equations *, const carried_masses *, const model_state *,
                         const double v[], const double a[], const inertia_relation *, sparse *S);

/* Derivatives of the inertia force and moment of one frame [6 x 6, row-major]. */
typedef struct inertia_parts {
    double place[36]; /* by spatial increments, at fixed rates in its axes; exponential chart */
    double velocity[36], acceleration[36]; /* by those, spatial */
    double turn[9]; /* columns: spatial turn by each coordinate of rotation */
    double rate[9]; /* likewise angular velocity by the rate of each */
} inertia_parts;
void inertia_frame(const model *, const carried_masses *, int index, const model_state *,
                   const double v[], const double a[], inertia_parts *out);
/* out = A diag(translation 1, B); then rows of rotation by their coordinates: K <- diag(1, turn^T)
 * K. */
void inertia_times(const double A[36], double translation, const double B[9], double out[36]);
void inertia_rows(const double turn[9], double K[36]);
typedef struct inertia_balance {
    double kinetic;     /* [J] */
    double momentum[3]; /* [kg m/s] */
    double angular[3];  /* about the origin [kg m^2/s] */
} inertia_balance;
/* ends[released ends x 6]: velocities of the centres of their masses, and in their axes angular
 * velocities; NULL: those of v. */
void inertia_of(const model *, const carried_masses *, const model_state *, const double v[],
                const double ends[], inertia_balance *out);

/* Errors of coordinates with inertia. Accelerations of massless coordinates are their positions by
 * the square of a step, so that an estimate that reads them is not one of the motion's error. */

typedef struct massive {
    int ready;
    double *light; /* [nodes and bodies x 2 x 9] onto shifts and onto turns without inertia, turns
                      in the frames' axes; NULL: there are none */
} massive;

/* Computes the lumped masses in a state, once for all functions below. */
status massive_of(const model *, const carried_masses *, const model_state *, massive *, fault *);
void massive_free(massive *);
/* Removes motions without inertia from e. Returns the root of the sum of weight[c] e[c]^2 over the
 * free coordinates. */
double massive_norm(const massive *, const model *, const double weight[], double e[]);

/* Internals of the conserving step. */

typedef struct evaluation evaluation;

typedef struct conserving {
    motion_scheme base;
    scheme_request of;
    int free, all;
    sparse S;
    matrix_factor *factor;
    double *step; /* [free + driven] dr, Cayley vectors c, da; of single angles and of released
                     coordinates the increments, of balls c */
    double *residual, *column, *row, *dx; /* [free + driven]; the tangent is S + column row^T */
    double *weight;
    massive massive;
    int strains;      /* most of an element or a spring */
    double *W;        /* [deformables x strains^2] mean of P'' at the ends of the step */
    double *C;        /* [deformables x strains^2] P''(e_n) */
    double *energy;   /* [deformables] P(e_n) */
    double *d;        /* [deformables x strains] */
    double *elastic;  /* [elements x strains] P'(e_n), where damped members' states have more than
                         that for a stress; NULL: none is damped */
    double *massless; /* [masses x 9] onto turns without inertia, in the frames' axes */
    double *spring;   /* [springs x 3 x SPRING_STRAINS] e and sigma of the end, sigma_n */
    double *slot;     /* [deformables x slot_size] what one keeps from its evaluation to update */
    int slot_size;
    complement *complement;
    evaluation *evaluation;         /* [CHUNK_MOST] work space */
    double h;                       /* [s] of the step */
    double k, denominator, missing; /* missing: of sum k_e . gap_e + k_d . gap_d */
    int settled;                    /* 1: the remaining gaps are rounding, no stresses */
    int wild;                       /* 1: k was too large to be used */
    double largest, change;         /* stresses */
    arrival arrival;
    long counted;
} conserving;

/* conserving_strain.c: of all elements and springs. */
/* Energies and springs at the start of the step; d is zero. */
status conserving_begin(conserving *, const instant *from, fault *);
/* Stresses of the present strains, and k; 0 as long as it is not to be trusted. */
status conserving_stresses(conserving *, const instant *from, model_state *now, int iteration,
                           fault *);
/* The strains of the end and d take dx; the largest inner change. */
double conserving_update(conserving *, const instant *from, model_state *now);

/* conserving_forces.c: residual -= forces, S += tangent, column and row, of all of them. */
void conserving_forces(conserving *, const instant *from, model_state *now,
                       double *incompatibility);

/* conserving_strain.c: residual -= forces of inertia, S += theirs. */
void conserving_inertia(conserving *, const instant *from, const model_state *now, double h);

/* conserving.c */
/* Finds rotations without inertia. REFUSED: no rotation has inertia. */
status conserving_massless(conserving *, fault *);
/* Work of the impulses that change prescribed masses from the rates of the step to those at its
 * end. */
double conserving_impulses(const conserving *, const instant *from, double h, const instant *to);
/* Rates at the end. */
void conserving_rates(conserving *, const instant *from, double h, instant *to);

/* conserving_forces.c: out[free + driven] += the loads at the middle, S += what they add. */
void conserving_loads(conserving *, const instant *from, const model_state *now, double h,
                      double out[]);

/* conserving_strain.c: the step, to begin with; as increments of coordinates. */
void conserving_predict(conserving *, const instant *from, double h);
void conserving_increment(const conserving *, const model_state *from, double inc[]);

/* conserving_forces.c: sets work and dissipation of `to`. */
status conserving_work(conserving *, const instant *from, instant *to, double h, fault *);
/* Rates of strains at the end; stresses of damped members gain eta S0 e'. */
void conserving_damped(const conserving *, const instant *from, double h, instant *to);

/* A frame with its mass over a step. */

typedef struct carried_step {
    double Rn[9], R1[9];
    double centre[3], before[3], after[3], mean[3]; /* from the frame; centre: in its axes */
    double J[9];                                    /* about the centre, in the frame's axes */
    double v0[3], v1[3], W0[3], W1[3];              /* of the centre; in the frame's axes */
    double c[3];
    int rides, held[3]; /* 1: translations of the frame are fixed, and not all */
    double g[3], behind[3], turned[3], late[3]; /* of these (carried.c) */
} carried_step;

/* Centre of one mass from the frame, and its tensor about the centre, in the frame's axes. For a
 * frame that only rotates the tensor is about the frame, which then counts as its centre. */
void carried_step_centre(const model *, const carried_mass *, double centre[3], double J[9]);
void carried_step_of(const conserving *, const instant *from, const model_state *now, double h,
                     const carried_mass *, carried_step *);

/* carried.c: frames with fixed and free translations. */
/* v1 of the fixed ones, and the moment `late`. */
void carried_step_follow(const carried_mass *, carried_step *);
/* sway[9] = -h/2 dv1/dc; swept: minus d(centre)/dc, T: cayley_tangent. */
void carried_step_sway(const carried_step *, double h, const double T[9], const double swept[9],
                       double sway[9]);
/* K[6 x 6] += derivative of `late`. */
void carried_step_late(const carried_mass *, const carried_step *, double h, const double T[9],
                       const double sway[9], double K[36]);

/* Derivatives of the relative motion of a step (cayley_step) by dr, c, da of the nodes, in closed
 * form. */

/* d phi_j = own_j dc_j + common_j dc, d z_j likewise, with c the mean; spin dc: of G. */
typedef struct cayley_slopes {
    double kappa[3], b[3], spin[9];
    double own[ELEMENT_MAX_NODES][9], common[ELEMENT_MAX_NODES][9];
    double z_own[ELEMENT_MAX_NODES][3], z_common[ELEMENT_MAX_NODES][3];
} cayley_slopes;
void cayley_slopes_of(const cayley_step *, cayley_slopes *);

/* out += weight A Y: A[rows x 7 nodes] by the spatial increments of x(s) becomes by dr, c, da. */
void cayley_slopes_columns(const cayley_step *, const cayley_slopes *, const cayley_point *,
                           double weight, int rows, const double A[], double out[]);
/* K[7 nodes x 7 nodes] += derivative of cayley_forces at fixed f[7 nodes]. */
void cayley_slopes_forces(const cayley_step *, const cayley_slopes *, const double f[], double K[]);

/* Checks that a motion can be integrated as requested. REFUSED: it cannot. */

/* The form of Newton's method suits the integrator; inertia and drivers are defined in time, with
 * the requested mass. */
status checks_of(const analysis_context *, int analysis, fault *);
/* Coordinates without inertia follow from balance body by body, not together with consistent
 * masses. Without numerical damping the accelerations of massless coordinates grow until they
 * overflow. */
status checks_massless(const analysis_context *, const carried_masses *, const scene_motion *,
                       const model_state *begin, fault *);

/* A step that conserves energy and both momenta for any formulation, from `strain` at three states
 * and `stress` at the end. With the strains e of its ends,
 *   s = (sigma_n + sigma_1)/2,   W = (P''(e_n) + P''(e_1))/2,
 *   d = sum_g w_g J(x(s_g)) (dr^, phi, da),   sigma_m = s + k W d,
 *   k = sum [P(e_1) - P(e_n) - s.d]/sum d.W d   (one number for the whole structure):
 * sum sigma_m.d is the change of energy, and forces A^T sigma_m have no resultant in any rigid
 * motion (cayley_step). Translations m (v1 - v)/h = f - F with dr = h (v + v1)/2; rotations by
 * Cayley vectors R_n^T c = h (W + W1)/2, (R_1 J W1 - R_n J W)/h = m - M. After Simo, Tarnow &
 * Doblare (1995), Gonzalez (1996) and Sansour et al. (2004); the common turn of an element, its two
 * points and the one number are not theirs. W is not P'' at rest: where stresses inside an element
 * depend on how far it is bent, its stiff directions move with the strains, and k W d would press
 * against them. */

/* REFUSED: several angles of a node in sequence; no rotation has inertia. Rates of massless
 * coordinates are the mean rates of a step. */
status conserving_alloc(const scheme_request *, motion_scheme **, fault *);

/* An element or a spring over a step: they differ only in the function that evaluates them. */

enum {
    DEFORMABLE_POINTS = 2, /* between the ends of a step */
    DEFORMABLE_STRAINS = ELEMENT_MAX_STRAINS,
    DEFORMABLE_COORDINATES = MODEL_MAX_COORDINATES
};

typedef struct deformable {
    const mesh_element *el;
    const mesh_discrete *spring; /* NULL: an element */
    int index;                   /* of the element */
    int strains, coordinates;    /* 7 nodes */
    const double *before;        /* sigma_n */
    double *W, *C_before;        /* mean of P'' at the ends of the step; P''(e_n) */
    double *e, *sigma, *d;       /* of the present iteration */
    double *first;               /* [strains] e_n of a spring */
    /* Kept from one iteration's evaluation to its update. */
    double *J;             /* [strains x coordinates] de/dx at the end by dr, c, da */
    double *C, *memory;    /* P''(e) [strains x strains]; of stress */
    double *present;       /* [strains] P'(e) */
    double *gap_e, *gap_d; /* [strains] D(x_1) - e, A (dr, c, da) - d */
    const double *S;       /* S0 of a damped member, matrix of a dashpot, else NULL */
    double damping;        /* eta [s] of it; 1 */
    double length;         /* [m] that incompatibilities are relative to */
} deformable;

/* Number of them, the springs after the elements, and each of them. */
int deformable_count(const conserving *);
deformable deformable_at(const conserving *, const instant *from, model_state *now, int i);
/* How many from `first` on are evaluated in one go: elements of one kind, or 1. */
int deformable_together(const conserving *, int first);

/* Values of one element that one iteration evaluates. */
struct evaluation {
    deformable of;
    cayley_step step;
    cayley_point point[DEFORMABLE_POINTS];
    node_state first[ELEMENT_MAX_NODES], last[ELEMENT_MAX_NODES];
    double turn[DEFORMABLE_POINTS + 1][3]; /* of a spring: where its vector has come to */
    double middle[DEFORMABLE_STRAINS];     /* (sigma_n + P'(e))/2 + k W d */
    double D[DEFORMABLE_STRAINS];
    double J[DEFORMABLE_POINTS][DEFORMABLE_STRAINS * ELEMENT_MAX_COORDINATES];
    double H[DEFORMABLE_POINTS][ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES]; /* middle */
    /* Their equations: forces on dr, c, da of the coordinates, its tangent, the column A^T W d and
     * the row k_e + k_d. */
    double force[DEFORMABLE_COORDINATES], column[DEFORMABLE_COORDINATES],
        row[DEFORMABLE_COORDINATES];
    double K[DEFORMABLE_COORDINATES * DEFORMABLE_COORDINATES];
};

/* evaluation.c: strains and their derivatives of count deformables `of`, elements of one kind
 * where they are more than one. */
void deformable_evaluate(const conserving *, const instant *from, const model_state *now, int count,
                         evaluation[]);

/* Prescribed coordinates in time: increments, rates and their derivatives. */

/* REFUSED: an unknown driver has no motion in time. */
status drive_check(const model *, fault *);
/* Entries [free, free + driven) of inc (from the state), v and a at `time`; each NULL: not needed.
 */
void drive_at(const equations *, const model_state *from, double time, double inc[], double v[],
              double a[]);

/* Runge-Kutta of order 8 with an error estimate of order 7 (Prince & Dormand 1981, rk8pd of GSL)
 * for inc' = X v,  v' = M^-1 (f - h - J^T sigma), X the inverse Jacobian turning_inverse for
 * rotations in the frame's axes, 1 else: for reference values of a mesh. Positions are
 * increments from the start of each step. */

/* REFUSED: a coordinate has no inertia. */
status explicit_alloc(const scheme_request *, motion_scheme **, fault *);

/* Internals of the explicit integrator. */

typedef struct explicit_scheme {
    motion_scheme base;
    scheme_request of;
    gsl_odeiv2_step *stepper;
    int free, all;
    double *y, *error, *dydt; /* [2 x free + 1] increments, rates, work; GSL's estimate; at the end
                               */
    double *inc, *residual;   /* [free + driven] */
    double *memory, *still;   /* of one element: as its type has it; no increment of strains */
    double power;             /* [W] that dashpots take */
    double *weight;           /* [free + driven] model.h */
    const instant *from;      /* of the present step */
    double end;               /* [s] where its last loads are read */
    instant *at;              /* the last evaluation */
    status outcome;           /* of it */
    fault why;
} explicit_scheme;

/* explicit.c: dydt at t [s] and y, GSL's way; the motion there is left in `at`. */
int explicit_rates(double t, const double y[], double dydt[], void *context);

/* explicit.c: a[free] = M^-1 of the residual, which has what the driven accelerations of a
 * take. SINGULAR: a sequence of angles is where two of them turn about one axis. */
status explicit_accelerate(const model *, const carried_masses *, const model_state *,
                           const double v[], const double residual[], double a[], fault *);
/* REFUSED: a coordinate of the undeformed model has no inertia. */
status explicit_check(const model *, const carried_masses *, fault *);

/* Extent and rate of the motion so far. Tolerances of steps are relative to the largest motion so
 * far, but at least to a guess of the largest one of all: at first 2 % of the size of the
 * structure. A motion that reaches less than half of its guess is integrated again. */

typedef struct extent {
    model_state *begin; /* initial state of the motion */
    double bent;        /* its distance from the undeformed state, whose rounding is the noise */
    double scale;       /* the guess, in the measure of model.h: 1 is the size of the structure */
    double largest;     /* distance from `begin` so far, of coordinates with inertia */
    double rate;        /* [1/s] largest mean one of a step, likewise */
    double density;     /* error of a step by its size to the order of the scheme: extent_error */
    double worst;       /* largest error of an accepted step, by its part of the motion */
} extent;

/* The initial guess. */
extern const double extent_guess;

void extent_begin(extent *, const model *);
/* Returns the extent after a step of h [s]. */
extent extent_with(const extent *, const model *, const motion_scheme *, const instant *from,
                   const instant *to, double h, double error);
/* Where the errors of steps add up to that of the motion, the error of a step of h [s] by what the
 * estimates were within the last ten radians of the motion: that of positions vanishes where rates
 * turn, and what rates are off by is largest there. */
double extent_error(const extent *, const motion_scheme *, double h, double error);
/* Allowed error of a part of the motion by a tolerance of the whole; rounding of coordinates does
 * not count. */
double extent_allows(const extent *, double part, double tolerance);
/* 1: the completed motion was less than half of the guess, its steps are too long for a tolerance
 * relative to that, and it exceeds the rounding of its initial state. *scale: a better guess. */
int extent_is_less(const extent *, double tolerance, double *scale);

/* States of a motion for pictures, evenly over its time, between the ends of its steps, too. */

typedef struct frames {
    const equations *eq;
    const model *m;
    outcome_path *to;
    double begin, end; /* [s] of the motion */
    step_between inside;
    instant at;
} frames;

/* m, to, begin and end are given; count 0: no pictures. */
status frames_alloc(frames *, int count, fault *);
void frames_free(frames *);
/* Stores the initial state. */
status frames_begin(frames *, const instant *now, fault *);
status frames_step(frames *, between_degree, const instant *from, const instant *to, fault *);

/* From a state at one instant to that at another: inc[free + driven], additive for translations,
 * warping and angles, the rotation vector in the frame's axes for rotations of FORM_BODY. */

/* `to` has the frames of `from` moved by inc; its strains, stresses and inner unknowns stay. */
void increment_apply(const model *, const model_state *from, const double inc[], double time,
                     model_state *to);
/* Adds to inc the spatial increments dx of the state that it has led to; `now` is without dx. */
void increment_add(const model *, const model_state *now, const double dx[], double inc[]);

/* The integrator that a motion requests. */

/* REFUSED: it cannot integrate this model; the fault says why. */
status integrator_alloc(const scheme_request *, motion_scheme **, fault *);
void integrator_free(motion_scheme *);

/* Slope discontinuities and jumps of loads and prescribed motions: no step crosses one. */

/* The first after `time` [s]; INFINITY: there is none. */
double kinks_next(const model *, double time);
/* Time at which a step that ends at a discontinuity reads its loads: just before it. */
double kinks_before(const model *, double time);

/* One instant of a motion by mixed Newton (Nijenhuis et al., section 4) from the one before:
 * equilibrium with the forces of inertia of rates that follow the increment,
 *   v = v0 + g inc,   a = a0 + b inc.
 * Elements keep strains and stresses as unknowns, so that stiff ones cost no iterations. */

/* 1: the factors of the last equations serve for the next ones. Their error is the product of both
 * corrections; those of the stresses (newton.h) show it where members are stiff. Measured with
 * elongations 1e6 times stiffer: beyond 2e-4 corrections stop contracting and steps of 0.2 s fail;
 * below, there are as many iterations as with new factors. */
int stage_stands(const arrival *);

typedef struct motion_stage {
    analysis_context *c;
    const carried_masses *masses;
    sparse S;
    matrix_factor *factor;
    double *residual, *dx; /* [free + driven] */
    arrival arrival;
    complement *complement;
    int all, free;
    int begins; /* 1: at a discontinuity loads after it count, 0: those before */
    long counted;
} motion_stage;

status stage_alloc(analysis_context *, const carried_masses *, motion_stage *, fault *);
void stage_free(motion_stage *);

/* S dx = residual; fresh 0: with the factors that there are. */
status stage_direction(motion_stage *, int fresh, fault *);

/* All arrays [free + driven]. */
typedef struct stage_rates {
    double b, g;
    const double *a0, *v0;
    double *inc, *v, *a; /* in: inc is the guess; prescribed coordinates are exact */
} stage_rates;
/* `now` has the strains and stresses of `from`, or better ones, and comes to the state at `time`.
 * NOT_CONVERGED: why; then `now` is of no use. */
status stage_solve(motion_stage *, const model_state *from, double time, stage_rates *,
                   model_state *now, step_record *, fault *);

/* Initial conditions of a motion: requested velocities, with consistent accelerations and massless
 * coordinates. */

/* Consistent accelerations and massless coordinates after a discontinuity of the loads; velocities
 * do not change. */
status launch_again(analysis_context *, const carried_masses *, const scene_motion *, instant *now,
                    instant *room, fault *);
/* now: the state and the time are given; `room` is work space. frame: the axes that the state is at
 * rest in turn so [rad/s, m]; omega zero: they do not. REFUSED: something is prescribed or held
 * otherwise than that turns. */
status launch_turning(analysis_context *, const carried_masses *, const scene_motion *,
                      const scene_rotating_frame *frame, instant *now, instant *room, fault *);
/* From axes at rest. */
status launch(analysis_context *, const carried_masses *, const scene_motion *, instant *now,
              instant *room, fault *);

/* Motions of a body and of the ends released from it, with and without inertia. The positions of
 * those without inertia follow from balance at every instant. */

/* Free coordinates less the rank of their masses in the state. */
status massless_count(const model *, const carried_masses *, const model_state *, int *count,
                      fault *);
/* force[free], dx[free] (spatial increments of rotations): what of them works on, or is, motion
 * without inertia. */
status massless_forces(const model *, const carried_masses *, const model_state *, double force[],
                       fault *);
status massless_motion(const model *, const carried_masses *, const model_state *, double dx[],
                       fault *);
/* a[free] as rates have it (forms_rates) loses the motion without inertia. */
status massless_drop(const model *, const carried_masses *, const model_state *, double a[],
                     fault *);
/* Spatial turns of bodies -> as rates have them (forms_rates): a[free]. */
void massless_own_axes(const model *, const model_state *, double a[]);
/* The largest stiffness of what has inertia, by that [1/s^2]; diagonal[free]: of a stiffness. */
status massless_stiffest(const model *, const carried_masses *, const model_state *,
                         const double diagonal[], double *, fault *);
/* a[free] that forces give what has inertia, as rates have it (forms_rates); 0 for what has none.
 */
status massless_accelerate(const model *, const carried_masses *, const model_state *,
                           const double force[], double a[], fault *);

/* Extrema of a motion's reactions, resultants, stresses, energies and momenta. At the ends of steps
 * the values are those of the scheme. Between, a cubic through four consecutive ends shows where a
 * value may exceed them (order 4), and a separate step leads there. The cubic's value counts where
 * both agree to less than it adds, so that an extremum that steps do not resolve is rejected. */

enum { PEAKS_ENDS = 4 }; /* of consecutive steps */

/* One quantity. */
typedef struct peak {
    const scene_quantity *q;
    outcome_passing *out;
    double sign, from, until; /* 1: largest, -1: least; window [s] */
    double value[PEAKS_ENDS]; /* the last ones */
} peak;

typedef struct peaks {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    const carried_masses *masses;
    outcome_motion *out;
    int count, ends; /* quantities; ends since the start or the last discontinuity of the loads */
    peak *one;       /* [count] */
    instant last[PEAKS_ENDS], at;
} peaks;

/* c, analysis, scheme, masses and out are given. Does nothing where no quantity needs extrema. */
status peaks_alloc(peaks *, fault *);
void peaks_free(peaks *);
/* Adds the end of a step, with its energies. last 1: the last one before a discontinuity of the
 * loads or of the motion. */
status peaks_here(peaks *, const instant *, const double balance[SCENE_BALANCES], int last,
                  fault *);
/* Starts again after a discontinuity. */
void peaks_jump(peaks *);
/* The motion is over. */
void peaks_end(peaks *);

/* Motion of a frame over a step by the coordinates of its body and by those of a released end:
 * exact, so that forces do the same work on either. With means m of both ends of the step,
 *   moved by a body:      dr = dr_b + c x rho_m,   forces f, m + rho_m x f;
 *   by angles, or released to turn, each about b, with tau = 2 tan(d angle/2):
 *                         c_k = c_(k-1) + tau_k x_k,  x = [b + c x b/2 + c (c.b)/4]/(1 - tau c.b/4)
 *                         with b at the start: along the mean axis, about which no moment acts;
 *   released to slide:    dr = .. + c x (a s)_m + [a_m - c x (a_1 - a_n)/4] ds. */

enum { PLACE_MOST = 6 + SCENE_RELEASED };

typedef struct frame_place {
    int columns;                  /* the six of the node, then its own turns, then slides */
    double work[6 * PLACE_MOST];  /* [6 x columns] forces F on the frame are work^T F on these */
    double moved[6 * PLACE_MOST]; /* derivative of (dr, c) of the frame by these */
    double curved[PLACE_MOST * PLACE_MOST]; /* that of work^T F at fixed F */
    double measure[PLACE_MOST];             /* work times it is (dr, c): what forces work on */
} frame_place;

/* 1: the frame moves by its own dr, c; nothing else is set. F[6]: NULL: zero. */
int place_plain(const model *, int vertex);
void place_of(const conserving *, const model_state *from, const model_state *now, int vertex,
              const double F[6], frame_place *);
/* dr, c of a frame. */
void place_step(const conserving *, const model_state *from, const model_state *now, int vertex,
                double dr[3], double c[3]);

/* Forces[n] of a frame whose six begin at `at`, its own ones at `own`, become those of its
 * coordinates; so do rows; and K[n x n] on both sides. */
void place_forces(const frame_place *, int at, int own, double forces[]);
void place_row(const frame_place *, int at, int own, double row[]);
void place_matrix(const frame_place *, int n, int at, int own, double K[]);
/* Forces F[6] that act on a frame go to out[free + driven], and K[6 x 6] = -dF by its dr, c to the
 * tangent. */
void place_add(conserving *, const model_state *from, const model_state *now, int vertex,
               const double F[6], const double K[36], double out[]);

/* Radau IIA of three stages (Hairer & Wanner II, IV.8), order 5, for q' = v, v' = a: positions of
 * the stages are the unknowns, rotations by their vectors in the frame's axes,
 *   t_i' = 1/h sum_j B_ij t_j,  W_i = Jr(t_i) t_i',  a_i = 1/h sum_j B_ij (v_j - v),  B = A^-1,
 * every stage in mixed Newton (Nijenhuis et al., section 4), all three at once. */

/* Allocates the integrator; an additional factorisation in each step gives an error estimate of
 * order 3. */
status radau_alloc(const scheme_request *, motion_scheme **, fault *);

/* The matrix of three stages of one step: blocks [n x n] of three by three, off the
 * diagonal of the masses only. */

enum { STAGES = 3 };

typedef struct stages_matrix {
    sparse whole; /* 3 n; owns its pattern */
    int n;
    int *diagonal; /* [STAGES x n] where the column of the block on the diagonal begins */
} stages_matrix;

/* single: pattern of one block, whole. */
status stages_alloc(const equations *, const carried_masses *, const sparse *single,
                    stages_matrix *, fault *);
void stages_free(stages_matrix *);
/* The block of a stage on the diagonal becomes K; the others zero it first. */
void stages_put(stages_matrix *, int stage, const sparse *K);
void stages_zero(stages_matrix *);
/* Entries K[columns x columns] of an element of block (i, k) are added, of blocks that are all
 * whole (damping, consistent masses). pattern: of a single block. */
void stages_add_element(stages_matrix *, int i, int k, const mesh_pattern *pattern, int element,
                        const double K[]);
/* Entry (row, column) of block (i, k) += value; nothing where either is not free. */
void stages_add(stages_matrix *, int i, int k, int row, int column, double value);

/* Internals of the three stages. */

/* One stage. */
typedef struct radau_stage {
    model_state *state;
    double *inc, *rate, *v, *a; /* [free + driven]; rate: of inc */
    linear_memory memory;       /* of its linearisation */
    complement *complement;
} radau_stage;

typedef struct radau {
    motion_scheme base;
    const scheme_request of;
    double node[STAGES], weights[STAGES], B[STAGES * STAGES];
    radau_stage stage[STAGES];
    sparse K;
    stages_matrix S;
    matrix_factor *factor, *single; /* of S; of the matrix of the estimate */
    double *residual;               /* [STAGES x free] */
    double *dx;                     /* [free + driven] */
    double *weight;                 /* [free + driven] */
    arrival arrival;
    int free, all;
    long counted, counted_single;
} radau;

/* radau_equations.c */
/* Nodes, weights and B of the scheme. */
void radau_coefficients(radau *);
/* Instant of a stage [s]; that of the last one is exactly the requested end of the step. */
double radau_time(const radau *, const instant *from, double h, int stage, const step_record *);
/* v and a of all stages, from their increments. */
void radau_rates(radau *, const instant *from, double h);
/* Changes of the rates (rate) and accelerations of stage i by spatial increments of a vertex in
 * stage k: scalars for translations, [3 x 3] for its rotation, in the axes of its rates. */
typedef struct radau_relation {
    double rate, acceleration, turn_rate[9], turn_acceleration[9];
} radau_relation;
void radau_relate(const radau *, int vertex, double h, int i, int k, radau_relation *);

/* out = R B, R of a vertex in stage i. */
void radau_in_space(const radau *, int vertex, int i, const double B[9], double out[9]);

/* radau_equations.c */
/* The residual of all stages in their present states, and fresh 1: S. */
status radau_equations(radau *, int fresh, const instant *from, double h, step_record *, fault *);

/* radau_equations.c: adds the consistent masses to S. */
void radau_spread(radau *, double h);

/* radau_equations.c: adds the damping of members to the residual and, fresh 1, to S. */
void radau_damp(radau *, int fresh, const instant *from, double h);
/* Energy that they dissipate in a solved step [J]; room[elements x strains]. */
double radau_dissipated(const radau *, const instant *from, double h, double room[]);
/* Their part in radau_error: the model's stresses, with rates of strains -sum e_i (strains
 * gained)/h and tangent g, until damping_follow says otherwise. room likewise, as long. */
void radau_damp_error(const radau *, const instant *from, double h, const double e[STAGES],
                      double g, double room[]);

/* radau.c: error of positions that a solved step adds, in the measure of model.h. [g^2 M + K] error
 * = F(x, v) + M (sum e_i (v_i - v)/h + g (v + sum e_i inc_i/h)), with g = 1/(l h), l the real
 * eigenvalue of A, about the instant before. room: work space. */
status radau_error(radau *, const instant *from, double h, instant *room, double *error, fault *);

/* Masses of ends of members that are released from their nodes: they move with the coordinates of
 * the node's body and with their own turns and shifts (harness/model/model.h). */

/* Coordinates that such an end, or any other vertex, depends on. */
typedef struct released_masses {
    int count, own;             /* the first of its own coordinates among them */
    int body, ball;             /* first of three turns whose rates are an angular velocity in the
                                   axes of the body, of the end; -1: none */
    int index[KINEMATICS_MOST]; /* [count] coordinates */
    double T[6 * KINEMATICS_MOST]; /* [6 x count] its spatial motion by increments of them */
} released_masses;
void released_columns(const model *, const model_state *, int vertex, released_masses *);

/* As forms_rates and forms_add_force have it of nodes. */
void released_rates(const model *, const model_state *, int vertex, const double v[],
                    const double a[], frame_rates *);
void released_add_force(const model *, const model_state *, int vertex, const double F[6],
                        double out[]);

/* Velocities of the frame whose mass with its first moment [kg m] moves by own[6]: velocity of the
 * centre, angular velocity in the frame's axes. */
void released_moving(const double own[6], double mass, const double moment[3], frame_rates *);

/* out[6 x count]: T, whose columns are multiplied: by `plain`, those of turns in the axes of body
 * and end by matrices [3 x 3] from the right. */
void released_motion(const released_masses *, double plain, const double body[9],
                     const double ball[9], double out[6 * KINEMATICS_MOST]);
/* out[count x count] += T^T A motion */
void released_project(const released_masses *, const double A[36], const double motion[],
                      double out[KINEMATICS_MOST * KINEMATICS_MOST]);

/* Resumes a motion at the end of another one, as if there had been one only. */

/* Step control that a motion continues with. */
typedef struct resume_control {
    double step; /* [s] the next one */
    account account;
    double origin; /* [J] energy at t = 0 */
    int quiet;     /* steps since the last discontinuity of the loads */
    extent extent;
} resume_control;

/* Keeps the end for a motion of the scene that continues this one or, of the last one, for another
 * run (solve_options.keep_ends); else nothing. */
status resume_keep(const analysis_context *, int analysis, const instant *now,
                   const resume_control *, outcome_motion *, fault *);
/* The end in another run that the motion resumes from; NULL: there is none. */
const outcome_end *resume_given(const analysis_context *, int analysis);
/* The end of an earlier motion of the scene. NOT_CONVERGED: that motion stopped early. */
status resume_before(const analysis_context *, int before, const outcome_end **, fault *);
/* Sets the instant and the control from that end. REFUSED: it belongs to another mesh. */
status resume_take(const analysis_context *, const outcome_end *, instant *now, resume_control *,
                   fault *);

/* Consistent state of coordinates without inertia, from positions and rates at one instant. */

/* Brings massless coordinates into balance with the loads from now on and with the gyroscopic
 * moments of the other rates; then computes accelerations, 0 of massless coordinates. Coordinates
 * that damping holds for longer than a part of the step h [s] do not move; their rates make the
 * balance. zero[free + driven]. NOT_CONVERGED: there is no such balance. */
status settle(motion_stage *, const double zero[], double h, instant *now, fault *);

/* Forces of inertia for reactions and section forces. */

/* The motion that causes them. */
typedef struct shares_motion {
    const double *v, *a; /* [free + driven] */
    int spread;          /* 1: consistent mass of elements (element_spreads) */
} shares_motion;

/* F[6] += force and moment (about the node's frame) that the masses moved by a node take. */
status shares_node(const model *, const model_state *, const shares_motion *, int node, double F[6],
                   fault *);
/* density[nodes][6]: what the mass of one element takes where it moves as each of its nodes does,
 * per initial length, with the moment about that node. */
void shares_along(const model *, const model_state *, const shares_motion *, int element,
                  double density[ELEMENT_MAX_NODES][6]);
/* ends[e][7] += inertia force on the share of one element's mass at its first (0) and last (1)
 * node, with that on warping. */
void shares_ends(const model *, const model_state *, const shares_motion *, int element,
                 double ends[2][7]);

/* Consistent masses of elements (element_type.spreads), in place of those lumped at their nodes:
 * the forces of inertia at an element's nodes, transferred to the bodies that move them and to
 * released ends. Where an element cannot be evaluated, all of its numbers are NaN. */

struct mesh_element;

/* F[7 nodes]: on the nodes of an element themselves. */
void spread_force(const model *, int element, const model_state *, const double v[],
                  const double a[], double F[]);
/* As inertia_subtract, inertia_add_tangent and inertia_of have it of masses at frames. */
void spread_subtract(const model *, const model_state *, const double v[], const double a[],
                     double out[]);
void spread_add_tangent(const equations *, const model_state *, const double v[], const double a[],
                        const inertia_relation *, sparse *S);
void spread_add_balance(const model *, const model_state *, const double v[], double *kinetic,
                        double momentum[3], double angular[3]);

/* Derivatives of the inertia forces of one element by the motions of the bodies that move its
 * nodes, and of its ends where these are released: 7 coordinates of each node. */
typedef struct spread_parts {
    const struct mesh_element *el;
    const model_state *state;
    int columns; /* coordinates of the element: 7 of each node, then those of released ends */
    int wide;    /* 1: it has such an end, which may have no coordinate */
    double place[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], /* as inertia_parts */
        velocity[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES],
        acceleration[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
    double turn[ELEMENT_MAX_NODES][9], rate[ELEMENT_MAX_NODES][9];
} spread_parts;
void spread_element(const model *, int element, const model_state *, const double v[],
                    const double a[], spread_parts *);
/* The same masses alone, at rest. */
void spread_masses(const model *, int element, const model_state *, spread_parts *);
/* How the motion of one body follows the coordinates: translations and warping by a factor, turns
 * by a matrix; of a released end spatial turns of its body and of a ball joint, others by the
 * factor. */
typedef struct spread_motion {
    double plain, turn[9], ball[9];
} spread_motion;
/* By spatial increments of the coordinates. */
void spread_place(const model *, const spread_parts *, spread_motion place[]);
/* out[columns x columns] += A diag(motions); then the rows of turns by their coordinates. */
void spread_times(const model *, const spread_parts *, const double A[],
                  const spread_motion motion[], double out[]);
void spread_rows(const spread_parts *, double K[]);

/* Output of a motion at the requested instants, wherever its steps end. Positions and rates are
 * those of the polynomial inside the step; where forces or energies are read, a separate step leads
 * to the instant, and the motion does not continue from it. */

typedef struct stations {
    analysis_context *c;
    int analysis;
    const carried_masses *masses;
    motion_scheme *scheme;
    outcome_motion *out;
    step_between inside;
    instant at;
} stations;

/* c, analysis, masses, scheme and out are given. */
status stations_alloc(stations *, fault *);
void stations_free(stations *);
/* Stations inside a step, without its end. */
status stations_inside(stations *, const instant *from, const instant *to, fault *);
/* The station at the present time, if there is one. */
status stations_here(stations *, const instant *now, const double balance[SCENE_BALANCES], fault *);

/* Rotation vectors that belong to a turn of a frame between two instants, and their rates: with
 * R = R_n exp(t~), body rates W of R'(t) = R W~ and t' are
 *   W = Jr(t) t',  Jr(t) = 1 - (1 - cos |t|)/|t|^2 t~ + (|t| - sin |t|)/|t|^3 t~ t~.
 * 3 x 3 matrices are row-major. */

void turning_jacobian(const double t[3], double Jr[9]);
/* Its inverse 1 + t~/2 + (1 - |t|/2 cot(|t|/2))/|t|^2 t~ t~; |t| < 2 pi. */
void turning_inverse(const double t[3], double inverse[9]);
/* d(Jr(t) y)/dt at fixed y. */
void turning_derivative(const double t[3], const double y[3], double D[9]);
/* t becomes the vector of exp(t~) exp(d~). */
void turning_add(double t[3], const double d[3]);

/* Velocity and acceleration of frames. */

/* Rates of a node's frame or of a released end, by forms_rates. */
void inertia_rates(const model *, const model_state *, int vertex, const double v[],
                   const double a[], frame_rates *);
/* Rates of any vertex. */
void vertex_rates(const model *, const model_state *, int vertex, const double v[],
                  const double a[], frame_rates *);

/* Extrema, crossings of a level and means of a motion between its stations. Roots are those of the
 * polynomial inside a step, to round-off. */

/* One quantity. */
typedef struct watched {
    const scene_quantity *q;
    outcome_passing *out;
    double from, until; /* [s] */
    double noise;       /* values nearer to the level have no sign */
    int side;           /* of the level that was left last; 0: none yet */
    int crossings;      /* of its direction, in the window */
    double first, last; /* [s] of them */
    double error;       /* [s] of the first one and the last */
    double sum, span;   /* of values, or of squares in parts of `largest`, by time; [s] */
    double largest;     /* magnitude so far, of a root mean square */
} watched;

typedef struct watches {
    analysis_context *c;
    int analysis;
    motion_scheme *scheme;
    outcome_motion *out;
    int count;
    watched *one; /* [count] */
    step_between inside;
    instant at;
} watches;

/* c, analysis, scheme and out are given. */
status watches_alloc(watches *, fault *);
void watches_free(watches *);
status watches_step(watches *, const instant *from, const instant *to, fault *);
/* The motion is over. */
void watches_end(watches *);

#endif
