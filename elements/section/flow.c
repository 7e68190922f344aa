#include "elements/section/flow.h"

#include <math.h>

#include "elements/math/quadrature.h"

flow_rule flow_rule_of_three(void)
{
    flow_rule rule;
    quadrature_points(FLOW_GAUSS, rule.x, rule.w);
    return rule;
}

double flow_along(const section_spec *s, int w, const double value[], double x)
{
    return (1 - x) * value[s->wall[w].from] + x * value[s->wall[w].to];
}

flow_frame flow_frame_of(const section_spec *s, int w, const double y[], const double z[])
{
    const int a = s->wall[w].from, b = s->wall[w].to;
    const double length = tree_wall_length(s, w), ty = (y[b] - y[a]) / length,
                 tz = (z[b] - z[a]) / length;
    return (flow_frame){length, ty, tz, tz, -ty};
}

double flow_moment(const section_spec *s, const section_tree *t, const double *value[3],
                   const flow_moments *q, int k, int i, double x)
{
    const double h = s->wall[t->wall[k]].thickness, length = tree_wall_length(s, t->wall[k]);
    const int near = t->near[k], far = t->far[k];
    return q[k].start[i] +
           h * length * (x * value[i][far] + x * x / 2 * (value[i][near] - value[i][far]));
}

/* The walls are taken from the free ends towards the root, so that the moments of everything beyond
 * are known.  Cells are cut where the walls that close them end; what flows across the cuts then
 * makes the warping one-valued. */
void flow_first_moments(const section_spec *s, const section_tree *t, const double *value[3],
                        flow_moments q[])
{
    const flow_rule rule = flow_rule_of_three();
    double beyond[SECTION_MAX_POINTS][3] = {{0}};
    const int branches = s->walls - t->cells;
    for (int k = s->walls - 1; k >= 0; k--) {
        const int w = t->wall[k], near = t->near[k], far = t->far[k];
        const double h = s->wall[w].thickness, length = tree_wall_length(s, w);
        for (int i = 0; i < 3; i++) {
            q[k].start[i] = k < branches ? beyond[far][i] : 0;
            beyond[near][i] += q[k].start[i] + h * length * (value[i][far] + value[i][near]) / 2;
        }
    }
    if (t->cells == 0)
        return;
    for (int i = 0; i < 3; i++) {
        double jump[SECTION_MAX_WALLS] = {0}, flow[SECTION_MAX_WALLS];
        for (int k = 0; k < s->walls; k++) {
            const int w = t->wall[k], sign = s->wall[w].from == t->far[k] ? 1 : -1;
            for (int g = 0; g < FLOW_GAUSS; g++)
                jump[w] -= sign * rule.w[g] * tree_wall_length(s, w) / s->wall[w].thickness *
                           flow_moment(s, t, value, q, k, i, rule.x[g]);
        }
        tree_flow(s, t, jump, flow);
        for (int k = 0; k < s->walls; k++)
            q[k].start[i] += (s->wall[t->wall[k]].from == t->far[k] ? 1 : -1) * flow[t->wall[k]];
    }
}

void flow_compliance(const section_spec *s, const section_tree *t, const double *value[3],
                     const double pole[2], double sum[9])
{
    const flow_rule rule = flow_rule_of_three();
    flow_moments q[SECTION_MAX_WALLS];
    flow_first_moments(s, t, value, q);
    for (int k = s->walls - 1; k >= 0; k--) {
        const int w = t->wall[k];
        const double h = s->wall[w].thickness, length = tree_wall_length(s, w);
        for (int g = 0; g < FLOW_GAUSS; g++) {
            const double ds = rule.w[g] * length;
            double S[3];
            for (int i = 0; i < 3; i++)
                S[i] = flow_moment(s, t, value, q, k, i, rule.x[g]);
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    sum[3 * i + j] += ds * S[i] * S[j] / h;
        }
        if (!s->thickness_terms)
            continue;
        const flow_frame n = flow_frame_of(s, w, value[0], value[1]);
        for (int g = 0; g < FLOW_GAUSS; g++) {
            const double yk = flow_along(s, w, value[0], rule.x[g]),
                         zk = flow_along(s, w, value[1], rule.x[g]);
            const double r = (yk - pole[0]) * n.ty + (zk - pole[1]) * n.tz,
                         slope[3] = {n.ny, n.nz, -r};
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    sum[3 * i + j] += rule.w[g] * n.length * pow(h, 5) / 120 * slope[i] * slope[j];
        }
    }
}
