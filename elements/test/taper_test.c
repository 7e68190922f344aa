/* Sections that change along a member: their ends, their middle, and what is refused. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/section/taper.h"
#include "elements/test/sections.h"

/* Doubly symmetric, web along z. */
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
    /* two flanges with 1.5 mm x 45 mm at 50 mm: Iw = 2 t b^3/12 (h/2)^2 */
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

/* Walls along z, or oblique, beside the shear centre: the web along an axis turned by an angle. */
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

int main(void)
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
    return gsl_test_summary();
}
