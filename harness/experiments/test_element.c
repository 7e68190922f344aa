#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "harness/formulations/adapted.h"

enum { RELAXATIONS = 30 };

static int fits(const test_element *s)
{
    return s->inner <= TEST_ELEMENT_INNER && s->memory <= TEST_ELEMENT_MEMORY;
}

static void at_rest(const test_element *s, node_state x[])
{
    static const double ahead[3] = {1, 0, 0};
    const double length = s->request.length;
    double turn[3], q[4];
    for (int i = 0; i < 3; i++)
        turn[i] = s->request.curvature[i] * length;
    for (int k = 0; k < s->nodes; k++) {
        memset(&x[k], 0, sizeof x[k]);
        arc_at(turn, ahead, s->place[k], x[k].r, q);
        rotation_matrix(q, x[k].R);
        for (int i = 0; i < 3; i++)
            x[k].r[i] *= length;
    }
}

static status begin(test_element *s, fault *f)
{
    node_state x[ELEMENT_MAX_NODES];
    const int count = adapters_history(s->made.given, s->options);
    if (count == 0)
        return STATUS_OK;
    s->history = calloc((size_t)count, sizeof *s->history);
    if (s->history == NULL)
        return fault_memory(f, "a history");
    s->values = count;
    at_rest(s, x);
    if (s->type.begin != NULL)
        s->type.begin(s->data, x, s->history);
    return STATUS_OK;
}

status test_element_make(const test_element_request *what, test_element *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->made = *what;
    memcpy(out->options, what->options, sizeof out->options);
    TRY(profiles_section(what->form, what->unit, &out->section, f));
    TRY(adapters_complete(what->given, out->options, &out->type, f));
    out->request =
        (element_request){.section = &out->section,
                          .length = (what->length > 0 ? what->length : 0.2385) / what->unit,
                          .features = what->features,
                          .options = out->options,
                          .type = what->given};
    memcpy(out->request.curvature, what->curvature, sizeof out->request.curvature);
    out->nodes = element_nodes(&out->type, out->options);
    element_places(&out->type, out->options, out->place);
    out->strains = element_strains(&out->type, out->options);
    out->inner = element_inner(&out->type, out->options);
    out->memory = element_memory(&out->type, out->options);
    out->scalars = element_scalars(&out->type, out->options);
    out->coordinates = (NODE_COORDINATES + out->scalars) * out->nodes;
    if (!fits(out))
        return fault_set(f, STATUS_FAULT,
                         "the element declares %d internal unknowns and %d doubles of memory, but "
                         "the checks support at most %d and %d; declare fewer",
                         out->inner, out->memory, TEST_ELEMENT_INNER, TEST_ELEMENT_MEMORY);
    out->size = out->type.data_size(&out->request);
    out->data = calloc(1, out->size > 0 ? out->size : 1);
    if (out->data == NULL)
        return fault_set(f, STATUS_FAULT,
                         "data_size: %zu bytes cannot be allocated; return a smaller size",
                         out->size);
    TRY(out->type.prepare(&out->request, out->data, f));
    return begin(out, f);
}

void test_element_free(test_element *s)
{
    free(s->data);
    free(s->history);
    s->data = NULL;
    s->history = NULL;
}

unsigned test_element_features(const element_type *t, unsigned without)
{
    return t->offers & ~(unsigned)(FEATURE_CURVATURE | FEATURE_COUPLED) & ~without;
}

/* Returns the next pseudo-random number in [-1/2, 1/2) of the generator splitmix64 (Steele, Lea,
 * Flood, OOPSLA 2014). */
