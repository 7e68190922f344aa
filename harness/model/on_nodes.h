/* What of loads and mass along members is put on nodes by convention, in words. */
#ifndef BEAMWORK_ON_NODES_H
#define BEAMWORK_ON_NODES_H

#include <stddef.h>

#include "cases/scene/scene.h"
#include "elements/element.h"

/* Of loads that ask for it, of masses that a motion or the scene lumps or a formulation has there,
 * and of what goes to the nodes with them: with the order in space that this has.  Of many the
 * first ones are named.  "" where nothing is.
 */
void on_nodes(const scene *s, const element_type *type, const double options[], char *text,
              size_t room);

#endif
