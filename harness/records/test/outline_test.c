/* Outlines at both ends of a member whose section changes: walls and corners belong together. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/test/sections.h"
#include "harness/records/records_impl.h"

/* High at one end, wide at the other: corners stay in their quadrants. */
static void rectangles(void)
{
    const section_spec high = section_spec_rectangle(2e11, 8e10, 0.1, 0.2),
                       wide = section_spec_rectangle(2e11, 8e10, 0.3, 0.1);
    const section c[2] = {sections_computed(&high), sections_computed(&wide)};
    outline near, far, half;
    outline_of(&high, &c[0], &near);
    outline_of_far_end(&wide, &c[1], &c[0], &far);
    gsl_test_int(near.walls, far.walls, "walls of a rectangle");
    outline_between(&near, &far, 0.5, &half);
    for (int k = 0; k < 4; k++) {
        const double *a = near.corner[0][k], *b = far.corner[0][k], *h = half.corner[0][k];
        gsl_test(!(a[0] * b[0] > 0 && a[1] * b[1] > 0), "corner %d stays in its quadrant", k);
        gsl_test_rel(fabs(a[0]), 0.1, 1e-14, "corner %d, near: y", k);
        gsl_test_rel(fabs(b[0]), 0.05, 1e-14, "corner %d, far: y", k);
        gsl_test_rel(fabs(h[0]), 0.075, 1e-14, "corner %d, between: y", k);
        gsl_test_rel(fabs(h[1]), 0.1, 1e-14, "corner %d, between: z", k);
    }
}

/* A rectangle of the same radii of inertia stands for matrices. */
static void matrices(void)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = SECTION_MATRICES;
    double *C = spec.constants.stiffness;
    const double EA = 3e7, b = 0.05, h = 0.02;
    C[0] = C[7] = C[14] = EA;
    C[21] = 100;
    C[28] = EA * b * b / 12;
    C[35] = EA * h * h / 12;
    const section c = sections_computed(&spec);
    outline o;
    outline_of(&spec, &c, &o);
    gsl_test_int(o.equivalent, 1, "it stands for the section");
    for (int k = 0; k < 4; k++) {
        gsl_test_rel(fabs(o.corner[0][k][0]), h / 2, 1e-14, "corner %d of matrices: y", k);
        gsl_test_rel(fabs(o.corner[0][k][1]), b / 2, 1e-14, "corner %d of matrices: z", k);
    }
}

int main(void)
{
    rectangles();
    matrices();
    return gsl_test_summary();
}
