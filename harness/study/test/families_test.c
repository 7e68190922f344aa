/* Agreement between formulations: the required number of families, the agreed limit, and cases
 * without agreement. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/study/study_impl.h"

enum { MESHES = 5, MOST = 6 };
static const int mesh[MESHES] = {2, 4, 8, 16, 32};
static const parameter_type parameter[] = {{.name = NULL}};
static const case_type made_up = {
    .name = "made_up", .summary = "of the test", .source = "none", .parameters = {parameter}};
static const element_type type[] = {
    {.name = "red_one", .family = "red", .abi = ELEMENT_ABI},
    {.name = "red_two", .family = "red", .abi = ELEMENT_ABI},
    {.name = "blue_one", .family = "blue", .abi = ELEMENT_ABI},
    {.name = "green_one", .family = "green", .abi = ELEMENT_ABI},
    {.name = "blue_two", .family = "blue", .abi = ELEMENT_ABI},
    {.name = "misprinted", .family = "grey", .misprint = "Eq. 1", .abi = ELEMENT_ABI}};
enum { RED_ONE, RED_TWO, BLUE_ONE, GREEN_ONE, BLUE_TWO, MISPRINTED };

typedef struct families_bench {
    sweep s;
    sweep_point p;
    series one[MOST];
    cell_result cell[MOST][MESHES];
    quantity_result quantity[MOST][MESHES];
    truths t;
} families_bench;

static void make(families_bench *b)
{
    memset(b, 0, sizeof *b);
    b->p.type = &made_up;
    scene_init(&b->p.scene, "made_up");
    scene_quantity *q =
        scene_add_quantity(&b->p.scene, "load", "N", 0, scene_coordinate(0, SCENE_UX));
    q->tolerance = 1e-4;
    q->least_order = 2;
    b->s = (sweep){.points = 1, .point = &b->p, .series = b->one};
}

/* Adds formulation number `which` with the values limit (1 + size n^-2). */
static void add(families_bench *b, int which, double limit, double size)
{
    const int i = b->s.seriess++;
    b->one[i] =
        (series){.formulation = {.type = &type[which]}, .meshes = MESHES, .cell = b->cell[i]};
    strcpy(b->one[i].formulation.key, type[which].name);
    memcpy(b->one[i].mesh, mesh, sizeof mesh);
    for (int k = 0; k < MESHES; k++) {
        b->quantity[i][k].value = limit * (1 + size / mesh[k] / mesh[k]);
        b->cell[i][k].solve.quantities = 1;
        b->cell[i][k].solve.quantity = &b->quantity[i][k];
    }
}

static void make_two(families_bench *b)
{
    make(b);
    add(b, RED_ONE, 3, 0.1);
    add(b, BLUE_ONE, 3, 0.1);
}

static void finish(families_bench *b)
{
    truths_free(&b->t);
    scene_free(&b->p.scene);
}

static void one_family_is_none(void)
{
    families_bench b;
    make(&b);
    add(&b, RED_ONE, 3, 0.1);
    add(&b, RED_TWO, 3, 0.2);
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families != 1, "two of one family are one family");
    fault f;
    gsl_test(families_add_truths(&b.s, 0, &b.t, &f) != STATUS_OK || b.t.rows != 0,
             "one family gives no reference");
    finish(&b);
}

static void two_families(void)
{
    families_bench b;
    fault f;
    make(&b);
    add(&b, RED_ONE, 3.1, 0.1);
    add(&b, RED_TWO, 3, 0.1);
    add(&b, BLUE_ONE, 3.001, 0.1);
    const families_limit l = families_limit_of(&b.s, 0, 0, &b.t);
    gsl_test(l.families != 2 || l.disputed, "two families agree: %d", l.families);
    gsl_test(!(fabs(l.value - 3) < 2e-3) || !(l.uncertainty >= 1e-3 && l.uncertainty < 2e-3),
             "their limit %.6g, its uncertainty is their spread: %.2g", l.value, l.uncertainty);
    gsl_test(families_add_truths(&b.s, 0, &b.t, &f) != STATUS_OK || b.t.rows != 1,
             "it is a reference value for the run");
    const truth *row = truth_agreed(&b.t, &made_up, b.p.parameter, "load");
    gsl_test(row == NULL || truth_gates(row), "of kind agreement, which never gates");
    gsl_test(row == NULL || strstr(row->source, "blue_one (blue)") == NULL ||
                 strstr(row->source, "red_two (red)") == NULL,
             "its source names who agrees: %s", row != NULL ? row->source : "");
    verdict v = {.series = 0, .quantity = 0};
    verdict_reach(&b.s, &b.t, &v);
    gsl_test(v.kind != VERDICT_NO_TRUTH || v.expected != VERDICT_NO_TRUTH || v.truth != NULL ||
                 !(fabs(v.model_error - 0.033) < 1e-3),
             "who disagrees is told, %.3g, and not judged: %s", v.model_error,
             verdict_name(v.kind));
    finish(&b);
}