static double number(unsigned long long *state)
{
    unsigned long long z = (*state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0 - 0.5;
}

void test_element_numbers(int count, unsigned seed, double out[])
{
    unsigned long long state = seed;
    for (int i = 0; i < count; i++)
        out[i] = number(&state);
}

double test_element_unit(const test_element *s, int c)
{
    return chart_unit(c, s->nodes, s->request.length);
}

void test_element_state(const test_element *s, double size, unsigned seed, node_state x[])
{
    double step[TEST_ELEMENT_COORDINATES];
    node_state rest[ELEMENT_MAX_NODES];
    at_rest(s, rest);
    test_element_numbers(s->coordinates, seed, step);
    for (int i = 0; i < s->coordinates; i++)
        step[i] *= size * test_element_unit(s, i);
    chart_move(rest, s->nodes, s->scalars, step, x);
}

void test_element_rigid_motion(const test_element *s, const double turn[3], const node_state x[],
                               node_state out[])
{
    static const double shift[3] = {0.317, -1.21, 2.37}; /* in element lengths */
    double q[4], R[9];
    rotation_exp(turn, q);
    rotation_matrix(q, R);
    for (int k = 0; k < s->nodes; k++) {
        out[k] = x[k];
        mat3_mul_vec(R, x[k].r, out[k].r);
        mat3_mul(R, x[k].R, out[k].R);
        for (int i = 0; i < 3; i++) {
            out[k].r[i] += shift[i] * s->request.length;
            out[k].u[i] = out[k].r[i] - (x[k].r[i] - x[k].u[i]);
        }
    }
}

void test_element_moved(const test_element_stencil *at, int i, double si, int j, double sj,
                        node_state out[])
{
    double step[TEST_ELEMENT_COORDINATES] = {0};
    step[i] += si * test_element_unit(at->s, i);
    step[j] += sj * test_element_unit(at->s, j);
    chart_move(at->x, at->s->nodes, at->s->scalars, step, out);
}

void test_element_rest(const test_element *s, double inner[])
{
    memset(inner, 0, (size_t)s->inner * sizeof *inner);
    if (s->type.rest != NULL)
        s->type.rest(s->data, inner);
}

status test_element_converged(const test_element *s, const double e[], double inner[],
                              stress_output *out)
{
    double memory[TEST_ELEMENT_MEMORY], residual = 1;
    const double none[TEST_ELEMENT_STRAINS] = {0};
    if (out->history == NULL)
        out->history = s->history;
    for (int i = 0; i < RELAXATIONS && s->inner > 0 && s->type.update != NULL; i++) {
        TRY(s->type.stress(s->data, e, inner,
                           &(stress_output){.residual = &residual, .memory = memory}));
        if (s->type.update(s->data, none, memory, inner) < 1e-15)
            break;
    }
    out->memory = s->memory > 0 ? memory : NULL;
    const status outcome = s->type.stress(s->data, e, inner, out);
    out->memory = NULL;
    return outcome;
}

int test_element_lacks_energy(const test_element *s)
{
    return s->made.given->force != NULL && s->values > 0;
}

const char *test_element_coordinate(const test_element *s, int c, char words[TEST_ELEMENT_WORDS])
{
    const int node = c / NODE_COORDINATES + 1, k = c % NODE_COORDINATES,
              more = c - NODE_COORDINATES * s->nodes;
    if (more >= 0)
        snprintf(words, TEST_ELEMENT_WORDS, "additional unknown %d of node %d",
                 more % s->scalars + 1, more / s->scalars + 1);
    else if (k < 3)
        snprintf(words, TEST_ELEMENT_WORDS, "displacement along %c of node %d", "xyz"[k], node);
    else if (k < 6)
        snprintf(words, TEST_ELEMENT_WORDS, "rotation about %c of node %d", "xyz"[k - 3], node);
    else
        snprintf(words, TEST_ELEMENT_WORDS, "warping amplitude of node %d", node);
    return words;
}

/* Describes how the element differs from a straight element with default options and a rectangular
 * section: " [options, section]", or "" if it does not. */
static void describe(const test_element_request *what, const formulation *chosen, test_element *s)
{
    static const char *const section_words[] = {"", "unsymmetric section",
                                                "section given by its matrices"};
    const char *options = strchr(chosen->key, ':');
    const int curved = what->curvature[0] != 0 || what->curvature[2] != 0;
    const char *const part[] = {options != NULL ? options + 1 : "", section_words[what->form],
                                curved ? "initially curved" : ""};
    size_t used = 0;
    s->words[0] = '\0';
    for (int k = 0; k < 3; k++)
        if (part[k][0] != '\0')
            used += (size_t)snprintf(s->words + used, sizeof s->words - used, "%s%.80s",
                                     used > 0 ? ", " : " [", part[k]);
    if (used > 0)
        snprintf(s->words + used, sizeof s->words - used, "]");
}

typedef struct way {
    const formulation *chosen;
    test_element_request made;
    int usual;
} way;

static const char failure[] = "the functions return results";

static int returns_values(const test_element *s, check_results *c)
{
    node_state x[ELEMENT_MAX_NODES];
    double e[TEST_ELEMENT_STRAINS], J[TEST_ELEMENT_STRAINS * TEST_ELEMENT_COORDINATES],
        inner[TEST_ELEMENT_INNER], energy;
    if (s->type.trouble == NULL)
        return 1;
    checks_current(c, "strain, stress%s", s->words);
    test_element_state(s, 0.04, 41, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J, .history = s->history});
    test_element_rest(s, inner);
    test_element_converged(s, e, inner, &(stress_output){.energy = &energy});
    const char *why = s->type.trouble(s->data);
    if (why == NULL)
        return 1;
    c->count = 0;
    checks_require(checks_open(c, failure, 0), 0, "%s%s; the other requirements are not checked",
                   why, s->words);
    return 0;
}

