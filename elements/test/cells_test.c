/* Closed cells and tubes against closed forms (Bredt 1896; Vlasov 1961), and against other
 * descriptions of themselves. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/test/sections.h"

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
    /* S = tf s h/2 in a flange from its middle; tf b h/4 + tw (h^2/4 - z^2)/2 in a web */
    const double top = tf * b * h / 4, bow = tw * h * h / 8,
                 square = 4 * tf * h * h / 4 * b * b * b / 24 +
                          2 * h / tw * (top * top + 4.0 / 3 * top * bow + 8.0 / 15 * bow * bow);
    gsl_test_rel(c.F[4], square / (c.Iy * c.Iy), 1e-13, "box: shear along the webs");
}

/* A regular polygon: a thin ring in the limit, with errors of 1/n^2. */
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
    /* the polygon itself: area a = N/2 R^2 sin(2 pi/N), length l = 2 N R sin(pi/N) */
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

/* Two cells of equal size on a common web: in torsion nothing flows through it (Bredt of the outer
 * wall). */
static section_spec two_cells(int swapped, double skew)
{
    static const double point[6][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
    static const int wall[7][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}, {1, 4}};
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = 6;
    spec.walls = 7;
    spec.cells = 2;
    for (int i = 0; i < 6; i++) { /* swapped: other root, walls backwards and in the other order */
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
    /* cells of widths p, q: (2 (p + .)/tw + h/tf) x1 - h/tf x2 = 2 p h, and so on */
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

/* A fin on a box, and walls cut in two: nothing changes by points in between. */
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
    refusal(&spec, "wall 3 (points 3-0) closes a cell; open it, or give the number");
    spec.cells = 2;
    refusal(&spec, "close 1 of the 2 cells");
    spec = two_cells(0, 0);
    spec.cells = 1;
    refusal(&spec, "closes a cell; give the number");
    spec = sections_steel(SECTION_TUBE);
    spec.diameter = 0.02;
    spec.wall_thickness = 0.011;
    refusal(&spec, "thickness of the tube is 0.011");
    spec.diameter = -1;
    refusal(&spec, "diameter of the tube is -1");
}

int main(void)
{
    box();
    ring();
    tube_closed_forms();
    cells();
    points_between();
    cells_refusals();
    return gsl_test_summary();
}
