/* What is analysed: a kind, and what that kind alone needs.  Every scene_add_* returns the index of
 * the new analysis, or -1 when memory ran out.  What a kind has is read through its function below,
 * which ends the program when the analysis is of another kind: nothing else names the union. */
#ifndef BEAMWORK_SCENE_ANALYSIS_H
#define BEAMWORK_SCENE_ANALYSIS_H

typedef struct scene scene;

enum { SCENE_NONE = -1, SCENE_NAME = 48, SCENE_UNIT = 16 }; /* sizes with the final zero */

typedef enum scene_analysis_kind {
    SCENE_LINEAR,     /* one linear solution with the loads at factor 1 */
    SCENE_STATIC,     /* nonlinear equilibrium along the path */
    SCENE_BUCKLING,   /* linear prestress about the undeformed state: what the loads have at path 0
                         stays, what they gain by path 1 is times the factor; or about the last
                         of a path */
    SCENE_MODAL,      /* natural frequencies about the present state */
    SCENE_COMPLIANCE, /* at every station of the static path before it */
    SCENE_CONTINUATION, /* path of a load factor, by arc length or by one coordinate */
    SCENE_ROTATION,     /* stationary: equilibrium and frequencies in the rotating frame */
    SCENE_MOTION        /* in time: the path parameter is the time [s] */
} scene_analysis_kind;

/* What a reaction's moment does while its node turns (harness/newton/newton.h). */
typedef enum scene_moments {
    SCENE_MOMENTS_SPATIAL,
    SCENE_MOMENTS_SEMITANGENTIAL,
    SCENE_MOMENTS_SYMMETRISED
} scene_moments;
#define SCENE_MOMENTS_CHOICES "spatial|semitangential|symmetrised"
const char *scene_moments_name(scene_moments);

/* Where to stop: of the path parameter, ascending; of a continuation: of its control coordinate
 * [m], as met. */
typedef struct scene_path {
    int stations;
    double *value; /* [stations] */
} scene_path;

/* The scene's axes turn.  Along a static path or a continuation this is constant, in a stationary
 * rotation it is times the path parameter.  Zero: at rest. */
typedef struct scene_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point on its axis [m] */
} scene_rotating_frame;

/* Static, rotation. */
typedef struct scene_walk {
    scene_path path;
    int steps_between; /* load steps from one station to the next, to begin with; >= 1 */
    int modes;         /* rotation: how many to look for at first, of all families together */
    scene_rotating_frame frame;
} scene_walk;

typedef struct scene_compliance {
    int node;
    scene_moments moments;
    unsigned released; /* bit i: component i at the node, though prescribed, is free and its
                          reaction is a dead load */
} scene_compliance;

/* How the path of proportional loads is followed, whose factor is unknown.  The control coordinate
 * is a translation of any node, also of an attached one; by arc length it is what curves are drawn
 * over.  The arc is the root of the mean, over all nodes, of (displacement/size of the scene)^2 +
 * rotation^2, dimensionless. */
typedef struct scene_control {
    int node, component;
    int by_arc;            /* 1: steps are lengths of arc, 0: steps of the control coordinate */
    double step, step_max; /* first and largest step [m, or 1 by arc length] */
    int constant_steps; /* 1: all steps are `step`, and a branch jump ends the path; 0: steps adapt,
                           and a jump is walked around */
} scene_control;

typedef struct scene_continuation {
    scene_path path;
    scene_rotating_frame frame;
    scene_control control;
} scene_continuation;

/* How a motion is integrated. */
typedef enum scene_scheme {
    SCENE_ALPHA,      /* generalized-alpha: order 2, damps what is not resolved */
    SCENE_CONSERVING, /* order 2, keeps energy and momenta */
    SCENE_RADAU,      /* Radau IIA of three stages: order 5 */
    SCENE_EXPLICIT,   /* Runge-Kutta of order 8: for truths */
    SCENE_SCHEMES
} scene_scheme;

