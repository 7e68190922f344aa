/* Runs a scene's analyses on a model and extracts its quantities. The only door from harness/run to harness/solve. */
#ifndef BEAMWORK_SOLVE_H
#define BEAMWORK_SOLVE_H

#include "harness/solve/shapes.h"

/* The mixed Newton condensed element by element; for comparison, in displacements only, and uncondensed with dense elimination. */
typedef enum solve_newton { SOLVE_MIXED, SOLVE_DISPLACEMENT, SOLVE_DENSE, SOLVE_NEWTONS } solve_newton;

typedef struct solve_options {
    solve_newton newton;
    double criterion;   /* relative size of the corrections; 0: default */
    int max_iterations; /* per step; 0: default */
    int steps_between;  /* overrides the scene's; 0: the scene's */
    int shapes;         /* most states of every path whose centre lines are kept; 0: no shapes */
} solve_options;

typedef struct curve {
    int points;
    double *x, *value;
} curve;

typedef struct quantity_result {
    status status;           /* OK: value is a number */
    double value;            /* NAN where it does not exist */
    double x;                /* abscissa where a maximum or minimum was found */
    curve curve;             /* of SCENE_CURVE, else 0 points */
    char reason[FAULT_TEXT]; /* why there is no value */
} quantity_result;

typedef struct step_record {
    double path, increment;
    int iterations, rejected, negative_pivots;
    double residual, correction, incompatibility;
} step_record;

typedef struct solve_result {
    status status;
    char reason[FAULT_TEXT];
    int quantities;
    quantity_result *quantity; /* [scene quantities], same order */
    int steps;
    step_record *step;
    double seconds_setup, seconds_solve; /* analysis of the pattern | the rest */
    shapes shapes;
} solve_result;

/* Fills result even on failure (quantities that could be found stay). */
status solve_scene(const scene *, model *, const solve_options *, solve_result *, fault *);
void solve_result_free(solve_result *);

#endif
