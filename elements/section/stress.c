#include "elements/section/stress.h"

#include <math.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "elements/section/walls.h"

enum { PER_QY, PER_QZ, PER_WARPING, PER_TWIST };

/* Returns the shear stress at the middle of the long sides of a rectangle in Saint-Venant torsion,
 * divided by G kappa t. w is the ratio of its width to its thickness t. */
static double long_side(double w)
{
    double sum = 0;
    for (int n = 11; n >= 1; n -= 2)
        sum += 1 / (n * n * cosh(n * PI * w / 2));
    return 1 - 8 / (PI * PI) * sum;
}

/* Returns the shear stress at the middle of the short sides, divided as in long_side. */
static double short_side(double w)
{
    const double catalan = 0.915965594177219015;
    double sum = catalan;
    for (int n = 11; n >= 1; n -= 2)
        sum -= (n % 4 == 1 ? 1.0 : -1.0) / (n * n) * 2 / (exp(n * PI * w) + 1);
    return 8 / (PI * PI) * sum;
}

static void rectangle_points(const section *c, stress_points *out)
{
    const double h = c->height, w = c->width;
    const int flat = w >= h; /* thin along y */
    const double thin = fmin(h, w), ratio = fmax(h, w) / thin, at_long = long_side(ratio) * thin,
                 at_short = short_side(ratio) * thin, parabola = 1.5 / c->A;
    for (int i = -1; i <= 1; i++)
        for (int k = -1; k <= 1; k++) {
            stress_point *p = &out->point[out->count++];
            memset(p, 0, sizeof *p);
            p->y = i * h / 2;
            p->z = k * w / 2;
            p->omega = (flat ? -1 : 1) * p->y * p->z;
            if (i == 0) {
                p->across[PER_QY][0] = parabola;
                p->across[PER_TWIST][0] = -k * (flat ? at_short : at_long);
                if (flat && c->Iw > 0)
                    p->across[PER_WARPING][0] = -p->z * h * h / (8 * c->Iw);
            }
            if (k == 0) {
                p->across[PER_QZ][1] = parabola;
                p->across[PER_TWIST][1] = i * (flat ? at_long : at_short);
                if (!flat && c->Iw > 0)
                    p->across[PER_WARPING][1] = p->y * w * w / (8 * c->Iw);
            }
        }
}

typedef struct wall_flow {
    const section_spec *spec;
    const section *constants;
    walls_lines lines;
    flow_moments q[SECTION_MAX_WALLS];
} wall_flow;

/* Adds a point on each surface of the wall of entry k, at x in [0, 1] from the far to the near
 * point of the wall. */
static void wall_points(const wall_flow *of, int k, double x, stress_points *out)
{
    const section_spec *s = of->spec;
    const section *c = of->constants;
    const walls_lines *l = &of->lines;
    const int w = l->tree.wall[k], near = l->tree.near[k], far = l->tree.far[k],
              forward = s->wall[w].from == far;
    const double t = s->wall[w].thickness, *value[3] = {l->y, l->z, l->omega},
                 inertia[3] = {c->Iz, c->Iy, c->Iw};
    const flow_frame n = flow_frame_of(s, w, l->y, l->z);
    for (int side = -1; side <= 1; side += 2) {
        stress_point *p = &out->point[out->count++];
        memset(p, 0, sizeof *p);
        p->y = l->y[far] + x * (l->y[near] - l->y[far]);
        p->z = l->z[far] + x * (l->z[near] - l->z[far]);
        p->omega = l->omega[far] + x * (l->omega[near] - l->omega[far]);
        const double arm = (p->y - l->pole[0]) * n.ty + (p->z - l->pole[1]) * n.tz;
        for (int i = 0; i < 3; i++) {
            const double stress =
                inertia[i] > 0 ? -flow_moment(s, &l->tree, value, of->q, k, i, x) / (inertia[i] * t)
                               : 0;
            p->across[i][0] = (forward ? 1 : -1) * stress * n.ty;
            p->across[i][1] = (forward ? 1 : -1) * stress * n.tz;
        }
        p->across[PER_TWIST][0] = (l->flow[w] / t + side * t) * n.ty;
        p->across[PER_TWIST][1] = (l->flow[w] / t + side * t) * n.tz;
        p->y += side * t / 2 * n.ny;
        p->z += side * t / 2 * n.nz;
        p->omega -= side * t / 2 * arm;
    }
}

/* Adds the fibre where the outer surfaces of walls v and w meet at point `at`. The warping is
 * continued from wall v. The shear stress is zero at the fibre. Adds nothing if the walls are
 * nearly parallel. */
static void add_corner(const wall_flow *of, int at, int v, int w, stress_points *out)
{
    const section_spec *s = of->spec;
    const walls_lines *l = &of->lines;
    const int wall[2] = {v, w};
    const flow_frame n = flow_frame_of(s, v, l->y, l->z);
    double away[2][2], from[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        const int k = wall[i], far = s->wall[k].from == at ? s->wall[k].to : s->wall[k].from;
        const double y = l->y[far] - l->y[at], z = l->z[far] - l->z[at];
        away[i][0] = y / hypot(y, z);
        away[i][1] = z / hypot(y, z);
    }
    const double sine = fabs(away[0][0] * away[1][1] - away[0][1] * away[1][0]);
    if (sine < 0.1)
        return;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            from[k] -= s->wall[wall[1 - i]].thickness / (2 * sine) * away[i][k];
    const double along = from[0] * n.ty + from[1] * n.tz, off = from[0] * n.ny + from[1] * n.nz,
                 rise = (l->omega[s->wall[v].to] - l->omega[s->wall[v].from]) / n.length,
                 arm = (l->y[at] + along * n.ty - l->pole[0]) * n.ty +
                       (l->z[at] + along * n.tz - l->pole[1]) * n.tz;
    out->point[out->count++] = (stress_point){.y = l->y[at] + from[0],
                                              .z = l->z[at] + from[1],
                                              .omega = l->omega[at] + along * rise - off * arm};
}

