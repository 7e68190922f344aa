/* Axes of released ends: those in which the section is described, whatever its principal ones; of a
 * curved member those at its end. The nodes are clamped, so that their reactions have no part along
 * them. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/analysis/test/hinged.h"
#include "harness/formulations/registry.h"

enum { REACTIONS = 3 };

static void clamped_ends(scene *s, int first, int last, int member)
{
    static const double end = 1;
    static const char *const name[2][REACTIONS] = {{"from_x", "from_y", "from_z"},
                                                   {"to_x", "to_y", "to_z"}};
    scene_hold_all(s, first);
    scene_hold_all(s, last);
    scene_add_load(s, SCENE_DISTRIBUTED, member, 0.3, -2, 3);
    const int path = scene_add_static(s, 1, &end, 2);
    for (int i = 0; i < 2 * REACTIONS; i++)
        scene_add_quantity(s, name[i / REACTIONS][i % REACTIONS], "N m", path,
                           scene_reaction(i < REACTIONS ? first : last, SCENE_RX + i % REACTIONS));
}

/* Legs of unequal length: the principal axes are turned by some 20 degrees. Hinges about z, and y
 * and x. */
static status build_angle(const double value[], scene *s, fault *f)
{
    (void)value;
    (void)f;
    section_spec spec = sections_steel(SECTION_WALLS);
    spec.points = 3;
    spec.walls = 2;
    spec.young = 2e5;
    spec.shear_modulus = 8e4;
    spec.point[1][0] = 0.1;
    spec.point[2][1] = 0.05;
    spec.wall[0].to = 1;
    spec.wall[1].to = 2;
    spec.wall[0].thickness = spec.wall[1].thickness = 0.01;
    const int profile = scene_add_section(s, &spec), first = scene_add_node(s, 0, 0, 0),
              last = scene_add_node(s, 1, 0, 0),
              member = scene_add_member(s, first, last, profile, y_axis);
    clamped_ends(s, first, last, member);
    s->load[0].vector[1] = -0.02;
    s->load[0].vector[2] = 0.03;
    s->load[0].vector[0] = 0.01;
    scene_release_end(s, member, 0, SCENE_RZ);
    scene_release_end(s, member, 1, SCENE_RY);
    return STATUS_OK;
}

/* A quarter of a circle from the tangent x to the tangent y, which is the axis of the hinge. */
static status build_arc(const double value[], scene *s, fault *f)
{
    const double inward[3] = {-1, 1, 0};
    (void)value;
    (void)f;
    const int profile = add_section(s), first = scene_add_node(s, 0, 0, 0),
              last = scene_add_node(s, 1, 1, 0),
              member = scene_add_member(s, first, last, profile, inward);
    scene_member_at(s, member)->curvature[2] = 1;
    clamped_ends(s, first, last, member);
    scene_release_end(s, member, 1, SCENE_RX);
    return STATUS_OK;
}

/* Which of the six reactions are none; the others are moments of the clamps. */
static void check(status (*build)(const double[], scene *, fault *), const char *chosen, int n,
                  unsigned released, double least)
{
    cell_result r;
    cells_solve(build, chosen, n, &r);
    gsl_test_int(r.solve.quantities, 2 * REACTIONS, "%s: reactions", chosen);
    double largest = 0;
    for (int i = 0; i < r.solve.quantities; i++)
        largest = fmax(largest, fabs(r.solve.quantity[i].value));
    gsl_test(!(largest > least), "%s: the clamps hold %g", chosen, largest);
    for (int i = 0; i < r.solve.quantities; i++)
        gsl_test((fabs(r.solve.quantity[i].value) <= 1e-9 * largest) != (released >> i & 1u),
                 "%s: %s is %.3g of %.3g", chosen, r.scene.quantity[i].name,
                 r.solve.quantity[i].value, largest);
    cell_result_free(&r);
}

int main(void)
{
    check(build_angle, "beamw_consistent", 3, 1U << 2 | 1U << 4, 1e-3);
    check(build_angle, "collocation", 2, 1U << 2 | 1U << 4, 1e-3);
    check(build_angle, "geometrically_exact", 4, 1U << 2 | 1U << 4, 1e-3);
    for (int n = 1; n < 8; n += 3) {
        check(build_arc, "geometrically_exact", n, 1U << 4, 0.1);
        check(build_arc, "beamw", 2 * n, 1U << 4, 0.1);
    }
    return gsl_test_summary();
}
