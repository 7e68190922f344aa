/* What an analysis leaves for those that follow it and for the quantities that are read from it. */
#ifndef BEAMWORK_SOLVER_OUTCOME_H
#define BEAMWORK_SOLVER_OUTCOME_H

#include "harness/newton/modes.h"
#include "harness/numerics/numerics.h"

/* Critical loads of one sign, ascending in size, or frequencies [rad/s], ascending; with their
 * modes. */
typedef struct outcome_side {
    int count;
    double *value, *mode; /* [count] NAN: lost in round-off; [count x free] */
    double *error; /* [count] estimate of what iteration and round-off leave, in parts of the value;
                      NULL: there is none */
    status status; /* NOT_CONVERGED: ... */
    char reason[FAULT_TEXT]; /* ... why there are no more, or some are lost */
} outcome_side;
/* Small motions about one state of a stationary rotation. */
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] [rad/s], [1/s] */
    double *error; /* [count] estimate of what iteration and round-off leave of lambda = growth + i
                      frequency, in parts of its size */
    mode_shape *shape; /* [count] */
    int negative;      /* eigenvalues of the stiffness, and ... */
    int unproven;      /* ... those of them that the modes do not account for */
} rotation_modes;
void outcome_modes_free(rotation_modes *);

enum { OUTCOME_MEANING = 128 };
/* Buckling, modal; what was found stays where the analysis failed. */
typedef struct outcome_spectrum {
    outcome_side positive, negative; /* frequencies are positive */
    char meaning[OUTCOME_MEANING];   /* with or without the damping of members, or how stability is
                                        lost; "": nothing is damped, and loads have a potential */
    double growth;    /* [1/s] of modes about a state without potential, the largest; 0: stable */
    double *strained; /* [free + driven] displacements by initial strains alone, about which modes
                         of the structure without loads are; NULL: there are none */
} outcome_spectrum;

/* Stations of a path: static, and the first member of the three below. */
typedef struct outcome_path {
    int stations, reached; /* the first `reached` of them */
    double *value;         /* [stations] of the path parameter or the control coordinate */
    model_state **state;   /* [stations]; NULL: of a compliance */
} outcome_path;

/* Of a node at one station, [6 x 6] both. */
typedef struct station_matrices {
    int known;
    double C[36], K[36];
} station_matrices;

typedef struct outcome_compliance {
    outcome_path path;
    /* of the six components at the node, at every station [stations x 36]; rows of held components
     * are zero, columns that nothing asks for NAN; belongs to the result */
    const double *matrix;
    station_matrices *taken; /* [stations] on the way along the path; NULL: none */
} outcome_compliance;

typedef struct outcome_rotation {
    outcome_path path;
    rotation_modes *modes; /* [stations]; NULL where no quantity asks for them */
} outcome_rotation;

/* Of a motion at one instant, by scene_balance. */
typedef struct outcome_instant {
    double *rate, *acceleration; /* [free + driven]: see harness/time/forms.h; one block */
    double balance[SCENE_BALANCES];
} outcome_instant;

/* What a motion passed through, wherever its stations lie, of one quantity. */
enum { PASSING_LOST = 2 }; /* a turn has lost its direction (harness/model/model.h) */
typedef struct outcome_passing {
    int known;    /* 1, 0: not, or PASSING_LOST */
    double value; /* as extracted, or a time [s], or how often in a second */
    double time;  /* [s] of a largest or least value */
    double error; /* estimate of what reading it between the ends of steps adds to the value */
} outcome_passing;

/* Of a motion where a step ended that was accepted; the first one: of the begin. */
typedef struct outcome_step {
    double time, step;        /* [s] its end and length; of the begin 0 */
    double error;             /* estimate of what it adds to positions, in the measure of model.h;
                                 0: it was not asked for */
    int iterations, rejected; /* rejected: longer ones that were tried before it */
    double balance[SCENE_BALANCES];
} outcome_step;

/* Where a motion stopped: all that one needs which goes on from there. */
typedef struct outcome_end {
    int analysis;            /* of the scene */
    double time, step;       /* [s] step: the next one */
    double path;             /* of the state */
    double work, dissipated; /* [J] since the begin */
    double largest, origin;  /* [J] largest energy so far; that of the begin */
    double turned;           /* [J] sum of the work of all steps, whatever their signs */
    double scale, extent, rate, density; /* of extent.h */
    double stress, contraction;          /* of arrival.h */
    int quiet;                           /* steps since what acts was last smooth no longer */
    size_t states, coordinates, strains, released, between;
    double *value; /* [2 states + 3 coordinates + 2 strains + released + 5 between]; NULL: none. The
                      state; that of the begin; rates, their derivatives, and what generalized-alpha
                      has of these; rates of damped strains and their derivatives; rates of released
                      ends as conserving steps have them; turns of nodes against others (model.h) */
} outcome_end;
/* How many numbers `value` has. */
size_t outcome_end_values(const outcome_end *);
void outcome_end_free(outcome_end *);

typedef struct outcome_motion {
    outcome_path path;
    outcome_instant *instant; /* [stations] */
    int steps;                /* with the begin */
    outcome_step *step;       /* [steps] */
    outcome_passing *passing; /* [quantities of the scene] */
    outcome_path frames;      /* for pictures, evenly over the time */
    double origin;            /* [J] energy at the begin, of the first of motions that go on */
    outcome_end end;
} outcome_motion;

typedef struct outcome_continuation {
    outcome_path path;
    int points;               /* of the path, the first without load */
    double *factor, *control; /* [points] load factor and control value [m] */
    int undecided; /* 1: whether there are critical points between these load factors, and
                      how many, could not be told: what is known are the events before */
    int decided_events;
    double undecided_from, undecided_to;
    model_state **state; /* [points] of nodes; NULL unless a curve of coordinates is wanted */
} outcome_continuation;

typedef struct analysis_outcome {
    scene_analysis_kind kind;
    status status;
    char reason[FAULT_TEXT];
    union {        /* written by the analysis, read through the functions below */
        double *x; /* linear: displacements of all coordinates */
        outcome_spectrum spectrum;
        outcome_path path; /* static */
        outcome_compliance compliance;
        outcome_rotation rotation;
        outcome_continuation continuation;
        outcome_motion motion;
    } left;
} analysis_outcome;

/* What the kind leaves; another kind ends the program. */
const double *outcome_displacements(const analysis_outcome *);
const outcome_spectrum *outcome_spectrum_of(const analysis_outcome *);
/* Of any analysis along a path. */
const outcome_path *outcome_path_of(const analysis_outcome *);
const outcome_compliance *outcome_compliance_of(const analysis_outcome *);
const outcome_rotation *outcome_rotation_of(const analysis_outcome *);
const outcome_motion *outcome_motion_of(const analysis_outcome *);
/* Of a motion, to be filled. */
outcome_motion *outcome_motion_in(analysis_outcome *);
const outcome_continuation *outcome_continuation_of(const analysis_outcome *);
/* A static path, or that of a stationary rotation, to be filled. */
outcome_path *outcome_walk(analysis_outcome *);
int outcome_has_path(const analysis_outcome *);
int outcome_has_spectrum(const analysis_outcome *);
void outcome_free(analysis_outcome *);
/* The values and modes of a side; they are taken from `from`. */
void outcome_take(eigen_side *from, outcome_side *to);
/* Room for the states of so many stations. */
status outcome_stations(outcome_path *, int stations, fault *);
/* A copy of the state becomes that of the next station; whole 0: of its nodes
 * (kinematics_nodes_alloc). */
status outcome_keep(outcome_path *, const model *, const model_state *, int whole, double path,
                    fault *);

#endif
