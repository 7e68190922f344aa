/* What a quantity of a scene is, in words made from the scene's own data. */
#ifndef BEAMWORK_MEANING_H
#define BEAMWORK_MEANING_H

#include <stddef.h>

#include "cases/scene/scene.h"

enum { MEANING_ROOM = 512 };

/* One line without a full stop: kind, component, node or member with its place, station, and
 * the analysis where another one would have the same line. Quantities of a scene that differ in
 * any of these have different lines. Nodes and members are
 * named as write_scene names them. The text is cut where it does not fit. */
void meaning_of_quantity(const scene *s, int quantity, char *text, size_t size);

#endif
