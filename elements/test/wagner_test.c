/* Compares the constant c of the Wagner torque, whose energy per length is E c kx^4, with closed
 * forms and with a least-squares result. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "elements/section/section.h"
#include "elements/section/stress.h"
#include "elements/section/walls.h"
#include "elements/test/kit.h"

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

/* Adds int g g^T dA of one wall, where g = (1, y, z, y^2 + z^2), relative to `about`. */
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

/* Returns the integral of the square of that part of the fourth function of g which is orthogonal
 * to the first three. */
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

static void one_sided(const wagner_shape *s, double angle)
{
    const section_spec spec = spec_of(s, 0, 1, angle);
    const double found = walls_one_sided(&spec);
    const int skew = s->name[0] == 'Z' || s->name[0] == 'b';
    gsl_test(skew ? !(found > 0.02) : !(found < 1e-9), "%s, turned by %g: one-sided by %g", s->name,
             angle, found);
}

static void one_sided_zed(void)
{
    const double b = 0.07, h = 0.1, t = 2e-3;
    const section_spec spec = spec_of(&shapes[4], 0, 1, 0);
    const double flange = b * t, web = 2 * h * t, area = web + 2 * flange;
    /* omega minus its value in the web: 0 in the web, h b at the ends of the flanges, and h b/2 on
     * average in a flange */
    const double mean = 2 * flange * h * b / 2 / area;
    const double omega_r2 = 2 * flange * h * b * (h * h / 2 + b * b / 4),
                 r2 = 2 * flange * (h * h + b * b / 3) + web * h * h / 3,
                 omega2 = 2 * flange * h * h * b * b / 3 - mean * mean * area,
                 r4 = 2 * flange * (pow(h, 4) + 2 * h * h * b * b / 3 + pow(b, 4) / 5) +
                      web * pow(h, 4) / 5;
    gsl_test_rel(walls_one_sided(&spec), fabs(omega_r2 - mean * r2) / sqrt(omega2 * r4), 1e-12,
                 "Z, by hand");
}

static void cruciform(void)
{
    const section_spec spec = spec_of(&shapes[0], 0, 1, 0);
    const section c = sections_computed(&spec);
    gsl_test_rel(c.wagner_torque, 2 * 4e-3 * pow(0.1, 5) / 45, 1e-13, "cruciform, by hand");
}

static void equal_angle(void)
{
    const double b = 0.08, t = 3e-3, A = 2 * b * t;
    const double point[3][2] = {{b, 0}, {0, 0}, {0, b}}, thickness[2] = {t, t};
    const section_spec spec = section_spec_walls(2e11, 8e10, 2, point, NULL, thickness);
    const section c = sections_computed(&spec);
    /* v = (s - b/2)/sqrt 2 along the axis of symmetry; int r^2 v dA = 2 t int s^2 (s - b/2)/sqrt
     * 2 */
    const double mixed = 2 * t * pow(b, 4) / 12 / sqrt(2), square = t * pow(b, 3) / 12,
                 quartic = 2 * t * pow(b, 5) / 5;
    gsl_test_rel(c.wagner_torque,
                 (quartic - pow(2 * t * pow(b, 3) / 3, 2) / A - mixed * mixed / square) / 8, 1e-12,
                 "equal angle, by hand: int r^4, shortening, bending");
}

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

static void wagner_tests(void)
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
}

static stress_points points_of(const section_spec *spec, const section *c)
{
    static stress_points p;
    fault f = {""};
    gsl_test(stress_points_of(spec, c, &p, &f) != STATUS_OK, "points (%s)", f.text);
    return p;
}

static double most(const stress_points *p, stress_resultants r, stress_measure what)
{
    return stress_of(p, &r, what);
}

static section_spec rectangle_spec(double width, double height)
{
    section_spec spec = sections_steel(SECTION_RECTANGLE);
    spec.width = width;
    spec.height = height;
    return spec;
}

