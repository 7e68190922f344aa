#include "harness/judge/preference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/catalogue/choice.h"
#include "harness/catalogue/formulations.h"
#include "harness/catalogue/registry.h"
#include "harness/model/features.h"
#include "harness/model/missing.h"

/* What speaks against a formulation, weightiest first; the least one is chosen. */
enum { AGAINST_OMITTED, AGAINST_HERE, AGAINST_THEORY, AGAINST_ELSEWHERE, AGAINST_ORDER, REASONS };
typedef struct standing {
    int against[REASONS];
} standing;

static const verdict_kind defects[] = {VERDICT_BIASED, VERDICT_WRONG_LIMIT,
                                       VERDICT_BIASED_AS_PREDICTED, VERDICT_WRONG_AS_PREDICTED};
enum { DEFECTS = sizeof defects / sizeof defects[0] };

static int tells_defect(const rule *r)
{
    int tells = 0;
    for (int i = 0; i < DEFECTS; i++)
        tells |= choice_index(r->verdicts, verdict_name(defects[i])) >= 0;
    return tells;
}

/* Does the rule say so of a quantity of the scene? */
static int holds_here(const rule *r, const scene *s, rule_subject at)
{
    for (int q = 0; q < s->quantities; q++)
        for (int i = 0; i < DEFECTS; i++) {
            at.quantity = s->quantity[q].name;
            at.verdict = verdict_name(defects[i]);
            if (rules_hold(r, &at))
                return 1;
        }
    return 0;
}

/* Features that it does not have, counted. */
static int count_omits(const scene *s, const element_type *type)
{
    int count = 0;
    for (unsigned left = missing_omits(s, type); left != 0; left &= left - 1)
        count++;
    return count;
}

static standing standing_of(const scene *s, const element_type *type, const rule_subject *where,
                            const rule *rules, int count)
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;
    standing out = {.against[AGAINST_OMITTED] = count_omits(s, type)};
    rule_subject at = *where;
    at.formulation = type->name;
    for (int i = 0; i < count; i++) {
        const int defect = tells_defect(&rules[i]);
        out.against[AGAINST_HERE] += defect && holds_here(&rules[i], s, at);
        out.against[AGAINST_ELSEWHERE] += defect && rules_speak_of(&rules[i], type->name);
    }
    out.against[AGAINST_THEORY] =
        (features_needed(s) & theories) != (features_needed_of(s, type) & theories);
    double options[ELEMENT_MAX_OPTIONS] = {0};
    parameter_defaults(type->options, options);
    out.against[AGAINST_ORDER] = -element_order_in(type, ELEMENT_STATICS, options).highest;
    return out;
}

static int is_better(const standing *a, const standing *b)
{
    for (int i = 0; i < REASONS; i++)
        if (a->against[i] != b->against[i])
            return a->against[i] < b->against[i];
    return 0;
}

/* Has it all of the scene, or, where `other`, what it needs to be another model of it? */
static int can_run(const scene *s, const element_type *type, int other)
{
    char words[OMIT_WORDS];
    if (other)
        return !missing_refused(s, type, words, sizeof words);
    return !missing_words(s, type, words, sizeof words) && !lacks_of(s, type, words, sizeof words);
}

/* The best of those that can run; NULL: none can. */
static const element_type *best_of(const scene *s, const rule_subject *where, const rule *rules,
                                   int count, int other, standing *best)
{
    const element_type *chosen = NULL;
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *type = registry_formulations[i];
        if (formulations_is_new(type) || !can_run(s, type, other)) /* its defects are not known */
            continue;
        const standing here = standing_of(s, type, where, rules, rules != NULL ? count : 0);
        if (chosen != NULL && !is_better(&here, best))
            continue;
        chosen = type;
        *best = here;
    }
    return chosen;
}

