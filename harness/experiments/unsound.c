/* States that are no numbers, as an iteration that diverges has them: they are told by a status or
 * by values that are no numbers, and never swallowed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/experiments/checks.h"
#include "harness/experiments/specimens.h"

enum { UNSOUND_M = SPECIMEN_STRAINS };

static int all_finite(int n, const double a[])
{
    for (int i = 0; i < n; i++)
        if (!isfinite(a[i]))
            return 0;
    return 1;
}

/* 1: nothing says that the state is none. */
static int swallowed(const specimen *s, const node_state x[])
{
    double e[UNSOUND_M], sigma[UNSOUND_M], inner[SPECIMEN_INNER], energy = 0;
    s->type.strain(s->data, x, &(strain_output){.e = e});
    if (!all_finite(s->strains, e))
        return 0;
    specimen_rest(s, inner);
    const status outcome =
        s->type.stress(s->data, e, inner, &(stress_output){.energy = &energy, .sigma = sigma});
    return outcome == STATUS_OK && isfinite(energy) && all_finite(s->strains, sigma);
}

static void spoil(const specimen *s, double by, claim *one)
{
    static const char *const what[] = {"position", "rotation"};
    for (int k = 0; k < s->nodes; k++)
        for (int i = 0; i < 4; i++) {
            node_state x[ELEMENT_MAX_NODES];
            specimen_state(s, 0.02, 59, x);
            if (i < 3)
                x[k].r[i] = x[k].u[i] = by;
            for (int j = 0; j < 9 && i == 3; j++)
                x[k].R[j] = by;
            claims_asks(
                one, !swallowed(s, x),
                "strain, stress: a %s of node %d that is %g gives strains and stresses that look "
                "sound; let it through, or return a status%s",
                what[i == 3], k + 1, by, s->words);
        }
}

/* Strains that are no numbers have no stress, where there is a stiffness against them. */
static void spoil_strains(const specimen *s, double by, claim *one)
{
    const double none[UNSOUND_M] = {0};
    double C[UNSOUND_M * UNSOUND_M], inner[SPECIMEN_INNER];
    specimen_rest(s, inner);
    if (s->type.stress(s->data, none, inner, &(stress_output){.C = C}) != STATUS_OK)
        return;
    for (int i = 0; i < s->strains; i++) {
        double e[UNSOUND_M] = {0}, sigma[UNSOUND_M], energy = 0;
        if (C[i * s->strains + i] == 0)
            continue;
        e[i] = by;
        specimen_rest(s, inner);
        const status outcome =
            s->type.stress(s->data, e, inner, &(stress_output){.energy = &energy, .sigma = sigma});
        claims_asks(one,
                    outcome != STATUS_OK || !isfinite(energy) || !all_finite(s->strains, sigma),
                    "stress: strain %d that is %g has an energy and stresses that look sound; let "
                    "it through, or return a status%s",
                    i + 1, by, s->words);
    }
}

/* All calls come back, whatever the state: far beyond what can be evaluated too. */
static void far_away(const specimen *s, double size, claim *one)
{
    double e[UNSOUND_M], J[UNSOUND_M * SPECIMEN_COORDINATES], sigma[UNSOUND_M],
        C[UNSOUND_M * UNSOUND_M], inner[SPECIMEN_INNER];
    node_state x[ELEMENT_MAX_NODES];
    specimen_state(s, size, 61, x);
    s->type.strain(s->data, x, &(strain_output){.e = e, .J = J});
    specimen_rest(s, inner);
    s->type.stress(s->data, e, inner, &(stress_output){.sigma = sigma, .C = C});
    claims_asks(one, 1, "%s", "");
}

static void unsound_check(const specimen *s, claims *c)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (size_t k = 0; k < sizeof none / sizeof none[0]; k++) {
        claims_doing(c, "strain and stress of a state that is %g%s", none[k], s->words);
        spoil(s, none[k], claims_open(c, "states that are NaN or Inf are reported", 0));
        spoil_strains(s, none[k], claims_open(c, "strains that are NaN or Inf are reported", 0));
    }
    static const double far[] = {1, 1e3, 1e10, 1e30, 1e100, 1e200, 1e300};
    for (size_t k = 0; k < sizeof far / sizeof far[0]; k++) {
        const double size = far[k];
        claims_doing(c, "strain and stress of a state %g lengths and radians away%s", size,
                     s->words);
        far_away(s, size, claims_open(c, "far states come back", 0));
    }
}

void checks_unsound(const formulation *chosen, claims *out)
{
    specimens_each(chosen, out, unsound_check);
}
