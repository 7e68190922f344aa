#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/formulations/adapted.h"

enum { GUARD = 64, M = TEST_ELEMENT_STRAINS, N = TEST_ELEMENT_COORDINATES };

/* a signalling NaN that no computation produces */
static const uint64_t mark = 0x7ff4beadfacade01ULL;

typedef struct guarded {
    const char *name;
    int size;
    double *words;
} guarded;

static double *guard(guarded *g, const char *name, int size)
{
    *g = (guarded){name, size, malloc((size_t)(size + 2 * GUARD) * sizeof(double))};
    if (g->words == NULL)
        abort();
    for (int i = 0; i < size + 2 * GUARD; i++)
        memcpy(&g->words[i], &mark, sizeof mark);
    return g->words + GUARD;
}

static int untouched(const double *word)
{
    uint64_t bits;
    memcpy(&bits, word, sizeof bits);
    return bits == mark;
}

static void look(guarded *g, int must, const test_element *s, check_results *c)
{
    check_result *beside = checks_open(c, "no memory outside an output changes", 0),
                 *filled = checks_open(c, "outputs are filled completely", 0);
    for (int i = 0; i < GUARD; i++) {
        const int outside[] = {-i - 1, g->size + i};
        for (int k = 0; k < 2; k++)
            checks_require(beside, untouched(&g->words[GUARD + outside[k]]),
                           "%s: entry %d is written, but the output has %d entries, numbered from "
                           "1; write only these%s",
                           g->name, outside[k] + 1, g->size, s->words);
    }
    for (int i = 0; i < g->size && must; i++)
        checks_require(filled, !untouched(&g->words[GUARD + i]),
                       "%s: entry %d of %d is never written; fill the whole output%s", g->name,
                       i + 1, g->size, s->words);
    free(g->words);
    g->words = NULL;
}

static void strains(const test_element *s, const node_state x[], check_results *c)
{
    guarded e, J, H;
    double weight[M];
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(i);
    strain_output out = {.e = guard(&e, "strain: e", s->strains),
                         .J = guard(&J, "strain: J", s->strains * s->coordinates),
                         .s = weight,
                         .H = guard(&H, "strain: H", s->coordinates * s->coordinates),
                         .history = s->history};
    checks_current(c, "strain%s", s->words);
    s->type.strain(s->data, x, &out);
    look(&e, 1, s, c);
    look(&J, 1, s, c);
    look(&H, 1, s, c);
}

static void stresses(const test_element *s, const double e[], check_results *c)
{
    const int m = s->strains;
    guarded energy, sigma, C, residual, memory, inner, G;
    double *own = guard(&inner, "rest: the internal unknowns", s->inner);
    checks_current(c, "rest and stress%s", s->words);
    test_element_rest(s, own);
    stress_output out = {.energy = guard(&energy, "stress: energy", 1),
                         .sigma = guard(&sigma, "stress: sigma", m),
                         .C = guard(&C, "stress: C", m * m),
                         .residual = guard(&residual, "stress: residual", 1),
                         .memory = guard(&memory, "stress: memory", s->memory),
                         .history = s->history};
    if (s->memory == 0)
        out.memory = NULL;
    const int filled = s->type.stress(s->data, e, own, &out) == STATUS_OK;
    if (s->inner > 0 && s->type.update != NULL && filled) {
        const double none[M] = {0};
        checks_current(c, "update%s", s->words);
        s->type.update(s->data, none, out.memory, own);
    }
    look(&energy, filled, s, c);
    look(&sigma, filled, s, c);
    look(&C, filled, s, c);
    look(&residual, filled, s, c);
    look(&memory, 0, s, c);
    look(&inner, 1, s, c);
    if (s->type.geometric == NULL)
        return;
    double *stiffness = guard(&G, "geometric: G", m * m);
    checks_current(c, "geometric%s", s->words);
    s->type.geometric(s->data, e, stiffness);
    look(&G, 1, s, c);
}

static void dampings(const test_element *s, check_results *c)
{
    guarded V;
    if (s->type.damping == NULL)
        return;
    double *matrix = guard(&V, "damping: V", s->strains * s->strains);
    checks_current(c, "damping%s", s->words);
    s->type.damping(s->data, matrix);
    look(&V, 1, s, c);
}

static void sections(const test_element *s, const node_state x[], check_results *c)
{
    const int n = s->coordinates;
    guarded P, T, H;
    if (s->type.line == NULL)
        return;
    line_output out = {.at = 0.3,
                       .force = {1, 2, 3},
                       .moment = {4, 5, 6},
                       .P = guard(&P, "line: P", 3 * n),
                       .T = guard(&T, "line: T", 3 * n),
                       .H = guard(&H, "line: H", n * n)};
    checks_current(c, "line%s", s->words);
    s->type.line(s->data, x, 1, &out);
    look(&P, 1, s, c);
    look(&T, 1, s, c);
    look(&H, 1, s, c);
}

