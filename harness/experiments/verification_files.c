#include "harness/experiments/verification_files.h"

#include <limits.h>
#include <stdio.h>

#include "harness/records/records.h"
#include "harness/study/study.h"

status verification_files_open(verification_files *to, const sweep *s, const judgement *j, fault *f)
{
    to->sweep = s;
    to->judged = j;
    if (to->output != NULL)
        TRY(store_open(NULL, s, j, &to->store, f));
    to->part = (json_part){.verdicts = 0};
    if (to->json != NULL)
        json_part_begin(&to->part);
    to->open = 1;
    return STATUS_OK;
}

void verification_files_case(void *files, const case_type *type)
{
    verification_files *to = files;
    if (to->output != NULL)
        store_case(&to->store, type);
    if (to->json != NULL)
        json_part_add(&to->part, to->sweep, to->judged);
}

/* Where a file goes: of an interrupted run, under a name that says so. */
static status name_place(const verification_files *files, const char *path, char out[PATH_MAX],
                         fault *f)
{
    if (files->sweep->unfinished > 0)
        return output_partial(path, out, f);
    snprintf(out, PATH_MAX, "%s", path);
    return STATUS_OK;
}

static status open_text(const verification_files *files, const char *path, output *out, fault *f)
{
    char where[PATH_MAX];
    TRY(name_place(files, path, where, f));
    return output_open(where, out, f);
}

static status write_json(verification_files *to, const environment *e, fault *f)
{
    output file;
    TRY(open_text(to, to->json, &file, f));
    return output_finish(
        &file, json_write_verdicts(file.stream, to->sweep, to->judged, e, &to->part, f), f);
}

static status write_junit(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->junit, &file, f));
    junit_write(file.stream, to->sweep, to->judged);
    return output_close(&file, f);
}

static status write_markdown(const verification_files *to, const overview *o, const environment *e,
                             fault *f)
{
    output file;
    TRY(open_text(to, to->markdown, &file, f));
    markdown_write(file.stream, to->sweep, to->judged, o, e);
    return output_close(&file, f);
}

static status write_proposal(const verification_files *to, fault *f)
{
    output file;
    TRY(open_text(to, to->propose, &file, f));
    proposal_write(file.stream, to->sweep, to->judged);
    return output_close(&file, f);
}

static status write_texts(verification_files *to, const overview *o, const environment *e, fault *f)
{
    if (to->json != NULL)
        TRY(write_json(to, e, f));
    if (to->junit != NULL)
        TRY(write_junit(to, f));
    if (to->markdown != NULL)
        TRY(write_markdown(to, o, e, f));
    return to->propose != NULL ? write_proposal(to, f) : STATUS_OK;
}

/* The store is closed whatever comes of it. */
static status write_store(verification_files *to, const environment *e, fault *f)
{
    char where[PATH_MAX];
    if (to->output == NULL)
        return STATUS_OK;
    const status outcome = name_place(to, to->output, where, f),
                 written = store_close(&to->store, outcome == STATUS_OK ? where : NULL, e,
                                       outcome == STATUS_OK ? f : NULL);
    return outcome != STATUS_OK ? outcome : written;
}

status verification_files_close(verification_files *to, const overview *o, const environment *e,
                                fault *f)
{
    status outcome = write_store(to, e, f);
    if (outcome == STATUS_OK)
        outcome = write_texts(to, o, e, f);
    json_part_free(&to->part);
    to->open = 0;
    return outcome;
}

void verification_files_drop(verification_files *to)
{
    if (!to->open)
        return;
    if (to->output != NULL)
        store_close(&to->store, NULL, NULL, NULL);
    json_part_free(&to->part);
    to->open = 0;
}
