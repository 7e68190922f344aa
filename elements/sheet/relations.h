/* Deformation functions of N's elements: eight generalized strains, quadratic in the local coordinates, by integrating the
 * compatibility relations with the linear fields (N Eqs. 13-20, 37). */
#ifndef BEAMWORK_SHEET_RELATIONS_H
#define BEAMWORK_SHEET_RELATIONS_H

#include "elements/beamw/forms.h"
#include "elements/sheet/local.h"

enum { RELATIONS_STRAINS = 8 };

enum { RELATIONS_MAX_TERMS = 96 };

/* Second derivative of y_row with respect to x_a and x_b (a <= b). */
typedef struct relations_term {
    int row, a, b;
    double value;
} relations_term;

/* y_k = linear_k x_k + sum of the terms value x_a x_b (half of it where a = b): few of the 8 x 36 are not zero. */
typedef struct relations_map {
    double linear[RELATIONS_STRAINS];
    int terms;
    relations_term term[RELATIONS_MAX_TERMS];
} relations_map;

typedef struct relations {
    double length;
    relations_map map; /* from the local coordinates, in the order of the strains, to the strains */
} relations;

/* Adds the terms of a symmetric matrix of second derivatives that are not rounding errors of the largest. */
void relations_add_terms(relations_map *map, int row, const double Q[RELATIONS_STRAINS * RELATIONS_STRAINS]);
/* y and, where wanted, dy/dx[8 x 8]. */
void relations_apply(const relations_map *map, const double x[RELATIONS_STRAINS], double y[RELATIONS_STRAINS],
                     double dy[RELATIONS_STRAINS][RELATIONS_STRAINS]);
/* H[8 x 8] += sum_k w_k d2y_k/dx2. */
void relations_add_second(const relations_map *map, const double w[RELATIONS_STRAINS],
                          double H[RELATIONS_STRAINS * RELATIONS_STRAINS]);

/* Fields along the element as linear functionals of the local coordinates, at s = length x: (phi_x, phi_x', phi_x'', u_y, u_y', u_y'', u_z, u_z', u_z''). */
enum { FIELD_PX, FIELD_PX1, FIELD_PX2, FIELD_UY, FIELD_UY1, FIELD_UY2, FIELD_UZ, FIELD_UZ1, FIELD_UZ2, FIELD_COUNT };
void relations_fields(double length, double Phi_y, double Phi_z, int warping, double x, double field[FIELD_COUNT][LOCALS]);

/* Phi 0: N Eq. 37, where shear is left out; the section's own: consistent with shear (reference/ERRATA.md, N 37). */
status relations_prepare(const element_request *request, double Phi_y, double Phi_z, relations *out, fault *f);
void relations_strain(const relations *r, const node_state x[2], strain_output *out);

/* 12 E I/(k G A l^2) in the two directions; 0 where the section is rigid or shear is not asked for. */
void relations_shear(const element_request *request, double *Phi_y, double *Phi_z);

#endif
