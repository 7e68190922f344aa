/* Scene files: read in the place of a case, written from any case. */
#include <stdio.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/record/output.h"
#include "harness/scene_file/key_list.h"
#include "harness/scene_writer/schema_file.h"
#include "harness/scene_writer/write.h"
#include "harness/study/cell.h"

/* All mistakes, a line each; as JSON where that is the form of the output. */
static void tell_mistakes(const cli_request *r, const mistakes *m, status outcome, const fault *f)
{
    fault unwritten;
    if (m->count == 0)
        cli_fail(outcome, f->text);
    else if (strcmp(r->format, "json") != 0)
        mistakes_print(m, stderr);
    else if (mistakes_json(m, stdout, &unwritten) != STATUS_OK)
        cli_fail(STATUS_FAULT, unwritten.text);
}

int cli_scene_read(const cli_request *r, const char *path, scene_file **out)
{
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_read(path, out, &m, &f);
    if (outcome == STATUS_OK)
        return EXIT_AS_EXPECTED;
    tell_mistakes(r, &m, outcome, &f);
    return outcome == STATUS_FAULT ? EXIT_FAULT : EXIT_REFUSED;
}

const case_type *cli_scene_case(cli_request *r)
{
    if (r->case_name != NULL) {
        cli_fail(STATUS_REFUSED, "a case and --scene: give one of them");
        return NULL;
    }
    const int code = cli_scene_read(r, r->scene_path[0], &r->scene);
    if (code == EXIT_AS_EXPECTED)
        return scene_file_case(r->scene);
    r->refusal = code;
    return NULL;
}

void cli_close(cli_request *r)
{
    scene_file_free(r->scene);
    r->scene = NULL;
}

status cli_truths_read(const cli_request *r, truths *t, fault *f)
{
    memset(t, 0, sizeof *t);
    if (r->scene == NULL)
        return truths_read(cli_truths_path(r), t, f);
    const status outcome = scene_file_add_truths(r->scene, r->parameter, t, f);
    if (outcome != STATUS_OK)
        truths_free(t);
    return outcome;
}

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
