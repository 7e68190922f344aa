/* States of a model and the motion of its nodes in them. */
#ifndef BEAMWORK_MODEL_KINEMATICS_H
#define BEAMWORK_MODEL_KINEMATICS_H

#include "harness/model/mesh.h"

status kinematics_state_alloc(const model *, model_state **, fault *); /* undeformed, path = 0 */
/* What kinematics_component and kinematics_driver_value read of a state, and its path: nothing else
 * may be asked of it. */
status kinematics_nodes_alloc(const model *, const model_state *from, model_state **, fault *);
void kinematics_state_free(model_state *);
const model_state *kinematics_rest(const model *); /* undeformed */
void kinematics_state_copy(const model *, const model_state *from, model_state *to);
double kinematics_state_path(const model_state *);
const double *kinematics_strains(const model_state *); /* [elements x strains] */

/* Frame of a scene node in a state: position [m] and unit quaternion. For tests of other rooms,
 * which need not know what a state keeps (state.h). */
void kinematics_frame(const model *, const model_state *, int node, double r[3], double q[4]);
/* Displacement [m] or rotation-vector component [rad] of a scene node since the undeformed state,
 * of as many turns as the path has made; not a number: the vector has lost its direction on a full
 * turn (turns.h). */
double kinematics_component(const model *, const model_state *, int node, int component);
/* The same of a node in the axes of another, `from`: how its place has moved there [m], or the
 * rotation vector of its turn against that [rad]. */
double kinematics_relative(const model *, const model_state *, int from, int node, int component);
double kinematics_driver_value(const model *, const model_state *, int driver);
/* Largest angle [rad] that an element's nodes have turned against each other, chords: or against
 * its chord, and that element. Less than two turns are told apart. */
double kinematics_largest_turn(const model *, const model_state *, int chords, int *element_index);
/* Likewise, about the element's axis. */
double kinematics_largest_twist(const model *, const model_state *, int *element_index);
/* Rise of the arc of an element at rest, by its curvature about z, in radii of gyration. */
double kinematics_largest_rise(const model *, int *element_index);

/* Coordinate index of a component of a node, or -1 where it is held, or dependent. */
int kinematics_coordinate(const model *, int node, int component);
/* Most coordinates that a vertex depends on: those of a body, and those of a released end. */
enum { KINEMATICS_MOST = 6 + SCENE_RELEASED };
/* Jacobian of the six spatial increments of a vertex with respect to the coordinates it depends on:
 * returns the count m <= size (6 of a node), fills index[m] and T[6 x m] (row-major, leading
 * dimension m). */
int kinematics_node_jacobian(const model *, const model_state *, int node, int size, int index[],
                             double T[]);
/* Current offset of a vertex from its body [m]. */
void kinematics_offset(const model *, const model_state *, int vertex, double rho[3]);

/* Of an element in a state, as its type takes it: x[nodes]. */
void kinematics_gather(const model *m, const model_state *s, const mesh_element *el,
                       node_state x[]);
void kinematics_position(const model *m, const model_state *s, int vertex, double r[3]);
/* Spatial axes of a sequence's angles in the present state: b[angles][3]. */
void kinematics_axes(const model *m, const model_state *s, int vertex, double b[3][3]);
/* Recomputes what depends on bodies' coordinates. */
void kinematics_follow(const model *m, model_state *s);
/* Increments of an element's own coordinates from those of the model: local[7 nodes]. */
void kinematics_local(const model *m, const model_state *s, const mesh_element *el,
                      const double dx[], double local[]);

#endif