static void masses(const test_element *s, const node_state x[], check_results *c)
{
    static const element_rotating_frame turning = {.omega = {31.3, -17.9, 23.7}};
    const int n = s->coordinates;
    guarded mass, potential, force, stiffness, gyroscopic;
    if (s->type.inertia == NULL)
        return;
    inertia_output out = {.M = guard(&mass, "inertia: M", n * n),
                          .potential = guard(&potential, "inertia: potential", 1),
                          .force = guard(&force, "inertia: force", n),
                          .N = guard(&stiffness, "inertia: N", n * n),
                          .G = guard(&gyroscopic, "inertia: G", n * n)};
    checks_current(c, "inertia%s", s->words);
    const int filled = s->type.inertia(s->data, x, &turning, &out) == STATUS_OK;
    look(&mass, filled, s, c);
    look(&potential, filled, s, c);
    look(&force, filled, s, c);
    look(&stiffness, filled, s, c);
    look(&gyroscopic, filled, s, c);
}

static void in_time(const test_element *s, const node_state x[], check_results *c)
{
    const int n = s->coordinates;
    guarded taken, rates, places;
    double rate[N], acceleration[N];
    if (s->type.inertia == NULL || !s->type.spreads || s->coordinates > 2 * NODE_COORDINATES)
        return;
    for (int i = 0; i < n; i++)
        rate[i] = acceleration[i] = sin(i);
    inertia_output out = {.rate = rate,
                          .acceleration = acceleration,
                          .taken = guard(&taken, "inertia: taken", n),
                          .C = guard(&rates, "inertia: C", n * n),
                          .K = guard(&places, "inertia: K", n * n)};
    checks_current(c, "inertia in time%s", s->words);
    const int filled = s->type.inertia(s->data, x, NULL, &out) == STATUS_OK;
    look(&taken, filled, s, c);
    look(&rates, filled, s, c);
    look(&places, filled, s, c);
}

static void forces(const test_element *s, const node_state x[], check_results *c)
{
    const int n = s->coordinates;
    const unsigned leaves = s->made.given->leaves;
    guarded energy, force, stiffness;
    if (s->made.given->force == NULL)
        return;
    force_output out = {.energy = guard(&energy, "force: energy", 1),
                        .F = guard(&force, "force: F", n),
                        .K = guard(&stiffness, "force: K", n * n)};
    out.history = s->history;
    if (test_element_lacks_energy(s))
        out.energy = NULL;
    if (leaves & LEAVES_FORCE)
        out.F = NULL;
    if (leaves)
        out.K = NULL;
    checks_current(c, "force%s", s->words);
    const int filled = s->made.given->force(adapted_own(s->data), x, &out) == STATUS_OK;
    look(&energy, filled && out.energy != NULL, s, c);
    look(&force, filled && out.F != NULL, s, c);
    look(&stiffness, filled && out.K != NULL, s, c);
}

static void data(const test_element *s, check_results *c)
{
    guarded bytes;
    const size_t own = s->made.given->data_size != NULL ? s->made.given->data_size(&s->request) : 0;
    double *place = guard(&bytes, "prepare: its data", (int)((own + 7) / 8));
    element_request request = s->request;
    checks_current(c, "prepare%s", s->words);
    memset(place, 0, own);
    s->made.given->prepare(&request, (element_data *)place, NULL);
    look(&bytes, 0, s, c);
}

static void check(const test_element *s, check_results *c)
{
    double room[GUARD + M + GUARD], kept[M], *e = room + GUARD;
    node_state x[ELEMENT_MAX_NODES], given[ELEMENT_MAX_NODES];
    check_result *inputs = checks_open(c, "inputs are not changed", 0);
    test_element_state(s, 0.02, 53, x);
    memcpy(given, x, sizeof given);
    strains(s, x, c);
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    memcpy(kept, e, (size_t)s->strains * sizeof *e);
    stresses(s, e, c);
    dampings(s, c);
    sections(s, x, c);
    masses(s, x, c);
    in_time(s, x, c);
    forces(s, x, c);
    data(s, c);
    checks_require(inputs, memcmp(given, x, (size_t)s->nodes * sizeof *x) == 0,
                   "strain, inertia: the element changes the states of the nodes, which are "
                   "inputs; write only to outputs%s",
                   s->words);
    checks_require(
        inputs, memcmp(kept, e, (size_t)s->strains * sizeof *e) == 0,
        "stress: the element changes the strains, which are inputs; write only to outputs%s",
        s->words);
}

