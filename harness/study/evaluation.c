#include "harness/study/study_impl.h"

#include <fnmatch.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics.h"

/* Sets rule.missed of each rule that the run should have shown but did not, and returns the number
 * of these rules. whole 1: no selection was made, so the run should have shown every rule.
 * Otherwise only rules of a user table (rule.from) count, and only if their formulations and cases
 * were run with all points and quantities. A selection (-k) that matches the name of a case
 * includes the whole case. */
static int missed_rules(const sweep *s, truths *t, int whole);
/* Counts the reference values that a complete run did not use: unmet, waiting and unread. An unread
 * value counts as met (truth.met), but is not evaluated. */
static void missed_truths(const sweep *s, truths *t, evaluation *out);

static int is_beyond(const rule *r, const verdict *v)
{
    return isfinite(v->departure) && isfinite(r->largest_error) &&
           fabs(v->departure) > r->largest_error;
}

/* Sets the expectation for a verdict. A verdict other than pass is expected if exactly one known
 * deviation applies. */
static void expect(const sweep *s, truths *t, verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    const char *quantity = p->scene.quantity[v->quantity].name;
    const rule_subject subject = {
        p->type,  p->parameter,         features_needed(&p->scene), one->formulation.key,
        quantity, verdict_name(v->kind)};
    v->matches = v->kind == v->expected;
    if (one->imported != NULL)
        return;
    for (int i = 0; i < t->rules && !v->matches; i++) {
        rule *r = &t->rule[i];
        if (!rules_hold(r, &subject))
            continue;
        if (v->rule != NULL) {
            snprintf(v->reason, sizeof v->reason,
                     "two known deviations apply to this quantity: %.60s and %.60s; restrict one "
                     "of them",
                     v->rule->name, r->name);
            v->expected = VERDICT_PASS;
            return;
        }
        v->rule = r;
        r->observed++;
        if (v->kind == VERDICT_BIASED_AS_PREDICTED || v->kind == VERDICT_WRONG_AS_PREDICTED)
            rules_confirm_limit(r, &subject);
        if (is_beyond(r, v) && r->from == NULL && formulations_is_loaded(one->formulation.type))
            continue;
        if (is_beyond(r, v))
            snprintf(v->reason, sizeof v->reason,
                     "the limit differs by %+.3g %% from %s, but known deviation %.60s covers at "
                     "most %.3g %%",
                     100 * v->departure,
                     v->predicted != NULL ? "the derived limit" : "the reference value", r->name,
                     100 * r->largest_error);
        else
            v->expected = v->kind;
    }
    v->matches = v->kind == v->expected;
}

static status check_cells(const sweep *s, int index, evaluation *out, fault *f)
{
    const series *one = &s->series[index];
    const scene *what = &s->point[one->point].scene;
    if (one->missing[0] != '\0' || one->without.other)
        return STATUS_OK;
    for (int i = 0; i < one->meshes; i++) {
        flaw c = {.series = index, .mesh = i};
        if (!record_is_consistent(&one->cell[i], what, formulation_newton(&one->formulation),
                                  c.why))
            TRY(memory_append(&out->flaw, &out->flaws, &c, sizeof c, "flaws of runs", f));
    }
    return STATUS_OK;
}

