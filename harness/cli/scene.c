/* Scene files written from any case; their keys described. */
#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/record/output.h"
#include "harness/scene_file/key_list.h"
#include "harness/scene_writer/schema_file.h"
#include "harness/scene_writer/write.h"
#include "harness/study/cell.h"

static status describe(FILE *to, const cli_request *r, fault *f)
{
    if (r->schema)
        return schema_file_write(to, f);
    key_list_write(to);
    return STATUS_OK;
}

/* type NULL: a description of the keys. */
static status write_to(FILE *to, const cli_request *r, const case_type *type, fault *f)
{
    static const scene_edit unchanged = {.kind = SCENE_EDIT_NONE};
    scene s;
    if (type == NULL)
        return describe(to, r, f);
    status outcome = cell_scene(type, r->parameter, &unchanged, &s, f);
    if (outcome == STATUS_OK) {
        const write_head head = {type->name, type->summary, type->source};
        outcome = write_scene(to, &s, &head, f);
    }
    scene_free(&s);
    return outcome;
}

static status write_out(const cli_request *r, const case_type *type, fault *f)
{
    output file;
    if (r->output == NULL) {
        TRY(write_to(stdout, r, type, f));
        return fflush(stdout) == 0
                   ? STATUS_OK
                   : fault_set(f, STATUS_FAULT, "standard output cannot be written");
    }
    TRY(output_open(r->output, &file, f));
    const status outcome = write_to(file.stream, r, type, f);
    if (outcome == STATUS_OK)
        return output_close(&file, f);
    output_discard(&file);
    return outcome;
}

int cli_scene(int count, char **arguments)
{
    cli_request r;
    fault f = {""};
    cli_parse(
        "scene", "[CASE]",
        "Writes a case at a parameter point as a scene file, or one of your own (--scene "
        "FILE) again: names kept where scenes have them, loops and expressions written out, "
        "numbers with all their digits. Reading it gives the same scene, bit for bit. "
        "--keys: what may stand in scene files; --schema: the same as JSON Schema, for editors.",
        "soFYHE", count, arguments, &r);
    const case_type *type = r.schema || r.keys ? NULL : cli_case(&r);
    int code = r.refusal;
    if (r.schema || r.keys || type != NULL) {
        const status outcome = write_out(&r, type, &f);
        code = outcome == STATUS_OK ? EXIT_AS_EXPECTED : cli_fail(outcome, f.text);
    }
    cli_close(&r);
    return code;
}
