#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/math/scalar.h"
#include "harness/formulations/adapted.h"

enum { M = TEST_ELEMENT_STRAINS, N = TEST_ELEMENT_COORDINATES };

static const char *const check_continuation = "commit does not change the strains",
                         *const claim_forces = "commit does not change the forces",
                         *const check_repetition = "a second commit changes nothing",
                         *const check_same = "commit gives bit-for-bit equal values again";

typedef struct committed {
    node_state x[ELEMENT_MAX_NODES];
    double before[ADAPTERS_MOST_HISTORY], after[ADAPTERS_MOST_HISTORY];
} committed;

static void commit_of(const test_element *s, const double before[], committed *out)
{
    const size_t bytes = (size_t)s->values * sizeof(double);
    memcpy(out->before, before, bytes);
    memcpy(out->after, before, bytes);
    s->type.commit(s->data, out->x, out->after);
}

/* Computes the forces of a type that defines them, multiplied by the units of their coordinates
 * [J]. */
static status forces_of(const test_element *s, const node_state x[], const double history[],
                        double force[N])
{
    TRY(s->made.given->force(adapted_own(s->data), x,
                             &(force_output){.F = force, .history = history}));
    for (int i = 0; i < s->coordinates; i++)
        force[i] *= test_element_unit(s, i);
    return STATUS_OK;
}

static void forces_continue(const test_element *s, const committed *of, check_result *one)
{
    double first[N], then[N], most = 0;
    char where[TEST_ELEMENT_WORDS];
    if (forces_of(s, of->x, of->before, first) != STATUS_OK ||
        forces_of(s, of->x, of->after, then) != STATUS_OK)
        return;
    for (int i = 0; i < s->coordinates; i++)
        most = fmax(most, fabs(first[i]));
    for (int i = 0; i < s->coordinates; i++)
        checks_deviation(one, checks_relative(fabs(then[i] - first[i]), most),
                         "commit: the force in coordinate %d (%s) changes from %.9g to %.9g when "
                         "the state is committed; store values that give the same forces%s",
                         i + 1, test_element_coordinate(s, i, where),
                         first[i] / test_element_unit(s, i), then[i] / test_element_unit(s, i),
                         s->words);
}

static void continues(const test_element *s, const committed *of, check_result *one)
{
    double first[M], then[M];
    if (test_element_lacks_energy(s)) {
        forces_continue(s, of, one);
        return;
    }
    s->type.strain(s->data, of->x, &(strain_output){.e = first, .history = of->before});
    s->type.strain(s->data, of->x, &(strain_output){.e = then, .history = of->after});
    for (int i = 0; i < s->strains; i++)
        checks_deviation(
            one, fabs(then[i] - first[i]) / s->request.length,
            "commit: strain %d of a state changes from %.9g m to %.9g m when the state "
            "is committed; store values that give the same strains%s",
            i + 1, first[i], then[i], s->words);
}

static void compare_values(const test_element *s, const double first[], const double then[],
                           const char *what, check_result *one)
{
    for (int i = 0; i < s->values; i++)
        checks_deviation(one, fabs(then[i] - first[i]) / fmax(1, fabs(first[i])),
                         "commit: value %d of the history is %.9g, but %.9g %s%s", i + 1, first[i],
                         then[i], what, s->words);
}

static void check(const test_element *s, check_results *c)
{
    static const unsigned seed[] = {5, 71, 73};
    committed of, again;
    const double *last = s->history;
    if (s->values == 0)
        return;
    checks_current(c, "commit%s", s->words);
    for (size_t k = 0; k < sizeof seed / sizeof seed[0]; k++) {
        test_element_state(s, 0.05, seed[k], of.x);
        memcpy(again.x, of.x, sizeof of.x);
        commit_of(s, last, &of);
        continues(s, &of,
                  test_element_lacks_energy(s) ? checks_open(c, claim_forces, 1e-11)
                                               : checks_open(c, check_continuation, 1e-13));
        commit_of(s, of.before, &again);
        compare_values(s, of.after, again.after,
                       "in a second call with the same input; use only the arguments of 'commit'",
                       checks_open(c, check_same, 0));
        commit_of(s, of.after, &again);
        compare_values(
            s, of.after, again.after,
            "after a second commit of the same state; let a second commit change nothing",
            checks_open(c, check_repetition, 1e-12));
        memcpy(again.before, of.after, sizeof of.after);
        last = again.before;
    }
}

void checks_history(const formulation *chosen, check_results *out)
{
    if (element_history(chosen->type, chosen->option) == 0) {
        checks_not_made(out, check_continuation, "declares no history");
        return;
    }
    test_elements_each(chosen, out, check);
}

/* STEPS: steps of each turn and each cycle. marks: numbers of cycles after which values are
 * measured. turned, moved: amplitudes of the rotations of nodes [rad] and of other coordinates. */
enum { STEPS = 24, MARKS = 3 };
static const int marks[MARKS] = {1, 10, 100};
static const double turned = 0.3, moved = 0.05;
static const double exact = 1e-9;

