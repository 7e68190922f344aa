#include "harness/truth/findings.h"

#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/registry.h"
#include "harness/truth/columns.h"

static status check_finding(const columns *r, finding *row, int i, char *const case_name[], char *const parameters[])
{
    fault why = {""};
    for (int k = 0; registry_cases[k] != NULL; k++)
        if (strcmp(registry_cases[k]->name, case_name[i]) == 0)
            row[i].type = registry_cases[k];
    if (row[i].type != NULL && parameters_parse(row[i].type, parameters[i], row[i].parameter, row[i].any, &why) != STATUS_OK)
        return fault_set(r->f, STATUS_FAULT, "%s: finding %d: %.200s", r->path, i + 1, why.text);
    return STATUS_OK;
}

status findings_read(const char *path, hid_t file, truths *out, fault *f)
{
    static const columns_field field[] = {{"formulation", 1, offsetof(finding, formulation)},
                                          {"quantity", 1, offsetof(finding, quantity)},
                                          {"verdict", 1, offsetof(finding, verdict)},
                                          {"proof", 1, offsetof(finding, proof)},
                                          {"limit", 0, offsetof(finding, limit)},
                                          {"uncertainty", 0, offsetof(finding, uncertainty)}};
    columns r = {.path = path, .name = "findings", .f = f};
    r.group = H5Gopen2(file, "findings", H5P_DEFAULT);
    r.rows = r.group >= 0 ? columns_length(r.group, "verdict") : -1;
    if (r.rows < 0) {
        H5Gclose(r.group);
        return columns_broken(&r, "verdict");
    }
    char **case_name = calloc((size_t)r.rows + 1, sizeof *case_name), **parameters = calloc((size_t)r.rows + 1, sizeof *parameters);
    out->finding = calloc((size_t)r.rows + 1, sizeof *out->finding);
    status outcome = STATUS_OK;
    if (case_name == NULL || parameters == NULL || out->finding == NULL)
        outcome = fault_set(f, STATUS_FAULT, "out of memory for findings");
    else
        out->findings = r.rows;
    for (size_t k = 0; k < sizeof field / sizeof field[0] && outcome == STATUS_OK; k++)
        outcome = columns_read(&r, &field[k], out->finding, sizeof *out->finding);
    if (outcome == STATUS_OK)
        outcome = columns_strings(&r, "case", case_name);
    if (outcome == STATUS_OK)
        outcome = columns_strings(&r, "parameters", parameters);
    for (int i = 0; i < r.rows && outcome == STATUS_OK; i++)
        outcome = check_finding(&r, out->finding, i, case_name, parameters);
    for (int i = 0; i < r.rows && case_name != NULL && parameters != NULL; i++) {
        free(case_name[i]);
        free(parameters[i]);
    }
    free(case_name);
    free(parameters);
    H5Gclose(r.group);
    return outcome;
}
