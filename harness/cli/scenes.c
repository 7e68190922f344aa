/* Several scene files of a command line. */
#include "harness/cli/cli.h"

#include <stdlib.h>
#include <string.h>

static status add_path(const void *context, const char *path, fault *f)
{
    scenes *out = *(scenes *const *)context;
    if (out->count == SCENES_MOST)
        return fault_set(f, STATUS_REFUSED,
                         "more than %d scene files are given; give fewer with --scene",
                         SCENES_MOST);
    out->path[out->count] = strdup(path);
    if (out->path[out->count] == NULL)
        return fault_memory(f, "scene files");
    out->count++;
    return STATUS_OK;
}

/* Checks that no other case has the same name, because names identify cases in the results. */
static status check_name(const case_type *one, const case_type *const *others, const char *path,
                         fault *f)
{
    for (; *others != NULL; others++)
        if (strcmp((*others)->name, one->name) == 0)
            return fault_set(f, STATUS_REFUSED,
                             "%.200s: a case or scene named '%s' is already in this run; give the "
                             "scene another name",
                             path, one->name);
    return STATUS_OK;
}

static int add_type(const command_line *l, int index, int *types, scenes *out)
{
    fault f = {""};
    const int code = case_input_read(l, out->path[index], &out->file[index]);
    if (code != EXIT_AS_EXPECTED)
        return code;
    const case_type *type = scene_file_case(out->file[index]);
    const status outcome = check_name(type, out->type, out->path[index], &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    out->type[(*types)++] = type;
    return EXIT_AS_EXPECTED;
}

int scenes_read(const command_line *l, const scenes_options *r, scenes *out)
{
    fault f = {""};
    int types = 0;
    memset(out, 0, sizeof *out);
    if (r->built_in || r->scene.count == 0)
        for (; types < SCENES_MOST && registry_cases[types] != NULL; types++)
            out->type[types] = registry_cases[types];
    status outcome = STATUS_OK;
    for (int i = 0; i < r->scene.count && outcome == STATUS_OK; i++)
        outcome = files_named(r->scene.text[i], add_path, &out, &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    int code = EXIT_AS_EXPECTED;
    for (int i = 0; i < out->count; i++) {
        const int one = add_type(l, i, &types, out);
        code = one != EXIT_AS_EXPECTED ? one : code; /* errors of all files are reported */
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

static status add_truths(const scenes *s, const scenes_options *r, truths *t, fault *f)
{
    if (r->built_in || r->scene.count == 0)
        TRY(truths_read(user_tables_packed(&r->truths), t, f));
    else
        TRY(truths_read_rules(user_tables_packed(&r->truths), t, f));
    for (int i = 0; i < s->count; i++)
        TRY(scene_truths_add_all(s->file[i], t, f));
    TRY(user_tables_truths(&r->truths, s->type, NULL, t, f));
    return user_tables_deviations(&r->deviations, s->type, t, f);
}

status scenes_truths(const scenes *s, const scenes_options *r, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    const status outcome = add_truths(s, r, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}
