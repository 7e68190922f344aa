/* Elements keep no state: what a call gives depends on its arguments alone. */
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"

enum { STATELESS_M = SPECIMEN_STRAINS, STATELESS_N = SPECIMEN_COORDINATES };

static const double longer = 1.7 * 0.2385; /* [m] */

/* Everything that an element says of one state. */
typedef struct call_account {
    status stress, inertia;
    double e[STATELESS_M], J[STATELESS_M * STATELESS_N], H[STATELESS_N * STATELESS_N], energy,
        sigma[STATELESS_M], C[STATELESS_M * STATELESS_M], residual, mass[STATELESS_N * STATELESS_N];
    double inner[SPECIMEN_INNER];
} call_account;

static void tell(const specimen *s, const node_state x[], call_account *out)
{
    double weight[STATELESS_M];
    memset(out, 0, sizeof *out);
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(3.7 * i + 0.3);
    s->type.strain(s->data, x, &(strain_output){out->e, out->J, weight, out->H});
    specimen_rest(s, out->inner);
    out->stress = specimen_settled(
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

/* The name of the first that is not the same bits, or NULL. */
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

static void same(const call_account *a, const call_account *b, const char *after, const specimen *s,
                 claim *one)
{
    const char *other = apart(a, b);
    claims_asks(one, other == NULL,
                "%s is another one after %s; keep nothing between calls, neither in static "
                "variables nor in the data%s",
                other, after, s->words);
}

/* Of another length, in memory of its own or in the place of the first, which is made again. Both
 * say what they say where nothing went before. */
static void other_element(const specimen *s, const call_account *before, const node_state x[],
                          const call_account *first, claim *one)
{
    specimen_request what = s->made;
    specimen other;
    call_account between, after;
    fault f = {""};
    what.length = longer;
    if (specimen_make(&what, &other, &f) == STATUS_OK) {
        tell(&other, x, &between);
        same(first, &between, "calls of another element, and not in a process of its own", s, one);
        tell(s, x, &after);
        same(before, &after, "calls of another element", s, one);
    }
    specimen_free(&other);
}

/* 0: it cannot be made again, and that is told. */
static int in_its_place(const specimen *s, const call_account *before, const node_state x[],
                        claim *one)
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
        tell(s, x, &after);
    memset(s->data, 0, s->size);
    const int again = s->type.prepare(&s->request, s->data, &f) == STATUS_OK;
    if (!again) {
        memcpy(s->data, kept, s->size);
        claims_asks(one, 0, "prepare: the same element is refused when it is made again: %s%s",
                    f.text, s->words);
    } else {
        tell(s, x, &after);
        same(before, &after, "another element stood in its memory", s, one);
    }
    free(kept);
    return again;
}

/* Each output alone is what it is together with the others. */
static void alone(const specimen *s, const call_account *before, const node_state x[], claim *one)
{
    call_account a = *before;
    double weight[STATELESS_M], inner[SPECIMEN_INNER];
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(3.7 * i + 0.3);
    s->type.strain(s->data, x, &(strain_output){.s = weight, .H = a.H});
    s->type.strain(s->data, x, &(strain_output){.J = a.J});
    s->type.strain(s->data, x, &(strain_output){.e = a.e});
    memcpy(inner, before->inner, sizeof inner);
    s->type.stress(s->data, a.e, inner, &(stress_output){.C = a.C});
    s->type.stress(s->data, a.e, inner, &(stress_output){.sigma = a.sigma});
    s->type.stress(s->data, a.e, inner, &(stress_output){.energy = &a.energy});
    if (s->inner > 0) { /* its last correction is not repeated */
        memcpy(a.sigma, before->sigma, sizeof a.sigma);
        memcpy(a.C, before->C, sizeof a.C);
        a.energy = before->energy;
    }
    same(before, &a, "asking for that output alone", s, one);
}

/* The same state by two ways, with inner unknowns: straight from rest, and over another state. */
static void two_ways(const specimen *s, const call_account *before, const node_state x[],
                     claim *one)
{
    double e[STATELESS_M], inner[SPECIMEN_INNER], energy = NAN;
    node_state y[ELEMENT_MAX_NODES];
    specimen_state(s, 0.04, 77, y);
    s->type.strain(s->data, y, &(strain_output){.e = e});
    specimen_rest(s, inner);
    if (specimen_settled(s, e, inner, &(stress_output){.energy = &energy}) != STATUS_OK)
        return;
    s->type.strain(s->data, x, &(strain_output){.e = e});
    specimen_settled(s, e, inner, &(stress_output){.energy = &energy});
    claims_departs(one, fabs(energy / before->energy - 1),
                   "stress, update: the energy of the same strains is %.9g J, and %.9g J after "
                   "other strains; the path must not matter%s",
                   before->energy, energy, s->words);
}

static void make_longer(const specimen *s, const node_state x[], call_account *out)
{
    specimen_request what = s->made;
    specimen other;
    fault f = {""};
    what.length = longer;
    if (specimen_make(&what, &other, &f) == STATUS_OK)
        tell(&other, x, out);
    specimen_free(&other);
}

/* What the first call of all says of the longer element: in a process of its own, where it is made
 * and nothing went before. */
static void tell_first(const specimen *s, const node_state x[], call_account *out)
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

static void stateless_check(const specimen *s, claims *c)
{
    call_account first = {0}, before, between, after;
    node_state x[ELEMENT_MAX_NODES], y[ELEMENT_MAX_NODES];
    claim *one = claims_open(c, "the same call gives the same bits", 0);
    specimen_state(s, 0.04, 41, x);
    specimen_state(s, 0.06, 43, y);
    tell_first(s, x, &first);
    claims_doing(c, "the same state again%s", s->words);
    tell(s, x, &before);
    tell(s, x, &after);
    same(&before, &after, "the same call", s, one);
    tell(s, y, &between);
    tell(s, x, &after);
    same(&before, &after, "calls of another state", s, one);
    claims_doing(c, "another element between%s", s->words);
    other_element(s, &before, x, &first, one);
    if (!in_its_place(s, &before, x, one))
        return;
    claims_doing(c, "outputs one by one%s", s->words);
    alone(s, &before, x, claims_open(c, "outputs do not depend on each other", 0));
    if (s->inner > 0)
        two_ways(s, &before, x, claims_open(c, "the path does not matter", 1e-9));
}

void checks_stateless(const formulation *chosen, claims *out)
{
    specimens_each(chosen, out, stateless_check);
    if (element_inner(chosen->type, chosen->option) == 0)
        claims_not_made(out, "the path does not matter", "no unknowns of its own");
}
