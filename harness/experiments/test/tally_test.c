/* What a sweep comes to, of rows made by hand: shares, the map, the worst points. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/experiments/experiments.h"

enum { POINTS = 6, MESHES = 2 };

static const parameter_type table[] = {
    {"a", "m", 1, -100, 100, NULL, ""},
    {"b", "m", 1, -100, 100, NULL, ""},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};
static const case_type box = {.name = "box", .parameters = {table}};

/* A grid of 3 x 2 points, one formulation, meshes 4 and 8, two quantities. */
static void make(parameter_ranges *r)
{
    memset(r, 0, sizeof *r);
    r->request = (ranges_request){.type = &box, .tolerance = 0.01};
    axis_read(&box, "a=0..2/2", &r->axis[0], NULL);
    axis_read(&box, "b=10,20", &r->axis[1], NULL);
    design_make(DESIGN_GRID, 2, r->axis, 0, 0, &r->design, NULL);
    r->formulations = 1;
    r->meshes = MESHES;
    r->mesh[0] = 4;
    r->mesh[1] = 8;
    r->quantities = 2;
    r->points_in_batch = POINTS;
    r->batches = 1;
}

/* Errors of both quantities with 4 and 8 elements at each point. */
static const double errors[POINTS][MESHES][2] = {
    {{0.001, 0.002}, {0.0001, 0.0002}}, /* within from 4 on */
    {{0.02, 0.002}, {0.003, 0.0002}},   /* the first from 8 on */
    {{0.001, 0.002}, {0.05, 0.0002}},   /* the first never: the finer mesh is off */
    {{NAN, NAN}, {NAN, NAN}},           /* no solution with 8 */
    {{NAN, 0.004}, {NAN, -0.0004}},     /* the first has no reference */
    {{NAN, NAN}, {NAN, NAN}},           /* no scene */
};
static const int least[POINTS][2] = {{4, 4}, {8, 4}, {0, 4}, {0, 0}, {0, 4}, {0, 0}};

static void fill(rows *w)
{
    for (int i = 0; i < POINTS; i++)
        for (int q = 0; q < 2; q++) {
            for (int k = 0; k < MESHES; k++) {
                const size_t at = rows_value(w, i, 0, k, q), cell = rows_cell(w, i, 0, k);
                w->error[at] = errors[i][k][q];
                w->value[at] = i == 3 || i == 5 ? NAN : 1;
                w->cost[cell] = 1e-3 * (k + 1);
                w->status[cell] = STATUS_OK;
                if (i == 3 && k == 1)
                    w->status[cell] = STATUS_NOT_CONVERGED;
                if (i == 5)
                    w->status[cell] = ROWS_NO_SCENE;
            }
            w->least[rows_least(w, i, 0, q)] = least[i][q];
            w->kind[rows_quantity(w, i, q)] = ROWS_LIMIT;
            w->doubt[rows_quantity(w, i, q)] = 1e-4 * i;
        }
    w->kind[rows_quantity(w, 4, 0)] = ROWS_NONE;
    w->kind[rows_quantity(w, 1, 0)] = ROWS_STORED;
}

static void series_are(const tally *t)
{
    const tally_series *first = tally_of(t, 0, 0), *second = tally_of(t, 0, 1),
                       *all = tally_of(t, 0, 2);
    gsl_test_int((int)first->asked, 4, "points with a reference");
    gsl_test_int((int)first->within[0], 2, "within with 4");
    gsl_test_int((int)first->within[1], 2, "within with 8");
    gsl_test_int((int)first->never, 2, "never: an error that comes back, no solution");
    gsl_test_int((int)second->asked, 5, "points with a reference, the other quantity");
    gsl_test_int((int)second->never, 1, "never, the other quantity");
    gsl_test_int(second->everywhere, 4, "enough, but for those");
    gsl_test_int((int)first->proven, 1, "points measured by a truth");
    gsl_test_int((int)second->proven, 0, "none, the other quantity");
    gsl_test_int((int)all->proven, 1, "points where one of all is measured by a truth");
    gsl_test_int((int)first->open, 1, "points with a value that nothing measures");
    gsl_test_int((int)second->open, 0, "none, the other quantity");
    gsl_test_int((int)all->open, 1, "points where one of all is not measured");
    gsl_test_int((int)all->asked, 4, "points where all are measured");
    gsl_test_int((int)all->within[0], 2, "all within with 4: not where one is not measured");
    gsl_test_int((int)all->never, 2, "never all");
    gsl_test_int(all->everywhere, 8, "enough for all, but for those");
}

