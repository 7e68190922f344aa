/* Matrices of small motions about what has been solved. */
#ifndef BEAMWORK_COLLECT_SYSTEMS_H
#define BEAMWORK_COLLECT_SYSTEMS_H

#include "harness/newton/newton.h"

/* About the undeformed structure, every station of every path that was reached, and the loaded
 * states of modal analyses: the matrices that those are made with. */
status collect_systems(const analysis_context *, system_matrices *, fault *);

#endif