void checks_bounds(const formulation *chosen, check_results *out)
{
    test_elements_each(chosen, out, check);
}

enum { STATELESS_M = TEST_ELEMENT_STRAINS, STATELESS_N = TEST_ELEMENT_COORDINATES };

static const double longer = 1.7 * 0.2385;

typedef struct call_account {
    status stress, inertia;
    double e[STATELESS_M], J[STATELESS_M * STATELESS_N], H[STATELESS_N * STATELESS_N], energy,
        sigma[STATELESS_M], C[STATELESS_M * STATELESS_M], residual, mass[STATELESS_N * STATELESS_N];
    double inner[TEST_ELEMENT_INNER];
} call_account;

static void record_calls(const test_element *s, const node_state x[], call_account *out)
{
    double weight[STATELESS_M];
    memset(out, 0, sizeof *out);
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(3.7 * i + 0.3);
    s->type.strain(s->data, x, &(strain_output){out->e, out->J, weight, out->H, s->history});
    test_element_rest(s, out->inner);
    out->stress = test_element_converged(
        s, out->e, out->inner,
        &(stress_output){
            .energy = &out->energy, .sigma = out->sigma, .C = out->C, .residual = &out->residual});
    if (s->type.inertia != NULL)
        out->inertia = s->type.inertia(s->data, x, NULL, &(inertia_output){.M = out->mass});
}

static int same_bits(size_t count, const double a[], const double b[])
{
    for (size_t i = 0; i < count; i++) {
        uint64_t one, other;
        memcpy(&one, &a[i], sizeof one);
        memcpy(&other, &b[i], sizeof other);
        if (one != other)
            return 0;
    }
    return 1;
}