static void known_badly(void)
{
    families_bench b;
    make(&b);
    add(&b, GREEN_ONE, 3, 0.1);
    for (int k = 0; k < MESHES; k++)
        b.quantity[0][k].value = 3 * (1 + (k % 2 ? 1e-4 : -1e-4));
    add(&b, RED_ONE, 3, 0.1);
    add(&b, BLUE_ONE, 3.000003, 0.1);
    const families_limit l = families_limit_of(&b.s, 0, 0, &b.t);
    gsl_test(l.families != 3, "three families agree: %d", l.families);
    gsl_test(!(fabs(l.value - 3) < 1e-5) || !(l.uncertainty >= 3e-6 && l.uncertainty < 5e-5),
             "the limit of those who know, %.8g, and how well they do: %.2g", l.value,
             l.uncertainty);
    finish(&b);
}

static void disagreements_of_families(void)
{
    families_bench b;
    make_two(&b);
    add(&b, RED_TWO, 3.2, 0.1);
    add(&b, BLUE_TWO, 3.2, 0.1);
    gsl_test(!families_limit_of(&b.s, 0, 0, &b.t).disputed, "two limits with two families each");
    fault f;
    gsl_test(families_add_truths(&b.s, 0, &b.t, &f) != STATUS_OK || b.t.rows != 0,
             "a dispute gives no reference");
    add(&b, GREEN_ONE, 3.2, 0.1);
    const families_limit l = families_limit_of(&b.s, 0, 0, &b.t);
    gsl_test(l.disputed || l.families != 3 || !(fabs(l.value - 3.2) < 1e-3),
             "the limit of more families: %d, %.6g", l.families, l.value);
    finish(&b);
}

static void known_best(void)
{
    families_bench b;
    fault f;
    make(&b);
    add(&b, RED_ONE, 3, 0.1);
    add(&b, BLUE_ONE, 3, 1e-4);
    add(&b, GREEN_ONE, 3.01, 1e-3);
    const families_limit l = families_limit_of(&b.s, 0, 0, &b.t);
    gsl_test(l.families != 2 || l.others != 1 || l.other[0] != 2, "%d agree, %d are named",
             l.families, l.others);
    gsl_test(!(fabs(l.value - 3) <= l.uncertainty) || !(l.uncertainty < 1e-5),
             "%.10g +- %.1g: by those who know it", l.value, l.uncertainty);
    gsl_test(families_add_truths(&b.s, 0, &b.t, &f) != STATUS_OK || b.t.rows != 1 ||
                 strstr(b.t.row[0].source, "agree, not green_one") == NULL,
             "%s", b.t.rows == 1 ? b.t.row[0].source : "no reference");
    finish(&b);
}

static void known_wrong(void)
{
    char formulations[] = "red_one", condition[] = "shear", verdicts[] = "wrong limit|undecided";
    rule known = {.formulations = formulations, .condition = condition, .verdicts = verdicts};
    truths ledger = {.rule = &known, .rules = 1};
    families_bench b;
    make(&b);
    add(&b, RED_ONE, 3, 0.1);
    add(&b, MISPRINTED, 3, 0.1);
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families >= 2, "a misprint is no witness");
    add(&b, BLUE_ONE, 3, 0.1);
    gsl_test_int(families_limit_of(&b.s, 0, 0, &b.t).families, 2, "two witnesses");
    const int without = families_limit_of(&b.s, 0, 0, &ledger).families;
    gsl_test_int(without, 2, "nothing shears here");
    scene_demand(&b.p.scene, FEATURE_SHEAR);
    gsl_test(families_limit_of(&b.s, 0, 0, &ledger).families >= 2, "known to be wrong in shear");
    verdicts[0] = '\0';
    gsl_test_int(families_limit_of(&b.s, 0, 0, &ledger).families, 2, "undecided at worst");
    finish(&b);
}

