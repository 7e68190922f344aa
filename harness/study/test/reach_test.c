/* Which formulation reaches an error: by counted work, never by a clock; what is known to be wrong
 * stands behind; costs nearer than prices are known tie. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/study/study.h"

enum { SERIES = 4, REACH_MESHES = 4, QUANTITIES = 2 };
enum { CHEAP, DEAR, OTHER, LAST };

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

/* Four formulations without prices of their own, exact on every mesh; the truth is 1. The work of
 * each is ten times that of the one before it. */
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
    expect(&b, (int[]){CHEAP, DEAR, OTHER, LAST}, 4, "by work");
    gsl_test_int(reach_ties(b.list, b.count), 1, "one is the cheapest");
    gsl_test_int(b.list[0].mesh, 0, "on the least mesh");
    for (int i = 0; i < SERIES; i++) /* the first one took longest */
        for (int k = 0; k < REACH_MESHES; k++)
            b.cell[i][k].solve.seconds_solve = 1.0 / (1 + i) + k;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){CHEAP, DEAR, OTHER, LAST}, 4, "whatever the clock says");
}

/* Within 1 % on the coarsest mesh, not on the next: from the third on it counts, with its work. */
static void by_accident(void)
{
    reach_bench b;
    reach_make(&b);
    b.value[CHEAP][1][0].value = 1.05;
    b.cell[CHEAP][2].counters.strain_evaluations = 5000000;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){DEAR, CHEAP, OTHER, LAST}, 4, "a dip");
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
    b.v[QUANTITIES * CHEAP].kind = VERDICT_WRONG_AS_PREDICTED;
    ask(&b, 0, 0.01);
    expect(&b, (int[]){DEAR, OTHER, LAST, CHEAP}, 4, "the cheapest has a limit of its own");
    gsl_test(b.list[3].defect != &b.v[QUANTITIES * CHEAP], "its verdict is told");
    ask(&b, 1, 0.01);
    expect(&b, (int[]){CHEAP, DEAR, OTHER, LAST}, 4, "of another quantity it is right");
    ask(&b, REACH_EVERY, 0.01);
    expect(&b, (int[]){DEAR, OTHER, LAST, CHEAP}, 4, "of all it is not");
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
    b.cell[DEAR][0].counters.strain_evaluations = (long)(100000 * (price_noise - 0.02));
    b.cell[OTHER][0].counters.strain_evaluations = (long)(100000 * (price_noise + 0.02));
    ask(&b, 0, 0.01);
    expect(&b, (int[]){CHEAP, DEAR, OTHER, LAST}, 4, "near each other");
    gsl_test_int(reach_ties(b.list, b.count), 2, "two tie, the third does not");
    b.v[QUANTITIES * DEAR].kind = VERDICT_UNDECIDED;
    ask(&b, 0, 0.01);
    gsl_test_int(reach_ties(b.list, b.count), 1, "what is not known to be right does not tie");
    b.v[QUANTITIES * DEAR].kind = VERDICT_PASS;
    b.cell[DEAR][0].counters.strain_evaluations = 100000;
    strcpy(b.one[DEAR].formulation.key, "before");
    ask(&b, 0, 0.01);
    expect(&b, (int[]){DEAR, CHEAP, OTHER, LAST}, 4, "equal costs by name");
    gsl_test_int(reach_ties(b.list, 0), 0, "nothing ties");
}

/* Who has no truth of its theory in one of them, or does not run, is not asked about all. */
static void not_asked(void)
{
    reach_bench b;
    imported other = {.gates = 0};
    reach_make(&b);
    b.v[QUANTITIES * CHEAP + 1].truth = NULL;
    strcpy(b.one[DEAR].missing, "shear");
    b.one[OTHER].imported = &other;
    ask(&b, REACH_EVERY, 0.01);
    expect(&b, (int[]){LAST}, 1, "all quantities");
    ask(&b, 0, 0.01);
    expect(&b, (int[]){CHEAP, LAST}, 2, "one quantity");
    const reach_question q = {&b.s, b.v, SERIES * QUANTITIES, 0, REACH_EVERY, 0.01};
    gsl_test_int(reach_asks(&q, CHEAP), 0, "a truth is missing");
    gsl_test_int(reach_asks(&q, DEAR), -1, "it does not run");
    gsl_test_int(reach_asks(&q, LAST), 1, "it is asked");
}

int main(void)
{
    by_work();
    by_accident();
    wrong_ones();
    ties();
    not_asked();
    return gsl_test_summary();
}
