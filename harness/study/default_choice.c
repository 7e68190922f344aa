#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AGAINST_OMITTED, AGAINST_HERE, AGAINST_THEORY, AGAINST_ELSEWHERE, AGAINST_ORDER, REASONS };
typedef struct standing {
    int against[REASONS];
} standing;

static int holds_here(const rule *r, const scene *s, rule_subject at)
{
    for (int q = 0; q < s->quantities; q++)
        for (int i = 0; i < VERDICT_DEFECTS; i++) {
            at.quantity = s->quantity[q].name;
            at.verdict = verdict_name(verdict_defects[i]);
            if (rules_hold(r, &at))
                return 1;
        }
    return 0;
}

static int count_omits(const scene *s, const element_type *type)
{
    int count = 0;
    for (unsigned left = missing_omits(s, type); left != 0; left &= left - 1)
        count++;
    return count;
}

static int order_of(const scene *s, const element_type *type)
{
    double options[ELEMENT_MAX_OPTIONS] = {0};
    int least = INT_MAX;
    parameter_defaults(type->options, options);
    for (int i = 0; i < s->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        const int moves =
            q->analysis < s->analyses && s->analysis[q->analysis].kind == SCENE_MOTION;
        const int one = moves ? element_order_of_motion().highest
                              : element_order_in(type, verdict_analysis(s, q), options).highest;
        least = one < least ? one : least;
    }
    return least;
}

static standing standing_of(const scene *s, const element_type *type, const rule_subject *where,
                            const rule *rules, int count)
{
    const unsigned theories = FEATURE_ENGESSER | FEATURE_HARINGX;
    standing out = {.against[AGAINST_OMITTED] = count_omits(s, type)};
    rule_subject at = *where;
    at.formulation = type->name;
    for (int i = 0; i < count; i++) {
        if (!verdict_explains_defect(&rules[i]) || !rules_apply_to(&rules[i], type->name))
            continue;
        out.against[AGAINST_HERE] += holds_here(&rules[i], s, at);
        out.against[AGAINST_ELSEWHERE]++;
    }
    out.against[AGAINST_THEORY] =
        (features_needed(s) & theories) != (features_needed_of(s, type) & theories);
    out.against[AGAINST_ORDER] = -order_of(s, type);
    return out;
}

static int is_better(const standing *a, const standing *b)
{
    for (int i = 0; i < REASONS; i++)
        if (a->against[i] != b->against[i])
            return a->against[i] < b->against[i];
    return 0;
}

/* Returns 1 if the type supports all features of the scene. other 1: also if it supports enough of
 * them to run as another model. */
static int can_run(const scene *s, const element_type *type, int other)
{
    char words[OMIT_WORDS];
    if (other)
        return !missing_refused(s, type, words, sizeof words);
    return !missing_words(s, type, words, sizeof words) && !lacks_of(s, type, words, sizeof words);
}

/* Candidates, the best first. All rank equal with the first candidate. At most two belong to the
 * same family. */
enum { CANDIDATES = 5, OF_FAMILY = 2 };
typedef struct default_choice_candidates {
    int count;
    const element_type *type[CANDIDATES];
    standing here[CANDIDATES];
} default_choice_candidates;

static int is_taken(const default_choice_candidates *all, const element_type *type)
{
    int same = 0;
    for (int i = 0; i < all->count; i++) {
        if (all->type[i] == type)
            return 1;
        same += strcmp(all->type[i]->family, type->family) == 0;
    }
    return same >= OF_FAMILY;
}

static int is_equal_rank(const standing *a, const standing *b)
{
    for (int i = 0; i < AGAINST_ELSEWHERE; i++)
        if (a->against[i] != b->against[i])
            return 0;
    return 1;
}

/* Counts what speaks against each formulation, and orders the formulations that can run the scene
 * into `all`. */
typedef struct ranked {
    const element_type *type;
    standing here;
} ranked;

