/* Strains of the Simo-Reissner beam at points of an element whose nodes' quaternions are
 * interpolated (point.h): e[6 g ..]     = l0 (gamma_x, gamma_y, gamma_z), gamma = R^T r' - e_x, and
 * l0^2 (kappa_x, kappa_y, kappa_z), at point g, e[6 points ..] = l0^2 a of every node, all in [m],
 * less their values in the undeformed (curved) state. */
#ifndef BEAMWORK_EXACT_STRAIN_H
#define BEAMWORK_EXACT_STRAIN_H

#include "elements/element.h"
#include "elements/geometrically_exact/measure.h"

enum { EXACT_STRAIN_MAX_POINTS = 2 };

typedef struct exact_strain_line {
    int nodes, points;
    double l0; /* [m] */
    exact_measure_kind rotation;
    double N[EXACT_STRAIN_MAX_POINTS][ELEMENT_MAX_NODES],
        dN[EXACT_STRAIN_MAX_POINTS][ELEMENT_MAX_NODES]; /* dN: per l0 */
    double initial[EXACT_STRAIN_MAX_POINTS]
                  [3]; /* what R^T r' is more than `rest` where the element is free of stress */
    double rest[EXACT_STRAIN_MAX_POINTS][6]; /* R^T r' and l0 kappa undeformed, dimensionless */
} exact_strain_line;

/* Gauss points between evenly spaced nodes; initial curvature [1/m] and strain, constant: what the
 * nodes of the stress-free element show at the points is no strain, whatever the arc. */
void exact_strain_prepare(int nodes, int points, double l0, const double curvature[3],
                          const double strain[3], exact_measure_kind rotation,
                          exact_strain_line *line);

#endif