static void add_corners(const wall_flow *of, stress_points *out)
{
    const section_spec *s = of->spec;
    for (int at = 0; at < s->points; at++) {
        int found = 0, wall[2] = {0, 0};
        for (int w = 0; w < s->walls; w++)
            if (s->wall[w].from == at || s->wall[w].to == at) {
                if (found < 2)
                    wall[found] = w;
                found++;
            }
        for (int i = 0; found == 2 && i < 2; i++)
            add_corner(of, at, wall[i], wall[1 - i], out);
    }
}

/* Completes the points of an angle section. If the shear centre and the area are given, they
 * determine the centroid of the given constants, to which the stress points refer. */
static void complete_angle(const wall_flow *of, stress_points *out)
{
    const section_spec *s = of->spec;
    if (s->walls != 2 || s->points != 3 || isnan(s->given.A) || isnan(s->given.ys) ||
        isnan(s->given.zs))
        return;
    const int first = s->wall[0].from,
              at = first == s->wall[1].from || first == s->wall[1].to ? first : s->wall[0].to;
    for (int k = 0; k < out->count; k++) {
        out->point[k].y += of->constants->ys - of->lines.y[at];
        out->point[k].z += of->constants->zs - of->lines.z[at];
    }
}

static status walls_of(const section_spec *s, const section *c, stress_points *out, fault *f)
{
    wall_flow of = {.spec = s, .constants = c};
    section scratch;
    memset(&scratch, 0, sizeof scratch);
    TRY(walls_lines_of(s, &of.lines, &scratch, f));
    const double *value[3] = {of.lines.y, of.lines.z, of.lines.omega};
    flow_first_moments(s, &of.lines.tree, value, of.q);
    for (int k = 0; k < s->walls; k++) {
        const int near = of.lines.tree.near[k], far = of.lines.tree.far[k];
        for (int i = 0; i < 3; i++)
            wall_points(&of, k, i / 2.0, out);
        for (int i = 0; i < 3; i++)
            if (value[i][near] * value[i][far] < 0)
                wall_points(&of, k, value[i][far] / (value[i][far] - value[i][near]), out);
    }
    add_corners(&of, out);
    complete_angle(&of, out);
    return STATUS_OK;
}

status stress_points_of(const section_spec *spec, const section *constants, stress_points *out,
                        fault *f)
{
    out->section = constants;
    out->count = 0;
    out->radius = 0;
    switch (spec->kind) {
    case SECTION_RECTANGLE:
        rectangle_points(constants, out);
        return STATUS_OK;
    case SECTION_TUBE:
        out->radius = spec->diameter / 2;
        return STATUS_OK;
    case SECTION_WALLS:
        return walls_of(spec, constants, out, f);
    case SECTION_CONSTANTS:
    case SECTION_MATRICES:
        break;
    }
    return fault_set(
        f, STATUS_REFUSED,
        "a section given by constants or matrices has no stress points; describe it by "
        "dimensions or walls, or request resultants");
}

typedef struct stress {
    double along, y, z;
} stress;

static double measured(const stress *s, stress_measure what)
{
    switch (what) {
    case STRESS_VON_MISES:
        return sqrt(s->along * s->along + 3 * (s->y * s->y + s->z * s->z));
    case STRESS_NORMAL_MAX:
        return s->along;
    case STRESS_NORMAL_MIN:
        break;
    }
    return -s->along;
}

/* Returns the normal stress [Pa] of a fibre due to its rotation by the twist. */
static double turned(const section *c, double y, double z, double twist)
{
    const double u = y - c->ys, v = z - c->zs, mean = c->Ip / c->A + c->ys * c->ys + c->zs * c->zs,
                 by_y = c->wagner_y / c->Iz - 2 * c->ys, by_z = c->wagner_z / c->Iy - 2 * c->zs;
    return c->young * twist * twist / 2 * (u * u + v * v - mean - by_y * y - by_z * z);
}

static double of_point(const section *c, const stress_point *p, const stress_resultants *r,
                       stress_measure what)
{
    const double by[4] = {r->Qy, r->Qz, r->warping, c->shear_modulus * r->twist};
    stress s = {r->N / c->A - r->Mz * p->y / c->Iz + r->My * p->z / c->Iy, 0, 0};
    if (c->Iw > 0)
        s.along -= r->bimoment * p->omega / c->Iw;
    if (r->turned)
        s.along += turned(c, p->y, p->z, r->twist);
    for (int i = 0; i < 4; i++) {
        s.y += by[i] * p->across[i][0];
        s.z += by[i] * p->across[i][1];
    }
    return measured(&s, what);
}

static double of_tube(const section *c, double R, const stress_resultants *r, stress_measure what)
{
    double largest = -INFINITY;
    for (int side = -1; side <= 1; side += 2) {
        stress s = {r->N / c->A + side * hypot(r->My, r->Mz) * R / c->Iy,
                    c->shear_modulus * r->twist * R, 0};
        if (r->turned)
            s.along += turned(c, R, 0, r->twist);
        largest = fmax(largest, measured(&s, what));
    }
    return largest;
}

double stress_of(const stress_points *points, const stress_resultants *r, stress_measure what)
{
    double largest =
        points->radius > 0 ? of_tube(points->section, points->radius, r, what) : -INFINITY;
    for (int i = 0; i < points->count; i++)
        largest = fmax(largest, of_point(points->section, &points->point[i], r, what));
    return what == STRESS_NORMAL_MIN ? -largest : largest;
}
