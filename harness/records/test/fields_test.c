/* Every column must contain the data that its name states. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/records.h"
#include "harness/study/study.h"

enum { MESHES = 6, STATIONS = 3, STEPS = 2 };
static const case_type made_up = {.name = "made_up"};
static const element_type element = {.name = "element"};

typedef struct fields_bench {
    sweep s;
    sweep_point p;
    series one;
    cell_result cell[MESHES];
    quantity_result quantity[MESHES][2];
    step_record step[STEPS];
    iteration_record iteration[5];
    nodal_matrices matrices;
    double path[STATIONS], compliance[36 * STATIONS], stiffness[36 * STATIONS], curve[4];
    truth row, other;
    verdict v;
    coverage c;
    evaluation j;
} fields_bench;

static void fill_path(fields_bench *b)
{
    for (int i = 0; i < 36 * STATIONS; i++) {
        b->compliance[i] = 100 + i;
        b->stiffness[i] = 1000 + i;
        b->path[i / 36] = 7 + i / 36;
    }
    b->matrices = (nodal_matrices){.stations = STATIONS,
                                   .path = b->path,
                                   .compliance = b->compliance,
                                   .stiffness = b->stiffness};
    b->step[0] = (step_record){.first = 0, .iterations = 2};
    b->step[1] = (step_record){.first = 2, .iterations = 3};
    for (int i = 0; i < 5; i++)
        b->iteration[i].correction = i + 1;
}

static void make(fields_bench *b)
{
    memset(b, 0, sizeof *b);
    b->p.type = &made_up;
    scene_init(&b->p.scene, "made_up");
    scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    scene_add_quantity(&b->p.scene, "force", "N", 0, scene_coordinate(0, SCENE_UX));
    b->row.value = 2;
    b->other.value = 4;
    fill_path(b);
    b->one = (series){
        .formulation = {.type = &element, .key = "element"}, .meshes = MESHES, .cell = b->cell};
    for (int i = 0; i < MESHES; i++) {
        b->one.mesh[i] = 1 << i;
        b->quantity[i][0] = (quantity_result){.value = 2 * (1 + 0.4 * pow(0.1, i)),
                                              .curve = {2 + i, b->curve, b->curve}};
        b->quantity[i][1] = (quantity_result){.value = 1, .curve = {3, b->curve, b->curve}};
        b->cell[i].solve = (solve_result){.quantities = 2,
                                          .quantity = b->quantity[i],
                                          .steps = STEPS,
                                          .step = b->step,
                                          .iterations = 5,
                                          .iteration = b->iteration,
                                          .matrix_sets = 1,
                                          .matrices = &b->matrices};
        b->cell[i].counters = (counters){.strain_evaluations = 11,
                                         .stress_evaluations = 12,
                                         .inertia_evaluations = 13,
                                         .iterations = 14,
                                         .steps = 15,
                                         .rejected_steps = 16,
                                         .factorisations = 17,
                                         .numerics = {18, 19, 20, 23},
                                         .negative_pivots = 21,
                                         .geometric_evaluations = 22};
    }
    b->s = (sweep){.points = 1, .seriess = 1, .point = &b->p, .series = &b->one};
    b->v.truth = &b->row;
    b->v.model_truth = &b->other;
    for (int k = 0; k < COVERAGE_MESHES; k++) {
        b->c.series[k] = 50 - k;
        b->c.covered[k] = 40 - k;
    }
    b->j = (evaluation){.verdicts = 1, .verdict = &b->v};
}

/* Returns number k of a field of a record, or NAN if the field does not exist. */
static double number_of(const record_type *type, const subject *s, const char *name, int k)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(type, KEY_AROUND, list);
    for (int i = 0; i < count; i++)
        if (strcmp(list[i]->name, name) == 0) {
            field_value v;
            schema_read(s, list[i], &v);
            return list[i]->kind == FIELD_DOUBLE ? v.numbers[k] : (double)v.whole;
        }
    return NAN;
}

static void expect(const record_type *type, const subject *s, const char *name, int k, double right)
{
    const double is = number_of(type, s, name, k);
    gsl_test(!(fabs(is - right) <= 1e-12 * fabs(right)), "%s.%s[%d]: %g, not %g", type->name, name,
             k, is, right);
}

static void work(const gathering *g)
{
    static const char *const name[] = {
        "strain_evaluations", "stress_evaluations", "inertia_evaluations", "iterations",
        "load_steps",         "rejected_steps",     "factorisations",      "solutions",
        "solved_entries",     "factor_flops",       "negative_pivots",     "geometric_evaluations",
        "dense_operations"};
    const subject s = gather_cell(g, 0, 3);
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
        expect(&record_cell, &s, name[i], 0, 11 + (double)i);
    expect(&record_cell, &s, "elements", 0, 8);
    expect(&record_cell, &s, "priced", 0, 0);
    expect(&record_cell, &s, "cost", 0, counted_cost(&s.series->formulation, &s.series->cell[3]));
    gsl_test(!(number_of(&record_cell, &s, "cost", 0) > 0), "a formulation without prices costs");
}

