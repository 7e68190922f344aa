/* A value that is off is coarse where its error falls with more elements, and wrong elsewhere: on
 * neighbouring meshes that are made up, finer or coarser than its own, with and without values. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"

enum { MESHES = 1 + OUTCOME_NEIGHBOURS };
static const double exact = 7;

typedef struct neighbours_bench {
    extreme_sweep s;
    sweep_point p;
    series first, others;
    cell_result cell, other[OUTCOME_NEIGHBOURS];
    quantity_result value, other_value[OUTCOME_NEIGHBOURS];
    formulation chosen;
    element_type element;
    truths t;
    truth row;
    extreme_outcome o;
} neighbours_bench;

static char words[][16] = {"", "exact", "same", "m"};

/* An extreme of the table that has exact values. */
static int exact_extreme(void)
{
    int i = 0;
    while (extremes[i].judge != EXTREME_EXACT)
        i++;
    return i;
}

/* own: elements of the mesh that is judged; error[0] is its relative error, the others are those of
 * its neighbours; NAN: no value. */
static void make(int own, const int mesh[OUTCOME_NEIGHBOURS], const double error[MESHES],
                 neighbours_bench *b)
{
    static char name[SCENE_NAME];
    const int index = exact_extreme();
    memset(b, 0, sizeof *b);
    snprintf(name, sizeof name, "%s", extremes[index].quantity[0].name);
    b->p.type = case_find(extremes[index].base, NULL);
    scene_init(&b->p.scene, "made_up");
    scene_add_quantity(&b->p.scene, name, "m", 0, scene_coordinate(0, SCENE_UX));
    b->element = (element_type){.name = "element"};
    b->chosen = (formulation){.key = "element", .type = &b->element};
    b->value = (quantity_result){.value = exact * (1 + error[0])};
    b->cell.solve.quantities = 1;
    b->cell.solve.quantity = &b->value;
    b->first = (series){.formulation = b->chosen, .meshes = 1, .mesh = {own}, .cell = &b->cell};
    b->others = (series){.formulation = b->chosen, .meshes = OUTCOME_NEIGHBOURS, .cell = b->other};
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++) {
        b->others.mesh[i] = mesh[i];
        b->other_value[i] =
            (quantity_result){.value = exact * (1 + error[i + 1]),
                              .status = isnan(error[i + 1]) ? STATUS_SINGULAR : STATUS_OK};
        b->other[i].solve.quantities = 1;
        b->other[i].solve.quantity = &b->other_value[i];
    }
    b->row = (truth){.type = b->p.type,
                     .formulation = words[0],
                     .theory = words[0],
                     .quantity = name,
                     .unit = words[3],
                     .kind = words[1],
                     .model = words[2],
                     .value = exact};
    b->t = (truths){.rows = 1, .row = &b->row};
    b->s = (extreme_sweep){.formulations = 1, .formulation = &b->chosen};
    b->s.first = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->first};
    b->s.neighbours = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->others};
    b->o = (extreme_outcome){.extreme = index};
}

static void expect(int own, const int mesh[OUTCOME_NEIGHBOURS], const double error[MESHES],
                   outcome_kind kind, const char *what)
{
    neighbours_bench b;
    fault f = {""};
    make(own, mesh, error, &b);
    gsl_test(extreme_judge_first(&b.s, &b.t, &b.o, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(b.o.kind != OUTCOME_WRONG, "%s: its own value is off: %s", what,
             outcome_name(b.o.kind));
    gsl_test_rel(b.o.error, error[0], 1e-9, "%s: its error", what);
    extreme_judge_neighbours(&b.s, &b.t, &b.o);
    gsl_test(b.o.kind != kind, "%s: %s", what, outcome_name(b.o.kind));
    for (int i = 0; i < OUTCOME_NEIGHBOURS; i++)
        if (isnan(error[i + 1]))
            gsl_test(!isnan(b.o.neighbour_error[i]), "%s: mesh %d has none", what, mesh[i]);
        else
            gsl_test_rel(b.o.neighbour_error[i], error[i + 1], 1e-9, "%s: error on mesh %d", what,
                         mesh[i]);
    scene_free(&b.p.scene);
}

int main(void)
{
    static const int finer[] = {8, 16}, coarser[] = {8, 16}, around[] = {8, 32};
    expect(4, finer, (double[]){0.16, 0.04, 0.01}, OUTCOME_COARSE, "second order, finer meshes");
    expect(4, finer, (double[]){-0.16, 0.04, -0.01}, OUTCOME_COARSE, "its sign may change");
    expect(4, finer, (double[]){0.16, 0.1, 0.079}, OUTCOME_COARSE, "half an order is enough");
    expect(4, finer, (double[]){0.16, 0.1, 0.081}, OUTCOME_WRONG, "less is not");
    expect(4, finer, (double[]){0.16, 0.01, 0.02}, OUTCOME_WRONG, "it rises at the end");
    expect(4, finer, (double[]){0.16, 0.3, 0.02}, OUTCOME_COARSE, "it rises and falls");
    expect(4, finer, (double[]){0.16, 0.16, 0.16}, OUTCOME_WRONG, "a limit of its own");
    expect(4, finer, (double[]){0.16, NAN, 0.01}, OUTCOME_COARSE, "without the middle mesh");
    expect(4, finer, (double[]){0.16, NAN, 0.09}, OUTCOME_WRONG, "without it: too slow");
    expect(4, finer, (double[]){0.16, 0.04, NAN}, OUTCOME_COARSE, "without the finest mesh");
    expect(4, finer, (double[]){0.16, 0.12, NAN}, OUTCOME_WRONG, "without it: too slow");
    expect(4, finer, (double[]){0.16, NAN, NAN}, OUTCOME_WRONG, "no neighbour has a value");
    expect(64, coarser, (double[]){0.01, 0.16, 0.04}, OUTCOME_COARSE, "coarser meshes were worse");
    expect(64, coarser, (double[]){0.04, 0.01, 0.02}, OUTCOME_WRONG, "coarser meshes were better");
    expect(64, coarser, (double[]){0.03, 0.08, 0.02}, OUTCOME_WRONG, "a coarser mesh was better");
    expect(64, coarser, (double[]){0.05, 0.16, NAN}, OUTCOME_COARSE, "one coarser mesh");
    expect(64, coarser, (double[]){0.06, 0.16, NAN}, OUTCOME_WRONG, "one coarser mesh: too slow");
    expect(16, around, (double[]){0.04, 0.16, 0.01}, OUTCOME_COARSE, "its own is the middle one");
    expect(16, around, (double[]){0.16, 0.04, 0.01}, OUTCOME_COARSE,
           "the middle one is out of line");
    expect(16, around, (double[]){0.01, 0.16, 0.04}, OUTCOME_WRONG, "the finest one is not best");
    return gsl_test_summary();
}
