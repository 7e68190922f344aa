/* Below which size changes of a value are round-off: of every kind of quantity, in its unit. */
#include "harness/study/study.h"

#include <gsl/gsl_test.h>
#include <stdio.h>

#include "elements/test/sections.h"

/* Size 5 m, E = 2e11 Pa, A = 0.02 m^2. */
static void make(scene *s)
{
    const double y[3] = {0, 0, 1};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.2, 0.1);
    scene_init(s, "size");
    scene_add_section(s, &spec);
    scene_add_node(s, 1, 2, 0.5);
    scene_add_node(s, 4, 6, 0.5);
    scene_add_member(s, 0, 1, 0, y);
}

int main(void)
{
    const double size = 5, young = 2e11, EA = young * 0.02, force = 1e-14 * EA;
    const struct {
        const char *name;
        scene_extract what;
        double scale;
    } row[] = {
        {"displacement", scene_coordinate(1, SCENE_UY), 1e-12 * size},
        {"rotation", scene_coordinate(1, SCENE_RY), 1e-12},
        {"relative displacement", scene_relative_to(1, SCENE_UX, 0), 1e-12 * size},
        {"relative rotation", scene_relative_to(1, SCENE_RZ, 0), 1e-12},
        {"reaction", scene_reaction(0, SCENE_UZ), force},
        {"reacting moment", scene_reaction(0, SCENE_RX), force * size},
        {"N", scene_internal_at(0, 0.5, SCENE_N), force},
        {"Qz", scene_internal_at(0, 0.5, SCENE_QZ), force},
        {"Mx", scene_internal_at(0, 0.5, SCENE_MX), force * size},
        {"bimoment", scene_internal_at(0, 0.5, SCENE_BIMOMENT), force * size * size},
        {"stress", scene_stress_at(0, 0.5, SCENE_VON_MISES), 1e-14 * young},
        {"du/dF", scene_compliance_entry(SCENE_UX, SCENE_UY), 1e-12 * size / EA},
        {"du/dM", scene_compliance_entry(SCENE_UX, SCENE_RY), 1e-12 / EA},
        {"dr/dF", scene_compliance_entry(SCENE_RX, SCENE_UY), 1e-12 / EA},
        {"dr/dM", scene_compliance_entry(SCENE_RX, SCENE_RY), 1e-12 / size / EA},
        {"orientation", scene_orientation_entry(1, 0, 2), 1e-12},
    };
    enum { ROWS = sizeof row / sizeof *row };
    scene s;
    quantity_result value[ROWS] = {{0}};
    make(&s);
    for (int i = 0; i < ROWS; i++) {
        char unit[8];
        snprintf(unit, sizeof unit, "%d", i); /* beside none of the same unit */
        scene_add_quantity(&s, row[i].name, unit, 0, row[i].what)->factor = i % 2 ? -1 : 10;
    }
    const solve_result r = {.quantities = ROWS, .quantity = value};
    for (int i = 0; i < ROWS; i++)
        gsl_test_rel(change_scale(&s, i, &r), (i % 2 ? 1 : 10) * row[i].scale, 1e-13, "%s",
                     row[i].name);
    value[0].value = -3; /* large beside it */
    gsl_test_rel(change_scale(&s, 0, &r), 3e-9, 1e-13, "beside a value of its unit");
    s.quantity[0].near_zero = 7;
    gsl_test_rel(change_scale(&s, 0, &r), 7, 1e-13, "beside what the case says");
    scene_free(&s);
    return gsl_test_summary();
}
