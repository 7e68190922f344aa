/* Largest and least values of what a motion has where its steps end: a peak between stations is
 * found, and between steps with the order of the cubic; a window; a jump of what acts. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/tools/kit/scenes.h"

#define PEAKS_SWUNG "harness/time/test/swung.yaml"

/* One station at the end: all that rises and falls before is between stations. */
int main(void)
{
    static const double step[] = {0.04, 0.02, 0.00125};
    enum { RUNS = 3, WHEN = 4, READ = 6 };
    for (int jumps = 0; jumps < 2; jumps++) {
        double value[RUNS][READ];
        for (int i = 0; i < RUNS; i++) {
            cell_result out;
            scenes_solve(PEAKS_SWUNG, "collocation", 1, &out,
                         "read=peaks;end=2.5;integrator=radau;step=%g;load=%s", step[i],
                         jumps ? "push" : "none");
            for (int k = 0; k < READ; k++) {
                value[i][k] = out.solve.quantity[k].value;
                gsl_test(!isfinite(value[i][k]), "quantity %d with %g s", k, step[i]);
            }
            cell_result_free(&out);
        }
        for (int k = 0; k < READ; k++) {
            const double size = fabs(value[2][k]), coarse = fabs(value[0][k] - value[2][k]) / size,
                         fine = fabs(value[1][k] - value[2][k]) / size;
            gsl_test(!(fine < 1e-3 && (k == WHEN || fine < coarse / 6 || fine < 1e-5)),
                     "quantity %d, jumps %d: %.9g, errors %.3g %.3g", k, jumps, value[2][k], coarse,
                     fine);
        }
    }
    return gsl_test_summary();
}
