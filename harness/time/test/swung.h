/* Motions of swung.yaml. */
#ifndef BEAMWORK_SWUNG_H
#define BEAMWORK_SWUNG_H

#include <gsl/gsl_test.h>
#include <stdarg.h>
#include <stdio.h>

#include "harness/formulations/formulation.h"
#include "harness/formulations/parameters.h"
#include "harness/study/cell.h"
#include "harness/tools/kit/scenes.h"

#define SWUNG "harness/time/test/swung.yaml"

/* At "name=value;..."; what became of it is its status. */
static inline status swung_try(const char *values, cell_result *out, fault *f)
{
    cell_request request = {.type = scenes_case(SWUNG), .elements = 1};
    formulation chosen;
    formulation_default(formulation_find("collocation"), &chosen);
    cell_formulation(&request, &chosen);
    scenes_at(request.type, request.parameter, "%s", values);
    return cell_run(&request, out, f);
}

__attribute__((format(printf, 2, 3))) static inline void swung_solve(cell_result *out,
                                                                     const char *values, ...)
{
    char text[PARAMETERS_TEXT];
    fault f = {""};
    va_list list;
    va_start(list, values);
    vsnprintf(text, sizeof text, values, list);
    va_end(list);
    gsl_test(swung_try(text, out, &f) != STATUS_OK, "%s: %s", text, out->solve.reason);
}

#endif
