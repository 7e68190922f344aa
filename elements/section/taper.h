/* Sections that change along a member: from one description to another of the same form, linearly
 * in its numbers.
 *
 * Every cross-section is that of a prismatic member with the section there, its centroid on the
 * member's line: the shear stresses due to the taper itself are omitted, as usual in beam
 * theory. */
#ifndef BEAMWORK_SECTION_TAPER_H
#define BEAMWORK_SECTION_TAPER_H

#include "elements/section/section.h"

/* May one description change into the other?  REFUSED: another form (rectangle, walls that hang
 * together in another way, D in one and F in the other ...), and, where the section warps, a shear
 * centre that moves, walls that do not stay in their planes, closed cells that are not the same:
 * the sectorial coordinate of a fibre would change along the member, which couples its warping with
 * torsion in a way that no prismatic piece has. ends: what the two come to. */
status section_taper_check(const section_spec *p, const section_spec *q,
                           const section *const ends[2], fault *f);

/* The description at x in [0, 1] from p to q. */
void section_taper_at(const section_spec *p, const section_spec *q, double x, section_spec *out);

#endif
