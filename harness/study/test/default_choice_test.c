/* The default choice of a formulation and a mesh, and the transfer of cells between processes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"
#include "harness/study/test/random_cell.h"
#include "harness/study/test/same_cell.h"

typedef struct default_choice_chosen {
    status outcome;
    formulation one;
    char why[FAULT_TEXT];
} default_choice_chosen;

static default_choice_chosen choose(const scene *s, const case_type *type, const double value[],
                                    const rule *rules, int count)
{
    default_choice_chosen out;
    fault f = {""};
    const rule_subject where = {.type = type, .parameter = value, .features = features_needed(s)};
    out.outcome = default_choice_formulation(s, &where, rules, count, &out.one, out.why, &f);
    return out;
}

static rule made_up(char *formulations, char *cases, char *verdicts)
{
    static char any[] = "*", none[] = "";
    return (rule){.name = any,
                  .formulations = formulations,
                  .cases = cases,
                  .condition = none,
                  .quantities = any,
                  .verdicts = verdicts,
                  .predicted = none,
                  .cause = any,
                  .proof = any,
                  .largest_error = 1};
}

static void of_case(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    char words[200], own[64], case_name[64], wrong[] = "wrong limit", uncertainty[] = "undecided",
                                             elsewhere[] = "another_case", any[] = "*";
    fault f = {""};
    scene s;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s: %s", type->name, f.text);
    const default_choice_chosen first = choose(&s, type, value, NULL, 0);
    const element_type *t = first.one.type;
    gsl_test(first.outcome != STATUS_OK || missing_words(&s, t, words, sizeof words) ||
                 lacks_of(&s, t, words, sizeof words),
             "%s: what is chosen offers all", type->name);
    snprintf(own, sizeof own, "%s", t->name);
    snprintf(case_name, sizeof case_name, "%s", type->name);
    const rule here = made_up(own, case_name, wrong), there = made_up(own, elsewhere, wrong),
               open = made_up(own, case_name, uncertainty), all = made_up(any, case_name, wrong);
    gsl_test(choose(&s, type, value, &here, 1).one.type == t, "%s: not with a defect here",
             type->name);
    gsl_test(choose(&s, type, value, &open, 1).one.type != t, "%s: a doubt is no defect",
             type->name);
    gsl_test(strstr(choose(&s, type, value, &all, 1).why, "but has a known deviation here") == NULL,
             "%s: where all have one, it is said", type->name);
    const default_choice_chosen other = choose(&s, type, value, &there, 1);
    gsl_test(other.one.type == t && strstr(other.why, "no known deviation here") == NULL,
             "%s: a defect elsewhere is none here", type->name);
    scene_free(&s);
}

static void of_meshes(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    default_choice found;
    fault f = {""};
    scene s;
    int here = -1;
    parameters_default(type, value);
    cell_scene(type, value, NULL, &s, &f);
    const default_choice_chosen first = choose(&s, type, value, NULL, 0);
    cell_request one = {.scene = &s};
    cell_formulation(&one, &first.one);
    gsl_test(default_choice_elements(&one, &first.one, DEFAULT_CHOICE_ERROR, &found, &f) !=
                 STATUS_OK,
             "%s: %s", type->name, f.text);
    const int n = found.elements, finest = s.mesh[s.meshes - 1];
    for (int i = 0; i < s.meshes; i++)
        here = s.mesh[i] == n ? i : here;
    gsl_test(here < 0 && (n < finest || n % finest != 0), "%s: n = %d of its meshes", type->name,
             n);
    cell_result a, b;
    one.elements = n;
    gsl_test(cell_run(&one, &a, &f) != STATUS_OK, "%s: it solves %s", type->name, f.text);
    one.elements = here < 0 ? n / 2 : here > 0 ? s.mesh[here - 1] : n;
    const status before = cell_run(&one, &b, &f);
    for (int q = 0; q < s.quantities && !found.short_of; q++)
        if (s.quantity[q].reduction != SCENE_CURVE && isfinite(a.solve.quantity[q].value))
            gsl_test(before != STATUS_OK || here == 0 ||
                         !(fabs(verdict_error(&s.quantity[q], a.solve.quantity[q].value,
                                              b.solve.quantity[q].value)) <= DEFAULT_CHOICE_ERROR),
                     "%s: %s has settled", type->name, s.quantity[q].name);
    cell_result_free(&a);
    cell_result_free(&b);
    default_choice_free(&found);
    scene_free(&s);
}

static void nothing_offers_all(void)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    scene s;
    const case_type *type = registry_cases[0];
    parameters_default(type, value);
    cell_scene(type, value, NULL, &s, &f);
    scene_demand(&s, FEATURE_END);
    gsl_test(choose(&s, type, value, NULL, 0).outcome != STATUS_REFUSED, "refused");
    scene_free(&s);
}

static void no_new_one(void)
{
    const element_type *accepted = registry_formulations[0];
    int choices = 0;
    formulations_accept(accepted->name);
    for (int i = 0; registry_cases[i] != NULL; i++) {
        double value[CASE_MAX_PARAMETERS] = {0};
        fault f = {""};
        scene s;
        parameters_default(registry_cases[i], value);
        gsl_test(cell_scene(registry_cases[i], value, NULL, &s, &f) != STATUS_OK, "%s", f.text);
        const default_choice_chosen one = choose(&s, registry_cases[i], value, NULL, 0);
        choices += one.outcome == STATUS_OK;
        gsl_test(one.outcome == STATUS_OK && one.one.type != accepted, "%s: %s is chosen and new",
                 s.name, one.one.key);
        scene_free(&s);
    }
    gsl_test(choices == 0, "the accepted one is chosen");
}

static void default_choice_tests(void)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        of_case(registry_cases[i]);
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (i % 4 == 0)
            of_meshes(registry_cases[i]);
    nothing_offers_all();
    no_new_one();
}

static void round_trips(random_source *d)
{
    enum { CELLS = 200 };
    cell_result sent[CELLS];
    FILE *file = tmpfile();
    int unwritten = 0, unread = 0;
    difference first = {NULL};
    if (file != NULL)
        for (int i = 0; i < CELLS; i++) {
            sent[i] = random_cell(d);
            unwritten += serialise_write(file, &sent[i]) != 0;
        }
    rewind(file);
    for (int i = 0; i < CELLS; i++) {
        cell_result got;
        unread += serialise_read(file, &got) != 0;
        const difference here = compare_cells(&sent[i], &got);
        if (first.name == NULL)
            first = here;
        cell_result_free(&got);
        cell_result_free(&sent[i]);
    }
    gsl_test_int(unwritten, 0, "cells that were not sent");
    gsl_test_int(unread, 0, "cells that did not arrive");
    gsl_test(first.name != NULL, "what arrives is what was sent (%s)",
             first.name != NULL ? first.name : "all");
    gsl_test_int(fgetc(file), EOF, "and nothing more");
    fclose(file);
}

static void empty_cell(void)
{
    const cell_result sent = {.solve = {.status = STATUS_SINGULAR, .reason = "nothing"}};
    cell_result got;
    FILE *file = tmpfile();
    gsl_test(file == NULL || serialise_write(file, &sent) != 0, "sent");
    rewind(file);
    gsl_test(serialise_read(file, &got) != 0 || compare_cells(&sent, &got).name != NULL,
             "an empty cell arrives");
    cell_result_free(&got);
    fclose(file);
}

static int is_empty(const cell_result *c)
{
    const solve_result *s = &c->solve;
    return c->left_out == NULL && s->quantity == NULL && s->step == NULL && s->iteration == NULL &&
           s->event == NULL && s->matrices == NULL && s->shapes.first == NULL &&
           s->shapes.state == NULL && s->shapes.point == NULL && s->shapes.node == NULL;
}

static void truncated(random_source *d, int pictured)
{
    cell_result sent = random_cell(d), got;
    if (!pictured)
        shapes_free(&sent.solve.shapes);
    char *bytes = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&bytes, &size);
    gsl_test(file == NULL || serialise_write(file, &sent) != 0 || fclose(file) != 0, "written");
    int accepted = 0, left = 0;
    for (size_t cut = 0; cut < size; cut++) {
        file = cut > 0 ? fmemopen(bytes, cut, "rb") : fopen("/dev/null", "rb");
        accepted += serialise_read(file, &got) == 0;
        left += !is_empty(&got);
        fclose(file);
    }
    file = fmemopen(bytes, size, "rb");
    gsl_test(serialise_read(file, &got) != 0, "the whole is read");
    fclose(file);
    cell_result_free(&got);
    cell_result_free(&sent);
    free(bytes);
    gsl_test(size < 1000, "%ld bytes", (long)size);
    gsl_test_int(accepted, 0, "truncated cells that were accepted");
    gsl_test_int(left, 0, "truncated cells that left something");
}

static void serialise_tests(void)
{
    random_source d = {88172645463325252ull};
    random_cell_complete();
    round_trips(&d);
    empty_cell();
    for (int i = 0; i < 6; i++)
        truncated(&d, i % 2);
}

static void run(const case_type *type, const char *const text[2], int share, sweep *s)
{
    static const int mesh[] = {1, 2};
    const sweep_request request = {.jobs = 2, .share = share};
    formulation all[64];
    int count = 0;
    fault f = {""};
    memset(s, 0, sizeof *s);
    for (; registry_formulations[count] != NULL; count++)
        formulation_default(registry_formulations[count], &all[count]);
    for (int i = 0; i < 2; i++) {
        double value[CASE_MAX_PARAMETERS] = {0};
        gsl_test(parameters_parse(type, text[i], value, NULL, &f) != STATUS_OK ||
                     plan_add(s, type, value, NULL, mesh, 2, &f) != STATUS_OK ||
                     plan_extend(s, all, count, &f) != STATUS_OK,
                 "planned %s", f.text);
    }
    gsl_test(run_sweep(&request, s, &f) != STATUS_OK, "run %s", f.text);
}

static double seconds(const cell_result *c)
{
    return c->solve.seconds_setup + c->solve.seconds_solve;
}

/* Returns the number of cells whose time is bit-for-bit that of another cell, and which therefore
 * share one solution. */
