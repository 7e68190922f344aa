#include "harness/tools/kit/ask.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/study/study.h"

int ask_offered(const scene *s, const element_type *type)
{
    char words[FAULT_TEXT];
    return !missing_words(s, type, words, sizeof words);
}

static ask_outcome outcome_of(const scene *s, const element_type *type, status outcome, int all)
{
    if (!ask_offered(s, type))
        return ASK_NOT_OFFERED;
    if (outcome == STATUS_REFUSED)
        return ASK_REFUSED;
    return outcome == STATUS_OK && all ? ASK_ANSWERED : ASK_FAILED;
}

static void copy_curve(const scene *s, const curve *c, answer *out, int i)
{
    const int continued = s->analysis[s->quantity[i].analysis].kind == SCENE_CONTINUATION;
    const int points = c->points < ASK_POINTS ? c->points : ASK_POINTS;
    out->points[i] = continued ? 0 : points;
    for (int k = 0; k < out->points[i]; k++)
        out->curve[i][k] = c->value[k];
}

/* Returns 1 if each quantity has a value or cannot have one, such as a frequency that the mesh does
 * not have. */
static int copy_values(const scene *s, const solve_result *r, answer *out)
{
    int all = 1;
    gsl_test(r->quantities > ASK_QUANTITIES, "%s: too many quantities for an answer", s->name);
    for (int i = 0; i < r->quantities && i < ASK_QUANTITIES; i++) {
        out->value[i] = r->quantity[i].value;
        out->scale[i] = s->quantity[i].near_zero;
        snprintf(out->name[i], SCENE_NAME, "%s", s->quantity[i].name);
        snprintf(out->why[i], FAULT_TEXT, "%s", r->quantity[i].reason);
        copy_curve(s, &r->quantity[i].curve, out, i);
        out->values += isfinite(out->value[i]) || r->quantity[i].curve.points > 0;
        all &= r->quantity[i].status == STATUS_OK || r->quantity[i].status == STATUS_NO_VALUE;
        out->count = i + 1;
    }
    return all;
}

static void set_answer(const scene *s, const element_type *type, const solve_result *r,
                       status outcome, answer *out)
{
    const int all = copy_values(s, r, out);
    out->status = outcome;
    out->members = s->members;
    out->outcome = outcome_of(s, type, outcome, all);
    char words[OMIT_WORDS];
    if (out->outcome == ASK_NOT_OFFERED && missing_refused(s, type, words, sizeof words))
        gsl_test(outcome != STATUS_REFUSED,
                 "%s, %s: a value that is not supported must be rejected (%s)", s->name, type->name,
                 status_name(outcome));
}

/* Returns 1 if the edit of the question is defined for the case with these parameters. */
static int is_posed(const question *q, const double parameter[])
{
    scene s;
    fault f = {""};
    scene_init(&s, q->type->name);
    const status built = case_build(q->type, parameter, &s, &f);
    gsl_test(built != STATUS_OK, "%s %s: built (%s)", q->type->name, q->parameters, f.text);
    const int posed = built == STATUS_OK && scene_edit_apply(&s, &q->edit, &f) == STATUS_OK;
    scene_free(&s);
    return posed;
}

void ask(const question *q, answer *out)
{
    cell_request request = {
        .type = q->type, .elements = q->elements, .keep_all = q->keep_all, .edit = q->edit};
    cell_result result;
    formulation chosen;
    fault f = {""};
    memset(out, 0, sizeof *out);
    formulation_default(q->formulation, &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(q->type, request.parameter);
    if (q->parameters != NULL &&
        parameters_parse(q->type, q->parameters, request.parameter, NULL, &f) != STATUS_OK)
        gsl_test(1, "%s", f.text);
    if (!is_posed(q, request.parameter)) {
        out->outcome = ASK_NOT_POSED;
        return;
    }
    const status outcome = cell_run(&request, &result, &f);
    set_answer(&result.scene, q->formulation, &result.solve, outcome, out);
    snprintf(out->reason, sizeof out->reason, "%s", f.text);
    cell_result_free(&result);
}

void ask_scene(const scene *s, const element_type *type, const double option[], int elements,
               answer *out)
{
    model *m = NULL;
    solve_result r = {0};
    formulation chosen;
    fault f = {""};
    memset(out, 0, sizeof *out);
    formulation_default(type, &chosen);
    const model_request wanted = {.scene = s,
                                  .type = type,
                                  .options = option != NULL ? option : chosen.option,
                                  .elements = elements};
    status outcome = scene_validate(s, &f);
    gsl_test(outcome != STATUS_OK, "%s: a scene (%s)", s->name, f.text);
    if (outcome == STATUS_OK)
        outcome = model_alloc(&wanted, &m, &f);
    if (outcome == STATUS_OK)
        outcome = solve_scene(s, m, NULL, &r, &f);
    set_answer(s, type, &r, outcome, out);
    snprintf(out->reason, sizeof out->reason, "%s", f.text);
    result_free(&r);
    model_free(m);
}

double answer_of(const answer *a, const char *quantity)
{
    for (int i = 0; i < a->count; i++)
        if (strcmp(a->name[i], quantity) == 0)
            return a->value[i];
    return NAN;
}

int ask_count(ask_tally *t, const answer *a, const char *what, ...)
{
    char *line = a->outcome == ASK_FAILED ? t->failure : t->refusal;
    t->count[a->outcome]++;
    t->values += a->values;
    if (a->outcome == ASK_FAILED || a->outcome == ASK_REFUSED) {
        va_list arguments;
        va_start(arguments, what);
        int used = vsnprintf(line, FAULT_TEXT, what, arguments);
        va_end(arguments);
        if (used < FAULT_TEXT)
            snprintf(line + used, (size_t)(FAULT_TEXT - used), ": %s",
                     a->reason[0] != '\0' ? a->reason : "no value");
    }
    return a->outcome == ASK_ANSWERED;
}

void ask_conclude(const ask_tally *t, const element_type *type, const char *test)
{
    const int *count = t->count;
    const int offered = count[ASK_ANSWERED] + count[ASK_REFUSED] + count[ASK_FAILED];
    gsl_test(count[ASK_FAILED] > 0, "%s, %s: %d of %d supported requests failed (%s)", type->name,
             test, count[ASK_FAILED], offered, t->failure);
    gsl_test(count[ASK_REFUSED] > t->most_refused,
             "%s, %s: %d of %d supported requests were rejected (%s)", type->name, test,
             count[ASK_REFUSED], offered, t->refusal);
    gsl_test(offered > 0 && t->values == 0,
             "%s, %s: %d values in %d answers, %d requests not supported", type->name, test,
             t->values, count[ASK_ANSWERED], count[ASK_NOT_OFFERED]);
}
