#ifndef BEAMWORK_TIME_H
#define BEAMWORK_TIME_H

#include "cases/scene/scene.h"
#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

typedef struct motion_state {
    double time; /* [s] */
    model_state *state;
    double *v, *a; /* [free + driven] rates, and their derivatives, in the forms of time_impl.h */
    /* [J] work of external forces, and energy dissipated by damping, since t = 0 */
    double work, dissipated;
    /* [model_stresses] strain rates of damped members, and the derivatives of these rates for
     * generalized-alpha and conserving steps; NULL: no damping */
    double *strain, *strain2;
    /* largest stress so far, and last contraction of Newton's method (see newton.h) */
    double stress, contraction;
    /* [released ends x 6] velocities of the masses of released ends in conserving steps: velocity
     * of the centre, and angular velocity in the axes of the end; NULL: none */
    double *ends;
    int ends_known;    /* 0: `ends` is not set; the velocities follow from v */
    double *algorithm; /* [free + driven] accelerations a of generalized-alpha (time_impl.h) */
} motion_state;

status motion_state_alloc(const model *, motion_state *, fault *);
void motion_state_free(motion_state *);
void motion_state_copy(const model *, const motion_state *from, motion_state *to);
/* Returns the number of values in `ends`. */
size_t motion_state_ends(const model *);

/* Interpolation of a motion inside a step by a polynomial for the increment of each coordinate. For
 * rotations, the increment is a rotation vector in the axes of the frame at the start. The
 * polynomial matches positions and rates at both ends, and also accelerations if their order equals
 * that of the rates. */

typedef enum dense_output_degree {
    /* matches positions and rates; the error is of order 4, and accelerations are linear */
    DENSE_OUTPUT_CUBIC,
    DENSE_OUTPUT_QUINTIC /* also matches accelerations; the error is of order 6 */
} dense_output_degree;

typedef struct dense_output {
    const equations *eq;
    const model *m;
    const motion_state *from, *to;
    dense_output_degree degree;
    double *part; /* [free + driven] x 5: coefficients of s, s^2, ..., s^5, with s from 0 to 1 in
                     the step */
    double *room; /* [3 x (free + driven)] */
} dense_output;

/* Computes the whole state. Strains, stresses and inner unknowns are interpolated linearly. */
void dense_output_at(const dense_output *, double time, motion_state *at);

/* Masses at the frames of a model: lumped masses of the elements, and rigid bodies. The masses that
 * are rigidly attached to a frame form one mass with a centre and a tensor. */

/* Mass at a frame, in axes that rotate with the frame and are parallel to the global axes in the
 * undeformed state. */
typedef struct frame_mass {
    int frame;         /* vertex that has coordinates, or vertex of a released end */
    double mass;       /* [kg] */
    double moment[3];  /* [kg m] mass times the position of the centre relative to the frame */
    double inertia[9]; /* [kg m^2] moment of inertia about the frame */
    /* part of `mass` that translations along each global axis do not move; see
     * frame_masses_diaphragms */
    double less[3];
} frame_mass;

typedef struct frame_masses {
    int masses;
    frame_mass *mass; /* [masses] one for each frame that has mass */
    /* [free + driven] masses of warping amplitudes [kg m^4]; 0 for other coordinates */
    double *warping;
    double total; /* [kg] total mass */
    /* 1: elements have consistent masses (time_impl.h), which are not contained in this
     * structure */
    int spread;
    /* [1/s] mass-proportional damping: ratio of force to momentum, including the elements */
    double damping;
} frame_masses;

/* Lumps the masses of elements at their nodes (mesh_element.share). Elements with three nodes have
 * the weights of Simpson's rule (Jonker, Eq. 73). */
status frame_masses_alloc(const model *, frame_masses *, fault *);
/* Like frame_masses_alloc, for rigid bodies only; the elements have consistent masses. */
status frame_masses_alloc_bodies(const model *, frame_masses *, fault *);
/* Copies the masses. The masses and inertia of the nodes of a diaphragm are transferred to the
 * master, except for motions along the normal. The diaphragm must not tilt. */
status frame_masses_diaphragms(const model *, const frame_masses *, frame_masses *, fault *);
void frame_masses_free(frame_masses *);
/* Computes a node's share of the mass of an element, its moment of inertia about the node, and the
 * mass [kg m^4] of the node's warping amplitude. */
struct mesh_element;
void frame_masses_share(const model *, const struct mesh_element *, int node, frame_mass *,
                        double *warping);

/* Work of external forces: loads, and reactions at prescribed coordinates. */

typedef struct outer_work {
    const equations *eq;
    const model *m;
    const frame_masses *masses;
    double *force, *holding; /* [free + driven] work space */
    double *dashpots;        /* [dashpots_room] */
    int elements, *element;  /* elements that have prescribed coordinates */
} outer_work;

status work_alloc(const equations *, const frame_masses *, outer_work *, fault *);
void work_free(outer_work *);

typedef struct scheme_request {
    analysis_context *c;
    const frame_masses *masses;
    const scene_motion *how;
    outer_work *work; /* computes motion_state.work */
    int estimate;     /* 1: an error estimate is requested for each step */
} scheme_request;

