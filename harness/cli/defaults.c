#include "harness/cli/defaults.h"

#include <string.h>

#include "harness/cli/case_input.h"
#include "harness/cli/errors.h"
#include "harness/experiments/solution.h"

solution_request defaults_request(const command_request *r, const case_type *type)
{
    solution_request out = {.type = type,
                            .parameter = r->parameter,
                            .select = r->select,
                            .elements = r->meshes > 0 ? r->mesh[0] : 0,
                            .keep_all = r->keep_all,
                            .steps = r->steps,
                            .shapes = r->shapes,
                            .threads = r->threads,
                            .systems = r->matrices != NULL};
    if (r->formulations > 0)
        out.formulation = r->formulation[0];
    return out;
}

/* A line of the note. */
static void add(char note[DEFAULTS_NOTE], const char *choice, const char *why, const char *option)
{
    const size_t used = strlen(note);
    snprintf(note + used, DEFAULTS_NOTE - used, "%s: %s; %s gives another\n", choice, why, option);
}

/* What was chosen becomes what was given. */
static void take(command_request *r, const solution_request *chosen, const solution_choice *why,
                 char note[DEFAULTS_NOTE])
{
    char choice[FORMULATION_KEY + 16];
    if (why->formulation[0] != '\0') {
        r->formulation[0] = chosen->formulation;
        r->formulations = 1;
        snprintf(choice, sizeof choice, "-f %s", r->formulation[0].key);
        add(note, choice, why->formulation, "-f NAME");
    }
    if (why->elements[0] != '\0') {
        r->mesh[0] = chosen->elements;
        r->meshes = 1;
        snprintf(choice, sizeof choice, "-n %d", r->mesh[0]);
        add(note, choice, why->elements, "-n N");
    }
}

static status choose(command_request *r, const case_type *type, int elements,
                     char note[DEFAULTS_NOTE], solution_choice *why, fault *f)
{
    truths ledger = {0};
    int levels;
    solution_request wanted = defaults_request(r, type);
    if (elements && r->error != NULL)
        TRY(errors_parse(r->error, 1, &wanted.error, &levels, f));
    if (r->formulations == 0)
        truths_read_rules(case_input_truths_path(r), &ledger, NULL); /* it may be missing */
    const status outcome = solution_choose(&wanted, ledger.rule, ledger.rules, elements, why, f);
    truths_free(&ledger);
    TRY(outcome);
    take(r, &wanted, why, note);
    return STATUS_OK;
}

status defaults_formulation(command_request *r, const case_type *type, char note[DEFAULTS_NOTE],
                            fault *f)
{
    note[0] = '\0';
    solution_choice why = {.formulation = ""};
    return r->formulations > 0 ? STATUS_OK : choose(r, type, 0, note, &why, f);
}

status defaults_fill(command_request *r, const case_type *type, char note[DEFAULTS_NOTE],
                     solution_choice *why, fault *f)
{
    solution_choice own = {.formulation = ""};
    note[0] = '\0';
    if (why != NULL)
        *why = (solution_choice){.formulation = ""};
    if (r->formulations > 0 && r->meshes > 0)
        return STATUS_OK;
    const status outcome = choose(r, type, 1, note, why != NULL ? why : &own, f);
    if (why == NULL)
        solution_choice_free(&own);
    return outcome;
}
