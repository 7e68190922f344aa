/* Continuation of equilibrium paths under proportional loads, inside of its files.
 *
 * The load factor is one more unknown and one coordinate, or the arc, is given instead:
 *   K dx = r + f' dl,  g . dx = c,  hence dx = K^-1 r + dl K^-1 f',
 *   dl = (c - g . K^-1 r)/(g . K^-1 f').
 * K as it was factored last on the way to a point gives the tangent of the path there, the first
 * direction of the next step and, where K is symmetric, the number of its negative eigenvalues: the
 * last correction is at most the criterion, and so is, but for a factor, what K has changed by. */
#ifndef BEAMWORK_CONTINUATION_IMPL_H
#define BEAMWORK_CONTINUATION_IMPL_H

#include <complex.h>

#include "harness/analysis/flutter_judge.h"
#include "harness/analysis/flutter_left.h"

/* A point of the path. */
typedef struct path_point {
    double factor, control; /* [1], [m] */
    double rate;            /* dfactor/ds with s in the model's metric */
    double *tangent;        /* [free + driven] dx/ds */
    int symmetric;
    int negative; /* negative pivots of K, or what left_count counts in their place; -1: not known
                   */
    int determinant; /* sign of det K */
    double least;    /* eigenvalue of K of least size, its real part where K is not
                        symmetric; NAN: not asked for */
    int nearest;
    double complex mu[LEFT_NEAREST]; /* [nearest] eigenvalues next to zero, least size first, where
                                        K is not symmetric */
} path_point;

/* Where a step goes: to this value of the control coordinate, or so far along the arc. */
typedef struct path_goal {
    int by_arc;
    double value;
} path_goal;

typedef struct continuation {
    analysis_context *c;
    const scene_control *by;
    const scene_path *path;
    outcome_continuation *o;
    int analysis, room; /* room: for points in the outcome */
    int asks_critical;  /* 1: a quantity asks for critical points */
    int keeps_states;   /* 1: the outcome keeps the state of every point */
    newton_run n;       /* n.backup: state at the start of the step */
    flutter_judge judge;
    model_state *end; /* of the step, while a critical point inside it is looked for */
    double *weight;   /* [free + driven] the metric */
    double *load;     /* [free + driven] f' */
    double *response; /* [free + driven] K^-1 f' */
    double *moved;    /* [free + driven] sum of the increments of the step */
    double *mode;     /* [free + driven] null vector */
    path_goal goal;   /* of the step that is iterated */
    path_point here, next, trial;
    int first;    /* negative pivots at the begin */
    int narrow;   /* 1: where something changes was told as near as can be */
    int doubtful; /* 1: whether the step has critical points could not be decided */
    int looked;   /* 1: n.dx, response and the factors belong to the present state */
} continuation;

status continuation_step_alloc(analysis_context *, int analysis, outcome_continuation *,
                               continuation *, fault *);
void continuation_step_free(continuation *);

double continuation_step_dot(const continuation *, const double a[],
                             const double b[]); /* in the metric */
/* Newton to the goal from n.backup = the state of `here`; the arc is measured along its tangent. */
status continuation_step_correct(continuation *, path_goal, step_record *, fault *);
/* The same from the present state, to which the last one led. */
status continuation_step_go_on(continuation *, path_goal, step_record *, fault *);
/* Factors K in the present state and fills the point; its tangent goes the way of along[free +
 * driven] (NULL: to a larger load). */
status continuation_step_look(continuation *, const double along[], path_point *, step_record *,
                              fault *);
/* After a correction that has converged: the point from the last factors, which belong to a state
 * that is away by the last correction; nothing is left to correct. */
status continuation_step_end(continuation *, path_point *, const step_record *, fault *);
/* The state goes back to that of `here`. */
void continuation_step_go_back(continuation *);

/* continuation_sound.c: why the step from `here` to `next` is too long or led to another branch;
 * NULL: sound. *swing: how much it turns relative to what is allowed. last_resort: several critical
 * points may lie in one step, as it cannot be shorter. */
const char *continuation_sound_doubt(const continuation *, int last_resort, double *swing);

/* The end of a step in doubt. */
typedef struct rival {
    model_state *state; /* NULL: none */
    double factor;
} rival;

/* The step from the control coordinate `from` had led to the rival, the path leads here: an event,
 * and with constant steps the end. */
status continuation_sound_report_jump(continuation *, const rival *, double from, fault *);

/* continuation_critical.c: the critical points between `here` and `next`, if any, become events.
 * The step was found with the goal. *jump: 1 when the tangent stiffness changes its inertia without
 * a critical point, which is another branch. */
status continuation_critical(continuation *, path_goal, int *jump, fault *);
/* Where critical points are asked for: *hidden 1 when something changes within the step and back,
 * as far as that lasts a fifth of it. */
status continuation_critical_within(continuation *, path_goal, int *hidden, fault *);

#endif
