/* One file per kind of analysis; each turns a model into an outcome that extract.c reads quantities
 * from. */
#ifndef BEAMWORK_ANALYSIS_H
#define BEAMWORK_ANALYSIS_H

#include "harness/algebra/eigen.h"
#include "harness/analysis/solve.h"

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
void outcome_take(eigen_side *from, outcome_side *to);

typedef struct analysis_outcome {
    status status;
    char reason[FAULT_TEXT];
    /* linear: displacements of all coordinates */
    double *x;
    /* static, continuation: the state at every station reached (the first `reached` of them) */
    int stations, reached;
    double *path;
    model_state **state;
    /* continuation: load factor and control value [m] at every point of the path, the first without
     * load */
    int points;
    double *factor, *control;
    model_state **point_state; /* [points]; NULL unless a curve of coordinates is wanted */
    /* buckling, modal; what was found stays where the analysis failed */
    outcome_side positive, negative;
    /* compliance: of the six components at the node, at every station [stations x 36]; rows of held
     * components are zero, columns that nothing asks for NAN; belongs to the result */
    const double *compliance;
    /* rotation: modes at every station; none where no quantity asks for them */
    struct rotation_modes *modes; /* [stations] */
} analysis_outcome;

typedef struct analysis_context {
    const scene *scene;
    model *model;
    const solve_options *options;
    solve_result *result;       /* step records go here */
    analysis_outcome *outcomes; /* [analyses], those before the present one are complete */
    double setup;               /* [s] spent on patterns and symbolic factorisation */
    int singular;               /* 1: the last factorisation failed */
} analysis_context;

typedef status analysis_function(analysis_context *, int analysis, analysis_outcome *, fault *);
analysis_function analysis_linear, analysis_buckling, analysis_modal, analysis_static,
    analysis_compliance, analysis_continuation, analysis_rotation;

void outcome_free(analysis_outcome *o);

/* A linear solution about the undeformed state: x[free + driven] of K x = f, with the factors of K
 * kept for the caller. */
typedef struct linear_system {
    sparse K;
    factor *factor;
} linear_system;
status linear_system_alloc(analysis_context *, linear_system *, fault *);
void linear_system_free(linear_system *);
/* Loads at factor 1 and drivers at the end of their path (path 1). */
status linear_system_solve(analysis_context *, linear_system *, double x[], fault *);

/* modal.c: how many modes the quantities of an analysis ask for. */
int modal_wanted(const analysis_context *, int analysis);

/* extract.c */
void extract_quantity(const analysis_context *, const scene_quantity *, quantity_result *);
void extract_no_value(quantity_result *, status, const char *reason);
double extract_scaled(const scene_quantity *, double value);
/* continuation_extract.c: curves and critical points of a continued path; 0: the quantity is
 * something else. */
int extract_continuation(const analysis_context *, const scene_quantity *, const analysis_outcome *,
                         quantity_result *);
int continuation_keeps_states(const scene *, int analysis); /* a curve of coordinates is wanted */

/* shapes.c: centre lines of the undeformed structure, of at most `most` states of every path, of
 * linear solutions and modes. */
status shapes_collect(const analysis_context *, int most, shapes *, fault *);

/* modes.c: what a mode of vibration or buckling looks like. */
typedef struct mode_shape {
    scene_family family;
    int half_waves;
} mode_shape;
status mode_identify(const model *, const scene *, const double mode[], mode_shape *, fault *);
int mode_in_family(const scene_quantity *,
                   const mode_shape *); /* is it what the quantity asks for? */
const char *mode_family_name(scene_family);
/* Modes of equal value[count], one after the other (each [n = free + driven]), may be mixed in any
 * way: they become those that move along the members' z axes and those that do not. */
status mode_separate(const model *, const scene *, int count, const double value[], size_t n,
                     double *mode, fault *);

/* Small motions about one state of a stationary rotation. */
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] [rad/s], [1/s] */
    mode_shape *shape;          /* [count] */
} rotation_modes;
void rotation_modes_free(rotation_modes modes[], int stations);

/* When it was asked for: the condition of a matrix just factored, into the counters. */
void count_condition(const analysis_context *, factor *, const sparse *);

#endif