static int take_next(const ranked of[], int count, default_choice_candidates *all)
{
    const ranked *best = NULL;
    for (int i = 0; i < count; i++)
        if (!is_taken(all, of[i].type) && (best == NULL || is_better(&of[i].here, &best->here)))
            best = &of[i];
    if (best == NULL || (all->count > 0 && !is_equal_rank(&all->here[0], &best->here)))
        return 0;
    all->type[all->count] = best->type;
    all->here[all->count++] = best->here;
    return 1;
}

static status candidates_of(const scene *s, const rule_subject *where, const rule *rules, int count,
                            int other, default_choice_candidates *all, fault *f)
{
    int types = 0, able = 0;
    while (registry_formulations[types] != NULL)
        types++;
    ranked *of = malloc(((size_t)types + 1) * sizeof *of);
    if (of == NULL)
        return fault_memory(f, "a choice");
    for (int i = 0; i < types; i++) {
        const element_type *type = registry_formulations[i];
        if (!formulations_is_new(type) && type->misprint == NULL && can_run(s, type, other))
            of[able++] =
                (ranked){type, standing_of(s, type, where, rules, rules != NULL ? count : 0)};
    }
    all->count = 0;
    while (all->count < CANDIDATES && take_next(of, able, all)) {}
    free(of);
    return STATUS_OK;
}

static status find(const scene *s, const rule_subject *where, const rule *rules, int count,
                   default_choice_candidates *all, char why[FAULT_TEXT], fault *f)
{
    TRY(candidates_of(s, where, rules, count, 0, all, f));
    const int whole = all->count > 0;
    if (!whole)
        TRY(candidates_of(s, where, rules, count, 1, all, f));
    if (all->count == 0)
        return fault_set(f, STATUS_REFUSED,
                         "no formulation supports everything that %.60s requires; 'beamwork list' "
                         "shows what each formulation supports",
                         s->name);
    const int *against = all->here[0].against;
    snprintf(why, FAULT_TEXT, "%s%s%s",
             whole ? "supports all physics of the scene"
                   : "another model, with the fewest omissions",
             rules == NULL                ? ""
             : against[AGAINST_HERE] == 0 ? ", no known deviation here"
                                          : ", but has a known deviation here",
             against[AGAINST_THEORY] ? ", not the requested shear theory" : "");
    return STATUS_OK;
}

status default_choice_formulation(const scene *s, const rule_subject *where, const rule *rules,
                                  int count, formulation *out, char why[FAULT_TEXT], fault *f)
{
    default_choice_candidates all = {0};
    TRY(find(s, where, rules, count, &all, why, f));
    formulation_default(all.type[0], out);
    return STATUS_OK;
}

/* Returns 1 if the path has unstable states. On such a path, a coarse mesh may follow another
 * branch. */
static int met_unstable(const solve_result *r)
{
    for (int i = 0; i < r->steps; i++)
        if (result_is_unstable(r->step[i].stability))
            return 1;
    return 0;
}

typedef struct candidate_run {
    cell_request request;
    formulation chosen;
    cell_result cell[2];
    double requested;  /* relative change that counts as converged */
    value_change last; /* expected change from the last mesh to finer meshes */
    /* [quantities] earlier changes, and changes between the last two meshes */
    double *former, *raw;
    /* largest change between the last two meshes if a further change is expected; otherwise 0 */
    double slow;
    int tried, before, elements;
    int unstable;
    double cost, next; /* [s] cost of the last mesh, and estimated cost of the next mesh */
} candidate_run;

static status begin(candidate_run *r, const cell_request *request, const formulation *chosen,
                    double requested, fault *f)
{
    const int quantities = request->scene->quantities;
    memset(r, 0, sizeof *r);
    r->request = *request;
    r->chosen = *chosen;
    r->requested = requested;
    cell_formulation(&r->request, chosen);
    r->last = (value_change){.largest = INFINITY, .which = -1};
    r->last.of_each = malloc(((size_t)quantities + 1) * sizeof *r->last.of_each);
    r->former = calloc((size_t)quantities + 1, sizeof *r->former);
    r->raw = calloc((size_t)quantities + 1, sizeof *r->raw);
    if (r->last.of_each == NULL || r->former == NULL || r->raw == NULL)
        return fault_memory(f, "a choice");
    for (int i = 0; i < quantities; i++)
        r->last.of_each[i] = NAN;
    return STATUS_OK;
}