#define SCENE_SCHEME_CHOICES "alpha|conserving|radau|explicit"

/* How the mass of members lies. */
typedef enum scene_mass {
    SCENE_MASS_USUAL, /* consistent where the formulation and all integrators of the motions that
                         go on from each other have it so, and the scene does not lump it */
    SCENE_LUMPED,     /* at the nodes, with all formulations alike */
    SCENE_CONSISTENT  /* along the elements, as a formulation has it that offers that */
} scene_mass;

#define SCENE_MASS_CHOICES "lumped|consistent"

/* Of generalized-alpha: alpha_m, alpha_f by rho, the spectral radius of what is not resolved; or as
 * given. */
typedef struct scene_alpha {
    double mass, force; /* alpha_m, alpha_f */
} scene_alpha;

/* Velocities at the begin: that of a rigid body that turns about a point. */
typedef struct scene_start {
    double velocity[3], spin[3], centre[3]; /* [m/s], [rad/s], [m] */
} scene_start;

/* In time, from rest or with `start`; about the last state of the path it follows, of a motion with
 * its rates and at its time. */
typedef struct scene_motion {
    scene_path path; /* instants at which quantities are read [s] */
    scene_scheme scheme;
    scene_alpha alpha;
    double step;      /* [s] first one; without a tolerance all */
    double tolerance; /* of the error of a step, relative to the size; 0: steps stay */
    scene_start start;
    scene_mass mass;
} scene_motion;

typedef struct scene_analysis {
    scene_analysis_kind kind;
    int follows; /* analysis whose state(s) this one is about, or SCENE_NONE: undeformed */
    union {
        scene_walk walk;
        scene_compliance compliance;
        scene_continuation continuation;
        scene_motion motion;
    } of;
    char name[SCENE_NAME]; /* "": none */
} scene_analysis;

int scene_add_linear(scene *s);
int scene_add_static(scene *s, int stations, const double path[], int steps_between);
/* As many eigenvalues as the quantities ask for. */
int scene_add_buckling(scene *s, int follows);
int scene_add_modal(scene *s, int follows);
int scene_add_compliance(scene *s, int follows, scene_compliance what);
int scene_add_continuation(scene *s, int stations, const double path[], scene_control control);
int scene_add_rotation(scene *s, int stations, const double path[], int steps_between, int modes,
                       scene_rotating_frame frame);
int scene_add_motion(scene *s, int follows, int stations, const double path[], scene_motion how);
/* alpha_m = (2 rho - 1)/(rho + 1), alpha_f = rho/(rho + 1) (Chung & Hulbert 1993). */
scene_alpha scene_alpha_of_radius(double rho);
/* Turns the axes of a static path or a continuation. */
void scene_set_rotating_frame(scene *s, int analysis, scene_rotating_frame frame);

/* "linear", "static", ...: as a scene file says it. */
const char *scene_analysis_name(scene_analysis_kind);

const scene_walk *scene_walk_of(const scene_analysis *a);
const scene_compliance *scene_compliance_of(const scene_analysis *a);
const scene_continuation *scene_continuation_of(const scene_analysis *a);
const scene_motion *scene_motion_of(const scene_analysis *a);
/* Is it a motion that is told to spread its mass along the elements? */
int scene_spreads(const scene_analysis *a);
/* Is it a motion whose elements are to do that where they can? */
int scene_may_spread(const scene *s, int analysis);
/* NULL: the kind has none. */
const scene_path *scene_path_of(const scene_analysis *a);
/* What a motion starts from, and the motions before it that it goes on from: a static path, a
 * continuation, a rotation; SCENE_NONE: the undeformed state. */
int scene_origin_of(const scene *s, int analysis);
const scene_rotating_frame *scene_rotating_frame_of(const scene_analysis *a);
/* Do the axes turn? */
int scene_rotates(const scene_analysis *a);

#endif
