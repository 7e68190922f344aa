#include "harness/tools/kit/cells.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "harness/formulations/formulations.h"

cell_request cells_of(const case_type *type, const char *formulation_text, int elements)
{
    cell_request request = {.type = type, .elements = elements};
    formulation chosen;
    fault f = {""};
    const status found = formulation_parse(formulation_text, &chosen, &f);
    gsl_test(type == NULL || found != STATUS_OK,
             "the case or the formulation %s does not exist: %s", formulation_text, f.text);
    if (type != NULL)
        parameters_default(type, request.parameter);
    if (found == STATUS_OK)
        cell_formulation(&request, &chosen);
    return request;
}

void cells_set(cell_request *request, const char *const assignment[])
{
    fault f = {""};
    for (int i = 0; assignment != NULL && assignment[i] != NULL; i++)
        gsl_test(parameters_set(request->type, assignment[i], request->parameter, &f) != STATUS_OK,
                 "%s, %s: %s", request->type->name, assignment[i], f.text);
}

double cells_value(const cell_result *r, const char *quantity)
{
    for (int i = 0; i < r->solve.quantities; i++)
        if (strcmp(r->scene.quantity[i].name, quantity) == 0)
            return r->solve.quantity[i].value;
    return NAN;
}

void cells_solve(status (*build)(const double value[], scene *, fault *),
                 const char *formulation_text, int elements, cell_result *r)
{
    static const parameter_type none[] = {{0}};
    const case_type type = {.name = "of_the_test",
                            .summary = "a case of the test",
                            .source = "none",
                            .parameters = {none},
                            .build = build};
    const cell_request request = cells_of(&type, formulation_text, elements);
    fault f = {""};
    gsl_test(cell_run(&request, r, &f) != STATUS_OK, "%s solved: %s", formulation_text, f.text);
}