typedef struct motion_scheme motion_scheme;
struct motion_scheme {
    int order; /* order of the error of a step in the step size */
    /* 1: error estimates of steps add up to the error of the motion; 0: estimates are of lower
     * order and much larger than the errors */
    int adds;
    /* motions without inertia, which the error estimate excludes (metric_distance); NULL: none, or
     * unknown before the first step */
    const double *light;
    dense_output_degree
        degree; /* interpolation inside a step; quintic if accelerations are as accurate as rates */
    /* Makes a step of h [s]. *error: estimated error of the positions, with the norm of
     * metric_distance. NOT_CONVERGED: a smaller step may succeed. */
    status (*step)(motion_scheme *, const motion_state *from, double h, motion_state *to,
                   double *error, step_record *, fault *);
    void (*free)(motion_scheme *);
};

/* Energy-balance error relative to the energy of the motion. */

enum {
    ACCOUNT_STEPS = 10
}; /* number of steps after the start or a discontinuity in which the energy is not checked */
/* Limits relative to account_size: unexplained energy gain that stops a motion, energy loss that is
 * reported, and energy loss that stops a motion, unless its steps are fixed or rho is below 0.9
 */
extern const double account_gained, account_stated, account_lost;

typedef struct account {
    double largest; /* [J] largest energy so far */
    double turned;  /* [J] sum of the absolute work of all steps */
    double work;    /* [J] work at the end of the last step */
} account;

void account_take(account *, int steps, const double balance[SCENE_BALANCES]);
/* Returns the larger of two values [J]: the largest energy, and the sum of the absolute work of all
 * steps. */
double account_size(const account *);

int damping_acts(const model *);
int damping_of_elements(const model *);
/* Computes the damping matrices of all elements. After this call, stresses of the run include
 * damping. Strain rates are zero until they are set. */
status damping_begin(const equations *, run_damping *, fault *);
void damping_end(const equations *, run_damping *);

/* Computes the damping matrix C of small motions about a state, on a pattern of model.h. more [s]:
 * additional stiffness-proportional damping of all members and springs. */
status damping_matrix(const equations *, const model_state *, double more, sparse *C, fault *);

/* Adds to push[free + driven] the generalised forces of a load with feedback in a state, for a
 * factor of 1. Adds to measured[free + driven] the derivative of the measured component. */
void feedback_signals(const equations *, const model_state *, int load, double push[],
                      double measured[]);

/* Checks before any analysis runs that the integrator supports the formulation, the form of
 * Newton's method, the damping and the kind of mass, that the coordinates of the nodes determine
 * their orientations, and that the values of all drivers are known. Returns REFUSED if one of these
 * conditions is not satisfied. */
status motion_check(const analysis_context *, int analysis, fault *);
/* Runs a motion. NOT_CONVERGED: a step failed, or the size of the displacements, on which the steps
 * depend, is still unknown after several integrations. REFUSED: the integrator does not support the
 * model, or the motion cannot start from the requested state. */
status motion_analysis(analysis_context *, int analysis, analysis_outcome *, fault *);
/* Returns the end of another run that the motion continues; NULL: none. */
const outcome_end *resume_given(const analysis_context *, int analysis);
/* Returns REFUSED with the reason why the quantity is undefined (outcome_motion.undefined). */
status motion_undefined(const scene *, const scene_quantity *, fault *);

/* Transforms K and G of small motions about a state during a motion from fixed axes to rotating
 * axes, which are parallel to the fixed axes at the time of the state. room: work space. All
 * matrices have the pattern of `about`. The axes rotate with `node`. node SCENE_NONE: each node has
 * its own axes, unless some of its components are fixed, prescribed or constrained. REFUSED: the
 * rotation of `node` mixes free components of a node with other components. */
status about_turning(const model *, const outcome_about *, int node, sparse *K, sparse *G,
                     sparse *room, fault *);

typedef struct reading {
    const equations *eq;
    const model_state *state; /* state; NULL: only compliances are read */
    const double *v, *a;      /* [free + driven] rates of a motion and their derivatives; NULL: the
                                 structure is at rest */
    const double *balance;    /* [SCENE_BALANCES]; NULL: not needed */
    const double *compliance; /* [36]; NULL: not needed */
    int before;               /* 1: with the loads before a jump at this instant */
    /* linear statics about the undeformed state: displacements [free + driven] and stresses
     * [elements x strains] due to all loads; NULL: other analyses */
    const double *x, *sigma;
} reading;

/* Returns 1 if the quantity depends only on positions and rates. */
int reading_is_kinematic(const scene_quantity *);
/* Returns the value of a kinematic quantity, without factor and offset. For a jerk, returns the
 * acceleration. v, a[free + driven]: rates of a motion and their derivatives; NULL: the structure
 * is at rest. */
double reading_of(const model *, const scene_quantity *, const model_state *, const double v[],
                  const double a[]);
/* Returns 1 if the quantity is a derivative of a reading, which is known only inside steps. */
int reading_is_slope(const scene_quantity *);
/* Returns the rounding error of an acceleration or a jerk inside a step of h [s], without factor; 0
 * for other quantities. The cause is that increments of rounded positions are divided by h^2 or
 * h^3. */
double reading_rounding(const model *, const scene_quantity *, const model_state *, double h);
/* Computes the value, without factor and offset, of a quantity whose kind has a `read` function. */
status reading_whole(const reading *, const scene_quantity *, double *out, fault *);

#endif
