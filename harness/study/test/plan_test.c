/* The cells of a verification: each point of the reference values must occur once, with the meshes
 * of these values. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study_impl.h"

enum { ROWS = 4, OWN_MESH = 37 };
static char plan_words[][32] = {"", "exact", "same", "m", "geometrically_exact"};

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

/* Counts the points of one case. *own: number of series of the row's formulation that contain the
 * row's mesh. */
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

static void too_many(void)
{
    refuses(0, 0, NULL);
    refuses(0, 1, "many: more than 24 meshes in a series; give fewer");
    refuses(1e7, 7, NULL);
    refuses(1e7, 8, "many: 1280000000 elements cannot be doubled again; give a smaller --refine");
}

static void plan_tests(void)
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
}

static const double length = 0.1, young = 2e11, shear_modulus = 8e10;

typedef enum omission_acting {
    NOTHING,
    BENDS,
    TWISTS,
    BUCKLES,
    VIBRATES,
    LOADINGS
} omission_acting;
static const char *const names[LOADINGS] = {"no load", "bent", "twisted", "buckled", "vibrating"};

static void leaf(scene *s, double thickness, omission_acting how, int held)
{
    const double y_axis[3] = {0, 1, 0}, end = 1;
    scene_init(s, "leaf");
    section_spec spec = section_spec_rectangle(young, shear_modulus, 0.02, thickness);
    spec.density = 7800;
    spec.given.Iw = 0;
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    if (held)
        scene_hold_all(s, root);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    if (how == BENDS)
        scene_add_load(s, SCENE_FORCE, tip, 0, 1, 0);
    if (how == TWISTS)
        scene_add_load(s, SCENE_MOMENT, tip, 1e-4, 0, 0);
    if (how == BUCKLES)
        scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    if (how == BUCKLES)
        scene_add_quantity(s, "load", "N", scene_add_buckling(s, SCENE_NONE),
                           scene_critical_factor(1, 1));
    else if (how == VIBRATES)
        scene_add_quantity(s, "frequency", "Hz", scene_add_modal(s, SCENE_NONE),
                           scene_frequency(1, SCENE_ANY));
    else {
        const int path = scene_add_static(s, 1, &end, 1);
        scene_add_quantity(s, "uy", "m", path, scene_coordinate(tip, SCENE_UY));
        scene_add_quantity(s, "rx", "rad", path, scene_coordinate(tip, SCENE_RX));
    }
}

static const element_type *rigid_one(const scene *s)
{
    for (int i = 0; registry_formulations[i] != NULL; i++)
        if (missing_omits(s, registry_formulations[i]) == FEATURE_SHEAR)
            return registry_formulations[i];
    return NULL;
}

static void of_leaf(double thickness, omission_acting how)
{
    scene s;
    omission o;
    char words[OMISSION_TEXT];
    leaf(&s, thickness, how, 1);
    const element_type *rigid = rigid_one(&s);
    omission_of(&s, rigid, &o);
    omission_words(&o, words);
    const double fine = omission_on_mesh(&s, FEATURE_SHEAR, 16);
    gsl_test(!isfinite(fine) || !isfinite(o.change), "%s, %g m thick: known: %s", names[how],
             thickness, words);
    gsl_test(o.other != (o.change > omission_most), "%s, %g m thick: %s", names[how], thickness,
             words);
    gsl_test(!o.other && fine > o.change, "%s, %g m thick: bound %g, truly %g", names[how],
             thickness, o.change, fine);
    gsl_test(o.other && !(fine > omission_most / 4), "%s, %g m thick: another model by %g only",
             names[how], thickness, fine);
    gsl_test(strstr(words, o.other ? "another model" : "changes no value") == NULL, "%s", words);
    scene_free(&s);
}

static int of_case(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    scene s;
    int seen = 0;
    unsigned known = 0;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s", f.text);
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *t = registry_formulations[i];
        omission o;
        char words[OMISSION_TEXT];
        if (missing_omits(&s, t) == 0 || missing_omits(&s, t) == known ||
            missing_refused(&s, t, words, sizeof words) || run_cost_of_scene(&s, 0, t, 16) > 1)
            continue;
        omission_of(&s, t, &o);
        known = o.what;
        const double fine = omission_on_mesh(&s, o.what, 16);
        omission_words(&o, words);
        gsl_test(o.other != !(o.change <= omission_most), "%s, %s: %s", s.name, t->name, words);
        gsl_test(isnan(o.change) && o.why[0] == '\0', "%s, %s: unknown, and no reason", s.name,
                 t->name);
        gsl_test(!o.other && isfinite(fine) && fine > o.change, "%s, %s: %s; truly %g", s.name,
                 t->name, words, fine);
        gsl_test(o.other && isfinite(o.change) && fine < omission_most / 4, "%s, %s: %s; truly %g",
                 s.name, t->name, words, fine);
        seen++;
    }
    scene_free(&s);
    return seen;
}

static void loose(void)
{
    scene s;
    omission o;
    char words[OMISSION_TEXT];
    leaf(&s, 0.001, BENDS, 0);
    omission_of(&s, rigid_one(&s), &o);
    omission_words(&o, words);
    gsl_test(!o.other || !isnan(o.change) || o.why[0] == '\0', "loose: %s", words);
    scene_free(&s);
}

static void omission_tests(void)
{
    static const double thickness[] = {2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.05};
    int seen = 0;
    for (size_t i = 0; i < sizeof thickness / sizeof *thickness; i++)
        for (int how = 0; how < LOADINGS; how++)
            of_leaf(thickness[i], (omission_acting)how);
    loose();
    for (int i = 0; registry_cases[i] != NULL; i++)
        seen += of_case(registry_cases[i]);
    gsl_test(seen < 20, "%d formulations omit something of a case", seen);
}

int main(void)
{
    plan_tests();
    omission_tests();
    return gsl_test_summary();
}
