#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/cli/cli.h"
#include "harness/import_export/import_export.h"
#include "harness/records/records.h"
#include "harness/study/study.h"
#include "harness/terminal/terminal.h"

typedef struct scene_request {
    case_options of;
    const char *output, *format; /* format: format of error messages */
    int schema, keys; /* 1: describe the keys of scene files, as JSON Schema or as a list */
} scene_request;

static status describe(FILE *to, const scene_request *r, fault *f)
{
    if (r->schema)
        return schema_file_write(to, f);
    key_list_write(to, paragraph_write);
    return STATUS_OK;
}

static status write_to(FILE *to, const scene_request *r, const case_type *type, scene *s, fault *f)
{
    if (type == NULL)
        return describe(to, r, f);
    const write_head head = {type->name, type->summary, type->source};
    TRY(cell_scene(type, r->of.parameter, NULL, s, f));
    if (strcmp(r->format, "json") != 0)
        return write_scene(to, s, &head, f);
    char of[PARAMETERS_TEXT + PATH_MAX];
    case_input_name(&r->of, type, of, sizeof of);
    return scene_data_write(&(scene_data_request){.scene = s, .head = &head, .of = of}, to, f);
}

static status write_out(const scene_request *r, const case_type *type, fault *f)
{
    output file;
    scene s = {0};
    TRY(output_open(r->output, &file, f));
    const status written = write_to(file.stream, r, type, &s, f);
    scene_free(&s);
    return output_finish(&file, written, f);
}

static int answer(const command_line *l, void *request)
{
    scene_request *r = request;
    fault f = {""};
    (void)l;
    const case_type *type = r->schema || r->keys ? NULL : case_input_find(&r->of);
    int code = r->of.refusal;
    if (r->schema || r->keys || type != NULL)
        code = message_exit(write_out(r, type, &f), &f);
    return code;
}

#define IN(at) .member = offsetof(scene_request, at)
static const verb_option own[] = {
    {"schema", 0, NULL, "describe all keys of scene files as JSON Schema", IN(schema)},
    {"keys", 0, NULL, "list all keys of scene files", IN(keys)},
    {0}};
static const verb_group shared[] = {
    SHARED(case, of), SHARED(output, output), SHARED(record, format), {NULL, 0}};
const verb verb_scene = {
    "scene",
    "[CASE]",
    "writes a case, or your own structure, as a scene file",
    "Writes a case at a parameter point as a scene file, or rewrites your own scene file (--scene "
    "FILE): names are kept, loops and expressions are expanded, and numbers have all their digits. "
    "The file that is written gives the same scene, bit for bit. --keys lists the keys of scene "
    "files; --schema describes them as JSON Schema, for editors. With --format json, writes the "
    "scene as data in SI units for drivers of other programs, with the axes of members, the "
    "constants of sections and the required physics.",
    "beamwork scene c_column -o column.yaml\n"
    "beamwork scene --keys",
    shared,
    own,
    sizeof(scene_request),
    .place = VERB_COMPUTE + 50,
    .answer = answer};