static void mark_met(truths *t, const sweep_point *p, const formulation *chosen,
                     const char *quantity, int evaluated)
{
    for (int i = truth_index_first(t, p->type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        truth *row = &t->row[i];
        if (truth_holds(row, p->type, p->parameter) &&
            (row->formulation[0] == '\0' || strcmp(row->formulation, chosen->key) == 0)) {
            row->met = 1;
            row->evaluated |= evaluated;
        }
    }
}

static status check_unit(const sweep_point *p, const truth *row, fault *f)
{
    for (int q = 0; q < p->scene.quantities; q++) {
        const scene_quantity *here = &p->scene.quantity[q];
        if (strcmp(here->name, row->quantity) == 0 && strcmp(here->unit, row->unit) != 0)
            return fault_set(f, STATUS_FAULT,
                             "case %s: the unit of %s is '%s', but that of its reference value is "
                             "'%s'; correct reference/tables/%s.csv and build again",
                             p->type->name, here->name, here->unit, row->unit, p->type->name);
    }
    return STATUS_OK;
}

static status check_units(const sweep *s, const truths *t, fault *f)
{
    for (int i = 0; i < s->points; i++)
        for (int r = 0; r < t->rows; r++)
            if (t->row[r].type == s->point[i].type)
                TRY(check_unit(&s->point[i], &t->row[r], f));
    return STATUS_OK;
}

static int is_imported(const series *one, int quantity)
{
    for (int i = 0; i < one->meshes; i++)
        if (one->cell[i].solve.quantity[quantity].status == STATUS_OK)
            return 1;
    return 0;
}

static int is_within(const verdict *v)
{
    return v->kind == VERDICT_PASS || v->kind == VERDICT_BIASED ||
           v->kind == VERDICT_BIASED_AS_PREDICTED || v->kind == VERDICT_LOW_ORDER;
}

static void evaluate_quantity(const sweep *s, truths *t, int index, int quantity, evaluation *out)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    const int gates = sweep_gates(s, one);
    verdict *v = &out->verdict[out->verdicts++];
    v->series = index;
    v->quantity = quantity;
    verdict_reach(s, t, v);
    expect(s, t, v);
    if (s->tolerance > 0 && is_within(v)) {
        out->tolerated += !v->matches && v->truth != NULL && gates;
        v->expected = v->kind;
        v->matches = 1;
    }
    if (!gates && one->imported != NULL) {
        out->imported += v->truth != NULL && v->kind != VERDICT_SKIP;
        out->imported_failed += v->truth != NULL && v->kind != VERDICT_SKIP && !v->matches;
        v->expected = v->kind;
        v->matches = 1;
        return;
    }
    v->needs_deviation = (s->named || !gates) && !v->matches && v->truth != NULL;
    if (!gates) {
        out->is_new += v->truth != NULL && v->kind != VERDICT_SKIP;
        out->proposed += v->needs_deviation;
        v->expected = v->kind;
        v->matches = 1;
    }
    out->by_kind[v->kind]++;
    out->evaluated += v->truth != NULL && v->kind != VERDICT_SKIP;
    out->unexpected += !v->matches;
    mark_met(t, p, &one->formulation, p->scene.quantity[quantity].name,
             v->kind != VERDICT_SKIP && v->kind != VERDICT_OTHER_MODEL);
}

/* largest relative change that scatter may explain */
static const double small_change = 1e-7;
/* The verdict must not change between relative scatters of 10^-MOST_DIGITS and 10^-LEAST_DIGITS, or
 * 10^-OPEN_DIGITS if it is undecided. */
enum { MOST_DIGITS = 16, LEAST_DIGITS = 6, OPEN_DIGITS = 3 };

static verdict verdict_with(const sweep *s, const truths *t, int index, int quantity,
                            double scatter)
{
    verdict out = {.series = index, .quantity = quantity};
    verdict_reach_with(s, t, scatter, &out);
    return out;
}

static int can_be_measured(const verdict *v)
{
    return v->truth != NULL && !isnan(v->fit.limit) && !isnan(v->fit.last_change);
}

/* Returns 1 if scatter may explain the whole last change, or the verdict is undecided. */
static int may_be_scatter(const sweep *s, const truths *t, int index, int quantity)
{
    const verdict v = verdict_with(s, t, index, quantity, NAN);
    return can_be_measured(&v) &&
           (v.kind == VERDICT_UNDECIDED ||
            v.fit.last_change <= small_change * fmax(fabs(v.finest), fabs(v.truth->value)));
}

/* Returns 1 if some scatter changes the verdict that is reached without measured scatter. */
static int depends_on_scatter(const sweep *s, const truths *t, int index, int quantity)
{
    const verdict v = verdict_with(s, t, index, quantity, NAN);
    const int least = v.kind == VERDICT_UNDECIDED ? OPEN_DIGITS : LEAST_DIGITS;
    for (int digits = MOST_DIGITS; can_be_measured(&v) && digits >= least; digits--) {
        const verdict other = verdict_with(s, t, index, quantity, pow(10, -digits));
        if (other.kind != v.kind || other.contradicted != v.contradicted)
            return 1;
    }
    return 0;
}

