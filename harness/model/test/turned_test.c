/* The same structure described in other axes of its section, turned by any angle about the beam:
 * the same answers of every formulation. What belongs to one axis only (a Wagner moment, a shear
 * centre's distance, an entry of D) shows here. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/tools/kit/ask.h"

enum { ANGLE = CASE_MAX_PARAMETERS - 1, ORIGINAL = CASE_MAX_PARAMETERS - 2 };

/* y = y' cos - z' sin: the local y axis of every member along x turns by the angle, the sections'
 * points by the opposite. */
static status turned(const double value[], scene *s, fault *f)
{
    const double c = cos(value[ANGLE]), d = sin(value[ANGLE]);
    const status outcome = case_build(registry_cases[(int)value[ORIGINAL]], value, s, f);
    for (int i = 0; i < s->sections && outcome == STATUS_OK; i++)
        for (int k = 0; k < s->section[i].points; k++) {
            const double y = s->section[i].point[k][0], z = s->section[i].point[k][1];
            s->section[i].point[k][0] = c * y + d * z;
            s->section[i].point[k][1] = c * z - d * y;
        }
    for (int i = 0; i < s->members && outcome == STATUS_OK; i++) {
        const double y = s->member[i].y_axis[1], z = s->member[i].y_axis[2];
        s->member[i].y_axis[1] = c * y - d * z;
        s->member[i].y_axis[2] = c * z + d * y;
    }
    return outcome;
}

static status turned_solve(int original, double angle, const element_type *element,
                           cell_result *out)
{
    case_type type = *registry_cases[original];
    cell_request request = {.type = &type, .elements = 4};
    formulation chosen;
    fault f = {""};
    formulation_default(element, &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(&type, request.parameter);
    request.parameter[ORIGINAL] = original;
    request.parameter[ANGLE] = angle;
    type.build = turned;
    return cell_run(&request, out, &f);
}

/* Quantities of one sign and order are the same numbers, save that a turn by half a circle
 * exchanges the signs of moments. */
static int compare(int original, const element_type *element)
{
    static const double angle[] = {0.5, 1.5707963267948966, -2.2};
    cell_result before, after;
    int compared = 0;
    const int runs = turned_solve(original, 0, element, &before) == STATUS_OK;
    gsl_test(!runs && ask_offered(&before.scene, element), "%s, %s: solved where it is offered %s",
             before.scene.name, element->name, before.solve.reason);
    /* what lacks shear along y is another model where y is another axis */
    const int lacks = (element->lacks & LACKS_SHEAR_Y) && !ask_offered(&before.scene, element);
    const size_t angles = runs && !lacks ? sizeof angle / sizeof angle[0] : 0;
    for (size_t k = 0; k < angles; k++) {
        gsl_test(turned_solve(original, angle[k], element, &after) != STATUS_OK,
                 "%s, %s turned by %g: %s", before.scene.name, element->name, angle[k],
                 after.solve.reason);
        for (int i = 0; i < after.solve.quantities; i++) {
            const double expected = before.solve.quantity[i].value,
                         value = after.solve.quantity[i].value;
            if (before.solve.quantity[i].curve.points > 0)
                continue;
            gsl_test(!(fabs(value - expected) <= 1e-9 * fabs(expected)),
                     "%s, %s turned by %g: %s %.12g, not %.12g", before.scene.name, element->name,
                     angle[k], before.scene.quantity[i].name, value, expected);
            compared++;
        }
        cell_result_free(&after);
    }
    cell_result_free(&before);
    return compared;
}

int main(void)
{
    int compared = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        for (int k = 0; registry_formulations[k] != NULL; k++)
            if (strcmp(registry_cases[i]->name, "moment_buckling") == 0 ||
                strcmp(registry_cases[i]->name, "unsymmetric_column") == 0 ||
                strcmp(registry_cases[i]->name, "c_column") == 0)
                compared += compare(i, registry_formulations[k]);
    gsl_test(compared < 100, "%d values were compared", compared);
    return gsl_test_summary();
}
