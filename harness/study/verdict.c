#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"

static const char *const names[VERDICT_KINDS] = {"pass",
                                                 "biased",
                                                 "wrong limit",
                                                 "biased, as predicted",
                                                 "wrong limit, as predicted",
                                                 "low order",
                                                 "undecided",
                                                 "diverged",
                                                 "refused",
                                                 "skip",
                                                 "no truth",
                                                 "other model"};
static const double order_slack = 0.3; /* accuracy of observed orders on finite meshes */
/* a difference is significant if it exceeds this multiple of the uncertainty */
static const double many_times = 3;

const verdict_kind verdict_defects[VERDICT_DEFECTS] = {
    VERDICT_BIASED, VERDICT_WRONG_LIMIT, VERDICT_BIASED_AS_PREDICTED, VERDICT_WRONG_AS_PREDICTED};

int verdict_explains_defect(const rule *r)
{
    int explains = 0;
    for (int i = 0; i < VERDICT_DEFECTS; i++)
        explains |= choice_index(r->verdicts, verdict_name(verdict_defects[i])) >= 0;
    return explains;
}

const char *verdict_name(verdict_kind kind)
{
    return names[kind];
}

static double scale_of(const scene_quantity *q, double truth_value)
{
    return fmax(fabs(truth_value), q->near_zero);
}

double verdict_error(const scene_quantity *q, double value, double truth_value)
{
    const double scale = scale_of(q, truth_value);
    return scale > 0 ? (value - truth_value) / scale : value - truth_value;
}

typedef struct verdict_history {
    int n[SERIES_MAX_MESHES];
    double value[SERIES_MAX_MESHES]; /* NAN: none */
    status failure;
    const char *reason;
} verdict_history;

static status failure_of(const solve_result *r, const quantity_result *q)
{
    if (q != NULL)
        return q->status;
    return r->status != STATUS_OK ? r->status : STATUS_NOT_CONVERGED;
}

int verdict_meshes(const series *s, int quantity)
{
    int count = s->meshes;
    while (s->imported != NULL && count > 1 &&
           s->cell[count - 1].solve.quantity[quantity].status != STATUS_OK)
        count--;
    return count;
}

static verdict_history history_of(const series *s, int quantity)
{
    verdict_history h = {.failure = STATUS_NOT_CONVERGED, .reason = ""};
    for (int i = 0; i < verdict_meshes(s, quantity); i++) {
        const solve_result *r = &s->cell[i].solve;
        const quantity_result *q = quantity < r->quantities ? &r->quantity[quantity] : NULL;
        h.failure = failure_of(r, q);
        h.reason = "";
        if (h.failure != STATUS_OK)
            h.reason = q != NULL && q->reason[0] != '\0' ? q->reason : r->reason;
        h.n[i] = s->mesh[i];
        h.value[i] = h.failure == STATUS_OK ? q->value : NAN;
    }
    return h;
}

element_analysis verdict_analysis(const scene *s, const scene_quantity *q)
{
    if (q->analysis >= s->analyses)
        return ELEMENT_STATICS;
    const scene_analysis *a = &s->analysis[q->analysis];
    if (a->kind == SCENE_MODAL || a->kind == SCENE_HARMONIC || a->kind == SCENE_ROTATION ||
        scene_rotates(a))
        return ELEMENT_VIBRATION;
    return a->kind == SCENE_BUCKLING ? ELEMENT_BUCKLING : ELEMENT_STATICS;
}

/* noise: relative scatter of the values; NAN: not measured. */
static mesh_limit limit_with(const sweep *s, int series_index, int quantity, int left_out,
                             double noise)
{
    const series *one = &s->series[series_index];
    const scene *here = &s->point[one->point].scene;
    const scene_quantity *q = &here->quantity[quantity];
    const verdict_history h = history_of(one, quantity);
    const element_order order =
        element_order_in(one->formulation.type, verdict_analysis(here, q), one->formulation.option);
    const limit_sequence sequence = {
        .count = verdict_meshes(one, quantity) - left_out,
        .n = h.n,
        .value = h.value,
        .noise = noise,
        .nominal_order = fmax(1, ceil(q->least_order)),
        .highest_order = scene_tapers(here) && order.highest > 2 ? 2 : order.highest,
        .near_zero = q->near_zero};
    return limit_of(&sequence);
}

