/* Guard words around every output: each is filled whole, and nothing beside it is touched. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"
#include "harness/formulations/adapted.h"

enum { GUARD = 64, M = SPECIMEN_STRAINS, N = SPECIMEN_COORDINATES };

/* A number that is none, and that nobody computes. */
static const uint64_t mark = 0x7ff4beadfacade01ULL;

/* An output of `size` entries between guards. */
typedef struct guarded {
    const char *name;
    int size;
    double *words; /* [GUARD + size + GUARD] */
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

/* Looks at it and frees it. must: 1: it is filled whole. */
static void look(guarded *g, int must, const specimen *s, claims *c)
{
    claim *beside = claims_open(c, "nothing beside an output is touched", 0),
          *filled = claims_open(c, "outputs are filled whole", 0);
    for (int i = 0; i < GUARD; i++) {
        claims_asks(beside, untouched(&g->words[GUARD - 1 - i]),
                    "%s: entry %d is written, before its first%s", g->name, -i - 1 + 1, s->words);
        claims_asks(beside, untouched(&g->words[GUARD + g->size + i]),
                    "%s: it has %d entries, and entry %d is written%s", g->name, g->size,
                    g->size + i + 1, s->words);
    }
    for (int i = 0; i < g->size && must; i++)
        claims_asks(filled, !untouched(&g->words[GUARD + i]),
                    "%s: entry %d of %d is never written%s", g->name, i + 1, g->size, s->words);
    free(g->words);
    g->words = NULL;
}

static void strains(const specimen *s, const node_state x[], claims *c)
{
    guarded e, J, H;
    double weight[M];
    for (int i = 0; i < s->strains; i++)
        weight[i] = cos(i);
    strain_output out = {.e = guard(&e, "strain: e", s->strains),
                         .J = guard(&J, "strain: J", s->strains * s->coordinates),
                         .s = weight,
                         .H = guard(&H, "strain: H", s->coordinates * s->coordinates)};
    claims_doing(c, "strain%s", s->words);
    s->type.strain(s->data, x, &out);
    look(&e, 1, s, c);
    look(&J, 1, s, c);
    look(&H, 1, s, c);
}

static void stresses(const specimen *s, const double e[], claims *c)
{
    const int m = s->strains;
    guarded energy, sigma, C, residual, memory, inner, G;
    double *own = guard(&inner, "rest: the unknowns of its own", s->inner);
    claims_doing(c, "rest and stress%s", s->words);
    specimen_rest(s, own);
    stress_output out = {.energy = guard(&energy, "stress: energy", 1),
                         .sigma = guard(&sigma, "stress: sigma", m),
                         .C = guard(&C, "stress: C", m * m),
                         .residual = guard(&residual, "stress: residual", 1),
                         .memory = guard(&memory, "stress: memory", s->memory)};
    if (s->memory == 0)
        out.memory = NULL;
    const int filled = s->type.stress(s->data, e, own, &out) == STATUS_OK;
    if (s->inner > 0 && s->type.update != NULL && filled) {
        const double none[M] = {0};
        claims_doing(c, "update%s", s->words);
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
    claims_doing(c, "geometric%s", s->words);
    s->type.geometric(s->data, e, stiffness);
    look(&G, 1, s, c);
}

static void masses(const specimen *s, const node_state x[], claims *c)
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
    claims_doing(c, "inertia%s", s->words);
    const int filled = s->type.inertia(s->data, x, &turning, &out) == STATUS_OK;
    look(&mass, filled, s, c);
    look(&potential, filled, s, c);
    look(&force, filled, s, c);
    look(&stiffness, filled, s, c);
    look(&gyroscopic, filled, s, c);
}

static void in_time(const specimen *s, const node_state x[], claims *c)
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
    claims_doing(c, "inertia in time%s", s->words);
    const int filled = s->type.inertia(s->data, x, NULL, &out) == STATUS_OK;
    look(&taken, filled, s, c);
    look(&rates, filled, s, c);
    look(&places, filled, s, c);
}

static void forces(const specimen *s, const node_state x[], claims *c)
{
    const int n = s->coordinates;
    const unsigned leaves = s->made.given->leaves;
    guarded energy, force, stiffness;
    if (s->made.given->force == NULL)
        return;
    force_output out = {.energy = guard(&energy, "force: energy", 1),
                        .F = guard(&force, "force: F", n),
                        .K = guard(&stiffness, "force: K", n * n)};
    if (leaves & LEAVES_FORCE)
        out.F = NULL;
    if (leaves)
        out.K = NULL;
    claims_doing(c, "force%s", s->words);
    const int filled = s->made.given->force(adapted_own(s->data), x, &out) == STATUS_OK;
    look(&energy, filled, s, c);
    look(&force, filled && out.F != NULL, s, c);
    look(&stiffness, filled && out.K != NULL, s, c);
}

/* prepare writes into its data_size bytes only. */
static void data(const specimen *s, claims *c)
{
    guarded bytes;
    const size_t own = s->made.given->data_size != NULL ? s->made.given->data_size(&s->request) : 0;
    double *place = guard(&bytes, "prepare: its data", (int)((own + 7) / 8));
    element_request request = s->request;
    claims_doing(c, "prepare%s", s->words);
    memset(place, 0, own);
    s->made.given->prepare(&request, (element_data *)place, NULL);
    look(&bytes, 0, s, c);
}

static void check(const specimen *s, claims *c)
{
    double room[GUARD + M + GUARD], kept[M], *e = room + GUARD;
    node_state x[ELEMENT_MAX_NODES], given[ELEMENT_MAX_NODES];
    claim *inputs = claims_open(c, "inputs are left as they are", 0);
    specimen_state(s, 0.02, 53, x);
    memcpy(given, x, sizeof given);
    strains(s, x, c);
    s->type.strain(s->data, x, &(strain_output){.e = e});
    memcpy(kept, e, (size_t)s->strains * sizeof *e);
    stresses(s, e, c);
    masses(s, x, c);
    in_time(s, x, c);
    forces(s, x, c);
    data(s, c);
    claims_asks(inputs, memcmp(given, x, (size_t)s->nodes * sizeof *x) == 0,
                "strain, inertia: the states of the nodes are changed; they are read only%s",
                s->words);
    claims_asks(inputs, memcmp(kept, e, (size_t)s->strains * sizeof *e) == 0,
                "stress: the strains are changed; they are read only%s", s->words);
}

void checks_bounds(const formulation *chosen, claims *out)
{
    specimens_each(chosen, out, check);
}
