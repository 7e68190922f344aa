/* Limits of one formulation: what vanishes leaves the answer that is found without it. */
#include <math.h>
#include <string.h>

#include "harness/catalogue/registry.h"
#include "harness/study/test/ask.h"

/* GA to infinity: the shear-flexible cantilever becomes the elastica (L = 1, load 10, EI = 10). */
static void stiff_in_shear(const element_type *e)
{
    double apart[2][2];
    for (int k = 0; k < 2; k++) {
        static answer sheared, rigid;
        const scene_edit none = {SCENE_EDIT_NONE, 0};
        ask(case_find("shear_elastica", NULL), "GA=1e12", e, k == 0 ? 4 : 16, 0, none, &sheared);
        ask(case_find("elastica", NULL), "", e, k == 0 ? 4 : 16, 0, none, &rigid);
        if (sheared.count == 0)
            return;
        apart[k][0] = fabs(value_of(&sheared, "v") / value_of(&rigid, "w_over_L") - 1);
        apart[k][1] = fabs(value_of(&sheared, "u") / value_of(&rigid, "u_over_L") + 1);
    }
    for (int i = 0; i < 2; i++)
        gsl_test(!(apart[0][i] <= 1e-9 || apart[1][i] <= apart[0][i] / 10),
                 "%s: %s in the limit GA to infinity is that without shear (%.1e)", e->name,
                 i == 0 ? "deflection" : "shortening", apart[0][i]);
}

/* Deflection of the elastica's beam with an initial curvature [1/m]; NAN: not solved. */
static double curved(const element_type *e, double curvature)
{
    scene s;
    model *m = NULL;
    solve_result result = {0};
    double value[CASE_MAX_PARAMETERS] = {0}, deflection = NAN;
    formulation chosen;
    fault f = {""};
    const case_type *type = case_find("elastica", &f);
    formulation_default(e, &chosen);
    parameters_default(type, value);
    scene_init(&s, type->name);
    status outcome = type->build(value, &s, &f);
    scene_member_at(&s, 0)->curvature[2] = curvature;
    const model_request request = {.scene = &s, .type = e, .options = chosen.option, .elements = 4};
    if (outcome == STATUS_OK)
        outcome = model_alloc(&request, &m, &f);
    if (outcome == STATUS_OK)
        outcome = solve_scene(&s, m, NULL, &result, &f);
    if (outcome == STATUS_OK)
        deflection = result.quantity[0].value;
    result_free(&result);
    model_free(m);
    scene_free(&s);
    return deflection;
}

/* Curvature to zero: the answer changes in proportion to it, down to where nothing is left of
 * it. */
static void nearly_straight(const element_type *e)
{
    const double straight = curved(e, 0), slope = (curved(e, 1e-4) - curved(e, -1e-4)) / 2e-4;
    gsl_test(!(fabs(slope) > 1e-3), "%s: an initial curvature matters (%.1e)", e->name, slope);
    for (int power = -5; power >= -15; power -= 2) {
        const double curvature = pow(10, power), change = curved(e, curvature) - straight;
        gsl_test_abs(change, slope * curvature, 1e-3 * fabs(slope) * curvature + 2e-14,
                     "%s: an initial curvature of 1e%d", e->name, power);
    }
}

/* The shear-rigid form is the printed one without shear. */
static void without_shear(const element_type *e, const element_type *rigid)
{
    static answer a, b;
    const scene_edit none = {SCENE_EDIT_NONE, 0};
    ask(case_find("c_column", NULL), "shear=0", e, 4, 0, none, &a);
    ask(case_find("c_column", NULL), "shear=0", rigid, 4, 0, none, &b);
    gsl_test(a.count == 0 || a.count != b.count, "%s and %s solve the column without shear",
             e->name, rigid->name);
    for (int i = 0; i < a.count; i++)
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
