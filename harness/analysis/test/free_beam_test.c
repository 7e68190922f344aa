/* A beam that nothing holds: six motions of a rigid body at no frequency, then those of the free
 * beam, (k_i L)^2 sqrt(EI/(rho A L^4)) with cos(k_i L) cosh(k_i L) = 1. The stiffness matrix is
 * singular; its shift must leave no trace in the frequencies. */
#include <gsl/gsl_math.h>
#include <gsl/gsl_test.h>
#include <math.h>

#include "elements/math/pi.h"
#include "harness/tools/kit/scenes.h"

enum { MODES = 10, RIGID = 6 };
static const double length = 2.385, thickness = 0.011, width = 0.017, young = 2.1e11,
                    density = 7300; /* m, m, m, Pa, kg/m^3 */
static const double root[2] = {4.7300407448627040, 7.8532046240958376};

/* 0: bending about the weak axis, then about the strong one, then the second of each. */
static double exact(int i)
{
    const double height = i % 2 == 0 ? thickness : width, k = root[i / 2] / length;
    return k * k * sqrt(young * height * height / 12 / density) / (2 * PI);
}

static void frequencies(const char *name, int elements, double allowed)
{
    cell_result r;
    scenes_solve("harness/analysis/test/bars.yaml", name, elements, &r, "bar=free");
    for (int i = 0; i < MODES && i < r.solve.quantities; i++) {
        const double value = r.solve.quantity[i].value;
        if (i < RIGID)
            gsl_test_abs(value, 0, 1e-3 * exact(0), "%s: motion %d of a rigid body", name, i);
        else
            gsl_test_rel(value, exact(i - RIGID), allowed, "%s: frequency %d", name, i - RIGID);
    }
    gsl_test_int(r.solve.quantities, MODES, "all of them");
    cell_result_free(&r);
}

int main(void)
{
    frequencies("beamw_vlasov", 32, 1e-5);
    frequencies("beamw_first", 32, 1e-5);
    /* so many elements that assembling them changes the stiffness: solutions are refined */
    frequencies("beamw_vlasov", 600, 2e-7);
    frequencies("beamw_vlasov", 2400, 2e-7);
    return gsl_test_summary();
}
