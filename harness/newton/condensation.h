/* Members condensed to their ends before the tangent is solved, and back.
 *
 * Where members have many elements the assembled tangent loses digits with the fourth power of
 * their number, as flexibilities of members (chain.h) do not; and the system that is left is as
 * small as with one element per member. */
#ifndef BEAMWORK_CONDENSATION_H
#define BEAMWORK_CONDENSATION_H

#include "harness/newton/run_state.h"
#include "harness/numerics/numerics.h"

typedef struct condensation condensation;

/* Elements of a member from which on it pays: before, the assembled tangent costs less and has
 * digits enough. */
enum { CONDENSATION_ELEMENTS = 1000 };

/* *out NULL: members have fewer elements than `from`, or something acts between their ends that has
 * a stiffness, or frames turn. released[count]: driven coordinates that are unknown too. */
status condensation_alloc(const equations *, int from, int count, const int released[],
                          condensation **out, fault *);
/* The members of `of`, which must outlive it, with other released coordinates: condensation_take.
 */
status condensation_alloc_like(const condensation *of, int count, const int released[],
                               condensation **out, fault *);
void condensation_free(condensation *);

/* The tangent of the last linearise_state with these arguments, in parts: members are condensed. */
status condensation_at(condensation *, const model_state *, double path, fault *);
/* The tangent that `of`, whose members these are, has in the state. */
void condensation_take(condensation *, const condensation *of, const model_state *);
/* On all coordinates, to be altered before it is factored; entries between ends only. */
sparse *condensation_ends(condensation *);
/* SINGULAR as factor_numeric, or where a member has a critical state of its own. */
status condensation_factor(condensation *, fault *);
/* x[free + driven] := K^-1 x on the unknowns; transposed: K^-T. */
void condensation_solve(condensation *, int transposed, double x[]);
factor_counts condensation_count(const condensation *);
/* A factor that solves by it and owns it. */
status condensation_as_factor(condensation *, matrix_factor **, fault *);

#endif
