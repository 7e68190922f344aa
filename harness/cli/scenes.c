#include "harness/cli/scenes.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/cli/message.h"
#include "harness/cli/own_tables.h"
#include "harness/formulations/registry.h"
#include "harness/study/scene_truths.h"

static status add_path(const char *path, scenes *out, fault *f)
{
    if (out->count == COMMAND_MAX_CASES)
        return fault_set(f, STATUS_REFUSED, "more than %d scene files; give fewer",
                         COMMAND_MAX_CASES);
    out->path[out->count] = strdup(path);
    if (out->path[out->count] == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for scene files");
    out->count++;
    return STATUS_OK;
}

static status add_paths(const glob_t *found, scenes *out, fault *f)
{
    for (size_t i = 0; i < found->gl_pathc; i++)
        TRY(add_path(found->gl_pathv[i], out, f));
    return STATUS_OK;
}

/* Every *.yaml of a folder, in the order of their names. */
static status add_folder(const char *folder, scenes *out, fault *f)
{
    glob_t found;
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
    const int failed = glob(pattern, 0, NULL, &found);
    free(pattern);
    if (failed == GLOB_NOMATCH)
        return fault_set(f, STATUS_REFUSED,
                         "--scene %.200s: no *.yaml in that folder; give a scene file", folder);
    if (failed != 0)
        return fault_set(f, STATUS_FAULT, "--scene %.200s: the folder cannot be read", folder);
    const status outcome = add_paths(&found, out, f);
    globfree(&found);
    return outcome;
}

static status find_paths(const command_request *r, scenes *out, fault *f)
{
    for (int i = 0; i < r->scene_count; i++) {
        struct stat about;
        if (stat(r->scene_path[i], &about) == 0 && S_ISDIR(about.st_mode))
            TRY(add_folder(r->scene_path[i], out, f));
        else
            TRY(add_path(r->scene_path[i], out, f));
    }
    return STATUS_OK;
}

/* Results tell cases apart by their names. */
static status check_name(const case_type *one, const case_type *const *others, const char *path,
                         fault *f)
{
    for (; *others != NULL; others++)
        if (strcmp((*others)->name, one->name) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "%.200s: a case or scene '%s' is judged already; give the scene "
                             "another name",
                             path, one->name);
    return STATUS_OK;
}

static int add_type(const command_request *r, int index, int *types, scenes *out)
{
    fault f = {""};
    const int code = case_input_read(r, out->path[index], &out->file[index]);
    if (code != EXIT_AS_EXPECTED)
        return code;
    const case_type *type = scene_file_case(out->file[index]);
    const status outcome = check_name(type, out->type, out->path[index], &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    out->type[(*types)++] = type;
    return EXIT_AS_EXPECTED;
}

int scenes_read(const command_request *r, scenes *out)
{
    fault f = {""};
    int types = 0;
    memset(out, 0, sizeof *out);
    if (r->built_in || r->scene_count == 0)
        for (; types < COMMAND_MAX_CASES && registry_cases[types] != NULL; types++)
            out->type[types] = registry_cases[types];
    const status outcome = find_paths(r, out, &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    int code = EXIT_AS_EXPECTED;
    for (int i = 0; i < out->count; i++) {
        const int one = add_type(r, i, &types, out);
        code = one != EXIT_AS_EXPECTED ? one : code; /* mistakes of all files are told */
    }
    return code;
}

void scenes_free(scenes *s)
{
    for (int i = 0; i < s->count; i++) {
        scene_file_free(s->file[i]);
        free(s->path[i]);
    }
    memset(s, 0, sizeof *s);
}

static status add_truths(const scenes *s, const command_request *r, truths *t, fault *f)
{
    if (r->built_in || r->scene_count == 0)
        TRY(truths_read(case_input_truths_path(r), t, f));
    else
        TRY(truths_read_rules(case_input_truths_path(r), t, f));
    for (int i = 0; i < s->count; i++)
        TRY(scene_truths_add_all(s->file[i], t, f));
    TRY(own_tables_truths(r, s->type, NULL, t, f));
    return own_tables_findings(r, s->type, t, f);
}

status scenes_truths(const scenes *s, const command_request *r, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    const status outcome = add_truths(s, r, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}
