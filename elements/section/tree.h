/* How the walls of a section hang together: a spanning tree of their mid-lines, and the walls that
 * close cells.
 *
 * A flow that is constant around each cell and zero elsewhere is what equilibrium leaves open;
 * compatibility of the warping, oint flow/t ds = given, decides it (Bredt 1896; Vlasov, Thin-walled
 * elastic beams, 1961, chapter 4). */
#ifndef BEAMWORK_SECTION_TREE_H
#define BEAMWORK_SECTION_TREE_H

#include "elements/section/section.h"

/* Root: point 0.  The first walls - cells entries are the tree, from the root outwards; each entry
 * behind closes a cell. */
typedef struct section_tree {
    int wall[SECTION_MAX_WALLS]; /* wall of an entry */
    int near[SECTION_MAX_WALLS],
        far[SECTION_MAX_WALLS]; /* its point nearer the root, and the other */
    int cells;
    /* [cell][wall]: 1 where the cell runs through the wall from `from` to `to`, -1 against it, 0
     * not at all */
    signed char round[SECTION_MAX_WALLS][SECTION_MAX_WALLS];
} section_tree;

/* REFUSED: a wall that closes more cells than the section has, fewer cells, disconnected walls, an
 * unused point. */
status tree_grow(const section_spec *s, section_tree *t, fault *f);

/* flow[walls], from `from` to `to`: constant around each cell, with oint flow/t ds = oint d(jump)
 * where jump[walls] is what the wall contributes.  All zero in an open section. */
void tree_flow(const section_spec *s, const section_tree *t, const double jump[], double flow[]);

double tree_wall_length(const section_spec *s, int w); /* [m] */

#endif