static void levels(const gathering *g, const fields_bench *b)
{
    static const char *const name[] = {"reach_10", "reach_1", "reach_0.1", "reach_0.01"};
    const subject s = gather_verdict(g, &b->v);
    for (int i = 0; i < 4; i++)
        expect(&record_verdict, &s, name[i], 0, 2 << i);
    expect(&record_verdict, &s, "truth", 0, 2);
    expect(&record_verdict, &s, "model_truth", 0, 4);
}

static void coverages(const gathering *g, const fields_bench *b)
{
    for (int k = 0; k < COVERAGE_MESHES; k++) {
        const subject s = gather_coverage(g, &b->c, k);
        expect(&record_coverage, &s, "series", 0, 50 - k);
        expect(&record_coverage, &s, "covered", 0, 40 - k);
    }
}

static void paths(const gathering *g)
{
    subjects list = {0};
    gather_mesh(g, &record_matrix, 0, 2, &list);
    gsl_test_int(list.count, STATIONS, "a record for each station");
    for (int i = 0; i < list.count; i++) {
        expect(&record_matrix, &list.row[i], "path", 0, 7 + i);
        for (int k = 0; k < 36; k++) {
            expect(&record_matrix, &list.row[i], "compliance", k, 100 + 36 * i + k);
            expect(&record_matrix, &list.row[i], "stiffness", k, 1000 + 36 * i + k);
        }
    }
    list.count = 0;
    gather_mesh(g, &record_iteration, 0, 2, &list);
    gsl_test_int(list.count, 5, "a record for each iteration");
    for (int i = 0; i < list.count; i++) {
        expect(&record_iteration, &list.row[i], "step", 0, i < 2 ? 0 : 1);
        expect(&record_iteration, &list.row[i], "iteration", 0, i < 2 ? i : i - 2);
        expect(&record_iteration, &list.row[i], "correction", 0, i + 1);
    }
    gather_free(&list);
}

static void curves(const gathering *g)
{
    subjects list = {0};
    double first = 0;
    gather_mesh(g, &record_curve, 0, 2, &list);
    gather_mesh(g, &record_curve, 0, 3, &list);
    gsl_test_int(list.count, 4, "a record for each curve");
    for (int i = 0; i < list.count; i++) {
        expect(&record_curve, &list.row[i], "first", 0, first);
        first += number_of(&record_curve, &list.row[i], "points", 0);
    }
    gsl_test_abs(first, 4 + 3 + 5 + 3, 0, "all points");
    gather_free(&list);
}

static void errors(const gathering *g)
{
    subjects list = {0};
    gather_mesh(g, &record_quantity, 0, 1, &list);
    gsl_test_int(list.count, 2, "a record for each quantity");
    expect(&record_quantity, &list.row[0], "error", 0, 0.04);
    expect(&record_quantity, &list.row[0], "model_error", 0, 2.08 / 4 - 1);
    gather_free(&list);
}

static void timings(void)
{
    cell_timing t = {.as_is = {.setup = 1, .solve = 2, .rounds = ROUNDS_COUNT},
                     .keep_all = {.setup = 3, .solve = 4, .rounds = ROUNDS_COUNT},
                     .free_keep_all = 7};
    const subject s = {.record = &t};
    static const char *const part[PHASES] = {"seconds_elements", "seconds_assembly",
                                             "seconds_factorisation", "seconds_solution",
                                             "seconds_rest"};
    for (int k = 0; k < ROUNDS_COUNT; k++) {
        t.as_is.round[k] = 20 - k;
        t.keep_all.round[k] = 30 - k;
    }
    for (int k = 0; k < PHASES; k++)
        t.phase[k] = 40 + k;
    for (int k = 0; k < ROUNDS_COUNT; k++) {
        char name[32];
        snprintf(name, sizeof name, "round_%d", k + 1);
        expect(&record_timing, &s, name, 0, 20 - k);
        snprintf(name, sizeof name, "keep_all_round_%d", k + 1);
        expect(&record_timing, &s, name, 0, 30 - k);
    }
    for (int k = 0; k < PHASES; k++)
        expect(&record_timing, &s, part[k], 0, 40 + k);
    expect(&record_timing, &s, "seconds_setup", 0, 1);
    expect(&record_timing, &s, "seconds_solve", 0, 2);
    expect(&record_timing, &s, "seconds_least", 0, 21 - ROUNDS_COUNT);
    expect(&record_timing, &s, "seconds_most", 0, 20);
    expect(&record_timing, &s, "keep_all_setup", 0, 3);
    expect(&record_timing, &s, "keep_all_solve", 0, 4);
    expect(&record_timing, &s, "keep_all_free", 0, 7);
    t.as_is.rounds = t.keep_all.rounds = 0;
    gsl_test(!isnan(number_of(&record_timing, &s, "round_2", 0)), "no round was run");
    gsl_test(!isnan(number_of(&record_timing, &s, "keep_all_setup", 0)), "nor one of all");
}

