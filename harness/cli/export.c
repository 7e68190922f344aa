/* Writes a case or a scene as an input deck for another program. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/formulations/formulations.h"
#include "harness/import_export/import_export.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

typedef struct export_request {
    case_options of;
    mesh_list meshes;
    const char *output, *to;
} export_request;

enum { DEFAULT_ELEMENTS = 20 };

static status write_deck(const export_request *r, const deck_request *deck, fault *f)
{
    output file;
    TRY(deck_check(deck, f));
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, deck_write(deck, file.stream, f), f);
}

/* Writes the deck. The caller answer() frees the scene, even after a failure. */
static status export(const export_request *r, const case_type *type, scene *s, fault *f)
{
    char of[PARAMETERS_TEXT + PATH_MAX];
    if (r->to == NULL || strcmp(r->to, "calculix") != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "--to must name the program that will read the input deck; give --to calculix");
    if (r->meshes.count > 1)
        return fault_set(
            f, STATUS_REFUSED,
            "an input deck contains only one mesh; give a single number with -n, such as -n 20");
    TRY(files_check(r->of.line, 0, NULL, f));
    TRY(cell_scene(type, r->of.parameter, NULL, s, f));
    case_input_name(&r->of, type, of, sizeof of);
    const deck_request deck = {.scene = s,
                               .of = of,
                               .elements =
                                   r->meshes.count > 0 ? r->meshes.elements[0] : DEFAULT_ELEMENTS};
    return write_deck(r, &deck, f);
}

static int answer(const command_line *l, void *request)
{
    export_request *r = request;
    (void)l;
    scene s = {0};
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    const status outcome = export(r, type, &s, &f);
    scene_free(&s);
    return message_exit(outcome, &f);
}

#define IN(at) .member = offsetof(export_request, at)
static const verb_option own[] = {
    {"to", 0, "calculix", "program that will read the input deck", IN(to)}, {0}};
static const verb_group shared[] = {
    SHARED(case, of), SHARED(meshes, meshes), SHARED(output, output), {NULL, 0}};
const verb verb_export = {
    "export",
    "[CASE]",
    "writes a structure as a solid model in an input deck for another program",
    "Writes a case, or your own scene (--scene FILE), as solids in an input deck for another "
    "program. Rectangles and straight walls at right angles become 20-node bricks with reduced "
    "integration; ends and bodies are rigid. Each member has -n elements along its length (default "
    "20), shorter near its ends. Scenes that an input deck cannot express are rejected. "
    "harness/import_export/read_back.py converts the printed results to an import file.",
    "beamwork export --scene cases/examples/leaf_spring_guide.yaml --to calculix -o guide.inp",
    shared,
    own,
    sizeof(export_request),
    .place = VERB_EXCHANGE + 10,
    .answer = answer};
