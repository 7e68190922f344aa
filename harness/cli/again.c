#include "harness/cli/again.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/experiments/stock.h"

enum { MOST = 1024 }; /* arguments */

static status add(again *out, const char *text, fault *f)
{
    char *copy = out->count < MOST ? strdup(text) : NULL;
    if (copy == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a command line");
    out->argument[out->count] = out->owned[out->count] = copy;
    out->count++;
    return STATUS_OK;
}

static status add_option(again *out, const char *option, const char *value, fault *f)
{
    if (value == NULL)
        return STATUS_OK;
    TRY(add(out, option, f));
    return add(out, value, f);
}

/* A path that held in any folder, as long as it does. */
static const char *choose(const char *absolute, const char *given)
{
    return strcmp(absolute, given) != 0 && access(absolute, F_OK) == 0 ? absolute : given;
}

static status add_words(again *out, const json_t *origin, fault *f)
{
    const json_t *absolute = json_object_get(origin, "arguments"),
                 *given = json_object_get(origin, "as_given");
    for (size_t i = 0; i < json_array_size(given); i++) {
        const char *word = json_string_value(json_array_get(given, i)),
                   *whole = json_string_value(json_array_get(absolute, i));
        if (word == NULL)
            continue;
        TRY(add(out, whole != NULL ? choose(whole, word) : word, f));
    }
    return STATUS_OK;
}

static status add_outputs(const command_request *r, again *out, fault *f)
{
    for (int i = 0; i < r->case_count; i++)
        TRY(add_option(out, "--from", r->cases[i], f));
    TRY(add_option(out, "--output", r->output, f));
    TRY(add_option(out, "--json", r->json, f));
    TRY(add_option(out, "--junit", r->junit, f));
    TRY(add_option(out, "--markdown", r->markdown, f));
    TRY(add_option(out, "--propose", r->propose, f));
    TRY(add_option(out, "--format", strcmp(r->format, "text") != 0 ? r->format : NULL, f));
    if (r->partial)
        TRY(add(out, "--partial", f));
    if (r->verbose)
        TRY(add(out, "--verbose", f));
    return r->quiet ? add(out, "--quiet", f) : STATUS_OK;
}

status again_make(const command_request *r, again *out, fault *f)
{
    batch_label label;
    *out = (again){.argument = calloc(MOST + 1, sizeof *out->argument),
                   .owned = calloc(MOST + 1, sizeof *out->owned)};
    if (out->argument == NULL || out->owned == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for a command line");
    TRY(stock_first(r->cases[0], &label, f));
    const char *verb = json_string_value(json_object_get(label.origin, "verb"));
    status outcome =
        verb != NULL ? STATUS_OK
                     : fault_set(f, STATUS_FAULT, "%.200s: its batches do not say what they are of",
                                 r->cases[0]);
    if (outcome == STATUS_OK)
        outcome = add(out, "beamwork", f);
    if (outcome == STATUS_OK)
        outcome = add(out, verb, f);
    if (outcome == STATUS_OK)
        outcome = add_words(out, label.origin, f);
    if (outcome == STATUS_OK)
        outcome = add_outputs(r, out, f);
    batch_label_free(&label);
    return outcome;
}

void again_free(again *out)
{
    for (int i = 0; i < out->count; i++)
        free(out->owned[i]);
    free(out->owned);
    free(out->argument);
    *out = (again){.count = 0};
}
