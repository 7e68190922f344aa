#include "elements/section/walls.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

double tree_wall_length(const section_spec *s, int w)
{
    const double *p = s->point[s->wall[w].from], *q = s->point[s->wall[w].to];
    return hypot(q[0] - p[0], q[1] - p[1]);
}

/* Finds the entry of `t` that reaches each point. The walls that close cells are the last
 * entries. */
static status connect(const section_spec *s, section_tree *t, fault *f)
{
    int reached[SECTION_MAX_POINTS] = {0}, used[SECTION_MAX_WALLS] = {0}, count = 0;
    int closing[SECTION_MAX_WALLS];
    reached[0] = 1;
    for (int grown = 1; grown;) {
        grown = 0;
        for (int w = 0; w < s->walls; w++) {
            const int a = s->wall[w].from, b = s->wall[w].to;
            if (used[w] || (!reached[a] && !reached[b]))
                continue;
            used[w] = grown = 1;
            if (reached[a] && reached[b]) {
                if (t->cells == s->cells)
                    return fault_set(f, STATUS_REFUSED,
                                     "section: wall %d (points %d-%d) closes a cell; %s", w, a, b,
                                     s->cells > 0 ? "correct the number of closed cells"
                                                  : "open the cell, or give the number of cells");
                closing[t->cells++] = w;
                continue;
            }
            t->wall[count] = w;
            t->near[count] = reached[a] ? a : b;
            t->far[count] = reached[a] ? b : a;
            reached[t->far[count]] = 1;
            count++;
        }
    }
    for (int w = 0; w < s->walls; w++)
        if (!used[w])
            return fault_set(f, STATUS_REFUSED,
                             "section: wall %d (points %d-%d) is not connected to wall 0; join the "
                             "walls at shared points",
                             w, s->wall[w].from, s->wall[w].to);
    for (int p = 0; p < s->points; p++)
        if (!reached[p])
            return fault_set(f, STATUS_REFUSED, "section: point %d belongs to no wall; remove it",
                             p);
    for (int c = 0; c < t->cells; c++) {
        t->wall[count + c] = closing[c];
        t->near[count + c] = s->wall[closing[c]].from;
        t->far[count + c] = s->wall[closing[c]].to;
    }
    return STATUS_OK;
}

/* Adds the path from a point to the root, multiplied by `sign`, to a cell. */
static void walk_to_root(const section_spec *s, section_tree *t, int c, int point, int sign)
{
    for (int k = s->walls - t->cells - 1; k >= 0; k--)
        if (t->far[k] == point) {
            const int forward = s->wall[t->wall[k]].from == point;
            t->round[c][t->wall[k]] += (signed char)(forward ? sign : -sign);
            point = t->near[k];
        }
}

status tree_grow(const section_spec *s, section_tree *t, fault *f)
{
    memset(t, 0, sizeof *t);
    TRY(connect(s, t, f));
    if (t->cells < s->cells)
        return fault_set(
            f, STATUS_REFUSED,
            "section: number of cells: %d closed by walls, %d given; correct the number "
            "of cells, or close the cells at shared points",
            t->cells, s->cells);
    for (int c = 0; c < t->cells; c++) {
        const int k = s->walls - t->cells + c;
        t->round[c][t->wall[k]] = 1;
        walk_to_root(s, t, c, t->far[k], 1);
        walk_to_root(s, t, c, t->near[k], -1);
    }
    return STATUS_OK;
}

void tree_flow(const section_spec *s, const section_tree *t, const double jump[], double flow[])
{
    /* for each cell c: sum over cells d of (oint_c,d ds/t) x_d = oint_c; the matrix is positive
     * definite */
    double matrix[SECTION_MAX_WALLS * SECTION_MAX_WALLS], x[SECTION_MAX_WALLS];
    const int n = t->cells;
    for (int w = 0; w < s->walls; w++)
        flow[w] = 0;
    if (n == 0)
        return;
    for (int c = 0; c < n; c++) {
        x[c] = 0;
        for (int d = 0; d < n; d++)
            matrix[c * n + d] = 0;
        for (int w = 0; w < s->walls; w++) {
            x[c] += t->round[c][w] * jump[w];
            for (int d = 0; d < n; d++)
                matrix[c * n + d] +=
                    t->round[c][w] * t->round[d][w] * tree_wall_length(s, w) / s->wall[w].thickness;
        }
    }
    dense_cholesky(n, matrix);
    dense_cholesky_solve(n, 1, matrix, x);
    for (int w = 0; w < s->walls; w++)
        for (int c = 0; c < n; c++)
            flow[w] += t->round[c][w] * x[c];
}

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

