/* Stress, stiffness and geometric stiffness against differences of the energy, of the stress and of
 * the stiffness. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"
#include "harness/formulations/formulations.h"

enum { ENERGY_M = SPECIMEN_STRAINS };

static const double moved_by = 0.02; /* [lengths] of the strains that are looked at */

/* Where differences are taken: a unit of a strain is a twentieth of the length. */
typedef struct energy_place {
    const specimen *s;
    const double *e, *inner;
} energy_place;

static double unit_of(const specimen *s)
{
    return s->request.length / 20;
}

/* The state with strains i and j moved by si and sj units. */
static status at_place(const energy_place *at, int i, double si, int j, double sj,
                       stress_output *out)
{
    double e[ENERGY_M], inner[SPECIMEN_INNER];
    memcpy(e, at->e, (size_t)at->s->strains * sizeof *e);
    memcpy(inner, at->inner, (size_t)at->s->inner * sizeof *inner);
    e[i] += si * unit_of(at->s);
    e[j] += sj * unit_of(at->s);
    return specimen_settled(at->s, e, inner, out);
}

static int energy_at(const void *context, int i, double si, int j, double sj, double values[])
{
    return (int)at_place(context, i, si, j, sj, &(stress_output){.energy = values});
}

static int stress_at(const void *context, int i, double si, int j, double sj, double values[])
{
    return (int)at_place(context, i, si, j, sj, &(stress_output){.sigma = values});
}

/* Size of C[i][j]: that of an entry between two strains of these stiffnesses. */
static double size_of(const specimen *s, const double C[], int i, int j)
{
    const int m = s->strains;
    double largest = 0;
    for (int k = 0; k < m; k++)
        largest = fmax(largest, fabs(C[k * m + k]));
    return sqrt(fmax(fabs(C[i * m + i]), 1e-9 * largest) *
                fmax(fabs(C[j * m + j]), 1e-9 * largest));
}

static void check_gradient(const energy_place *at, const double sigma[], const double C[],
                           claims *c)
{
    const specimen *s = at->s;
    claim *one = claims_open(c, "stress is the gradient of the energy", 1e-6);
    for (int i = 0; i < s->strains; i++) {
        double found = NAN;
        const int outcome = stencil_first(energy_at, at, 1, i, &found);
        found /= unit_of(s);
        const double size =
            fmax(fabs(sigma[i]), size_of(s, C, i, i) * moved_by * s->request.length);
        claims_departs(
            one, outcome == 0 ? claims_share(fabs(sigma[i] - found), size) : NAN,
            "stress: sigma %d is %.6g, the energy's derivative in strain %d is %.6g: one "
            "of them is wrong%s",
            i + 1, sigma[i], i + 1, found, s->words);
    }
}

static void check_stiffness(const energy_place *at, const double C[], claims *c)
{
    const specimen *s = at->s;
    const int m = s->strains;
    claim *derives = claims_open(c, "C is the derivative of the stress", 1e-7),
          *symmetric = claims_open(c, "C is symmetric", 1e-9);
    for (int j = 0; j < m; j++) {
        double column[ENERGY_M] = {0};
        const int outcome = stencil_first(stress_at, at, m, j, column);
        for (int i = 0; i < m; i++) {
            const double size = size_of(s, C, i, j), found = column[i] / unit_of(s);
            claims_departs(derives,
                           outcome == 0 ? claims_share(fabs(C[i * m + j] - found), size) : NAN,
                           "C: the derivative of sigma %d in strain %d is %.6g, differences of the "
                           "stress give %.6g%s",
                           i + 1, j + 1, C[i * m + j], found, s->words);
            claims_departs(
                symmetric, claims_share(fabs(C[i * m + j] - C[j * m + i]), size),
                "C: entry %d, %d is %.6g and entry %d, %d is %.6g; a stress that derives "
                "from an energy has a symmetric C%s",
                i + 1, j + 1, C[i * m + j], j + 1, i + 1, C[j * m + i], s->words);
        }
    }
}

