/* Condensed members give the same answers as the assembled tangent: every case, and released ends,
 * with formulations of each family; and beyond what an assembled tangent has digits for. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

static const char *const formulations[] = {"beamw", "sheet_third", "geometrically_exact",
                                           "collocation"};
enum { FORMULATIONS = sizeof formulations / sizeof formulations[0], NEVER = 1000000 };

/* A fifth of a motion is solved by the same steps as all of it. */
static void shorten(const case_type *type, double parameter[])
{
    const int time = parameter_index(type->parameters, "time");
    if (time >= 0)
        parameter[time] /= 5;
}

static status test_condensation_solve(const case_type *type, const char *of, int elements,
                                      int condensed, cell_result *out)
{
    cell_request request = cells_of(type, of, elements);
    fault f = {""};
    shorten(type, request.parameter);
    request.solve.condensed = condensed;
    return cell_run(&request, out, &f);
}

/* Values of quantities beside those of the same kind of unit, which zeros are measured by. */
static double scale_of(const cell_result *r, const char *unit)
{
    double largest = 0;
    for (int i = 0; i < r->solve.quantities; i++)
        if (strcmp(r->scene.quantity[i].unit, unit) == 0 &&
            r->solve.quantity[i].status == STATUS_OK)
            largest = fmax(largest, fabs(r->solve.quantity[i].value));
    return largest;
}

/* How many values were compared. */
static int compare(const char *name, const char *of, const cell_result *a, const cell_result *b)
{
    int compared = 0;
    for (int i = 0; i < a->solve.quantities; i++) {
        const quantity_result *p = &a->solve.quantity[i], *q = &b->solve.quantity[i];
        const scene_quantity *what = &a->scene.quantity[i];
        gsl_test(p->status != q->status, "%s, %s, %s: %s", name, of, what->name, q->reason);
        if (p->status != STATUS_OK || q->status != STATUS_OK)
            continue;
        const double apart = fabs(p->value - q->value),
                     size = fabs(p->value) + 1e-3 * scale_of(a, what->unit);
        gsl_test(!(apart <= 1e-7 * size), "%s, %s, %s: %.10g assembled, %.10g condensed", name, of,
                 what->name, p->value, q->value);
        compared++;
    }
    return compared;
}

static int both_ways(const case_type *type, const char *of, int elements)
{
    cell_result assembled, condensed;
    const status one = test_condensation_solve(type, of, elements, NEVER, &assembled),
                 other = test_condensation_solve(type, of, elements, 1, &condensed);
    gsl_test(one != other, "%s, %s: solved both ways", type->name, of);
    const int compared = one == STATUS_OK && other == STATUS_OK
                             ? compare(type->name, of, &assembled, &condensed)
                             : 0;
    cell_result_free(&assembled);
    cell_result_free(&condensed);
    return compared;
}

static void cases(void)
{
    int compared = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        for (int k = 0; k < FORMULATIONS; k++)
            compared += both_ways(registry_cases[i], formulations[k], 2);
    gsl_test(compared < 500, "%d values of cases were compared", compared);
}

/* Two leaves, joined by a hinge, the second one from a body; the tip slides in its holder. */
static status hinged(const double value[], scene *s, fault *f)
{
    const double y[3] = {0, 1, 0}, end = 1;
    section_spec spec = section_spec_rectangle(2e11, 8e10, 0.02, 0.001);
    (void)value;
    (void)f;
    scene_init(s, "hinged");
    const int root = scene_add_node(s, 0, 0, 0), body = scene_add_node(s, 0.1, 0, 0),
              beside = scene_add_attached(s, body, 0.11, 0.01, 0.005),
              tip = scene_add_node(s, 0.2, 0.02, 0), leaf = scene_add_section(s, &spec);
    scene_hold_all(s, root);
    scene_hold(s, tip, SCENE_UX, SCENE_RX);
    scene_add_member(s, root, body, leaf, y);
    const int second = scene_add_member(s, beside, tip, leaf, y);
    scene_release_end(s, second, 0, SCENE_RZ);
    scene_release_end(s, second, 1, SCENE_UX);
    scene_add_load(s, SCENE_FORCE, body, 0.5, 1, 0.3);
    scene_add_load(s, SCENE_FORCE, beside, 0, 0.4, 0.3);
    const int path = scene_add_static(s, 1, &end, 3);
    for (int i = 0; i < 6; i++)
        scene_add_quantity(s, (const char *[]){"ux", "uy", "uz", "rx", "ry", "rz"}[i],
                           i < 3 ? "m" : "rad", path, scene_coordinate(body, i));
    return STATUS_OK;
}

static void released(void)
{
    static const parameter_type none[] = {{0}};
    const case_type type = {.name = "hinged",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = hinged};
    int compared = 0;
    for (int k = 0; k < FORMULATIONS; k++)
        compared += both_ways(&type, formulations[k], 3);
    gsl_test(compared < 12, "%d values with released ends were compared", compared);
}

/* With 4000 elements, condition 1e16 of the assembled tangent, Newton's method converges as with
 * few. */
static void many(const case_type *type)
{
    cell_result few, more;
    const status one = test_condensation_solve(type, "beamw_consistent", 128, 0, &few),
                 other = test_condensation_solve(type, "beamw_consistent", 4000, 0, &more);
    gsl_test(one != STATUS_OK || other != STATUS_OK, "%s: solved with 4000 elements", type->name);
    gsl_test(more.counters.iterations > few.counters.iterations + 5,
             "%s: %ld iterations with 4000 elements, %ld with 128", type->name,
             more.counters.iterations, few.counters.iterations);
    for (int i = 0; i < few.solve.quantities && one == STATUS_OK && other == STATUS_OK; i++)
        gsl_test_rel(more.solve.quantity[i].value, few.solve.quantity[i].value, 2e-5, "%s, %s",
                     type->name, few.scene.quantity[i].name);
    cell_result_free(&few);
    cell_result_free(&more);
}

int main(void)
{
    int found = 0;
    cases();
    released();
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, "c_cantilever") == 0) {
            many(registry_cases[i]);
            found = 1;
        }
    gsl_test(!found, "c_cantilever is there");
    return gsl_test_summary();
}
