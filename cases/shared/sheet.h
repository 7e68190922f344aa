/* The clamped sheet flexure that several scenes share (N section 4.1): along x, its width along z, its thickness along y. */
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

/* clang-format off */
#define SHEET_TABLE(default_wagner) \
    [SHEET_LENGTH] = {"length", "m", 0.1, 1e-9, 1e6, NULL, "length of the sheet"}, \
    [SHEET_WIDTH] = {"width", "m", 0.1, 1e-9, 1e6, NULL, "width, along z"}, \
    [SHEET_THICKNESS] = {"thickness", "m", 0.00225, 1e-12, 1e5, NULL, "thickness, along y"}, \
    [SHEET_YOUNG] = {"young", "Pa", 200e9, 1e-3, 1e15, NULL, "modulus of elasticity"}, \
    [SHEET_POISSON] = {"poisson", "1", 0.3, -0.99, 0.49, NULL, "Poisson's ratio"}, \
    [SHEET_DEFLECTION] = {"tip_deflection", "m", 0.015, -1e6, 1e6, NULL, \
        "prescribed tip displacement along y"}, \
    [SHEET_TIP_WARPING] = {"tip_warping", "1", 0, 0, 1, NULL, \
        "warping at the tip: 0 fixed, 1 free"}, \
    [SHEET_WARPING] = {"warping", "1", 1, 0, 1, NULL, \
        "1: restrained warping, 0: uniform torsion"}, \
    [SHEET_SHEAR] = {"shear", "1", 1, 0, 1, NULL, "1: flexible in shear, 0: shear-rigid"}, \
    [SHEET_TRAPEZE] = {"trapeze", "1", 1, 0, 1, NULL, \
        "1: shortening of a twisted sheet (N Eq. 8)"}, \
    [SHEET_WAGNER] = {"wagner", "1", default_wagner, 0, 1, NULL, "1: Wagner torque (N Eq. 46)"}, \
    [SHEET_SHEAR_FACTOR] = {"shear_factor", "1", 0, 0, 10, NULL, \
        "k of the shear stiffness; 0: 10 (1 + nu)/(12 + 11 nu)"}, \
    [SHEET_MOMENTS] = {"moment_convention", "", SCENE_MOMENTS_SPATIAL, 0, 0, \
        SCENE_MOMENTS_CHOICES, "moments on the tip while it turns, in C_*"}
/* clang-format on */

/* Steel-like sheet section; width along the member's local z. shear_factor 0: the formula. */
void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out);

/* Section, nodes, member with a clamped root, physics and meshes.  The tip is left free; root and tip are returned.
 * Refuses a tip deflection that the length cannot reach. */
status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f);

/* Compliance at the tip along a static path, prescribed motion replaced by its reactions: adds
 * the entries C_<response>_<load> whose row and column are listed, as values at the end of the path. */
void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count);

#endif