static void one_way(const way *w, check_results *c, test_elements_check *check)
{
    test_element s;
    fault f = {""};
    if (c->count > 0 && strcmp(c->check_result[0].name, failure) == 0)
        return;
    checks_current(c, "prepare");
    const status outcome = test_element_make(&w->made, &s, &f);
    describe(&w->made, w->chosen, &s);
    const int refused = outcome == STATUS_REFUSED && f.text[0] != '\0';
    checks_require(checks_open(c, "prepare", 0), outcome == STATUS_OK || (refused && !w->usual),
                   "prepare: the element%s is rejected (%s: %s); support the element, or reject it "
                   "with a reason and do not declare the feature",
                   s.words[0] != '\0' ? s.words
                                      : " with a rectangular section and all declared features",
                   status_name(outcome), f.text[0] != '\0' ? f.text : "no reason is given");
    if (outcome == STATUS_OK && returns_values(&s, c))
        check(&s, c);
    test_element_free(&s);
}

static void all_forms(const formulation *chosen, check_results *c, test_elements_check *check)
{
    const element_type *t = chosen->type;
    way w = {.chosen = chosen,
             .usual = 1,
             .made = {.given = t,
                      .options = chosen->option,
                      .features = test_element_features(t, 0),
                      .unit = 1}};
    one_way(&w, c, check);
    w.usual = 0;
    if (!(t->limits & LIMIT_DOUBLY_SYMMETRIC) && t->offers & FEATURE_ECCENTRIC) {
        w.made.form = PROFILES_UNSYMMETRIC;
        one_way(&w, c, check);
    }
    if (t->offers & FEATURE_COUPLED) {
        w.made.form = PROFILES_MATRICES;
        w.made.features =
            t->offers & ~(unsigned)(FEATURE_CURVATURE | FEATURE_WARPING | FEATURE_WAGNER_TORQUE);
        one_way(&w, c, check);
    }
    if (t->offers & FEATURE_CURVATURE) {
        w.made.form = PROFILES_RECTANGLE;
        w.made.features =
            (test_element_features(t, 0) | FEATURE_CURVATURE) & ~(unsigned)FEATURE_WAGNER_TORQUE;
        w.made.curvature[0] = 0.2;
        w.made.curvature[1] = 0.3;
        w.made.curvature[2] = 0.9;
        one_way(&w, c, check);
    }
}