static void map_is(const tally *t)
{
    static const int right[2][3] = {{4, 0, 0}, {8, 0, 0}};
    gsl_test(t->columns != 3 || t->lines != 2, "a map of %d x %d", t->columns, t->lines);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++) {
            const tally_place *p = tally_at(t, 0, 2, k, i);
            gsl_test_int(p->never > 0 ? 0 : p->least, right[k][i], "field %d, %d", k, i);
        }
    gsl_test_int((int)tally_at(t, 0, 0, 0, 2)->asked, 0, "a field without a reference");
    gsl_test_int((int)tally_at(t, 0, 2, 0, 2)->asked, 0, "a field where one is not measured");
    gsl_test_int((int)tally_at(t, 0, 2, 1, 2)->points, 0, "a field without a scene");
    gsl_test_int((int)tally_at(t, 0, 0, 1, 0)->proven, 1, "a field measured by a truth");
    gsl_test_int((int)tally_at(t, 0, 0, 0, 0)->proven, 0, "a field measured by a limit");
    gsl_test_rel(tally_edge(t, 0, 1), 1, 0, "second column");
    gsl_test_rel(tally_edge(t, 1, 1), 20, 0, "second line");
}

/* No solution first, then by size whatever the sign, of the finest mesh. */
static void worst_are(const tally *t)
{
    gsl_test_int(t->worsts[0], 3, "worst points");
    gsl_test(t->worst[0][0].point != 3 || t->worst[0][0].status != STATUS_NOT_CONVERGED,
             "the cell without a solution");
    gsl_test(t->worst[0][1].point != 2 || t->worst[0][1].error != 0.05, "the largest error");
    gsl_test(t->worst[0][2].point != 1 || t->worst[0][2].quantity != 0, "the next one");
    gsl_test_int((int)t->failed[1], 1, "cells without a solution");
    gsl_test_int((int)t->ran[1], 5, "cells that ran");
    gsl_test_int((int)t->without_scene, 1, "points without a scene");
    gsl_test_int((int)t->first_without, 5, "the first of them");
    gsl_test_rel(t->doubt[1], 4e-4, 1e-15, "the largest doubt");
}

/* Whether points come together or one by one. */
static void same_in_pieces(const parameter_ranges *r, const rows *whole, const tally *right)
{
    tally t;
    const rows_shape shape = ranges_shape(r);
    tally_alloc(r, &t, NULL);
    for (int i = 0; i < POINTS; i++) {
        rows one;
        rows_alloc(&shape, 1, &one, NULL);
        for (int q = 0; q < 2; q++) {
            for (int k = 0; k < MESHES; k++) {
                one.error[rows_value(&one, 0, 0, k, q)] =
                    whole->error[rows_value(whole, i, 0, k, q)];
                one.value[rows_value(&one, 0, 0, k, q)] =
                    whole->value[rows_value(whole, i, 0, k, q)];
                one.status[k] = whole->status[rows_cell(whole, i, 0, k)];
            }
            one.least[q] = whole->least[rows_least(whole, i, 0, q)];
            one.kind[q] = whole->kind[rows_quantity(whole, i, q)];
        }
        tally_add(&t, i, &one, NULL);
        rows_free(&one);
    }
    gsl_test(memcmp(t.worst[0], right->worst[0], sizeof t.worst[0]) != 0, "worst in pieces");
    gsl_test(memcmp(t.series, right->series, 3 * sizeof *t.series) != 0, "shares in pieces");
    tally_free(&t);
}

int main(void)
{
    parameter_ranges r;
    rows w;
    tally t;
    make(&r);
    const rows_shape shape = ranges_shape(&r);
    gsl_test(rows_alloc(&shape, POINTS, &w, NULL) != STATUS_OK, "rows");
    gsl_test(tally_alloc(&r, &t, NULL) != STATUS_OK, "tally");
    fill(&w);
    tally_add(&t, 0, &w, NULL);
    series_are(&t);
    map_is(&t);
    worst_are(&t);
    same_in_pieces(&r, &w, &t);
    tally_free(&t);
    rows_free(&w);
    ranges_free(&r);
    return gsl_test_summary();
}
