/* A case or a scene as an input deck of another program. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "harness/cli/cli.h"
#include "harness/exchange/deck.h"
#include "harness/formulations/parameters.h"
#include "harness/records/output.h"
#include "harness/study/cell.h"

enum { DEFAULT_ELEMENTS = 20 };

/* What the deck is of, as an import says it: case or whole path of a scene file; parameters that
 * differ from their defaults. */
static void name_of(const command_request *r, const case_type *type, char *text, size_t size)
{
    char parameters[PARAMETERS_TEXT], path[PATH_MAX];
    parameters_text(type, r->parameter, parameters, sizeof parameters);
    const char *file = r->scene_count > 0 ? realpath(r->scene_path[0], path) : NULL;
    snprintf(text, size, "%s%s%s", file != NULL ? file : type->name,
             parameters[0] != '\0' ? "; " : "", parameters);
}

static status write_deck(const command_request *r, const deck_request *deck, fault *f)
{
    output file;
    TRY(deck_check(deck, f));
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, deck_write(deck, file.stream, f), f);
}

/* With a scene that export_request frees. */
static status export(const command_request *r, const case_type *type, scene *s, fault *f)
{
    char of[PARAMETERS_TEXT + PATH_MAX];
    if (r->to == NULL || strcmp(r->to, "calculix") != 0)
        return fault_set(f, STATUS_REFUSED, "which program is the deck for? Say --to calculix");
    if (r->meshes > 1)
        return fault_set(f, STATUS_REFUSED, "a deck has one mesh; give one number with -n");
    TRY(files_check(r, 0, NULL, f));
    TRY(cell_scene(type, r->parameter, NULL, s, f));
    name_of(r, type, of, sizeof of);
    const deck_request deck = {
        .scene = s, .of = of, .elements = r->meshes > 0 ? r->mesh[0] : DEFAULT_ELEMENTS};
    return write_deck(r, &deck, f);
}

static int export_request(command_request *r)
{
    scene s = {0};
    fault f = {""};
    const case_type *type = case_input_find(r);
    if (type == NULL)
        return r->refusal;
    const status outcome = export(r, type, &s, &f);
    scene_free(&s);
    return message_exit(outcome, &f);
}

int cli_export(int count, char **arguments)
{
    return command_run(
        "export", "[CASE]",
        "Writes a case, or a scene of your own (--scene FILE), as solids in the words of "
        "another program: rectangles and straight walls at right angles as bricks with 20 nodes "
        "and "
        "reduced integration, ends "
        "and bodies rigid; -n elements along each member (default 20), dense at its ends. "
        "What a deck cannot say is refused. harness/exchange/read_back.py makes an import of "
        "what the program prints."
        "\vbeamwork export --scene cases/examples/leaf_spring_guide.yaml --to calculix -o "
        "guide.inp",
        "nsoYO", count, arguments, export_request);
}