static void other_choices(const formulation *chosen, int option, check_results *c,
                          test_elements_check *check)
{
    const assignment_list list = formulation_options(chosen->type);
    const parameter_type *o = parameter_at(chosen->type->options, option);
    for (int k = 0; k < parameter_choices(o); k++) {
        formulation other = *chosen;
        char value[ASSIGNMENT_VALUE];
        if (k == (int)chosen->option[option])
            continue;
        other.option[option] = k;
        assignment_value_text(o, k, value, sizeof value);
        snprintf(other.key, sizeof other.key, "%s:", chosen->type->name);
        assignment_text(&list, other.option, other.key + strlen(other.key),
                        (int)(sizeof other.key - strlen(other.key)));
        all_forms(&other, c, check);
    }
}

void test_elements_each(const formulation *chosen, check_results *c, test_elements_check *check)
{
    all_forms(chosen, c, check);
    for (int i = 0; i < parameter_count(chosen->type->options); i++)
        other_choices(chosen, i, c, check);
}

enum { N = TEST_ELEMENT_COORDINATES };

static const char *const F_name = "F is the gradient of the energy",
                         *const K_name = "K is the derivative of F",
                         *const check_same = "a rigid motion does not change the energy",
                         *const check_undeformed = "the undeformed element has no forces";

static status call(const test_element *s, const node_state x[], force_output *out)
{
    out->history = s->history;
    if (test_element_lacks_energy(s))
        out->energy = NULL;
    return s->made.given->force(adapted_own(s->data), x, out);
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    return (int)call(at->s, x, &(force_output){.energy = values});
}

static int force_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const test_element_stencil *at = context;
    node_state x[ELEMENT_MAX_NODES];
    test_element_moved(at, i, si, j, sj, x);
    return (int)call(at->s, x, &(force_output){.F = values});
}

/* Multiplies the forces by the units of their coordinates [J]. Returns the largest magnitude. */
static double works(const test_element *s, const double F[], double out[])
{
    double largest = 0;
    for (int i = 0; i < s->coordinates; i++) {
        out[i] = F[i] * test_element_unit(s, i);
        largest = fmax(largest, fabs(out[i]));
    }
    return largest;
}

static void check_force(const test_element_stencil *at, const double F[], check_result *one)
{
    const test_element *s = at->s;
    char where[TEST_ELEMENT_WORDS];
    double work[N];
    const double size = works(s, F, work);
    for (int i = 0; i < s->coordinates; i++) {
        double found = NAN;
        const double unit = test_element_unit(s, i);
        stencil_first(energy_at, at, 1, i, &found);
        checks_deviation(one, checks_relative(fabs(work[i] - found), size),
                         "force: F in coordinate %d (%s) is %.6g, but the derivative of the energy "
                         "is %.6g; correct F or the energy%s",
                         i + 1, test_element_coordinate(s, i, where), F[i], found / unit, s->words);
    }
}

/* Checks the symmetric part of K, which corresponds to the exponential chart. With a history, all
 * of K is checked; K then consists of derivatives with respect to spatial increments. */
static void check_stiffness(const test_element_stencil *at, const double K[], check_result *one)
{
    const test_element *s = at->s;
    const int n = s->coordinates;
    char first[TEST_ELEMENT_WORDS], other[TEST_ELEMENT_WORDS];
    double column[N][N], size = 0;
    for (int j = 0; j < n; j++) {
        const double unit = test_element_unit(s, j);
        stencil_first(force_at, at, n, j, column[j]);
        size = fmax(size, fabs(K[j * n + j]) * unit * unit);
    }
    const double opposite = test_element_lacks_energy(s) ? 0 : 0.5;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < (opposite > 0 ? i + 1 : n); j++) {
            const double ui = test_element_unit(s, i), uj = test_element_unit(s, j);
            const double given =
                ((1 - opposite) * K[i * n + j] + opposite * K[j * n + i]) * ui * uj;
            const double found = (1 - opposite) * column[j][i] * ui + opposite * column[i][j] * uj;
            checks_deviation(
                one, checks_relative(fabs(given - found), size),
                "K: the derivative of the force in coordinate %d (%s) with respect to coordinate "
                "%d (%s) is %.6g, but finite differences of F give %.6g; correct K or F%s",
                i + 1, test_element_coordinate(s, i, first), j + 1,
                test_element_coordinate(s, j, other), given / (ui * uj), found / (ui * uj),
                s->words);
        }
}

