/* The published algorithm as a baseline: how large its system is, when it is timed, and what its
 * time is taken for. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/newton/newton.h"
#include "harness/tools/kit/cells.h"

/* The order of the matrix that is eliminated. */
static int order_of(const cell_request *request)
{
    scene s;
    model *m = NULL;
    fault f = {""};
    int order = -1;
    scene_init(&s, request->type->name);
    const model_request wanted = {.scene = &s,
                                  .type = request->formulation,
                                  .options = request->option,
                                  .elements = request->elements};
    if (case_build(request->type, request->parameter, &s, &f) == STATUS_OK &&
        model_alloc(&wanted, &m, &f) == STATUS_OK)
        order = uncondensed_size(m);
    gsl_test(order < 0, "%s: %s", request->type->name, f.text);
    model_free(m);
    scene_free(&s);
    return order;
}

static dense_reference measure(const cell_request *request)
{
    dense_reference dense = {0};
    cell_result cell;
    fault f = {""};
    cell_run(request, &cell, &f);
    dense_reference_round(request, &cell, 0, &dense);
    cell_result_free(&cell);
    return dense;
}

static void unknowns(void)
{
    static const char *const name[] = {"sheet_cantilever", "elastica", "bend_45"};
    static const char *const key[] = {"sheet_third", "beamw_consistent", "collocation",
                                      "geometrically_exact:nodes=3"};
    int measured = 0;
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 4; k++)
            for (int n = 1; n <= 4; n++) {
                const cell_request request = cells_of(case_find(name[c], NULL), key[k], n);
                const dense_reference dense = measure(&request);
                if (dense.unknowns == 0)
                    continue;
                measured++;
                gsl_test_int(dense.unknowns, order_of(&request), "%s, %s, n = %d: unknowns",
                             name[c], key[k], n);
                gsl_test(!(dense.iteration > 0), "%s, %s, n = %d: an iteration takes time", name[c],
                         key[k], n);
            }
    gsl_test(measured < 24, "%d cells were measured", measured);
}

/* Nothing iterates, or the matrix is too large. */
static void not_measured(void)
{
    const cell_request linear = cells_of(case_find("warping_torsion", NULL), "beamw_consistent", 4),
                       continued = cells_of(case_find("snap_through", NULL), "collocation", 2),
                       large = cells_of(case_find("elastica", NULL), "geometrically_exact", 600);
    gsl_test_int(measure(&linear).unknowns, 0, "a linear problem");
    gsl_test_int(measure(&continued).unknowns, 0, "a path that the algorithm cannot follow");
    gsl_test_int(measure(&large).unknowns, 0, "a matrix beyond 3000 unknowns");
}

static void seconds(void)
{
    dense_reference b = {.unknowns = 10, .iteration = 0.3};
    gsl_test_rel(dense_reference_seconds(&b, 7), 2.1, 1e-15, "one iteration for all");
    b.whole = (rounds_reading){.rounds = 2, .round = {1.7, 1.6}};
    gsl_test_rel(dense_reference_seconds(&b, 7), 1.6, 1e-15, "whole runs, where they were made");
    b = (dense_reference){0};
    gsl_test(!isinf(dense_reference_seconds(&b, 7)), "what was not measured has no time");
}

int main(void)
{
    unknowns();
    not_measured();
    seconds();
    return gsl_test_summary();
}
