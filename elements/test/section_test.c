/* Compares the section constants of a rectangle with those of a wall of the same size. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "elements/math/scalar.h"
#include "elements/test/kit.h"

static section wall_section(double h, double t, double y, double z, double angle)
{
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = 2;
    spec.walls = 1;
    for (int i = 0; i < 2; i++) {
        spec.point[i][0] = y + (i - 0.5) * h * cos(angle);
        spec.point[i][1] = z + (i - 0.5) * h * sin(angle);
        spec.wall[0].to = 1;
    }
    spec.wall[0].thickness = t;
    spec.thickness_terms = 1;
    return sections_computed(&spec);
}

static section rectangle(double width, double height, double ky, double kz)
{
    section_spec spec = sections_steel(SECTION_RECTANGLE);
    spec.width = width;
    spec.height = height;
    spec.shear_factor[0] = ky;
    spec.shear_factor[1] = kz;
    return sections_computed(&spec);
}

static void rectangle_is_a_wall(double h, double t)
{
    const section wall = wall_section(h, t, 0, 0, 0), wide = rectangle(h, t, 0, 0),
                  high = rectangle(t, h, 0, 0);
    gsl_test_rel(wide.A, wall.A, 1e-14, "area of %g x %g", h, t);
    gsl_test_rel(wide.Iy, wall.Iz, 1e-13, "stiff bending");
    gsl_test_rel(wide.Iz, wall.Iy, 1e-13, "soft bending");
    gsl_test_rel(wall.Iw, pow(h * t, 3) / 144, 1e-13, "warping constant of a wall of %g x %g", h,
                 t);
    gsl_test_rel(wide.F[0], wall.F[4], 1e-13, "shear across the wall");
    gsl_test_rel(wide.F[4], wall.F[0], 1e-13, "shear along the wall");
    gsl_test_rel(wide.F[8], wall.F[8], 1e-13, "warping shear of %g x %g", h, t);
    gsl_test_rel(high.F[8], wide.F[8], 1e-14, "warping shear knows no side");
    gsl_test_rel(high.Iw, wide.Iw, 1e-14, "nor does warping");
    gsl_test_rel(wide.D[8] * wide.F[8], 1, 1e-14, "rigidity of warping shear");
}

static void given_factors(void)
{
    const section one = rectangle(0.1, 0.02, 0.85, 0), none = rectangle(0.1, 0.02, 0, 0),
                  both = rectangle(0.1, 0.02, 0.85, 0.85);
    gsl_test_rel(one.F[0], both.F[0], 1e-14, "a factor that is given counts");
    gsl_test_rel(one.F[4], none.F[4], 1e-14, "the one beside it is 5/6");
    gsl_test(one.F[8] != 0 || both.F[8] != 0, "with given factors there is no warping shear");
}

static void turned_wall(void)
{
    const double h = 0.13, t = 0.017;
    const section straight = wall_section(h, t, 0, 0, 0);
    for (int i = -8; i <= 8; i++) {
        const double angle = 0.19 * i;
        const section c = wall_section(h, t, 0.3, -0.2, angle);
        gsl_test_rel(fmax(c.Iy, c.Iz), straight.Iz, 1e-12, "turned by %g: stiff bending", angle);
        gsl_test_rel(fmin(c.Iy, c.Iz), straight.Iy, 1e-12, "soft bending");
        gsl_test_rel(c.Iw, straight.Iw, 1e-12, "warping constant");
        gsl_test_rel(c.F[8], straight.F[8], 1e-12, "warping shear");
        gsl_test_rel(fmin(c.F[0], c.F[4]), fmin(straight.F[0], straight.F[4]), 1e-12, "shear");
        gsl_test_abs(hypot(c.ys, c.zs), 0, 1e-14, "shear centre in the middle");
    }
}

/* Computes int (y, z, 1)(y, z, 1)^T dA over the areas of the walls, by quadrature, with y and z as
 * in the input. */
static void area_moments(const section_spec *s, double sum[3][3])
{
    enum { N = 4 };
    double x[N], w[N];
    quadrature_points(N, x, w);
    for (int i = 0; i < 9; i++)
        sum[i / 3][i % 3] = 0;
    for (int k = 0; k < s->walls; k++) {
        const double *p = s->point[s->wall[k].from], *q = s->point[s->wall[k].to],
                     t = s->wall[k].thickness;
        const double along[2] = {q[0] - p[0], q[1] - p[1]}, length = hypot(along[0], along[1]);
        for (int i = 0; i < N * N; i++) {
            const double u = x[i / N], v = (x[i % N] - 0.5) * t / length;
            const double point[3] = {p[0] + u * along[0] - v * along[1],
                                     p[1] + u * along[1] + v * along[0], 1};
            for (int j = 0; j < 9; j++)
                sum[j / 3][j % 3] += w[i / N] * w[i % N] * t * length * point[j / 3] * point[j % 3];
        }
    }
}

