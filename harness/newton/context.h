/* What an analysis works with. */
#ifndef BEAMWORK_CONTEXT_H
#define BEAMWORK_CONTEXT_H

#include "harness/newton/condensation.h"
#include "harness/newton/outcome.h"
#include "harness/newton/result.h"
#include "harness/newton/run_state.h"

/* What a solution keeps from one analysis for the next ones. */
typedef struct context_work {
    double setup;        /* [s] spent on patterns and symbolic factorisation */
    int singular;        /* 1: the last factorisation failed */
    matrix_factor *left; /* of the pattern of the free coordinates, whose numbers nobody needs any
                     more; NULL: none */
} context_work;

typedef struct analysis_context {
    const scene *scene;
    const model *model;
    run_state *run; /* of that model */
    equations eq;   /* of that model, under the loading of the analysis: context_of */
    const solve_options *options;
    solve_result *result;       /* step records go here */
    analysis_outcome *outcomes; /* [analyses], those before the present one are complete */
    context_work *work;
} analysis_context;

/* Is the analysis asked for, by what is read from it or by the options? */
int context_runs(const analysis_context *, int analysis);
/* That of an analysis, with its loading; loads without a function of time stay in a motion as in
 * the state that it starts from. */
analysis_context context_of(const analysis_context *, int analysis);
/* The same where no load acts and no driver moves: what stays are strains that members have by
 * themselves. */
analysis_context context_unloaded(const analysis_context *);
/* The numeric factors of K, and into the context whether they exist. */
status context_factor(analysis_context *, matrix_factor *, const sparse *K, fault *);
/* What condenses members of many elements; *out NULL: none is, or the condition of the tangent was
 * asked for, which is that of all coordinates. See condensation_alloc. */
status context_condensation(const analysis_context *, int count, const int released[],
                            condensation **out, fault *);
/* The same of a tangent whose members are condensed. */
status context_factor_condensed(analysis_context *, condensation *, fault *);
/* REFUSED where what was factored is not symmetric: `what` (critical loads) need that of the state.
 */
status context_symmetric(const matrix_factor *, const char *what, fault *f);
/* A symmetric factor of the pattern of the free coordinates is not needed any more: it is kept
 * where a compliance may ask for one, so that order and pattern need not be found again. */
void context_leave_factor(analysis_context *, matrix_factor *);
/* NULL: none was left. */
matrix_factor *context_take_factor(analysis_context *);
/* When it was asked for: the condition of a matrix just factored, into the counters. */
void context_count_condition(const analysis_context *, matrix_factor *, const sparse *K);
/* The work of a solution with a factor, into the counters; fresh 0: its numbers are those of a
 * solution before. *counted: factorisations of it that are there already, and then are all. */
void context_count_solution(const analysis_context *, const matrix_factor *, int fresh,
                            long *counted);
/* The work of an eigenvalue problem, into the counters. */
void context_count_eigen(const analysis_context *, const eigen_result *);

#endif
