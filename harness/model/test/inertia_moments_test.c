/* Masses at the nodes of straight elements: their moments, and those of sections by their matrices.
 */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/shared/lumped.h"
#include "elements/test/worst.h"
#include "harness/experiments/experiments.h"

enum { MOST = SPECIMEN_COORDINATES };

/* What a scene with `mass: lumped` has, with all formulations alike. */
static void at_nodes(const specimen *s, const node_state x[], double M[])
{
    const lumped_mass whole = lumped_of(&s->section, s->request.features, s->request.length);
    lumped_element(&whole, s->nodes, lumped_shares(s->nodes), x, NULL, &(inertia_output){.M = M});
}

static void make(const char *name, const specimen_request *what, specimen *out)
{
    fault f = {""};
    gsl_test(specimen_make(what, out, &f) != STATUS_OK, "%s: prepared %s", name, f.text);
}

/* Masses at the nodes of an element stand as the rule for loads does: trapezoids with two nodes,
 * Simpson's with three, whose second moment about the end is exact. The twist has the section's own
 * polar inertia, whatever gives it. */
static void lumped_moments(const char *name)
{
    formulation chosen;
    specimen s;
    double M[MOST * MOST], x_moment = 0, polar = 0;
    node_state x[ELEMENT_MAX_NODES];
    gsl_test(formulation_parse(name, &chosen, NULL) != STATUS_OK, "%s", name);
    const specimen_request what = {.given = chosen.type,
                                   .options = chosen.option,
                                   .features = FEATURE_MASS | FEATURE_ROTARY_INERTIA,
                                   .form = PROFILES_UNSYMMETRIC,
                                   .unit = 1};
    make(name, &what, &s);
    s.section.Ip *= 1.3;
    gsl_test(s.type.prepare(&s.request, s.data, NULL) != STATUS_OK, "%s: prepared again", name);
    specimen_state(&s, 0, 1, x);
    at_nodes(&s, x, M);
    for (int k = 0; k < s.nodes; k++) {
        x_moment += M[(NODE_COORDINATES * k + 1) * (s.coordinates + 1)] * pow(x[k].r[0], 2);
        polar += M[(NODE_COORDINATES * k + 3) * (s.coordinates + 1)];
    }
    const double l = s.request.length, mass = s.section.density * s.section.A * l;
    gsl_test_rel(x_moment, mass * l * l / (s.nodes == 2 ? 2 : 3), 1e-13,
                 "%s: second moment of the masses", name);
    gsl_test_rel(polar, s.section.density * s.section.Ip * l, 1e-13, "%s: polar inertia", name);
    specimen_free(&s);
}

/* The mass matrix of one node of two is half that of the slice times its length. */
static void slice(const char *name)
{
    formulation chosen;
    specimen s;
    double M[MOST * MOST], worst = 0;
    node_state x[ELEMENT_MAX_NODES];
    gsl_test(formulation_parse(name, &chosen, NULL) != STATUS_OK, "%s", name);
    const specimen_request what = {.given = chosen.type,
                                   .options = chosen.option,
                                   .features = FEATURE_MASS | FEATURE_SHEAR,
                                   .form = PROFILES_MATRICES,
                                   .unit = 1};
    make(name, &what, &s);
    specimen_state(&s, 0, 1, x);
    at_nodes(&s, x, M);
    for (int i = 0; i < 36; i++)
        worst = worst_of(worst, fabs(M[s.coordinates * (i / 6) + i % 6] -
                                     s.request.length / 2 * s.section.mass[i]) /
                                    (s.request.length * s.section.mass[0]));
    gsl_test(!(worst < 1e-16), "%s: mass matrix of a node (%.1e)", name, worst);
    specimen_free(&s);
}

int main(void)
{
    lumped_moments("geometrically_exact:nodes=2");
    lumped_moments("geometrically_exact:nodes=3");
    lumped_moments("collocation");
    slice("geometrically_exact:nodes=2");
    slice("collocation");
    return gsl_test_summary();
}
