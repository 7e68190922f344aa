/* Largest and least values of what a motion has where its steps end: a peak between stations is
 * found, and between steps with the order of the cubic; a window; a jump of what acts. */
#include <math.h>

#include "harness/time/test/swung.h"

enum { STEP, JUMPS, PARAMETERS };

/* One station at the end: all that rises and falls before is between stations. */
static status build(const double value[], scene *s, fault *f)
{
    static const double end[] = {2.5};
    (void)f;
    const swung of = swung_build(s);
    scene_motion how = swung_motion(SCENE_RADAU, value[STEP]);
    if (value[JUMPS] != 0) {
        const int push = scene_add_load(s, SCENE_FORCE, of.base, 4, 0, 0);
        scene_load_piece(s, push, 1, "1");
        scene_load_piece(s, push, 0, "0");
    }
    const int motion = scene_add_motion(s, SCENE_NONE, 1, end, how);
    const scene_extract what[] = {scene_balance_of(SCENE_KINETIC), scene_balance_of(SCENE_STRAIN),
                                  scene_internal_at(of.member, 0.5, SCENE_MZ),
                                  scene_internal_at(of.member, 0.3, SCENE_N)};
    static const char *const name[] = {"kinetic", "strain", "Mz", "N"};
    for (int i = 0; i < 4; i++)
        scene_add_quantity(s, name[i], "", motion, what[i])->reduction = SCENE_MAX;
    scene_set_passing(scene_add_quantity(s, "when", "s", motion, what[1]), SCENE_MAX_TIME,
                      (scene_passing){.until = 0});
    scene_set_passing(scene_add_quantity(s, "window", "", motion, what[0]), SCENE_MIN,
                      (scene_passing){.from = 0.777, .until = 1.111});
    return STATUS_OK;
}

static const parameter_type table[] = {
    [STEP] = {"step", "s", 0.02, 1e-6, 1, NULL, "of it"},
    [JUMPS] = {"jumps", "1", 0, 0, 1, NULL, "is there a push that ends"},
    {0}};
static const case_type flown = {.name = "peaks", .parameters = {table}, .build = build};

int main(void)
{
    static const double step[] = {0.04, 0.02, 0.00125};
    enum { RUNS = 3, WHEN = 4, READ = 6 };
    for (int jumps = 0; jumps < 2; jumps++) {
        double value[RUNS][READ];
        for (int i = 0; i < RUNS; i++) {
            cell_result out;
            swung_solve(&flown, (const double[]){step[i], jumps}, PARAMETERS, &out);
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
