#include "harness/command/defaults.h"

#include <string.h>

#include "harness/command/case_input.h"
#include "harness/judge/preference.h"
#include "harness/model/features.h"

/* A line of the note. */
static void add(char note[DEFAULTS_NOTE], const char *choice, const char *why, const char *option)
{
    const size_t used = strlen(note);
    snprintf(note + used, DEFAULTS_NOTE - used, "%s: %s; %s gives another\n", choice, why, option);
}

static status fill_formulation(command_request *r, const case_type *type, const scene *s,
                               char note[DEFAULTS_NOTE], fault *f)
{
    truths ledger = {0};
    char why[FAULT_TEXT], choice[FORMULATION_KEY + 16];
    const rule_subject where = {
        .type = type, .parameter = r->parameter, .features = features_needed(s)};
    const int known = truths_read_rules(case_input_truths_path(r), &ledger, NULL) == STATUS_OK;
    const status outcome = preference_formulation(s, &where, known ? ledger.rule : NULL,
                                                  ledger.rules, &r->formulation[0], why, f);
    truths_free(&ledger);
    TRY(outcome);
    r->formulations = 1;
    snprintf(choice, sizeof choice, "-f %s", r->formulation[0].key);
    add(note, choice, why, "-f NAME");
    return STATUS_OK;
}

static void fill_elements(command_request *r, const scene *s, char note[DEFAULTS_NOTE])
{
    char why[FAULT_TEXT], choice[32];
    cell_request cell = {.scene = s, .keep_all = r->keep_all, .threads = r->threads};
    cell_formulation(&cell, &r->formulation[0]);
    cell.solve.steps_between = r->steps;
    r->mesh[0] = preference_elements(&cell, why);
    r->meshes = 1;
    snprintf(choice, sizeof choice, "-n %d", r->mesh[0]);
    add(note, choice, why, "-n N");
}

static status fill(command_request *r, const case_type *type, scene *s, int elements,
                   char note[DEFAULTS_NOTE], fault *f)
{
    TRY(cell_scene(type, r->parameter, NULL, s, f));
    if (r->matrices != NULL)
        scene_need(s, FEATURE_MASS);
    if (r->formulations == 0)
        TRY(fill_formulation(r, type, s, note, f));
    if (elements && r->meshes == 0)
        fill_elements(r, s, note);
    return STATUS_OK;
}

static status fill_scene(command_request *r, const case_type *type, int elements,
                         char note[DEFAULTS_NOTE], fault *f)
{
    scene s = {0};
    const status outcome = fill(r, type, &s, elements, note, f);
    scene_free(&s);
    return outcome;
}

status defaults_formulation(command_request *r, const case_type *type, char note[DEFAULTS_NOTE],
                            fault *f)
{
    note[0] = '\0';
    return r->formulations > 0 ? STATUS_OK : fill_scene(r, type, 0, note, f);
}

status defaults_fill(command_request *r, const case_type *type, char note[DEFAULTS_NOTE], fault *f)
{
    note[0] = '\0';
    return r->formulations > 0 && r->meshes > 0 ? STATUS_OK : fill_scene(r, type, 1, note, f);
}
