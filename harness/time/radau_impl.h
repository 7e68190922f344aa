/* Inside of the three stages. */
#ifndef BEAMWORK_RADAU_IMPL_H
#define BEAMWORK_RADAU_IMPL_H

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/complement.h"
#include "harness/time/scheme.h"
#include "harness/time/stages.h"

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

/* radau_rates.c */
/* Nodes, weights and B of the scheme. */
void radau_coefficients(radau *);
/* Of the instant of a stage [s]: the last one is at the end of the step as it was asked for. */
double radau_time(const radau *, const instant *from, double h, int stage, const step_record *);
/* v and a of all stages, from their increments. */
void radau_rates(radau *, const instant *from, double h);
/* What the rates (rate) and accelerations of stage i gain by spatial increments of a vertex in
 * stage k: scalars of translations, [3 x 3] of its rotation, in the axes of its rates. */
typedef struct radau_relation {
    double rate, acceleration, turn_rate[9], turn_acceleration[9];
} radau_relation;
void radau_relate(const radau *, int vertex, double h, int i, int k, radau_relation *);

/* out = R B, R of a vertex in stage i. */
void radau_in_space(const radau *, int vertex, int i, const double B[9], double out[9]);

/* radau_equations.c */
/* The residual of all stages in their present states, and fresh 1: S. */
status radau_equations(radau *, int fresh, const instant *from, double h, step_record *, fault *);

/* radau_spread.c: S gains what masses take that elements spread. */
void radau_spread(radau *, double h);

/* radau_damping.c: residual and, fresh 1, S gain what damped members take. */
void radau_damp(radau *, int fresh, const instant *from, double h);
/* What they lose in a step that was solved [J]; room[elements x strains]. */
double radau_dissipated(const radau *, const instant *from, double h, double room[]);
/* Their part in radau_error: the model's stresses, with rates of strains -sum e_i (strains
 * gained)/h and tangent g, until damping_follow says otherwise. room likewise, as long. */
void radau_damp_error(const radau *, const instant *from, double h, const double e[STAGES],
                      double g, double room[]);

/* radau_error.c: what a step that was solved adds to the error of positions, in the measure of
 * model.h. [g^2 M + K] error = F(x, v) + M (sum e_i (v_i - v)/h + g (v + sum e_i inc_i/h)), with
 * g = 1/(l h), l the real eigenvalue of A, about the instant before. room: work space. */
status radau_error(radau *, const instant *from, double h, instant *room, double *error, fault *);

#endif
