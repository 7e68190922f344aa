/* Resultants between the nodes of a motion, against a closed form: of a rod along x that is spun
 * about z through its end, r = sin(k X)/(k cos(k L)), N = EA (cos(k X)/cos(k L) - 1), k^2 = m
 * w^2/EA, which for small strains is m w^2 (L^2 - X^2)/2. Order 2, at nodes and between them, as
 * the lumped masses. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/tools/kit/scenes.h"

extern const element_type element_geometrically_exact, element_collocation;

#define NODES_RODS "harness/time/test/rods.yaml"

enum { PLACES = 3, MESHES = 4 };
static const double length = 2, nodes_omega = 3, EA = 200, mass = 1.5,
                    place[PLACES] = {0, 0.3, 0.5};

static double expected(int i)
{
    const double k = sqrt(mass / EA) * nodes_omega;
    return EA * (cos(k * place[i] * length) / cos(k * length) - 1);
}

/* order: least one between the two finest meshes; of 2 also the highest. */
static void spin(const element_type *type, scene_scheme scheme, double order)
{
    double error[MESHES][PLACES];
    for (int n = 0; n < MESHES; n++) {
        answer a;
        scenes_ask(NODES_RODS, type, 2 << n, &a, "of=spun;end=0.02;step=5e-4;integrator=%s",
                   scenes_integrator[scheme]);
        for (int i = 0; i < PLACES; i++) {
            const char name[] = {'N', (char)('0' + i), 0};
            error[n][i] = fabs(answer_of(&a, name) / expected(i) - 1);
        }
        gsl_test(!(fabs(answer_of(&a, "largest") / answer_of(&a, "N0") - 1) < 1e-9),
                 "%s: most where it is held (%s)", type->name, a.reason);
    }
    for (int i = 0; i < PLACES; i++) {
        const double last = error[MESHES - 1][i], found = log2(error[MESHES - 2][i] / last);
        gsl_test(
            !(((found > order - 0.2 && (order > 2 || found < 2.2)) || last < 1e-8) && last < 2e-4),
            "%s: N at %g: errors %.3g %.3g %.3g %.3g, order %.3g", type->name, place[i],
            error[0][i], error[1][i], error[2][i], last, found);
    }
}

int main(void)
{
    spin(&element_collocation, SCENE_CONSERVING, 2);
    spin(&element_collocation, SCENE_RADAU, 2);
    spin(&element_geometrically_exact, SCENE_CONSERVING, 3); /* three nodes: at nodes 4 */
    spin(&element_geometrically_exact, SCENE_RADAU, 3);
    return gsl_test_summary();
}
