/* Of types that are known by a force or an energy of their nodes. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"
#include "harness/formulations/adapted.h"
#include "harness/formulations/formulations.h"

enum { N = SPECIMEN_COORDINATES };

static const char *const claim_F = "F is the gradient of the energy",
                         *const claim_K = "K is the derivative of F",
                         *const claim_same = "a rigid motion leaves the energy",
                         *const claim_rest = "nothing loads the undeformed element";

static status call(const specimen *s, const node_state x[], force_output *out)
{
    return s->made.given->force(adapted_own(s->data), x, out);
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const specimen_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    specimen_moved(at, i, si, j, sj, x);
    return (int)call(at->s, x, &(force_output){.energy = values});
}

static int force_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const specimen_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    specimen_moved(at, i, si, j, sj, x);
    return (int)call(at->s, x, &(force_output){.F = values});
}

/* Forces times units of their coordinates: works [J]; size: the largest. */
static double works(const specimen *s, const double F[], double out[])
{
    double largest = 0;
    for (int i = 0; i < s->coordinates; i++) {
        out[i] = F[i] * chart_unit(i, s->request.length);
        largest = fmax(largest, fabs(out[i]));
    }
    return largest;
}

static void check_force(const specimen_place *at, const double F[], claim *one)
{
    const specimen *s = at->s;
    char where[SPECIMEN_WORDS];
    double work[N];
    const double size = works(s, F, work);
    for (int i = 0; i < s->coordinates; i++) {
        double found = NAN;
        const double unit = chart_unit(i, s->request.length);
        stencil_first(energy_at, at, 1, i, &found);
        claims_departs(one, claims_share(fabs(work[i] - found), size),
                       "force: F in coordinate %d (%s) is %.6g, the energy's derivative is %.6g%s",
                       i + 1, specimen_coordinate(i, where), F[i], found / unit, s->words);
    }
}

/* Only the symmetric part of K counts: that of the exponential chart. */
static void check_stiffness(const specimen_place *at, const double K[], claim *one)
{
    const specimen *s = at->s;
    const int n = s->coordinates;
    char first[SPECIMEN_WORDS], other[SPECIMEN_WORDS];
    double column[N][N], size = 0;
    for (int j = 0; j < n; j++) {
        const double unit = chart_unit(j, s->request.length);
        stencil_first(force_at, at, n, j, column[j]);
        size = fmax(size, fabs(K[j * n + j]) * unit * unit);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            const double ui = chart_unit(i, s->request.length),
                         uj = chart_unit(j, s->request.length);
            const double given = (K[i * n + j] + K[j * n + i]) / 2 * ui * uj,
                         found = (column[j][i] * ui + column[i][j] * uj) / 2;
            claims_departs(one, claims_share(fabs(given - found), size),
                           "K: the derivative of the force in coordinate %d (%s) along coordinate "
                           "%d (%s) is %.6g, differences of F give %.6g%s",
                           i + 1, specimen_coordinate(i, first), j + 1,
                           specimen_coordinate(j, other), given / (ui * uj), found / (ui * uj),
                           s->words);
        }
}

static void check_carried(const specimen *s, const node_state x[], double energy, claim *one)
{
    static const double turn[][3] = {{0.71, -1.93, 1.37}, {0, 0, 1.9}, {2.1, 0, 0}, {0, -2.9, 0}};
    for (size_t k = 0; k < sizeof turn / sizeof turn[0]; k++) {
        node_state carried[ELEMENT_MAX_NODES];
        double other = NAN;
        specimen_carry(s, turn[k], x, carried);
        call(s, carried, &(force_output){.energy = &other});
        claims_departs(one, claims_share(fabs(other - energy), fabs(energy)),
                       "force: a rigid turn by (%g, %g, %g) rad takes the energy from %.6g J to "
                       "%.6g J; measure strains in axes that turn with the element%s",
                       turn[k][0], turn[k][1], turn[k][2], energy, other, s->words);
    }
}

static void check_rest(const specimen *s, double scale, claim *one)
{
    double F[N] = {0}, work[N] = {0}, energy = NAN;
    char where[SPECIMEN_WORDS];
    node_state x[ELEMENT_MAX_NODES];
    const unsigned leaves = s->made.given->leaves;
    specimen_state(s, 0, 1, x);
    call(s, x, &(force_output){.energy = &energy, .F = leaves & LEAVES_FORCE ? NULL : F});
    claims_departs(one, fabs(energy) / scale,
                   "force: the undeformed element has an energy of %.3g J%s", energy, s->words);
    if (leaves & LEAVES_FORCE)
        return;
    works(s, F, work);
    for (int i = 0; i < s->coordinates; i++)
        claims_departs(
            one, fabs(work[i]) / scale,
            "force: F in coordinate %d (%s) of the undeformed element is %.3g, not zero%s", i + 1,
            specimen_coordinate(i, where), F[i], s->words);
}

static void check(const specimen *s, claims *c)
{
    const unsigned leaves = s->made.given->leaves;
    double energy = NAN, F[N], K[N * N];
    node_state x[ELEMENT_MAX_NODES];
    const specimen_place at = {s, x};
    specimen_state(s, 0.05, 11, x);
    claims_doing(c, "force%s", s->words);
    const status outcome =
        call(s, x,
             &(force_output){
                 .energy = &energy, .F = leaves & LEAVES_FORCE ? NULL : F, .K = leaves ? NULL : K});
    claims_asks(claims_open(c, "moderate strains have a force", 0), outcome == STATUS_OK,
                "force: a state moved by some hundredths ends with status '%s'%s",
                status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    check_carried(s, x, energy, claims_open(c, claim_same, 1e-9));
    check_rest(s, fabs(energy), claims_open(c, claim_rest, 1e-10));
    if (!(leaves & LEAVES_FORCE))
        check_force(&at, F, claims_open(c, claim_F, 1e-8));
    if (leaves == 0)
        check_stiffness(&at, K, claims_open(c, claim_K, 1e-8));
}

void checks_force(const formulation *chosen, claims *out)
{
    if (chosen->type->force == NULL) {
        claims_not_made(out, claim_F, "known by its strains and stresses");
        return;
    }
    if (chosen->type->leaves & LEAVES_FORCE)
        claims_not_made(out, claim_F, "left to differences");
    if (chosen->type->leaves)
        claims_not_made(out, claim_K, "left to differences");
    specimens_each(chosen, out, check);
}
