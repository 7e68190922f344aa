/* Summary of a sweep with artificial rows: percentages, the map, and the worst points. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"
#include "harness/formulations/formulations.h"

enum { POINTS = 6, MESHES = 2 };

static const parameter_type table[] = {
    {"a", "m", 1, -100, 100, NULL, ""},
    {"b", "m", 1, -100, 100, NULL, ""},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};
static const case_type box = {.name = "box", .parameters = {table}};

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

/* errors of both quantities at each point, with 4 and 8 elements */
static const double errors[POINTS][MESHES][2] = {
    {{0.001, 0.002}, {0.0001, 0.0002}}, /* both quantities are within the tolerance with 4 and more
                                           elements */
    {{0.02, 0.002}, {0.003, 0.0002}},   /* the first quantity is within the tolerance only with 8
                                           elements */
    {{0.001, 0.002}, {0.05, 0.0002}},   {{NAN, NAN}, {NAN, NAN}}, /* no solution */
    {{NAN, 0.004}, {NAN, -0.0004}}, /* the first quantity has no reference value */
    {{NAN, NAN}, {NAN, NAN}},       /* no scene */
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
            w->uncertainty[rows_quantity(w, i, q)] = 1e-4 * i;
        }
    w->kind[rows_quantity(w, 4, 0)] = ROWS_NONE;
    w->kind[rows_quantity(w, 1, 0)] = ROWS_STORED;
}

static void series_are(const tally *t)
{
    const tally_series *first = tally_of(t, 0, 0), *second = tally_of(t, 0, 1),
                       *all = tally_of(t, 0, 2);
    gsl_test_int((int)first->requested, 4, "points with a reference");
    gsl_test_int((int)first->within[0], 2, "within with 4");
    gsl_test_int((int)first->within[1], 2, "within with 8");
    gsl_test_int((int)first->never, 2, "never: an error that comes back, no solution");
    gsl_test_int((int)second->requested, 5, "points with a reference, the other quantity");
    gsl_test_int((int)second->never, 1, "never, the other quantity");
    gsl_test_int(second->everywhere, 4, "enough, but for those");
    gsl_test_int((int)first->proven, 1, "points measured by a reference value");
    gsl_test_int((int)second->proven, 0, "none, the other quantity");
    gsl_test_int((int)all->proven, 1, "points where one of all is measured by a reference value");
    gsl_test_int((int)first->open, 1, "points with a value that nothing measures");
    gsl_test_int((int)second->open, 0, "none, the other quantity");
    gsl_test_int((int)all->open, 1, "points where one of all is not measured");
    gsl_test_int((int)all->requested, 4, "points where all are measured");
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
    gsl_test_int((int)tally_at(t, 0, 0, 0, 2)->requested, 0, "a field without a reference");
    gsl_test_int((int)tally_at(t, 0, 2, 0, 2)->requested, 0, "a field where one is not measured");
    gsl_test_int((int)tally_at(t, 0, 2, 1, 2)->points, 0, "a field without a scene");
    gsl_test_int((int)tally_at(t, 0, 0, 1, 0)->proven, 1, "a field measured by a reference value");
    gsl_test_int((int)tally_at(t, 0, 0, 0, 0)->proven, 0, "a field measured by a limit");
    gsl_test_rel(tally_edge(t, 0, 1), 1, 0, "second column");
    gsl_test_rel(tally_edge(t, 1, 1), 20, 0, "second line");
}

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
    gsl_test_rel(t->uncertainty[1], 4e-4, 1e-15, "the largest doubt");
}

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

static void tally_tests(void)
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
}

static const parameter_type axis_table[] = {
    {"width", "m", 0.05, 1e-3, 10, NULL, "of a strip"},
    {"turn", "rad", 0, -1, 1, NULL, "of an end"},
    {"shear", "1", 1, 0, 1, NULL, "0 or 1"},
    {"ends", "", 0, 0, 0, "fixed|free|sliding", "how they are held"},
    {NULL, NULL, 0, 0, 0, NULL, NULL},
};
static const case_type strip = {.name = "strip", .parameters = {axis_table}};

