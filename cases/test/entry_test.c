/* What is derived from the tables of entries: other units, ranges, comparison, exchanged ends. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"

static void has_powers(void)
{
    static const struct {
        const char *unit;
        int length, force;
    } all[] = {{"m^4", 4, 0},         {"1/m", -1, 0},     {"kg", -1, 1},     {"kg/m^3", -4, 1},
               {"kg m^2", 1, 1},      {"Pa", -2, 1},      {"N/m", -1, 1},    {"m/s^2", 1, 0},
               {"rad/(N m)", -1, -1}, {"kg m^2/s", 1, 1}, {"N m/rad", 1, 1}, {"rad/s", 0, 0}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        gsl_test_int(entry_power(all[i].unit, ENTRY_LENGTH), all[i].length, "length in %s",
                     all[i].unit);
        gsl_test_int(entry_power(all[i].unit, ENTRY_FORCE), all[i].force, "force in %s",
                     all[i].unit);
    }
}

static scene_node some_node(void)
{
    return (scene_node){.position = {1, 2, 3},
                        .attached = SCENE_NONE,
                        .rotation = SCENE_ROTATION_FORK,
                        .axis = {{1, 0, 0}, {0, 1, 0}},
                        .body = {.mass = 7, .inertia = {5, 5, 5}}};
}

static void is_scaled(void)
{
    scene_node n = some_node();
    entry_scale(entry_node, &n, ENTRY_LENGTH, 10);
    gsl_test_rel(n.position[2], 30, 1e-15, "position");
    gsl_test_rel(n.body.mass, 0.7, 1e-15, "mass");
    gsl_test_rel(n.body.inertia[1], 50, 1e-15, "inertia");
    gsl_test_rel(n.axis[1][1], 1, 1e-15, "a direction has no length");
}

static void is_compared(void)
{
    const scene_node n = some_node();
    scene_node other = n;
    gsl_test(!entry_same(entry_node, &n, &other), "the same");
    other.axis[1][2] = 1e-300;
    gsl_test(entry_same(entry_node, &n, &other), "another web of the fork");
    other.rotation = SCENE_ROTATION_SPATIAL;
    gsl_test(entry_same(entry_node, &n, &other), "no fork");
    other = n;
    other.body.centre[0] = -0.0;
    gsl_test(entry_same(entry_node, &n, &other), "bit for bit");
}

static void is_in_range(void)
{
    const scene s = {.nodes = 2};
    scene_member m = {.p = 0, .q = 1, .damping = 1};
    fault f = {""};
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_OK, "in range");
    m.divisions = -3;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "divisions = -3; give a whole number from 0 to 10000000") != 0,
             "below: %s", f.text);
    m.divisions = 0;
    m.damping = INFINITY;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "damping = inf; give at least 0") != 0,
             "endless: %s", f.text);
    m.damping = 0;
    m.curvature[1] = NAN;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED, "no number");
    m.curvature[1] = 0;
    m.q = 2;
    gsl_test(entry_check(&s, entry_member, &m, &f) != STATUS_REFUSED ||
                 strcmp(f.text, "to: node 2 does not exist; add the node first") != 0,
             "no node: %s", f.text);
}

static void is_mirrored(void)
{
    scene_member m = {.y_axis = {1, 2, 3}, .curvature = {0, 5, 7}};
    entry_mirror(entry_member, &m);
    gsl_test_rel(m.y_axis[1], -2, 0, "y");
    gsl_test_rel(m.curvature[1], 5, 0, "curvature about y");
    gsl_test_rel(m.curvature[2], -7, 0, "curvature about z");
}

int main(void)
{
    has_powers();
    is_scaled();
    is_compared();
    is_in_range();
    is_mirrored();
    return gsl_test_summary();
}
