/* What the energy of an element with strains at Gauss points depends on, and the elimination of what the nodes do not show
 * (stiffness.h says why).  Dimensionless (constants.h). */
#ifndef BEAMWORK_EXACT_FIELDS_H
#define BEAMWORK_EXACT_FIELDS_H

#include "elements/exact/constants.h"
#include "elements/exact/stiffness.h"

enum {
    FIELDS_MAX_BUBBLES = STRAIN_MAX_POINTS, /* of the warping amplitude */
    FIELDS_STRESSES = 5,                    /* Q_y, Q_z, M_w, M_y, M_z of a point */
    FIELDS_MAX_FREE = STIFFNESS_MAX_STRAINS + FIELDS_MAX_BUBBLES,
    FIELDS_MAX_ALL = FIELDS_MAX_FREE + FIELDS_STRESSES * STRAIN_MAX_POINTS
};

/* Before elimination: strains, bubbles, stresses. */
typedef struct fields {
    int nodes, points, strains, warping_bubbles, free, all, field;
    double x[STRAIN_MAX_POINTS], w[STRAIN_MAX_POINTS]; /* points of the strains */
    double at[STIFFNESS_MAX_FIELD],
        weight[STIFFNESS_MAX_FIELD]; /* points that integrate the fourth power of the twist rate */
    double through[STIFFNESS_MAX_FIELD][STRAIN_MAX_POINTS]; /* Lagrange polynomials on x, at `at` */
    double twist[STIFFNESS_MAX_FIELD][FIELDS_MAX_FREE];     /* kappa_x */
    double slope[STIFFNESS_MAX_FIELD][FIELDS_MAX_FREE];     /* a' */
    double mean[STRAIN_MAX_POINTS][FIELDS_MAX_FREE];        /* P a at the points */
    double energy[FIELDS_MAX_ALL * FIELDS_MAX_ALL];         /* 2 x the quadratic form */
} fields;

void fields_prepare(const constants *c, int nodes, fields *f);

/* Bubbles and stresses as they follow from the strains: X[all - strains][strains]; 0, or the failing pivot. */
int fields_eliminate(const fields *f, double X[]);

#endif
