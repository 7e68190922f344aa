/* Stresses at the points of sections: integrated over the walls they are the resultants that made
 * them; a rectangle's torsion is Saint-Venant's, whose published coefficients are Timoshenko's
 * (Theory of Elasticity, 1970, section 109). */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/pi.h"
#include "elements/section/stress.h"
#include "elements/test/sections.h"

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

/* T = k1 (2a)^2 2b tau, b/a: Timoshenko's table. */
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

/* The stress function's slope at the middles of the sides, by the double sine series. */
static void torsion_exact(void)
{
    const double t = 0.02, w = 0.03;
    const section_spec spec = rectangle_spec(w, t);
    const section c = sections_computed(&spec);
    const stress_points p = points_of(&spec, &c);
    double shorter = 0; /* single series in 1/cosh of the other direction */
    for (int n = 1; n < 200; n += 2)
        shorter += 1 / (n * n * cosh(n * PI * t / (2 * w)));
    for (int i = 0; i < p.count;
         i++) /* tau_xy at z = w/2: the long side of the rectangle seen from z */
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

/* Resultants of the stresses that resultants make in walls: Simpson's rule is exact, for all are
 * quadratic along a wall. */
static void integrated(const char *name, const section_spec *spec)
{
    static const double by[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    const section c = sections_computed(spec);
    const stress_points p = points_of(spec, &c);
    for (int k = 0; k < 4; k++) {
        double Q[2] = {0}, torque = 0;
        int from = 0;
        while (from <
               p.count) { /* ends and middle of a wall on both surfaces, then more points of it */
            const stress_point *at = &p.point[from];
            const double length = hypot(at[4].y - at[0].y, at[4].z - at[0].z);
            double t = 0;
            for (int w = 0; w < spec->walls; w++) { /* walls of the tests differ in length */
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
                torque += share * ((at[i].y - c.ys) * tau[1] - (at[i].z - c.zs) * tau[0]);
            }
            if (k ==
                3) /* what varies through the wall: half of t^3/3, the other half is across it */
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

int main(void)
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
                 strstr(f.text, "no points") == NULL,
             "given constants are refused (%s)", f.text);
    return gsl_test_summary();
}