/* Processes walls from the free ends towards the root, so the moments of all walls beyond a wall
 * are known before those of the wall. */
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

/* Constants of a section of straight thin walls, open or with closed cells, with the sectorial
 * coordinate and the shear centre. Every integrand along a wall is a polynomial of degree five at
 * most, for which three Gauss points are exact. */

enum { ROOT = 0 };

static double product(const section_spec *s, const double f[], const double g[])
{
    const flow_rule rule = flow_rule_of_three();
    double sum = 0;
    for (int w = 0; w < s->walls; w++)
        for (int k = 0; k < FLOW_GAUSS; k++)
            sum += rule.w[k] * tree_wall_length(s, w) * s->wall[w].thickness *
                   flow_along(s, w, f, rule.x[k]) * flow_along(s, w, g, rule.x[k]);
    return sum;
}

static status check_walls(const section_spec *s, fault *f)
{
    if (s->walls < 1 || s->walls > SECTION_MAX_WALLS || s->points < 2 ||
        s->points > SECTION_MAX_POINTS)
        return fault_set(
            f, STATUS_REFUSED,
            "section: number of walls: %d, number of points: %d; give 1 to %d walls and "
            "2 to %d points",
            s->walls, s->points, SECTION_MAX_WALLS, SECTION_MAX_POINTS);
    for (int w = 0; w < s->walls; w++) {
        const int a = s->wall[w].from, b = s->wall[w].to;
        if (a < 0 || a >= s->points || b < 0 || b >= s->points)
            return fault_set(f, STATUS_REFUSED,
                             "section: wall %d refers to point %d, but the %d points are numbered "
                             "from 0; correct the number",
                             w, a < 0 || a >= s->points ? a : b, s->points);
        if (!(s->wall[w].thickness > 0) || !isfinite(s->wall[w].thickness))
            return fault_set(f, STATUS_REFUSED,
                             "section: the thickness of wall %d is %g m; give a positive thickness",
                             w, s->wall[w].thickness);
        if (!(tree_wall_length(s, w) > 0) || !isfinite(tree_wall_length(s, w)))
            return fault_set(f, STATUS_REFUSED,
                             "section: the length of wall %d is %g m; move its end points apart", w,
                             tree_wall_length(s, w));
    }
    return STATUS_OK;
}

/* Returns twice the area that a wall sweeps about a pole, from `from` to `to` [m^2]. */
static double swept(const section_spec *s, int w, const double y[], const double z[], double yp,
                    double zp)
{
    const int a = s->wall[w].from, b = s->wall[w].to;
    return (y[a] - yp) * (z[b] - z[a]) - (z[a] - zp) * (y[b] - y[a]);
}

/* Computes the sectorial coordinate about a pole, with zero mean: omega = int (y dz - z dy) - int
 * psi/t ds. psi is the flow of Saint-Venant torsion divided by G and by the twist rate. psi is
 * constant around each cell, and zero if there are no cells. */
static void sectorial(const section_spec *s, const section_tree *t, const double y[],
                      const double z[], double yp, double zp, double area, const double psi[],
                      double omega[])
{
    double one[SECTION_MAX_POINTS];
    for (int p = 0; p < SECTION_MAX_POINTS; p++)
        one[p] = 1;
    omega[ROOT] = 0;
    for (int k = 0; k < s->walls - t->cells; k++) {
        const int a = t->near[k], b = t->far[k], w = t->wall[k];
        omega[b] = omega[a] + (y[a] - yp) * (z[b] - z[a]) - (z[a] - zp) * (y[b] - y[a]);
        if (t->cells > 0)
            omega[b] -= (s->wall[w].from == a ? 1 : -1) * psi[w] * tree_wall_length(s, w) /
                        s->wall[w].thickness;
    }
    const double mean = product(s, omega, one) / area;
    for (int p = 0; p < s->points; p++)
        omega[p] -= mean;
}

/* Computes the flow psi of the cells in torsion, divided by G and by the twist rate [m^2]. Returns
 * the contribution of the cells to It [m^4] (Bredt). */
static double cell_torsion(const section_spec *s, const section_tree *t, const double y[],
                           const double z[], double psi[])
{
    double jump[SECTION_MAX_WALLS], It = 0;
    for (int w = 0; w < s->walls; w++)
        jump[w] = swept(s, w, y, z, 0, 0);
    tree_flow(s, t, jump, psi);
    for (int w = 0; w < s->walls; w++)
        It += psi[w] * jump[w];
    return It;
}

