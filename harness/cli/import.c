#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/import_export/import_export.h"
#include "harness/records/records.h"

typedef struct import_request {
    const char *output, *format, *map;
} import_request;

static int as_json(const import_request *r)
{
    return strcmp(r->format, "json") == 0;
}

static status print_mistakes(const import_request *r, const mistakes *m, fault *f)
{
    if (as_json(r))
        return mistakes_json(m, stdout, f);
    for (int i = 0; i < m->count; i++)
        fprintf(stderr, "%s:%d: %s\n", m->file, m->list[i].line, m->list[i].text);
    if (m->more > 0)
        fprintf(stderr, "%s: %d more %s\n", m->file, m->more, m->more == 1 ? "error" : "errors");
    return STATUS_OK;
}

/* Reports a file with errors, which have been printed. Returns `outcome`. */
static status refuse(const char *path, status outcome, fault *f)
{
    return fault_set(
        f, outcome,
        "nothing was imported, because %.200s contains errors; correct the listed errors", path);
}

static status read_mapped(const command_line *l, const import_request *r, import_set *set, fault *f)
{
    mistakes m = {.file = r->map};
    const status outcome = import_map_read(r->map, l->argument, l->arguments, set, &m, f);
    TRY(print_mistakes(r, &m, f));
    if (m.count > 0)
        refuse(r->map, outcome, f);
    return outcome;
}

static status read_files(const command_line *l, const import_request *r, import_set *set, fault *f)
{
    status outcome = STATUS_OK;
    for (int i = 0; i < l->arguments; i++) {
        mistakes m = {.file = l->argument[i]};
        fault here = {""};
        const status one = import_file_read(l->argument[i], set, &m, &here);
        TRY(print_mistakes(r, &m, f));
        if (one == STATUS_OK || outcome == STATUS_FAULT)
            continue;
        outcome = one;
        if (m.count > 0)
            refuse(l->argument[i], one, f);
        else
            *f = here;
    }
    return outcome;
}

static void report(const sweep *s)
{
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        const sweep_point *p = &s->point[one->point];
        printf("%s%s%s: %s%s%s, %d %s, %d %s%s%s\n", p->type->name, p->text[0] != '\0' ? "; " : "",
               p->text, one->formulation.key, one->imported->version[0] != '\0' ? ", version " : "",
               one->imported->version, one->imported->rows,
               one->imported->rows == 1 ? "value" : "values", one->meshes,
               one->meshes == 1 ? "mesh" : "meshes",
               imported_same_model(one->imported) ? "" : "; another model: ",
               imported_same_model(one->imported) ? "" : one->imported->model);
    }
}

static status check_again(const sweep *s, fault *f)
{
    for (int i = 0; i < s->seriess; i++)
        for (int k = 0; k < i; k++)
            if (s->series[i].point == s->series[k].point &&
                strcmp(s->series[i].formulation.key, s->series[k].formulation.key) == 0)
                return fault_set(
                    f, STATUS_REFUSED,
                    "%.100s: results for the same program, case and parameters are in %.80s:%d and "
                    "%.80s:%d; remove one of them, or change '# program:' in one",
                    s->series[i].formulation.key, s->series[k].imported->file,
                    s->series[k].imported->row[0].line, s->series[i].imported->file,
                    s->series[i].imported->row[0].line);
    return STATUS_OK;
}

static status import(const command_line *l, const import_request *r, import_set *set, fault *f)
{
    if (l->arguments == 0 || r->output == NULL)
        return fault_set(f, STATUS_REFUSED,
                         "import requires one or more files and an output, such as 'beamwork "
                         "import theirs.csv -o theirs.h5'");
    TRY(files_check(l, 1, NULL, f));
    TRY(r->map != NULL ? read_mapped(l, r, set, f) : read_files(l, r, set, f));
    TRY(check_again(&set->sweep, f));
    const environment e = environment_now(1);
    TRY(store_write(r->output, NULL, &set->sweep, NULL, &e, f));
    if (!as_json(r))
        report(&set->sweep);
    return STATUS_OK;
}

static int answer(const command_line *l, void *request)
{
    import_set set = {0};
    fault f = {""};
    const status outcome = import(l, request, &set, &f);
    import_block_free_set(&set);
    return message_exit(outcome, &f);
}

#define IN(at) .member = offsetof(import_request, at)
static const verb_option own[] = {{"map", 0, "FILE.yaml",
                                   "for files without a header: map of their columns to quantities",
                                   IN(map), .traits = OPTION_INPUT},
                                  {0}};
static const verb_group shared[] = {SHARED(output, output), SHARED(record, format), {NULL, 0}};
const verb verb_import = {
    "import",
    "FILE...",
    "reads results of other programs, for 'verify --imported'",
    "Reads results of other programs for a case or scene from CSV files with a header "
    "(harness/import_export/import.md). Names, units and parameters are checked, and values are "
    "converted to the units of the quantities. 'verify --imported' shows the values of the file "
    "given by -o as results of another program. --format json prints the errors of each file, for "
    "editors.",
    "beamwork import theirs.csv -o theirs.h5",
    shared,
    own,
    sizeof(import_request),
    .place = VERB_EXCHANGE + 20,
    .answer = answer};
