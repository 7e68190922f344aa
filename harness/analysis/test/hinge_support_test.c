/* An end that is released from a clamped node is one at a support that lets it go: in every
 * analysis, by every formulation and way of Newton. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/scenes.h"

#define SPRINGS "harness/analysis/test/springs.yaml"

/* A released end of a clamped node and a support that lets the end go. */
static void supported(const char *chosen, int dense)
{
    static const char *const released[] = {"hinge", "two_turns", "ball", "slide"};
    for (int k = 0; k < 4; k++) {
        cell_result at_support, at_node;
        scenes_solve(SPRINGS, chosen, 4, &at_support, "of=support;released=%s;about=%d",
                     released[k], !dense);
        scenes_solve(SPRINGS, chosen, 4, &at_node, "of=end;released=%s;about=%d", released[k],
                     !dense);
        const int asked = dense ? 19 : 23;
        gsl_test(at_node.solve.quantities != asked || at_support.solve.quantities != asked,
                 "%s, %s: %d quantities", chosen, released[k], at_node.solve.quantities);
        for (int i = 0; i < at_node.solve.quantities; i++) {
            const double expected = at_support.solve.quantity[i].value,
                         value = at_node.solve.quantity[i].value;
            gsl_test(!(fabs(value - expected) <= 1e-8 * fabs(expected) + 1e-11),
                     "%s, %s: %s is %.12g, at a support %.12g (%s)", chosen, released[k],
                     at_node.scene.quantity[i].name, value, expected,
                     at_node.solve.quantity[i].reason);
        }
        cell_result_free(&at_support);
        cell_result_free(&at_node);
    }
}

int main(void)
{
    static const char *const newton[] = {"", ":newton=displacement", ":newton=dense"};
    for (int i = 0; registry_formulations[i] != NULL; i++)
        for (int k = 0; k < 3; k++) {
            char chosen[80];
            snprintf(chosen, sizeof chosen, "%s%s", registry_formulations[i]->name, newton[k]);
            supported(chosen, k == 2); /* without what follows a factored tangent */
        }
    return gsl_test_summary();
}
