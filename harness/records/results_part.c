/* What a stored run was asked for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/formulations/formulations.h"
#include "harness/records/results.h"

enum { NAME = 2048 };

int results_part_has(const char *lines, const char *text)
{
    const size_t length = strlen(text);
    for (const char *at = lines; at != NULL; at = strchr(at, '\n')) {
        at += *at == '\n';
        if (strncmp(at, text, length) == 0 && (at[length] == '\n' || at[length] == '\0'))
            return 1;
    }
    return 0;
}

/* The formulation of case/parameters/formulation. */
static const char *formulation_of(const char *series_name)
{
    const char *slash = strrchr(series_name, '/');
    return slash != NULL ? slash + 1 : series_name;
}

int results_part_is_fresh(const results_part *p, const char *series_name)
{
    return results_part_has(p->fresh, formulation_of(series_name));
}

int results_part_selects(const results_part *p, const char *series_name, const char *quantity)
{
    char text[NAME];
    snprintf(text, sizeof text, "%s/%s", series_name, quantity);
    return p->select == NULL || select_matches(p->select, text) != 0;
}

/* Has the run a quantity of the series that this part of one leaves out? */
static int leaves_out(const results_part *p, const stored_results *known, const char *series_name)
{
    for (int i = 0; p->select != NULL && i < known->cells; i++)
        for (int k = 0; strcmp(known->cell[i].name, series_name) == 0 && k < known->cell[i].values;
             k++)
            if (!results_part_selects(p, series_name, known->cell[i].value[k].quantity))
                return 1;
    for (int i = 0; p->select != NULL && i < known->seriess; i++)
        for (int k = 0;
             strcmp(known->series[i].name, series_name) == 0 && k < known->series[i].limits; k++)
            if (!results_part_selects(p, series_name, known->series[i].limit[k].quantity))
                return 1;
    return 0;
}

int results_part_differ(const stored_results *a, const stored_results *b, const char *series_name)
{
    if (a->part.select != NULL && b->part.select != NULL &&
        strcmp(a->part.select, b->part.select) == 0)
        return 0;
    return leaves_out(&a->part, a, series_name) || leaves_out(&a->part, b, series_name) ||
           leaves_out(&b->part, a, series_name) || leaves_out(&b->part, b, series_name);
}

/* Is what a run knows at `name` of the series, or, where the series has no options, of its case?
 * With options only those quantities are judged for which these matter: the ones with limits. */
static int speaks_for(const char *name, const char *series_name)
{
    return strchr(formulation_of(series_name), ':') != NULL
               ? strcmp(name, series_name) == 0
               : strncmp(name, series_name, strcspn(series_name, "/") + 1) == 0;
}

/* Is any quantity selected that a run knows? */
static int selects_any(const results_part *p, const stored_results *known, const char *series_name)
{
    const int judged = strchr(formulation_of(series_name), ':') != NULL;
    for (int i = 0; i < known->cells; i++) {
        const result_cell *cell = &known->cell[i];
        for (int k = 0; speaks_for(cell->name, series_name) && k < cell->values; k++)
            if ((!judged || isfinite(cell->value[k].limit)) &&
                results_part_selects(p, series_name, cell->value[k].quantity))
                return 1;
    }
    for (int i = 0; i < known->seriess; i++) {
        const result_series *one = &known->series[i];
        for (int k = 0; speaks_for(one->name, series_name) && k < one->limits; k++)
            if (results_part_selects(p, series_name, one->limit[k].quantity))
                return 1;
    }
    return 0;
}

/* Has any series of the run that formulation? */
static int has_formulation(const stored_results *r, const char *key)
{
    for (int i = 0; i < r->seriess; i++)
        if (strcmp(formulation_of(r->series[i].name), key) == 0)
            return 1;
    return 0;
}

int results_part_wants(const stored_results *r, const stored_results *other,
                       const char *series_name)
{
    const results_part *p = &r->part;
    const char *key = formulation_of(series_name);
    char of[NAME];
    snprintf(of, sizeof of, "%.*s", (int)strcspn(series_name, "/"), series_name);
    if (p->cases != NULL && !results_part_has(p->cases, of))
        return 0;
    if (p->formulations != NULL && !results_part_has(p->formulations, key))
        return 0;
    /* options that nobody runs who does not ask for them */
    if (strchr(key, ':') != NULL && results_part_has(other->part.formulations, key) &&
        !has_formulation(r, key))
        return 0;
    return p->select == NULL || selects_any(p, r, series_name) ||
           selects_any(p, other, series_name);
}

void results_part_free(results_part *p)
{
    free(p->select);
    free(p->cases);
    free(p->formulations);
    free(p->fresh);
    memset(p, 0, sizeof *p);
}
