/* What the mass inside of an element adds to its frequencies (elements/field/field_mass.h): every
 * entry against the exact dynamic stiffness of uniform beams. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/field/field_mass.h"
#include "elements/test/sections.h"

static const double inner_l0 = 0.8;

static void add_inner(int i, int j, double value, double B[FIELD_INNER * FIELD_INNER])
{
    B[i * FIELD_INNER + j] = B[j * FIELD_INNER + i] = value;
}

/* B of a uniform element is what stands with -omega^4 in the power series of its exact dynamic
 * stiffness: z = omega l sqrt(rho/E) in z cot(z), z/sin(z) of rods and shafts, z^4 = rho A
 * omega^2 l^4/(E I) in Bernoulli's beam, (59 z^8/161700) E I/l^3 and so on. */
int main(void)
{
    const double A = 0.2, I[3] = {0.013, 0.007, 0.009}, density = 3, stiffness[2] = {A, 0.009},
                 mass[2] = {density * A, density * 0.02};
    section_spec spec = sections_of(A, I[0], I[1], I[2]);
    spec.density = density;
    const section c = sections_computed(&spec);
    const element_request request = {.section = &c, .length = inner_l0, .features = FEATURE_MASS};
    displacement_field f;
    double B[FIELD_INNER * FIELD_INNER], exact[FIELD_INNER * FIELD_INNER] = {0};
    field_prepare(&request, 2, &f);
    field_inner(&request, &f, B);
    for (int k = 0; k < 2; k++) {
        const int p = 3 * k, q = NODE_COORDINATES + p;
        const double b = mass[k] * mass[k] * inner_l0 * inner_l0 * inner_l0 / stiffness[k];
        add_inner(p, p, b / 45, exact);
        add_inner(q, q, b / 45, exact);
        add_inner(p, q, b * 7 / 360, exact);
    }
    for (int across = 1; across < 3; across++) {
        const int v = across, w = NODE_COORDINATES + v, t = across == 1 ? 5 : 4,
                  u = NODE_COORDINATES + t;
        const double b = mass[0] * mass[0] * pow(inner_l0, 5) / I[across == 1 ? 1 : 0],
                     l = across == 1 ? inner_l0 : -inner_l0;
        for (int side = 0; side < 2; side++) {
            add_inner(side ? w : v, side ? w : v, b * 59 / 161700, exact);
            add_inner(side ? u : t, side ? u : t, b * inner_l0 * inner_l0 * 71 / 4365900, exact);
            add_inner(side ? w : v, side ? u : t, (side ? -1 : 1) * b * l * 223 / 2910600, exact);
            add_inner(side ? w : v, side ? t : u, (side ? 1 : -1) * b * l * 1681 / 23284800, exact);
        }
        add_inner(v, w, b * 1279 / 3880800, exact);
        add_inner(t, u, -b * inner_l0 * inner_l0 * 1097 / 69854400, exact);
    }
    for (int i = 0; i < FIELD_INNER; i++)
        for (int j = 0; j < FIELD_INNER; j++) {
            const double size = sqrt(exact[i * (FIELD_INNER + 1)] * exact[j * (FIELD_INNER + 1)]);
            gsl_test(!(fabs(B[i * FIELD_INNER + j] - exact[i * FIELD_INNER + j]) <= 1e-11 * size),
                     "B[%d][%d] = %.12g, not %.12g", i, j, B[i * FIELD_INNER + j],
                     exact[i * FIELD_INNER + j]);
        }
    return gsl_test_summary();
}
