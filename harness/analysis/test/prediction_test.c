/* The closed-form solution of a clamped-free sheet beside what one third-order element computes
 * from the same potential. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

static void prediction_solve(const char *const assignment[], cell_result *out)
{
    cell_request request = cells_of(case_find("sheet_cantilever", NULL), "sheet_third", 1);
    fault f = {""};
    cells_set(&request, assignment);
    gsl_test(cell_run(&request, out, &f) != STATUS_OK, "solved: %s", f.text);
}

/* In the plane the element's inverse of N Eq. 37 is exact enough to agree with all digits; out of
 * it the two differ by terms of the fourth order, of which `apart` is the size for C_zz. */
static void beside_the_element(const char *const assignment[], double in_plane, double apart)
{
    cell_result r;
    int predicted = 0;
    prediction_solve(assignment, &r);
    for (int i = 0; i < r.scene.quantities; i++) {
        const scene_quantity *q = &r.scene.quantity[i];
        const double value = r.solve.quantity[i].value;
        if (q->prediction.source == NULL)
            continue;
        predicted++;
        const int out_of_plane = strcmp(q->name, "C_zz") == 0 || strcmp(q->name, "C_uz_Fz") == 0;
        gsl_test_rel(q->prediction.value, value, out_of_plane ? apart : in_plane, "%s, %s",
                     assignment[0], q->name);
    }
    gsl_test_int(predicted, 7, "%s: everything that the closed form speaks of is predicted",
                 assignment[0]);
    cell_result_free(&r);
}

/* L^3/3EIy + L/kGA. */
static void undeformed(void)
{
    const char *const straight[] = {"tip_deflection=1e-9", NULL};
    const double E = 200e9, w = 0.1, t = 0.00225, L = 0.1, nu = 0.3,
                 k = 10 * (1 + nu) / (12 + 11 * nu);
    cell_result r;
    prediction_solve(straight, &r);
    for (int i = 0; i < r.scene.quantities; i++)
        if (strcmp(r.scene.quantity[i].name, "C_zz") == 0)
            gsl_test_rel(r.scene.quantity[i].prediction.value,
                         4 * L * L * L / (E * t * w * w * w) + L * 2 * (1 + nu) / (k * E * w * t),
                         1e-11, "C_zz of the undeformed sheet");
    cell_result_free(&r);
}

int main(void)
{
    const char *const small[] = {"tip_deflection=0.001", NULL},
                      *const middle[] = {"tip_deflection=0.015", NULL},
                      *const free_tip[] = {"tip_warping=1", NULL},
                      *const uniform[] = {"warping=0", NULL}, *const rigid[] = {"shear=0", NULL};
    undeformed();
    beside_the_element(small, 1e-11, 2e-5);
    beside_the_element(middle, 1e-11, 1e-2);
    beside_the_element(free_tip, 1e-11, 1.5e-2);
    beside_the_element(uniform, 1e-11, 3e-4);
    beside_the_element(rigid, 1e-11, 1.5e-2);
    return gsl_test_summary();
}