enum { COMPARES_STRAINS, COMPARES_FORCES, COMPARES_ENERGY };

typedef struct walker {
    const test_element *s;
    double history[ADAPTERS_MOST_HISTORY];
    int compares;
    /* each entry of `force` is multiplied by the unit of its coordinate [J] */
    double e[M], energy, force[N];
    double most_e, most_energy, most_force; /* largest absolute values in the first cycle */
} walker;

static void walker_begin(const test_element *s, walker *w)
{
    memset(w, 0, sizeof *w);
    w->s = s;
    w->compares = s->made.given->force == NULL   ? COMPARES_STRAINS
                  : test_element_lacks_energy(s) ? COMPARES_FORCES
                                                 : COMPARES_ENERGY;
    if (s->values > 0)
        memcpy(w->history, s->history, (size_t)s->values * sizeof *w->history);
}

/* Computes the state of a closed cycle at a phase in [0, 1]. */
static void cycle_state(const test_element *s, double phase, node_state x[])
{
    const double there = sin(2 * PI * phase), aside = 1 - cos(2 * PI * phase);
    double a[N], b[N], step[N];
    node_state rest[ELEMENT_MAX_NODES];
    test_element_state(s, 0, 1, rest);
    test_element_numbers(s->coordinates, 101, a);
    test_element_numbers(s->coordinates, 103, b);
    for (int i = 0; i < s->coordinates; i++) {
        const int k = i % NODE_COORDINATES;
        step[i] = (k >= 3 && k < 6 ? turned : moved) * (there * a[i] + aside * b[i]) *
                  test_element_unit(s, i);
    }
    chart_move(rest, s->nodes, s->scalars, step, x);
}

static double largest(int count, const double v[])
{
    double out = 0;
    for (int i = 0; i < count && !isnan(out); i++)
        out = isnan(v[i]) || fabs(v[i]) > out ? fabs(v[i]) : out;
    return out;
}

/* Returns 1 if step k is evaluated: with a history, every step; otherwise, the steps of the first
 * cycle and of the cycles that end at a mark. */
static int matters(const test_element *s, int k)
{
    int is = s->values > 0 || k <= STEPS;
    for (int i = 0; i < MARKS; i++)
        is |= k > (marks[i] - 1) * STEPS && k <= marks[i] * STEPS;
    return is;
}

static status walker_strains(walker *w, const node_state x[], int forces)
{
    const test_element *s = w->s;
    double J[M * N], sigma[M], inner[TEST_ELEMENT_INNER];
    s->type.strain(s->data, x,
                   &(strain_output){.e = w->e,
                                    .J = forces ? J : NULL,
                                    .history = s->values > 0 ? w->history : NULL});
    if (!forces)
        return STATUS_OK;
    test_element_rest(s, inner);
    TRY(test_element_converged(s, w->e, inner, &(stress_output){.sigma = sigma}));
    memset(w->force, 0, sizeof w->force);
    dense_add_transpose_mul(s->coordinates, s->strains, 1, J, sigma, w->force);
    for (int i = 0; i < s->coordinates; i++)
        w->force[i] *= test_element_unit(s, i);
    return STATUS_OK;
}

static status walker_step(walker *w, int k, const node_state x[], int forces)
{
    const test_element *s = w->s;
    if (w->compares == COMPARES_STRAINS)
        TRY(walker_strains(w, x, forces));
    else if (w->compares == COMPARES_FORCES)
        TRY(forces_of(s, x, w->history, w->force));
    else
        TRY(s->made.given->force(adapted_own(s->data), x, &(force_output){.energy = &w->energy}));
    if (k <= STEPS) {
        w->most_e = fmax(w->most_e, largest(s->strains, w->e));
        w->most_force = fmax(w->most_force, largest(s->coordinates, w->force));
        w->most_energy = fmax(w->most_energy, fabs(w->energy));
    }
    if (s->values > 0)
        s->type.commit(s->data, x, w->history);
    return STATUS_OK;
}

static void turn_back(const test_element *s, const double turn[3], double force[N])
{
    double q[4], R[9];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int i = 0; i < s->coordinates; i += i % NODE_COORDINATES == 0 ? 3 : 4) {
        const double v[3] = {force[i], force[i + 1], force[i + 2]};
        mat3_transpose_mul_vec(R, v, force + i);
    }
}

static double difference(const walker *at, const walker *there, const double turn[3])
{
    const test_element *s = at->s;
    double differs[N > M ? N : M];
    if (at->compares == COMPARES_ENERGY)
        return fabs(there->energy - at->energy);
    const int strains = at->compares == COMPARES_STRAINS;
    memcpy(differs, strains ? there->e : there->force,
           (size_t)(strains ? s->strains : s->coordinates) * sizeof *differs);
    if (!strains)
        turn_back(s, turn, differs);
    for (int i = 0; i < (strains ? s->strains : s->coordinates); i++)
        differs[i] -= strains ? at->e[i] : at->force[i];
    return largest(strains ? s->strains : s->coordinates, differs);
}

