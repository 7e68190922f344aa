#ifndef BEAMWORK_TEST_HINGED_H
#define BEAMWORK_TEST_HINGED_H

#include <gsl/gsl_test.h>

#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"
#include "harness/tools/kit/cells.h"

static const double y_axis[3] = {0, 1, 0}, EI = 7.1, EA = 7e6, mass = 0.7;
static inline int add_section(scene *s)
{
    section_spec spec = sections_of(EA, 2 * EI, EI, EI);
    spec.density = mass / EA;
    return scene_add_section(s, &spec);
}

/* Returns the zero of g between a and b, found by bisection. */
static inline double hinged_zero(double (*g)(double), double a, double b)
{
    for (int i = 0; i < 200; i++) {
        const double c = (a + b) / 2;
        *(g(a) * g(c) <= 0 ? &b : &a) = c;
    }
    return (a + b) / 2;
}

#endif
