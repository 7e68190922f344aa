/* Variables of the energy of an element with strains at Gauss points, and the elimination of the
 * fields that the nodes do not show (reasons in stiffness.h).  Dimensionless (beam_constants.h). */
#ifndef BEAMWORK_EXACT_FIELDS_H
#define BEAMWORK_EXACT_FIELDS_H

#include "elements/geometrically_exact/stiffness.h"
#include "elements/shared/beam_constants.h"

enum {
    EXACT_FIELDS_MAX_BUBBLES = EXACT_STRAIN_MAX_POINTS, /* of the warping amplitude */
    EXACT_FIELDS_STRESSES = 5,                          /* Q_y, Q_z, M_w, M_y, M_z of a point */
    EXACT_FIELDS_MAX_FREE = EXACT_STIFFNESS_MAX_STRAINS + EXACT_FIELDS_MAX_BUBBLES,
    EXACT_FIELDS_MAX_ALL = EXACT_FIELDS_MAX_FREE + EXACT_FIELDS_STRESSES * EXACT_STRAIN_MAX_POINTS
};

/* Before elimination: strains, bubbles, stresses. */
typedef struct exact_fields {
    int nodes, points, strains, warping_bubbles, free, all, field;
    double x[EXACT_STRAIN_MAX_POINTS], w[EXACT_STRAIN_MAX_POINTS]; /* points of the strains */
    double at[EXACT_STIFFNESS_MAX_FIELD],
        weight[EXACT_STIFFNESS_MAX_FIELD]; /* points that integrate the fourth power of the twist
                                              rate */
    double through[EXACT_STIFFNESS_MAX_FIELD]
                  [EXACT_STRAIN_MAX_POINTS]; /* Lagrange polynomials on x, at `at` */
    double twist[EXACT_STIFFNESS_MAX_FIELD][EXACT_FIELDS_MAX_FREE]; /* kappa_x */
    double slope[EXACT_STIFFNESS_MAX_FIELD][EXACT_FIELDS_MAX_FREE]; /* a' */
    double mean[EXACT_STRAIN_MAX_POINTS][EXACT_FIELDS_MAX_FREE];    /* P a at the points */
    double energy[EXACT_FIELDS_MAX_ALL * EXACT_FIELDS_MAX_ALL];     /* 2 x the quadratic form */
} exact_fields;

void exact_fields_prepare(const beam_constants *c, int nodes, exact_fields *f);

/* Bubbles and stresses as they follow from the strains: X[all - strains][strains]; 0, or the
 * failing pivot. */
int exact_fields_eliminate(const exact_fields *f, double X[]);

#endif