static void conclude(element_measure *one, const char *holds, const char *fails)
{
    double worst = 0;
    for (int i = 0; i < one->points; i++)
        worst = fmax(worst, isnan(one->error[i]) ? INFINITY : one->error[i]);
    snprintf(one->words, sizeof one->words, "%s", worst <= exact ? holds : fails);
}

static void superposed(const test_element *s, measures *out)
{
    static const double axis[3] = {0.36, 0.48, 0.8};
    static const char *const name[] = {"strains, turns superposed", "forces, turns superposed",
                                       "energy, turns superposed"};
    walker at, there;
    double most = 0;
    walker_begin(s, &at);
    walker_begin(s, &there);
    element_measure *one = measures_add(out, name[at.compares]);
    for (int k = 1, mark = 0; mark < MARKS; k++) {
        double turn[3];
        node_state x[ELEMENT_MAX_NODES], carried[ELEMENT_MAX_NODES];
        if (!matters(s, k))
            continue;
        cycle_state(s, (double)(k % STEPS) / STEPS, x);
        for (int i = 0; i < 3; i++)
            turn[i] = axis[i] * 2 * PI * k / STEPS;
        test_element_rigid_motion(s, turn, x, carried);
        if (walker_step(&at, k, x, 0) != STATUS_OK ||
            walker_step(&there, k, carried, 0) != STATUS_OK) {
            snprintf(one->words, sizeof one->words,
                     "the element cannot evaluate a state of this path");
            return;
        }
        most = fmax(most, difference(&at, &there, turn));
        const double size[] = {at.most_e, at.most_force, at.most_energy};
        if (k == marks[mark] * STEPS)
            measures_point(one, marks[mark++], most / size[at.compares]);
    }
    conclude(one, "objective", "not objective");
}

static void cycles(const test_element *s, measures *out)
{
    walker at;
    element_measure *strains = NULL, *forces;
    walker_begin(s, &at);
    if (at.compares == COMPARES_ENERGY)
        return;
    if (at.compares == COMPARES_STRAINS)
        strains = measures_add(out, "strains after closed cycles");
    forces = measures_add(out, "forces after closed cycles");
    for (int k = 1, mark = 0; mark < MARKS; k++) {
        node_state x[ELEMENT_MAX_NODES];
        if (!matters(s, k))
            continue;
        cycle_state(s, (double)(k % STEPS) / STEPS, x);
        if (walker_step(&at, k, x, k <= STEPS || k == marks[mark] * STEPS) != STATUS_OK) {
            snprintf(forces->words, sizeof forces->words,
                     "the element cannot evaluate a state of this path");
            if (strains != NULL)
                memcpy(strains->words, forces->words, sizeof strains->words);
            return;
        }
        if (k != marks[mark] * STEPS)
            continue;
        if (strains != NULL)
            measures_point(strains, marks[mark], largest(s->strains, at.e) / at.most_e);
        measures_point(forces, marks[mark++], largest(s->coordinates, at.force) / at.most_force);
    }
    if (strains != NULL)
        conclude(strains, "path-independent", "path-dependent");
    conclude(forces, "path-independent", "path-dependent");
}

static void hold_against_declared(const formulation *chosen, const measures *out, check_results *c)
{
    static const struct {
        unsigned limit;
        const char *check_result, *word;
    } of[] = {{LIMIT_NOT_OBJECTIVE, "superposed turns change no strain", "LIMIT_NOT_OBJECTIVE"},
              {LIMIT_PATH_DEPENDENT, "closed cycles leave no strain", "LIMIT_PATH_DEPENDENT"}};
    for (int i = 0; i < 2 && i < out->count; i++) {
        const element_measure *one = &out->measure[i];
        if (one->points == 0)
            continue;
        if (chosen->type->limits & of[i].limit) {
            char why[60];
            snprintf(why, sizeof why, "declares %s", of[i].word);
            checks_not_made(c, of[i].check_result, why);
            continue;
        }
        for (int k = 0; k < one->points; k++)
            checks_deviation(checks_open(c, of[i].check_result, exact), one->error[k],
                             "%s: the error after %g turns or cycles is %.2g of the largest value; "
                             "correct the rotations or 'commit', or declare %s",
                             one->name, one->at[k], one->error[k], of[i].word);
    }
}

void measured_paths(const formulation *chosen, check_results *c, measures *out)
{
    const test_element_request what = {.given = chosen->type,
                                       .options = chosen->option,
                                       .features = test_element_features(chosen->type, 0),
                                       .unit = 1};
    test_element s;
    fault f = {""};
    checks_current(c, "an element along a path");
    if (test_element_make(&what, &s, &f) == STATUS_OK) {
        superposed(&s, out);
        cycles(&s, out);
    }
    if (element_history(chosen->type, chosen->option) > 0)
        hold_against_declared(chosen, out, c);
    test_element_free(&s);
}
