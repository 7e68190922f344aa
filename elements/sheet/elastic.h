/* Stiffness of the linear solution (N Eqs. 33-36). */
#ifndef BEAMWORK_SHEET_ELASTIC_H
#define BEAMWORK_SHEET_ELASTIC_H

#include "elements/sheet/strains.h"

/* Shear parameters Phi_y, Phi_z of N Eq. 18; 0 for a section that is rigid in shear. */
double sheet_elastic_phi_y(const section *c, double l0);
double sheet_elastic_phi_z(const section *c, double l0);

/* S[8 x 8] [N/m]. */
void sheet_elastic_stiffness(const section *c, double l0, double Phi_y, double Phi_z,
                             double S[SHEET_STRAINS * SHEET_STRAINS]);

#endif
