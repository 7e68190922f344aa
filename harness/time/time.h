/* time/: integrators of motions, inertia, the runner. */
#ifndef BEAMWORK_TIME_H
#define BEAMWORK_TIME_H

#include "cases/scene/scene.h"
#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* State of a motion at one instant. */

typedef struct instant {
    double time; /* [s] */
    model_state *state;
    double *v, *a;           /* [free + driven] rates and their derivatives: see time_impl.h */
    double work, dissipated; /* [J] since t = 0: by external forces; by damping */
    double *strain,
        *strain2; /* [model_stresses] rates of the strains of what is damped, and
                     their derivatives as generalized-alpha has them; NULL: nothing is */
    double stress,
        contraction;   /* largest stress so far, and how Newton contracted last: newton.h */
    double *ends;      /* [released ends x 6] of their masses as conserving steps integrate them:
                          velocity of the centre, angular one in the end's axes; NULL: none is */
    int ends_known;    /* 0: they are those of v */
    double *algorithm; /* [free + driven] of generalized-alpha: the acceleration it averages */
} instant;

status instant_alloc(const model *, instant *, fault *);
void instant_free(instant *);
void instant_copy(const model *, const instant *from, instant *to);
/* Numbers in `ends`. */
size_t instant_ends(const model *);
/* The convergence history of Newton's method belongs to the instant: a rejected step leaves no
 * trace. Call recall before a step, and remember with the instant at its end. */
void instant_recall(const instant *from, arrival *);
void instant_remember(const arrival *, instant *to);

/* A motion inside one of its steps: a polynomial of every coordinate's increment, that of rotations
 * of the vector in the frame's axes at the start, with the positions and rates of both ends, and
 * with the accelerations too where a scheme has them to the same order. Prescribed coordinates are
 * read from their drivers. */

typedef enum between_degree {
    BETWEEN_CUBIC,  /* positions and rates: order 4 inside a step; accelerations are linear */
    BETWEEN_QUINTIC /* accelerations too: order 6 */
} between_degree;

typedef struct step_between {
    const equations *eq;
    const model *m;
    const instant *from, *to;
    between_degree degree;
    double *part; /* [free + driven] x 5: of s, s^2 .. s^5; s = 0 .. 1 along the step */
    double *room; /* [3 x (free + driven)] */
} step_between;

status between_alloc(const equations *, step_between *, fault *);
void between_free(step_between *);
/* Sets the step; both instants must not change as long as it is read. */
void between_take(step_between *, between_degree, const instant *from, const instant *to);
/* Positions and rates at a time of the step, or next to it [s]. */
void between_places(const step_between *, double time, instant *at);
/* The whole state. Strains, stresses and inner unknowns are linear between the ends of the step:
 * for pictures, not for forces. */
void between_at(const step_between *, double time, instant *at);

/* Masses at the frames of a model: those of the elements, lumped at their nodes, and rigid bodies.
 * All masses joined rigidly to a frame belong to it: one mass, one centre, one tensor. */

/* At one frame, in axes that rotate with it and were the fixed ones at rest. */
typedef struct carried_mass {
    int frame;         /* vertex with its own coordinates, or of a released end */
    double mass;       /* [kg] */
    double moment[3];  /* mass times its centre, from the frame [kg m] */
    double inertia[9]; /* about the frame [kg m^2] */
} carried_mass;

typedef struct carried_masses {
    int masses;
    carried_mass *mass; /* [masses] one for each frame that has any */
    double *warping;    /* [coordinates] of warping amplitudes [kg m^4], else 0 */
    double total;       /* [kg] of these */
    int spread;         /* 1: elements have a consistent mass (time_impl.h), and none is here */
} carried_masses;

/* Elements of two nodes have half their mass at each, of three Simpson's shares (Jonker, Eq. 73).
 * The mass of a released end moves with its own turns and shifts. */
status carried_alloc(const model *, carried_masses *, fault *);
/* Rigid bodies alone, in addition to consistent masses of elements. */
status carried_alloc_spread(const model *, carried_masses *, fault *);
void carried_free(carried_masses *);
/* Share of one node in the mass of an element, about the node, and of its warping amplitude [kg
 * m^4]. */
struct mesh_element;
void carried_share(const model *, const struct mesh_element *, int node, carried_mass *,
                   double *warping);

/* Work of external forces: of the loads and of the reactions at prescribed coordinates. */

typedef struct outer_work {
    const equations *eq;
    const model *m;
    const carried_masses *masses;
    double *force, *holding; /* [free + driven] room */
    double *dashpots;        /* [dashpots_room] */
    int elements, *element;  /* that prescribed coordinates move */
} outer_work;

status work_alloc(const equations *, const carried_masses *, outer_work *, fault *);
void work_free(outer_work *);

/* Power [W] at rates v (or work [J] along increments, rotations by vectors in the frames' axes):
 * `along`; the forces are those of the state with rates v and accelerations a, at `time`. */
double work_power(outer_work *, const model_state *, const double v[], const double a[],
                  double time, const double along[]);
/* Work of a step: mean of the forces at its start and its end along its increment inc[free +
 * driven]. Exact for constant forces; else of second order. */
double work_trapezoid(outer_work *, const instant *from, const instant *to, const double inc[]);

/* Interface of all time integrators: one step from an instant to another. */

