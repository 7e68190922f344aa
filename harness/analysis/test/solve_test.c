/* Model and solvers through their public door: what is left out changes nothing, round-off stays
 * small. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/cells.h"

static double solve_value_of(const char *case_name, const char *formulation_text, int n,
                             int keep_all, const char *assignment, const char *quantity,
                             long *iterations)
{
    cell_request request = cells_of(case_find(case_name, NULL), formulation_text, n);
    cell_result result;
    fault f = {""};
    if (assignment[0] != '\0')
        cells_set(&request, (const char *const[]){assignment, NULL});
    request.keep_all = keep_all;
    gsl_test(cell_run(&request, &result, &f) != STATUS_OK, "%s solved with %s (%s)", case_name,
             formulation_text, f.text);
    const double value = cells_value(&result, quantity);
    if (iterations != NULL)
        *iterations = result.counters.iterations;
    cell_result_free(&result);
    return value;
}

static void leaving_out_changes_nothing(void)
{
    static const struct {
        const char *case_name, *quantity;
    } pairs[] = {{"c_column", "buckling_load"},
                 {"warping_torsion", "twist_ratio"},
                 {"sheet_cantilever", "C_zz"},
                 {"elastica", "theta"},
                 {"wagner_torsion", "shortening"}};
    for (size_t i = 0; i < 4; i++) {
        const double lean =
            solve_value_of(pairs[i].case_name, "beamw", 4, 0, "", pairs[i].quantity, NULL);
        const double full =
            solve_value_of(pairs[i].case_name, "beamw", 4, 1, "", pairs[i].quantity, NULL);
        gsl_test_rel(full, lean, 1e-10, "%s: keeping everything gives the same %s",
                     pairs[i].case_name, pairs[i].quantity);
    }
}

static void newton(void)
{
    long mixed = 0, displacement = 0;
    const double a =
        solve_value_of("sheet_cantilever", "beamw_consistent", 4, 0, "", "C_xx", &mixed);
    const double b = solve_value_of("sheet_cantilever", "beamw_consistent:newton=displacement", 4,
                                    0, "", "C_xx", &displacement);
    gsl_test_rel(b, a, 1e-9, "both kinds of Newton find the same equilibrium");
    const double c =
        solve_value_of("sheet_cantilever", "beamw_consistent:newton=dense", 4, 0, "", "C_xx", NULL);
    gsl_test_rel(c, a, 1e-10, "and so does the uncondensed system");
    gsl_test(!(mixed <= 4 * 15),
             "mixed Newton takes at most four iterations a step (%ld in 15 steps)", mixed);
}

/* In a first step of 15 degrees the ends of short elements change places: the strains cannot tell,
 * the solver must. */
static void no_element_is_turned_round(void)
{
    const double value = solve_value_of("spherical_joint", "beamw_consistent", 32, 0, "wagner=0",
                                        "support_stiffness_max", NULL);
    gsl_test_rel(value, 953153.87, 1e-3,
                 "spherical joint on fine meshes: no silent jump to a reversed element");
}

static void fine_mesh(void)
{
    const double coarse =
        solve_value_of("c_column", "beamw_vlasov", 256, 0, "shear=0", "buckling_load", NULL);
    const double fine =
        solve_value_of("c_column", "beamw_vlasov", 1024, 0, "shear=0", "buckling_load", NULL);
    const double exact = 16117335.51891;
    gsl_test_rel(fine, exact, 2e-6, "1024 elements: %.3g from the exact load", fine / exact - 1);
    const double order = log((coarse - exact) / (fine - exact)) / log(4);
    gsl_test(!(fabs(order - 2) < 0.1), "round-off does not hide the order on 1024 elements (%.2f)",
             order);
}

/* Far below the largest values the geometric stiffness alone decides the pivots of K - A/s, and
 * here they vanish. */
static void frame_of_strips(void)
{
    const double exact = 0.6222080872197;
    for (int n = 8; n <= 32; n *= 2) {
        const double moment = solve_value_of("right_angle_frame", "beamw_consistent", n, 0, "",
                                             "critical_moment", NULL);
        gsl_test_rel((moment / exact - 1) * n * n, 0.411, 0.01,
                     "right-angle frame of %d elements a leg: second order", n);
    }
}

/* Equal elements round alike: their errors add up to much more than independent ones, and the
 * inertia is that of the sums. */
static void equal_elements(void)
{
    const double critical = solve_value_of("lateral_buckling", "geometrically_exact", 256, 0,
                                           "load=mid", "load_factor", NULL);
    gsl_test_rel(critical, 16.93613215047, 1e-6, "lateral buckling with 512 elements");
}

/* Two elements between forks have 14 motions, of which two are axial; in some of the others no
 * vertex moves, and only sections turn and warp: they are no axial ones either. */
static void modes_in_place(void)
{
    for (int keep_all = 0; keep_all < 2; keep_all++)
        for (int k = 1; k <= 13; k++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "frequency_%d", k);
            const double value =
                solve_value_of("c_column", "beamw_consistent", 2, keep_all, "", name, NULL);
            gsl_test(isfinite(value) != (k <= 12), "c_column, keep_all = %d: %s is %g Hz", keep_all,
                     name, value);
        }
}

int main(void)
{
    modes_in_place();
    leaving_out_changes_nothing();
    newton();
    no_element_is_turned_round();
    fine_mesh();
    frame_of_strips();
    equal_elements();
    return gsl_test_summary();
}
