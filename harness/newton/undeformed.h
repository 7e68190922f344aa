/* Derivatives of elements in the undeformed state, which never changes: evaluated once and kept in
 * the model. */
#ifndef BEAMWORK_UNDEFORMED_H
#define BEAMWORK_UNDEFORMED_H

#include "harness/newton/run_state.h"

/* de/dx [strains x 7 nodes], dsigma/de [strains x strains] and, of a member with initial strains,
 * the stresses [strains] of an element whose nodes do not move, to first order (NULL: none); until
 * the next one is asked for. */
typedef struct undeformed_element {
    const double *J, *C, *initial;
} undeformed_element;

/* In large models elements of one kind that follow each other with the same orientation, as far as
 * rounding of their places lets it be told, are one. FAULT: out of memory. */
status undeformed_of(const equations *, int element, undeformed_element *, fault *);
/* What no element has yet is evaluated for all together, where the formulation can, until
 * ahead_end. */
void undeformed_begin(const equations *);

#endif
