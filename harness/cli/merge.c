#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"

enum { MOST = 1024 }; /* largest number of arguments */

typedef struct again {
    int count;
    /* "beamwork", the verb, and the arguments, NULL-terminated */
    char *argument[MOST + 1];
    char *owned[MOST + 1];
} again;

static status add(again *out, const char *text, fault *f)
{
    char *copy = out->count < MOST ? strdup(text) : NULL;
    if (copy == NULL)
        return fault_memory(f, "the command line");
    out->argument[out->count] = out->owned[out->count] = copy;
    out->count++;
    return STATUS_OK;
}

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

static status add_outputs(const command_line *l, again *out, fault *f)
{
    char text[64];
    for (int i = 0; i < l->arguments; i++) {
        TRY(add(out, "--from", f));
        TRY(add(out, l->argument[i], f));
    }
    for (int i = 0; i < l->givens; i++) {
        snprintf(text, sizeof text, "--%s", l->given[i].option->name);
        TRY(add(out, text, f));
        if (l->given[i].value != NULL)
            TRY(add(out, l->given[i].value, f));
    }
    return STATUS_OK;
}

static status add_all(const batch_label *label, const command_line *l, again *out, fault *f)
{
    const char *name = json_string_value(json_object_get(label->origin, "verb"));
    if (name == NULL)
        return fault_set(f, STATUS_FAULT,
                         "%.200s: the batches do not contain their request; delete them, and "
                         "compute them again with this version of beamwork",
                         l->argument[0]);
    TRY(add(out, "beamwork", f));
    TRY(add(out, name, f));
    TRY(add_words(out, label->origin, f));
    return add_outputs(l, out, f);
}

/* Reads the request from the first batch of the first folder. Adds --from for all folders, and the
 * output options of the verb merge. Call again_free after a failure as well. */
static status again_make(const command_line *l, again *out, fault *f)
{
    batch_label label;
    TRY(batch_store_first(l->argument[0], &label, f));
    const status outcome = add_all(&label, l, out, f);
    batch_label_free(&label);
    return outcome;
}

static void again_free(again *out)
{
    for (int i = 0; i < out->count; i++)
        free(out->owned[i]);
}

static int ask(again *a, const verb *const *verbs)
{
    char text[180];
    const verb *v = verb_find(verbs, a->argument[1]);
    if (v != NULL)
        return command_run(v, verbs, a->count - 1, a->argument + 1);
    snprintf(text, sizeof text,
             "the batches of '%.40s' were computed by another version of the program; merge them "
             "with that version",
             a->argument[1]);
    return message_fail(STATUS_REFUSED, text);
}

static int answer(const command_line *l, void *request)
{
    again a = {.count = 0};
    fault f = {""};
    (void)request;
    if (l->arguments == 0)
        return message_fail(
            STATUS_REFUSED,
            "merge requires the folders of --into, such as 'beamwork merge batches -o results.h5'");
    const status outcome = again_make(l, &a, &f);
    const int code = outcome == STATUS_OK ? ask(&a, l->verbs) : message_fail(outcome, f.text);
    again_free(&a);
    return code;
}

typedef struct merge_request {
    const char *output, *format;
    report_options reports;
    int on;
} merge_request;

#define IN(at) .member = offsetof(merge_request, at)
static const verb_option own[] = {
    {"partial", 0, NULL, "continue without missing batches", IN(on)},
    {"verbose", 'v', NULL, "verify: print every limit, not only the overview", IN(on)},
    {"quiet", 'q', NULL, "print only unexpected verdicts and the final PASS or FAIL sentence",
     IN(on)},
    {0}};
static const verb_group shared[] = {SHARED(output, output),
                                    SHARED(format, format),
                                    SHARED(json, reports.json),
                                    SHARED(reports, reports),
                                    {NULL, 0}};
const verb verb_merge = {
    "merge",
    "FOLDER...",
    "merges the batches of all shards of verify or sweep into one run",
    "Merges the batches that shards of verify or sweep wrote with --into. The output is that of a "
    "single run; the verb, options and input files are those of the shards. If batches are "
    "missing, they are listed, and nothing is written; with --partial, the existing part is "
    "written to files named .partial. Exit status: that of the verb; 2 if batches belong to "
    "another request, build or input, or if two batches differ; 5 if batches are missing.",
    "beamwork merge parts -o results.h5\n"
    "beamwork merge first/parts second/parts -o results.h5 --junit junit.xml",
    shared,
    own,
    sizeof(merge_request),
    .place = VERB_EVALUATE + 60,
    .answer = answer};