static void torsion(double ratio, double coefficient, int flat)
{
    const double t = 0.01, w = ratio * t;
    const section_spec spec = flat ? rectangle_spec(w, t) : rectangle_spec(t, w);
    const section c = sections_computed(&spec);
    const stress_points p = points_of(&spec, &c);
    const double torque = 5,
                 mises = most(&p, (stress_resultants){.twist = torque / (c.shear_modulus * c.It)},
                              STRESS_VON_MISES);
    gsl_test_rel(mises, sqrt(3) * torque / (coefficient * t * t * w), 2.5e-3,
                 "torsion of 1 : %g, flat %d", ratio, flat);
}

static void torsion_exact(void)
{
    const double t = 0.02, w = 0.03;
    const section_spec spec = rectangle_spec(w, t);
    const section c = sections_computed(&spec);
    const stress_points p = points_of(&spec, &c);
    double shorter = 0;
    for (int n = 1; n < 200; n += 2)
        shorter += 1 / (n * n * cosh(n * PI * t / (2 * w)));
    for (int i = 0; i < p.count; i++)
        if (p.point[i].y == 0 && p.point[i].z > 0)
            gsl_test_rel(p.point[i].across[3][0], -w * (1 - 8 / (PI * PI) * shorter), 1e-3,
                         "middle of the short side, by the other series");
}

static void rectangle(void)
{
    const double w = 0.05, h = 0.02;
    const section_spec spec = rectangle_spec(w, h);
    const section c = sections_computed(&spec);
    const stress_points p = points_of(&spec, &c);
    const stress_resultants bent = {.N = 1e3, .My = 30, .Mz = -20};
    const double N = 1e3 / (w * h), M = 30 * 6 / (h * w * w) + 20 * 6 / (w * h * h);
    gsl_test_rel(most(&p, bent, STRESS_NORMAL_MAX), N + M, 1e-12, "corner in tension");
    gsl_test_rel(most(&p, bent, STRESS_NORMAL_MIN), N - M, 1e-12, "corner in compression");
    gsl_test_rel(most(&p, bent, STRESS_VON_MISES), M + N, 1e-12, "no shear at corners");
    gsl_test_rel(most(&p, (stress_resultants){.Qy = 600}, STRESS_VON_MISES),
                 sqrt(3) * 1.5 * 600 / (w * h), 1e-12, "shear parabola");
    gsl_test_rel(most(&p, (stress_resultants){.Qy = 600, .Qz = -800}, STRESS_VON_MISES),
                 sqrt(3) * 1.5 * 1000 / (w * h), 1e-12, "both parabolas at the centre");
    gsl_test_rel(most(&p, (stress_resultants){.bimoment = -2}, STRESS_NORMAL_MAX),
                 2 * w * h / 4 / c.Iw, 1e-12, "bimoment");
    gsl_test_rel(most(&p, (stress_resultants){.warping = 2}, STRESS_VON_MISES),
                 sqrt(3) * 2 * w / 2 * h * h / (8 * c.Iw), 1e-12, "shear of the warping");
    gsl_test_rel(most(&p, (stress_resultants){.twist = 0.1, .turned = 1}, STRESS_NORMAL_MAX),
                 c.young * 0.005 * (w * w + h * h) / 6, 1e-12, "fibres at the corners, turned");
    const section_spec high = rectangle_spec(h, w);
    const section d = sections_computed(&high);
    const stress_points q = points_of(&high, &d);
    gsl_test_rel(most(&q, (stress_resultants){.warping = 2, .bimoment = 1}, STRESS_VON_MISES),
                 most(&p, (stress_resultants){.warping = 2, .bimoment = 1}, STRESS_VON_MISES),
                 1e-12, "lying and standing");
}

/* The stresses, integrated over the walls, must equal the resultants. Simpson's rule is exact,
 * because all stresses are at most quadratic along a wall. */