static void end(candidate_run *r)
{
    free(r->last.of_each);
    free(r->former);
    free(r->raw);
    cell_result_free(&r->cell[0]);
    cell_result_free(&r->cell[1]);
}

static int next_mesh(const scene *s, const candidate_run *r)
{
    return r->tried < s->meshes ? s->mesh[r->tried] : 2 * r->elements;
}

static int has_converged(const scene *s, const candidate_run *r)
{
    const int sure = !r->unstable && !r->last.missing;
    return r->last.largest <= r->requested && (sure || r->tried >= s->meshes);
}

static int exhausted(const scene *s, const candidate_run *r)
{
    const int may_converge = r->tried < 2 || isfinite(r->last.largest);
    return r->tried >= s->meshes &&
           (!may_converge || r->next > DEFAULT_CHOICE_COST || r->elements >= DEFAULT_CHOICE_FINEST);
}

/* Estimates the remaining change if the order is below one, because it then exceeds the last change
 * c. The estimate is c (q + q^2 + ...), where q is the ratio of the last change to the previous
 * one. */
static void expect_more(const scene *s, candidate_run *r)
{
    /* smallest relative change that gives an order, and largest multiple of the last change */
    const double seen = 1e-6, most = 9;
    const double largest = r->last.largest;
    for (int i = 0; i < s->quantities; i++) {
        const double now = r->last.of_each[i], rate = now / r->former[i];
        r->raw[i] = now;
        if (!(now > seen && r->former[i] > seen && rate > 0.5 && rate < 1))
            continue;
        r->last.of_each[i] = now * fmin(rate / (1 - rate), most);
        if (r->last.of_each[i] > r->last.largest) {
            r->last.largest = r->last.of_each[i];
            r->last.which = i;
        }
    }
    r->slow = r->last.largest > largest ? largest : 0;
}

static void refine(const scene *s, candidate_run *r)
{
    const int halved = r->tried > 1 && r->elements == 2 * r->before;
    cell_result *now = &r->cell[r->tried % 2];
    fault f;
    cell_result_free(now);
    memset(now, 0, sizeof *now);
    r->before = r->elements;
    r->request.elements = r->elements = next_mesh(s, r);
    cell_run(&r->request, now, &f);
    if (r->tried > 0) {
        memcpy(r->former, r->raw, (size_t)s->quantities * sizeof *r->raw);
        change_between(s, &r->cell[(r->tried + 1) % 2], now, &r->last);
        if (!halved || r->elements != 2 * r->before)
            memset(r->former, 0, (size_t)s->quantities * sizeof *r->former);
        expect_more(s, r);
    }
    r->unstable |= met_unstable(&now->solve);
    r->cost = counted_cost(&r->chosen, now);
    r->next = 2 * r->cost;
    r->tried++;
}

/* Returns the last change; 0: fewer than two meshes have been solved. */
static double known_change(const candidate_run *r)
{
    return r->tried < 2 ? 0 : r->last.largest;
}

/* Returns the candidate whose next mesh has the lowest cost. If costs are equal within the
 * error of the cost model, the candidate with the smallest known change is returned, and of
 * these the first. NULL: all are exhausted. */
static candidate_run *next_candidate(const scene *s, candidate_run of[], int count)
{
    const double equal = 1.17; /* error of half of the ratios of costs (docs/theory/cost.md) */
    candidate_run *out = NULL;
    double least = INFINITY;
    for (int i = 0; i < count; i++)
        if (!exhausted(s, &of[i]))
            least = fmin(least, of[i].next);
    for (int i = 0; i < count; i++) {
        candidate_run *r = &of[i];
        if (exhausted(s, r) || r->next > equal * least)
            continue;
        if (out == NULL || known_change(r) < known_change(out))
            out = r;
    }
    return out;
}