static void check_carried(const test_element *s, const node_state x[], double energy,
                          check_result *one)
{
    static const double turn[][3] = {{0.71, -1.93, 1.37}, {0, 0, 1.9}, {2.1, 0, 0}, {0, -2.9, 0}};
    for (size_t k = 0; k < sizeof turn / sizeof turn[0]; k++) {
        node_state carried[ELEMENT_MAX_NODES];
        double other = NAN;
        test_element_rigid_motion(s, turn[k], x, carried);
        call(s, carried, &(force_output){.energy = &other});
        checks_deviation(
            one, checks_relative(fabs(other - energy), fabs(energy)),
            "force: a rigid rotation by (%g, %g, %g) rad changes the energy from %.6g J "
            "to %.6g J; measure strains in axes that rotate with the element%s",
            turn[k][0], turn[k][1], turn[k][2], energy, other, s->words);
    }
}

static void check_rest(const test_element *s, double scale, check_result *one)
{
    double F[N] = {0}, work[N] = {0}, energy = NAN;
    char where[TEST_ELEMENT_WORDS];
    node_state x[ELEMENT_MAX_NODES];
    const unsigned leaves = s->made.given->leaves;
    test_element_state(s, 0, 1, x);
    call(s, x, &(force_output){.energy = &energy, .F = leaves & LEAVES_FORCE ? NULL : F});
    if (test_element_lacks_energy(s))
        energy = 0;
    checks_deviation(one, fabs(energy) / scale,
                     "force: the undeformed element has an energy of %.3g J; define the energy as "
                     "zero in that state%s",
                     energy, s->words);
    if (leaves & LEAVES_FORCE)
        return;
    works(s, F, work);
    for (int i = 0; i < s->coordinates; i++)
        checks_deviation(one, fabs(work[i]) / scale,
                         "force: F in coordinate %d (%s) of the undeformed element is %.3g; define "
                         "it as zero in that state%s",
                         i + 1, test_element_coordinate(s, i, where), F[i], s->words);
}

static void check(const test_element *s, check_results *c)
{
    const unsigned leaves = s->made.given->leaves;
    double energy = NAN, F[N], work[N], K[N * N];
    node_state x[ELEMENT_MAX_NODES];
    const test_element_stencil at = {s, x};
    test_element_state(s, 0.05, 11, x);
    checks_current(c, "force%s", s->words);
    const status outcome =
        call(s, x,
             &(force_output){
                 .energy = &energy, .F = leaves & LEAVES_FORCE ? NULL : F, .K = leaves ? NULL : K});
    checks_require(checks_open(c, "moderate strains have forces", 0), outcome == STATUS_OK,
                   "force: displacements of a few hundredths of the length give the status '%s'; "
                   "compute their forces%s",
                   status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    if (!test_element_lacks_energy(s))
        check_carried(s, x, energy, checks_open(c, check_same, 1e-9));
    else
        energy = works(s, F, work);
    check_rest(s, fabs(energy), checks_open(c, check_undeformed, 1e-10));
    if (!(leaves & LEAVES_FORCE) && !test_element_lacks_energy(s))
        check_force(&at, F, checks_open(c, F_name, 1e-8));
    if (leaves == 0)
        check_stiffness(&at, K, checks_open(c, K_name, 1e-8));
}

void checks_force(const formulation *chosen, check_results *out)
{
    if (chosen->type->force == NULL) {
        checks_not_made(out, F_name, "the element is defined by its strains and stresses");
        return;
    }
    if (element_history(chosen->type, chosen->option) > 0) {
        checks_not_made(out, F_name, "with a history, forces need not derive from an energy");
        checks_not_made(out, check_same, "with a history, see 'paths'");
    }
    if (chosen->type->leaves & LEAVES_FORCE)
        checks_not_made(out, F_name, "computed by differences");
    if (chosen->type->leaves)
        checks_not_made(out, K_name, "computed by differences");
    test_elements_each(chosen, out, check);
}