static void uncertain(void)
{
    families_bench b;
    make_two(&b);
    b.one[1].meshes = 1;
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families > 1,
             "one mesh does not determine a limit");
    b.one[1].meshes = MESHES;
    b.quantity[1][MESHES - 1].value = 3.3;
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families > 1, "a mesh that jumps shows none");
    finish(&b);
}

/* Returns the index of the coarsest mesh for which all quantities of the series are within 1 % on
 * this mesh and all finer meshes; -1: none. */
static int every(const families_bench *b, int series_index)
{
    reach_question q = {.s = &b->s, .quantity = REACH_EVERY, .level = 0.01};
    reached list[MOST];
    int found = -1;
    verdict *all = reach_verdicts(&b->s, &b->t, &q.verdicts);
    q.verdict = all;
    for (int i = reach_ranking(&q, list) - 1; i >= 0; i--)
        if (list[i].series == series_index)
            found = list[i].mesh;
    free(all);
    return found;
}

static void reach(void)
{
    families_bench b;
    fault f;
    make(&b);
    add(&b, RED_ONE, 3, 0.1);
    add(&b, BLUE_ONE, 3, 0.5);
    add(&b, GREEN_ONE, 3.2, 0.1);
    gsl_test(every(&b, 0) != -1, "nothing to measure by");
    gsl_test(families_add_truths(&b.s, 0, &b.t, &f) != STATUS_OK || b.t.rows != 1, "a reference");
    gsl_test_int(every(&b, 0), 1, "0.1/n^2 within 1 % from n = 4 on");
    gsl_test_int(every(&b, 1), 2, "0.5/n^2 from n = 8 on");
    gsl_test_int(every(&b, 2), -1, "another limit never");
    b.quantity[0][3].value = 3.1;
    gsl_test_int(every(&b, 0), 4, "every finer mesh has to be within it too");
    finish(&b);
}

static void families_tests(void)
{
    one_family_is_none();
    two_families();
    known_badly();
    disagreements_of_families();
    known_best();
    known_wrong();
    uncertain();
    reach();
}

static const cost_coefficient rows[] = {
    {"", COUNTED_one, 1},
    {"", COUNTED_solutions, 2},
    {"*", COUNTED_strain_evaluations, 100},
    {"red", COUNTED_strain_evaluations, 1000},
    {"red:stages=4", COUNTED_strain_evaluations, 2000},
    {"red:stages=4,form=x", COUNTED_strain_evaluations, 3000},
    {NULL, COUNTED_one, 0},
};

static cell_result counted(void)
{
    return (cell_result){
        .size = {.elements = 2, .strains = 8, .inner = 3, .kinds = 1, .free = 13},
        .counters = {.strain_evaluations = 5, .numerics = {.solutions = 3, .solved_entries = 7}}};
}

static double cost_of(const char *key)
{
    formulation f = {.type = NULL};
    const cell_result cell = counted();
    strcpy(f.key, key);
    return counted_cost_of(rows, &f, &cell) - 1 - 2 * 3;
}

static void which_rows(void)
{
    gsl_test_abs(cost_of("red"), 5 * 1000, 0, "its own row");
    gsl_test_abs(cost_of("red:mass=lumped"), 5 * 1000, 0, "an option without a price");
    gsl_test_abs(cost_of("red:stages=4"), 5 * 2000, 0, "an option with one");
    gsl_test_abs(cost_of("red:mass=lumped,stages=4"), 5 * 2000, 0, "the same among others");
    gsl_test_abs(cost_of("red:form=x,stages=4"), 5 * 3000, 0, "the row that says most of it");
    gsl_test_abs(cost_of("red:stages=40"), 5 * 1000, 0, "another value that begins alike");
    gsl_test_abs(cost_of("redder"), 5 * 100, 0, "a name that begins alike has no row");
    gsl_test_abs(cost_of("new"), 5 * 100, 0, "without a row: the general coefficient");
}

static void which_have_coefficients(void)
{
    formulation f = {.type = NULL};
    strcpy(f.key, "new");
    gsl_test_int(has_cost_coefficients(rows, &f), 0, "no prices of its own");
    strcpy(f.key, "red:mass=lumped");
    gsl_test_int(has_cost_coefficients(rows, &f), 1, "prices of its own");
}