/* Repeatedly solves the next mesh of a candidate until one has converged. Returns this candidate;
 * NULL: none converges within the limits. */
static candidate_run *run_candidates(const scene *s, candidate_run of[], int count)
{
    candidate_run *next;
    while ((next = next_candidate(s, of, count)) != NULL) {
        refine(s, next);
        if (has_converged(s, next))
            return next;
    }
    return NULL;
}

static int has_curves(const scene *s)
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].reduction == SCENE_CURVE)
            return 1;
    return 0;
}

static void describe_elements(const scene *s, const candidate_run *r, char why[FAULT_TEXT])
{
    if (has_converged(s, r) && r->slow > 0)
        snprintf(why, FAULT_TEXT,
                 "no value is expected to change by more than %.2g %%; convergence is slow, with a "
                 "change of %.2g %% from n = %d",
                 100 * r->last.largest, 100 * r->slow, r->before);
    else if (has_converged(s, r))
        snprintf(why, FAULT_TEXT, "no value changed by more than %.2g %%%s from n = %d",
                 100 * r->last.largest, has_curves(s) ? " (curves: of their largest value)" : "",
                 r->before);
    else if (isfinite(r->last.largest) && r->last.which >= 0)
        snprintf(why, FAULT_TEXT,
                 "the finest mesh that was tried, on which %s still changed by %.2g %% from n = %d",
                 s->quantity[r->last.which].name, 100 * r->last.largest, r->before);
    else
        snprintf(why, FAULT_TEXT, "the finest mesh that was tried%s",
                 r->unstable ? "; coarser meshes had unstable states" : "");
}

static candidate_run *smallest_change(candidate_run of[], int count)
{
    candidate_run *out = &of[0];
    for (int i = 1; i < count; i++)
        if (of[i].last.largest < out->last.largest)
            out = &of[i];
    return out;
}

static void keep(const scene *s, candidate_run *r, default_choice *out)
{
    out->chosen = r->chosen;
    out->elements = r->elements;
    out->short_of = !has_converged(s, r) && r->last.which >= 0;
    out->change = r->last.of_each;
    r->last.of_each = NULL;
    describe_elements(s, r, out->why_elements);
}

void default_choice_free(default_choice *p)
{
    free(p->change);
    p->change = NULL;
}

status default_choice_elements(const cell_request *request, const formulation *chosen,
                               double requested, default_choice *out, fault *f)
{
    candidate_run one;
    *out = (default_choice){.why_formulation = ""};
    TRY(begin(&one, request, chosen, requested, f));
    run_candidates(request->scene, &one, 1);
    keep(request->scene, &one, out);
    end(&one);
    return STATUS_OK;
}

static void choose(const scene *s, candidate_run of[], int count, default_choice *out)
{
    candidate_run *first = run_candidates(s, of, count);
    keep(s, first != NULL ? first : smallest_change(of, count), out);
    if (first != NULL && count > 1) {
        const size_t used = strlen(out->why_formulation);
        snprintf(out->why_formulation + used, FAULT_TEXT - used,
                 ", converged at the lowest cost of %d formulations", count);
    }
}

status default_choice_both(const cell_request *request, const rule_subject *where,
                           const rule *rules, int count, double requested, default_choice *out,
                           fault *f)
{
    default_choice_candidates all;
    int begun = 0;
    status outcome = STATUS_OK;
    *out = (default_choice){.why_formulation = ""};
    TRY(find(request->scene, where, rules, count, &all, out->why_formulation, f));
    candidate_run *of = malloc(((size_t)all.count + 1) * sizeof *of);
    if (of == NULL)
        return fault_memory(f, "a choice");
    for (; begun < all.count && outcome == STATUS_OK; begun++) {
        formulation one;
        formulation_default(all.type[begun], &one);
        outcome = begin(&of[begun], request, &one, requested, f);
    }
    if (outcome == STATUS_OK)
        choose(request->scene, of, all.count, out);
    for (int i = 0; i < begun; i++)
        end(&of[i]);
    free(of);
    return outcome;
}