static void second_moments(const section_spec *s, const double y[], const double z[], double *Iyy,
                           double *Izz, double *Iyz)
{
    *Iyy = product(s, z, z);
    *Izz = product(s, y, y);
    *Iyz = product(s, y, z);
    if (s->thickness_terms)
        for (int w = 0; w < s->walls; w++) {
            const flow_frame n = flow_frame_of(s, w, y, z);
            const double bend = n.length * pow(s->wall[w].thickness, 3) / 12;
            *Iyy += bend * n.nz * n.nz;
            *Izz += bend * n.ny * n.ny;
            *Iyz += bend * n.ny * n.nz;
        }
}

static void wagner_constants(const section_spec *s, const double y[], const double z[],
                             section *out)
{
    const flow_rule rule = flow_rule_of_three();
    for (int w = 0; w < s->walls; w++) {
        const flow_frame n = flow_frame_of(s, w, y, z);
        const double t = s->wall[w].thickness, bend = s->thickness_terms ? t * t * t / 12 : 0;
        for (int k = 0; k < FLOW_GAUSS; k++) {
            const double ds = rule.w[k] * n.length, yk = flow_along(s, w, y, rule.x[k]),
                         zk = flow_along(s, w, z, rule.x[k]), square = yk * yk + zk * zk;
            out->wagner_y +=
                ds * (t * yk * square + bend * (yk * (1 + 2 * n.ny * n.ny) + 2 * zk * n.ny * n.nz));
            out->wagner_z +=
                ds * (t * zk * square + bend * (zk * (1 + 2 * n.nz * n.nz) + 2 * yk * n.ny * n.nz));
        }
    }
}

/* Returns 1/8 int q^2 dA, where q is the part of r^2 = y^2 + z^2 that axial and bending strains do
 * not represent, r^2 - Ip/A - wagner_y/Iz y - wagner_z/Iy z. The position of the shear centre has
 * no influence, because rotation about another point only adds such strains. At the distance n
 * across a wall, the function is q + q_n n + n^2. */
static double wagner_torque(const section_spec *s, const double y[], const double z[],
                            const section *c)
{
    const flow_rule rule = flow_rule_of_three();
    const double mean = c->Ip / c->A, by_y = c->wagner_y / c->Iz, by_z = c->wagner_z / c->Iy;
    double sum = 0;
    for (int w = 0; w < s->walls; w++) {
        const flow_frame n = flow_frame_of(s, w, y, z);
        const double t = s->wall[w].thickness, thick = s->thickness_terms != 0 ? t : 0,
                     bend = t * thick * thick / 12, quartic = t * pow(thick, 4) / 80;
        for (int k = 0; k < FLOW_GAUSS; k++) {
            const double ds = rule.w[k] * n.length, yk = flow_along(s, w, y, rule.x[k]),
                         zk = flow_along(s, w, z, rule.x[k]),
                         q = yk * yk + zk * zk - mean - by_y * yk - by_z * zk,
                         q_n = (2 * yk - by_y) * n.ny + (2 * zk - by_z) * n.nz;
            sum += ds * (t * q * q + bend * (q_n * q_n + 2 * q) + quartic);
        }
    }
    return sum / 8;
}

double section_principal_angle(double Iyy, double Izz, double Iyz)
{
    double up = 2 * Iyz, across = Izz - Iyy;
    if (fabs(up) <= 1e-13 * (Iyy + Izz))
        return 0;
    if (across < 0) {
        up = -up;
        across = -across;
    }
    return atan2(up, across) / 2;
}

static double warping_constant(const section_spec *s, const double y[], const double z[],
                               const double omega[], const double pole[2])
{
    const flow_rule rule = flow_rule_of_three();
    double Iw = product(s, omega, omega);
    if (s->thickness_terms)
        for (int w = 0; w < s->walls; w++) {
            const flow_frame n = flow_frame_of(s, w, y, z);
            for (int k = 0; k < FLOW_GAUSS; k++) {
                const double r = (flow_along(s, w, y, rule.x[k]) - pole[0]) * n.ty +
                                 (flow_along(s, w, z, rule.x[k]) - pole[1]) * n.tz;
                Iw += rule.w[k] * n.length * pow(s->wall[w].thickness, 3) / 12 * r * r;
            }
        }
    return Iw;
}

