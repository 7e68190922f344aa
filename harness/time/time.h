/* time/: integrators of transient analyses, inertia, and the analysis itself. */
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
    double *v, *a; /* [free + driven] rates and their derivatives, as defined in time_impl.h */
    double work, dissipated;    /* [J] since t = 0: work of external forces, and energy lost by
                                   damping */
    double *strain, *strain2;   /* [model_stresses] strain rates of damped members and their
                                   derivatives as used by generalized-alpha; NULL: no damping */
    double stress, contraction; /* largest stress so far, and last contraction of Newton's
                                   method: see newton.h */
    double *ends;   /* [released ends x 6] velocities of the masses of released ends in conserving
                       steps: velocity of the centre, angular velocity in the axes of the end; NULL:
                       no such mass */
    int ends_known; /* 0: the values of `ends` are not set; they follow from v */
    double *algorithm; /* [free + driven] the acceleration that generalized-alpha averages */
} instant;

status instant_alloc(const model *, instant *, fault *);
void instant_free(instant *);
void instant_copy(const model *, const instant *from, instant *to);
/* Returns the number of values in `ends`. */
size_t instant_ends(const model *);

/* A motion inside one step, interpolated by a polynomial of the increment of every coordinate.
 * For rotations, the increment is a rotation vector in the axes of the frame at the start. The
 * polynomial matches positions and rates at both ends, and also accelerations if the scheme
 * computes them to the same order. Prescribed coordinates come from their drivers. */

typedef enum between_degree {
    BETWEEN_CUBIC,  /* matches positions and rates: error of order 4 inside a step; accelerations
                       are linear */
    BETWEEN_QUINTIC /* also matches accelerations: error of order 6 */
} between_degree;

typedef struct step_between {
    const equations *eq;
    const model *m;
    const instant *from, *to;
    between_degree degree;
    double
        *part; /* [free + driven] x 5: coefficients of s, s^2 .. s^5; s = 0 .. 1 along the step */
    double *room; /* [3 x (free + driven)] */
} step_between;

/* Computes the whole state. Strains, stresses and inner unknowns are interpolated linearly,
 * which is accurate enough for pictures but not for forces. */
void between_at(const step_between *, double time, instant *at);

/* Masses at the frames of a model: lumped masses of the elements, and rigid bodies. All masses
 * joined rigidly to a frame are combined into one mass with one centre and one tensor. */

/* Mass at one frame, in axes that rotate with it and are parallel to the global ones in the
 * undeformed state. */
typedef struct carried_mass {
    int frame;         /* vertex with its own coordinates, or vertex of a released end */
    double mass;       /* [kg] */
    double moment[3];  /* mass times the position of its centre relative to the frame [kg m] */
    double inertia[9]; /* moment of inertia about the frame [kg m^2] */
} carried_mass;

typedef struct carried_masses {
    int masses;
    carried_mass *mass; /* [masses] one for each frame that has mass */
    double *warping;    /* [coordinates] mass of warping amplitudes [kg m^4], else 0 */
    double total;       /* [kg] total mass */
    int spread;     /* 1: the elements have consistent masses (time_impl.h), which are not included
                       here */
    double damping; /* [1/s] mass-proportional damping: ratio of force to momentum, also for the
                       elements */
} carried_masses;

/* Lumps half of the mass of a two-node element at each node, and Simpson's weights for three nodes
 * (Jonker, Eq. 73). The mass of a released end moves with the rotations and shifts of that end. */
status carried_alloc(const model *, carried_masses *, fault *);
/* As carried_alloc, but with rigid bodies only, for elements with consistent masses. */
status carried_alloc_spread(const model *, carried_masses *, fault *);
void carried_free(carried_masses *);
/* Computes one node's share of the mass of an element, about the node, and the mass of its
 * warping amplitude [kg m^4]. */
struct mesh_element;
void carried_share(const model *, const struct mesh_element *, int node, carried_mass *,
                   double *warping);

/* Work of external forces: loads, and reactions at prescribed coordinates. */

typedef struct outer_work {
    const equations *eq;
    const model *m;
    const carried_masses *masses;
    double *force, *holding; /* [free + driven] work space */
    double *dashpots;        /* [dashpots_room] */
    int elements, *element;  /* elements that have prescribed coordinates */
} outer_work;

status work_alloc(const equations *, const carried_masses *, outer_work *, fault *);
void work_free(outer_work *);

/* Interface of all time integrators: a step from one instant to the next. */

typedef struct scheme_request {
    analysis_context *c;
    const carried_masses *masses;
    const scene_motion *how;
    outer_work *work; /* work of external forces, for instant.work */
    int estimate;     /* 1: an error estimate of each step is requested */
} scheme_request;

