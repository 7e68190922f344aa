/* Checks of element histories, and measurements along paths: superposed rigid rotations of many
 * turns, and closed cycles of deformation. */
#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"
#include "harness/formulations/adapted.h"

enum { M = SPECIMEN_STRAINS, N = SPECIMEN_COORDINATES };

static const char *const claim_continues = "commit does not change the strains",
                         *const claim_twice = "a second commit changes nothing",
                         *const claim_same = "commit gives the same bits again";

/* A committed state, and the history before and after the call of `commit`. */
typedef struct committed {
    node_state x[ELEMENT_MAX_NODES];
    double before[ELEMENT_MAX_HISTORY], after[ELEMENT_MAX_HISTORY];
} committed;

static void commit_of(const specimen *s, const double before[], committed *out)
{
    const size_t bytes = (size_t)s->values * sizeof(double);
    memcpy(out->before, before, bytes);
    memcpy(out->after, before, bytes);
    s->type.commit(s->data, out->x, out->after);
}

static void continues(const specimen *s, const committed *of, claim *one)
{
    double first[M], then[M];
    s->type.strain(s->data, of->x, &(strain_output){.e = first, .history = of->before});
    s->type.strain(s->data, of->x, &(strain_output){.e = then, .history = of->after});
    for (int i = 0; i < s->strains; i++)
        claims_departs(one, fabs(then[i] - first[i]) / s->request.length,
                       "commit: strain %d of a state changes from %.9g m to %.9g m when the state "
                       "is committed; store values that give the same strains%s",
                       i + 1, first[i], then[i], s->words);
}

static void compare_values(const specimen *s, const double first[], const double then[],
                           const char *what, claim *one)
{
    for (int i = 0; i < s->values; i++)
        claims_departs(one, fabs(then[i] - first[i]) / fmax(1, fabs(first[i])),
                       "commit: value %d of the history is %.9g, but %.9g %s%s", i + 1, first[i],
                       then[i], what, s->words);
}

static void check(const specimen *s, claims *c)
{
    static const unsigned seed[] = {5, 71, 73};
    committed of, again;
    const double *last = s->history;
    if (s->values == 0)
        return;
    claims_doing(c, "commit%s", s->words);
    for (size_t k = 0; k < sizeof seed / sizeof seed[0]; k++) {
        specimen_state(s, 0.05, seed[k], of.x);
        memcpy(again.x, of.x, sizeof of.x);
        commit_of(s, last, &of);
        continues(s, &of, claims_open(c, claim_continues, 1e-13));
        commit_of(s, of.before, &again);
        compare_values(s, of.after, again.after, "in a second call with the same input",
                       claims_open(c, claim_same, 0));
        commit_of(s, of.after, &again);
        compare_values(s, of.after, again.after, "after a second commit of the same state",
                       claims_open(c, claim_twice, 1e-12));
        memcpy(again.before, of.after, sizeof of.after);
        last = again.before;
    }
}

void checks_history(const formulation *chosen, claims *out)
{
    if (element_history(chosen->type, chosen->option) == 0) {
        claims_not_made(out, claim_continues, "declares no history");
        return;
    }
    specimens_each(chosen, out, check);
}

/* Strains and forces along a path of one element. */

/* STEPS: steps of each turn and cycle. marks: numbers of cycles after which values are measured.
 * turned, moved: size of the rotations of nodes [rad] and of other coordinates. The rotations
 * remain below the declared limits. */
enum { STEPS = 24, MARKS = 3 };
static const int marks[MARKS] = {1, 10, 100};
static const double turned = 0.3, moved = 0.05;
static const double exact = 1e-9;

/* An element that follows a path, with its history and its last results. */
typedef struct walker {
    const specimen *s;
    double history[ELEMENT_MAX_HISTORY];
    int strains;                   /* 0: only the energy is computed */
    double e[M], energy, force[N]; /* force: multiplied by the unit of its coordinate [J] */
    double most_e, most_energy, most_force; /* largest absolute values in the first cycle */
} walker;

static void walker_begin(const specimen *s, walker *w)
{
    memset(w, 0, sizeof *w);
    w->s = s;
    w->strains = s->made.given->force == NULL;
    if (s->values > 0)
        memcpy(w->history, s->history, (size_t)s->values * sizeof *w->history);
}

