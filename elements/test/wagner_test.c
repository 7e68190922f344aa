/* The constant of the Wagner torque, c of the energy E c kx^4 per length, of sections of walls:
 * closed forms by hand, and what is left of y^2 + z^2 over the area itself when shortening and
 * bending take what they can (least squares, three unknowns). */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>

#include "elements/math/pi.h"
#include "elements/math/quadrature.h"
#include "elements/section/walls.h"
#include "elements/test/sections.h"

typedef struct wagner_shape {
    const char *name;
    int points, walls, cells;
    double point[6][2]; /* [m] */
    int wall[6][2];
    double thickness[6]; /* [m] */
} wagner_shape;

static const wagner_shape shapes[] = {
    {"cruciform",
     5,
     4,
     0,
     {{0, 0}, {0.1, 0}, {-0.1, 0}, {0, 0.1}, {0, -0.1}},
     {{0, 1}, {0, 2}, {0, 3}, {4, 0}},
     {4e-3, 4e-3, 4e-3, 4e-3}},
    {"I",
     6,
     5,
     0,
     {{-0.05, 0.1}, {0, 0.1}, {0.05, 0.1}, {-0.03, -0.1}, {0, -0.1}, {0.03, -0.1}},
     {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}},
     {6e-3, 6e-3, 4e-3, 8e-3, 8e-3}},
    {"channel",
     4,
     3,
     0,
     {{0.05, 0.1}, {0, 0.1}, {0, -0.1}, {0.05, -0.1}},
     {{0, 1}, {1, 2}, {2, 3}},
     {6e-3, 3e-3, 6e-3}},
    {"angle", 3, 2, 0, {{0.12, 0}, {0, 0}, {0, 0.07}}, {{0, 1}, {1, 2}}, {5e-3, 7e-3}},
    {"Z",
     4,
     3,
     0,
     {{-0.07, 0.1}, {0, 0.1}, {0, -0.1}, {0.07, -0.1}},
     {{0, 1}, {1, 2}, {2, 3}},
     {2e-3, 2e-3, 2e-3}},
    {"T",
     4,
     3,
     0,
     {{-0.06, 0}, {0, 0}, {0.06, 0}, {0, 0.1}},
     {{0, 1}, {1, 2}, {1, 3}},
     {5e-3, 5e-3, 8e-3}},
    {"box",
     4,
     4,
     1,
     {{0, 0}, {0.09, 0}, {0.11, 0.2}, {0, 0.2}},
     {{0, 1}, {1, 2}, {3, 2}, {3, 0}},
     {3e-3, 5e-3, 4e-3, 2e-3}}};

static section_spec spec_of(const wagner_shape *s, int thick, double size, double angle)
{
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = s->points;
    spec.walls = s->walls;
    spec.cells = s->cells;
    spec.thickness_terms = thick;
    for (int i = 0; i < s->points; i++) {
        const double y = size * s->point[i][0], z = size * s->point[i][1];
        spec.point[i][0] = 0.3 + cos(angle) * y - sin(angle) * z;
        spec.point[i][1] = -0.1 + sin(angle) * y + cos(angle) * z;
    }
    for (int w = 0; w < s->walls; w++) {
        spec.wall[w].from = s->wall[w][0];
        spec.wall[w].to = s->wall[w][1];
        spec.wall[w].thickness = size * s->thickness[w];
    }
    return spec;
}

/* Adds int g g^T dA of one wall, g = (1, y, z, y^2 + z^2) from `about`. */
static void add_wall(const section_spec *s, int wall, const double about[2], double sum[4][4])
{
    enum { N = 4 };
    double x[N], w[N];
    quadrature_points(N, x, w);
    const double *p = s->point[s->wall[wall].from], *q = s->point[s->wall[wall].to],
                 t = s->wall[wall].thickness;
    const double along[2] = {q[0] - p[0], q[1] - p[1]}, length = hypot(along[0], along[1]);
    for (int i = 0; i < N * N; i++) {
        const double u = x[i / N], v = s->thickness_terms ? (x[i % N] - 0.5) * t / length : 0,
                     y = p[0] + u * along[0] - v * along[1] - about[0],
                     z = p[1] + u * along[1] + v * along[0] - about[1];
        const double g[4] = {1, y, z, y * y + z * z};
        for (int j = 0; j < 16; j++)
            sum[j / 4][j % 4] += w[i / N] * w[i % N] * t * length * g[j / 4] * g[j % 4];
    }
}

/* What the first three leave of the fourth: its square over the area. */
static double left_of(double m[4][4])
{
    for (int k = 0; k < 3; k++)
        for (int i = k + 1; i < 4; i++) {
            const double part = m[i][k] / m[k][k];
            for (int j = k; j < 4; j++)
                m[i][j] -= part * m[k][j];
        }
    return m[3][3];
}

static void over_the_area(const wagner_shape *s, int thick, double angle)
{
    const section_spec spec = spec_of(s, thick, 1, angle);
    const section c = sections_computed(&spec);
    const double about[2] = {c.centroid[0] + 0.01, c.centroid[1] - 0.02};
    double sum[4][4] = {{0}};
    for (int w = 0; w < spec.walls; w++)
        add_wall(&spec, w, about, sum);
    gsl_test_rel(c.wagner_torque, left_of(sum) / 8, 1e-11,
                 "%s, turned by %g, thickness terms %d: what r^2 has over the area", s->name, angle,
                 thick);
    const section_spec large = spec_of(s, thick, 10, angle);
    gsl_test_rel(sections_computed(&large).wagner_torque, 1e6 * c.wagner_torque, 1e-11,
                 "%s ten times larger", s->name);
}

