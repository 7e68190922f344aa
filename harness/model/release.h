/* Ends of members that keep turns and shifts to themselves (scene_release).
 *
 * Such an end has a vertex of its own behind all others, in the list `release`.  With the frame r,
 * R of its node's body, the node at the offset rho from it, and the member's undeformed axes a, d
 * at the end, R_end = R exp(a_1 t_1) exp(a_2 t_2),  r_end = r + R rho + R_end (sum d_i s_i). Three
 * turns have no order: R_end is free, its increments are spatial ones.  The end's coordinates t, s
 * stand behind those of the element's nodes; forces and matrices of the element are taken to all of
 * them by the chain rule with the second derivatives of the frame (turns: 1/2 b_i x b_j for i
 * before j, those of the body before all; shifts: turns of the end before them). */
#ifndef BEAMWORK_MODEL_RELEASE_H
#define BEAMWORK_MODEL_RELEASE_H

#include "harness/model/mesh.h"

/* Ends of all members that keep something. */
int release_count(const scene *);
/* Their vertices, when the elements are made. */
status release_build(model *, fault *);

/* The end at this vertex; NULL: it is none. */
static inline const mesh_release *release_of(const model *m, int vertex)
{
    const int first = model_first_release(m);
    return vertex < first ? NULL : &model_mesh_of(m)->release[vertex - first];
}

/* The end's motion d[6] += what its own coordinates, by dx, add to that of its node. */
void release_add_local(const model *, const model_state *, int vertex, const double dx[],
                       double d[6]);
/* T[6 x count] of its node's place and turn becomes that of the end, with its own columns from
 * `own` on. */
void release_jacobian(const model *, const model_state *, int vertex, int count, int own,
                      double T[]);
/* Own coordinates move by dx; returns the largest change [1, rad]. */
double release_advance(const model *, model_state *, int vertex, const double dx[]);
/* Place and orientation behind those of all nodes. */
void release_follow(const model *, model_state *);

/* Spatial axes of the turns [turns x 3]; of three: the fixed ones. */
void release_turn_axes(const model *, const model_state *, int vertex, double b[3][3]);
/* Spatial directions of the shifts [slides x 3], and how far the end is from its node [m]. */
void release_slide_axes(const model *, const model_state *, int vertex, double along[3][3],
                        double apart[3]);

/* force[7 at, its six]: of the end's frame becomes that of its node's place; own[]: of its
 * coordinates. */
void release_force(const model *, const model_state *, int vertex, double force[6], double own[]);
/* Room for the columns of ends behind those of the nodes: K[7 nodes x 7 nodes] -> K[columns x
 * columns]. */
void release_widen(const mesh_element *, double K[]);
/* The same of K, whose six coordinates of the end begin at `at`, its own ones at `own`. force[6] as
 * in release_force, which it follows; NULL: no second derivatives. */
void release_matrix(const model *, const model_state *, int vertex, int n, int at, int own,
                    double force[6], double K[]);

#endif
