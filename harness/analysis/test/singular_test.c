/* If a structure can move freely, the analysis must end with SINGULAR, and the message must name
 * the node and its motion. Supported structures must be solved. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/test/kit.h"
#include "harness/analysis/test/moves.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/tools/kit/cells.h"

static void two_beams(scene *s)
{
    const double y[3] = {0, 1, 0}, end = 1;
    const section_spec spec = sections_of(1e4, 4, 1, 1);
    scene_init(s, "two_beams");
    const int profile = scene_add_section(s, &spec);
    for (int i = 0; i < 2; i++) {
        const int first = scene_add_node(s, 0, i, 0), last = scene_add_node(s, 2, i, 0);
        scene_add_member(s, first, last, profile, y);
        scene_add_load(s, SCENE_FORCE, last, 0, 0, 0.01);
    }
    scene_hold_all(s, 0);
    scene_hold_all(s, 2);
    scene_add_static(s, 1, &end, 1);
}

static void let_go(scene *s, int node, int first, int last)
{
    for (int k = first; k <= last; k++)
        *(k < SCENE_RX ? &scene_node_at(s, node)->translation[k]
                       : &scene_node_at(s, node)->angle[k - SCENE_RX]) = SCENE_FREE;
}

static void everywhere(scene *s)
{
    let_go(s, 2, SCENE_UX, SCENE_RZ);
}
static void along(scene *s)
{
    let_go(s, 2, SCENE_UX, SCENE_UX);
}
static void about_itself(scene *s)
{
    let_go(s, 2, SCENE_RX, SCENE_RX);
}
static void about_a_hinge(scene *s)
{
    let_go(s, 2, SCENE_RY, SCENE_RY);
}
static void between_hinges(scene *s)
{
    let_go(s, 2, SCENE_RX, SCENE_RZ);
    scene_hold(s, 3, SCENE_UX, SCENE_UZ);
}
static void between_forks(scene *s)
{
    const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
    let_go(s, 2, SCENE_UX, SCENE_RZ);
    scene_hold(s, 2, SCENE_UY, SCENE_UZ);
    scene_hold(s, 3, SCENE_UY, SCENE_UZ);
    scene_fork(s, 2, x, z);
    scene_fork(s, 3, x, z);
}
static void held_by_forks(scene *s)
{
    between_forks(s);
    scene_hold(s, 3, SCENE_UX, SCENE_UX);
}
static void nothing(scene *s)
{
    (void)s;
}

static const struct {
    const char *what;
    void (*change)(scene *);
    double motion[6];
    int any; /* 1: there are several free motions; the message may name any of them */
} changes[] = {
    {"all is held", nothing, {0}, 0},
    {"nothing holds it", everywhere, {0}, 1},
    {"free along x", along, {1, 0, 0, 0, 0, 0}, 0},
    {"free to turn about itself", about_itself, {0, 0, 0, 1, 0, 0}, 0},
    {"a hinge at its root", about_a_hinge, {0, 0, 0, 0, 1, 0}, 0},
    {"hinges at both ends", between_hinges, {0, 0, 0, 1, 0, 0}, 0},
    {"forks that slide", between_forks, {1, 0, 0, 0, 0, 0}, 0},
    {"forks that are held", held_by_forks, {0}, 0},
};

static void supports(const char *formulation_text, int elements)
{
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        const double *expected = changes[i].motion;
        const int loose = changes[i].any || vec3_norm(expected) + vec3_norm(expected + 3) > 0;
        double motion[6] = {0}, largest = 0;
        int node = -1;
        scene s;
        model *m = NULL;
        solve_result r = {0};
        formulation fm;
        fault f = {""};
        two_beams(&s);
        changes[i].change(&s);
        formulation_parse(formulation_text, &fm, &f);
        const model_request what = {&s, fm.type, fm.option, elements, 0, 0};
        gsl_test(scene_validate(&s, &f) != STATUS_OK || model_alloc(&what, &m, &f) != STATUS_OK,
                 "%s: %s", changes[i].what, f.text);
        gsl_test_int(supports_loose_part(m, &node, motion), loose, "%s", changes[i].what);
        gsl_test(loose && node != 2, "%s: node %d is named", changes[i].what, node);
        for (int k = 0; k < 6; k++)
            largest = fmax(largest, fabs(motion[k]));
        if (loose && !changes[i].any)
            for (int k = 0; k < 6; k++)
                gsl_test(!(fabs(fabs(motion[k]) / largest - expected[k]) <= 1e-9),
                         "%s: component %d of the motion is %g", changes[i].what, k,
                         motion[k] / largest);
        const status outcome = solve_scene(&s, m, NULL, &r, &f);
        gsl_test_int((int)outcome, loose ? STATUS_SINGULAR : STATUS_OK, "%s, %s: %s",
                     changes[i].what, formulation_text, f.text);
        gsl_test(loose &&
                     strstr(f.text,
                            "neither node 2 at (0, 1, 0) nor any part joined to it is supported") ==
                         NULL,
                 "%s: the culprit is named: %s", changes[i].what, f.text);
        result_free(&r);
        model_free(m);
        scene_free(&s);
    }
}

static status run(const char *case_name, const char *formulation_text, int elements,
                  const char *assignment, cell_result *out, fault *f)
{
    cell_request request = cells_of(case_find(case_name, NULL), formulation_text, elements);
    if (assignment[0] != '\0')
        cells_set(&request, (const char *const[]){assignment, NULL});
    return cell_run(&request, out, f);
}

