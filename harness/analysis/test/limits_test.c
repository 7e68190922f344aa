/* Limits of one formulation: what vanishes leaves the answer that is found without it. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

/* Asks a case on a mesh; 1: answered. */
static int found(const char *name, const char *parameters, const element_type *e, int n,
                 ask_tally *tally, answer *out)
{
    const question q = {
        .type = case_find(name, NULL), .parameters = parameters, .formulation = e, .elements = n};
    ask(&q, out);
    return ask_count(tally, out, "%s, %s, n = %d", name, parameters, n);
}

/* GA to infinity: the shear-flexible cantilever becomes the elastica (L = 1, load 10, EI = 10). */
static void stiff_in_shear(const element_type *e)
{
    static const int n[2] = {4, 16};
    double apart[2][2];
    ask_tally tally = {0};
    for (int k = 0; k < 2; k++) {
        static answer sheared, rigid;
        const int both = found("shear_elastica", "GA=1e12", e, n[k], &tally, &sheared) +
                         found("elastica", "", e, n[k], &tally, &rigid);
        if (both < 2)
            break;
        apart[k][0] = fabs(answer_of(&sheared, "v") / answer_of(&rigid, "w_over_L") - 1);
        apart[k][1] = fabs(answer_of(&sheared, "u") / answer_of(&rigid, "u_over_L") + 1);
    }
    ask_conclude(&tally, e, "stiff in shear");
    if (tally.count[ASK_ANSWERED] == 4)
        for (int i = 0; i < 2; i++)
            gsl_test(!(apart[0][i] <= 1e-9 || apart[1][i] <= apart[0][i] / 10),
                     "%s: %s in the limit GA to infinity is that without shear (%.1e)", e->name,
                     i == 0 ? "deflection" : "shortening", apart[0][i]);
}

/* Deflection of the elastica's beam with an initial curvature [1/m]; NAN: not solved. */
static double curved(const element_type *e, double curvature, ask_tally *tally)
{
    static answer a;
    scene s;
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    const case_type *type = case_find("elastica", &f);
    parameters_default(type, value);
    scene_init(&s, type->name);
    gsl_test(case_build(type, value, &s, &f) != STATUS_OK, "elastica: built (%s)", f.text);
    scene_member_at(&s, 0)->curvature[2] = curvature;
    ask_scene(&s, e, NULL, 4, &a);
    scene_free(&s);
    return ask_count(tally, &a, "curvature %g", curvature) ? a.value[0] : NAN;
}

/* Curvature to zero: the answer changes in proportion to it, down to where nothing is left of
 * it. */
static void nearly_straight(const element_type *e)
{
    ask_tally tally = {0};
    const double straight = curved(e, 0, &tally), more = curved(e, 1e-4, &tally),
                 slope = (more - curved(e, -1e-4, &tally)) / 2e-4;
    const int least = isnan(slope) ? 0 : -15; /* nothing to go by: no power */
    for (int power = -5; power >= least; power -= 2) {
        const double curvature = pow(10, power), change = curved(e, curvature, &tally) - straight;
        gsl_test_abs(change, slope * curvature, 1e-3 * fabs(slope) * curvature + 2e-14,
                     "%s: an initial curvature of 1e%d", e->name, power);
    }
    ask_conclude(&tally, e, "nearly straight");
    gsl_test(tally.count[ASK_ANSWERED] > 1 && !(fabs(slope) > 1e-3),
             "%s: an initial curvature matters (%.1e)", e->name, slope);
}

/* The shear-rigid form is the printed one without shear. */
static void without_shear(const element_type *e, const element_type *rigid)
{
    static answer a, b;
    ask_tally tally = {0};
    const int both = found("c_column", "shear=0", e, 4, &tally, &a) +
                     found("c_column", "shear=0", rigid, 4, &tally, &b);
    gsl_test(both < 2 || a.count != b.count, "%s and %s solve the column without shear", e->name,
             rigid->name);
    for (int i = 0; i < a.count && i < b.count; i++)
        gsl_test_rel(b.value[i], a.value[i], 1e-11,
                     "%s: %s of the column is that of %s without shear", rigid->name, a.name[i],
                     e->name);
}

int main(void)
{
    without_shear(formulation_find("beamw"), formulation_find("beamw_vlasov"));
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        stiff_in_shear(registry_formulations[i]);
        nearly_straight(registry_formulations[i]);
    }
    return gsl_test_summary();
}
