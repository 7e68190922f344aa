/* Motions that go on from each other are one motion, bit for bit; where the error of steps is
 * estimated too, but for the round-off of a factorisation that pivots anew. */
#include <math.h>
#include <string.h>

#include "harness/time/test/swung.h"

enum { INTEGRATOR, TOLERANCE, PARTS, JOINT, PARAMETERS };
enum { MOST_PARTS = 3 };

/* A load that jumps at 0.5 s: there steps end, whoever walks across. */
static status build(const double value[], scene *s, fault *f)
{
    static const double ends[] = {0.25, 0.5, 1}, whole = 1;
    const int parts = (int)value[PARTS];
    (void)f;
    const swung of = swung_build(s);
    if (value[JOINT] > 0) { /* a rod at the tip that turns and slides there */
        static const double z_axis[] = {0, 0, 1};
        const int rod = scene_add_member(s, of.tip, scene_add_node(s, 1.4, 0.9, 0.3),
                                         scene_member_at(s, of.member)->section, z_axis);
        scene_release_end(s, rod, 0, SCENE_RX);
        scene_release_end(s, rod, 0, SCENE_UZ);
    }
    const int kick = scene_add_load(s, SCENE_FORCE, of.base, 0, 0, 1);
    scene_load_piece(s, kick, 0.5, "0");
    scene_load_piece(s, kick, 0, "1.5");
    scene_motion how = swung_motion((scene_scheme)value[INTEGRATOR], 1 / 64.0);
    how.tolerance = value[TOLERANCE];
    int motion = SCENE_NONE;
    for (int i = 0; i < parts; i++) {
        motion = scene_add_motion(s, motion, 1, parts == 1 ? &whole : &ends[i + MOST_PARTS - parts],
                                  how);
        how.start = (scene_start){.velocity = {0}};
    }
    scene_add_quantity(s, "x", "m", motion, scene_coordinate(of.tip, SCENE_UX));
    scene_add_quantity(s, "turn", "rad", motion, scene_coordinate(of.tip, SCENE_RY));
    scene_add_quantity(s, "spin", "rad/s", motion, scene_rate(of.tip, SCENE_RZ));
    scene_add_quantity(s, "energy", "J", motion, scene_balance_of(SCENE_ENERGY));
    scene_add_quantity(s, "work", "J", motion, scene_balance_of(SCENE_WORK));
    scene_add_quantity(s, "missing", "J", motion, scene_balance_of(SCENE_DRIFT));
    scene_add_quantity(s, "strain", "J", motion, scene_balance_of(SCENE_STRAIN));
    return STATUS_OK;
}

static const parameter_type table[] = {
    [INTEGRATOR] = {"integrator", "1", 0, 0, 3, TIMED_INTEGRATORS, "scheme"},
    [TOLERANCE] = {"tolerance", "1", 0, 0, 1, NULL, "0: all steps are alike"},
    [PARTS] = {"parts", "1", 1, 1, MOST_PARTS, NULL, "of the motion"},
    [JOINT] = {"joint", "1", 0, 0, 1, NULL, "1: with released ends"},
    {0}};
static const case_type parted = {.name = "parted", .parameters = {table}, .build = build};

static void same_linked(const char *name, int scheme, double tolerance, int parts, int joint)
{
    cell_result one, more;
    swung_solve(&parted, (const double[]){scheme, tolerance, 1, joint}, PARAMETERS, &one);
    swung_solve(&parted, (const double[]){scheme, tolerance, parts, joint}, PARAMETERS, &more);
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
