/* The limit on which families agree: how many it takes, which one it is, and when there is none. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

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

/* A sweep of one point and quantity, its series added one by one. */
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

/* A formulation whose values are limit (1 + size n^-2). */
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

/* A red and a blue one agree on 3. */
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
             "it is a truth for the run");
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

/* What a third family hardly knows makes neither the limit nor its uncertainty worse. */
static void known_badly(void)
{
    families_bench b;
    make(&b);
    add(&b, GREEN_ONE, 3, 0.1);
    for (int k = 0; k < MESHES; k++) /* it goes up and down by 1e-4 */
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

/* Two against two: nobody knows. Three against two: the three. */
static void disputes(void)
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

/* Who knows it best is the centre; who is off by more than it is uncertain by is named. */
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

/* Who is kept with its misprint, or is known to be wrong in what the scene has, does not vote. */
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

/* Who is not known well agrees with nobody. */
static void uncertain(void)
{
    families_bench b;
    make_two(&b);
    b.one[1].meshes = 1;
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families > 1, "one mesh shows no limit");
    b.one[1].meshes = MESHES;
    b.quantity[1][MESHES - 1].value = 3.3;
    gsl_test(families_limit_of(&b.s, 0, 0, &b.t).families > 1, "a mesh that jumps shows none");
    finish(&b);
}

/* Index of the mesh from which on a series is within 1 % of everything, or -1. */
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

/* The least mesh from which on everything is within 1 %, by agreement where there is no truth. */
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

int main(void)
{
    one_family_is_none();
    two_families();
    known_badly();
    disputes();
    known_best();
    known_wrong();
    uncertain();
    reach();
    return gsl_test_summary();
}
