/* Which ends of members hold their warping, in words. */
#ifndef BEAMWORK_WARPING_ENDS_H
#define BEAMWORK_WARPING_ENDS_H

#include <stddef.h>

#include "cases/scene/scene.h"

/* Of members whose section warps: "held at base_a, base_b; shared at fold; free at tip", by nodes,
 * or "leaf at base" where ends at one node differ.  Of many the first ones are named.  "" where
 * nothing warps. */
void warping_ends(const scene *s, char *text, size_t room);
/* The same of those that the other scene, of the same members, leaves free. */
void warping_ends_freed(const scene *s, const scene *other, char *text, size_t room);

#endif
