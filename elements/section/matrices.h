/* Sections by their matrices: with the strains of the Simo-Reissner beam along the member's line,
 *   (N, Qy, Qz, Mx, My, Mz) = C (gx, gy, gz, kx, ky, kz),
 * and with the velocity of the line and the angular velocity in the section's axes v = (vx, vy, vz,
 * wx, wy, wz) the kinetic energy 1/2 v . M v per length (Hodges, Nonlinear Composite Beam Theory,
 * 2006, chapters 4 and 5).  Row-major.
 *
 * What else a section has follows for the orders of size and for formulations that know constants
 * only: with E = G = 1 Pa, A = C_11, Iy = C_55, Iz = C_66, It = C_44, shear rigidities C_22 and
 * C_33; nothing warps, the centroid is on the line. */
#ifndef BEAMWORK_SECTION_MATRICES_H
#define BEAMWORK_SECTION_MATRICES_H

#include "elements/section/section.h"

/* Largest asymmetry of matrices that were measured or printed, in parts of the diagonal. */
#define SECTION_MATRICES_SYMMETRIC 1e-6

/* Fills a zeroed section.  REFUSED: C not symmetric or not positive definite; M not that of a
 * slice: mass m, centre (0, cy, cz), a moment of inertia about the centre that is not negative, M =
 * [m 1, -m c~; m c~, J]. What is symmetric, or a slice, within SECTION_MATRICES_SYMMETRIC becomes
 * so. */
status section_matrices(const section_spec *spec, section *out, fault *f);

/* Is there more in the matrices than constants have?  Anything off the diagonal of C; where inertia
 * matters, anything off that of M, and moments of inertia J other than those of a section of one
 * material, where they are asked for, or other than Jxx. */
int section_matrices_couple(const section *c, int inertia, int rotary);

/* Centre of mass [m]; (0, 0, 0) without mass. */
void section_matrices_centre(const section *c, double centre[3]);

#endif
