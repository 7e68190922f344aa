/* All values of one cell, for tests that compare answers with each other. */
#ifndef BEAMWORK_TEST_ASK_H
#define BEAMWORK_TEST_ASK_H

#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/catalogue/formulations.h"
#include "harness/catalogue/parameters.h"
#include "harness/study/cell.h"

enum { MOST_QUANTITIES = 256 };

/* Values of a cell; count 0: it was not solved, or the formulation does not offer it. */
typedef struct answer {
    int count, members;
    status status;
    double value[MOST_QUANTITIES], scale[MOST_QUANTITIES];
    char name[MOST_QUANTITIES][SCENE_NAME], reason[FAULT_TEXT];
} answer;

static inline void ask(const case_type *type, const char *parameters, const element_type *formulation_type, int n, int keep_all,
                       scene_edit edit, answer *out)
{
    cell_request request = {.type = type, .formulation = formulation_type, .elements = n, .keep_all = keep_all, .edit = edit};
    cell_result result;
    formulation chosen;
    fault f = {""};
    memset(out, 0, sizeof *out);
    formulation_default(formulation_type, &chosen);
    memcpy(request.option, chosen.option, sizeof request.option);
    parameters_default(type, request.parameter);
    if (parameters_parse(type, parameters, request.parameter, NULL, &f) != STATUS_OK)
        gsl_test(1, "%s", f.text);
    out->status = cell_run(&request, &result, &f);
    snprintf(out->reason, sizeof out->reason, "%s", f.text);
    out->members = result.scene.members;
    for (int i = 0; out->status == STATUS_OK && i < result.solve.quantities && i < MOST_QUANTITIES; i++) {
        out->value[i] = result.solve.quantity[i].value;
        out->scale[i] = result.scene.quantity[i].near_zero;
        snprintf(out->name[i], SCENE_NAME, "%s", result.scene.quantity[i].name);
        out->count = i + 1;
    }
    cell_result_free(&result);
}

static inline double value_of(const answer *a, const char *quantity)
{
    for (int i = 0; i < a->count; i++)
        if (strcmp(a->name[i], quantity) == 0)
            return a->value[i];
    return NAN;
}

#endif
