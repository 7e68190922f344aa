/* The judge on made-up series: every kind of verdict, and what of it counts. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/study/test/bench.h"

static void limits(void)
{
    judge_bench b;
    bench_converge(&b);
    bench_expect(&b, VERDICT_PASS, 0, "right limit, right order, coarse meshes far off");
    gsl_test_rel(b.j.verdict[0].fit.order, 2, 1e-6, "its order");
    gsl_test_int(b.j.verdict[0].fit.from, 4, "the four finest meshes show it");
    bench_says(&b, "converges to the truth, order 2");
    bench_fill(&b, 3.003, 0.7, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "smooth convergence to +0.1 %");
    gsl_test_rel(b.j.verdict[0].error, 1e-3, 1e-9, "the error is the limit's");
    bench_says(&b, "converges to a wrong limit: +0.1 %");
    bench_fill(&b, 3 * (1 - 0.00115), 0.7, 4);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "fast convergence to -0.115 %");
    bench_says(&b, "converges to a wrong limit: -0.115 %");
    bench_fill(&b, 3 * (1 + 0.8e-4), 0.7, 2);
    bench_expect(&b, VERDICT_BIASED, 1, "limit within the tolerance, and sharp");
    bench_says(&b, "has a different limit within the tolerance: +0.008 %");
    bench_fill(&b, 3 * (1 + 1.2e-4), 0.7, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "limit just outside, and sharp");
    bench_fill(&b, 3 * (1 + 2e-4), -6e-4 * 1024 * 0.9, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1,
                 "the finest mesh hits the truth on the way to another limit");
    gsl_test(fabs(b.j.verdict[0].finest - 3) > 3e-4, "(it does: %.17g)", b.j.verdict[0].finest);
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3.05 + 1e-5 * (i % 2 ? 1 : -1);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1,
                 "values without an order, that have settled elsewhere");
    gsl_test(isfinite(b.j.verdict[0].fit.order) ||
                 !isfinite(b.j.verdict[0].fit.limit_uncertainty) || b.j.verdict[0].fit.from == 0,
             "and say how well their limit is known, and from which meshes");
    bench_free(&b);
}

static void orders(void)
{
    judge_bench b;
    bench_make(&b);
    bench_fill(&b, 3, 0.07, 1);
    bench_expect(&b, VERDICT_LOW_ORDER, 1, "right limit, first order instead of second");
    bench_says(&b, "converges to the truth, but with order 1 instead of 2");
    b.row[0].uncertainty = 0.05;
    bench_expect(&b, VERDICT_PASS, 0,
                 "changes that the truth's own uncertainty hides show no order");
    b.row[0].uncertainty = 0;
    /* changes, from the finest mesh on: orders 1.2, 1.2 and then `earlier` */
    const double earlier[] = {1.2, 2.2};
    for (int k = 0; k < 2; k++) {
        double change = 1e-5, value = 3 + change / (pow(2, 1.2) - 1);
        for (int i = MESHES; i-- > 0; change *= pow(2, i > MESHES - 3 ? 1.2 : earlier[k])) {
            b.quantity[i].value = value;
            value += change;
        }
        bench_expect(&b, k == 0 ? VERDICT_LOW_ORDER : VERDICT_PASS, k == 0,
                     k == 0 ? "three low orders" : "two low orders, an accident");
    }
    bench_fill(&b, 3, 0.7, 1.8);
    bench_expect(&b, VERDICT_PASS, 0, "an order within what finite meshes show");
    bench_fill(&b, 3, 1e-14, 1);
    bench_expect(&b, VERDICT_PASS, 0, "at the round-off floor no order is asked for");
    bench_says(&b, "has converged to the truth: the last meshes differ by noise only");
    bench_free(&b);
}

static void doubts(void)
{
    judge_bench b;
    bench_make(&b);
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 0.01 : -0.01);
    bench_expect(&b, VERDICT_UNDECIDED, 1, "alternating values");
    bench_says(&b,
               "undecided: its limit is -0.333 % off, known to 2.0 % only (oscillating, 5 meshes)");
    b.p.scene.quantity[0].near_zero = 5;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "of a truth below what counts as near zero");
    bench_says(&b, "undecided: its limit is -0.2 % off, known to 0.060 in its unit only "
                   "(oscillating, 5 meshes)");
    b.p.scene.quantity[0].near_zero = 0;
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 1e-6 : -1e-6);
    bench_expect(&b, VERDICT_PASS, 0, "alternating values that surely stay inside the tolerance");
    bench_says(&b, "agrees with the truth within the tolerance, without an order");
    bench_fill(&b, 4, 0.01, 2);
    b.one.meshes = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "three meshes never say that a limit is wrong");
    b.one.meshes = MESHES;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "more do");
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 1 : -1) * pow(4, -i);
    bench_judge(&b);
    gsl_test_rel(b.j.verdict[0].fit.limit_uncertainty, 3 * (1.0 / 256 + 1.0 / 64), 1e-6,
                 "without an order the case's own reduces former changes");
    b.one.meshes = 1;
    b.quantity[0].value = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "one mesh shows no limit, even if it is right");
    bench_says(&b, "undecided: one mesh shows no limit");
    b.one.meshes = MESHES;
    bench_fill(&b, 3 * (1 + 1e-9), 1e-7, 1);
    b.row[0].uncertainty = 4e-9;
    bench_expect(&b, VERDICT_PASS, 0, "a limit that the truth's own digits do not tell from it");
    bench_says(&b, "converges to the truth, order 1; the difference is below the truth's digits");
    double noise[1] = {1e-3};
    bench_fill(&b, 3 * (1 + 2e-4), 0.7, 2);
    b.one.noise = noise;
    b.row[0].uncertainty = 0;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "noise that was measured hides a wrong limit");
    bench_free(&b);
}

