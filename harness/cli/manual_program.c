#include <string.h>

#include "harness/cli/manual.h"
#include "harness/cli/roff.h"

static void write_verbs(FILE *to, const manual_row *verb)
{
    int open = 0;
    for (; verb->name != NULL; verb++) {
        if (verb->text != NULL) {
            fprintf(to, ".It Xr beamwork\\-%s 1\n", verb->name);
            roff_text(to, verb->text);
            continue;
        }
        fprintf(to, "%s.Ss To %s\n.Bl -tag -width \"beamwork-element-test(1)\" -compact\n",
                open ? ".El\n" : "", verb->name);
        open = 1;
    }
    fprintf(to, open ? ".El\n" : "");
}

static void write_rows(FILE *to, const char *width, const manual_row *row)
{
    fprintf(to, ".Bl -tag -width %s -compact\n", width);
    for (; row->name != NULL; row++) {
        fprintf(to, ".It");
        roff_argument(to, row->name);
        fputc('\n', to);
        roff_text(to, row->text);
    }
    fprintf(to, ".El\n");
}

static void write_examples(FILE *to, const manual_row *row)
{
    fprintf(to, ".Sh EXAMPLES\n");
    for (; row->name != NULL; row++) {
        char text[200];
        snprintf(text, sizeof text, "%s:", row->text);
        text[0] = (char)(text[0] >= 'a' && text[0] <= 'z' ? text[0] - 'a' + 'A' : text[0]);
        roff_text(to, text);
        fprintf(to, ".Pp\n.Dl");
        roff_argument(to, row->name);
        fprintf(to, row[1].name != NULL ? "\n.Pp\n" : "\n");
    }
}

void manual_write_program(FILE *to, const manual_program *p)
{
    static const manual_row variables[] = {
        {"BEAMWORK_TRUTHS", "packed truths, where --truths does not name them"}, {NULL, NULL}};
    static const roff_reference see[] = {
        {"beamwork-results", 5}, {"beamwork-scene", 5}, {"beamwork-element", 7}};
    roff_page(to, "beamwork", 1, p->summary);
    fprintf(to, ".Sh SYNOPSIS\n.Nm beamwork\n.Ar VERB\n.Op Ar OPTION ...\n.Nm beamwork\n"
                ".Cm help\n.Ar VERB\n.Nm beamwork\n.Fl \\-version\n.Sh DESCRIPTION\n");
    roff_text(to, p->question);
    fprintf(to, "All values are SI.\n"
                "Each verb has a page of its own; its options stand there, and in\n"
                ".Ql beamwork VERB \\-h .\n");
    write_verbs(to, p->verbs);
    fprintf(to, ".Sh ENVIRONMENT\n");
    write_rows(to, "BEAMWORK_TRUTHS", variables);
    fprintf(to, ".Sh EXIT STATUS\n");
    write_rows(to, "Ds", p->statuses);
    fprintf(to, ".Pp\n");
    roff_text(to, p->of_compare);
    write_examples(to, p->examples);
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}