static void committed(void)
{
    const cell_result cell = counted();
    int seen = 0, own = 0;
    for (int i = 0; registry_formulations[i] != NULL; i++, seen++) {
        formulation f;
        formulation_default(registry_formulations[i], &f);
        own += has_cost_coefficients(cost_coefficients, &f);
        gsl_test(!(counted_cost(&f, &cell) > 0 && counted_cost(&f, &cell) < 1), "%s costs %g s",
                 f.key, counted_cost(&f, &cell));
    }
    gsl_test(seen < 2 || own < 2, "%d formulations, %d with prices", seen, own);
    for (const cost_coefficient *r = cost_coefficients; r->formulation != NULL; r++)
        gsl_test(!(r->seconds > 0), "%s: %g s", r->formulation, r->seconds);
    gsl_test(!(counted_cost_noise > 1 && counted_cost_noise < 2), "noise %g", counted_cost_noise);
}

static void counted_cost_tests(void)
{
    which_rows();
    which_have_coefficients();
    committed();
}

enum { SERIES = 4, REACH_MESHES = 4, QUANTITIES = 2 };
enum { LOW_COST, HIGH_COST, OTHER, LAST };

typedef struct reach_bench {
    sweep s;
    sweep_point p;
    scene_quantity quantity[QUANTITIES];
    series one[SERIES];
    cell_result cell[SERIES][REACH_MESHES];
    quantity_result value[SERIES][REACH_MESHES][QUANTITIES];
    truth row;
    verdict v[SERIES * QUANTITIES];
    reached list[SERIES];
    int count;
} reach_bench;

/* Makes four formulations that are exact on every mesh and have the common cost coefficients. The
 * reference value is 1. The work of each formulation is ten times that of the previous one. */
static void reach_make(reach_bench *b)
{
    static const char *const key[SERIES] = {"cheap", "dear", "other", "last"};
    memset(b, 0, sizeof *b);
    b->p.scene.quantities = QUANTITIES;
    b->p.scene.quantity = b->quantity;
    b->row.value = 1;
    b->s = (sweep){.points = 1, .seriess = SERIES, .point = &b->p, .series = b->one};
    long work = 100000;
    for (int i = 0; i < SERIES; i++, work *= 10) {
        b->one[i] = (series){.meshes = REACH_MESHES, .mesh = {1, 2, 4, 8}, .cell = b->cell[i]};
        strcpy(b->one[i].formulation.key, key[i]);
        for (int k = 0; k < REACH_MESHES; k++) {
            for (int q = 0; q < QUANTITIES; q++)
                b->value[i][k][q].value = 1;
            b->cell[i][k].size.strains = 8;
            b->cell[i][k].counters.strain_evaluations = work << k;
            b->cell[i][k].solve.quantities = QUANTITIES;
            b->cell[i][k].solve.quantity = b->value[i][k];
        }
        for (int q = 0; q < QUANTITIES; q++)
            b->v[QUANTITIES * i + q] = (verdict){.series = i, .quantity = q, .truth = &b->row};
    }
}

static void ask(reach_bench *b, int quantity, double level)
{
    const reach_question q = {&b->s, b->v, SERIES * QUANTITIES, 0, quantity, level};
    b->count = reach_ranking(&q, b->list);
}

static void expect(const reach_bench *b, const int order[], int count, const char *words)
{
    gsl_test_int(b->count, count, "%s: how many", words);
    for (int i = 0; i < count && i < b->count; i++)
        gsl_test_int(b->list[i].series, order[i], "%s: place %d", words, i + 1);
}

static void by_work(void)
{
    reach_bench b;
    reach_make(&b);
    ask(&b, 0, 0.01);
    expect(&b, (int[]){LOW_COST, HIGH_COST, OTHER, LAST}, 4, "by work");
    gsl_test_int(reach_ties(b.list, b.count), 1, "one is the cheapest");
    gsl_test_int(b.list[0].mesh, 0, "on the least mesh");
    for (int i = 0; i < SERIES; i++)
        for (int k = 0; k < REACH_MESHES; k++)
            b.cell[i][k].solve.seconds_solve = 1.0 / (1 + i) + k;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){LOW_COST, HIGH_COST, OTHER, LAST}, 4, "whatever the clock says");
}