static void integrated(const char *name, const section_spec *spec)
{
    static const double by[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const section c = sections_computed(spec);
    const stress_points p = points_of(spec, &c);
    for (int k = 0; k < 4; k++) {
        double Q[2] = {0}, torque = 0;
        int from = 0;
        for (int wall = 0; wall < spec->walls;
             wall++) { /* points of a wall: its ends and its middle on both surfaces, then others */
            const stress_point *at = &p.point[from];
            const double length = hypot(at[4].y - at[0].y, at[4].z - at[0].z);
            double t = 0;
            for (int w = 0; w < spec->walls; w++) {
                const double *a = spec->point[spec->wall[w].from],
                             *b = spec->point[spec->wall[w].to];
                if (fabs(hypot(b[0] - a[0], b[1] - a[1]) - length) < 1e-9)
                    t = spec->wall[w].thickness;
            }
            for (int i = 0; i < 6; i++) {
                const double share = length * t * (i / 2 == 1 ? 4 : 1) / 12;
                double tau[2] = {0};
                for (int r = 0; r < 4; r++)
                    for (int j = 0; j < 2; j++)
                        tau[j] += by[k][r] * at[i].across[r][j];
                Q[0] += share * tau[0];
                Q[1] += share * tau[1];
                const double y = (at[i].y + at[i ^ 1].y) / 2, z = (at[i].z + at[i ^ 1].z) / 2;
                torque += share * ((y - c.ys) * tau[1] - (z - c.zs) * tau[0]);
            }
            if (k == 3)
                torque += length * t * t * t / 3;
            from += 6;
            while (from < p.count && (p.count - from) >= 2 &&
                   fabs((p.point[from].y - at[0].y) * (at[4].z - at[0].z) -
                        (p.point[from].z - at[0].z) * (at[4].y - at[0].y)) < 1e-12 &&
                   hypot(p.point[from].y - at[4].y, p.point[from].z - at[4].z) > 1e-12 &&
                   hypot(p.point[from].y - at[0].y, p.point[from].z - at[0].z) > 1e-12 &&
                   hypot(p.point[from].y - at[0].y, p.point[from].z - at[0].z) < length)
                from += 2;
        }
        const double scale = k == 3 ? c.It : 1, arm = sqrt(c.Ip / c.A);
        gsl_test_abs(Q[0], k == 0, 1e-10 * (k == 3 ? c.It / arm : 1 / (k == 2 ? arm : 1)),
                     "%s: Qy of unit %d", name, k);
        gsl_test_abs(Q[1], k == 1, 1e-10 * (k == 3 ? c.It / arm : 1 / (k == 2 ? arm : 1)),
                     "%s: Qz of unit %d", name, k);
        gsl_test_abs(torque,
                     k == 2   ? c.Iw > 0
                     : k == 3 ? c.It
                              : 0,
                     1e-10 * fmax(scale, arm), "%s: torque of unit %d about the shear centre", name,
                     k);
    }
}

static section_spec walls_spec(int points, const double point[][2], int walls, const int ends[][2],
                               const double thickness[], int cells)
{
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = points;
    spec.walls = walls;
    spec.cells = cells;
    memcpy(spec.point, point, (size_t)points * sizeof spec.point[0]);
    for (int i = 0; i < walls; i++) {
        spec.wall[i].from = ends[i][0];
        spec.wall[i].to = ends[i][1];
        spec.wall[i].thickness = thickness[i];
    }
    return spec;
}

static void tube(void)
{
    section_spec spec = sections_steel(SECTION_TUBE);
    spec.diameter = 0.1;
    spec.wall_thickness = 0.01;
    const section c = sections_computed(&spec);
    const stress_points p = points_of(&spec, &c);
    const double bend = 500 * 0.05 / c.Iy, turn = 200 * 0.05 / c.It;
    gsl_test_rel(
        most(&p, (stress_resultants){.My = 300, .Mz = 400, .twist = 200 / (c.shear_modulus * c.It)},
             STRESS_VON_MISES),
        sqrt(bend * bend + 3 * turn * turn), 1e-12, "tube bent and twisted");
}

static void stress_tests(void)
{
    static const double channel[][2] = {{0.05, 0}, {0, 0.001}, {0, 0.1}, {0.06, 0.11}},
                        box[][2] = {{0, 0}, {0.1, 0.01}, {0.11, 0.07}, {0, 0.05}, {0.16, 0.08}};
    static const int chain[][2] = {{0, 1}, {2, 1}, {2, 3}},
                     ring[][2] = {{0, 1}, {1, 2}, {3, 2}, {3, 0}, {2, 4}};
    static const double thin[] = {2e-3, 3e-3, 4e-3}, walls[] = {2e-3, 1e-3, 3e-3, 2e-3, 1.5e-3};
    static const double table[][2] = {{1, 0.208}, {1.5, 0.231}, {2, 0.246},  {3, 0.267},
                                      {5, 0.291}, {10, 0.312},  {100, 0.333}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (int flat = 0; flat < 2; flat++)
            torsion(table[i][0], i == 6 ? 0.3313 : table[i][1], flat);
    torsion_exact();
    rectangle();
    tube();
    const section_spec open = walls_spec(4, channel, 3, chain, thin, 0),
                       closed = walls_spec(5, box, 5, ring, walls, 1);
    integrated("channel", &open);
    integrated("box with a lip", &closed);
    const section_spec given = section_spec_constants(1, 1);
    stress_points p;
    fault f = {""};
    gsl_test(stress_points_of(&given, &given.constants, &p, &f) != STATUS_REFUSED ||
                 strstr(f.text, "no stress points") == NULL,
             "given constants are refused (%s)", f.text);
}

static section_spec i_shape(double depth, double flange, double thickness)
{
    const double b = flange / 2, h = depth / 2,
                 point[][2] = {{-b, h}, {0, h}, {b, h}, {-b, -h}, {0, -h}, {b, -h}},
                 thick[] = {thickness, thickness, 1e-3, thickness, thickness};
    static const int ends[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    return section_spec_walls(2e11, 8e10, 5, point, ends, thick);
}

static status checked(const section_spec *p, const section_spec *q, fault *f)
{
    const section a = sections_computed(p), b = sections_computed(q), *const ends[] = {&a, &b};
    return section_taper_check(p, q, ends, f);
}

static void ends_are_ends(const char *name, const section_spec *p, const section_spec *q)
{
    section_spec at;
    const section ends[] = {sections_computed(p), sections_computed(q)};
    for (int k = 0; k < 2; k++) {
        section_taper_at(p, q, k, &at);
        const section c = sections_computed(&at);
        gsl_test_rel(c.A, ends[k].A, 1e-14, "%s, end %d: A", name, k);
        gsl_test_rel(c.Iy, ends[k].Iy, 1e-14, "%s, end %d: Iy", name, k);
        gsl_test_rel(c.It, ends[k].It, 1e-14, "%s, end %d: It", name, k);
        gsl_test_rel(c.F[0], ends[k].F[0], 1e-13, "%s, end %d: F", name, k);
    }
}

static void rectangles(void)
{
    section_spec p = section_spec_rectangle(2e11, 8e10, 0.04, 0.02),
                 q = section_spec_rectangle(1e11, 6e10, 0.02, 0.03), at;
    fault f = {""};
    p.density = 8000;
    q.density = 4000;
    gsl_test(checked(&p, &q, &f) != STATUS_OK, "rectangles: %s", f.text);
    ends_are_ends("rectangle", &p, &q);
    section_taper_at(&p, &q, 0.25, &at);
    const section c = sections_computed(&at);
    gsl_test_rel(c.A, 0.035 * 0.0225, 1e-15, "a quarter along: both sizes are linear");
    gsl_test_rel(c.young, 1.75e11, 1e-15, "a quarter along: E");
    gsl_test_rel(c.density, 7000, 1e-15, "a quarter along: density");
    p.given.It = 1e-9;
    gsl_test(checked(&p, &q, &f) != STATUS_REFUSED || strstr(f.text, "'It'") == NULL,
             "given at one end only: %s", f.text);
    q.given.It = 3e-9;
    gsl_test(checked(&p, &q, &f) != STATUS_OK, "given at both: %s", f.text);
    section_taper_at(&p, &q, 0.25, &at);
    gsl_test_rel(sections_computed(&at).It, 1.5e-9, 1e-15, "a quarter along: a given constant");
}

static void constants(void)
{
    section_spec p = section_spec_constants(1, 1), q, at;
    p.constants = (section){.A = 1, .Iy = 2, .Iz = 3, .It = 4, .Ip = 5, .F = {0.5, 0, 0, 0, 0.25}};
    q = p;
    q.constants.Iy = 4;
    q.constants.F[0] = 1;
    fault f = {""};
    gsl_test(checked(&p, &q, &f) != STATUS_OK, "constants: %s", f.text);
    ends_are_ends("constants", &p, &q);
    section_taper_at(&p, &q, 0.5, &at);
    gsl_test_rel(sections_computed(&at).Iy, 3, 1e-15, "half way: Iy");
    gsl_test_rel(sections_computed(&at).F[0], 0.75, 1e-15, "half way: F");
    memset(q.constants.F, 0, sizeof q.constants.F);
    gsl_test(checked(&p, &q, &f) != STATUS_REFUSED, "F at one end only is refused");
}

static void walls(void)
{
    const section_spec p = i_shape(0.1, 0.06, 2e-3);
    section_spec wide = i_shape(0.1, 0.03, 1e-3), deep = i_shape(0.2, 0.06, 2e-3), at;
    fault f = {""};
    gsl_test(checked(&p, &wide, &f) != STATUS_OK, "flanges that change in their planes: %s",
             f.text);
    ends_are_ends("walls", &p, &wide);
    section_taper_at(&p, &wide, 0.5, &at);
    gsl_test_rel(sections_computed(&at).Iw, 2 * 1.5e-3 * pow(0.045, 3) / 12 * 0.05 * 0.05, 1e-12,
                 "half way: Iw");
    gsl_test(checked(&p, &deep, &f) != STATUS_REFUSED || strstr(f.text, "warps") == NULL,
             "flanges that leave their planes: %s", f.text);
    section_spec plane = p;
    plane.given.Iw = deep.given.Iw = 0;
    gsl_test(checked(&plane, &deep, &f) != STATUS_OK, "the same without warping: %s", f.text);
    wide.wall[2].from = 0;
    gsl_test(checked(&p, &wide, &f) != STATUS_REFUSED, "walls that hang together otherwise");
}

static void turned_walls(double angle)
{
    const double c = cos(angle), d = sin(angle);
    section_spec shape[3] = {i_shape(0.1, 0.06, 2e-3), i_shape(0.1, 0.03, 1e-3),
                             i_shape(0.2, 0.06, 2e-3)};
    fault f = {""};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < shape[k].points; i++) {
            double *at = shape[k].point[i];
            const double y = c * at[0] - d * at[1];
            at[1] = d * at[0] + c * at[1];
            at[0] = y;
        }
    gsl_test(checked(&shape[0], &shape[1], &f) != STATUS_OK, "in their planes at %g: %s", angle,
             f.text);
    gsl_test(checked(&shape[0], &shape[2], &f) != STATUS_REFUSED, "out of their planes at %g",
             angle);
}

static void taper_tests(void)
{
    const section_spec rectangle = section_spec_rectangle(2e11, 8e10, 0.04, 0.02),
                       i = i_shape(0.1, 0.06, 2e-3);
    fault f = {""};
    rectangles();
    constants();
    walls();
    turned_walls(1.5707963267948966);
    turned_walls(0.3);
    gsl_test(checked(&rectangle, &i, &f) != STATUS_REFUSED ||
                 strstr(f.text, "a rectangle to walls") == NULL,
             "another form: %s", f.text);
}

int main(void)
{
    wagner_tests();
    stress_tests();
    taper_tests();
    return gsl_test_summary();
}
