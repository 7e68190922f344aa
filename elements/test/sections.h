/* Sections of tests. */
#ifndef BEAMWORK_TEST_SECTIONS_H
#define BEAMWORK_TEST_SECTIONS_H

#include "elements/section/section.h"

/* Constants of a section that is accepted; else the test fails and they are zero. */
section sections_computed(const section_spec *);
/* Of this kind, with the moduli of steel, E = 200 GPa and G = 80 GPa. */
section_spec sections_steel(section_kind);
/* Constants as they are given [m^2, m^4], with E = G = 1 Pa and Ip = Iy + Iz; it does not warp. */
section_spec sections_of(double A, double Iy, double Iz, double It);

#endif
