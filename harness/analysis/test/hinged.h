/* A bar that only bends, twists and stretches, and the solution of a scene of it: for tests of hinges. */
#ifndef BEAMWORK_TEST_HINGED_H
#define BEAMWORK_TEST_HINGED_H

#include <gsl/gsl_test.h>
#include <string.h>

#include "elements/test/sections.h"
#include "harness/catalogue/formulations.h"
#include "harness/study/cell.h"

static const double y_axis[3] = {0, 1, 0}, EI = 7.1, EA = 7e6, mass = 0.7;
static inline int add_section(scene *s)
{
    section_spec spec = sections_of(EA, 2 * EI, EI, EI);
    spec.density = mass / EA;
    return scene_add_section(s, &spec);
}

static inline void solve(status (*build)(const double[], scene *, fault *), const char *chosen,
                         int n, cell_result *r)
{
    static const parameter_type none[] = {{.name = NULL}};
    const case_type type = {.name = "hinges",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = build};
    cell_request request = {.type = &type, .elements = n};
    formulation fm;
    fault f = {""};
    gsl_test(formulation_parse(chosen, &fm, &f) != STATUS_OK, "%s exists", chosen);
    request.formulation = fm.type;
    request.solve.newton = formulation_newton(&fm);
    memcpy(request.option, fm.option, sizeof request.option);
    gsl_test(cell_run(&request, r, &f) != STATUS_OK, "%s solved: %s", chosen, f.text);
}

#endif