status preference_formulation(const scene *s, const rule_subject *where, const rule *rules,
                              int count, formulation *out, char why[FAULT_TEXT], fault *f)
{
    standing best = {{0}};
    const element_type *chosen = best_of(s, where, rules, count, 0, &best);
    const int whole = chosen != NULL;
    if (!whole)
        chosen = best_of(s, where, rules, count, 1, &best);
    if (chosen == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "no formulation offers all that %.60s needs; 'beamwork list' shows what "
                         "each offers",
                         s->name);
    formulation_default(chosen, out);
    snprintf(why, FAULT_TEXT, "%s%s%s",
             whole ? "offers all that is needed" : "another model, which lacks the least",
             rules == NULL                     ? ""
             : best.against[AGAINST_HERE] == 0 ? ", no known defect here"
                                               : ", but has a known defect here",
             best.against[AGAINST_THEORY] ? ", another theory of shear than asked for" : "");
    return STATUS_OK;
}

/* Largest relative change of a value, and of which quantity (-1: none changed); infinite where one
 * has none that the other has. */
static double change_of(const scene *s, const solve_result *a, const solve_result *b, int *which)
{
    double largest = 0;
    *which = -1;
    for (int q = 0; q < s->quantities; q++) {
        const double x = q < a->quantities ? a->quantity[q].value : (double)NAN,
                     y = q < b->quantities ? b->quantity[q].value : (double)NAN;
        if (s->quantity[q].reduction == SCENE_CURVE || (isnan(x) && isnan(y)))
            continue;
        const double change =
            isnan(x) || isnan(y) ? INFINITY : fabs(verdict_error(&s->quantity[q], y, x));
        if (change > largest) {
            largest = change;
            *which = q;
        }
    }
    return largest;
}

/* Of a mesh from the one before it. */
typedef struct step {
    double change; /* INFINITY: not known */
    int which;     /* quantity, -1: none */
} step;

static step step_between(const scene *s, const cell_result *before, const cell_result *now)
{
    step out = {INFINITY, -1};
    if (cell_values(before) > 0 && cell_values(now) > 0)
        out.change = change_of(s, &before->solve, &now->solve, &out.which);
    return out;
}

/* Of a path of which a coarse mesh may follow another branch. */
static int met_unstable(const solve_result *r)
{
    for (int i = 0; i < r->steps; i++)
        if (result_is_unstable(r->step[i].stability))
            return 1;
    return 0;
}

static void tell_elements(const scene *s, int mesh, const step *last, int unstable,
                          char why[FAULT_TEXT])
{
    if (last->change <= PREFERENCE_SETTLED)
        snprintf(why, FAULT_TEXT, "no value changed by more than %.2g %% from n = %d",
                 100 * last->change, s->mesh[mesh - 1]);
    else if (isfinite(last->change))
        snprintf(why, FAULT_TEXT, "the finest mesh of the case; %s still changed by %.2g %%",
                 s->quantity[last->which].name, 100 * last->change);
    else
        snprintf(why, FAULT_TEXT, "the finest mesh of the case%s",
                 unstable ? "; coarser ones met unstable states" : "");
}

int preference_elements(const cell_request *request, char why[FAULT_TEXT])
{
    const scene *s = request->scene;
    cell_request one = *request;
    cell_result cell[2];
    step last = {INFINITY, -1};
    int mesh = -1, unstable = 0;
    memset(cell, 0, sizeof cell);
    while (mesh + 1 < s->meshes && (last.change > PREFERENCE_SETTLED || unstable)) {
        cell_result *now = &cell[++mesh % 2];
        fault f;
        cell_result_free(now);
        memset(now, 0, sizeof *now);
        one.elements = s->mesh[mesh];
        cell_run(&one, now, &f); /* one that fails is not settled */
        if (mesh > 0)
            last = step_between(s, &cell[(mesh + 1) % 2], now);
        unstable |= met_unstable(&now->solve); /* which finer ones may not pass */
    }
    cell_result_free(&cell[0]);
    cell_result_free(&cell[1]);
    tell_elements(s, mesh, &last, unstable, why);
    return s->mesh[mesh];
}