/* Computes the state of a closed cycle at a phase in [0, 1]. */
static void cycle_state(const specimen *s, double phase, node_state x[])
{
    const double there = sin(2 * PI * phase), aside = 1 - cos(2 * PI * phase);
    double a[N], b[N], step[N];
    node_state rest[ELEMENT_MAX_NODES];
    specimen_state(s, 0, 1, rest);
    specimen_numbers(s->coordinates, 101, a);
    specimen_numbers(s->coordinates, 103, b);
    for (int i = 0; i < s->coordinates; i++) {
        const int k = i % NODE_COORDINATES;
        step[i] = (k >= 3 && k < 6 ? turned : moved) * (there * a[i] + aside * b[i]) *
                  chart_unit(i, s->request.length);
    }
    chart_move(rest, s->nodes, step, x);
}

/* Returns the largest absolute value, or NAN if a value is NAN. */
static double largest(int count, const double v[])
{
    double out = 0;
    for (int i = 0; i < count && !isnan(out); i++)
        out = isnan(v[i]) || fabs(v[i]) > out ? fabs(v[i]) : out;
    return out;
}

/* Returns 1 if step k is evaluated. With a history, all steps are evaluated. Otherwise only the
 * steps of the first cycle and of the cycles that end at a mark are evaluated. */
static int matters(const specimen *s, int k)
{
    int is = s->values > 0 || k <= STEPS;
    for (int i = 0; i < MARKS; i++)
        is |= k > (marks[i] - 1) * STEPS && k <= marks[i] * STEPS;
    return is;
}

/* Evaluates the element in step k of its path, and commits the state. forces 1: also computes the
 * forces. */
static status walker_step(walker *w, int k, const node_state x[], int forces)
{
    const specimen *s = w->s;
    double J[M * N], sigma[M], inner[SPECIMEN_INNER];
    if (!w->strains) {
        TRY(s->made.given->force(adapted_own(s->data), x, &(force_output){.energy = &w->energy}));
        if (k <= STEPS)
            w->most_energy = fmax(w->most_energy, fabs(w->energy));
        return STATUS_OK;
    }
    s->type.strain(s->data, x,
                   &(strain_output){.e = w->e,
                                    .J = forces ? J : NULL,
                                    .history = s->values > 0 ? w->history : NULL});
    if (forces) {
        specimen_rest(s, inner);
        TRY(specimen_settled(s, w->e, inner, &(stress_output){.sigma = sigma}));
        memset(w->force, 0, sizeof w->force);
        dense_add_transpose_mul(s->coordinates, s->strains, 1, J, sigma, w->force);
        for (int i = 0; i < s->coordinates; i++)
            w->force[i] *= chart_unit(i, s->request.length);
    }
    if (k <= STEPS) {
        w->most_e = fmax(w->most_e, largest(s->strains, w->e));
        w->most_force = fmax(w->most_force, largest(s->coordinates, w->force));
    }
    if (s->values > 0)
        s->type.commit(s->data, x, w->history);
    return STATUS_OK;
}

static void conclude(element_measure *one, const char *holds, const char *fails)
{
    double worst = 0;
    for (int i = 0; i < one->points; i++)
        worst = fmax(worst, isnan(one->error[i]) ? INFINITY : one->error[i]);
    snprintf(one->words, sizeof one->words, "%s", worst <= exact ? holds : fails);
}

/* Follows closed cycles with and without an additional rotation of the whole element, and compares
 * the strains. For elements without strains, compares the energies. */
