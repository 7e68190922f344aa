/* Meshes with consistent mass must converge to the limit of meshes with lumped mass. */
#include <math.h>

#include "harness/time/test/moving.h"

extern const element_type element_beamw_consistent;
extern const case_type case_release, case_leaf_guide;

static double value_of(const case_type *type, const char *parameters, const char *quantity,
                       scene_mass mass, int elements)
{
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    answer a;
    scene s;
    parameters_default(type, value);
    gsl_test(parameters_parse(type, parameters, value, NULL, &f) != STATUS_OK, "%s", f.text);
    scene_init(&s, type->name);
    gsl_test(case_build(type, value, &s, &f) != STATUS_OK, "%s: built (%s)", type->name, f.text);
    for (int i = 0; i < s.analyses; i++)
        if (s.analysis[i].kind == SCENE_MOTION)
            s.analysis[i].of.motion.mass = mass;
    ask_scene(&s, &element_beamw_consistent, NULL, elements, &a);
    scene_free(&s);
    gsl_test(a.outcome != ASK_ANSWERED, "%s with %d elements (%s)", type->name, elements, a.reason);
    return answer_of(&a, quantity);
}

/* Checks the errors of the coarsest and the third mesh with respect to the finest one. The errors
 * must have the given order and be at most the fraction `part` of those with lumped mass. The limit
 * with lumped mass must be the same within `near`. */
static void meshes(const case_type *type, const char *parameters, const char *quantity,
                   double order, double part, double near)
{
    enum { MESHES = 4 };
    double found[2][MESHES];
    for (int mass = 0; mass < 2; mass++)
        for (int k = 0; k < MESHES; k++)
            found[mass][k] = value_of(type, parameters, quantity,
                                      mass ? SCENE_CONSISTENT : SCENE_LUMPED, 1 << k);
    const double *lumped = found[0], *own = found[1], limit = own[MESHES - 1],
                 other = lumped[MESHES - 1], ratio = fabs((own[0] - limit) / (own[2] - limit));
    gsl_test(!(fabs(other - limit) < near * fabs(limit)), "%s %s: limits %.9g and %.9g", type->name,
             quantity, limit, other);
    for (int k = 0; k < MESHES - 1; k++)
        gsl_test(!(fabs(own[k] - limit) < part * fabs(lumped[k] - limit)),
                 "%s %s with %d elements: consistent %.3e, lumped %.3e off", type->name, quantity,
                 1 << k, own[k] - limit, lumped[k] - limit);
    gsl_test(!(ratio > pow(4, order)), "%s %s: order %.1f", type->name, quantity, log2(ratio) / 2);
}

int main(void)
{
    meshes(&case_release, "tolerance=1e-7", "tip", 2.5, 0.15, 5e-3);
    meshes(&case_release, "model=timoshenko;tolerance=1e-9;time=0.004;step=1e-4", "tip", 2, 0.1,
           2e-2);
    meshes(&case_leaf_guide, "tolerance=1e-5", "displacement", 3, 100, 2e-5);
    return gsl_test_summary();
}
