#include "harness/cli/cli.h"

#include <string.h>

static status add(chosen_formulations *o, const char *text, fault *f)
{
    return formulation_list_add(text, COMMAND_MAX_FORMULATIONS, o->formulation, &o->formulations,
                                f);
}

void named_add(chosen_formulations *o, const char *text)
{
    fault f;
    if (add(o, text, &f) != STATUS_OK)
        message_refuse(f.text);
}

/* Sets the default time limit [s]. For element-test, the limit applies to each part of the test. */
static void begin(void *group, command_line *l)
{
    chosen_formulations *o = group;
    o->time_limit = strcmp(l->verb->name, "element-test") == 0 ? 60 : 120;
}

static status load(const char *element, fault *f)
{
    const element_type *type;
    TRY(plugin_load(element, &type, f));
    return formulations_add(type, element, f);
}

/* Sets the time limit for the first answer of a process, then loads the elements and adds the named
 * formulations. */
static status end(void *group, command_line *l, fault *f)
{
    chosen_formulations *o = group;
    (void)l;
    process_limit(o->time_limit);
    if (o->element.count > 0)
        data_place_modules();
    for (int i = 0; i < o->element.count; i++)
        TRY(load(o->element.text[i], f));
    for (int i = 0; i < o->named.count; i++)
        TRY(add(o, o->named.text[i], f));
    return STATUS_OK;
}

int named_alone(const chosen_formulations *o)
{
    for (int i = 0; i < o->named.count; i++)
        if (strcmp(o->named.text[i], "all") == 0)
            return 0;
    return o->named.count > 0;
}

static const verb_option both[] = {
    {"formulation", 'f', "NAME[:KEY=VALUE,...]",
     "formulation with its options, or 'all'; may be repeated",
     .member = offsetof(chosen_formulations, named), .traits = OPTION_REPEATS},
    {"element", 0, "FILE|exec:COMMAND",
     "your own formulation: a shared object (a path with a '/', such as ./mine.so), or a command "
     "that uses the protocol of harness/formulations/protocol.md (such as 'exec:python3 "
     "my_beam.py'); may be repeated",
     .member = offsetof(chosen_formulations, element), .traits = OPTION_REPEATS | OPTION_INPUT,
     .most = FORMULATIONS_MOST_LOADED},
    {0}};
static const verb_option limit[] = {
    {"time-limit", 0, "SECONDS",
     "time limit of a run (default 120; element-test: 60 for each part; 0: no limit); a run that "
     "exceeds the limit fails with status 'time_limit'",
     .member = offsetof(chosen_formulations, time_limit), .most = 1000000},
    {0}};
const option_group options_formulations = {both, begin, end, NULL};
const option_group options_element = {both + 1, begin, end, NULL};
const option_group options_time_limit = {limit, NULL, NULL, NULL};

solution_request defaults_request(const defaults *d)
{
    solution_request out = d->wanted;
    out.elements = d->meshes->count > 0 ? d->meshes->elements[0] : 0;
    if (d->chosen->formulations > 0)
        out.formulation = d->chosen->formulation[0];
    return out;
}

static void add_note(char note[DEFAULTS_NOTE], const char *choice, const char *why,
                     const char *option)
{
    const size_t used = strlen(note);
    snprintf(note + used, DEFAULTS_NOTE - used, "%s: %s; %s selects a different one\n", choice, why,
             option);
}

/* Copies the chosen formulation and mesh into the request, and appends the reasons to the note. */
static void take(const defaults *d, const solution_request *chosen, const solution_choice *why,
                 char note[DEFAULTS_NOTE])
{
    char choice[FORMULATION_KEY + 16];
    if (why->formulation[0] != '\0') {
        d->chosen->formulation[0] = chosen->formulation;
        d->chosen->formulations = 1;
        snprintf(choice, sizeof choice, "-f %s", d->chosen->formulation[0].key);
        add_note(note, choice, why->formulation, "-f NAME");
    }
    if (why->elements[0] != '\0') {
        d->meshes->elements[0] = chosen->elements;
        d->meshes->count = 1;
        snprintf(choice, sizeof choice, "-n %d", d->meshes->elements[0]);
        add_note(note, choice, why->elements, "-n N");
    }
}

static status choose(const defaults *d, int elements, char note[DEFAULTS_NOTE],
                     solution_choice *why, fault *f)
{
    truths deviations = {0};
    solution_request wanted = defaults_request(d);
    if (d->chosen->formulations == 0 && d->known == NULL)
        truths_read_rules(user_tables_packed(d->truths), &deviations,
                          NULL); /* the file may be missing */
    const truths *t = d->known != NULL ? d->known : &deviations;
    const status outcome = solution_choose(&wanted, t->rule, t->rules, elements, why, f);
    truths_free(&deviations);
    TRY(outcome);
    take(d, &wanted, why, note);
    return STATUS_OK;
}

status defaults_formulation(const defaults *d, char note[DEFAULTS_NOTE], fault *f)
{
    note[0] = '\0';
    solution_choice why = {.formulation = ""};
    return d->chosen->formulations > 0 ? STATUS_OK : choose(d, 0, note, &why, f);
}

status defaults_fill(const defaults *d, char note[DEFAULTS_NOTE], solution_choice *why, fault *f)
{
    solution_choice own = {.formulation = ""};
    note[0] = '\0';
    if (why != NULL)
        *why = (solution_choice){.formulation = ""};
    if (d->chosen->formulations > 0 && d->meshes->count > 0)
        return STATUS_OK;
    const status outcome = choose(d, 1, note, why != NULL ? why : &own, f);
    if (why == NULL)
        solution_choice_free(&own);
    return outcome;
}