static sweep_axis read_good(const char *text)
{
    sweep_axis a;
    fault f = {""};
    gsl_test(axis_read(&strip, text, &a, &f) != STATUS_OK, "%s is read: %s", text, f.text);
    return a;
}

static void values_are(const char *text, axis_kind kind, int count, const double right[])
{
    sweep_axis a = read_good(text);
    gsl_test(a.kind != kind, "%s: kind %s", text, axis_kind_name(a.kind));
    gsl_test_int(a.count, count, "%s: values", text);
    for (int i = 0; i < a.count && i < count; i++)
        gsl_test_rel(axis_value(&a, i), right[i], 4e-16, "%s: value %d", text, i);
    axis_free(&a);
}

static void ends_are_exact(void)
{
    sweep_axis a = read_good("width=0.2..0.9/7"), b = read_good("width=0.2..0.9/7:log");
    gsl_test(axis_value(&a, 0) != 0.2 || axis_value(&a, 7) != 0.9, "equal parts");
    gsl_test(axis_value(&b, 0) != 0.2 || axis_value(&b, 7) != 0.9, "equal ratios");
    axis_free(&a);
    axis_free(&b);
}

static void shares(void)
{
    sweep_axis a = read_good("turn=-1..1"), b = read_good("width=0.01..1:log"),
               c = read_good("ends=free,fixed");
    gsl_test_int(a.count, 0, "a range without parts has no values");
    gsl_test_rel(axis_at(&a, 0.25), -0.5, 1e-15, "a quarter of the way");
    gsl_test_rel(axis_at(&b, 0.5), 0.1, 1e-15, "half of the ratio");
    gsl_test_int((int)axis_at(&c, 0.49), 1, "the first word");
    gsl_test_int((int)axis_at(&c, 0.5), 0, "the second word");
    gsl_test_int((int)axis_at(&c, 0.999999), 0, "the second word to the end");
    axis_free(&c);
}

static void is_refused(const char *text, const char *word)
{
    sweep_axis a;
    fault f = {""};
    gsl_test(axis_read(&strip, text, &a, &f) != STATUS_REFUSED, "%s is refused", text);
    gsl_test(strstr(f.text, word) == NULL, "%s: says '%s': %s", text, word, f.text);
}

static void axis_tests(void)
{
    values_are("width=0.1..0.5/4", AXIS_LINEAR, 5, (const double[]){0.1, 0.2, 0.3, 0.4, 0.5});
    values_are("turn=1..-1/2", AXIS_LINEAR, 3, (const double[]){1, 0, -1});
    values_are("width=0.001..10/4:log", AXIS_LOG, 5, (const double[]){0.001, 0.01, 0.1, 1, 10});
    values_are("turn=-1..-0.01/2:log", AXIS_LOG, 3, (const double[]){-1, -0.1, -0.01});
    values_are("width=0.3,0.1", AXIS_LIST, 2, (const double[]){0.3, 0.1});
    values_are("shear=0..1/1", AXIS_LINEAR, 2, (const double[]){0, 1});
    values_are("ends=sliding,fixed", AXIS_WORDS, 2, (const double[]){2, 0});
    ends_are_exact();
    shares();
    is_refused("widht=1..2/3", "did you mean 'width'");
    is_refused("width", "NAME=1..2/4");
    is_refused("width=", "NAME=1..2/4");
    is_refused("width=1..20/3", "outside its range");
    is_refused("width=1..11/3", "outside its range");
    is_refused("width=1,20", "outside its range");
    is_refused("width=1mm..2/3",
               "write a range such as width=1..2/4, with numbers in m, without the unit");
    is_refused("width=1..2/2.5", "whole number");
    is_refused("width=1..2/0", "whole number");
    is_refused("width=1..1/2", "a single value");
    is_refused("turn=-1..1/2:log", "the same sign");
    is_refused("width=1..2/2:ln", "equal ratios");
    is_refused("width=1,1", "twice");
    is_refused("width=1,,2", "missing");
    is_refused("shear=0..1/2", "give 0 or 1");
    is_refused("shear=0..1", "give 0 or 1");
    is_refused("ends=fixed..free/1", "fixed|free|sliding");
    is_refused("ends=fixd", "unknown choice");
}

