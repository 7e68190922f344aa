/* Properties that need no reference value, for every formulation on every case that it runs:
 * equivalent descriptions of a mesh, mirror images, rotated symmetric structures, and reciprocity.
 * Two discretisations of the same continuum may differ, but the difference must decrease as the
 * mesh is refined. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/kit.h"
#include "harness/analysis/test/moves.h"
#include "harness/formulations/formulations.h"
#include "harness/tools/kit/ask.h"

static const scene_edit unchanged = {SCENE_EDIT_NONE, 0};

/* Returns the difference of two values relative to `scale`; 0: both are missing, because the mesh
 * has no such frequency. */
static double apart_of(double a, double b, double scale)
{
    const double size = fmax(fmax(fabs(a), fabs(b)), scale);
    if (isnan(a) && isnan(b))
        return 0;
    return size > 0 ? fabs(a - b) / size : 0;
}

static double curves_apart(const answer *a, const answer *b, int i)
{
    double scale = a->scale[i], worst = a->points[i] == b->points[i] ? 0 : INFINITY;
    for (int k = 0; k < a->points[i]; k++)
        scale = fmax(scale, fabs(a->curve[i][k]));
    for (int k = 0; k < a->points[i] && k < b->points[i]; k++)
        worst = worst_of(worst, apart_of(a->curve[i][k], b->curve[i][k], scale));
    return worst;
}

static double difference(const answer *a, const answer *b, const char **quantity_name)
{
    double worst = a->count == b->count ? 0 : INFINITY;
    *quantity_name = "their number";
    for (int i = 0; i < a->count && i < b->count; i++) {
        const double values = apart_of(a->value[i], b->value[i], a->scale[i]);
        const double apart = worst_of(values, curves_apart(a, b, i));
        *quantity_name = apart <= worst ? *quantity_name : a->name[i];
        worst = worst_of(worst, apart);
    }
    return worst;
}

static const parameter_type *parameter_of(const case_type *type, const char *name)
{
    const int i = parameter_index(type->parameters, name);
    return i < 0 ? NULL : parameter_at(type->parameters, i);
}

/* Writes parameters for few stations or, in a motion, for constant steps. Adaptive steps would
 * depend on the size of the members. */
static void short_path(const case_type *type, int size, char words[])
{
    const parameter_type *step = parameter_of(type, "step"), *steps = parameter_of(type, "steps");
    words[0] = '\0';
    if (step != NULL && parameter_of(type, "tolerance") != NULL)
        snprintf(words, (size_t)size, "tolerance=0;step=%.17g", 4 * step->value);
    else if (steps != NULL && steps->max >= 3)
        snprintf(words, (size_t)size, "steps=3");
}

typedef struct invariants_subject {
    const case_type *type;
    const element_type *formulation;
    ask_tally *tally;
    int coarse;
    int rigid; /* result of has_rigid_motions */
} invariants_subject;

/* Returns 1 if frequencies are requested of a structure that no node supports. Its rigid motions
 * have the frequency zero and increase the rounding errors of the other frequencies. */
static int has_rigid_motions(const case_type *type)
{
    scene s;
    fault f = {""};
    double parameter[CASE_MAX_PARAMETERS];
    int vibrates = 0;
    parameters_default(type, parameter);
    scene_init(&s, type->name);
    const status built = case_build(type, parameter, &s, &f);
    gsl_test(built != STATUS_OK, "%s: built (%s)", type->name, f.text);
    for (int i = 0; i < s.analyses; i++)
        vibrates |= s.analysis[i].kind == SCENE_MODAL;
    const int rigid = vibrates && has_free_nodes_only(&s);
    scene_free(&s);
    return rigid;
}

static double bound_of(const invariants_subject *s)
{
    return s->rigid ? 1e-6 : 1e-8;
}

static void ask_about(const invariants_subject *s, int n, int keep_all, scene_edit edit,
                      answer *out)
{
    char path[SCENE_NAME];
    short_path(s->type, sizeof path, path);
    ask(&(question){s->type, path, s->formulation, n, keep_all, edit}, out);
}

