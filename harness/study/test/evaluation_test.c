/* Reference values in verdicts on an artificial series: which one is used, expected verdicts,
 * stored values of meshes, and the exit status. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study_impl.h"
#include "harness/study/test/bench.h"

static void predictions(void)
{
    evaluation_bench b;
    bench_make(&b);
    bench_fill(&b, 3.003, 0.7, 2);
    truth *derived = bench_add_prediction(&b, 3.003);
    derived->uncertainty = 1e-8;
    bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 1, "a wrong limit that was derived");
    bench_expect_words(&b, "converges to its derived limit 3.003: +0.1 % from the reference value");
    derived->value = 3.0041;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "another wrong limit than the one that was derived");
    gsl_test(strstr(b.j.verdict[0].reason, "3.0041") == NULL, "says which: %s",
             b.j.verdict[0].reason);
    derived->value = 3.003;
    derived->formulation = words[WHY];
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "a limit derived for another formulation");
    derived->formulation = words[ELEMENT];
    derived->on_curve = 1;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "a point of a curve is not the limit");
    derived->on_curve = 0;
    bench_fill(&b, 3.003, 1e-3, 2);
    derived->value = 3.003001;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "near the derived limit, but surely another one");
    bench_free(&b);
}

static void theories(void)
{
    evaluation_bench b;
    bench_make(&b);
    element_type haringx = element;
    haringx.offers = FEATURE_SHEAR | FEATURE_HARINGX;
    haringx.shear_theories = SHEAR_HARINGX;
    b.one.formulation.type = &haringx;
    scene_demand(&b.p.scene, FEATURE_SHEAR | FEATURE_GEOMETRIC);
    b.p.scene.shear_theory = SCENE_SHEAR_ENGESSER;
    bench_fill(&b, 3.003, 0.7, 2);
    b.row[0].theory = words[ENGESSER];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a reference value of another theory does not judge");
    gsl_test_rel(b.j.verdict[0].model_error, 1e-3, 1e-6, "the models differ");
    bench_expect_words(&b, "no reference value for its shear theory; its limit is +0.1 % from the "
                           "reference value for engesser");
    bench_add_row(&b, 3.003)->theory = words[HARINGX];
    bench_expect(&b, VERDICT_PASS, 0, "one of its own does");
    haringx.shear_theories = SHEAR_ENGESSER | SHEAR_HARINGX;
    haringx.offers |= FEATURE_ENGESSER;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "of two theories the one that is asked for");
    haringx.shear_theories = SHEAR_OWN;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "one of its own is shown against what there is");
    bench_free(&b);
}

static void publications(void)
{
    evaluation_bench b;
    bench_converge(&b);
    truth *published = bench_add_row(&b, 3.01);
    published->kind = words[PUBLISHED];
    published->uncertainty = 0.005;
    bench_expect(&b, VERDICT_PASS, 0, "an exact reference value judges beside a published one");
    gsl_test(b.j.verdict[0].contradicted != published, "which the limit contradicts");
    published->uncertainty = 0.011;
    bench_expect(&b, VERDICT_PASS, 0, "a published value with fewer digits");
    gsl_test(b.j.verdict[0].contradicted != NULL, "is not contradicted");
    bench_free(&b);
}

static void bound_by_the_derived_limit(void)
{
    static char kind[] = "wrong limit, as predicted|undecided";
    evaluation_bench b;
    bench_make(&b);
    bench_fill(&b, 3.3, 0.7, 2);
    truth *derived = bench_add_prediction(&b, 3.3);
    derived->uncertainty = 0.01;
    b.known = (rule){.name = words[WHY],
                     .formulations = words[ELEMENT],
                     .cases = words[MADE_UP],
                     .condition = words[NOTHING],
                     .quantities = words[LOAD],
                     .verdicts = kind,
                     .predicted = words[NOTHING],
                     .largest_error = 1e-3};
    b.t.rule = &b.known;
    b.t.rules = 1;
    bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 0,
                 "0.1 from the reference value, and where it should be");
    for (int side = -1; side <= 1; side += 2) {
        derived->value = 3.3 + side * 3 * 0.9e-3;
        bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 0, "within the bound of the derived limit");
        derived->value = 3.3 + side * 3 * 1.1e-3;
        bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 1, "beyond the bound of the derived limit");
    }
    bench_free(&b);
}

static void expectations(void)
{
    evaluation_bench b;
    bench_make(&b);
    snprintf(b.one.missing, sizeof b.one.missing, "shear");
    bench_expect(&b, VERDICT_SKIP, 3, "nothing but skips: nothing was checked");
    gsl_test_int(b.j.waiting, 1, "a reference value that everybody skips waits");
    b.one.missing[0] = '\0';
    b.p.status = STATUS_REFUSED;
    bench_expect(&b, VERDICT_REFUSED, 1, "a point whose scene is refused");
    b.p.status = STATUS_OK;
    bench_fill(&b, 3.003, 0.7, 2);
    b.known = (rule){.name = words[WHY],
                     .formulations = words[ELEMENT],
                     .cases = words[MADE_UP],
                     .condition = words[NOTHING],
                     .quantities = words[LOAD],
                     .verdicts = words[WRONG_LIMIT],
                     .predicted = words[NOTHING],
                     .largest_error = 0.002};
    b.t.rule = &b.known;
    b.t.rules = 1;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 0, "a known wrong limit");
    b.known.largest_error = 0.0009;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1,
                 "a wrong limit that is farther off than its cause explains");
    b.known.largest_error = NAN;
    b.known.verdicts = words[LOW_ORDER];
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "another defect than the known one");
    b.known.verdicts = words[WRONG_LIMIT];
    b.twice[0] = b.twice[1] = b.known;
    b.t.rule = b.twice;
    b.t.rules = 2;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "two rules for one verdict");
    b.t.rule = &b.known;
    b.t.rules = 1;
    b.known.predicted = words[LOAD_OF_IT];
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "a rule whose prediction no verdict met");
    b.known.predicted = words[NOTHING];
    bench_fill(&b, 3, 0.7, 2);
    bench_expect(&b, VERDICT_PASS, 1, "a known defect that is gone");
    gsl_test_int(b.j.unobserved, 1, "is a rule nobody observed");
    b.t.rules = 0;
    b.row[0].parameter[0] = 5;
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a reference value of other parameters does not judge");
    gsl_test_int(b.j.unmet, 1, "and is missed");
    b.row[0].any[0] = 1;
    bench_expect(&b, VERDICT_PASS, 0, "a reference value of any length does");
    b.row[0].any[0] = 0;
    b.row[0].parameter[0] = 2;
    bench_fill(&b, 3.003, 0.7, 2);
    b.row[0].uncertainty = 0.0029;
    bench_expect(&b, VERDICT_PASS, 0,
                 "a limit within the tolerance and the reference value's own uncertainty");
    b.row[0].uncertainty = 0.0026;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "and one beyond both");
    b.row[0].uncertainty = 0;
    bench_fill(&b, 3, 0.7, 2);
    bench_add_row(&b, 3.003);
    for (int exact = 0; exact < 2; exact++) {
        b.row[exact].kind = words[EXACT];
        b.row[1 - exact].kind = words[PUBLISHED];
        bench_expect(
            &b, exact == 0 ? VERDICT_PASS : VERDICT_WRONG_LIMIT, exact,
            "an exact reference value judges, a published one that contradicts it does not");
    }
    b.row[0].kind = words[EXACT];
    b.t.rows = 1;
    b.row[0].model = words[OTHER];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a reference value of another model does not judge");
    gsl_test_abs(b.j.verdict[0].model_error, 0, 1e-6, "it gives the model error");
    b.row[0].model = words[SAME];
    b.row[0].quantity = words[WHY];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a reference value of a quantity that does not exist");
    gsl_test_int(b.j.unmet, 1, "is missed");
    b.row[0].quantity = words[LOAD];
    bench_expect(&b, VERDICT_PASS, 0, "all truths are met");
    b.t.unknown_cases = 1;
    bench_expect(&b, VERDICT_PASS, 1, "but for those of a case that does not exist");
    gsl_test_int(b.j.unmet, 1, "which is missed");
    bench_free(&b);
}

static void other_instants(void)
{
    static const parameter_type both[] = {{"length", "m", 2, 1, 9, NULL, "some length"},
                                          {"time", "s", 5, 1, 9, NULL, "time of the output"},
                                          {0}};
    static const case_type timed = {.name = "made_up",
                                    .summary = "a case of the test",
                                    .source = "none",
                                    .parameters = {both},
                                    .build = no_build};
    static const double end = 5;
    evaluation_bench b;
    bench_converge(&b);
    b.p.type = b.row[0].type = &timed;
    b.p.parameter[1] = b.row[0].parameter[1] = end;
    truth *later = bench_add_row(&b, 3);
    later->parameter[1] = 9;
    bench_expect(&b, VERDICT_PASS, 1, "a reference value of other parameters");
    gsl_test_int(b.j.unmet, 1, "is missed");
    scene_add_motion(&b.p.scene, SCENE_NONE, 1, &end,
                     (scene_motion){.step = 1, .start = {.velocity = {0}}});
    bench_expect(&b, VERDICT_PASS, 0, "a reference value at another instant of a motion");
    gsl_test_int(b.j.unmet, 0, "is not missed");
    gsl_test_int(b.j.unread, 1, "but was not looked at");
    gsl_test_int(b.j.waiting, 0, "and waits for no formulation");
    gsl_test(later->evaluated, "nothing was judged by it");
    gsl_test_int(later->met, 1, "nor is it told as one of nothing that exists");
    later->quantity = words[WHY];
    bench_expect(&b, VERDICT_PASS, 1, "of a quantity that does not exist");
    gsl_test_int(b.j.unmet, 1, "it is missed, whatever the instant");
    bench_free(&b);
}

static void stored_values(void)
{
    evaluation_bench b;
    fault f = {""};
    bench_converge(&b);
    truth *stored = bench_add_row(&b, b.quantity[1].value * (1 + 0.9e-6));
    stored->formulation = words[ELEMENT];
    stored->elements = 4;
    bench_expect(&b, VERDICT_PASS, 0, "a mesh agrees with its stored value");
    gsl_test_int(b.j.agreements, 1, "one stored value");
    stored->value = b.quantity[1].value * (1 + 1.1e-6);
    bench_expect(&b, VERDICT_PASS, 1, "a mesh differs from its stored value");
    stored->uncertainty = 1e-4;
    bench_expect(&b, VERDICT_PASS, 0, "by less than it was printed to");
    b.quantity[1].value = NAN;
    bench_expect(&b, VERDICT_PASS, 1, "a mesh without a value does not agree");
    b.cell[1].solve.quantities = 0;
    bench_expect(&b, VERDICT_PASS, 1, "nor does one that crashed");
    stored->kind = words[UNREPEATABLE];
    bench_expect(&b, VERDICT_PASS, 0, "a figure that nobody can compute again");
    gsl_test_int(b.j.agreements, 0, "is compared with nothing");
    stored->kind = words[EXACT];
    b.row[0].unit = words[KILONEWTON];
    evaluation_free(&b.j);
    gsl_test(evaluation_make(&b.s, &b.t, 1, &b.j, &f) != STATUS_FAULT ||
                 strstr(f.text, "kN") == NULL,
             "another unit: %s", f.text);
    bench_free(&b);
}

static void of_its_own_series(void)
{
    evaluation_bench b;
    fault f = {""};
    bench_converge(&b);
    truth *stored = bench_add_row(&b, b.quantity[1].value);
    stored->formulation = words[ELEMENT];
    stored->elements = 4;
    quantity_result value[MESHES];
    cell_result cell[MESHES];
    memcpy(value, b.quantity, sizeof value);
    memcpy(cell, b.cell, sizeof cell);
    for (int i = 0; i < MESHES; i++) {
        value[i].value *= 2;
        cell[i].solve.quantity = &value[i];
    }
    series both[2] = {b.one, b.one};
    snprintf(both[0].formulation.key, sizeof both[0].formulation.key, "%s", words[OTHER]);
    both[0].cell = cell;
    const sweep s = {.points = 1, .point = &b.p, .seriess = 2, .series = both};
    for (int i = 0; i < 2; i++) {
        evaluation j = {0};
        gsl_test(agreements_add(&s, &b.t, i, &j, &f) != STATUS_OK, "%s", f.text);
        gsl_test_int(j.agreements, i, "agreements of series %d", i);
        gsl_test_int(j.disagreements, 0, "they agree");
        for (int k = 0; k < j.agreements; k++)
            gsl_test(j.agreement[k].value != b.quantity[1].value, "with its own value: %g",
                     j.agreement[k].value);
        free(j.agreement);
    }
    bench_free(&b);
}

static void evaluation_truths_tests(void)
{
    predictions();
    theories();
    publications();
    bound_by_the_derived_limit();
    expectations();
    other_instants();
    stored_values();
    of_its_own_series();
}

static void limits(void)
{
    evaluation_bench b;
    bench_converge(&b);
    bench_expect(&b, VERDICT_PASS, 0, "right limit, right order, coarse meshes far off");
    gsl_test_rel(b.j.verdict[0].fit.order, 2, 1e-6, "its order");
    gsl_test_int(b.j.verdict[0].fit.from, 4, "the four finest meshes show it");
    bench_expect_words(&b, "converges to the reference value, order 2");
    bench_fill(&b, 3.003, 0.7, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "smooth convergence to +0.1 %");
    gsl_test_rel(b.j.verdict[0].error, 1e-3, 1e-9, "the error is the limit's");
    bench_expect_words(&b, "converges to a wrong limit: +0.1 %");
    bench_fill(&b, 3 * (1 - 0.00115), 0.7, 4);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "fast convergence to -0.115 %");
    bench_expect_words(&b, "converges to a wrong limit: -0.115 %");
    b.j.verdict[0].fit.limit_uncertainty = fabs(b.j.verdict[0].fit.limit - 3) / 2;
    bench_expect_words(&b, "does not converge on these meshes and has a wrong value: -0.115 %");
    bench_fill(&b, 3 * (1 + 0.8e-4), 0.7, 2);
    bench_expect(&b, VERDICT_BIASED, 1, "limit within the tolerance, and sharp");
    bench_expect_words(&b, "has a different limit within the tolerance: +0.008 %");
    bench_fill(&b, 3 * (1 + 1.2e-4), 0.7, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "limit just outside, and sharp");
    bench_fill(&b, 3 * (1 + 2e-4), -6e-4 * 1024 * 0.9, 2);
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1,
                 "the finest mesh hits the reference value on the way to another limit");
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
    evaluation_bench b;
    bench_make(&b);
    bench_fill(&b, 3, 0.07, 1);
    bench_expect(&b, VERDICT_LOW_ORDER, 1, "right limit, first order instead of second");
    bench_expect_words(&b, "converges to the reference value, but with order 1 instead of 2");
    b.row[0].uncertainty = 0.05;
    bench_expect(&b, VERDICT_PASS, 0,
                 "changes that the reference value's own uncertainty hides show no order");
    b.row[0].uncertainty = 0;
    /* changes between meshes, the finest first: orders 1.2, 1.2, then `earlier` */
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
    bench_expect_words(&b,
                       "has converged to the reference value: the values on the last meshes differ "
                       "only by rounding");
    bench_free(&b);
}