static void all_cases_are_held(void)
{
    for (int i = 0; registry_cases[i] != NULL; i++) {
        scene s;
        model *m = NULL;
        double value[CASE_MAX_PARAMETERS] = {0}, motion[6];
        int node = -1, tried = 0;
        fault f = {""};
        scene_init(&s, registry_cases[i]->name);
        parameters_default(registry_cases[i], value);
        gsl_test(case_build(registry_cases[i], value, &s, &f) != STATUS_OK, "%s: %s", s.name,
                 f.text);
        for (int k = 0; registry_formulations[k] != NULL && !tried; k++) {
            const model_request what = {&s, registry_formulations[k], NULL, 2, 0, 0};
            tried = model_alloc(&what, &m, &f) == STATUS_OK;
        }
        gsl_test(!tried || (supports_loose_part(m, &node, motion) && !moves_only(&s)),
                 "%s is held (node %d)", s.name, node);
        model_free(m);
        scene_free(&s);
    }
}

static void round_off(void)
{
    static const struct {
        const char *case_name, *formulation, *assignment, *quantity;
        int elements;
        double exact;
    } row[] = {{"sheet_cantilever", "beamw_consistent", "thickness=1e-10", "C_xx", 16, NAN},
               {"sheet_cantilever", "geometrically_exact", "thickness=1e-10", "C_xx", 16, NAN},
               {"warping_torsion", "beamw_vlasov", "", "twist_ratio", 20000, 0.23840584404423515}};
    int lost = 0;
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        cell_result r;
        fault f = {""};
        const status outcome =
            run(row[i].case_name, row[i].formulation, row[i].elements, row[i].assignment, &r, &f);
        gsl_test(strstr(f.text, "not held") != NULL || strstr(f.text, "critical") != NULL,
                 "%s, n = %d: %s", row[i].case_name, row[i].elements, f.text);
        gsl_test(outcome == STATUS_SINGULAR && strstr(f.text, "round-off") == NULL,
                 "%s, n = %d: the cause is named: %s", row[i].case_name, row[i].elements, f.text);
        gsl_test(outcome != STATUS_OK && outcome != STATUS_SINGULAR &&
                     outcome != STATUS_NOT_CONVERGED,
                 "%s: a reported failure", row[i].case_name);
        const int evaluated = outcome == STATUS_OK && !isnan(row[i].exact) ? r.solve.quantities : 0;
        for (int k = 0; k < evaluated; k++)
            if (strcmp(r.scene.quantity[k].name, row[i].quantity) == 0)
                gsl_test_rel(r.solve.quantity[k].value, row[i].exact, 1e-5,
                             "%s: an answer is right", row[i].case_name);
        lost += outcome == STATUS_SINGULAR;
        cell_result_free(&r);
    }
    gsl_test(lost < 2, "%d were lost in round-off", lost);
}

static void driver_that_moves_nothing(double half_angle, int condition_component)
{
    const double c = cos(half_angle), d = sin(half_angle), z[3] = {0, 0, 1}, path[2] = {0, 1},
                 value[2] = {0, 0.01}, end = 1;
    const int meets = condition_component == SCENE_UX;
    scene s;
    model *m = NULL;
    solve_result r = {0};
    formulation fm;
    fault f = {""};
    const section_spec spec = sections_of(1e4, 4, 1, 1);
    scene_init(&s, "v");
    const int profile = scene_add_section(&s, &spec), apex = scene_add_node(&s, c, 0, 0),
              tip = scene_add_node(&s, c + 0.3, 0, 0);
    for (int i = 0; i < 2; i++) {
        const int root = scene_add_node(&s, 0, i == 0 ? d : -d, 0);
        scene_hold_all(&s, root);
        scene_member_at(&s, scene_add_member(&s, root, apex, profile, z))->divisions =
            i == 0 ? 1 : 3;
    }
    scene_add_member(&s, apex, tip, profile, z);
    const int known = scene_add_driver(&s, "known", 2, path, value);
    scene_drive(&s, apex, condition_component, known);
    scene_drive(&s, tip, SCENE_UX,
                scene_add_unknown_driver(&s, "unknown", apex, condition_component, known));
    scene_add_static(&s, 1, &end, 1);
    formulation_parse("collocation", &fm, &f);
    const model_request what = {&s, fm.type, fm.option, 1, 0, 0};
    gsl_test(scene_validate(&s, &f) != STATUS_OK || model_alloc(&what, &m, &f) != STATUS_OK,
             "V: %s", f.text);
    const status outcome = solve_scene(&s, m, NULL, &r, &f);
    gsl_test_int((int)outcome, meets ? STATUS_OK : STATUS_SINGULAR, "V of %g, condition on %d: %s",
                 half_angle, condition_component, f.text);
    gsl_test(!meets && strstr(f.text, "does not move") == NULL, "the cause is named: %s", f.text);
    result_free(&r);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    static const double half_angle[] = {0.3, 0.61, 0.87, 1.13};
    for (size_t i = 0; i < sizeof half_angle / sizeof half_angle[0]; i++) {
        driver_that_moves_nothing(half_angle[i], SCENE_UX);
        driver_that_moves_nothing(half_angle[i], SCENE_UY);
    }
    supports("beamw_consistent", 2);
    supports("collocation", 4);
    supports("geometrically_exact", 3);
    all_cases_are_held();
    round_off();
    return gsl_test_summary();
}