typedef int quantity_test(const sweep *s, const truths *t, int series_index, int quantity);

static int has_quantity_that(const sweep *s, const truths *t, int series_index,
                             quantity_test *holds)
{
    const series *one = &s->series[series_index];
    const sweep_point *p = &s->point[one->point];
    for (int q = 0; q < p->scene.quantities; q++)
        if (p->scene.quantity[q].reduction != SCENE_CURVE &&
            sweep_selects(s, p, &one->formulation, p->scene.quantity[q].name) &&
            holds(s, t, series_index, q))
            return 1;
    return 0;
}

int evaluation_needs_scatter(const sweep *s, const truths *t, int series_index)
{
    return s->series[series_index].imported == NULL &&
           has_quantity_that(s, t, series_index, may_be_scatter) &&
           has_quantity_that(s, t, series_index, depends_on_scatter);
}

static void clear_observations(truths *t)
{
    for (int i = 0; i < t->rules; i++)
        t->rule[i].observed = t->rule[i].confirmed = 0;
    for (int i = 0; i < t->rows; i++)
        t->row[i].met = t->row[i].evaluated = 0;
}

static void evaluate_series(const sweep *s, truths *t, int index, evaluation *out)
{
    const series *one = &s->series[index];
    const sweep_point *p = &s->point[one->point];
    for (int q = 0; q < p->scene.quantities; q++) {
        const scene_quantity *quantity = &p->scene.quantity[q];
        if (one->imported != NULL && (quantity->reduction == SCENE_CURVE || !is_imported(one, q)))
            continue;
        if (quantity->reduction == SCENE_CURVE)
            mark_met(t, p, &one->formulation, quantity->name,
                     one->missing[0] == '\0' && !one->without.other);
        else if (sweep_selects(s, p, &one->formulation, quantity->name))
            evaluate_quantity(s, t, index, q, out);
    }
}

status evaluation_begin(const sweep *s, truths *t, evaluation *out, fault *f)
{
    int count = 0;
    memset(out, 0, sizeof *out);
    clear_observations(t);
    for (int i = 0; i < s->seriess; i++)
        count += s->point[s->series[i].point].scene.quantities;
    out->verdict = calloc((size_t)count + 1, sizeof *out->verdict);
    if (out->verdict == NULL)
        return fault_memory(f, "verdicts");
    return check_units(s, t, f);
}

status evaluation_add(const sweep *s, truths *t, int series_index, evaluation *out, fault *f)
{
    const series *one = &s->series[series_index];
    const int first = out->verdicts;
    evaluate_series(s, t, series_index, out);
    TRY(agreements_add(s, t, series_index, out, f));
    if (one->imported == NULL && sweep_gates(s, one))
        TRY(check_cells(s, series_index, out, f));
    return coverage_count(s, first, out, f);
}

void evaluation_end(const sweep *s, truths *t, int whole, evaluation *out)
{
    out->unobserved = s->tolerance > 0 ? 0 : missed_rules(s, t, whole);
    if (whole)
        missed_truths(s, t, out);
}

status evaluation_make(const sweep *s, truths *t, int whole, evaluation *out, fault *f)
{
    TRY(evaluation_begin(s, t, out, f));
    for (int i = 0; i < s->seriess; i++)
        TRY(evaluation_add(s, t, i, out, f));
    evaluation_end(s, t, whole, out);
    return STATUS_OK;
}

void evaluation_free(evaluation *j)
{
    free(j->verdict);
    free(j->agreement);
    free(j->coverage);
    free(j->flaw);
    free(j->breach);
    free(j->regression);
    memset(j, 0, sizeof *j);
}