static void needs_scatter(void)
{
    evaluation_bench b;
    bench_make(&b);
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 0.01 : -0.01);
    bench_expect(&b, VERDICT_UNDECIDED, 1, "alternating values");
    bench_expect_words(&b, "undecided: error of the limit -0.333 %, uncertainty 2.0 % "
                           "(oscillating, 5 meshes); use finer meshes");
    b.p.scene.quantity[0].near_zero = 5;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "of a reference value below what counts as near zero");
    bench_expect_words(&b, "undecided: error of the limit -0.2 %, uncertainty 0.060 in the unit of "
                           "the quantity (oscillating, 5 meshes); use finer meshes");
    b.p.scene.quantity[0].near_zero = 0;
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 1e-6 : -1e-6);
    bench_expect(&b, VERDICT_PASS, 0, "alternating values that surely stay inside the tolerance");
    bench_expect_words(
        &b, "agrees with the reference value within the tolerance; the order is not known");
    bench_fill(&b, 4, 0.01, 2);
    b.one.meshes = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "three meshes never say that a limit is wrong");
    b.one.meshes = MESHES;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "more do");
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 1 : -1) * pow(4, -i);
    bench_evaluate(&b);
    gsl_test_rel(b.j.verdict[0].fit.limit_uncertainty, 3 * (1.0 / 256 + 1.0 / 64), 1e-6,
                 "without an order the case's own reduces former changes");
    b.one.meshes = 1;
    b.quantity[0].value = 3;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "one mesh shows no limit, even if it is right");
    bench_expect_words(&b,
                       "undecided: one mesh does not determine a limit; use at least four meshes");
    b.one.meshes = MESHES;
    bench_fill(&b, 3 * (1 + 1e-9), 1e-7, 1);
    b.row[0].uncertainty = 4e-9;
    bench_expect(&b, VERDICT_PASS, 0,
                 "a limit that the reference value's own digits do not tell from it");
    bench_expect_words(
        &b, "converges to the reference value, order 1; the difference is below the last "
            "digit of the reference value");
    double noise[1] = {1e-3};
    bench_fill(&b, 3 * (1 + 2e-4), 0.7, 2);
    b.one.noise = noise;
    b.row[0].uncertainty = 0;
    bench_expect(&b, VERDICT_UNDECIDED, 1, "noise that was measured hides a wrong limit");
    bench_free(&b);
}

