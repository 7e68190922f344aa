/* What of forces works on what has no inertia: warping amplitudes with and without mass. */
#include "harness/model/model.h"
#include "harness/time/time_impl.h"

#include <gsl/gsl_test.h>
#include <math.h>

#include "harness/formulations/formulations.h"

enum { MASSLESS_MOST = 80 };

/* An I free in space; omit: physics that is left out. */
static void warps(unsigned omit, int heavy)
{
    static const double y[3] = {0, 1, 0}, point[][2] = {{-0.03, 0.05},  {0, 0.05},  {0.03, 0.05},
                                                        {-0.03, -0.05}, {0, -0.05}, {0.03, -0.05}},
                        thick[] = {2e-3, 2e-3, 1e-3, 2e-3, 2e-3};
    static const int walls[][2] = {{0, 1}, {1, 2}, {1, 4}, {3, 4}, {4, 5}};
    section_spec spec = section_spec_walls(2e11, 8e10, 5, point, walls, thick);
    formulation chosen;
    scene s;
    model *m = NULL;
    carried_masses masses;
    fault f = {""};
    double force[MASSLESS_MOST], motion[MASSLESS_MOST], given[MASSLESS_MOST], a[MASSLESS_MOST];
    const double end = 1;
    int massless = 0, seen = 0;
    spec.density = 7800;
    scene_init(&s, "bar");
    const int p = scene_add_node(&s, 0, 0, 0), q = scene_add_node(&s, 1, 0, 0);
    scene_add_member(&s, p, q, scene_add_section(&s, &spec), y);
    scene_omit(&s, omit);
    scene_add_motion(&s, SCENE_NONE, 1, &end,
                     (scene_motion){.step = 1, .start = {.velocity = {0}}});
    gsl_test(formulation_parse("beamw_consistent", &chosen, &f) != STATUS_OK, "%s", f.text);
    const model_request request = {
        .scene = &s, .type = chosen.type, .options = chosen.option, .elements = 2};
    if (model_alloc(&request, &m, &f) != STATUS_OK || carried_alloc(m, &masses, &f) != STATUS_OK) {
        gsl_test(1, "%s", f.text);
        return;
    }
    const model_state *rest = kinematics_rest(m);
    for (int c = 0; c < model_unknowns(m); c++)
        force[c] = motion[c] = given[c] = 2;
    massless_count(m, &masses, rest, &massless, &f);
    massless_forces(m, &masses, rest, force, &f);
    massless_motion(m, &masses, rest, motion, &f);
    massless_accelerate(m, &masses, rest, given, a, &f);
    for (int w = 0; w < model_warps(m); w++) {
        const int c = model_warp(m, w);
        const double mass = masses.warping[c];
        gsl_test((mass > 0) != heavy, "warping %d has mass: %g", w, mass);
        gsl_test_abs(force[c], heavy ? 0 : 2, 0, "force on warping %d, heavy: %d", w, heavy);
        gsl_test_abs(motion[c], heavy ? 0 : 2, 0, "motion of warping %d, heavy: %d", w, heavy);
        gsl_test_abs(a[c], heavy ? 2 / mass : 0, 1e-12 * fabs(a[c]), "acceleration of warping %d",
                     w);
        seen++;
    }
    gsl_test_int(seen, 3, "warping amplitudes");
    gsl_test((massless == 0) != heavy, "%d coordinates have no inertia, heavy: %d", massless,
             heavy);
    carried_free(&masses);
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    warps(0, 1);
    warps(FEATURE_ROTARY_INERTIA, 0);
    return gsl_test_summary();
}