static void by_accident(void)
{
    reach_bench b;
    reach_make(&b);
    b.value[LOW_COST][1][0].value = 1.05;
    b.cell[LOW_COST][2].counters.strain_evaluations = 5000000;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){HIGH_COST, LOW_COST, OTHER, LAST}, 4, "a dip");
    gsl_test_int(b.list[1].mesh, 2, "the mesh behind the dip");
    ask(&b, REACH_EVERY, 0.01);
    gsl_test_int(b.list[1].mesh, 2, "of all quantities the mesh that has the last of them");
    ask(&b, 0, 0.1);
    gsl_test_int(b.list[0].mesh, 0, "within 10 % it is no dip");
}

static void wrong_ones(void)
{
    reach_bench b;
    reach_make(&b);
    b.v[QUANTITIES * LOW_COST].kind = VERDICT_WRONG_AS_PREDICTED;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){HIGH_COST, OTHER, LAST, LOW_COST}, 4, "the cheapest has a limit of its own");
    gsl_test(b.list[3].defect != &b.v[QUANTITIES * LOW_COST], "its verdict is told");
    ask(&b, 1, 0.01);
    expect(&b, (int[]){LOW_COST, HIGH_COST, OTHER, LAST}, 4, "of another quantity it is right");
    ask(&b, REACH_EVERY, 0.01);
    expect(&b, (int[]){HIGH_COST, OTHER, LAST, LOW_COST}, 4, "of all it is not");
    for (int kind = 0; kind < VERDICT_KINDS; kind++)
        gsl_test_int(reach_is_defect((verdict_kind)kind),
                     kind != VERDICT_PASS && kind != VERDICT_NO_TRUTH && kind != VERDICT_SKIP &&
                         kind != VERDICT_OTHER_MODEL,
                     "%s", verdict_name((verdict_kind)kind));
    for (int i = 0; i < SERIES; i++)
        b.v[QUANTITIES * i].kind = VERDICT_BIASED;
    ask(&b, 0, 0.01);
    gsl_test_int(reach_ties(b.list, b.count), 0, "where none is right none is the cheapest");
}

static void ties(void)
{
    reach_bench b;
    reach_make(&b);
    b.cell[HIGH_COST][0].counters.strain_evaluations = (long)(100000 * (counted_cost_noise - 0.02));
    b.cell[OTHER][0].counters.strain_evaluations = (long)(100000 * (counted_cost_noise + 0.02));
    ask(&b, 0, 0.01);
    expect(&b, (int[]){LOW_COST, HIGH_COST, OTHER, LAST}, 4, "near each other");
    gsl_test_int(reach_ties(b.list, b.count), 2, "two tie, the third does not");
    b.v[QUANTITIES * HIGH_COST].kind = VERDICT_UNDECIDED;
    ask(&b, 0, 0.01);
    gsl_test_int(reach_ties(b.list, b.count), 1, "what is not known to be right does not tie");
    b.v[QUANTITIES * HIGH_COST].kind = VERDICT_PASS;
    b.cell[HIGH_COST][0].counters.strain_evaluations = 100000;
    strcpy(b.one[HIGH_COST].formulation.key, "before");
    ask(&b, 0, 0.01);
    expect(&b, (int[]){HIGH_COST, LOW_COST, OTHER, LAST}, 4, "equal costs by name");
    gsl_test_int(reach_ties(b.list, 0), 0, "nothing ties");
}

static void not_requested(void)
{
    reach_bench b;
    imported other = {.gates = 0};
    reach_make(&b);
    b.v[QUANTITIES * LOW_COST + 1].truth = NULL;
    strcpy(b.one[HIGH_COST].missing, "shear");
    b.one[OTHER].imported = &other;
    ask(&b, REACH_EVERY, 0.01);
    expect(&b, (int[]){LAST}, 1, "all quantities");
    ask(&b, 0, 0.01);
    expect(&b, (int[]){LOW_COST, LAST}, 2, "one quantity");
    const reach_question q = {&b.s, b.v, SERIES * QUANTITIES, 0, REACH_EVERY, 0.01};
    gsl_test_int(reach_has_references(&q, LOW_COST), 0, "a reference value is missing");
    gsl_test_int(reach_has_references(&q, HIGH_COST), -1, "it does not run");
    gsl_test_int(reach_has_references(&q, LAST), 1, "it is asked");
}

static void reach_tests(void)
{
    by_work();
    by_accident();
    wrong_ones();
    ties();
    not_requested();
}

int main(void)
{
    families_tests();
    counted_cost_tests();
    reach_tests();
    return gsl_test_summary();
}