static void superposed(const specimen *s, measures *out)
{
    static const double axis[3] = {0.36, 0.48, 0.8};
    walker at, there;
    double most = 0;
    walker_begin(s, &at);
    walker_begin(s, &there);
    element_measure *one =
        measures_add(out, at.strains ? "strains, turns superposed" : "energy, turns superposed");
    for (int k = 1, mark = 0; mark < MARKS; k++) {
        double turn[3], differs[M];
        node_state x[ELEMENT_MAX_NODES], carried[ELEMENT_MAX_NODES];
        if (!matters(s, k))
            continue;
        cycle_state(s, (double)(k % STEPS) / STEPS, x);
        for (int i = 0; i < 3; i++)
            turn[i] = axis[i] * 2 * PI * k / STEPS;
        specimen_carry(s, turn, x, carried);
        if (walker_step(&at, k, x, 0) != STATUS_OK ||
            walker_step(&there, k, carried, 0) != STATUS_OK) {
            snprintf(one->words, sizeof one->words, "a state of the path cannot be evaluated");
            return;
        }
        for (int i = 0; i < s->strains && at.strains; i++)
            differs[i] = there.e[i] - at.e[i];
        most =
            fmax(most, at.strains ? largest(s->strains, differs) : fabs(there.energy - at.energy));
        if (k != marks[mark] * STEPS)
            continue;
        measures_point(one, marks[mark++], most / (at.strains ? at.most_e : at.most_energy));
    }
    conclude(one, "objective", "not objective");
}

/* Follows closed cycles, and compares the states at their ends with the undeformed state. */
static void cycles(const specimen *s, measures *out)
{
    walker at;
    element_measure *strains, *forces;
    walker_begin(s, &at);
    if (!at.strains)
        return;
    strains = measures_add(out, "strains after closed cycles");
    forces = measures_add(out, "forces after closed cycles");
    for (int k = 1, mark = 0; mark < MARKS; k++) {
        node_state x[ELEMENT_MAX_NODES];
        if (!matters(s, k))
            continue;
        cycle_state(s, (double)(k % STEPS) / STEPS, x);
        if (walker_step(&at, k, x, k <= STEPS || k == marks[mark] * STEPS) != STATUS_OK) {
            snprintf(strains->words, sizeof strains->words,
                     "a state of the path cannot be evaluated");
            memcpy(forces->words, strains->words, sizeof forces->words);
            return;
        }
        if (k != marks[mark] * STEPS)
            continue;
        measures_point(strains, marks[mark], largest(s->strains, at.e) / at.most_e);
        measures_point(forces, marks[mark++], largest(s->coordinates, at.force) / at.most_force);
    }
    conclude(strains, "path-independent", "path-dependent");
    conclude(forces, "path-independent", "path-dependent");
}

/* Checks that errors after superposed rotations and closed cycles are at most `exact`, unless the
 * formulation declares LIMIT_NOT_OBJECTIVE or LIMIT_PATH_DEPENDENT. */
static void hold_against_declared(const formulation *chosen, const measures *out, claims *c)
{
    static const struct {
        unsigned limit;
        const char *claim, *word;
    } of[] = {{LIMIT_NOT_OBJECTIVE, "superposed turns change no strain", "LIMIT_NOT_OBJECTIVE"},
              {LIMIT_PATH_DEPENDENT, "closed cycles leave no strain", "LIMIT_PATH_DEPENDENT"}};
    for (int i = 0; i < 2 && i < out->count; i++) {
        const element_measure *one = &out->measure[i];
        if (one->points == 0)
            continue;
        if (chosen->type->limits & of[i].limit) {
            char why[60];
            snprintf(why, sizeof why, "declares %s", of[i].word);
            claims_not_made(c, of[i].claim, why);
            continue;
        }
        for (int k = 0; k < one->points; k++)
            claims_departs(claims_open(c, of[i].claim, exact), one->error[k],
                           "strain: %s: an error of %.2g of the largest strain after %g turns or "
                           "cycles; correct "
                           "the update, or declare %s",
                           one->name, one->error[k], one->at[k], of[i].word);
    }
}

void measured_paths(const formulation *chosen, claims *c, measures *out)
{
    const specimen_request what = {.given = chosen->type,
                                   .options = chosen->option,
                                   .features = specimen_features(chosen->type, 0),
                                   .unit = 1};
    specimen s;
    fault f = {""};
    claims_doing(c, "an element along a path");
    if (specimen_make(&what, &s, &f) == STATUS_OK) {
        superposed(&s, out);
        cycles(&s, out);
    }
    if (element_history(chosen->type, chosen->option) > 0)
        hold_against_declared(chosen, out, c);
    specimen_free(&s);
}