static void failures(void)
{
    evaluation_bench b;
    bench_converge(&b);
    b.quantity[4].value = NAN;
    b.quantity[4].status = STATUS_NO_VALUE;
    bench_expect(&b, VERDICT_DIVERGED, 1, "no number on the finest mesh");
    b.quantity[4].status = STATUS_SINGULAR;
    snprintf(b.quantity[4].reason, sizeof b.quantity[4].reason, "singular at path 0.3");
    bench_expect(&b, VERDICT_DIVERGED, 1, "singular on the finest mesh");
    gsl_test(strcmp(b.j.verdict[0].reason, "singular at path 0.3") != 0, "with its reason");
    bench_expect_words(&b, "has no value on the finest mesh: singular at path 0.3");
    b.quantity[4].status = STATUS_REFUSED;
    bench_expect(&b, VERDICT_REFUSED, 1, "refused");
    bench_fill(&b, 3, 0.7, 2);
    b.quantity[4].status = STATUS_OK;
    b.quantity[0].value = NAN;
    b.quantity[0].status = STATUS_NO_VALUE;
    bench_expect(&b, VERDICT_PASS, 0, "a coarse mesh without a value does not count");
    bench_free(&b);
}

static void uncertain_noise(void)
{
    evaluation_bench b;
    bench_make(&b);
    bench_fill(&b, 3, 0.07, 2);
    gsl_test_int(evaluation_needs_scatter(&b.s, &b.t, 0), 0, "a limit that noise cannot touch");
    bench_fill(&b, 3, 1e-7, 2);
    gsl_test_int(evaluation_needs_scatter(&b.s, &b.t, 0), 0, "a pass with any scatter");
    for (int i = 0; i < MESHES; i++)
        b.quantity[i].value = 3 + (i % 2 ? 0.01 : -0.01);
    gsl_test_int(evaluation_needs_scatter(&b.s, &b.t, 0), 0, "undecided with any scatter");
    bench_fill(&b, 3 * (1 + 1e-9), 1e-7, 2);
    gsl_test_int(evaluation_needs_scatter(&b.s, &b.t, 0), 1, "a bias that may be scatter");
    b.t.rows = 0;
    gsl_test_int(evaluation_needs_scatter(&b.s, &b.t, 0), 0, "nothing to judge by");
    bench_free(&b);
}

static void coverages(void)
{
    evaluation_bench b;
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
    bench_expect(&b, VERDICT_PASS, 0, "a reference value that is not known better");
    gsl_test_int(b.j.coverage[0].covered[0], 1, "covers it");
    b.row[0].uncertainty = 0;
    b.row[0].kind = words[PUBLISHED];
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "a reference value that is not exact");
    gsl_test_int(b.j.coverages, 0, "says nothing of coverage");
    bench_free(&b);
}

static void selection(void)
{
    evaluation_bench b;
    fault f = {""};
    bench_converge(&b);
    b.s.select = "made_up and load";
    bench_expect(&b, VERDICT_PASS, 0, "a quantity is selected");
    b.s.select = "not load";
    evaluation_free(&b.j);
    gsl_test(evaluation_make(&b.s, &b.t, 0, &b.j, &f) != STATUS_OK || b.j.verdicts != 0 ||
                 evaluation_exit(&b.j) != 3,
             "or left out");
    bench_free(&b);
}

static void evaluation_tests(void)
{
    limits();
    orders();
    needs_scatter();
    failures();
    uncertain_noise();
    coverages();
    selection();
}

int main(void)
{
    evaluation_truths_tests();
    evaluation_tests();
    return gsl_test_summary();
}