int evaluation_exit(const evaluation *j)
{
    if (j->breaches + j->regressions > 0)
        return EVALUATION_DIFFERS;
    if (j->evaluated + j->agreements == 0)
        return EVALUATION_NOTHING;
    return j->unexpected + j->disagreements + j->unobserved + j->unmet + j->flaws > 0
               ? EVALUATION_DIFFERS
               : EVALUATION_AS_EXPECTED;
}

const char *evaluation_outcome(const evaluation *j)
{
    const int code = evaluation_exit(j);
    return code == EVALUATION_NOTHING   ? "nothing was judged"
           : code == EVALUATION_DIFFERS ? "fail"
                                        : "pass";
}

static int is_run(const sweep *s, const case_type *type, const element_type *element)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].imported == NULL &&
            (type == NULL || s->point[s->series[i].point].type == type) &&
            (element == NULL || s->series[i].formulation.type == element))
            return 1;
    return 0;
}

static int key_is_run(const sweep *s, const char *word)
{
    for (int i = 0; i < s->seriess; i++)
        if (s->series[i].imported == NULL && fnmatch(word, s->series[i].formulation.key, 0) == 0)
            return 1;
    return 0;
}

static int formulations_are_run(const sweep *s, const char *word)
{
    int all = 1, found = 0;
    if (strchr(word, ':') != NULL)
        return key_is_run(s, word);
    for (int i = 0; formulations_at(i) != NULL; i++)
        if (fnmatch(word, formulations_at(i)->name, 0) == 0) {
            all &= is_run(s, NULL, formulations_at(i));
            found = 1;
        }
    return all && found;
}

static int cases_are_run(const sweep *s, const char *word)
{
    int all = 1, found = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (fnmatch(word, registry_cases[i]->name, 0) == 0)
            all &= is_run(s, registry_cases[i], NULL);
    for (int i = 0; i < s->points; i++)
        if (fnmatch(word, s->point[i].type->name, 0) == 0) {
            all &= select_covers(s->select, s->point[i].type->name);
            found = 1;
        }
    return all && found;
}

static int all_is_run(const sweep *s, const rule *r)
{
    char word[RULES_WORD];
    for (const char *at = r->formulations; (at = rules_next_word(at, word)) != NULL;)
        if (!formulations_are_run(s, word))
            return 0;
    for (const char *at = r->cases; (at = rules_next_word(at, word)) != NULL;)
        if (!cases_are_run(s, word))
            return 0;
    return s->unfinished == 0;
}

static int missed_rules(const sweep *s, truths *t, int whole)
{
    int count = 0;
    for (int i = 0; i < t->rules; i++) {
        rule *r = &t->rule[i];
        const int due = whole || (r->from != NULL && all_is_run(s, r));
        r->missed = due && !rules_is_observed(r);
        count += r->missed;
    }
    return count;
}

static int moves(const scene *s)
{
    int found = 0;
    for (int i = 0; i < s->analyses; i++)
        found |= s->analysis[i].kind == SCENE_MOTION;
    return found;
}

static int has_quantity(const scene *s, const char *name)
{
    for (int q = 0; q < s->quantities; q++)
        if (strcmp(s->quantity[q].name, name) == 0)
            return 1;
    return 0;
}

static int is_unread(const sweep *s, const truth *row)
{
    for (int i = 0; i < s->points; i++)
        if (s->point[i].type == row->type && s->point[i].status == STATUS_OK &&
            moves(&s->point[i].scene) && has_quantity(&s->point[i].scene, row->quantity))
            return 1;
    return 0;
}

static void missed_truths(const sweep *s, truths *t, evaluation *out)
{
    for (int i = 0; i < t->rows; i++) {
        truth *row = &t->row[i];
        const int elsewhere =
            row->formulation[0] != '\0' && formulation_find(row->formulation) == NULL;
        if (!row->met && !elsewhere && is_unread(s, row)) {
            row->met = 1;
            out->unread++;
            continue;
        }
        out->unmet += !row->met && !elsewhere;
        out->waiting += (row->met || elsewhere) && !row->evaluated;
    }
    out->unmet += t->unknown_cases;
}
