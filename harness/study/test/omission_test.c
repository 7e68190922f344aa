/* What physics that is left out changes: bounds against fine meshes, on beams of any thickness
 * under any load, and on every case at its defaults; what cannot be bounded is another model. */
#include "harness/study/study.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

static const double length = 0.1, young = 2e11, shear_modulus = 8e10;

typedef enum omission_acting {
    NOTHING,
    BENDS,
    TWISTS,
    BUCKLES,
    VIBRATES,
    LOADINGS
} omission_acting;
static const char *const names[LOADINGS] = {"no load", "bent", "twisted", "buckled", "vibrating"};

/* A clamped leaf of that thickness. */
static void leaf(scene *s, double thickness, omission_acting how, int held)
{
    const double y_axis[3] = {0, 1, 0}, end = 1;
    scene_init(s, "leaf");
    section_spec spec = section_spec_rectangle(young, shear_modulus, 0.02, thickness);
    spec.density = 7800;
    spec.given.Iw = 0;
    const int root = scene_add_node(s, 0, 0, 0), tip = scene_add_node(s, length, 0, 0);
    scene_add_member(s, root, tip, scene_add_section(s, &spec), y_axis);
    if (held)
        scene_hold_all(s, root);
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    if (how == BENDS)
        scene_add_load(s, SCENE_FORCE, tip, 0, 1, 0);
    if (how == TWISTS)
        scene_add_load(s, SCENE_MOMENT, tip, 1e-4, 0, 0);
    if (how == BUCKLES)
        scene_add_load(s, SCENE_FORCE, tip, -1, 0, 0);
    if (how == BUCKLES)
        scene_add_quantity(s, "load", "N", scene_add_buckling(s, SCENE_NONE),
                           scene_critical_factor(1, 1));
    else if (how == VIBRATES)
        scene_add_quantity(s, "frequency", "Hz", scene_add_modal(s, SCENE_NONE),
                           scene_frequency(1, SCENE_ANY));
    else {
        const int path = scene_add_static(s, 1, &end, 1);
        scene_add_quantity(s, "uy", "m", path, scene_coordinate(tip, SCENE_UY));
        scene_add_quantity(s, "rx", "rad", path, scene_coordinate(tip, SCENE_RX));
    }
}

/* A formulation without shear that can do the rest. */
static const element_type *rigid_one(const scene *s)
{
    for (int i = 0; registry_formulations[i] != NULL; i++)
        if (missing_omits(s, registry_formulations[i]) == FEATURE_SHEAR)
            return registry_formulations[i];
    return NULL;
}

static void of_leaf(double thickness, omission_acting how)
{
    scene s;
    omission o;
    char words[OMISSION_TEXT];
    leaf(&s, thickness, how, 1);
    const element_type *rigid = rigid_one(&s);
    omission_of(&s, rigid, &o);
    omission_words(&o, words);
    const double fine = omission_on_mesh(&s, FEATURE_SHEAR, 16);
    gsl_test(!isfinite(fine) || !isfinite(o.change), "%s, %g m thick: known: %s", names[how],
             thickness, words);
    gsl_test(o.other != (o.change > omission_most), "%s, %g m thick: %s", names[how], thickness,
             words);
    gsl_test(!o.other && fine > o.change, "%s, %g m thick: bound %g, truly %g", names[how],
             thickness, o.change, fine);
    gsl_test(o.other && !(fine > omission_most / 4), "%s, %g m thick: another model by %g only",
             names[how], thickness, fine);
    gsl_test(strstr(words, o.other ? "another model" : "changes no asked value") == NULL, "%s",
             words);
    scene_free(&s);
}

/* Bounds of a case, against its own meshes. */
static int of_case(const case_type *type)
{
    double value[CASE_MAX_PARAMETERS] = {0};
    fault f = {""};
    scene s;
    int seen = 0;
    unsigned known = 0;
    parameters_default(type, value);
    gsl_test(cell_scene(type, value, NULL, &s, &f) != STATUS_OK, "%s", f.text);
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        const element_type *t = registry_formulations[i];
        omission o;
        char words[OMISSION_TEXT];
        if (missing_omits(&s, t) == 0 || missing_omits(&s, t) == known ||
            missing_refused(&s, t, words, sizeof words) || expense_of_scene(&s, 0, t, 16) > 1)
            continue;
        omission_of(&s, t, &o);
        known = o.what;
        const double fine = omission_on_mesh(&s, o.what, 16);
        omission_words(&o, words);
        gsl_test(o.other != !(o.change <= omission_most), "%s, %s: %s", s.name, t->name, words);
        gsl_test(isnan(o.change) && o.why[0] == '\0', "%s, %s: unknown, and no reason", s.name,
                 t->name);
        gsl_test(!o.other && isfinite(fine) && fine > o.change, "%s, %s: %s; truly %g", s.name,
                 t->name, words, fine);
        gsl_test(o.other && isfinite(o.change) && fine < omission_most / 4, "%s, %s: %s; truly %g",
                 s.name, t->name, words, fine);
        seen++;
    }
    scene_free(&s);
    return seen;
}

/* Nothing holds it: no solution, no bound. */
static void loose(void)
{
    scene s;
    omission o;
    char words[OMISSION_TEXT];
    leaf(&s, 0.001, BENDS, 0);
    omission_of(&s, rigid_one(&s), &o);
    omission_words(&o, words);
    gsl_test(!o.other || !isnan(o.change) || o.why[0] == '\0', "loose: %s", words);
    scene_free(&s);
}

int main(void)
{
    static const double thickness[] = {2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.05};
    int seen = 0;
    for (size_t i = 0; i < sizeof thickness / sizeof *thickness; i++)
        for (int how = 0; how < LOADINGS; how++)
            of_leaf(thickness[i], (omission_acting)how);
    loose();
    for (int i = 0; registry_cases[i] != NULL; i++)
        seen += of_case(registry_cases[i]);
    gsl_test(seen < 20, "%d formulations leave something out of a case", seen);
    return gsl_test_summary();
}