/* A section that a half turn brings onto itself, and one without any symmetry, twist to either side
 * in other ways; a mirror makes both sides alike, whatever the axes, and so do walls that meet in
 * one point. */
static void one_sided(const wagner_shape *s, double angle)
{
    const section_spec spec = spec_of(s, 0, 1, angle);
    const double found = walls_one_sided(&spec);
    const int skew = s->name[0] == 'Z' || s->name[0] == 'b';
    gsl_test(skew ? !(found > 0.02) : !(found < 1e-9), "%s, turned by %g: one-sided by %g", s->name,
             angle, found);
}

/* The Z by hand: omega, with its mean taken off, is that of the middle of the web where no wall is,
 * and even in the half turn; int omega r^2 dA over web and twice one flange. */
static void one_sided_zed(void)
{
    const double b = 0.07, h = 0.1, t = 2e-3; /* h: half of the web */
    const section_spec spec = spec_of(&shapes[4], 0, 1, 0);
    const double flange = b * t, web = 2 * h * t, area = web + 2 * flange;
    /* from 0 in the web omega goes to h b at the ends of the flanges: mean h b/2 over these */
    const double mean = 2 * flange * h * b / 2 / area;
    const double omega_r2 = 2 * flange * h * b * (h * h / 2 + b * b / 4),
                 r2 = 2 * flange * (h * h + b * b / 3) + web * h * h / 3,
                 omega2 = 2 * flange * h * h * b * b / 3 - mean * mean * area,
                 r4 = 2 * flange * (pow(h, 4) + 2 * h * h * b * b / 3 + pow(b, 4) / 5) +
                      web * pow(h, 4) / 5;
    gsl_test_rel(walls_one_sided(&spec), fabs(omega_r2 - mean * r2) / sqrt(omega2 * r4), 1e-12,
                 "Z, by hand");
}

/* Legs b of thickness t about their common end: 1/8 (int r^4 dA - Ip^2/A). */
static void cruciform(void)
{
    const section_spec spec = spec_of(&shapes[0], 0, 1, 0);
    const section c = sections_computed(&spec);
    gsl_test_rel(c.wagner_torque, 2 * 4e-3 * pow(0.1, 5) / 45, 1e-13, "cruciform, by hand");
}

/* An equal angle, t legs of b: mean distance b/4 of the centroid from each leg; along a leg s from
 * the corner r^2 = s^2, less its mean b^2/3 and what bending in the plane of symmetry takes. */
static void equal_angle(void)
{
    const double b = 0.08, t = 3e-3, A = 2 * b * t;
    const double point[3][2] = {{b, 0}, {0, 0}, {0, b}}, thickness[2] = {t, t};
    const section_spec spec = section_spec_walls(2e11, 8e10, 2, point, NULL, thickness);
    const section c = sections_computed(&spec);
    /* v = (s - b/2)/sqrt 2 along the axis of symmetry; int r^2 v dA = 2 t int s^2 (s - b/2)/sqrt 2
     */
    const double mixed = 2 * t * pow(b, 4) / 12 / sqrt(2), square = t * pow(b, 3) / 12,
                 quartic = 2 * t * pow(b, 5) / 5;
    gsl_test_rel(c.wagner_torque,
                 (quartic - pow(2 * t * pow(b, 3) / 3, 2) / A - mixed * mixed / square) / 8, 1e-12,
                 "equal angle, by hand: int r^4, shortening, bending");
}

/* A thick wall is its rectangle; w^5 t/1440 of a thin one, and as much of its short side. */
static void strip(double w, double t)
{
    for (int i = 0; i < 4; i++) {
        const double c = cos(0.4 * i), s = sin(0.4 * i);
        const double point[2][2] = {{0.1, 0.2}, {0.1 + c * w, 0.2 + s * w}};
        section_spec wall = section_spec_walls(2e11, 8e10, 1, point, NULL, &t);
        wall.thickness_terms = 1;
        const double found = sections_computed(&wall).wagner_torque;
        gsl_test_rel(found, (pow(w, 5) * t + w * pow(t, 5)) / 1440, 1e-11, "strip %g x %g", w, t);
        const section_spec sheet = section_spec_rectangle(2e11, 8e10, w, t);
        gsl_test_rel(found, sections_computed(&sheet).wagner_torque, 1e-11,
                     "%g x %g as a wall, and as a rectangle", w, t);
    }
}

/* Fibres of a thin ring have one length, whatever the twist: next to nothing is left. */
static void ring(void)
{
    enum { N = 32 };
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = spec.walls = N;
    spec.cells = 1;
    for (int i = 0; i < N; i++) {
        spec.point[i][0] = 0.1 * cos(2 * PI * i / N);
        spec.point[i][1] = 0.1 * sin(2 * PI * i / N);
        spec.wall[i].from = i;
        spec.wall[i].to = (i + 1) % N;
        spec.wall[i].thickness = 1e-4;
    }
    const section c = sections_computed(&spec);
    gsl_test(!(c.wagner_torque > 0) || c.wagner_torque > 1e-5 * c.Ip * c.Ip / c.A,
             "polygon: %g of Ip^2/A", c.wagner_torque / (c.Ip * c.Ip / c.A));
}

int main(void)
{
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        for (int k = 0; k < 6; k++) {
            over_the_area(&shapes[i], k % 2, 0.35 * k);
            one_sided(&shapes[i], 0.35 * k);
        }
    one_sided_zed();
    cruciform();
    equal_angle();
    strip(0.1, 0.02);
    strip(0.05, 0.05);
    strip(0.1, 3e-4);
    ring();
    return gsl_test_summary();
}
