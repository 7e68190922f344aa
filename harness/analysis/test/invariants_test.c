/* What needs no truth, for every formulation on every case it runs on: the same mesh in other
 * words, mirror images, turned symmetric structures, reciprocity. A number that is compared is
 * relative to its size. Two discretisations of the same continuum may differ, but the difference
 * falls with the mesh. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/registry.h"
#include "harness/study/test/ask.h"

/* Largest relative difference of all values that exist, and whose. Frequencies of a mesh without
 * such a mode exist in neither. */
static double difference(const answer *a, const answer *b, const char **whose)
{
    double worst = a->count == b->count ? 0 : INFINITY;
    *whose = "their number";
    for (int i = 0; i < a->count && i < b->count; i++) {
        const double size = fmax(fmax(fabs(a->value[i]), fabs(b->value[i])), a->scale[i]);
        const double apart = isnan(a->value[i]) && isnan(b->value[i]) ? 0
                             : size > 0 ? fabs(a->value[i] - b->value[i]) / size
                                        : 0;
        if (!(apart <= worst)) {
            worst = apart;
            *whose = a->name[i];
        }
    }
    return worst;
}

/* Few stations, where a case lets one choose. */
static const char *short_path(const case_type *type)
{
    for (int i = 0; type->parameters[i].name != NULL; i++)
        if (strcmp(type->parameters[i].name, "steps") == 0)
            return type->parameters[i].max >= 3 ? "steps=3" : "";
    return "";
}

/* One formulation on one case: an edit of the scene changes nothing. */
static void same(const case_type *type, const element_type *formulation_type, const char *what,
                 int n, int other_n, scene_edit edit, double tolerance)
{
    static answer before, after;
    const char *whose;
    ask(type, short_path(type), formulation_type, n, 0, (scene_edit){SCENE_EDIT_NONE, 0}, &before);
    if (before.count == 0)
        return; /* not offered */
    ask(type, short_path(type), formulation_type, other_n, 0, edit, &after);
    if (after.status == STATUS_REFUSED)
        return; /* the edit is not defined for this scene */
    const double apart = difference(&before, &after, &whose);
    gsl_test(!(apart <= tolerance), "%s, %s: %s (%s, %.1e)%s%s", type->name, formulation_type->name,
             what, whose, apart, after.status != STATUS_OK ? " " : "", after.reason);
}

/* Amplitudes of warping that are kept where nothing warps make the twist of some formulations a
 * cubic: a better mesh, and the same continuum. */
static void keep_all(const case_type *type, const element_type *e)
{
    static const int n[2] = {4, 16};
    static answer lean, full;
    const scene_edit none = {SCENE_EDIT_NONE, 0};
    double apart[2] = {0, 0};
    const char *whose = "";
    for (int k = 0; k < 2; k++) {
        ask(type, short_path(type), e, n[k], 0, none, &lean);
        if (lean.count == 0)
            return;
        ask(type, short_path(type), e, n[k], 1, none, &full);
        apart[k] = difference(&lean, &full, &whose);
        if (apart[k] <= 1e-8)
            break;
    }
    gsl_test(
        !(apart[0] <= 1e-8 || apart[1] <= apart[0] / 8),
        "%s, %s: keeping what a scene leaves out changes nothing but the mesh (%s, %.1e, %.1e)",
        type->name, e->name, whose, apart[0]);
}

static void every_case(const element_type *e)
{
    for (int i = 0; registry_cases[i] != NULL; i++) {
        static answer whole;
        const case_type *type = registry_cases[i];
        keep_all(type, e);
        if (!(e->limits & LIMIT_ORDER_DEPENDENT)) /* by a discretisation error, which the sweep of
                                                     extremes shows */
            same(type, e, "the other order of nodes changes nothing", 2, 2,
                 (scene_edit){SCENE_EDIT_REVERSE, 0}, 1e-8);
        same(type, e, "another unit of length changes nothing", 2, 2,
             (scene_edit){SCENE_EDIT_UNIT, 1000}, 1e-8);
        ask(type, short_path(type), e, 1, 0, (scene_edit){SCENE_EDIT_NONE, 0}, &whole);
        if (whole.members == 1)
            same(type, e, "two members of two elements are one of four", 4, 2,
                 (scene_edit){SCENE_EDIT_SPLIT, 0.5}, 1e-8);
    }
}

/* An image of the structure in a mirror: which values change their sign. */
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
    for (size_t i = 0; i < sizeof images / sizeof images[0]; i++) {
        static answer one, other;
        const scene_edit none = {SCENE_EDIT_NONE, 0};
        const case_type *type = case_find(images[i].base, NULL);
        ask(type, images[i].one, e, 3, 0, none, &one);
        ask(type, images[i].other, e, 3, 0, none, &other);
        if (one.count == 0)
            continue;
        gsl_test_rel(value_of(&other, images[i].even), value_of(&one, images[i].even), 1e-9,
                     "%s, %s: %s of the mirror image is the same", images[i].base, e->name,
                     images[i].even);
        if (images[i].odd != NULL)
            gsl_test_rel(value_of(&other, images[i].odd), -value_of(&one, images[i].odd), 1e-9,
                         "%s, %s: %s of the mirror image is opposite", images[i].base, e->name,
                         images[i].odd);
    }
}

/* Three equal folds: turned by a third of a turn, the joint is the same joint. */
static void thirds(const element_type *e)
{
    cell_result result;
    formulation chosen;
    fault f = {""};
    cell_request request = {
        .type = case_find("spherical_joint", &f), .formulation = e, .elements = 1};
    formulation_default(e, &chosen);
    memcpy(request.option, chosen.option, sizeof request.option);
    parameters_default(request.type, request.parameter);
    parameters_set(request.type, "steps=6", request.parameter, &f);
    if (cell_run(&request, &result, &f) == STATUS_OK)
        for (int i = 0; i < result.solve.quantities; i++) {
            const curve *c = &result.solve.quantity[i].curve;
            for (int k = 0; k + 2 < c->points; k++)
                gsl_test_rel(c->value[k + 2], c->value[k], 1e-8,
                             "spherical_joint, %s: the same stiffness a third of a turn on",
                             e->name);
        }
    cell_result_free(&result);
}

/* Maxwell and Betti hold for loads that have a potential: semitangential moments, and not moments
 * about fixed axes. */
static void reciprocity(const element_type *e)
{
    static const char *const response[] = {"ux", "uy", "uz", "thx", "thy", "thz"}, *const load[] = {
                                                                                       "Fx", "Fy",
                                                                                       "Fz", "Mx",
                                                                                       "My", "Mz"};
    static const char *const convention[] = {"moment_convention=semitangential",
                                             "moment_convention=spatial"};
    const case_type *type = case_find("sheet_wagner", NULL);
    double apart[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        static answer a;
        ask(type, convention[k], e, 3, 0, (scene_edit){SCENE_EDIT_NONE, 0}, &a);
        if (a.count == 0)
            return;
        double C[6][6];
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++) {
                char name[SCENE_NAME];
                snprintf(name, sizeof name, "C_%s_%s", response[i], load[j]);
                C[i][j] = value_of(&a, name);
            }
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < i; j++)
                apart[k] = fmax(apart[k], fabs(C[i][j] - C[j][i]) / sqrt(fabs(C[i][i] * C[j][j])));
    }
    if (e->limits & LIMIT_UNSYMMETRIC_TANGENT)
        gsl_test(
            !(apart[0] > 1e-6),
            "sheet_wagner, %s: its tangent is not symmetric, and the compliance shows it (%.1e)",
            e->name, apart[0]);
    else
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