/* Returns the name of the first result that differs in any bit; NULL: all results are equal. */
static const char *apart(const call_account *a, const call_account *b)
{
    const struct {
        const char *name;
        size_t count;
        const double *one, *other;
    } all[] = {{"strain: e", STATELESS_M, a->e, b->e},
               {"strain: J", sizeof a->J / sizeof(double), a->J, b->J},
               {"strain: H", sizeof a->H / sizeof(double), a->H, b->H},
               {"stress: the energy", 1, &a->energy, &b->energy},
               {"stress: sigma", STATELESS_M, a->sigma, b->sigma},
               {"stress: C", sizeof a->C / sizeof(double), a->C, b->C},
               {"inertia: M", sizeof a->mass / sizeof(double), a->mass, b->mass}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (!same_bits(all[i].count, all[i].one, all[i].other))
            return all[i].name;
    return a->stress != b->stress ? "stress: the status" : NULL;
}

static void same(const call_account *a, const call_account *b, const char *after,
                 const test_element *s, check_result *one)
{
    const char *other = apart(a, b);
    checks_require(
        one, other == NULL,
        "%s differs %s; do not store anything between calls in static variables or in 'data'%s",
        other, after, s->words);
}

/* Checks that calls of a second, longer element do not change the results of the first element, and
 * that the second element gives the same results as in a new process. */
static void other_element(const test_element *s, const call_account *before, const node_state x[],
                          const call_account *first, check_result *one)
{
    test_element_request what = s->made;
    test_element other;
    call_account between, after;
    fault f = {""};
    what.length = longer;
    if (test_element_make(&what, &other, &f) == STATUS_OK) {
        record_calls(&other, x, &between);
        same(first, &between, "after calls of another element, compared with a new process", s,
             one);
        record_calls(s, x, &after);
        same(before, &after, "after calls of another element", s, one);
    }
    test_element_free(&other);
}

/* Prepares a longer element in the memory of the element, then prepares the element again, and
 * checks that its results are unchanged. Returns 0 if this is not possible. */
static int in_its_place(const test_element *s, const call_account *before, const node_state x[],
                        check_result *one)
{
    element_request request = s->request;
    call_account after;
    fault f = {""};
    char *kept = malloc(s->size);
    if (kept == NULL)
        return 0;
    memcpy(kept, s->data, s->size);
    request.length = longer;
    memset(s->data, 0, s->size);
    if (s->type.data_size(&request) == s->size &&
        s->type.prepare(&request, s->data, NULL) == STATUS_OK)
        record_calls(s, x, &after);
    memset(s->data, 0, s->size);
    const int again = s->type.prepare(&s->request, s->data, &f) == STATUS_OK;
    if (!again) {
        memcpy(s->data, kept, s->size);
        checks_require(one, 0,
                       "prepare: an accepted element is rejected when it is prepared again (%s); "
                       "do not depend on earlier calls%s",
                       f.text, s->words);
    } else {
        record_calls(s, x, &after);
        same(before, &after, "if another element was in its memory before", s, one);
    }
    free(kept);
    return again;
}

static void alone(const test_element *s, const call_account *before, const node_state x[],
                  check_result *one)
{
    call_account a = *before;
    double weight[STATELESS_M], inner[TEST_ELEMENT_INNER];
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(3.7 * i + 0.3);
    s->type.strain(s->data, x, &(strain_output){.s = weight, .H = a.H, .history = s->history});
    s->type.strain(s->data, x, &(strain_output){.J = a.J, .history = s->history});
    s->type.strain(s->data, x, &(strain_output){.e = a.e, .history = s->history});
    memcpy(inner, before->inner, sizeof inner);
    s->type.stress(s->data, a.e, inner, &(stress_output){.C = a.C, .history = s->history});
    s->type.stress(s->data, a.e, inner, &(stress_output){.sigma = a.sigma, .history = s->history});
    s->type.stress(s->data, a.e, inner,
                   &(stress_output){.energy = &a.energy, .history = s->history});
    if (s->inner > 0) {
        memcpy(a.sigma, before->sigma, sizeof a.sigma);
        memcpy(a.C, before->C, sizeof a.C);
        a.energy = before->energy;
    }
    const char *other = apart(before, &a);
    checks_require(one, other == NULL,
                   "%s differs if it is requested alone; compute it independently of the other "
                   "outputs%s",
                   other, s->words);
}

/* Checks that the energy of an element with inner unknowns does not depend on the path: the same
 * state is reached from the undeformed state and from another state. */
static void two_ways(const test_element *s, const call_account *before, const node_state x[],
                     check_result *one)
{
    double e[STATELESS_M], inner[TEST_ELEMENT_INNER], energy = NAN;
    node_state y[ELEMENT_MAX_NODES];
    test_element_state(s, 0.04, 77, y);
    s->type.strain(s->data, y, &(strain_output){.e = e, .history = s->history});
    test_element_rest(s, inner);
    if (test_element_converged(s, e, inner, &(stress_output){.energy = &energy}) != STATUS_OK)
        return;
    s->type.strain(s->data, x, &(strain_output){.e = e, .history = s->history});
    test_element_converged(s, e, inner, &(stress_output){.energy = &energy});
    checks_deviation(
        one, fabs(energy / before->energy - 1),
        "stress, update: the same strains give an energy of %.9g J, but %.9g J when evaluated "
        "after other strains; let 'update' find the same internal unknowns%s",
        before->energy, energy, s->words);
}

static void make_longer(const test_element *s, const node_state x[], call_account *out)
{
    test_element_request what = s->made;
    test_element other;
    fault f = {""};
    what.length = longer;
    if (test_element_make(&what, &other, &f) == STATUS_OK)
        record_calls(&other, x, out);
    test_element_free(&other);
}

static void record_first_calls(const test_element *s, const node_state x[], call_account *out)
{
    const pid_t parent = getpid();
    call_account *there =
        mmap(NULL, sizeof *there, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (there == MAP_FAILED)
        return;
    fflush(NULL);
    const pid_t child_process = fork();
    if (child_process == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() == parent)
            make_longer(s, x, there);
        _exit(0);
    }
    if (child_process > 0)
        waitpid(child_process, NULL, 0);
    *out = *there;
    munmap(there, sizeof *there);
}

static void stateless_check(const test_element *s, check_results *c)
{
    call_account first = {0}, before, between, after;
    node_state x[ELEMENT_MAX_NODES], y[ELEMENT_MAX_NODES];
    check_result *one = checks_open(c, "the same call gives bit-for-bit equal results", 0);
    test_element_state(s, 0.04, 41, x);
    test_element_state(s, 0.06, 43, y);
    record_first_calls(s, x, &first);
    checks_current(c, "the same state again%s", s->words);
    record_calls(s, x, &before);
    record_calls(s, x, &after);
    same(&before, &after, "in a second, equal call", s, one);
    record_calls(s, y, &between);
    record_calls(s, x, &after);
    same(&before, &after, "after calls for another state", s, one);
    checks_current(c, "another element between%s", s->words);
    other_element(s, &before, x, &first, one);
    if (!in_its_place(s, &before, x, one))
        return;
    checks_current(c, "outputs one by one%s", s->words);
    alone(s, &before, x, checks_open(c, "outputs do not depend on each other", 0));
    if (s->inner > 0)
        two_ways(s, &before, x, checks_open(c, "the result does not depend on the path", 1e-9));
}

void checks_stateless(const formulation *chosen, check_results *out)
{
    test_elements_each(chosen, out, stateless_check);
    if (element_inner(chosen->type, chosen->option) == 0)
        checks_not_made(out, "the result does not depend on the path",
                        "the element has no internal unknowns");
}