static element_order order_of(element_analysis a, const double options[])
{
    (void)options;
    return (element_order){10 * (int)a + 1, 10 * (int)a + 2};
}

static void declarations(void)
{
    static const element_type ordered = {.name = "ordered", .order = order_of};
    static const struct {
        const char *name;
        element_analysis analysis;
    } row[] = {{"statics", ELEMENT_STATICS},
               {"vibration", ELEMENT_VIBRATION},
               {"buckling", ELEMENT_BUCKLING}};
    const series one = {.formulation = {.type = &ordered, .key = "ordered"}};
    const subject s = {.series = &one};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s_least", row[i].name);
        expect(&record_declaration, &s, name, 0, 10 * row[i].analysis + 1);
        snprintf(name, sizeof name, "%s_highest", row[i].name);
        expect(&record_declaration, &s, name, 0, 10 * row[i].analysis + 2);
    }
}

static void fields_tests(void)
{
    static fields_bench b;
    make(&b);
    const gathering g = {&b.s, &b.j, NULL};
    work(&g);
    levels(&g, &b);
    coverages(&g, &b);
    paths(&g);
    curves(&g);
    errors(&g);
    timings();
    declarations();
    scene_free(&b.p.scene);
}

enum { LINE_MESHES = 5, SERIES = 4 };
static const parameter_type parameter[] = {{.name = NULL}};
static const case_type line_made_up = {
    .name = "made_up", .summary = "of the test", .source = "none", .parameters = {parameter}};
static const element_type type[SERIES] = {{.name = "red", .family = "red", .abi = ELEMENT_ABI},
                                          {.name = "blue", .family = "blue", .abi = ELEMENT_ABI},
                                          {.name = "green", .family = "green", .abi = ELEMENT_ABI},
                                          {.name = "grey", .family = "grey", .abi = ELEMENT_ABI}};

typedef struct reach_line_bench {
    sweep s;
    sweep_point p;
    series one[SERIES];
    cell_result cell[SERIES][LINE_MESHES];
    quantity_result quantity[SERIES][LINE_MESHES];
    truths t;
} reach_line_bench;

/* Adds a series with the values limit (1 + 0.1 n^-2). There are `work` evaluations on the coarsest
 * mesh and twice as many on each finer mesh. */
static void add(reach_line_bench *b, double limit, long work)
{
    const int i = b->s.seriess++;
    b->one[i] =
        (series){.formulation = {.type = &type[i]}, .meshes = LINE_MESHES, .cell = b->cell[i]};
    strcpy(b->one[i].formulation.key, type[i].name);
    for (int k = 0; k < LINE_MESHES; k++) {
        const double n = b->one[i].mesh[k] = 2 << k;
        b->quantity[i][k].value = limit * (1 + 0.1 / n / n);
        b->cell[i][k].size.strains = 8;
        b->cell[i][k].counters.strain_evaluations = work << k;
        b->cell[i][k].solve.quantities = 1;
        b->cell[i][k].solve.quantity = &b->quantity[i][k];
    }
}

static void line_make(reach_line_bench *b, double times)
{
    fault f;
    memset(b, 0, sizeof *b);
    b->p.type = &line_made_up;
    scene_init(&b->p.scene, "made_up");
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    q->tolerance = 1e-4;
    q->least_order = 2;
    b->s = (sweep){.points = 1, .point = &b->p, .series = b->one};
    add(b, 3, 1000000);
    add(b, 3, (long)(1000000 * times));
    add(b, 3, 9000000);
    add(b, 3.3, 10000);
    gsl_test(families_add_truths(&b->s, 0, &b->t, &f) != STATUS_OK || b->t.rows != 1, "agreed");
}

static void add_model(reach_line_bench *b, const char *kind, double value)
{
    truth *row = realloc(b->t.row, (size_t)(b->t.rows + 1) * sizeof *row);
    gsl_test(row == NULL, "room for a reference value");
    b->t.row = row;
    row[b->t.rows++] = (truth){.type = &line_made_up,
                               .formulation = strdup(""),
                               .theory = strdup(""),
                               .quantity = strdup("load"),
                               .unit = strdup("N"),
                               .kind = strdup(kind),
                               .model = strdup("other"),
                               .convention = strdup(""),
                               .source = strdup("of the test"),
                               .value = value};
}