static double noise_of(const sweep *s, int series_index, int quantity)
{
    const series *one = &s->series[series_index];
    return one->noise != NULL ? one->noise[quantity] : NAN;
}

mesh_limit verdict_limit(const sweep *s, int series_index, int quantity, int left_out)
{
    return limit_with(s, series_index, quantity, left_out, noise_of(s, series_index, quantity));
}

/* Returns 1 if the order is known and too low. With more than four meshes, the previous order must
 * also be below the nominal order, and the last three orders must be monotonic. Changes below the
 * uncertainty of the reference value are ignored. */
static int order_is_low(const scene_quantity *q, const verdict *v)
{
    const double least = q->least_order - order_slack, nominal = ceil(q->least_order);
    return v->fit.kind == LIMIT_ASYMPTOTIC && v->fit.order + v->fit.order_uncertainty < least &&
           (v->fit.meshes == 4 || (v->fit.earlier_order < nominal && !v->fit.order_turns)) &&
           v->fit.last_change > v->truth->uncertainty;
}

/* Returns 1 if the limit agrees with the derived limit: their distance is at most many_times the
 * uncertainty of the limit plus that of the derived limit. */
static int is_predicted(const verdict *v)
{
    if (v->predicted == NULL)
        return 0;
    const double apart = fabs(v->fit.limit - v->predicted->value);
    return apart <= many_times * v->fit.limit_uncertainty + v->predicted->uncertainty;
}

static verdict_kind compare(const scene_quantity *q, const verdict *v)
{
    const double error = fabs(v->fit.limit - v->truth->value),
                 uncertainty = v->fit.limit_uncertainty;
    const int known = strcmp(v->truth->kind, "exact") == 0;
    if (!(error + uncertainty <= v->tolerance)) {
        const int wrong = error - uncertainty > v->tolerance && v->fit.meshes > 3;
        if (!wrong)
            return VERDICT_UNDECIDED;
        return is_predicted(v) ? VERDICT_WRONG_AS_PREDICTED : VERDICT_WRONG_LIMIT;
    }
    if (known && error > many_times * uncertainty + v->truth->uncertainty + v->unmodelled)
        return is_predicted(v) ? VERDICT_BIASED_AS_PREDICTED : VERDICT_BIASED;
    return order_is_low(q, v) ? VERDICT_LOW_ORDER : VERDICT_PASS;
}

/* Returns the values of truth.theory that apply to the formulation; NULL: any. A formulation whose
 * modes exclude shear has a separate theory, and its limits are compared with any reference
 * value. */
static const char *theories_of(const scene *s, const element_type *type)
{
    switch (features_theory(s, type)) {
    case SHEAR_ENGESSER:
        return "engesser";
    case SHEAR_HARINGX:
        return "haringx";
    default:
        return NULL;
    }
}

const truth *verdict_truth(const truths *t, const sweep_point *p, const formulation *chosen,
                           int quantity)
{
    return truth_of_theory(t, p->type, p->parameter, p->scene.quantity[quantity].name, "same",
                           theories_of(&p->scene, chosen->type));
}

const truth *verdict_reference(const truths *t, const sweep_point *p, const formulation *chosen,
                               int quantity)
{
    const truth *row = verdict_truth(t, p, chosen, quantity);
    const char *name = p->scene.quantity[quantity].name;
    return row != NULL ? row : truth_agreed(t, p->type, p->parameter, name);
}

