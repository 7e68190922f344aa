/* Helicoidal strains, those of a beam with uniform strains: the screw displacement that takes node
 * p and its triad to node q, with the rotation vector psi and the translation U along the way, in
 * axes that turn on it, e1 = U_x - l0,  e2 = l0 psi_x,  e3, e4 = l0 psi_y/2 -+ U_z,  e5, e6 = l0
 * psi_z/2 +- U_y,  e7, e8 = l0^2 a. They are J Eq. 7 to first order and the same for p and q
 * exchanged.  Uniform strains of any size are measured exactly, U = l0 (e_x + gamma), psi = l0
 * kappa; J's sines of angles to the chord are not when sections shear. */
#ifndef BEAMWORK_BEAMW_HELICOIDAL_H
#define BEAMWORK_BEAMW_HELICOIDAL_H

#include "elements/beamw/variants.h"

/* As element_type.strain. */
void beamw_helicoidal_strain(const element_data *d, const node_state x[], strain_output *out);

#endif