static void add_quantity(reach_line_bench *b, const char *name, scene_reduction reduction)
{
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, name, "N", 0, scene_coordinate(0, SCENE_UX));
    q->reduction = reduction;
}

static void finish(reach_line_bench *b)
{
    truths_free(&b->t);
    scene_free(&b->p.scene);
}

static void line_of(const reach_line_bench *b, double level, char out[1000])
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    reach_line_write(to, &b->s, &b->t, level);
    reach_model_write(to, &b->s, &b->t, level);
    fclose(to);
    for (const char *at = text; *at != '\0';) {
        const char *end = strncmp(at, " (", 2) == 0 ? strchr(at, ')') : NULL;
        if (end != NULL && strncmp(end - 3, " ms", 3) == 0)
            at = end + 1;
        else
            *out++ = *at++;
    }
    *out = '\0';
    free(text);
}

static void line_expect(const reach_line_bench *b, double level, const char *right)
{
    char line[1000];
    line_of(b, level, line);
    gsl_test(strcmp(line, right) != 0, "'%s', not '%s'", line, right);
}

static void not_every_quantity(void)
{
    reach_line_bench b;
    line_make(&b, 2 * counted_cost_noise);
    add_quantity(&b, "curve", SCENE_CURVE);
    line_expect(
        &b, 1e-9,
        "for 1e-07 % in every quantity (curves are not included: curve): no formulation on these "
        "meshes; not reached by red (load: 0.0098 %), blue (load: 0.0098 %), green (load: 0.0098 "
        "%), "
        "grey (load: 10 %)\n");
    add_quantity(&b, "sway", SCENE_LAST);
    add_quantity(&b, "tilt", SCENE_LAST);
    b.s.seriess = 3;
    line_expect(&b, 0.01,
                "for 1 % in 1 of 3 quantities (without a reference: sway, tilt; curves are not "
                "included: curve): red n = 4; blue n = 4; "
                "green n = 4; no own cost coefficients: red, blue, green\n");
    b.s.seriess = 1;
    b.t.rows--;
    line_expect(&b, 0.01,
                "for 1 % in no quantity (without a reference: load, sway, tilt; curves are not "
                "included: curve): no ranking; give "
                "'truths' in the scene, or formulations of other families (-f)\n");
    b.t.rows++;
    finish(&b);
}

static void other_models(void)
{
    reach_line_bench b;
    line_make(&b, 2 * counted_cost_noise);
    b.s.seriess = 1;
    add_model(&b, "agreement", 4);
    line_expect(&b, 0.01, "for 1 % in every quantity: red n = 4; no own cost coefficients: red\n");
    add_model(&b, "independent", 3.1);
    line_expect(
        &b, 0.01,
        "for 1 % in every quantity: red n = 4; no own cost coefficients: red\n"
        "The beam model differs from the structure: load of another model is 3.1 N (of the "
        "test); the limit of "
        "red differs from it by -3.2 %. The target error of 1 % applies only to the beam model.\n");
    line_expect(&b, 1e-9,
                "for 1e-07 % in every quantity: no formulation on these meshes; not reached by red "
                "(load: 0.0098 %)\n");
    b.s.seriess = 4;
    line_expect(
        &b, 0.2,
        "for 20 % in every quantity: grey n = 2; red n = 2; blue n = 2; green n = 2; no own "
        "cost coefficients: grey, red, blue, green\n"
        "The beam model differs from the structure: load of another model is 3.1 N (of the test); "
        "the limit of "
        "grey differs from it by +6.5 %. The target error of 20 % applies only to the beam "
        "model.\n");
    finish(&b);
}

static void reach_line_tests(void)
{
    reach_line_bench b;
    line_make(&b, 2 * counted_cost_noise);
    line_expect(&b, 0.01,
                "for 1 % in every quantity: red n = 4; blue n = 4; green n = 4; no own cost "
                "coefficients: red, blue, green; not reached by grey (load: 10 %)\n");
    line_expect(
        &b, 1e-9,
        "for 1e-07 % in every quantity: no formulation on these meshes; not reached by red "
        "(load: 0.0098 %), blue (load: 0.0098 %), green (load: 0.0098 %), grey (load: 10 %)\n");
    finish(&b);
    line_make(&b, 1 + (counted_cost_noise - 1) / 2);
    line_expect(
        &b, 0.2,
        "for 20 % in every quantity: grey n = 2; red n = 2; blue n = 2; green n = 2; no own "
        "cost coefficients: grey, red, blue, green\n");
    line_expect(&b, 0.03,
                "for 3 % in every quantity: red n = 2, blue n = 2: costs tie; green n = 2; "
                "no own cost coefficients: red, blue, green; not reached by grey "
                "(load: 10 %)\n");
    finish(&b);
    not_every_quantity();
    other_models();
}

int main(void)
{
    fields_tests();
    reach_line_tests();
    return gsl_test_summary();
}
