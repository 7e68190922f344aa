#include <math.h>
#include <string.h>

#include "elements/geometrically_exact/deformed.h"
#include "elements/geometrically_exact/exact.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"

void exact_measure_angle(double t, double m[3])
{
    if (t < 0.01) { /* series atan(y)/y = sum (-t)^k/(2 k + 1) */
        double power = 1;
        m[0] = m[1] = m[2] = 0;
        for (int k = 0; k < 10; k++) {
            m[0] += power / (2 * k + 1);
            m[1] -= power * (k + 1) / (2 * k + 3);
            m[2] += power * (k + 1) * (k + 2) / (2 * k + 5);
            power *= -t;
        }
        return;
    }
    m[0] = atan(sqrt(t)) / sqrt(t);
    m[1] = (1 / (1 + t) - m[0]) / (2 * t);
    m[2] = (-1 / ((1 + t) * (1 + t)) - 3 * m[1]) / (2 * t);
}

/* Computes R^T r' and the rotation measures at the points, for nodes on the stress-free arc. */
static void observe_rest(exact_strain_line *line, const double rotation_vector[3],
                         const double e[3], const double at[],
                         double rest[EXACT_STRAIN_MAX_POINTS][6])
{
    exact_deformed_nodes s;
    memset(s.u, 0, sizeof s.u);
    for (int k = 0; k < line->nodes; k++)
        arc_at(rotation_vector, e, at[k], s.r[k], s.q[k]);
    for (int g = 0; g < line->points; g++) {
        exact_point p;
        double y[3], dy[3], m[3], T[9];
        exact_deformed_observe(line->nodes, line, &s, g, &p, y, dy);
        memcpy(rest[g], p.v, sizeof p.v);
        memcpy(&rest[g][3], p.kappa, sizeof p.kappa);
        if (line->rotation == EXACT_MEASURE_QUARTER)
            continue;
        exact_measure_ratio(line->rotation, p.kappa, m);
        exact_measure_of(m, p.kappa, &rest[g][3], T);
    }
}

void exact_strain_prepare(int nodes_count, int points, double l0, const double curvature[3],
                          const double strain[3], exact_measure_kind rotation,
                          exact_strain_line *line)
{
    const double rotation_vector[3] = {curvature[0] * l0, curvature[1] * l0, curvature[2] * l0},
                 along[3] = {1, 0, 0};
    const double strained[3] = {1 + strain[0], strain[1], strain[2]};
    double x[EXACT_STRAIN_MAX_POINTS], w[EXACT_STRAIN_MAX_POINTS],
        at[EXACT_MAX_NODES] = {0}, without[EXACT_STRAIN_MAX_POINTS][6];
    memset(line, 0, sizeof *line);
    line->nodes = nodes_count;
    line->points = points;
    line->l0 = l0;
    line->rotation = rotation;
    quadrature_points(points, x, w);
    for (int k = 0; k < nodes_count; k++)
        at[k] = (double)k / (nodes_count - 1);
    for (int g = 0; g < points; g++)
        lagrange_at(nodes_count, at, x[g], line->N[g], line->dN[g]);
    observe_rest(line, rotation_vector, along, at, line->rest);
    observe_rest(line, rotation_vector, strained, at, without);
    for (int g = 0; g < points; g++)
        for (int i = 0; i < 3; i++)
            line->initial[g][i] = without[g][i] - line->rest[g][i];
}
