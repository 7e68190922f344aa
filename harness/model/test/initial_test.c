/* Initial elongation and shear strains (N Eq. 52): what is free takes them without stress, what is
 * held feels EA g or GA g. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/sections.h"
#include "harness/analysis/analysis.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"

static const char *const names[] = {
    "sheet_second",        "sheet_second_consistent",     "sheet_third", "sheet_third_printed",
    "geometrically_exact", "geometrically_exact:nodes=2", "collocation"};
enum { NAMES = sizeof names / sizeof names[0] };

/* A rectangle of length 2 m, its strains g[3]; held[6]: components of the tip that are held. Values
 * of six coordinates, six reactions. */
static void solve(const char *name, const double g[3], const int held[6], double u[6], double F[6])
{
    static const char *const quantity[12] = {"u0", "u1", "u2", "u3", "u4", "u5",
                                             "F0", "F1", "F2", "F3", "F4", "F5"};
    scene s;
    formulation fm;
    model *m = NULL;
    solve_result r;
    fault f = {""};
    const double y_axis[3] = {0, 1, 0}, end = 1;
    scene_init(&s, "strained");
    section_spec spec = section_spec_rectangle(2e9, 8e8, 0.2, 0.1);
    spec.shear_factor[0] = spec.shear_factor[1] = 5.0 / 6;
    spec.given.Iw = 0;
    const int root = scene_add_node(&s, 0, 0, 0), tip = scene_add_node(&s, 2, 0, 0);
    const int member = scene_add_member(&s, root, tip, scene_add_section(&s, &spec), y_axis);
    memcpy(scene_member_at(&s, member)->strain, g, sizeof scene_member_at(&s, member)->strain);
    scene_hold_all(&s, root);
    scene_omit(&s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA);
    const int path = scene_add_static(&s, 1, &end, 1);
    for (int i = 0; i < 6; i++)
        if (held[i])
            scene_hold(&s, tip, i, i);
    for (int i = 0; i < 12; i++) {
        scene_add_quantity(&s, quantity[i], "1", path,
                           i < 6 ? scene_coordinate(tip, i) : scene_reaction(tip, i - 6));
    }
    gsl_test(formulation_parse(name, &fm, &f) != STATUS_OK, "%s exists", name);
    const model_request what = {&s, fm.type, fm.option, 3, 0};
    status outcome = model_alloc(&what, &m, &f);
    if (outcome == STATUS_OK) {
        outcome = solve_scene(&s, m, NULL, &r, &f);
        if (outcome == STATUS_OK)
            for (int i = 0; i < 6; i++) {
                u[i] = r.quantity[i].value;
                F[i] = r.quantity[6 + i].value;
            }
        result_free(&r);
    }
    gsl_test(outcome != STATUS_OK, "%s: %s", name, f.text);
    model_free(m);
    scene_free(&s);
}

static void elongation(const char *name)
{
    const double g[3] = {1e-3, 0, 0}, EA = 2e9 * 0.02;
    const int loose[6] = {0}, held[6] = {1, 1, 1, 1, 1, 1};
    double u[6] = {0}, F[6] = {0};
    solve(name, g, loose, u, F);
    gsl_test_rel(u[0], 2e-3, 1e-12, "%s: a free end moves by L g", name);
    gsl_test_abs(F[0] / EA, 0, 1e-14, "%s: without stress", name);
    solve(name, g, held, u, F);
    gsl_test_rel(F[0], -EA * 1e-3, 1e-12, "%s: held at both ends it pushes with EA g", name);
}

/* Sections slide against each other: the axis is inclined to the sections, which do not turn. */
static void shear(const char *name, int direction)
{
    double g[3] = {0}, u[6] = {0}, F[6] = {0};
    const double GA = 5.0 / 6 * 8e8 * 0.02, small = 1e-6;
    const int loose[6] = {0}, held[6] = {1, 1, 1, 1, 1, 1};
    g[direction] = small;
    solve(name, g, loose, u, F);
    gsl_test_rel(u[direction], 2 * small, 1e-5, "%s: a free end slides by L g along %c", name,
                 "xyz"[direction]);
    gsl_test_abs(u[direction == 1 ? 5 : 4] / small, 0, 1e-5, "%s: and does not turn", name);
    solve(name, g, held, u, F);
    /* Timoshenko's clamped beam under the imposed sliding L g: 12 EI L g/(L^3 (1 + Phi)). */
    const double EI = 2e9 * (direction == 1 ? 0.2 * 0.1 * 0.1 * 0.1 : 0.1 * 0.2 * 0.2 * 0.2) / 12,
                 L = 2;
    const double Phi = 12 * EI / (GA * L * L), expected = -12 * EI * small / (L * L * (1 + Phi));
    gsl_test_rel(F[direction], expected, 1e-5, "%s: held, along %c", name, "xyz"[direction]);
}

static void not_offered(void)
{
    formulation fm;
    char words[100];
    scene s;
    scene_init(&s, "strained");
    gsl_test(formulation_parse("beamw", &fm, NULL) != STATUS_OK, "beamw exists");
    scene_member_at(&s, scene_add_member(&s, 0, 0, 0, (const double[3]){0, 1, 0}))->strain[0] =
        1e-3;
    gsl_test(!missing_words(&s, fm.type, words, sizeof words) || strstr(words, "initial") == NULL,
             "a formulation without it is told: %s", words);
    scene_free(&s);
}

/* The energy of an element is counted from where it is without stress, whatever its arc. */
static void no_energy_at_rest(const char *name)
{
    static const double none[ELEMENT_MAX_STRAINS] = {0};
    double inner[1024] = {0}, energy = NAN;
    formulation chosen;
    fault f = {""};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.05, 0.001);
    const section c = sections_computed(&spec);
    gsl_test(formulation_parse(name, &chosen, &f) != STATUS_OK, "%s", f.text);
    const double length = 0.3;
    const element_request request = {.section = &c,
                                     .length = length,
                                     .features =
                                         chosen.type->offers & ~(unsigned)FEATURE_WAGNER_TORQUE,
                                     .options = chosen.option,
                                     .curvature = {0.2, 0.3, 0.9}};
    element_data *data = calloc(1, chosen.type->data_size(&request));
    gsl_test(chosen.type->prepare(&request, data, &f) != STATUS_OK, "%s: %s", name, f.text);
    if (chosen.type->rest != NULL)
        chosen.type->rest(data, inner);
    chosen.type->stress(data, none, inner, &(stress_output){.energy = &energy});
    const double bending = c.young * c.Iz * 0.9 * 0.9 * length / 2;
    gsl_test(!(fabs(energy) <= 1e-12 * bending),
             "%s: energy at rest, by that of straightening it: %.1e", name, energy / bending);
    free(data);
}

int main(void)
{
    for (int i = 0; i < NAMES; i++) {
        no_energy_at_rest(names[i]);
        elongation(names[i]);
        if (strncmp(names[i], "sheet_third", 11) !=
            0) /* N Eq. 50 knows no shear along the thickness: refused */
            shear(names[i], 1);
        shear(names[i], 2);
    }
    not_offered();
    return gsl_test_summary();
}
