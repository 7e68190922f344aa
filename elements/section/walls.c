/* Constants of an open section of straight thin walls: sectorial coordinate, shear centre, shear flow.
 * J Eq. 27 for the shear rigidities; every integrand along a wall is a polynomial of degree five at most, for which
 * three Gauss points are exact. */
#include "elements/section/walls.h"

#include <math.h>

#include "elements/math/quadrature.h"

enum { GAUSS = 3, ROOT = 0 };

typedef struct gauss_rule {
    double x[GAUSS], w[GAUSS]; /* on [0, 1] */
} gauss_rule;

static gauss_rule rule_of_three(void)
{
    gauss_rule rule;
    quadrature_points(GAUSS, rule.x, rule.w);
    return rule;
}

static double wall_length(const section_spec *s, int w)
{
    const double *p = s->point[s->wall[w].from], *q = s->point[s->wall[w].to];
    return hypot(q[0] - p[0], q[1] - p[1]);
}

/* Value at x in [0, 1] of a function that is linear along the wall, from its values at the points. */
static double along(const section_spec *s, int w, const double value[], double x)
{
    return (1 - x) * value[s->wall[w].from] + x * value[s->wall[w].to];
}

/* int f g dA over the mid-lines; f, g given at the points. */
static double product(const section_spec *s, const double f[], const double g[])
{
    const gauss_rule rule = rule_of_three();
    double sum = 0;
    for (int w = 0; w < s->walls; w++)
        for (int k = 0; k < GAUSS; k++)
            sum += rule.w[k] * wall_length(s, w) * s->wall[w].thickness *
                   along(s, w, f, rule.x[k]) * along(s, w, g, rule.x[k]);
    return sum;
}

/* Order in which the walls leave the root: wall[k], its point nearer the root and the one farther. */
typedef struct tree {
    int wall[SECTION_MAX_WALLS], near[SECTION_MAX_WALLS], far[SECTION_MAX_WALLS];
} tree;

