/* Which truths speak of a point, a formulation, a quantity. */
#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/study/truth.h"
#include "harness/study/truth_index.h"

const char truth_kinds[] =
    "exact|predicted|independent|consensus|agreement|published|reconstructed|experiment|"
    "unrepeatable";

/* Where mass lies changes what a mesh gives, and not what meshes go to. */
static int may_differ(const truth *row, const parameter_type *p)
{
    return row->formulation[0] == '\0' && case_is_mass(p);
}

static int same_point(const truth *row, const case_type *type, const double value[])
{
    const int count = parameter_count(type->parameters);
    const double *at = row->parameter;
    for (int i = 0; i < count; i++)
        if (!row->any[i] && fabs(value[i] - at[i]) > 1e-14 * fabs(at[i]) &&
            !may_differ(row, parameter_at(type->parameters, i)))
            return 0;
    return 1;
}

/* Is the pattern that of a formulation's key, or of its name without options? */
static int is_of_formulation(const char *pattern, const char *key)
{
    char bare[64];
    snprintf(bare, sizeof bare, "%.*s", (int)strcspn(key, ":"), key);
    return fnmatch(pattern, key, 0) == 0 || fnmatch(pattern, bare, 0) == 0;
}

int truth_holds(const truth *row, const case_type *type, const double value[])
{
    return row->type == type && same_point(row, type, value);
}

int truth_gates(const truth *row)
{
    return strcmp(row->kind, "agreement") != 0 && strcmp(row->kind, "unrepeatable") != 0;
}

const truth *truth_of(const truths *t, const case_type *type, const double value[],
                      const char *quantity, const char *theory_name)
{
    return truth_of_theory(t, type, value, quantity, theory_name, NULL);
}

const truth *truth_of_theory(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *theory_name, const char *theories)
{
    const truth *best = NULL;
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        const int fits = row->formulation[0] == '\0' && !row->on_curve &&
                         strcmp(row->model, theory_name) == 0 &&
                         (truth_gates(row) || strcmp(theory_name, "same") != 0);
        const int follows = fits && (theories == NULL || row->theory[0] == '\0' ||
                                     choice_index(theories, row->theory) >= 0);
        if (follows && truth_holds(row, type, value) &&
            (best == NULL ||
             choice_index(truth_kinds, row->kind) < choice_index(truth_kinds, best->kind)))
            best = row;
    }
    return best;
}

const truth *truth_agreed(const truths *t, const case_type *type, const double value[],
                          const char *quantity)
{
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        if (strcmp(row->kind, "agreement") == 0 && !row->on_curve &&
            strcmp(row->model, "same") == 0 && truth_holds(row, type, value))
            return row;
    }
    return NULL;
}

const truth *truth_predicted(const truths *t, const case_type *type, const double value[],
                             const char *quantity, const char *key)
{
    for (int i = truth_index_first(t, type, quantity); i < t->rows; i = truth_index_next(t, i)) {
        const truth *row = &t->row[i];
        if (strcmp(row->kind, "predicted") == 0 && !row->on_curve &&
            truth_holds(row, type, value) && is_of_formulation(row->formulation, key))
            return row;
    }
    return NULL;
}
