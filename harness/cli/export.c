/* A case or a scene as an input deck of another program. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/parameters.h"
#include "harness/cli/cli.h"
#include "harness/export/deck.h"
#include "harness/record/output.h"
#include "harness/study/cell.h"

enum { DEFAULT_ELEMENTS = 20 };

/* What the deck is of, as an import says it: case or whole path of a scene file; parameters that
 * differ from their defaults. */
static void name_of(const cli_request *r, const case_type *type, char *text, size_t size)
{
    char parameters[PARAMETERS_TEXT], path[PATH_MAX];
    parameters_text(type, r->parameter, parameters, sizeof parameters);
    const char *file = r->scene_count > 0 ? realpath(r->scene_path[0], path) : NULL;
    snprintf(text, size, "%s%s%s", file != NULL ? file : type->name,
             parameters[0] != '\0' ? "; " : "", parameters);
}

static status write_deck(const cli_request *r, const deck_request *deck, fault *f)
{
    output file;
    TRY(deck_check(deck, f));
    if (r->output == NULL)
        return deck_write(deck, stdout, f);
    TRY(output_open(r->output, &file, f));
    const status outcome = deck_write(deck, file.stream, f);
    if (outcome == STATUS_OK)
        return output_close(&file, f);
    output_discard(&file);
    return outcome;
}

static status export(const cli_request *r, const case_type *type, fault *f)
{
    static const scene_edit unchanged = {.kind = SCENE_EDIT_NONE};
    char of[PARAMETERS_TEXT + PATH_MAX];
    scene s;
    if (r->to == NULL || strcmp(r->to, "calculix") != 0)
        return fault_set(f, STATUS_REFUSED, "which program is the deck for? Say --to calculix");
    if (r->meshes > 1)
        return fault_set(f, STATUS_REFUSED, "a deck has one mesh; give one number with -n");
    TRY(cli_check_files(r, 0, NULL, f));
    status outcome = cell_scene(type, r->parameter, &unchanged, &s, f);
    if (outcome == STATUS_OK) {
        name_of(r, type, of, sizeof of);
        const deck_request deck = {
            .scene = &s, .of = of, .elements = r->meshes > 0 ? r->mesh[0] : DEFAULT_ELEMENTS};
        outcome = write_deck(r, &deck, f);
    }
    scene_free(&s);
    return outcome;
}

int cli_export(int count, char **arguments)
{
    cli_request r;
    fault f = {""};
    cli_parse("export", "[CASE]",
              "Writes a case, or a scene of your own (--scene FILE), as solids in the words of "
              "another program: rectangles as bricks with 20 nodes and reduced integration, ends "
              "and bodies rigid; -n elements along each member (default 20), dense at its ends. "
              "What a deck cannot say is refused. harness/export/read_back.py makes an import of "
              "what the program prints.",
              "nsoYO", count, arguments, &r);
    const case_type *type = cli_case(&r);
    int code = r.refusal;
    if (type != NULL) {
        const status outcome = export(&r, type, &f);
        code = outcome == STATUS_OK ? EXIT_AS_EXPECTED : cli_fail(outcome, f.text);
    }
    cli_close(&r);
    return code;
}