static void thick_walls(void)
{
    static const double point[4][2] = {{0, 0}, {0.05, 0.01}, {0.05, 0.08}, {0.02, 0.1}};
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = 4;
    spec.walls = 3;
    spec.thickness_terms = 1;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            spec.point[i][k] = point[i][k];
    for (int i = 0; i < 3; i++) {
        spec.wall[i].from = i;
        spec.wall[i].to = i + 1;
        spec.wall[i].thickness = 0.004 + 0.003 * i;
    }
    const section c = sections_computed(&spec);
    double m[3][3];
    area_moments(&spec, m);
    const double yc = m[0][2] / m[2][2], zc = m[1][2] / m[2][2];
    const double yy = m[0][0] - m[2][2] * yc * yc, zz = m[1][1] - m[2][2] * zc * zc,
                 yz = m[0][1] - m[2][2] * yc * zc;
    const double mean = (yy + zz) / 2, radius = hypot((yy - zz) / 2, yz);
    gsl_test_rel(c.A, m[2][2], 1e-13, "area of thick walls");
    gsl_test_rel(c.centroid[0], yc, 1e-12, "centroid, y");
    gsl_test_rel(c.centroid[1], zc, 1e-12, "centroid, z");
    gsl_test_rel(fmax(c.Iy, c.Iz), mean + radius, 1e-12, "larger second moment of thick walls");
    gsl_test_rel(fmin(c.Iy, c.Iz), mean - radius, 1e-12, "smaller second moment of thick walls");
    gsl_test_rel(c.Ip, yy + zz, 1e-12, "polar moment of thick walls");
    const double a = c.axes_angle,
                 about_y = yy * cos(a) * cos(a) + zz * sin(a) * sin(a) + 2 * yz * sin(a) * cos(a);
    gsl_test_rel(c.Iz, about_y, 1e-12, "Iz belongs to the y axis that was found");
}

/* Compares the torsion constant with Prandtl's stress function as a double series: 256/pi^6 sum
 * over odd m, n of (a b)/(m^2 n^2 (m^2/a^2 + n^2/b^2)). The terms beyond M add less than a third of
 * 1/M^3. */
static void torsion_of_a_rectangle(double a, double b)
{
    double sum = 0;
    for (int m = 999; m >= 1; m -= 2)
        for (int n = 999; n >= 1; n -= 2)
            sum += a * b / ((double)m * m * n * n * (m * m / (a * a) + n * n / (b * b)));
    gsl_test_rel(rectangle(a, b, 0, 0).It, 256 / pow(PI, 6) * sum, 1e-7, "torsion of %g x %g", a,
                 b);
    gsl_test_rel(rectangle(b, a, 0, 0).It, rectangle(a, b, 0, 0).It, 1e-14, "the sides exchanged");
}

static double warping_at(double y, double z, double a, double b)
{
    double omega = y * z;
    for (int n = 0; n < 60; n++) {
        const double k = (2 * n + 1) * PI / 2 / a;
        omega -= (n % 2 ? -4 : 4) / (a * pow(k, 3)) * sin(k * y) *
                 (exp(k * (z - b)) - exp(-k * (z + b))) / (1 + exp(-2 * k * b));
    }
    return omega;
}

static void warping_constant(double width, double height)
{
    enum { N = 20 };
    double x[N], w[N], sum = 0;
    const double a = fmin(width, height) / 2, b = fmax(width, height) / 2;
    quadrature_points(N, x, w);
    for (int i = 0; i < N * N; i++)
        sum += w[i / N] * w[i % N] * pow(warping_at(a * x[i / N], b * x[i % N], a, b), 2);
    gsl_test_rel(rectangle(width, height, 0, 0).Iw, 4 * a * b * sum, 1e-7, "Iw of %g x %g", width,
                 height);
    gsl_test_rel(rectangle(height, width, 0, 0).Iw, rectangle(width, height, 0, 0).Iw, 1e-13,
                 "it knows no side");
    gsl_test_rel(rectangle(1e-4, 1, 0, 0).Iw, 1e-12 / 144, 1e-6, "of a thin one");
}

