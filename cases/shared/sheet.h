/* The clamped sheet flexure that several scenes share (N section 4.1): along x, its width along z,
 * its thickness along y. */
#ifndef BEAMWORK_CASES_SHEET_H
#define BEAMWORK_CASES_SHEET_H

#include "cases/case.h"

/* The first parameters of every such case, in this order. */
enum {
    SHEET_LENGTH,
    SHEET_WIDTH,
    SHEET_THICKNESS,
    SHEET_YOUNG,
    SHEET_POISSON,
    SHEET_DEFLECTION,
    SHEET_TIP_WARPING,
    SHEET_WARPING,
    SHEET_SHEAR,
    SHEET_TRAPEZE,
    SHEET_WAGNER,
    SHEET_SHEAR_FACTOR,
    SHEET_MOMENTS,
    SHEET_PARAMETERS
};

/* Their entries. */
extern const parameter_type sheet_parameters[];

/* Steel-like sheet section; width along the member's local z. shear_factor 0: the formula. */
void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out);

/* Section, nodes, member with a clamped root, physics and meshes.  The tip is left free; root and
 * tip are returned. Refuses a tip deflection that the length cannot reach. */
status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f);

/* Compliance at the tip along a static path, prescribed motion replaced by its reactions: adds
 * the entries C_<response>_<load> whose row and column are listed, as values at the end of the
 * path. */
void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count);

#endif
