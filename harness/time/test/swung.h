/* A short soft beam that flies, turns, bends and twists, pulled at one end: no mode of it is faster
 * than the steps of these tests. */
#ifndef BEAMWORK_SWUNG_H
#define BEAMWORK_SWUNG_H

#include <gsl/gsl_test.h>
#include <stdio.h>

#include "cases/shared/timed.h"
#include "harness/formulations/formulation.h"
#include "harness/formulations/parameters.h"
#include "harness/study/cell.h"
#include "harness/tools/kit/scenes.h"

typedef struct swung {
    int member, tip, base;
} swung;

static inline swung swung_build(scene *s)
{
    static const double y[] = {0, 1, 0};
    const section_spec spec = timed_profile(&(timed_section){
        .EA = 100, .GA = 60, .GJ = 12, .EI = 10, .mass = 1, .polar = 0.6, .rotary = 0.3});
    swung out;
    out.base = scene_add_node(s, 0, 0, 0);
    out.tip = scene_add_node(s, 1, 0.2, 0.1);
    out.member = scene_add_member(s, out.base, out.tip, scene_add_section(s, &spec), y);
    const int pull = scene_add_load(s, SCENE_FORCE, out.tip, 1, 2, -1.5);
    scene_load_piece(s, pull, 0, "2*sin(3*t)");
    scene_omit(s, FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE);
    return out;
}

static inline scene_motion swung_motion(scene_scheme by, double step)
{
    return (scene_motion){.scheme = by,
                          .alpha = scene_alpha_of_radius(0.9),
                          .step = step,
                          .mass = SCENE_LUMPED, /* as all integrators have it */
                          .start = {.velocity = {0.3, 0, -0.2}, .spin = {0.8, -1.5, 1.1}}};
}

/* What became of it is its status. */
static inline status swung_try(const case_type *type, const double parameter[], int parameters,
                               cell_result *out, fault *f)
{
    cell_request request = {.type = type, .elements = 1};
    formulation chosen;
    formulation_default(formulation_find("collocation"), &chosen);
    cell_formulation(&request, &chosen);
    parameters_default(type, request.parameter);
    for (int i = 0; i < parameters; i++)
        request.parameter[i] = parameter[i];
    return cell_run(&request, out, f);
}

static inline void swung_solve(const case_type *type, const double parameter[], int parameters,
                               cell_result *out)
{
    fault f = {""};
    gsl_test(swung_try(type, parameter, parameters, out, &f) != STATUS_OK, "%s: %s", type->name,
             out->solve.reason);
}

#endif