static void report(const char *key, const checks_family *family, const check_results *c)
{
    for (int i = 0; i < c->count; i++)
        gsl_test(c->check_result[i].outcome == CHECK_FAILED, "%s, %s: %s (%.1e, allowed %.1e) %s",
                 key, family->name, c->check_result[i].name, c->check_result[i].worst,
                 c->check_result[i].allowed, c->check_result[i].sentence);
    gsl_test(c->count == 0, "%s, %s: %d comparisons", key, family->name, checks_compared(c));
}

static void interface_tests(void)
{
    int compared = 0, by_matrices = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        formulation chosen;
        formulation_default(registry_formulations[i], &chosen);
        by_matrices += (chosen.type->offers & FEATURE_COUPLED) != 0;
        for (int k = 0; k < CHECKS_FAMILIES; k++) {
            static check_results c;
            memset(&c, 0, sizeof c);
            checks_families[k].run(&chosen, &c);
            report(chosen.key, &checks_families[k], &c);
            compared += checks_compared(&c);
        }
    }
    gsl_test(compared < 100000, "%d comparisons", compared);
    gsl_test(by_matrices < 1, "%d formulations carry sections by their matrices", by_matrices);
}

enum { PLACES = 8 };

static const parameter_type map_table[] = {{"a", "m", 1, -100, 100, NULL, ""}, {0}};
static const case_type map_box = {.name = "box", .parameters = {map_table}};

static const struct {
    tally_place place;
    const char *mixed, *alike;
} field[PLACES] = {
    {{.points = 0}, ".", "."},
    {{.points = 2, .other = 2}, "o", "o"},
    {{.points = 2}, "?", "?"},
    {{.points = 2, .requested = 2, .never = 1, .proven = 1}, "-*", "-"},
    {{.points = 2, .requested = 2, .never = 1}, "-", "-"},
    {{.points = 2, .requested = 2, .proven = 1, .least = 4}, "4*", "4"},
    {{.points = 2, .requested = 2, .least = 8}, "8", "8"},
    {{.points = 2, .requested = 1, .proven = 1, .least = 4}, "4*?", "4?"},
};

static void map_map_is(int mixed)
{
    parameter_ranges r = {.request = {.type = &map_box, .tolerance = 0.01},
                          .formulations = 1,
                          .meshes = 2,
                          .mesh = {4, 8},
                          .quantities = 1,
                          .points_in_batch = PLACES,
                          .batches = 1};
    tally t;
    fault f = {""};
    char *text = NULL;
    size_t size = 0;
    axis_read(&map_box, "a=0..7/7", &r.axis[0], NULL);
    design_make(DESIGN_GRID, 1, r.axis, 0, 0, &r.design, NULL);
    snprintf(r.formulation[0].key, sizeof r.formulation[0].key, "beam");
    gsl_test(tally_alloc(&r, &t, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(t.columns, PLACES, "columns");
    for (int q = 0; q < 2; q++) {
        t.series[q].requested = 11;
        t.series[q].proven = mixed ? 3 : 11;
        for (int i = 0; i < PLACES; i++)
            t.map[q * PLACES + i] = field[i].place;
    }
    FILE *to = open_memstream(&text, &size);
    ranges_table_map(to, &t, 1);
    fclose(to);
    int lines = 0;
    for (const char *at = text; (at = strstr(at, "\n  beam ")) != NULL; lines++) {
        char word[16];
        at += strlen("\n  beam ");
        for (int i = 0; i < PLACES; i++) {
            int length = 0;
            sscanf(at, "%15s%n", word, &length);
            at += length;
            gsl_test_str(word, mixed ? field[i].mixed : field[i].alike, "field %d, mixed: %d", i,
                         mixed);
        }
    }
    gsl_test(lines == 0, "a map is drawn: %s", text);
    free(text);
    tally_free(&t);
}

static void map_tests(void)
{
    map_map_is(0);
    map_map_is(1);
}

int main(void)
{
    tally_tests();
    axis_tests();
    interface_tests();
    map_tests();
    return gsl_test_summary();
}