static status grow_tree(const section_spec *s, tree *t, fault *f)
{
    int reached[SECTION_MAX_POINTS] = {0}, used[SECTION_MAX_WALLS] = {0}, count = 0;
    reached[ROOT] = 1;
    for (int grown = 1; grown;) {
        grown = 0;
        for (int w = 0; w < s->walls; w++) {
            const int a = s->wall[w].from, b = s->wall[w].to;
            if (used[w] || (!reached[a] && !reached[b]))
                continue;
            if (reached[a] && reached[b])
                return fault_set(f, STATUS_REFUSED,
                                 "section: wall %d (points %d-%d) closes a cell; only open "
                                 "sections are offered: open it",
                                 w, a, b);
            used[w] = grown = 1;
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
    return STATUS_OK;
}

static status check_walls(const section_spec *s, fault *f)
{
    if (s->walls < 1 || s->walls > SECTION_MAX_WALLS || s->points < 2 ||
        s->points > SECTION_MAX_POINTS)
        return fault_set(f, STATUS_REFUSED, "section: %d walls and %d points; give 1 to %d walls",
                         s->walls, s->points, SECTION_MAX_WALLS);
    for (int w = 0; w < s->walls; w++) {
        const int a = s->wall[w].from, b = s->wall[w].to;
        if (a < 0 || a >= s->points || b < 0 || b >= s->points)
            return fault_set(f, STATUS_REFUSED,
                             "section: wall %d names point %d of %d; number points from 0", w,
                             a < 0 || a >= s->points ? a : b, s->points);
        if (!(s->wall[w].thickness > 0) || !isfinite(s->wall[w].thickness))
            return fault_set(f, STATUS_REFUSED,
                             "section: thickness of wall %d is %g m; it must be positive", w,
                             s->wall[w].thickness);
        if (!(wall_length(s, w) > 0) || !isfinite(wall_length(s, w)))
            return fault_set(f, STATUS_REFUSED,
                             "section: length of wall %d is %g m; it must be positive", w,
                             wall_length(s, w));
    }
    return STATUS_OK;
}

/* Sectorial coordinate about a pole, zero mean: omega = int (y dz - z dy). */
static void sectorial(const section_spec *s, const tree *t, const double y[], const double z[],
                      double yp, double zp, double area, double omega[])
{
    double one[SECTION_MAX_POINTS];
    for (int p = 0; p < SECTION_MAX_POINTS; p++)
        one[p] = 1;
    omega[ROOT] = 0;
    for (int k = 0; k < s->walls; k++) {
        const int a = t->near[k], b = t->far[k];
        omega[b] = omega[a] + (y[a] - yp) * (z[b] - z[a]) - (z[a] - zp) * (y[b] - y[a]);
    }
    const double mean = product(s, omega, one) / area;
    for (int p = 0; p < s->points; p++)
        omega[p] -= mean;
}

/* Terms of the wall's own thickness; n = (tz, -ty) is its normal, r the distance from the foot of the shear centre. */
typedef struct wall_frame {
    double length, ty, tz, ny, nz;
} wall_frame;

static wall_frame frame_of(const section_spec *s, int w, const double y[], const double z[])
{
    const int a = s->wall[w].from, b = s->wall[w].to;
    const double length = wall_length(s, w), ty = (y[b] - y[a]) / length,
                 tz = (z[b] - z[a]) / length;
    return (wall_frame){length, ty, tz, tz, -ty};
}

static void second_moments(const section_spec *s, const double y[], const double z[], double *Iyy,
                           double *Izz, double *Iyz)
{
    *Iyy = product(s, z, z);
    *Izz = product(s, y, y);
    *Iyz = product(s, y, z);
    if (s->thickness_terms)
        for (int w = 0; w < s->walls; w++) {
            const wall_frame n = frame_of(s, w, y, z);
            const double bend = n.length * pow(s->wall[w].thickness, 3) / 12;
            *Iyy += bend * n.nz * n.nz;
            *Izz += bend * n.ny * n.ny;
            *Iyz += bend * n.ny * n.nz;
        }
}

static void wagner_constants(const section_spec *s, const double y[], const double z[],
                             section *out)
{
    const gauss_rule rule = rule_of_three();
    for (int w = 0; w < s->walls; w++) {
        const wall_frame n = frame_of(s, w, y, z);
        const double t = s->wall[w].thickness, bend = s->thickness_terms ? t * t * t / 12 : 0;
        for (int k = 0; k < GAUSS; k++) {
            const double ds = rule.w[k] * n.length, yk = along(s, w, y, rule.x[k]),
                         zk = along(s, w, z, rule.x[k]), square = yk * yk + zk * zk;
            out->wagner_y +=
                ds * (t * yk * square + bend * (yk * (1 + 2 * n.ny * n.ny) + 2 * zk * n.ny * n.nz));
            out->wagner_z +=
                ds * (t * zk * square + bend * (zk * (1 + 2 * n.nz * n.nz) + 2 * yk * n.ny * n.nz));
        }
    }
}

/* int S_i S_j / t ds of the shear flows, plus the share across the thickness. The walls are taken from the free ends
 * towards the root, so that the moments of everything beyond are known. */
static void shear_flow(const section_spec *s, const tree *t, const double *value[3],
                       const double pole[2], double sum[9])
{
    const gauss_rule rule = rule_of_three();
    double beyond[SECTION_MAX_POINTS][3] = {{0}};
    for (int k = s->walls - 1; k >= 0; k--) {
        const int w = t->wall[k], near = t->near[k], far = t->far[k];
        const double h = s->wall[w].thickness, length = wall_length(s, w);
        for (int g = 0; g < GAUSS; g++) {
            const double x = rule.x[g], ds = rule.w[g] * length;
            double S[3];
            for (int i = 0; i < 3; i++)
                S[i] =
                    beyond[far][i] +
                    h * length * (x * value[i][far] + x * x / 2 * (value[i][near] - value[i][far]));
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    sum[3 * i + j] += ds * S[i] * S[j] / h;
        }
        for (int i = 0; i < 3; i++)
            beyond[near][i] += beyond[far][i] + h * length * (value[i][far] + value[i][near]) / 2;
        if (!s->thickness_terms)
            continue;
        const wall_frame n = frame_of(s, w, value[0], value[1]);
        for (int g = 0; g < GAUSS; g++) {
            const double yk = along(s, w, value[0], rule.x[g]),
                         zk = along(s, w, value[1], rule.x[g]);
            const double r = (yk - pole[0]) * n.ty + (zk - pole[1]) * n.tz,
                         slope[3] = {n.ny, n.nz, -r};
            for (int i = 0; i < 3; i++)
                for (int j = 0; j < 3; j++)
                    sum[3 * i + j] += rule.w[g] * n.length * pow(h, 5) / 120 * slope[i] * slope[j];
        }
    }
}

/* Rotation to principal axes, the smaller of the two; 0 where every axis is one. */
static double principal_angle(double Iyy, double Izz, double Iyz)
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
    const gauss_rule rule = rule_of_three();
    double Iw = product(s, omega, omega);
    if (s->thickness_terms)
        for (int w = 0; w < s->walls; w++) {
            const wall_frame n = frame_of(s, w, y, z);
            for (int k = 0; k < GAUSS; k++) {
                const double r = (along(s, w, y, rule.x[k]) - pole[0]) * n.ty +
                                 (along(s, w, z, rule.x[k]) - pole[1]) * n.tz;
                Iw += rule.w[k] * n.length * pow(s->wall[w].thickness, 3) / 12 * r * r;
            }
        }
    return Iw;
}

status section_walls(const section_spec *s, section *out, fault *f)
{
    tree t;
    TRY(check_walls(s, f));
    TRY(grow_tree(s, &t, f));
    double y[SECTION_MAX_POINTS] = {0}, z[SECTION_MAX_POINTS] = {0},
           omega[SECTION_MAX_POINTS] = {0}, first[2] = {0, 0};
    for (int w = 0; w < s->walls; w++) {
        const double area = wall_length(s, w) * s->wall[w].thickness;
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
    out->axes_angle = principal_angle(Iyy, Izz, Iyz);
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
                         "section: the walls lie on one line, so the mid-line has no bending "
                         "stiffness across it; switch "
                         "thickness_terms on or give a rectangle");

    double pole[2] = {0, 0};
    sectorial(s, &t, y, z, 0, 0, out->A, omega);
    pole[0] = product(s, omega, z) / out->Iy;
    pole[1] = -product(s, omega, y) / out->Iz;
    sectorial(s, &t, y, z, pole[0], pole[1], out->A, omega);
    out->ys = pole[0];
    out->zs = pole[1];
    out->Iw = warping_constant(s, y, z, omega, pole);
    /* Walls that meet in one point do not warp along their mid-lines: what is left of Iw is rounding. */
    const int warps = out->Iw > 1e-24 * out->Ip * out->Ip / out->A;
    if (!warps)
        out->Iw = 0;
    wagner_constants(s, y, z, out);

    const double *value[3] = {y, z, omega};
    const double inertia[3] = {out->Iz, out->Iy, out->Iw};
    shear_flow(s, &t, value, pole, out->F);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out->F[3 * i + j] =
                (i == 2 || j == 2) && !warps ? 0 : out->F[3 * i + j] / (inertia[i] * inertia[j]);
    return STATUS_OK;
}
