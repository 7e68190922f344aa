#include <stdlib.h>
#include <string.h>

#include "harness/cli/manual.h"
#include "harness/cli/roff.h"

static void write_option(FILE *to, const struct argp_option *o)
{
    const int optional = (o->flags & OPTION_ARG_OPTIONAL) != 0;
    fprintf(to, ".It ");
    if (o->key > ' ' && o->key <= '~')
        fprintf(to, "Fl %c , ", o->key);
    fprintf(to, "Fl \\-");
    for (const char *at = o->name; *at != '\0'; at++)
        fprintf(to, *at == '-' ? "\\-" : "%c", *at);
    if (o->arg != NULL) {
        fprintf(to, optional ? " Ns Oo = Ns Ar" : " Ns = Ns Ar");
        roff_argument(to, o->arg);
        fprintf(to, optional ? " Oc" : "");
    }
    fputc('\n', to);
    roff_text(to, o->doc);
}

static void write_examples(FILE *to, const char *lines)
{
    fprintf(to, ".Sh EXAMPLES\n.Bd -literal\n");
    while (*lines != '\0') {
        const size_t length = strcspn(lines, "\n");
        roff_literal(to, lines, length);
        lines += length + (lines[length] == '\n');
    }
    fprintf(to, ".Ed\n");
}

static int takes(const help_subject *s, const char *option)
{
    const struct argp_option *o = s->chosen;
    while (o->name != NULL && strcmp(o->name, option) != 0)
        o++;
    return o->name != NULL;
}

/* The other pages that a reader of this one may need. */
static void write_references(FILE *to, const help_subject *s)
{
    roff_reference list[4] = {{"beamwork", 1}};
    int count = 1;
    if (takes(s, "output"))
        list[count++] = (roff_reference){"beamwork-results", 5};
    if (takes(s, "scene"))
        list[count++] = (roff_reference){"beamwork-scene", 5};
    if (takes(s, "element"))
        list[count++] = (roff_reference){"beamwork-element", 7};
    roff_see(to, list, count);
}

void manual_write_verb(FILE *to, const help_subject *s, const void *context)
{
    const manual_row *verb = context;
    const size_t length = strcspn(s->doc, "\v");
    char name[80], *doc = strndup(s->doc, length);
    snprintf(name, sizeof name, "beamwork-%s", s->verb);
    roff_page(to, name, 1, verb->text);
    fprintf(to, ".Sh SYNOPSIS\n.Nm beamwork\n.Cm %s\n", s->verb);
    if (s->arguments[0] != '\0') {
        fprintf(to, ".Ar");
        roff_argument(to, s->arguments);
        fputc('\n', to);
    }
    fprintf(to, ".Op Ar OPTION ...\n.Sh DESCRIPTION\n");
    roff_text(to, doc != NULL ? doc : "");
    fprintf(to, ".Pp\nThe options:\n.Bl -tag -width Ds\n");
    for (const struct argp_option *o = s->chosen; o->name != NULL; o++)
        write_option(to, o);
    fprintf(to, ".El\n.Sh EXIT STATUS\nThat of\n.Xr beamwork 1 .\n");
    if (s->doc[length] == '\v')
        write_examples(to, s->doc + length + 1);
    write_references(to, s);
    free(doc);
}
