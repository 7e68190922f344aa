/* The nodal forces of a uniform load along a member must have its force and its first and second
 * moments. Centrifugal forces must be proportional to the square of the angular velocity. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { MOST = 40 };
enum { LINE, SPIN };

/* Computes the forces of one component on the vertices of a member of length 2 along x, due to a
 * load along it or to a frame that rotates about z. The two end vertices come first. */
static void forces_along(int what, const char *name, double path, int follows, int nodes,
                         double out[])
{
    const double y[3] = {0, 1, 0}, z[3] = {0, 0, 0.3}, origin[3] = {0, 0, 0}, end = 1;
    formulation chosen;
    scene s;
    model *m = NULL;
    fault f = {""};
    section_spec spec = section_spec_constants(1, 1);
    spec.density = 1;
    spec.constants = (section){.A = 1, .Iy = 1, .Iz = 1, .It = 1, .Ip = 2};
    scene_init(&s, "member");
    const int p = scene_add_node(&s, 0, 0, 0), q = scene_add_node(&s, 2, 0, 0);
    const int member = scene_add_member(&s, p, q, scene_add_section(&s, &spec), y);
    scene_add_static(&s, 1, &end, 1);
    if (what == LINE)
        scene_add_load(&s, SCENE_DISTRIBUTED, member, 0, 3, 0);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK, "%s", f.text);
    const model_request request = {&s, chosen.type, chosen.option, 1, 0, 0};
    gsl_test(model_alloc(&request, &m, &f) != STATUS_OK, "%s: %s", name, f.text);
    double residual[MOST];
    run_state run;
    model_linearisation lin = {.path = path, .residual = residual};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    if (what == SPIN)
        eq.loading = (loading){.rotates = 1,
                               .rotation_follows_path = follows,
                               .frame = {{z[0], z[1], z[2]}, {origin[0], origin[1], origin[2]}}};
    gsl_test(linearise_state(&eq, &run.memory, kinematics_rest(m), &lin, &f) != STATUS_OK, "%s: %s",
             name, f.text);
    run_state_end(&run);
    for (int k = 0; k < nodes; k++)
        out[k] = residual[kinematics_coordinate(m, k, what == LINE ? SCENE_UY : SCENE_UX)];
    model_free(m);
    scene_free(&s);
}

static void along_a_member(const char *name, int nodes)
{
    double F[MOST], sum[3] = {0};
    forces_along(LINE, name, 1, 0, nodes, F);
    for (int k = 0; k < nodes; k++) {
        const int place[] = {0, nodes - 1, 1};
        const double x = 2.0 * place[k] / (nodes - 1), force = F[k];
        for (int power = 0; power < 3; power++)
            sum[power] += force * pow(x, power);
    }
    gsl_test_rel(sum[0], 3 * 2, 1e-14, "%s: all of the load", name);
    gsl_test_rel(sum[1], 3 * 2, 1e-14, "%s: its moment", name);
    gsl_test_rel(sum[2], nodes == 2 ? 3 * 4 : 3 * 8 / 3.0, 1e-14, "%s: its second moment", name);
}

static void turning_faster(void)
{
    static const char name[] = "geometrically_exact:nodes=2";
    double whole[2], half[2], steady[2];
    forces_along(SPIN, name, 1, 1, 2, whole);
    forces_along(SPIN, name, 0.5, 1, 2, half);
    forces_along(SPIN, name, 0.5, 0, 2, steady);
    for (int k = 0; k < 2; k++) {
        gsl_test_abs(half[k], whole[k] / 4, 1e-15, "half the angular velocity, force %d", k);
        gsl_test_abs(steady[k], whole[k], 1e-15,
                     "an angular velocity that does not follow the path, force %d", k);
    }
    gsl_test_rel(whole[1], 0.3 * 0.3 * 2 * 2 / 3, 1e-13,
                 "the mass along the element, by the displacements of its end");
}

int main(void)
{
    along_a_member("geometrically_exact:nodes=2", 2);
    along_a_member("geometrically_exact:nodes=3", 3);
    turning_faster();
    return gsl_test_summary();
}
