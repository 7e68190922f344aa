/* Small motions and stability about states whose tangent is not symmetric: loads that follow, and
 * moments about fixed axes.  There stability is lost by divergence, where the tangent is singular,
 * or by flutter, where two frequencies meet; with damping of members where a motion grows. */
#ifndef BEAMWORK_FLUTTER_H
#define BEAMWORK_FLUTTER_H

#include "harness/analysis/unsymmetric.h"
#include "harness/newton/newton.h"

typedef enum flutter_kind { FLUTTER_NONE, FLUTTER_DIVERGES, FLUTTER_OSCILLATES } flutter_kind;

/* Matrices of small motions about Newton's present state, whose K is factored. */
typedef struct flutter_system {
    sparse M, C;
    int damped;   /* 1: C is that of members; else motions are those without damping */
    int massless; /* 1: nothing has a mass; M is the metric, which knows no direction, so that
                     double values stay real: only what diverges has a meaning */
} flutter_system;

status flutter_system_alloc(const newton_run *, flutter_system *, fault *);
void flutter_system_free(flutter_system *);
/* The least `wanted` motions about the state. */
status flutter_motions(const newton_run *, flutter_system *, int wanted, int estimate,
                       unsymmetric_result *, fault *);
/* Frequencies, modes and errors become those of an outcome; what has no digits is NAN there. */
void flutter_take(unsymmetric_result *from, outcome_side *to);
/* What the motions are of: "", "undamped" where members are damped and damped is 0, or "with the
 * members' damping". */
const char *flutter_damping(const scene *, int damped);
/* What grows fastest, *mode of them. */
flutter_kind flutter_of(const flutter_system *, const unsymmetric_result *, int *mode);
/* "flutter, undamped", "divergence", "flutter, growth with the members' damping" */
const char *flutter_name(const flutter_system *, flutter_kind);

/* The path at which stability is first lost, from path 0: Newton stands at a state of it. *mode
 * [free], which the caller frees. */
typedef struct flutter_point {
    double path, error, frequency; /* error: in parts of the path; [rad/s] */
    const char *what;              /* flutter_name */
    int massless;
    double *mode;
} flutter_point;
/* From the present path to `target`: static_walk. */
typedef status flutter_walk(newton_run *, double target, double *increment, fault *);
status flutter_search(newton_run *, double size, flutter_walk *, flutter_point *, fault *);

#endif
