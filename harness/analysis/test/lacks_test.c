/* A formulation that supports shear must include it in both directions, or declare one as missing
 * and reject scenes with shear in this direction. A guided cantilever has the deflection F l^3 (1 +
 * Phi)/(12 EI) with Phi = 12 EI/(k G A l^2). */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/tools/kit/accepted.h"

static const double length = 1, wide = 0.08, young = 2e11, shear_modulus = 8e10, share = 5.0 / 6;

static void guided(scene *s, double across_y, double across_z, int direction, int members)
{
    const double y_axis[3] = {0, 1, 0};
    double force[3] = {0};
    scene_init(s, "guided");
    section_spec spec = section_spec_rectangle(young, shear_modulus, across_z, across_y);
    spec.shear_factor[0] = spec.shear_factor[1] = share;
    spec.given.Iw = 0;
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0),
              profile = scene_add_section(s, &spec);
    int last = root;
    for (int i = 1; i < members; i++) {
        const int next = scene_add_node(s, length * i / members, 0, 0);
        scene_add_member(s, last, next, profile, y_axis);
        last = next;
    }
    scene_add_member(s, last, tip, profile, y_axis);
    scene_hold_all(s, root);
    scene_hold(s, tip, SCENE_RX, SCENE_RZ);
    force[direction] = 1;
    scene_add_load(s, SCENE_FORCE, tip, force[0], force[1], force[2]);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    scene_add_quantity(s, "u", "m", scene_add_linear(s), scene_coordinate(tip, direction));
}

/* Returns the deflection; NAN: the scene is rejected, with the reason in words[200]; INFINITY: it
 * cannot be solved. */
static double deflection(const element_type *type, scene *s, char *words)
{
    formulation chosen;
    model *m = NULL;
    solve_result r;
    fault f = {""};
    double u = NAN;
    formulation_default(type, &chosen);
    const model_request what = {.scene = s, .type = type, .options = chosen.option, .elements = 2};
    const status made = model_alloc(&what, &m, &f);
    memcpy(words, f.text, strlen(f.text) + 1);
    if (made != STATUS_OK)
        return NAN;
    const status solved = solve_scene(s, m, NULL, &r, &f);
    u = solved == STATUS_OK ? r.quantity[0].value : INFINITY;
    result_free(&r);
    const char *const *line;
    for (int i = model_left_out(m, &line) - 1; i >= 0; i--)
        if (strstr(line[i], "along") != NULL)
            memcpy(words, line[i], strlen(line[i]) + 1);
    model_free(m);
    return u;
}

static void one(const element_type *type, double thickness, int direction, int members)
{
    scene s;
    char words[FAULT_TEXT];
    guided(&s, thickness, wide, direction, members);
    char missing[200];
    const int runs = !missing_words(&s, type, missing, sizeof missing);
    const double depth = direction == 1 ? thickness : wide,
                 breadth = direction == 1 ? wide : thickness;
    const double EI = young * breadth * depth * depth * depth / 12,
                 GA = share * shear_modulus * breadth * depth;
    const double Phi = 12 * EI / (GA * length * length),
                 exact = length * length * length / (12 * EI) * (1 + Phi);
    const double Phi_y = young * thickness * thickness / (share * shear_modulus * length * length);
    const double u = deflection(type, &s, words);
    const int lacks = (type->lacks & LACKS_SHEAR_Y) != 0, other = lacks && Phi_y > 0.01;
    gsl_test(isnan(u), "%s: %g of %g m thick, Phi_y = %.3g: %s", type->name, thickness, length,
             Phi_y, words);
    gsl_test_int(missing_omits(&s, type) != 0, other, "%s: %g m thick: another model", type->name,
                 thickness);
    gsl_test(runs != !other || runs != (missing[0] == '\0'),
             "%s: %g m thick: what is missing: '%s'", type->name, thickness, missing);
    gsl_test(lacks != (strstr(words, "along y") != NULL),
             "%s: %g m thick: what is lacking is said: '%s'", type->name, thickness, words);
    if (other)
        gsl_test(strstr(words, type->lacks_by) == NULL,
                 "%s: with the equation that leaves it out: %s", type->name, words);
    if (other && direction == 1)
        gsl_test_rel(u, exact / (1 + Phi), 1e-9, "%s: rigid in shear along y, %g m thick",
                     type->name, thickness);
    else
        gsl_test_rel(u, exact, lacks && direction == 1 ? Phi : 1e-9,
                     "%s: deflection along %c, %g m thick", type->name, "xyz"[direction],
                     thickness);
    scene_free(&s);
}

int main(void)
{
    static const double thickness[] = {0.001, 0.003, 0.01, 0.03, 0.05, 0.06, 0.1, 0.3};
    for (int i = 0; accepted_at(i) != NULL; i++)
        for (size_t k = 0;
             k < sizeof thickness / sizeof *thickness && (accepted_at(i)->offers & FEATURE_SHEAR);
             k++)
            for (int direction = 1; direction <= 2; direction++)
                for (int members = 1; members <= 3; members += 2)
                    one(accepted_at(i), thickness[k], direction, members);
    return gsl_test_summary();
}
