/* The size of a correction sees every coordinate: translations by the size of the scene, turns
 * in radians, amplitudes of warping times that size; and the rigid motion that is left loose is
 * one that the supports allow. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "harness/formulations/formulations.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

static const double length = 2;

/* A member along x that warps; what holds its far end. */
static int warping_member(const element_type *type, int first, int last, scene *s, model **m)
{
    const double y[3] = {0, 1, 0}, end = 1;
    fault f = {""};
    section_spec spec = section_spec_rectangle(1e4, 4e3, 0.2, 0.05);
    scene_init(s, "member");
    const int p = scene_add_node(s, 0, 0, 0), q = scene_add_node(s, length, 0, 0);
    scene_add_member(s, p, q, scene_add_section(s, &spec), y);
    if (first <= last)
        scene_hold(s, q, first, last);
    scene_add_static(s, 1, &end, 1);
    const model_request request = {s, type, NULL, 3, 0};
    const status made = model_alloc(&request, m, &f);
    gsl_test(made != STATUS_OK, "%s: %s", type->name, f.text);
    return made == STATUS_OK;
}

/* Size of a correction of one coordinate alone. */
static double size_of(model *m, int coordinate, double step)
{
    const model_size size = model_sizes(m);
    const size_t n = (size_t)(size.free + size.driven);
    double *dx = calloc(n, sizeof *dx), *residual = calloc(n, sizeof *residual), out = NAN;
    model_state *s;
    fault f = {""};
    run_state run;
    model_linearisation lin = {.residual = residual};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    if (kinematics_state_alloc(m, &s, &f) == STATUS_OK &&
        linearise_state(&eq, &run.memory, s, &lin, &f) == STATUS_OK) {
        dx[coordinate] = step;
        out = advance_state(&eq, &run.memory, s, dx, 0, NULL);
    }
    run_state_end(&run);
    kinematics_state_free(s);
    free(dx);
    free(residual);
    return out;
}

static void corrections(const element_type *type)
{
    scene s;
    model *m = NULL;
    const double step = 1e-5;
    if (warping_member(type, SCENE_UX, SCENE_RZ, &s, &m)) {
        int translations = 0, turns = 0, amplitudes = 0;
        const int n = model_sizes(m).free;
        for (int k = 0; k < n; k++) {
            const double size = size_of(m, k, step) / step;
            const int translation = fabs(size * length - 1) < 1e-9, turn = fabs(size - 1) < 1e-9,
                      warp = fabs(size - length) < 1e-9;
            /* what is inside an element counts too */
            gsl_test(type->inner != NULL ? !(size > 0.4 / length) : translation + turn + warp != 1,
                     "%s: coordinate %d counts as %g", type->name, k, size);
            gsl_test(!isnan(size_of(m, k, NAN)), "%s: coordinate %d may be no number", type->name,
                     k);
            translations += translation;
            turns += turn;
            amplitudes += warp;
        }
        gsl_test(type->inner == NULL && turns != translations, "%s: as many turns as translations",
                 type->name);
        gsl_test(type->inner == NULL && (type->offers & FEATURE_WARPING) && amplitudes == 0,
                 "%s: amplitudes of warping count", type->name);
    }
    model_free(m);
    scene_free(&s);
}

/* Held at the far end in its translations: what is left turns about it. */
static void loose_about_the_far_end(const element_type *type)
{
    scene s;
    model *m = NULL;
    const double arm[3] = {length, 0, 0};
    if (warping_member(type, SCENE_UX, SCENE_UZ, &s, &m)) {
        int node = -1;
        double motion[6], there[3];
        gsl_test(!supports_loose_part(m, &node, motion) || node != 0, "%s: it is loose",
                 type->name);
        vec3_cross(motion + 3, arm, there);
        for (int i = 0; i < 3; i++)
            gsl_test_abs(motion[i] + there[i], 0, 1e-12, "%s: the held end stays, direction %d",
                         type->name, i);
        gsl_test(!(vec3_norm(motion + 3) > 1e-3), "%s: it turns", type->name);
    }
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    for (int i = 0; registry_formulations[i] != NULL; i++)
        corrections(registry_formulations[i]);
    loose_about_the_far_end(registry_formulations[0]);
    return gsl_test_summary();
}
