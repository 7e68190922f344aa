/* When a limit is the one that was derived: at the edges of what is known of both, on either side
 * of the truth, and wherever the uncertainty comes from. */
#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/study/test/bench.h"

static const double just = 3e-3; /* inside or outside of an edge, in parts of its distance */

/* The verdict with a prediction that is so far above the limit (below: negative). */
static verdict_kind judged(judge_bench *b, double limit, double apart)
{
    b->row[1].value = limit + apart;
    return bench_judge(b)->kind;
}

/* The prediction is met up to the distance `edge` from the limit, and no farther. */
static void edges(judge_bench *b, double edge, verdict_kind beyond, const char *what)
{
    const double limit = bench_judge(b)->fit.limit;
    const verdict_kind within =
        beyond == VERDICT_BIASED ? VERDICT_BIASED_AS_PREDICTED : VERDICT_WRONG_AS_PREDICTED;
    for (int side = -1; side <= 1; side += 2) {
        const verdict_kind in = judged(b, limit, side * edge * (1 - just)),
                           out = judged(b, limit, side * edge * (1 + just));
        gsl_test(in != within, "%s: inside its edge %+.1e: %s", what, side * edge,
                 verdict_name(in));
        gsl_test(out != beyond, "%s: beyond its edge %+.1e: %s", what, side * edge,
                 verdict_name(out));
    }
}

static void with_prediction(judge_bench *b, double limit)
{
    static double none[1] = {0};
    bench_make(b);
    b->one.noise = none; /* it was measured */
    bench_fill(b, limit, 0.7, 2);
    bench_add_prediction(b, limit);
}

/* A limit that is known well: the prediction's own uncertainty, whatever the error's size and sign;
 * a part of the error, small as it is, explains nothing. */
static void sharp_limits(void)
{
    static const double error[] = {0.003, -0.003, 0.3, -0.03};
    for (int i = 0; i < 4; i++) {
        judge_bench b;
        with_prediction(&b, 3 + error[i]);
        const mesh_limit fit = bench_judge(&b)->fit;
        const double doubt = fit.limit_uncertainty, part = 1e-3 * error[i];
        gsl_test(!(doubt < 1e-5 * fabs(error[i])), "(the limit is known well: %.1e)", doubt);
        gsl_test(judged(&b, fit.limit, part) != VERDICT_WRONG_LIMIT ||
                     judged(&b, fit.limit, -part) != VERDICT_WRONG_LIMIT,
                 "a thousandth of the error is another limit");
        b.row[1].uncertainty = fabs(error[i]) / 50;
        edges(&b, 3 * doubt + b.row[1].uncertainty, VERDICT_WRONG_LIMIT,
              "the prediction's uncertainty");
        b.row[0].uncertainty = fabs(error[i]) / 10;
        edges(&b, 3 * doubt + b.row[1].uncertainty, VERDICT_WRONG_LIMIT,
              "the truth's own uncertainty does not count");
        bench_free(&b);
    }
}

/* Three uncertainties of a limit that is not known well. */
static void uncertain_limits(void)
{
    judge_bench b;
    double noise[1] = {1e-5};
    with_prediction(&b, 3.03);
    b.one.noise = noise;
    const double doubt = bench_judge(&b)->fit.limit_uncertainty;
    gsl_test(!(3 * doubt > 1.5e-3 * 0.03), "(the limit is not known well: %.1e)", doubt);
    edges(&b, 3 * doubt, VERDICT_WRONG_LIMIT, "three uncertainties");
    b.row[1].uncertainty = doubt / 2;
    edges(&b, 3.5 * doubt, VERDICT_WRONG_LIMIT, "three uncertainties and the prediction's");
    bench_free(&b);
}

/* Within the tolerance a sharp limit of its own is biased, unless it is the derived one. */
static void biases(void)
{
    static const double error[] = {2e-4, -2e-4};
    for (int i = 0; i < 2; i++) {
        judge_bench b;
        with_prediction(&b, 3 + error[i]);
        b.row[1].uncertainty = 1e-6;
        const double doubt = bench_judge(&b)->fit.limit_uncertainty;
        edges(&b, 3 * doubt + 1e-6, VERDICT_BIASED, "within the tolerance");
        b.row[1].value = 3 + error[i];
        bench_fill(&b, 3, 0.7, 2);
        bench_expect(&b, VERDICT_PASS, 0, "a limit that is the truth, and not the derived one");
        bench_free(&b);
    }
}

/* A limit that is not settled is not what was derived, even if both agree. */
static void undecided(void)
{
    judge_bench b;
    with_prediction(&b, 3.03);
    double noise[1] = {1e-2};
    b.one.noise = noise;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "noise that hides where the limit is");
    b.one.noise = NULL;
    b.one.meshes = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1,
                 "three meshes say of no limit that it is the derived one");
    bench_free(&b);
}

int main(void)
{
    sharp_limits();
    uncertain_limits();
    biases();
    undecided();
    return gsl_test_summary();
}