typedef struct scheme_request {
    analysis_context *c;
    const carried_masses *masses;
    const scene_motion *how;
    outer_work *work; /* of external forces: for instant.work */
    int estimate;     /* 1: the error of each step is wanted */
} scheme_request;

typedef struct motion_scheme motion_scheme;
struct motion_scheme {
    int order;             /* of the error of one step that is estimated, in its size */
    int adds;              /* 1: the estimates add up to the error of the motion; 0: they are of a
                              lower order and far above it */
    const double *light;   /* what has no inertia and is in no error: metric_distance; NULL: none,
                              or not known before the first step */
    between_degree degree; /* inside a step; quintic: accelerations are as exact as rates */
    /* One step of h [s]; *error: estimate of what it adds to positions, in the measure
     * metric_distance. NOT_CONVERGED: `to` is of no use, `from` is as it was. */
    status (*step)(motion_scheme *, const instant *from, double h, instant *to, double *error,
                   step_record *, fault *);
    void (*free)(motion_scheme *);
};

/* Energy-balance error of a motion, relative to its energy. */

/* Parts of account_size: energy gained without cause that ends a motion; energy lost that is
 * reported, and energy lost that ends a motion unless the scene asks for it. */
enum { ACCOUNT_STEPS = 10 }; /* first steps: too little energy to measure an error by */
extern const double account_gained, account_stated, account_lost;

typedef struct account {
    double largest; /* [J] energy so far */
    double turned;  /* [J] sum of the work of all steps, whatever their signs */
    double work;    /* [J] at the last one */
} account;

/* Adds the balance at the start (steps 0), then of every step, in their order. */
void account_take(account *, int steps, const double balance[SCENE_BALANCES]);
/* The largest energy so far, or all the work so far, if that is larger [J]. */
double account_size(const account *);
/* [J] allowed energy-balance error: a part of that, and rounding. */
double account_most(const account *, double part, double rounding);

/* Is energy lost on purpose: by alpha with a spectral radius below 0.9, or by steps that the scene
 * prescribes? */
int account_loses(const scene_motion *);

/* NOT_CONVERGED: the motion has gained more energy than account_gained without cause, or lost more
 * than account_lost although the scene does not ask for it. rounding [J]: see balance_rounding. */
status account_judge(const account *, const scene_motion *, double time,
                     const double balance[SCENE_BALANCES], double rounding, fault *);

/* Stiffness-proportional damping: stresses gain eta S0 e', with the rates of the strains and the
 * stiffness S0 of the undeformed element. Rigid motions are not damped. Dashpots: the same with
 * the deformations of their spring and a matrix that is given. */

/* Is any member or spring of the scene damped? */
int damping_acts(const scene *);
int damping_of_members(const scene *);
/* S0 of all kinds, and from here on its share of the run's stresses, with rates that stay zero
 * until they are set. Nothing where no member is damped. */
status damping_begin(const equations *, run_damping *, fault *);
void damping_end(const equations *, run_damping *);

/* C of small motions about a state, on a pattern of model.h; more [s]: damping that all members and
 * springs have besides, in proportion to their stiffness. */
status damping_matrix(const equations *, const model_state *, double more, sparse *C, fault *);

/* Rates of the strains now: known + g (e - those of `from`, as they are); known[model_stresses].
 * from NULL: g is 0. */
void damping_follow(const equations *, double g, const double known[], const model_state *from);
/* Strains of elements and springs -> e[model_stresses]. */
void damping_strains(const model *, const model_state *, double e[]);
/* e' = J x' at rates v[free + driven] -> rate[model_stresses]. */
status damping_rates(const model *, const model_state *, const double v[], double rate[], fault *);
/* What dashpots take at rates v: out[free + driven] -=; returns the power that they lose [W].
 * room[dashpots_room]. */
size_t dashpots_room(const model *);
double dashpots_subtract(const model *, const model_state *, const double v[], double room[],
                         double out[]);
/* F[6] += on a node's frame. */
status dashpots_at_node(const model *, const model_state *, const double v[], int node, double F[6],
                        fault *);
/* Rates of the strains by those of the coordinates, which stay; nothing where nothing is damped. */
status damping_now(const equations *, instant *, fault *);
/* Power that rates of strains lose [W]. */
double damping_power(const equations *, const double rate[]);

/* Motion in time: states at the instants that were requested. */

status motion_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);

/* Quantities of a motion at an instant that need no forces. */

/* Is it read from positions and rates alone? */
int reading_is_kinematic(const scene_quantity *);
/* As extracted, without factor and offset; kinematic kinds only. rate[free + driven] */
double reading_of(const model *, const scene_quantity *, const model_state *, const double rate[]);

/* Quantities of a state that need more than positions and rates: reactions, resultants, stresses.
 */

/* As extracted, without factor and offset, of SCENE_REACTION, SCENE_INTERNAL and SCENE_STRESS. v,
 * a[free + driven]: rates of a motion and their derivatives; NULL: nothing moves. */
status resultants_of(const equations *, const scene_quantity *, const model_state *,
                     const double v[], const double a[], double *out, fault *);
/* Resultant in a section, in any state that internal_state describes. */
status resultants_in_section(const equations *, const scene_quantity *, const internal_state *,
                             double *out, fault *);

#endif
