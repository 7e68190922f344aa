/* Motions that go on from each other are one motion, bit for bit; where the error of steps is
 * estimated too, but for the round-off of a factorisation that pivots anew. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/tools/kit/scenes.h"

#define RESUME_SWUNG "harness/time/test/swung.yaml"

/* A load that jumps at 0.5 s: there steps end, whoever walks across. joint: of a rod at the tip. */
static void same_linked(const char *name, int scheme, double tolerance, int parts, int joint)
{
    cell_result one, more;
    cell_result *const in[] = {&one, &more};
    for (int i = 0; i < 2; i++)
        scenes_solve(
            RESUME_SWUNG, "collocation", 1, in[i],
            "load=kick;read=balance;integrator=%s;step=%.17g;tolerance=%g;second=%s;parts=%d",
            scenes_integrator[scheme], 1 / 64.0, tolerance, joint ? "turns_and_slides" : "none",
            i == 0 ? 1 : parts);
    for (int i = 0; i < one.solve.quantities; i++) {
        gsl_test(one.solve.quantity[i].status != STATUS_OK, "%s: %s: %s", name,
                 one.scene.quantity[i].name, one.solve.quantity[i].reason);
        const double x = one.solve.quantity[i].value, y = more.solve.quantity[i].value;
        const int differs = tolerance > 0 ? !(fabs(x - y) <= 1e-11 * fmax(1, fabs(x)))
                                          : memcmp(&x, &y, sizeof x) != 0;
        gsl_test(differs, "%s in %d parts: %s is %.17g, in one %.17g", name, parts,
                 one.scene.quantity[i].name, y, x);
    }
    gsl_test_int(more.solve.steps, one.solve.steps, "%s: steps in %d parts", name, parts);
    gsl_test_int(more.solve.motions, one.solve.motions + parts - 1, "%s: records in %d parts", name,
                 parts);
    gsl_test(one.solve.steps < 20, "%s: %d steps", name, one.solve.steps);
    cell_result_free(&one);
    cell_result_free(&more);
}

static void same(const char *name, int scheme, double tolerance, int parts)
{
    same_linked(name, scheme, tolerance, parts, 0);
}

int main(void)
{
    same("alpha", SCENE_ALPHA, 0, 3);
    same("conserving", SCENE_CONSERVING, 0, 3);
    same("radau", SCENE_RADAU, 0, 3);
    same("explicit", SCENE_EXPLICIT, 0, 3);
    same("alpha", SCENE_ALPHA, 1e-5, 2);
    same("radau", SCENE_RADAU, 1e-7, 2);
    same_linked("alpha with a joint", SCENE_ALPHA, 0, 3, 1);
    same_linked("conserving with a joint", SCENE_CONSERVING, 0, 3, 1);
    return gsl_test_summary();
}