static int found(const invariants_subject *s, int n, int keep_all, scene_edit edit, answer *out)
{
    ask_about(s, n, keep_all, edit, out);
    return ask_count(s->tally, out, "%s, n = %d", s->type->name, n);
}

/* Finds the coarsest mesh with an answer, and the answers on this mesh and on the next one. Returns
 * 0 if no mesh has an answer. */
static int found_coarsest(invariants_subject *s, answer *out, answer *next)
{
    for (s->coarse = 2; s->coarse <= 32; s->coarse *= 2) {
        ask_about(s, s->coarse, 0, unchanged, out);
        ask_about(s, 2 * s->coarse, 0, unchanged, next);
        if (out->outcome != ASK_FAILED && next->outcome != ASK_FAILED)
            break;
    }
    return ask_count(s->tally, out, "%s, n = 2 to 32", s->type->name);
}

static void same(const invariants_subject *s, const char *what, const answer *before, int n,
                 scene_edit edit)
{
    static answer after;
    const char *quantity_name;
    if (!found(s, n, 0, edit, &after))
        return;
    const double apart = difference(before, &after, &quantity_name);
    gsl_test(!(apart <= bound_of(s)), "%s, %s: %s (%s, %.1e)", s->type->name, s->formulation->name,
             what, quantity_name, apart);
}

static void keep_all(const invariants_subject *s, const answer *fine)
{
    static answer finer, full;
    const answer *const lean[2] = {fine, &finer};
    double apart[2] = {0, 0};
    const char *quantity_name = "";
    for (int k = 0; k < 2; k++) {
        const int n = s->coarse * (k == 0 ? 2 : 8);
        if ((k == 1 && !found(s, n, 0, unchanged, &finer)) || !found(s, n, 1, unchanged, &full))
            return;
        apart[k] = difference(lean[k], &full, &quantity_name);
        if (apart[k] <= bound_of(s))
            break;
    }
    gsl_test(
        !(apart[0] <= bound_of(s) || apart[1] <= apart[0] / 8),
        "%s, %s: keeping what a scene leaves out changes nothing but the mesh (%s, %.1e, %.1e)",
        s->type->name, s->formulation->name, quantity_name, apart[0], apart[1]);
}

static void one_case(const case_type *type, const element_type *e, ask_tally *tally)
{
    static answer coarse, fine;
    invariants_subject s = {type, e, tally, 0, has_rigid_motions(type)};
    if (!found_coarsest(&s, &coarse, &fine))
        return;
    const int both = ask_count(tally, &fine, "%s, n = %d", type->name, 2 * s.coarse);
    if (both)
        keep_all(&s, &fine);
    if (!(e->limits & LIMIT_ORDER_DEPENDENT))
        same(&s, "the other order of nodes changes nothing", &coarse, s.coarse,
             (scene_edit){SCENE_EDIT_REVERSE, 0});
    if (!s.rigid) /* a small unit makes rigid motions less accurate */
        same(&s, "another unit of length changes nothing", &coarse, s.coarse,
             (scene_edit){SCENE_EDIT_UNIT, 1000});
    if (coarse.members == 1 && both)
        same(&s, "two members of two elements are one of four", &fine, s.coarse,
             (scene_edit){SCENE_EDIT_SPLIT, 0.5});
}

static void every_case(const element_type *e)
{
    ask_tally tally = {0};
    for (int i = 0; registry_cases[i] != NULL; i++)
        one_case(registry_cases[i], e, &tally);
    gsl_test(tally.count[ASK_ANSWERED] == 0, "%s: there are cases that it runs on", e->name);
    ask_conclude(&tally, e, "the same in other words");
}

