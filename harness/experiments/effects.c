#include "harness/experiments/effects.h"

#include <stdio.h>
#include <string.h>

enum { EFFECTS_M = SPECIMEN_STRAINS, N = SPECIMEN_COORDINATES };

/* What an element says of a state. */
typedef struct effects_answers {
    double e[EFFECTS_M], J[EFFECTS_M * N], energy, sigma[EFFECTS_M], C[EFFECTS_M * EFFECTS_M],
        G[EFFECTS_M * EFFECTS_M];
} effects_answers;

static int answer(const specimen *s, const node_state x[], effects_answers *out)
{
    double inner[SPECIMEN_INNER], stress[EFFECTS_M];
    memset(out, 0, sizeof *out);
    specimen_numbers(s->strains, 67, stress);
    if (s->type.geometric != NULL)
        s->type.geometric(s->data, stress, out->G);
    s->type.strain(s->data, x, &(strain_output){.e = out->e, .J = out->J});
    specimen_rest(s, inner);
    return specimen_settled(
               s, out->e, inner,
               &(stress_output){.energy = &out->energy, .sigma = out->sigma, .C = out->C}) ==
           STATUS_OK;
}

static int other(int count, const double a[], const double b[])
{
    for (int i = 0; i < count; i++)
        if (a[i] != b[i])
            return 1;
    return 0;
}

static int differ(const effects_answers *a, const effects_answers *b)
{
    return other(EFFECTS_M, a->e, b->e) || other(EFFECTS_M * N, a->J, b->J) ||
           a->energy != b->energy || other(EFFECTS_M, a->sigma, b->sigma) ||
           other(EFFECTS_M * EFFECTS_M, a->C, b->C) || other(EFFECTS_M * EFFECTS_M, a->G, b->G);
}

/* The element with the features, and the same without one of them. */
typedef struct pair {
    specimen with, without;
} pair;

static int makes(const formulation *chosen, unsigned features, profiles_form form, specimen *out)
{
    const specimen_request what = {.given = chosen->type,
                                   .options = chosen->option,
                                   .features = features,
                                   .form = form,
                                   .unit = 1};
    fault f = {""};
    return specimen_make(&what, out, &f) == STATUS_OK;
}

/* 1: something changes, 0: nothing does, -1: one of the two is refused. */
static int changes(const formulation *chosen, unsigned features, unsigned bit, profiles_form form)
{
    pair p;
    effects_answers a, b;
    node_state x[ELEMENT_MAX_NODES];
    int found = -1;
    const int made = makes(chosen, features, form, &p.with),
              bare = makes(chosen, features & ~bit, form, &p.without);
    if (made && bare && p.with.strains == p.without.strains) {
        specimen_state(&p.with, 0.04, 61, x);
        if (answer(&p.with, x, &a) && answer(&p.without, x, &b))
            found = differ(&a, &b);
    } else if (made && bare) {
        found = 1;
    }
    specimen_free(&p.with);
    specimen_free(&p.without);
    return found;
}

/* The same of the warping amplitudes of its nodes. */
static int warps(const formulation *chosen, unsigned features, profiles_form form)
{
    specimen s;
    effects_answers a, b;
    node_state x[ELEMENT_MAX_NODES];
    int found = -1;
    if (makes(chosen, features, form, &s)) {
        specimen_state(&s, 0.04, 61, x);
        const int first = answer(&s, x, &a);
        for (int k = 0; k < s.nodes; k++)
            x[k].a = 0;
        if (first && answer(&s, x, &b))
            found = differ(&a, &b);
    }
    specimen_free(&s);
    return found;
}

/* Of a rectangle and, where it takes one, of an unsymmetric section: 1 once something changes. */
static int anywhere(const formulation *chosen, unsigned features, unsigned bit)
{
    const element_type *t = chosen->type;
    const int forms =
        !(t->limits & LIMIT_DOUBLY_SYMMETRIC) && t->offers & FEATURE_ECCENTRIC ? 2 : 1;
    int found = -1;
    for (int form = 0; form < forms && found < 1; form++) {
        const int here = bit == 0 ? warps(chosen, features, (profiles_form)form)
                                  : changes(chosen, features, bit, (profiles_form)form);
        found = here > found ? here : found;
    }
    return found;
}

void effects_check(const formulation *chosen, claims *c)
{
    /* Without FEATURE_ECCENTRIC: the shear centre is a constant of the section, and elements take
     * it from there. Without FEATURE_TRAPEZE: it is one of the terms of second order, and a
     * formulation that leaves them all out to show what they are worth (beamw_first) is asked for
     * what the whole one is asked for. What belongs to the structure, mass or shape is looked at
     * elsewhere. */
    static const unsigned sections[] = {FEATURE_WARPING, FEATURE_SHEAR, FEATURE_WAGNER_MOMENTS,
                                        FEATURE_WAGNER_TORQUE};
    const unsigned all = specimen_features(chosen->type, 0);
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        const unsigned bit = sections[i];
        char name[CLAIM_NAME];
        if (!(all & bit))
            continue;
        snprintf(name, sizeof name, "%s changes something", feature_name(bit));
        claims_doing(c, "strain and stress with and without %s", feature_name(bit));
        claim *one = claims_open(c, name, 0);
        if (bit == FEATURE_WARPING)
            claims_asks(one, anywhere(chosen, all, 0) != 0,
                        "offers warping, but nothing depends on the warping amplitudes; let it, or "
                        "do not offer it");
        else /* theories of shear go with shear */
            claims_asks(
                one,
                anywhere(chosen, all,
                         bit == FEATURE_SHEAR ? bit | FEATURE_ENGESSER | FEATURE_HARINGX : bit) !=
                    0,
                "offers %s, but nothing changes with it: strains, energy, stress and C are those "
                "of the element without it; let them depend on it, or do not offer it",
                feature_name(bit));
    }
}
