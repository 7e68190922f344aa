/* Deformation functions of N's elements: eight generalized strains, quadratic in the local
 * coordinates, e_i = (Lambda q)_i + 1/2 q^T Q_i q (N Eq. 37), less those of the element free of
 * stress: its nodes along an arc of constant torsion and curvature, initial elongation and shear
 * included.  (The linear initial stresses of N Eq. 52 are not free of stress there:
 * reference/ERRATA.md.) */
#ifndef BEAMWORK_SHEET_STRAINS_H
#define BEAMWORK_SHEET_STRAINS_H

#include "elements/sheet/local.h"

enum {
    SHEET_STRAINS = 8,
    SHEET_STRAINS_LISTED = 6,
    SHEET_STRAINS_TERMS = SHEET_STRAINS_LISTED * 36
};

typedef struct sheet_strains_table {
    double chord;   /* of the undeformed arc [m] */
    double torsion; /* initial: amplitudes of the nodes are twist rates beyond it [rad/m] */
    double rest[SHEET_STRAINS]; /* of the element free of stress, which the strains are less [m] */
    double Lambda[SHEET_STRAINS * SHEET_LOCAL_COORDINATES]; /* [m per coordinate] */
    int terms; /* Q_i jk and Q_i kj, j <= k, that are not zero; Q_7 = Q_8 = Q_2 are not listed */
    struct {
        double c;
        int i, j, k;
    } term[SHEET_STRAINS_TERMS];
} sheet_strains_table;

/* Phi_y, Phi_z: shear parameters of the displacement fields (N Eq. 18); both 0: N Eq. 37, where
 * shear is omitted; the section's own: consistent with shear (derived here). Features: warping,
 * trapeze. */
status sheet_strains_prepare(const element_request *request, double Phi_y, double Phi_z,
                             sheet_strains_table *out, fault *f);

/* Counts the strains from the element free of stress. */
void sheet_strains_set_rest(const element_request *request, sheet_strains_table *out);

/* As element_type.strain. */
void sheet_strains_evaluate(const sheet_strains_table *table, const node_state x[2],
                            strain_output *out);

#endif