static void find_truths(const sweep *s, const truths *t, verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    const char *name = p->scene.quantity[v->quantity].name;
    v->truth = verdict_truth(t, p, &one->formulation, v->quantity);
    v->model_truth = truth_of(t, p->type, p->parameter, name, "other");
    if (v->truth == NULL)
        v->theory_truth = truth_of(t, p->type, p->parameter, name, "same");
    if (v->truth == NULL && v->model_truth == NULL)
        v->model_truth = v->theory_truth;
    if (v->truth == NULL && v->model_truth == NULL)
        v->model_truth = truth_agreed(t, p->type, p->parameter, name);
    const int foreign = one->imported != NULL && !imported_same_model(one->imported);
    if ((foreign || one->without.other) && v->truth != NULL) {
        v->model_truth = v->truth;
        v->truth = NULL;
    }
    v->predicted = truth_predicted(t, p->type, p->parameter, name, one->formulation.key);
}

/* Returns a published value of the same model and theory, other than the reference value, that
 * differs from the limit by more than the sum of both uncertainties; NULL: none. */
static const truth *contradiction(const sweep *s, const truths *t, const verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    const char *theories = theories_of(&p->scene, one->formulation.type);
    const char *quantity = p->scene.quantity[v->quantity].name;
    for (int i = truth_index_first(t, p->type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        if (strcmp(row->kind, "published") == 0 && row->formulation[0] == '\0' && !row->on_curve &&
            row != v->truth && strcmp(row->model, "same") == 0 &&
            (theories == NULL || row->theory[0] == '\0' || strcmp(row->theory, theories) == 0) &&
            truth_holds(row, p->type, p->parameter) &&
            fabs(v->fit.limit - row->value) > v->fit.limit_uncertainty + row->uncertainty)
            return row;
    }
    return NULL;
}

static void describe_other_model(const series *one, verdict *v)
{
    char words[OMISSION_TEXT];
    omission_words(&one->without, words);
    v->kind = v->expected = VERDICT_OTHER_MODEL;
    snprintf(v->reason, sizeof v->reason, "%.*s", (int)sizeof v->reason - 1, words);
}

static int is_inapplicable(const sweep *s, verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    if (one->missing[0] != '\0') {
        v->kind = v->expected = VERDICT_SKIP;
        snprintf(v->reason, sizeof v->reason, "does not support %s", one->missing);
        return 1;
    }
    if (p->status != STATUS_OK) {
        v->kind = p->status == STATUS_REFUSED ? VERDICT_REFUSED : VERDICT_DIVERGED;
        snprintf(v->reason, sizeof v->reason, "%s", p->reason);
        return 1;
    }
    const verdict_history h = history_of(one, v->quantity);
    if (h.failure == STATUS_OK)
        return 0;
    v->kind = h.failure == STATUS_REFUSED ? VERDICT_REFUSED : VERDICT_DIVERGED;
    snprintf(v->reason, sizeof v->reason, "%s", h.reason);
    return 1;
}

void verdict_reach(const sweep *s, const truths *t, verdict *v)
{
    verdict_reach_with(s, t, noise_of(s, v->series, v->quantity), v);
}

void verdict_reach_with(const sweep *s, const truths *t, double noise, verdict *v)
{
    const series *one = &s->series[v->series];
    const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
    v->unmodelled = 0;
    v->finest = v->error = v->departure = v->model_error = v->tolerance = NAN;
    v->fit = (mesh_limit){.limit = NAN,
                          .limit_uncertainty = NAN,
                          .order = NAN,
                          .order_uncertainty = NAN,
                          .last_change = NAN};
    v->expected = VERDICT_PASS;
    find_truths(s, t, v);
    if (is_inapplicable(s, v)) {
        if (one->without.other && one->missing[0] == '\0')
            describe_other_model(one, v);
        return;
    }
    v->finest = one->cell[verdict_meshes(one, v->quantity) - 1].solve.quantity[v->quantity].value;
    v->fit = limit_with(s, v->series, v->quantity, 0, noise);
    if (v->model_truth != NULL)
        v->model_error = verdict_error(q, v->fit.limit, v->model_truth->value);
    if (one->without.other) {
        describe_other_model(one, v);
        return;
    }
    if (v->truth == NULL) {
        v->kind = v->expected = VERDICT_NO_TRUTH;
        return;
    }
    v->unmodelled = one->without.what != 0 ? one->without.change * scale_of(q, v->truth->value) : 0;
    v->tolerance = (s->tolerance > 0 ? s->tolerance : q->tolerance) * scale_of(q, v->truth->value) +
                   v->truth->uncertainty + v->unmodelled;
    v->error = v->departure = verdict_error(q, v->fit.limit, v->truth->value);
    if (v->predicted != NULL)
        v->departure -= verdict_error(q, v->predicted->value, v->truth->value);
    v->below_digits = fabs(v->fit.limit - v->truth->value) <= v->truth->uncertainty;
    v->kind = compare(q, v);
    if (v->kind == VERDICT_PASS || v->kind == VERDICT_LOW_ORDER)
        v->contradicted = contradiction(s, t, v);
    if (v->predicted != NULL && v->kind == VERDICT_WRONG_LIMIT)
        snprintf(v->reason, sizeof v->reason, "its limit differs from the derived limit %.10g",
                 v->predicted->value);
}

static const series *series_of(const sweep *s, const verdict *v)
{
    return &s->series[v->series];
}

static const char *case_of(const sweep *s, const verdict *v)
{
    return s->point[series_of(s, v)->point].type->name;
}

static const char *quantity_of(const sweep *s, const verdict *v)
{
    return s->point[series_of(s, v)->point].scene.quantity[v->quantity].name;
}

static int same_rule(const sweep *s, const verdict *a, const verdict *b)
{
    return a->needs_deviation && b->needs_deviation && a->kind == b->kind &&
           strcmp(case_of(s, a), case_of(s, b)) == 0 &&
           strcmp(series_of(s, a)->formulation.key, series_of(s, b)->formulation.key) == 0;
}

static int first_of(const sweep *s, const evaluation *j, int index, int quantity)
{
    const verdict *v = &j->verdict[index];
    for (int i = 0; i < index; i++)
        if (same_rule(s, &j->verdict[i], v) &&
            (!quantity || strcmp(quantity_of(s, &j->verdict[i]), quantity_of(s, v)) == 0))
            return i;
    return index;
}

static void write_rule(FILE *to, const sweep *s, const evaluation *j, int first, int number)
{
    const verdict *v = &j->verdict[first];
    const char *key = series_of(s, v)->formulation.key, *blank = "";
    double largest = 0;
    fprintf(to, "NEW%d-%s,\"%s\",%s,,\"", number, case_of(s, v), key, case_of(s, v));
    for (int i = first; i < j->verdicts; i++) {
        const verdict *one = &j->verdict[i];
        if (!same_rule(s, v, one))
            continue;
        if (isfinite(one->departure))
            largest = fmax(largest, fabs(one->departure));
        if (first_of(s, j, i, 1) != i)
            continue;
        fprintf(to, "%s%s", blank, quantity_of(s, one));
        blank = " ";
    }
    fprintf(to, "\",\"%s\",", verdict_name(v->kind));
    if (largest > 0)
        fprintf(to, "%.2g", 4 * largest / 3);
    fprintf(to, ",,\"" PROPOSAL_CAUSE "\",\n");
}

int proposal_write(FILE *to, const sweep *s, const evaluation *j)
{
    int rules = 0;
    fprintf(to, "rule,formulations,cases,condition,quantities,verdicts,largest_error,predicted,"
                "cause,proof\n");
    for (int i = 0; i < j->verdicts; i++)
        if (j->verdict[i].needs_deviation && first_of(s, j, i, 0) == i)
            write_rule(to, s, j, i, ++rules);
    return rules;
}

int imported_same_model(const imported *i)
{
    return strcmp(i->model, "beam") == 0;
}

void imported_free(imported *i)
{
    if (i == NULL)
        return;
    free(i->row);
    free(i);
}
