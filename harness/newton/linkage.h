/* Members as rigid parts of a linkage, where their ends are released. */
#ifndef BEAMWORK_LINKAGE_H
#define BEAMWORK_LINKAGE_H

#include "harness/model/model.h"

/* 1: held as it is, the undeformed structure moves without deformation where ends of members are
 * released: the node that moves most, or -1 and a member between nodes that stay, and its motion
 * (displacement [m], turn [rad], of any size). Not looked for among more than 200 parts. */
int linkage_mechanism(const model *, int *node, int *member, double motion[6]);

#endif
