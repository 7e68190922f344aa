/* Springs: their derivatives against differences, whatever the turn between their ends; nothing
 * while both ends move as one; and the deformations that are known. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/test/nodes.h"
#include "elements/test/random.h"
#include "elements/test/worst.h"
#include "harness/model/model.h"

static void two_ends(const element_data *data, const node_state x[], strain_output *out)
{
    (void)data;
    spring_strain(2, x, NULL, out);
}

static void to_ground(const element_data *data, const node_state x[], strain_output *out)
{
    (void)data;
    spring_strain(1, x, NULL, out);
}

static const element_type spring[2] = {{.name = "to ground", .strain = to_ground},
                                       {.name = "two ends", .strain = two_ends}};

enum { SPRING_MOST = 2 * NODE_COORDINATES };

static void turn_end(double angle, uint64_t *seed, node_state *x)
{
    double axis[3], size = 0;
    for (int i = 0; i < 3; i++) {
        axis[i] = random_number(seed);
        size += axis[i] * axis[i];
    }
    for (int i = 0; i < 3; i++)
        axis[i] *= angle / sqrt(size);
    nodes_turn(x->R, axis);
}

static void derivatives(int nodes, double angle, uint64_t *seed)
{
    double d[SPRING_MOST], s[SPRING_STRAINS];
    node_state x[2];
    nodes_straight(2, 0.31, x);
    nodes_increments(nodes, 0.31, 1, (unsigned)random_bits(seed), d);
    nodes_move(nodes, 1, d, x);
    turn_end(angle, seed, &x[nodes - 1]);
    nodes_increments(nodes, 0.31, 1, (unsigned)random_bits(seed), d);
    for (int k = 0; k < nodes; k++)
        d[NODE_COORDINATES * k + 6] = 0;
    for (int i = 0; i < SPRING_STRAINS; i++)
        s[i] = random_number(seed) * (i < 3 ? 1 : 0.31);
    const nodes_departure found =
        nodes_differences(&spring[nodes - 1], NULL, nodes, SPRING_STRAINS, x, d, s);
    gsl_test(!(found.first < 1e-8), "%s, turn %g: first derivatives (%.1e)", spring[nodes - 1].name,
             angle, found.first);
    gsl_test(!(found.second < 1e-7), "%s, turn %g: second derivatives (%.1e)",
             spring[nodes - 1].name, angle, found.second);
    gsl_test(!(found.asymmetry < 1e-14), "%s, turn %g: symmetric (%.1e)", spring[nodes - 1].name,
             angle, found.asymmetry);
}

/* Both ends move as one rigid body: nothing; then one turns about an axis of the other. */
static void known(uint64_t *seed)
{
    double d[SPRING_MOST], e[SPRING_STRAINS];
    node_state x[2];
    nodes_straight(2, 0.31, x);
    nodes_increments(1, 0.31, 1, (unsigned)random_bits(seed), d);
    for (int i = 0; i < 3; i++)
        x[1].u[i] = x[0].u[i] = 0;
    nodes_turn(x[0].R, d + 3);
    memcpy(x[1].R, x[0].R, sizeof x[1].R);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] = x[0].r[i] + 0.31 * x[0].R[3 * i];
        x[1].u[i] = x[1].r[i] - (i == 0 ? 0.31 : 0);
    }
    spring_strain(2, x, NULL, &(strain_output){.e = e});
    for (int i = 0; i < SPRING_STRAINS; i++)
        gsl_test(!(fabs(e[i]) < 4e-16), "rigid motion: no deformation %d (%.1e)", i, e[i]);
    const double y[3] = {0.7 * x[0].R[1], 0.7 * x[0].R[4], 0.7 * x[0].R[7]};
    nodes_turn(x[1].R, y);
    for (int i = 0; i < 3; i++) {
        x[1].r[i] += 0.02 * x[0].R[3 * i + 2];
        x[1].u[i] += 0.02 * x[0].R[3 * i + 2];
    }
    spring_strain(2, x, NULL, &(strain_output){.e = e});
    gsl_test_rel(e[2], 0.02, 1e-13, "pulled along its z axis");
    gsl_test_rel(e[4], 0.7, 1e-14, "turned about its y axis");
    gsl_test(!(fabs(e[0]) + fabs(e[1]) + fabs(e[3]) + fabs(e[5]) < 1e-15), "and nothing else");
}

int main(void)
{
    static const double angle[] = {0, 1e-9, 1e-3, 0.2, 0.6, 0.72, 1.3, 2.4, 2.9};
    uint64_t seed = 11;
    for (int nodes = 1; nodes <= 2; nodes++)
        for (size_t i = 0; i < sizeof angle / sizeof angle[0]; i++)
            derivatives(nodes, angle[i], &seed);
    known(&seed);
    return gsl_test_summary();
}