/* The constant of the torque that is cubic in the twist rate is 1/8 int (r^2 - mean of r^2)^2 dA
 * for any rectangle. */
static void wagner_torque(double width, double height)
{
    enum { N = 5 };
    double x[N], w[N], mean = 0, variance = 0;
    quadrature_points(N, x, w);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < N * N; i++) {
            const double y = (x[i / N] - 0.5) * width, z = (x[i % N] - 0.5) * height,
                         share = w[i / N] * w[i % N], square = y * y + z * z;
            mean += pass == 0 ? share * square : 0;
            variance += pass == 0 ? 0 : share * pow(square - mean, 2);
        }
    const section wide = rectangle(width, height, 0, 0), high = rectangle(height, width, 0, 0);
    const double thin = pow(fmax(width, height), 5) * fmin(width, height) / 1440;
    gsl_test_rel(wide.wagner_torque, variance * width * height / 8, 1e-13,
                 "cubic torque of %g x %g", width, height);
    gsl_test_rel(high.wagner_torque, wide.wagner_torque, 1e-14, "it knows no side");
    gsl_test_rel(wide.wagner_torque / thin, 1 + pow(fmin(width / height, height / width), 4), 1e-13,
                 "beside that of a thin one");
    section_spec given = sections_steel(SECTION_RECTANGLE);
    given.width = width;
    given.height = height;
    given.given.wagner_torque = 3e-9;
    gsl_test_rel(sections_computed(&given).wagner_torque, 3e-9, 1e-15, "another one is given");
}

static void refusals(void)
{
    const struct {
        const char *word;
        size_t offset;
        double value;
    } row[] = {{"young", offsetof(section_spec, young), 0},
               {"shear_modulus", offsetof(section_spec, shear_modulus), -1},
               {"density", offsetof(section_spec, density), -1},
               {"density", offsetof(section_spec, density), NAN},
               {"width", offsetof(section_spec, width), 0},
               {"thickness", offsetof(section_spec, height), INFINITY}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        section c;
        fault f = {""};
        section_spec spec = sections_steel(SECTION_RECTANGLE);
        spec.width = 0.1;
        spec.height = 0.02;
        *(double *)(void *)((char *)&spec + row[i].offset) = row[i].value;
        gsl_test(section_compute(&spec, &c, &f) != STATUS_REFUSED ||
                     strstr(f.text, row[i].word) == NULL,
                 "%s = %g: %s", row[i].word, row[i].value, f.text);
    }
}

static void section_tests(void)
{
    torsion_of_a_rectangle(1, 1);
    /* 1/3 - 64/pi^5 sum over odd n of tanh(n pi/2)/n^5, to 16 digits (mpmath) */
    gsl_test_rel(rectangle(1, 1, 0, 0).It, 0.14057701495515371559, 1e-15, "of a square");
    torsion_of_a_rectangle(2, 1);
    torsion_of_a_rectangle(0.3, 0.06);
    wagner_torque(0.1, 0.0007);
    wagner_torque(0.1, 0.03);
    wagner_torque(0.02, 0.02);
    warping_constant(0.02, 0.02);
    warping_constant(0.03, 0.02);
    warping_constant(0.1, 0.03);
    refusals();
    rectangle_is_a_wall(0.1, 0.02);
    rectangle_is_a_wall(0.1, 0.0003);
    given_factors();
    turned_wall();
    thick_walls();
}

/* Compares closed cells and tubes with closed forms (Bredt 1896; Vlasov 1961), and with other
 * descriptions of the same section. */

static const double h = 0.2, b = 0.09, tf = 0.012, tw = 0.007; /* mid-lines [m] */