/* Without strains: no energy, no stress; what bends a curved element straight is not looked at. */
static void check_rest(const specimen *s, claims *c)
{
    const double none[ENERGY_M] = {0};
    double inner[SPECIMEN_INNER], sigma[ENERGY_M], C[ENERGY_M * ENERGY_M], energy = NAN;
    claim *one = claims_open(c, "nothing stresses the undeformed element", 1e-12);
    specimen_rest(s, inner);
    if (specimen_settled(s, none, inner,
                         &(stress_output){.energy = &energy, .sigma = sigma, .C = C}) != STATUS_OK)
        return;
    const double scale = size_of(s, C, 0, 0) * s->request.length * s->request.length;
    claims_departs(one, fabs(energy) / scale,
                   "stress: the undeformed element has an energy of %.3g J; count it from there%s",
                   energy, s->words);
    for (int i = 0; i < s->strains; i++)
        claims_departs(one, fabs(sigma[i]) / (size_of(s, C, i, i) * s->request.length),
                       "stress: sigma %d of the undeformed element is %.3g N, not zero%s", i + 1,
                       sigma[i], s->words);
}

/* G is symmetric and linear in the prestress. */
static void check_geometric(const specimen *s, const double C[], claims *c)
{
    const int m = s->strains;
    double a[ENERGY_M], b[ENERGY_M], both[ENERGY_M], Ga[ENERGY_M * ENERGY_M],
        Gb[ENERGY_M * ENERGY_M], Gs[ENERGY_M * ENERGY_M];
    if (s->type.geometric == NULL)
        return;
    claim *symmetric = claims_open(c, "G is symmetric", 1e-9),
          *linear = claims_open(c, "G is linear in the prestress", 1e-9);
    specimen_numbers(m, 17, a);
    specimen_numbers(m, 18, b);
    for (int i = 0; i < m; i++) {
        const double size = size_of(s, C, i, i) * moved_by * s->request.length;
        a[i] *= size;
        b[i] *= size;
        both[i] = 2 * a[i] - 3 * b[i];
    }
    claims_doing(c, "geometric%s", s->words);
    s->type.geometric(s->data, a, Ga);
    s->type.geometric(s->data, b, Gb);
    s->type.geometric(s->data, both, Gs);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            const int ij = i * m + j, ji = j * m + i;
            const double size = size_of(s, C, i, j) * moved_by;
            claims_departs(symmetric, claims_share(fabs(Ga[ij] - Ga[ji]), size),
                           "geometric: G entry %d, %d is %.6g and entry %d, %d is %.6g; make it "
                           "symmetric%s",
                           i + 1, j + 1, Ga[ij], j + 1, i + 1, Ga[ji], s->words);
            claims_departs(linear, claims_share(fabs(Gs[ij] - 2 * Ga[ij] + 3 * Gb[ij]), size),
                           "geometric: G entry %d, %d of a sum of prestresses is not the sum of "
                           "theirs%s",
                           i + 1, j + 1, s->words);
        }
}

static void check(const specimen *s, claims *c)
{
    double e[ENERGY_M], sigma[ENERGY_M], C[ENERGY_M * ENERGY_M], inner[SPECIMEN_INNER], energy,
        residual = NAN;
    node_state x[ELEMENT_MAX_NODES];
    const energy_place at = {.s = s, .e = e, .inner = inner};
    specimen_state(s, moved_by, 11, x);
    claims_doing(c, "stress%s", s->words);
    s->type.strain(s->data, x, &(strain_output){.e = e});
    specimen_rest(s, inner);
    const status outcome = specimen_settled(
        s, e, inner,
        &(stress_output){.energy = &energy, .sigma = sigma, .C = C, .residual = &residual});
    claims_asks(claims_open(c, "moderate strains have a stress", 0), outcome == STATUS_OK,
                "stress: strains of some hundredths of the length end with status '%s'%s",
                status_name(outcome), s->words);
    if (outcome != STATUS_OK)
        return;
    claims_departs(claims_open(c, "its own equations are solved", 1e-9), fabs(residual),
                   "update: after %d corrections the residual of its own unknowns is %.1e; check "
                   "memory and update%s",
                   30, residual, s->words);
    check_gradient(&at, sigma, C, c);
    check_stiffness(&at, C, c);
    check_rest(s, c);
    check_geometric(s, C, c);
}

void checks_energy(const formulation *chosen, claims *out)
{
    if (chosen->type->force != NULL) {
        claims_not_made(out, "stress is the gradient of the energy",
                        "known by its force: has no stresses of its own");
        return;
    }
    specimens_each(chosen, out, check);
    if (chosen->type->geometric == NULL)
        claims_not_made(out, "G is symmetric", "has no geometric stiffness inside the element");
}
