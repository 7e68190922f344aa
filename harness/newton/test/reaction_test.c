/* Reactions at the foot of an arm, of every formulation. */
#include <gsl/gsl_test.h>
#include <stdio.h>

#include "elements/math/dense.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"

/* A beam on an arm: what the body at its foot carries is the tip's force, and its moment about the
 * body. */
static void foot_of_an_arm(const element_type *type)
{
    const double y[3] = {0, 1, 0}, end = 1, P[3] = {0.01, -0.02, 0.03};
    scene s;
    model *m = NULL;
    solve_result r = {0};
    fault f = {""};
    section_spec spec = section_spec_rectangle(1e4, 4e3, 0.1, 0.08);
    scene_init(&s, "arm");
    const int foot = scene_add_node(&s, 0, 0, 0),
              arm = scene_add_attached(&s, foot, 0.3, -0.4, 0.2);
    const int tip = scene_add_node(&s, 1.3, -0.4, 0.2);
    scene_hold_all(&s, foot);
    scene_add_member(&s, arm, tip, scene_add_section(&s, &spec), y);
    scene_add_load(&s, SCENE_FORCE, tip, P[0], P[1], P[2]);
    scene_add_load(&s, SCENE_FORCE, foot, 5, 6, 7); /* into the ground at once */
    scene_add_static(&s, 1, &end, 1);
    for (int k = 0; k < 9; k++) {
        char name[8];
        snprintf(name, sizeof name, "q%d", k);
        scene_add_quantity(&s, name, "1", 0,
                           k < 6 ? scene_reaction(foot, k) : scene_coordinate(tip, k - 6));
    }
    const model_request request = {&s, type, NULL, 2, 0};
    if (model_alloc(&request, &m, &f) == STATUS_OK &&
        solve_scene(&s, m, NULL, &r, &f) == STATUS_OK) {
        const double x[3] = {1.3 + r.quantity[6].value, -0.4 + r.quantity[7].value,
                             0.2 + r.quantity[8].value};
        double moment[3];
        vec3_cross(x, P, moment);
        for (int i = 0; i < 3; i++) {
            gsl_test_abs(r.quantity[i].value, -P[i] - 5 - i, 1e-9, "%s: reaction %d at the foot",
                         type->name, i);
            gsl_test_abs(r.quantity[3 + i].value, -moment[i], 1e-9,
                         "%s: reacting moment %d at the foot", type->name, i);
        }
    } else {
        gsl_test(1, "%s: %s", type->name, f.text);
    }
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++)
        foot_of_an_arm(registry_formulations[i]);
    return gsl_test_summary();
}