static void mirrors(const element_type *e)
{
    static const struct {
        const char *base, *one, *other, *even, *odd;
    } images[] = {
        {"elastica", "load=3", "load=-3", "u_over_L", "w_over_L"},
        {"elastica", "load=3", "load=-3", "u_over_L", "theta"},
        {"bend_45", "force=600", "force=-600", "u_radial", "u_load"},
        {"roll_up", "turns=0.3", "turns=-0.3", "tip_gap", NULL},
        {"wagner_torsion", "angle=0.7", "angle=-0.7", "shortening", "moment"},
        {"sheet_cantilever", "tip_deflection=0.015", "tip_deflection=-0.015", "C_xx", "F_y"},
        {"sheet_cantilever", "tip_deflection=0.015", "tip_deflection=-0.015", "C_zz", "C_ux_Fy"},
        {"sheet_wagner", "wagner=0", "wagner=0;tip_phi_x=-0.15", "C_ux_Fx", "C_ux_My"},
        {"geradin_cardona", "load=600000", "load=-600000", "tip_x", "tip_y"},
    };
    ask_tally tally = {0};
    for (size_t i = 0; i < sizeof images / sizeof images[0]; i++) {
        static answer one, other;
        const case_type *type = case_find(images[i].base, NULL);
        ask(&(question){type, images[i].one, e, 4, 0, unchanged}, &one);
        ask(&(question){type, images[i].other, e, 4, 0, unchanged}, &other);
        const int both = ask_count(&tally, &one, "%s, %s", images[i].base, images[i].one) +
                         ask_count(&tally, &other, "%s, %s", images[i].base, images[i].other);
        if (both < 2)
            continue;
        gsl_test_rel(answer_of(&other, images[i].even), answer_of(&one, images[i].even), 1e-9,
                     "%s, %s: %s of the mirror image is the same", images[i].base, e->name,
                     images[i].even);
        if (images[i].odd != NULL)
            gsl_test_rel(answer_of(&other, images[i].odd), -answer_of(&one, images[i].odd), 1e-9,
                         "%s, %s: %s of the mirror image is opposite", images[i].base, e->name,
                         images[i].odd);
    }
    ask_conclude(&tally, e, "mirror images");
}

static void thirds(const element_type *e)
{
    static answer a;
    ask_tally tally = {0};
    int compared = 0;
    ask(&(question){case_find("spherical_joint", NULL), "steps=6", e, 1, 0, unchanged}, &a);
    if (ask_count(&tally, &a, "spherical_joint"))
        for (int i = 0; i < a.count; i++)
            for (int k = 0; k + 2 < a.points[i]; k++, compared++)
                gsl_test_rel(a.curve[i][k + 2], a.curve[i][k], 1e-8,
                             "spherical_joint, %s: the same stiffness a third of a turn on",
                             e->name);
    gsl_test(a.outcome == ASK_ANSWERED && compared == 0, "spherical_joint, %s: has curves",
             e->name);
    ask_conclude(&tally, e, "thirds of a turn");
}

static double asymmetry(const answer *a)
{
    static const char *const response[] = {"ux", "uy", "uz", "thx", "thy", "thz"};
    static const char *const load[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
    double C[6][6], worst = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            char name[SCENE_NAME];
            snprintf(name, sizeof name, "C_%s_%s", response[i], load[j]);
            C[i][j] = answer_of(a, name);
        }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < i; j++)
            worst = worst_of(worst, fabs(C[i][j] - C[j][i]) / sqrt(fabs(C[i][i] * C[j][j])));
    return worst;
}

static void reciprocity(const element_type *e)
{
    static const char *const convention[] = {"moment_convention=semitangential",
                                             "moment_convention=spatial"};
    const case_type *type = case_find("sheet_wagner", NULL);
    ask_tally tally = {0};
    double apart[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        static answer a;
        ask(&(question){type, convention[k], e, 3, 0, unchanged}, &a);
        if (ask_count(&tally, &a, "sheet_wagner, %s", convention[k]))
            apart[k] = asymmetry(&a);
    }
    ask_conclude(&tally, e, "reciprocity");
    if (tally.count[ASK_ANSWERED] < 2)
        return;
    gsl_test(!(apart[0] < 1e-9),
             "sheet_wagner, %s: compliance under semitangential moments is symmetric (%.1e)",
             e->name, apart[0]);
    gsl_test(!(apart[1] > 1e-6),
             "sheet_wagner, %s: under moments about fixed axes it is not (%.1e)", e->name,
             apart[1]);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++) {
        every_case(registry_formulations[i]);
        mirrors(registry_formulations[i]);
        thirds(registry_formulations[i]);
        reciprocity(registry_formulations[i]);
    }
    return gsl_test_summary();
}
