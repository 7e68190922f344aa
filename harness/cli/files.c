#include "harness/cli/files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/formulations/words.h"
#include "harness/records/output.h"
#include "harness/records/output_folder.h"

enum { OUTPUTS = 7, INPUTS = 7 };

typedef struct named_place {
    const char *option, *path;
    output_form form;
    int folder; /* 1: a new one */
    place where;
} named_place;

static status check_inputs(const named_place *out, const char *const input[INPUTS], fault *f)
{
    for (int i = 0; i < INPUTS; i++) {
        place in;
        if (input[i] != NULL && input[i][0] != '\0' &&
            place_find(input[i], &in, NULL) == STATUS_OK && place_same(&in, &out->where))
            return fault_set(f, STATUS_REFUSED,
                             "%s %.100s would replace %.100s, which is read; give it another name",
                             out->option, out->path, input[i]);
    }
    return STATUS_OK;
}

static status check_pair(const named_place *a, const named_place *b, fault *f)
{
    if (!place_same(&a->where, &b->where) || a->where.shared)
        return STATUS_OK;
    return fault_set(f, STATUS_REFUSED,
                     "%s %.100s and %s %.100s are the same file; give them two names", a->option,
                     a->path, b->option, b->path);
}

/* Objects, and the files that a command names. */
static status check_element(const named_place *out, const char *element, fault *f)
{
    static const char exec[] = "exec:";
    char **word;
    if (strncmp(element, exec, sizeof exec - 1) != 0)
        return check_inputs(out, (const char *const[INPUTS]){element}, f);
    if (words_split(element + sizeof exec - 1, &word, NULL) != STATUS_OK)
        return STATUS_OK; /* refused where it is loaded */
    status outcome = STATUS_OK;
    for (int i = 0; word[i] != NULL && outcome == STATUS_OK; i++)
        if (access(word[i], F_OK) == 0)
            outcome = check_inputs(out, (const char *const[INPUTS]){word[i]}, f);
    free(word);
    return outcome;
}

status files_check(const command_request *r, int whole_file, const char *truths_path, fault *f)
{
    named_place out[OUTPUTS] = {
        {.option = "-o", .path = r->output, .form = whole_file ? OUTPUT_WHOLE_FILE : OUTPUT_TEXT},
        {.option = "--json", .path = r->json},
        {.option = "--junit", .path = r->junit},
        {.option = "--markdown", .path = r->markdown},
        {.option = "--propose", .path = r->propose},
        {.option = "--matrices", .path = r->matrices, .folder = 1},
        {.option = "--ends", .path = r->ends, .form = OUTPUT_WHOLE_FILE}};
    const int is_path = r->against != NULL && strchr(r->against, '/') != NULL;
    const char *const input[INPUTS] = {
        truths_path, r->most_arguments == 2 ? r->case_name : NULL, r->second, r->scene_path[0],
        r->map,      is_path ? r->against : "/proc/self/exe",      r->restart};
    for (int i = 0; i < OUTPUTS; i++) {
        if (out[i].path == NULL)
            continue;
        TRY(out[i].folder ? output_folder_try(out[i].path, &out[i].where, f)
                          : output_try(out[i].path, out[i].form, &out[i].where, f));
        TRY(check_inputs(&out[i], input, f));
        for (int k = 0; k < r->elements; k++)
            TRY(check_element(&out[i], r->element[k], f));
        if (r->reads_files)
            for (int k = 0; k < r->case_count; k++)
                TRY(check_inputs(&out[i], (const char *const[INPUTS]){r->cases[k]}, f));
        for (int k = 0; k < i; k++)
            if (out[k].path != NULL)
                TRY(check_pair(&out[k], &out[i], f));
    }
    return STATUS_OK;
}

status files_check_input(const command_request *r, const char *path, fault *f)
{
    const char *const option[OUTPUTS] = {"-o",        "--json",     "--junit", "--markdown",
                                         "--propose", "--matrices", "--ends"};
    const char *const out[OUTPUTS] = {r->output,  r->json,     r->junit, r->markdown,
                                      r->propose, r->matrices, r->ends};
    const char *const input[INPUTS] = {path};
    for (int i = 0; i < OUTPUTS; i++) {
        named_place one = {.option = option[i], .path = out[i]};
        if (out[i] != NULL && place_find(out[i], &one.where, NULL) == STATUS_OK)
            TRY(check_inputs(&one, input, f));
    }
    return STATUS_OK;
}
