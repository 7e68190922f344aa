/* Which truth judges a made-up series, what of it was expected, stored values of meshes, and what
 * the gate says. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <stdio.h>
#include <stdlib.h>

#include "harness/study/study_impl.h"
#include "harness/study/test/bench.h"

static void predictions(void)
{
    judge_bench b;
    bench_make(&b);
    bench_fill(&b, 3.003, 0.7, 2);
    truth *derived = bench_add_prediction(&b, 3.003);
    derived->uncertainty = 1e-8;
    bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 1, "a wrong limit that was derived");
    bench_says(&b, "converges to the limit that was derived for it, 3.003: +0.1 % from the truth");
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

/* A formulation is judged by the truth of its own theory of shear, whatever the scene asks for. */
static void theories(void)
{
    judge_bench b;
    bench_make(&b);
    element_type haringx = element;
    haringx.offers = FEATURE_SHEAR | FEATURE_HARINGX;
    haringx.shear_theories = SHEAR_HARINGX;
    b.one.formulation.type = &haringx;
    scene_demand(&b.p.scene, FEATURE_SHEAR | FEATURE_GEOMETRIC);
    b.p.scene.shear_theory = SCENE_SHEAR_ENGESSER;
    bench_fill(&b, 3.003, 0.7, 2);
    b.row[0].theory = words[ENGESSER];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a truth of another theory does not judge");
    gsl_test_rel(b.j.verdict[0].model_error, 1e-3, 1e-6, "the models differ");
    bench_says(&b, "no truth of its theory of shear; its limit is +0.1 % from that of engesser");
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
    judge_bench b;
    bench_converge(&b);
    truth *published = bench_add_row(&b, 3.01);
    published->kind = words[PUBLISHED];
    published->uncertainty = 0.005;
    bench_expect(&b, VERDICT_PASS, 0, "an exact truth judges beside a published one");
    gsl_test(b.j.verdict[0].contradicted != published, "which the limit contradicts");
    published->uncertainty = 0.011;
    bench_expect(&b, VERDICT_PASS, 0, "a published value with fewer digits");
    gsl_test(b.j.verdict[0].contradicted != NULL, "is not contradicted");
    bench_free(&b);
}

/* Where a limit was derived, a rule is bound by the distance from it, however far the truth is. */
static void bound_by_the_derived_limit(void)
{
    static char kind[] = "wrong limit, as predicted|undecided";
    judge_bench b;
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
    bench_expect(&b, VERDICT_WRONG_AS_PREDICTED, 0, "0.1 from the truth, and where it should be");
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
    judge_bench b;
    bench_make(&b);
    snprintf(b.one.missing, sizeof b.one.missing, "shear");
    bench_expect(&b, VERDICT_SKIP, 3, "nothing but skips: nothing was checked");
    gsl_test_int(b.j.waiting, 1, "a truth that everybody skips waits");
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
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a truth of other parameters does not judge");
    gsl_test_int(b.j.unmet, 1, "and is missed");
    b.row[0].any[0] = 1;
    bench_expect(&b, VERDICT_PASS, 0, "a truth of any length does");
    b.row[0].any[0] = 0;
    b.row[0].parameter[0] = 2;
    bench_fill(&b, 3.003, 0.7, 2);
    b.row[0].uncertainty = 0.0029;
    bench_expect(&b, VERDICT_PASS, 0,
                 "a limit within the tolerance and the truth's own uncertainty");
    b.row[0].uncertainty = 0.0026;
    bench_expect(&b, VERDICT_WRONG_LIMIT, 1, "and one beyond both");
    b.row[0].uncertainty = 0;
    bench_fill(&b, 3, 0.7, 2);
    bench_add_row(&b, 3.003);
    for (int exact = 0; exact < 2; exact++) {
        b.row[exact].kind = words[EXACT];
        b.row[1 - exact].kind = words[PUBLISHED];
        bench_expect(&b, exact == 0 ? VERDICT_PASS : VERDICT_WRONG_LIMIT, exact,
                     "an exact truth judges, a published one that contradicts it does not");
    }
    b.row[0].kind = words[EXACT];
    b.t.rows = 1;
    b.row[0].model = words[OTHER];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a truth of another model does not judge");
    gsl_test_abs(b.j.verdict[0].model_error, 0, 1e-6, "it gives the model error");
    b.row[0].model = words[SAME];
    b.row[0].quantity = words[WHY];
    bench_expect(&b, VERDICT_NO_TRUTH, 3, "a truth of a quantity that does not exist");
    gsl_test_int(b.j.unmet, 1, "is missed");
    b.row[0].quantity = words[LOAD];
    bench_expect(&b, VERDICT_PASS, 0, "all truths are met");
    b.t.strangers = 1;
    bench_expect(&b, VERDICT_PASS, 1, "but for those of a case that does not exist");
    gsl_test_int(b.j.unmet, 1, "which is missed");
    bench_free(&b);
}

/* A truth of a motion at an instant that the run does not read is not judged by, and is not missed;
 * of a case at rest it is. */
static void other_instants(void)
{
    static const parameter_type both[] = {{"length", "m", 2, 1, 9, NULL, "some length"},
                                          {"time", "s", 5, 1, 9, NULL, "when it is looked at"},
                                          {0}};
    static const case_type timed = {.name = "made_up",
                                    .summary = "a case of the test",
                                    .source = "none",
                                    .parameters = {both},
                                    .build = no_build};
    static const double end = 5;
    judge_bench b;
    bench_converge(&b);
    b.p.type = b.row[0].type = &timed;
    b.p.parameter[1] = b.row[0].parameter[1] = end;
    truth *later = bench_add_row(&b, 3);
    later->parameter[1] = 9;
    bench_expect(&b, VERDICT_PASS, 1, "a truth of other parameters");
    gsl_test_int(b.j.unmet, 1, "is missed");
    scene_add_motion(&b.p.scene, SCENE_NONE, 1, &end,
                     (scene_motion){.step = 1, .start = {.velocity = {0}}});
    bench_expect(&b, VERDICT_PASS, 0, "a truth at another instant of a motion");
    gsl_test_int(b.j.unmet, 0, "is not missed");
    gsl_test_int(b.j.unread, 1, "but was not looked at");
    gsl_test_int(b.j.waiting, 0, "and waits for no formulation");
    gsl_test(later->judged, "nothing was judged by it");
    gsl_test_int(later->met, 1, "nor is it told as one of nothing that exists");
    later->quantity = words[WHY];
    bench_expect(&b, VERDICT_PASS, 1, "of a quantity that does not exist");
    gsl_test_int(b.j.unmet, 1, "it is missed, whatever the instant");
    bench_free(&b);
}

static void stored_values(void)
{
    judge_bench b;
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
    judgement_free(&b.j);
    gsl_test(judgement_make(&b.s, &b.t, 1, &b.j, &f) != STATUS_FAULT ||
                 strstr(f.text, "kN") == NULL,
             "another unit: %s", f.text);
    bench_free(&b);
}

/* Behind the series of another formulation, which has other values on its meshes. */
static void of_its_own_series(void)
{
    judge_bench b;
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
        judgement j = {0};
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

int main(void)
{
    predictions();
    theories();
    publications();
    bound_by_the_derived_limit();
    expectations();
    other_instants();
    stored_values();
    of_its_own_series();
    return gsl_test_summary();
}
