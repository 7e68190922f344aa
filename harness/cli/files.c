#include "harness/cli/files.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/formulations/formulations.h"
#include "harness/records/records.h"

enum { OUTPUTS = 7 }; /* of one verb, each once */

typedef struct named_place {
    char option[40];
    const char *path;
    file_place where;
} named_place;

static status check_input(const void *context, const char *input, fault *f)
{
    const named_place *out = context;
    file_place in;
    if (input != NULL && input[0] != '\0' && place_find(input, &in, NULL) == STATUS_OK &&
        place_same(&in, &out->where))
        return fault_set(f, STATUS_REFUSED,
                         "%s %.100s would replace %.100s, which is read; give it another name",
                         out->option, out->path, input);
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

static status find_scenes(const char *folder, glob_t *found, fault *f)
{
    /* the folder's own name is no pattern */
    char *pattern = malloc(2 * strlen(folder) + sizeof "/*.yaml"), *at = pattern;
    if (pattern == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for scene files");
    for (const char *c = folder; *c != '\0'; c++) {
        if (strchr("\\*?[", *c) != NULL)
            *at++ = '\\';
        *at++ = *c;
    }
    memcpy(at, "/*.yaml", sizeof "/*.yaml");
    const int failed = glob(pattern, 0, NULL, found);
    free(pattern);
    if (failed == GLOB_NOMATCH)
        return fault_set(f, STATUS_REFUSED, "%.200s: no *.yaml in that folder; give a scene file",
                         folder);
    return failed == 0 ? STATUS_OK
                       : fault_set(f, STATUS_FAULT, "%.200s: the folder cannot be read", folder);
}

static status visit_folder(const char *folder, file_visit *visit, const void *context, fault *f)
{
    glob_t found;
    status outcome = find_scenes(folder, &found, f);
    TRY(outcome);
    for (size_t i = 0; i < found.gl_pathc && outcome == STATUS_OK; i++)
        outcome = visit(context, found.gl_pathv[i], f);
    globfree(&found);
    return outcome;
}

static status visit_command(const char *command, file_visit *visit, const void *context, fault *f)
{
    char **word;
    struct stat there;
    if (words_split(command, &word, NULL) != STATUS_OK)
        return STATUS_OK; /* refused where it is loaded */
    status outcome = STATUS_OK;
    for (int i = 0; word[i] != NULL && outcome == STATUS_OK; i++)
        if (stat(word[i], &there) == 0 && S_ISREG(there.st_mode))
            outcome = visit(context, word[i], f);
    free(word);
    return outcome;
}

status files_named(const char *input, file_visit *visit, const void *context, fault *f)
{
    static const char exec[] = "exec:";
    struct stat there;
    if (strncmp(input, exec, sizeof exec - 1) == 0)
        return visit_command(input + sizeof exec - 1, visit, context, f);
    return stat(input, &there) == 0 && S_ISDIR(there.st_mode)
               ? visit_folder(input, visit, context, f)
               : visit(context, input, f);
}

/* Arguments are files, or names. */
static status check_arguments(const named_place *out, const command_line *l, fault *f)
{
    const int read =
        strstr(l->verb->arguments, "FILE") != NULL || strstr(l->verb->arguments, "OLD") != NULL;
    for (int i = 0; read && i < l->arguments; i++)
        TRY(check_input(out, l->argument[i], f));
    return STATUS_OK;
}

static status check_inputs(const named_place *out, const command_line *l, const char *truths_path,
                           fault *f)
{
    const given_option *g;
    TRY(check_input(out, truths_path, f));
    TRY(check_input(out, "/proc/self/exe", f));
    for (int i = 0; (g = given_next(l, OPTION_INPUT, &i)) != NULL;)
        TRY(files_named(g->value, check_input, out, f));
    return check_arguments(out, l, f);
}

static void name_place(const given_option *g, named_place *out)
{
    const verb_option *o = g->option;
    *out = (named_place){.path = g->value};
    if (o->letter != 0)
        snprintf(out->option, sizeof out->option, "-%c", o->letter);
    else
        snprintf(out->option, sizeof out->option, "--%s", o->name);
}

static status try_place(const given_option *g, int whole_file, named_place *out, fault *f)
{
    const unsigned traits = g->option->traits;
    const int whole = (traits & OPTION_HDF5) != 0 || (whole_file && g->option->letter == 'o');
    name_place(g, out);
    return (traits & OPTION_FOLDER) != 0
               ? output_folder_try(out->path, &out->where, f)
               : output_try(out->path, whole ? OUTPUT_WHOLE_FILE : OUTPUT_TEXT, &out->where, f);
}

status files_check(const command_line *l, int whole_file, const char *truths_path, fault *f)
{
    named_place out[OUTPUTS];
    const given_option *g;
    int count = 0;
    for (int i = 0; (g = given_next(l, OPTION_OUTPUT, &i)) != NULL && count < OUTPUTS; count++) {
        TRY(try_place(g, whole_file, &out[count], f));
        TRY(check_inputs(&out[count], l, truths_path, f));
        for (int k = 0; k < count; k++)
            TRY(check_pair(&out[k], &out[count], f));
    }
    return STATUS_OK;
}

status files_check_results(const command_line *l, int stored, const char *truths_path, fault *f)
{
    const char *results = given_value(l, "output");
    TRY(files_check(l, stored, truths_path, f));
    return stored && results != NULL ? kept_check(results, f) : STATUS_OK;
}