static section_spec box_spec(void)
{
    static const double point[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = spec.walls = 4;
    spec.cells = 1;
    for (int i = 0; i < 4; i++) {
        spec.point[i][0] = b * point[i][0];
        spec.point[i][1] = h * point[i][1];
        spec.wall[i].from = i;
        spec.wall[i].to = (i + 1) % 4;
        spec.wall[i].thickness = i % 2 ? tw : tf;
    }
    return spec;
}

static void box(void)
{
    const section_spec spec = box_spec();
    const section c = sections_computed(&spec);
    const double round = 2 * b / tf + 2 * h / tw,
                 corner = b * h / 4 * (h / tw - b / tf) / (h / tw + b / tf);
    gsl_test_rel(c.It, 4 * b * b * h * h / round + 2 * (b * tf * tf * tf + h * tw * tw * tw) / 3,
                 1e-13, "box: Bredt");
    gsl_test_rel(c.Iw, c.A * corner * corner / 3, 1e-12, "box: warping");
    gsl_test_abs(hypot(c.ys, c.zs), 0, 1e-15, "box: shear centre in the middle");
    /* first moment of area at s: tf s h/2 in a flange, where s is measured from its middle, and tf
     * b h/4 + tw (h^2/4 - z^2)/2 in a web */
    const double top = tf * b * h / 4, bow = tw * h * h / 8,
                 square = 4 * tf * h * h / 4 * b * b * b / 24 +
                          2 * h / tw * (top * top + 4.0 / 3 * top * bow + 8.0 / 15 * bow * bow);
    gsl_test_rel(c.F[4], square / (c.Iy * c.Iy), 1e-13, "box: shear along the webs");
}

static void ring(void)
{
    enum { N = 32 };
    const double R = 0.1, t = 0.0001;
    section_spec spec = sections_steel(SECTION_WALLS), tube = sections_steel(SECTION_TUBE);
    spec.points = spec.walls = N;
    spec.cells = 1;
    for (int i = 0; i < N; i++) {
        spec.point[i][0] = R * cos(2 * PI * i / N);
        spec.point[i][1] = R * sin(2 * PI * i / N);
        spec.wall[i].from = i;
        spec.wall[i].to = (i + 1) % N;
        spec.wall[i].thickness = t;
    }
    tube.diameter = 2 * R + t;
    tube.wall_thickness = t;
    const section c = sections_computed(&spec), d = sections_computed(&tube);
    gsl_test_rel(c.It, d.It, 0.02, "ring: torsion");
    gsl_test_rel(c.Iy, d.Iy, 0.02, "ring: bending");
    gsl_test_rel(c.F[0], d.F[0], 0.02, "ring: shear");
    gsl_test(c.Iw != 0, "ring: no warping");
    const double a = N / 2.0 * R * R * sin(2 * PI / N), l = 2 * N * R * sin(PI / N);
    gsl_test_rel(c.It, 4 * a * a * t / l + l * t * t * t / 3, 1e-12, "polygon: Bredt");
}

static void tube_closed_forms(void)
{
    section_spec spec = sections_steel(SECTION_TUBE);
    spec.diameter = 0.06;
    spec.wall_thickness = 0.03;
    const section bar = sections_computed(&spec);
    const double R = 0.03, r = 0.02;
    gsl_test_rel(bar.A, PI * R * R, 1e-14, "bar: area");
    gsl_test_rel(bar.It, PI * pow(R, 4) / 2, 1e-14, "bar: torsion");
    gsl_test_rel(bar.D[0] / bar.A, 6.0 / 7, 1e-14, "bar: shear");
    spec.wall_thickness = 0.01;
    const section c = sections_computed(&spec);
    gsl_test_rel(c.Iy, PI * (pow(R, 4) - pow(r, 4)) / 4, 1e-14, "tube: bending");
    gsl_test_rel(c.Ip, c.It, 1e-14, "tube: polar moment");
    /* int |tau|^2 dA for tau = grad(f cos), f = (a s + b/s - s^3)/8, a = 3 (R^2 + r^2), b = 3 R^2
     * r^2 */
    const double up = 3 * (R * R + r * r) * (pow(R, 4) - pow(r, 4)) / 4 +
                      3 * R * R * r * r * (R * R - r * r) / 2 - (pow(R, 6) - pow(r, 6)) / 6;
    gsl_test_rel(c.F[0], PI / 8 * up / (c.Iz * c.Iz), 1e-13, "tube: shear");
}

static section_spec two_cells(int swapped, double skew)
{
    static const double point[6][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
    static const int wall[7][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}, {1, 4}};
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = 6;
    spec.walls = 7;
    spec.cells = 2;
    for (int i = 0; i < 6; i++) {
        const int p = swapped ? 5 - i : i;
        spec.point[p][0] = b * point[i][0] + (i == 1 || i == 4 ? skew : 0);
        spec.point[p][1] = h * point[i][1];
    }
    for (int i = 0; i < 7; i++) {
        const int w = swapped ? 6 - i : i;
        spec.wall[w].from = swapped ? 5 - wall[i][1] : wall[i][0];
        spec.wall[w].to = swapped ? 5 - wall[i][0] : wall[i][1];
        spec.wall[w].thickness = skew != 0 && i == 6 ? tf : tw;
    }
    return spec;
}

static void cells(void)
{
    const section_spec even = two_cells(0, 0);
    const section c = sections_computed(&even);
    const double area = 2 * b * h, round = (4 * b + 2 * h) / tw,
                 open = (4 * b + 3 * h) * tw * tw * tw / 3;
    gsl_test_rel(c.It, 4 * area * area / round + open, 1e-12, "two equal cells: Bredt");
    const section_spec skew = two_cells(0, 0.02), other = two_cells(1, 0.02);
    const section d = sections_computed(&skew), e = sections_computed(&other);
    /* flows x1, x2 in cells of widths p, q: (2 (p + .)/tw + h/tf) x1 - h/tf x2 = 2 p h, and
     * correspondingly for x2 */
    const double p = b + 0.02, q = b - 0.02, m11 = (2 * p + h) / tw + h / tf,
                 m22 = (2 * q + h) / tw + h / tf, m12 = -h / tf, det = m11 * m22 - m12 * m12;
    const double x1 = (m22 * 2 * p * h - m12 * 2 * q * h) / det,
                 x2 = (m11 * 2 * q * h - m12 * 2 * p * h) / det;
    gsl_test_rel(d.It,
                 2 * h * (p * x1 + q * x2) + ((4 * b + 2 * h) * pow(tw, 3) + h * pow(tf, 3)) / 3,
                 1e-12, "two cells: Bredt");
    gsl_test_rel(e.It, d.It, 1e-12, "two cells, other order: torsion");
    gsl_test_rel(e.Iw, d.Iw, 1e-11, "two cells, other order: warping");
    gsl_test_abs(e.ys, d.ys, 1e-15, "two cells, other order: shear centre");
    gsl_test(!(fabs(d.ys) > 1e-4), "two unequal cells: the shear centre moves");
    for (int i = 0; i < 9; i++)
        gsl_test_abs(e.F[i] * sqrt(d.D[4 * (i / 3)] * d.D[4 * (i % 3)]),
                     d.F[i] * sqrt(d.D[4 * (i / 3)] * d.D[4 * (i % 3)]), 1e-12,
                     "two cells, other order: shear %d", i);
}

static void points_between(void)
{
    section_spec one = box_spec();
    one.point[4][0] = 0.5 * b + 0.04;
    one.point[4][1] = one.point[1][1];
    one.points = one.walls = 5;
    one.wall[4].from = 1;
    one.wall[4].to = 4;
    one.wall[4].thickness = tw;
    section_spec two = one;
    two.points = two.walls = 6;
    two.point[5][0] = 0.5 * b;
    two.point[5][1] = 0.1 * h;
    two.wall[5] = two.wall[1];
    two.wall[1].to = two.wall[5].from = 5;
    const section c = sections_computed(&one), d = sections_computed(&two);
    gsl_test_rel(d.It, c.It, 1e-13, "a point in between: torsion");
    gsl_test_rel(d.Iw, c.Iw, 1e-11, "a point in between: warping");
    gsl_test_rel(d.zs, c.zs, 1e-11, "a point in between: shear centre");
    for (int i = 0; i < 9; i++)
        gsl_test_rel(d.F[i], c.F[i], 1e-10, "a point in between: shear %d", i);
}

static void refusal(const section_spec *spec, const char *word)
{
    section c;
    fault f = {""};
    const status got = section_compute(spec, &c, &f);
    gsl_test(got != STATUS_REFUSED || strstr(f.text, word) == NULL, "'%s': %s", word, f.text);
}

static void cells_refusals(void)
{
    section_spec spec = box_spec();
    spec.cells = 0;
    refusal(&spec, "wall 3 (points 3-0) closes a cell; open the cell, or give the number");
    spec.cells = 2;
    refusal(&spec, "number of cells: 1 closed by walls, 2 given");
    spec = two_cells(0, 0);
    spec.cells = 1;
    refusal(&spec, "closes a cell; correct the number");
    spec = sections_steel(SECTION_TUBE);
    spec.diameter = 0.02;
    spec.wall_thickness = 0.011;
    refusal(&spec, "thickness of the tube is 0.011");
    spec.diameter = -1;
    refusal(&spec, "diameter of the tube is -1");
}

static void cells_tests(void)
{
    box();
    ring();
    tube_closed_forms();
    cells();
    points_between();
    cells_refusals();
}

int main(void)
{
    section_tests();
    cells_tests();
    return gsl_test_summary();
}
