#include "cases/format/key_list.h"
#include "harness/cli/manual.h"
#include "harness/cli/roff.h"

static const char opening[] = ".Bl -tag -width 2n -offset %s -compact\n";

typedef struct keys {
    FILE *to;
    int depth; /* lists that are open */
} keys;

static void close_to(keys *k, int depth)
{
    for (; k->depth > depth; k->depth--)
        fprintf(k->to, ".El\n");
}

/* A list for each depth: that of the keys below stands in the item of the key above them. */
static void write_key(void *context, int depth, const char *name, const char *form,
                      const char *text)
{
    keys *k = context;
    close_to(k, depth + 1);
    for (; k->depth <= depth; k->depth++)
        fprintf(k->to, opening, k->depth == 0 ? "0" : "2n");
    fprintf(k->to, ".It Ic");
    roff_argument(k->to, name);
    fprintf(k->to, " No");
    roff_argument(k->to, form);
    fputc('\n', k->to);
    roff_text(k->to, text);
}

static void write_keys(FILE *to, void list(key_list_take *, void *))
{
    keys k = {to, 0};
    list(write_key, &k);
    close_to(&k, 0);
}

/* Ten lines, as the README has them. */
static const char example[] =
    "beamwork: 1\n"
    "sections:\n"
    "  leaf: {rectangle: {width: 50e-3, thickness: 0.5e-3}, young: 210e9, shear_modulus: 81e9}\n"
    "nodes:\n"
    "  base: {at: [0, 0, 0], hold: all}\n"
    "  tip:  {at: [0.1, 0, 0]}\n"
    "members:\n"
    "  leaf: {from: base, to: tip, section: leaf, y: [0, 1, 0]}\n"
    "loads:\n"
    "  push: {force: [0, 1, 0], on: tip}\n";

void manual_write_scene(FILE *to)
{
    static const roff_reference see[] = {
        {"beamwork", 1}, {"beamwork-scene", 1}, {"beamwork-solve", 1}};
    roff_page(to, "beamwork-scene", 5, "structures of one's own, for beamwork");
    fprintf(to, ".Sh DESCRIPTION\n");
    roff_text(to, "A scene file is YAML; all values are SI, numbers are expressions, and there is "
                  "nothing to compile. Mistakes are told together, with their places.");
    fprintf(to, ".Pp\n");
    roff_text(to, key_list_head[0]);
    fprintf(to, ".Ss Every entry\n");
    roff_text(to, key_list_head[1]);
    fprintf(to, ".Pp\n");
    write_keys(to, key_list_loops);
    fprintf(to, ".Ss All keys\n");
    write_keys(to, key_list_all);
    fprintf(to, ".Sh EXAMPLES\nA leaf spring that is clamped and pushed aside:\n.Bd -literal\n");
    for (const char *at = example; *at != '\0'; at++) {
        const char *line = at;
        while (*at != '\n')
            at++;
        roff_literal(to, line, (size_t)(at - line));
    }
    fprintf(to, ".Ed\n");
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}