static void failures(void)
{
    judge_bench b;
    bench_converge(&b);
    b.quantity[4].value = NAN;
    b.quantity[4].status = STATUS_NO_VALUE;
    bench_expect(&b, VERDICT_DIVERGED, 1, "no number on the finest mesh");
    b.quantity[4].status = STATUS_SINGULAR;
    snprintf(b.quantity[4].reason, sizeof b.quantity[4].reason, "singular at path 0.3");
    bench_expect(&b, VERDICT_DIVERGED, 1, "singular on the finest mesh");
    gsl_test(strcmp(b.j.verdict[0].reason, "singular at path 0.3") != 0, "with its reason");
    bench_says(&b, "has no value on the finest mesh: singular at path 0.3");
    b.quantity[4].status = STATUS_REFUSED;
    bench_expect(&b, VERDICT_REFUSED, 1, "refused");
    bench_fill(&b, 3, 0.7, 2);
    b.quantity[4].status = STATUS_OK;
    b.quantity[0].value = NAN;
    b.quantity[0].status = STATUS_NO_VALUE;
    bench_expect(&b, VERDICT_PASS, 0, "a coarse mesh without a value does not count");
    bench_free(&b);
}

/* Noise is worth measuring where the last change is tiny or the verdict open, and there is a truth.
 */
static void doubtful_noise(void)
{
    judge_bench b;
    bench_make(&b);
    bench_fill(&b, 3, 0.07, 2);
    gsl_test_int(judgement_doubts(&b.s, &b.t, 0), 0, "a limit that noise cannot touch");
    bench_fill(&b, 3, 1e-7, 2);
    gsl_test_int(judgement_doubts(&b.s, &b.t, 0), 1, "changes that may be noise");
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 0.01 : -0.01);
    gsl_test_int(judgement_doubts(&b.s, &b.t, 0), 1, "an open verdict");
    b.t.rows = 0;
    gsl_test_int(judgement_doubts(&b.s, &b.t, 0), 0, "nothing to judge by");
    bench_free(&b);
}

/* How many limits of exact truths lie within their uncertainty, also without the finest meshes. */
static void coverages(void)
{
    judge_bench b;
    bench_converge(&b);
    bench_expect(&b, VERDICT_PASS, 0, "a series");
    gsl_test_int(b.j.coverages, 1, "of one formulation");
    for (int k = 0; k < COVERAGE_MESHES; k++)
        gsl_test(b.j.coverage[0].series[k] != (k < MESHES - 2) ||
                     b.j.coverage[0].covered[k] != (k < MESHES - 2),
                 "without %d meshes: %d of %d", k, b.j.coverage[0].covered[k],
                 b.j.coverage[0].series[k]);
    bench_fill(&b, 3.001, 0.7, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "another limit");
    gsl_test_int(b.j.coverage[0].covered[0], 0, "is not covered");
    b.row[0].uncertainty = 0.0011;
    bench_expect(&b, VERDICT_PASS, 0, "a truth that is not known better");
    gsl_test_int(b.j.coverage[0].covered[0], 1, "covers it");
    b.row[0].uncertainty = 0;
    b.row[0].kind = words[PUBLISHED];
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "a truth that is not exact");
    gsl_test_int(b.j.coverages, 0, "says nothing of coverage");
    bench_free(&b);
}

static void selection(void)
{
    judge_bench b;
    fault f = {""};
    bench_converge(&b);
    b.s.select = "made_up and load";
    bench_expect(&b, VERDICT_PASS, 0, "a quantity is selected");
    b.s.select = "not load";
    judgement_free(&b.j);
    gsl_test(judgement_make(&b.s, &b.t, 0, &b.j, &f) != STATUS_OK || b.j.verdicts != 0 ||
                 judgement_exit(&b.j) != 3,
             "or left out");
    bench_free(&b);
}

int main(void)
{
    limits();
    orders();
    doubts();
    failures();
    doubtful_noise();
    coverages();
    selection();
    return gsl_test_summary();
}