typedef struct motion_scheme motion_scheme;
struct motion_scheme {
    int order; /* order of the error of one step in the step size */
    int adds;  /* 1: the error estimates of the steps add up to the error of the motion; 0: the
                  estimates are of lower order and much larger than the errors */
    const double *light; /* coordinates without inertia, which the error ignores: metric_distance;
                            NULL: none, or not known before the first step */
    between_degree
        degree; /* interpolation inside a step; quintic if accelerations are as accurate as rates */
    /* Makes one step of h [s]. *error: estimated error of the positions, in the measure of
     * metric_distance. NOT_CONVERGED: `to` is invalid, and `from` has not changed. */
    status (*step)(motion_scheme *, const instant *from, double h, instant *to, double *error,
                   step_record *, fault *);
    void (*free)(motion_scheme *);
};

/* Energy-balance error of a motion, relative to its energy. */

/* Limits relative to account_size: unexplained energy gain that stops a motion; energy loss that is
 * reported; energy loss that stops a motion unless the scene requests numerical damping. */
enum {
    ACCOUNT_STEPS = 10
}; /* number of first steps in which the energy is too small to measure an error */
extern const double account_gained, account_stated, account_lost;

typedef struct account {
    double largest; /* [J] largest energy so far */
    double turned;  /* [J] sum of the absolute work of all steps */
    double work;    /* [J] work at the end of the last step */
} account;

/* Adds the energy balance of a step; to be called with the initial balance (steps 0), then for
 * every step in order. */
void account_take(account *, int steps, const double balance[SCENE_BALANCES]);
/* Returns the largest energy so far or the total absolute work so far, whichever is larger [J]. */
double account_size(const account *);

/* Returns 1 if a member or a spring of the scene is damped. */
int damping_acts(const scene *);
int damping_of_members(const scene *);
/* Computes S0 of all kinds of elements. After this call the stresses of the run include damping,
 * with strain rates that are zero until they are set. Does nothing when no member is damped. */
status damping_begin(const equations *, run_damping *, fault *);
void damping_end(const equations *, run_damping *);

/* Computes the damping matrix C of small motions about a state, on a pattern of model.h. more
 * [s]: additional stiffness-proportional damping of all members and springs. */
status damping_matrix(const equations *, const model_state *, double more, sparse *C, fault *);

/* For a load with feedback in a state, adds to push[free + driven] the generalised forces of a
 * factor of 1, and to measured[free + driven] the derivative of the measured component. */
void feedback_signals(const equations *, const model_state *, int load, double push[],
                      double measured[]);

/* Transient analysis: computes the states at the requested instants. */

status motion_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Returns REFUSED with the reason why the quantity has no value (outcome_motion.undefined). */
status motion_undefined(const scene *, const scene_quantity *, fault *);

/* Transforms K and G of small motions about an instant to axes that rotate and are parallel to
 * the fixed axes at the instant. K, G: input in fixed axes, output in rotating axes; room: work
 * space. All have the pattern of `about`. The axes rotate with `node`. node SCENE_NONE: the axes
 * of each node rotate with that node, unless some of its components are fixed, prescribed or
 * constrained. REFUSED: a node is fixed, prescribed or constrained across the rotation of
 * `node`. */
status about_turning(const model *, const outcome_about *, int node, sparse *K, sparse *G,
                     sparse *room, fault *);

/* Quantities of a state, as read by their files in cases/quantities. */

/* Known data of a state. */
typedef struct reading {
    const equations *eq;
    const model_state *state; /* NULL: not stored, because only compliances are read */
    const double *v,
        *a; /* [free + driven] rates of a motion and their derivatives; NULL: at rest */
    const double *balance;    /* [SCENE_BALANCES]; NULL: not needed */
    const double *compliance; /* [36]; NULL: not needed */
    /* for linear statics about the undeformed state: displacements [free + driven] and stresses
     * [elements x strains] under all loads; else NULL */
    const double *x, *sigma;
} reading;

/* Returns 1 if the quantity depends on positions and rates only. */
int reading_is_kinematic(const scene_quantity *);
/* Returns the value without factor and offset, for kinematic kinds only; for a jerk, the
 * acceleration. v, a[free + driven]: rates of a motion and their derivatives; NULL: at rest. */
double reading_of(const model *, const scene_quantity *, const model_state *, const double v[],
                  const double a[]);
/* Returns 1 if the quantity is the slope of a reading, which is known only inside steps. */
int reading_is_slope(const scene_quantity *);
/* Computes the value, without factor and offset, for every kind of quantity with a `read`
 * function. */
status reading_whole(const reading *, const scene_quantity *, double *out, fault *);

#endif
