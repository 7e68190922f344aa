/* Energy, forces and stiffness that a type gives of an element, alone or of many states together.
 */
#ifndef BEAMWORK_FORCES_H
#define BEAMWORK_FORCES_H

#include "elements/element.h"
#include "harness/formulations/gather.h"

/* Of the type itself; with `together`, of the answers gathered there, and zero while states are. */
status forces_of(const element_data *d, gather *together, const node_state x[], force_output *out);
/* Doubles of a gathered answer. */
size_t forces_size(const element_data *d);
/* Fills the answers of states first .. first + count - 1 with all that the type gives; it has
 * force_many. */
void forces_evaluate(const element_type *given, gather *, int first, int count);

#endif
