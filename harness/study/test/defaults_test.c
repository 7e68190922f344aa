/* reference/defaults.csv, which the programs of reference/derive read, must agree with the
 * parameter tables of the cases: the same parameters in the same order, with the same numbers and
 * words. The last parameters of each case, for omitted physics and for the location of mass, are
 * not in the file, because the derivations do not use them. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"

enum { LINE = 512 };

static int total(void)
{
    int count = 0;
    for (int i = 0; registry_cases[i] != NULL; i++)
        count += parameters_of_source(registry_cases[i]);
    return count;
}

static const case_type *case_of(const char *name)
{
    for (int i = 0; registry_cases[i] != NULL; i++)
        if (strcmp(registry_cases[i]->name, name) == 0)
            return registry_cases[i];
    return NULL;
}

static void check_row(const char *line, const case_type *type, int at, const char *name,
                      const char *number, const char *choices)
{
    if (type == NULL || at >= parameters_of_source(type)) {
        gsl_test(1, "defaults.csv: %s: no such case or parameter", line);
        return;
    }
    const parameter_type *p = parameter_at(type->parameters, at);
    double value[CASE_MAX_PARAMETERS] = {0};
    parameters_default(type, value);
    gsl_test(strcmp(p->name, name) != 0, "defaults.csv: %s: it is %s", line, p->name);
    gsl_test(strtod(number, NULL) != value[at], "defaults.csv: %s: it is %.17g", line, value[at]);
    gsl_test(strcmp(p->choices == NULL ? "" : p->choices, choices) != 0,
             "defaults.csv: %s: its words", line);
}

static int check_table(FILE *table)
{
    char line[LINE], before[LINE] = "";
    int rows = 0, at = 0;
    if (fgets(line, sizeof line, table) == NULL)
        return 0;
    while (fgets(line, sizeof line, table) != NULL) {
        line[strcspn(line, "\r\n")] = '\0';
        char copy[LINE], *rest = copy;
        memcpy(copy, line, sizeof copy);
        const char *name = strsep(&rest, ","), *parameter = strsep(&rest, ",");
        const char *number = strsep(&rest, ",");
        if (rest == NULL) {
            gsl_test(1, "defaults.csv: %s: four columns", line);
            continue;
        }
        at = strcmp(name, before) == 0 ? at + 1 : 0;
        snprintf(before, sizeof before, "%s", name);
        check_row(line, case_of(name), at, parameter, number, rest);
        rows++;
    }
    return rows;
}

int main(void)
{
    const char *folder = getenv("BEAMWORK_REFERENCE");
    char path[LINE];
    snprintf(path, sizeof path, "%s/defaults.csv", folder != NULL ? folder : "reference");
    FILE *table = fopen(path, "r");
    gsl_test(table == NULL, "%s opens", path);
    if (table == NULL)
        return gsl_test_summary();
    gsl_test_int(check_table(table), total(), "one row for each parameter of each case");
    fclose(table);
    return gsl_test_summary();
}