static int shared(const sweep *s)
{
    int out = 0;
    for (int i = 0; i < s->seriess; i++)
        for (int j = 0; j < i; j++)
            for (int k = 0; k < s->series[i].meshes; k++)
                out += s->series[i].missing[0] == '\0' && s->series[j].missing[0] == '\0' &&
                       seconds(&s->series[i].cell[k]) > 0 &&
                       seconds(&s->series[i].cell[k]) == seconds(&s->series[j].cell[k]);
    return out;
}

static void clear_times(cell_result *c)
{
    c->solve.seconds_setup = c->solve.seconds_solve = 0;
    memset(c->solve.phase, 0, sizeof c->solve.phase);
}

static void same_answers(const char *name, const char *first, const char *second)
{
    const char *const text[2] = {first, second};
    fault f = {""};
    sweep once, each;
    int cells = 0;
    const case_type *type = case_find(name, &f);
    run(type, text, 1, &once);
    run(type, text, 0, &each);
    gsl_test(shared(&once) == 0, "%s: something is solved once", name);
    /* two measured times may be equal by chance */
    gsl_test(shared(&each) > 1, "%s: nothing is, unless it was asked for", name);
    for (int i = 0; i < once.seriess; i++)
        for (int k = 0; k < once.series[i].meshes && once.series[i].missing[0] == '\0'; k++) {
            cell_result *a = &once.series[i].cell[k], *b = &each.series[i].cell[k];
            clear_times(a);
            clear_times(b);
            const difference d = compare_cells(a, b);
            gsl_test(d.name != NULL, "%s, %s, n = %d: %s", name, once.series[i].formulation.key,
                     once.series[i].mesh[k], d.name);
            cells++;
        }
    gsl_test(cells == 0, "%s: cells", name);
    sweep_free(&once);
    sweep_free(&each);
}

static void share_tests(void)
{
    same_answers("sheet_cantilever", "", "shear=0");
    same_answers("c_cantilever", "", "shear=0");
    same_answers("rotating_cantilever", "", "omega_star=2");
}

int main(void)
{
    default_choice_tests();
    serialise_tests();
    share_tests();
    return gsl_test_summary();
}
