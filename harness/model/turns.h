/* Turns beyond half a circle: an orientation repeats itself, what has turned so does not. */
#ifndef BEAMWORK_MODEL_TURNS_H
#define BEAMWORK_MODEL_TURNS_H

#include "harness/model/model.h"

/* What is followed, in this order: the turns of the scene's nodes, of its springs (their ends
 * against each other), and of what quantities read of a node against another. */
status turns_build(model *, fault *);

/* The rotation vector [rad] of q that continues `before`: of all vectors of q, and of all
 * quaternions of its sign, the next one. On a full turn, where they have no direction of their own,
 * it keeps that of `before`. */
void turns_continue(const double q[4], const double before[3], double out[3]);

/* Why there is no number of a turn. */
extern const char turns_lost[];

/* Of a state whose orientations have changed; state.turn holds where they come from. */
void turns_follow(const model *, model_state *);
/* [3] in a state, not a number where it has lost its direction. */
const double *turns_of_node(const model_state *, int node);
const double *turns_of_spring(const model *, const model_state *, int spring);
/* NULL: no quantity reads it. */
const double *turns_between(const model *, const model_state *, int from, int node);

/* Of those between nodes, which quantities of one run read and not of another: how many, and each
 * as its nodes and its vector [5]. What is not among those that are taken has made less than half a
 * turn more than its nodes differ by. */
int turns_between_count(const model *);
void turns_put_between(const model *, const model_state *, double out[]);
void turns_take_between(const model *, int count, const double in[], model_state *);

/* Has a vector of more than half a turn swung aside? Beside a full turn it does in no time, and on
 * it what it has become is round-off. */
int turns_swung(const double from[3], const double to[3]);
/* Is it within `near` [rad] of one or more full turns? */
int turns_full(double size, double near);
/* Those that have lost their direction since `from` are no numbers from here on. */
void turns_lose(const model *, const model_state *from, model_state *);

#endif
