/* Deformation functions of N's elements: eight generalized strains, quadratic in the local coordinates, by integrating the
 * compatibility relations with the linear fields (N Eqs. 13-20, 37). */
#ifndef BEAMWORK_SHEET_RELATIONS_H
#define BEAMWORK_SHEET_RELATIONS_H

#include "elements/beamw/forms.h"
#include "elements/sheet/local.h"

enum { RELATIONS_STRAINS = 8 };

typedef struct relations {
    double length;
    double linear[RELATIONS_STRAINS]; /* e_k = linear_k x_k + x^T Q_k x/2, locals in the order of the strains */
    double Q[RELATIONS_STRAINS][LOCALS * LOCALS];
} relations;

/* Fields along the element as linear functionals of the local coordinates, at s = length x: (phi_x, phi_x', phi_x'', u_y, u_y', u_y'', u_z, u_z', u_z''). */
enum { FIELD_PX, FIELD_PX1, FIELD_PX2, FIELD_UY, FIELD_UY1, FIELD_UY2, FIELD_UZ, FIELD_UZ1, FIELD_UZ2, FIELD_COUNT };
void relations_fields(double length, double Phi_y, double Phi_z, int warping, double x, double field[FIELD_COUNT][LOCALS]);

/* Phi 0: N Eq. 37, where shear is left out; the section's own: consistent with shear (reference/ERRATA.md, N 37). */
status relations_prepare(const element_request *request, double Phi_y, double Phi_z, relations *out, fault *f);
void relations_strain(const relations *r, const node_state x[2], strain_output *out);

/* 12 E I/(k G A l^2) in the two directions; 0 where the section is rigid or shear is not asked for. */
void relations_shear(const element_request *request, double *Phi_y, double *Phi_z);

#endif
