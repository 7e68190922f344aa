/* Whether the supports hold all parts of a structure. Rigid motions of a part are six numbers:
 * displacement of an origin, turn times the size of the model; what prevents them squares, of
 * lengths. */
#ifndef BEAMWORK_MODEL_SUPPORTS_H
#define BEAMWORK_MODEL_SUPPORTS_H

#include "harness/model/model.h"

/* 1: the supports leave a part of the undeformed structure loose: a node of it, and a rigid motion
 * (displacement of that node [m], turn [rad], of any size) that they allow. Coordinates that are
 * driven are held. */
int supports_loose_part(const model *, int *node, double motion[6]);

/* Least eigenvalue of the supports' squares beside the largest: held points closer to each other
 * than its root times the length count as one. */
extern const double supports_loose;

/* part[vertices]: a vertex that stands for all that elements, springs and bodies join, by
 * supports_root; apart: released ends are not joined to their nodes. */
void supports_join(const model *, int apart, int part[]);
int supports_root(const int part[], int vertex);
/* What moves a vertex. */
int supports_mover(const model *, int vertex, int apart);
/* G[6 x 6]: motion (m, rad) at a position from the origin. */
void supports_rigid(const double position[3], double length, double G[36]);
/* What the supports of a node prevent of the motions about the origin: out[6 x 6]. */
void supports_prevented(const model *, int node, const double origin[3], double out[36]);
/* sum[6 x 6] += squares of what springs between the part and the ground prevent, whatever their
 * stiffness. */
void supports_add_springs(const model *, const int part[], int root, const double origin[3],
                          double sum[36]);

#endif