status walls_lines_of(const section_spec *s, walls_lines *lines, section *out, fault *f)
{
    TRY(check_walls(s, f));
    TRY(tree_grow(s, &lines->tree, f));
    memset(lines->y, 0, sizeof lines->y);
    memset(lines->z, 0, sizeof lines->z);
    memset(lines->omega, 0, sizeof lines->omega);
    double *y = lines->y, *z = lines->z, first[2] = {0, 0};
    for (int w = 0; w < s->walls; w++) {
        const double area = tree_wall_length(s, w) * s->wall[w].thickness;
        out->A += area;
        out->It += area * s->wall[w].thickness * s->wall[w].thickness / 3;
        for (int k = 0; k < 2; k++)
            first[k] += area * (s->point[s->wall[w].from][k] + s->point[s->wall[w].to][k]) / 2;
    }
    for (int k = 0; k < 2; k++)
        out->centroid[k] = first[k] / out->A;
    for (int p = 0; p < s->points; p++) {
        y[p] = s->point[p][0] - out->centroid[0];
        z[p] = s->point[p][1] - out->centroid[1];
    }
    double Iyy, Izz, Iyz;
    second_moments(s, y, z, &Iyy, &Izz, &Iyz);
    out->axes_angle = isnan(s->given.beta) ? section_principal_angle(Iyy, Izz, Iyz) : s->given.beta;
    const double c = cos(out->axes_angle), d = sin(out->axes_angle);
    if (d != 0)
        for (int p = 0; p < s->points; p++) {
            const double turned = c * y[p] + d * z[p];
            z[p] = -d * y[p] + c * z[p];
            y[p] = turned;
        }
    second_moments(s, y, z, &out->Iy, &out->Iz, &Iyz);
    out->Ip = out->Iy + out->Iz;
    if (!(out->Iy > 1e-14 * out->Ip) || !(out->Iz > 1e-14 * out->Ip))
        return fault_set(f, STATUS_REFUSED,
                         "section: all walls lie on one line and have no bending stiffness across "
                         "that line; give thickness_terms: yes, or a rectangle");

    double *omega = lines->omega, *pole = lines->pole;
    out->It += cell_torsion(s, &lines->tree, y, z, lines->flow);
    sectorial(s, &lines->tree, y, z, 0, 0, out->A, lines->flow, omega);
    pole[0] = product(s, omega, z) / out->Iy;
    pole[1] = -product(s, omega, y) / out->Iz;
    sectorial(s, &lines->tree, y, z, pole[0], pole[1], out->A, lines->flow, omega);
    out->ys = pole[0];
    out->zs = pole[1];
    out->Iw = warping_constant(s, y, z, omega, pole);
    return STATUS_OK;
}

status section_walls(const section_spec *s, section *out, fault *f)
{
    walls_lines lines;
    TRY(walls_lines_of(s, &lines, out, f));
    const double *y = lines.y, *z = lines.z, *omega = lines.omega;
    /* walls that meet in one point do not warp along their mid-lines, and Iw is then only rounding
     * error */
    const int warps = out->Iw > 1e-24 * out->Ip * out->Ip / out->A;
    if (!warps)
        out->Iw = 0;
    wagner_constants(s, y, z, out);
    out->wagner_torque = wagner_torque(s, y, z, out);

    const double *value[3] = {y, z, omega};
    const double inertia[3] = {out->Iz, out->Iy, out->Iw};
    flow_compliance(s, &lines.tree, value, lines.pole, out->F);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->F[3 * i + j] =
                (i == 2 || j == 2) && !warps ? 0 : out->F[3 * i + j] / (inertia[i] * inertia[j]);
    return STATUS_OK;
}

double walls_one_sided(const section_spec *s)
{
    const flow_rule rule = flow_rule_of_three();
    walls_lines lines;
    section c = {0};
    double mixed = 0, warps = 0, quartic = 0;
    if (s->kind != SECTION_WALLS || walls_lines_of(s, &lines, &c, NULL) != STATUS_OK)
        return 0;
    for (int w = 0; w < s->walls; w++)
        for (int k = 0; k < FLOW_GAUSS; k++) {
            const double dA = rule.w[k] * tree_wall_length(s, w) * s->wall[w].thickness,
                         y = flow_along(s, w, lines.y, rule.x[k]),
                         z = flow_along(s, w, lines.z, rule.x[k]), square = y * y + z * z,
                         omega = flow_along(s, w, lines.omega, rule.x[k]);
            mixed += dA * omega * square;
            warps += dA * omega * omega;
            quartic += dA * square * square;
        }
    return warps > 1e-24 * quartic ? fabs(mixed) / sqrt(warps * quartic) : 0;
}
