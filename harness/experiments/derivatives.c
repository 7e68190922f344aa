/* J and H against differences of sixth order, entry by entry. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"
#include "harness/formulations/formulations.h"

enum { M = SPECIMEN_STRAINS, N = SPECIMEN_COORDINATES };

static const double allowed = 1e-9; /* of the largest entry of the same strain */
static const char *const claim_J = "J is the derivative of the strains",
                         *const claim_H = "H is the second derivative";

static int strains_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const specimen_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    specimen_moved(at, i, si, j, sj, x);
    at->s->type.strain(at->s->data, x, &(strain_output){.e = values});
    return 0;
}

static int jacobian_at(const void *context, int i, double si, int j, double sj, double values[])
{
    const specimen_place *at = context;
    node_state x[ELEMENT_MAX_NODES];
    specimen_moved(at, i, si, j, sj, x);
    at->s->type.strain(at->s->data, x, &(strain_output){.J = values});
    return 0;
}

static double largest(int n, const double a[])
{
    double out = 0;
    for (int i = 0; i < n; i++)
        out = fmax(out, fabs(a[i]));
    return out;
}

/* One entry by what it is and what differences give, both times the unit of the coordinate. */
static void compare_J(const specimen *s, int strain, int c, double given, double found, double size,
                      claim *one)
{
    char where[SPECIMEN_WORDS];
    const double unit = chart_unit(c, s->request.length);
    claims_departs(one, size > 0 ? fabs(given - found) / size : fabs(given - found),
                   "J: the derivative of strain %d in coordinate %d (%s) is %.6g, differences give "
                   "%.6g%s",
                   strain + 1, c + 1, specimen_coordinate(c, where), given / unit, found / unit,
                   s->words);
}

/* Strain against strain: [strains x n] times units. */
static void check_J(const specimen *s, const node_state x[], claim *one)
{
    const specimen_place at = {s, x};
    const int n = s->coordinates;
    double J[M * N], found[N][M];
    for (int c = 0; c < n; c++)
        stencil_first(strains_at, &at, s->strains, c, found[c]);
    s->type.strain(s->data, x, &(strain_output){.J = J});
    for (int i = 0; i < s->strains; i++) {
        double row[N], differences[N];
        for (int c = 0; c < n; c++) {
            row[c] = J[i * n + c] * chart_unit(c, s->request.length);
            differences[c] = found[c][i];
        }
        const double size = fmax(largest(n, row), largest(n, differences));
        for (int c = 0; c < n; c++)
            compare_J(s, i, c, row[c], differences[c], size, one);
    }
}

/* Against the symmetric part of the change of J: that of the exponential chart. change[c]: of J
 * along coordinate c, per unit of it. */
static void compare_H(const specimen *s, int strain, const double H[], const double change[][M * N],
                      double size, claim *one)
{
    const int n = s->coordinates;
    const double l = s->request.length;
    char first[SPECIMEN_WORDS], other[SPECIMEN_WORDS];
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const double ub = chart_unit(b, l), ua = chart_unit(a, l);
            const double found =
                (change[a][strain * n + b] * ub + change[b][strain * n + a] * ua) / 2;
            const double given = H[a * n + b] * ua * ub;
            claims_departs(
                one, claims_share(fabs(given - found), size),
                "H: the second derivative of strain %d in coordinates %d and %d (%s, %s) "
                "is %.6g, differences of J give %.6g: apart by %.1e of its size%s",
                strain + 1, a + 1, b + 1, specimen_coordinate(a, first),
                specimen_coordinate(b, other), H[a * n + b], found / (ua * ub),
                claims_share(fabs(given - found), size), s->words);
        }
}

static void check_H(const specimen *s, const node_state x[], claim *one)
{
    double change[N][M * N];
    const specimen_place at = {s, x};
    const int n = s->coordinates;
    double J[M * N], H[N * N], weight[M] = {0}, size = 0;
    s->type.strain(s->data, x, &(strain_output){.J = J});
    for (int c = 0; c < n; c++)
        stencil_first(jacobian_at, &at, s->strains * n, c, change[c]);
    for (int i = 0; i < s->strains; i++)
        for (int c = 0; c < n; c++)
            size = fmax(size, fabs(J[i * n + c]) * chart_unit(c, s->request.length));
    for (int i = 0; i < s->strains; i++) {
        memset(weight, 0, sizeof weight);
        weight[i] = 1;
        s->type.strain(s->data, x, &(strain_output){.s = weight, .H = H});
        compare_H(s, i, H, (const double(*)[M * N]) change, size, one);
    }
}

static void check(const specimen *s, claims *c)
{
    static const double sizes[] = {0, 0.3, 0.3};
    const unsigned leaves = s->made.given->leaves;
    for (unsigned k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        static const double turn[3] = {0.71, -1.93, 1.37};
        node_state x[ELEMENT_MAX_NODES], carried[ELEMENT_MAX_NODES];
        specimen_state(s, sizes[k], 7 + k, x);
        specimen_carry(s, turn, x, carried);
        const node_state *at = k == 1 ? carried : x;
        if (!(leaves & LEAVES_J)) {
            claims_doing(c, "strain with J%s", s->words);
            check_J(s, at, claims_open(c, claim_J, allowed));
        }
        if (!(leaves & (LEAVES_J | LEAVES_H)) &&
            claims_open(c, claim_J, allowed)->outcome == CLAIM_HOLDS) {
            claims_doing(c, "strain with H%s", s->words);
            check_H(s, at, claims_open(c, claim_H, allowed));
        }
    }
}

void checks_derivatives(const formulation *chosen, claims *out)
{
    const element_type *t = chosen->type;
    if (t->force != NULL) {
        claims_not_made(out, claim_J, "known by its force: has no strains of its own");
        return;
    }
    if (t->leaves & LEAVES_J)
        claims_not_made(out, claim_J, "left to differences");
    if (t->leaves & (LEAVES_J | LEAVES_H))
        claims_not_made(out, claim_H, "left to differences");
    if (!(t->leaves & LEAVES_J))
        specimens_each(chosen, out, check);
    if (claims_open(out, claim_J, allowed)->outcome == CLAIM_BROKEN)
        claims_not_made(out, claim_H, "not looked at before J is right");
}
