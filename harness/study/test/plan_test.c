/* Which cells a verification consists of: the points of the truths, each once, and their meshes. A
 * row that holds at any value of a parameter (*) makes no point of its own, and speaks of all. */
#include <gsl/gsl_test.h>
#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

enum { ROWS = 4, OWN_MESH = 37 };
static char plan_words[][32] = {"", "exact", "same", "m", "geometrically_exact"};

/* The first two parameters of a case that are plain numbers. */
static int numbers_of(const case_type *type, int out[2])
{
    int count = 0;
    for (int i = 0; i < parameter_count(type->parameters) && count < 2; i++)
        if (parameter_at(type->parameters, i)->choices == NULL)
            out[count++] = i;
    return count;
}

static truth row_of(const case_type *type)
{
    truth row = {.type = type,
                 .formulation = plan_words[0],
                 .theory = plan_words[0],
                 .quantity = plan_words[3],
                 .unit = plan_words[3],
                 .kind = plan_words[1],
                 .model = plan_words[2],
                 .value = 1};
    parameters_default(type, row.parameter);
    return row;
}

/* Of one case; *own: those of its series of that formulation that have the mesh of a row. */
static int count_points(const sweep *s, const case_type *type, int *own)
{
    int points = 0;
    *own = 0;
    for (int i = 0; i < s->points; i++)
        points += s->point[i].type == type;
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < s->series[i].meshes && s->point[s->series[i].point].type == type; k++)
            *own += s->series[i].mesh[k] == OWN_MESH &&
                    strcmp(s->series[i].formulation.key, plan_words[4]) == 0;
    return points;
}

static void expect(const case_type *type, int rows, truth row[], int points, int own,
                   const char *what)
{
    const truths t = {.rows = rows, .row = row};
    const sweep_request all = {.whole_only = 1};
    sweep s;
    fault f = {""};
    int found;
    gsl_test(plan_sweep(&all, &t, &s, &f) != STATUS_OK, "%s: %s: %s", type->name, what, f.text);
    gsl_test_int(count_points(&s, type, &found), points, "%s: %s: points", type->name, what);
    gsl_test_int(found, own, "%s: %s: series with the mesh of the row", type->name, what);
    sweep_free(&s);
}

static void points(const case_type *type, const int number[2])
{
    truth row[ROWS];
    for (int i = 0; i < ROWS; i++)
        row[i] = row_of(type);
    expect(type, 1, row, 1, 0, "the defaults");
    row[1].parameter[number[0]] *= 1.25;
    row[2] = row[1];
    expect(type, 3, row, 2, 0, "another point, twice");
    row[2].parameter[number[1]] = row[1].parameter[number[1]] * 1.5 + 0.01;
    expect(type, 3, row, 3, 0, "two other points");
    row[2].any[number[0]] = 1;
    expect(type, 3, row, 2, 0, "any value of one parameter is no point");
    for (int i = 0; i < parameter_count(type->parameters); i++)
        row[2].any[i] = 1;
    row[2].formulation = plan_words[4];
    row[2].elements = OWN_MESH;
    expect(type, 3, row, 2, 2, "the mesh of a row that holds everywhere");
    row[2].any[number[0]] = 0;
    row[2].parameter[number[0]] = row[1].parameter[number[0]];
    expect(type, 3, row, 2, 1, "of one that holds at one of the points");
    row[2].parameter[number[0]] *= 1.25;
    expect(type, 3, row, 2, 0, "of one that holds at none of them");
}

/* Each series has so many meshes more, the last one of 2^n times the elements; the others as
 * before. */
static void doublings(void)
{
    const truths none = {.rows = 0};
    const sweep_request plain = {.whole_only = 1}, finer = {.whole_only = 1, .doublings = 2};
    sweep one, two;
    fault f = {""};
    gsl_test(plan_sweep(&plain, &none, &one, &f) != STATUS_OK ||
                 plan_sweep(&finer, &none, &two, &f) != STATUS_OK,
             "doublings: %s", f.text);
    gsl_test_int(two.seriess, one.seriess, "the same series");
    for (int i = 0; i < one.seriess; i++) {
        const series *a = &one.series[i], *b = &two.series[i];
        const int n = a->meshes;
        gsl_test(b->meshes != n + 2 || b->mesh[n] != 2 * a->mesh[n - 1] ||
                     b->mesh[n + 1] != 4 * a->mesh[n - 1],
                 "two meshes beyond %d elements", a->mesh[n - 1]);
        gsl_test(memcmp(a->mesh, b->mesh, (size_t)n * sizeof *a->mesh) != 0, "the others stay");
    }
    sweep_free(&one);
    sweep_free(&two);
}

/* The first case of the registry with as many meshes as a scene can have, or with one of so many
 * elements. */
static status with_meshes(const double value[], scene *s, fault *f)
{
    double defaults[CASE_MAX_PARAMETERS] = {0};
    int mesh[SCENE_MESHES];
    parameters_default(registry_cases[0], defaults);
    const status built = case_build(registry_cases[0], defaults, s, f);
    for (int i = 0; i < SCENE_MESHES; i++)
        mesh[i] = value[0] > 0 ? (int)value[0] : i + 1;
    scene_meshes(s, SCENE_MESHES, mesh);
    return built;
}

static void refuses(double elements, int doublings, const char *refusal)
{
    const parameter_type table[] = {{"elements", "1", elements, 0, 1e7, NULL, "0: 1 to 24"}, {0}};
    const case_type type = {.name = "many", .parameters = {table}, .build = with_meshes};
    const case_type *const cases[] = {&type, NULL};
    const truths none = {.rows = 0};
    const sweep_request finer = {.whole_only = 1, .cases = cases, .doublings = doublings};
    sweep s;
    fault f = {""};
    const status outcome = plan_sweep(&finer, &none, &s, &f);
    gsl_test_int((int)outcome, (int)(refusal != NULL ? STATUS_REFUSED : STATUS_OK), "%s", f.text);
    if (outcome != STATUS_OK) {
        gsl_test(refusal == NULL || strstr(f.text, refusal) == NULL, "%s", f.text);
        return;
    }
    gsl_test(s.seriess == 0 || s.series[0].meshes != (elements > 0 ? doublings + 1 : SCENE_MESHES),
             "%d doublings of %g elements: %d meshes", doublings, elements, s.series[0].meshes);
    sweep_free(&s);
}

/* What does not fit is refused: no mesh is left out. */
static void too_many(void)
{
    refuses(0, 0, NULL);
    refuses(0, 1, "many: more than 24 meshes in a series; give fewer");
    refuses(1e7, 7, NULL);
    refuses(1e7, 8, "many: 1280000000 elements cannot be doubled again; give fewer doublings");
}

int main(void)
{
    int cases = 0;
    doublings();
    too_many();
    for (int i = 0; registry_cases[i] != NULL; i++) {
        int number[2];
        double value[CASE_MAX_PARAMETERS] = {0};
        parameters_default(registry_cases[i], value);
        if (numbers_of(registry_cases[i], number) < 2 || value[number[0]] == 0)
            continue;
        points(registry_cases[i], number);
        cases++;
    }
    gsl_test(cases < 10, "%d cases have two numbers", cases);
    return gsl_test_summary();
}
