#include "harness/cli/help.h"

#include <string.h>

#include "harness/terminal/paragraph.h"

enum { INDENT = 2, COLUMN = 30, TEXT = 2000 };

static void write_option(FILE *to, const struct argp_option *o)
{
    const int optional = (o->flags & OPTION_ARG_OPTIONAL) != 0;
    int at = o->key > ' ' && o->key <= '~' ? fprintf(to, "  -%c, ", o->key) : fprintf(to, "      ");
    at += fprintf(to, "--%s", o->name);
    if (o->arg != NULL)
        at += fprintf(to, optional ? "[=%s]" : "=%s", o->arg);
    if (at + 1 >= COLUMN) {
        fputc('\n', to);
        at = 0;
    }
    paragraph_write(to, at, COLUMN, o->doc);
}

static void write_examples(FILE *to, const char *lines)
{
    fprintf(to, strchr(lines, '\n') != NULL ? "\nexamples\n" : "\nexample\n");
    while (*lines != '\0') {
        const size_t length = strcspn(lines, "\n");
        fprintf(to, "  %.*s\n", (int)length, lines);
        lines += length + (lines[length] == '\n');
    }
}

static void write_text(FILE *to, const help_subject *s, const void *context)
{
    (void)context;
    char doc[TEXT];
    const size_t length = strcspn(s->doc, "\v");
    snprintf(doc, sizeof doc, "%.*s", (int)length, s->doc);
    fprintf(to, "usage: beamwork %s %s%s[OPTION...]\n", s->verb, s->arguments,
            s->arguments[0] != '\0' ? " " : "");
    paragraph_write(to, 0, INDENT, doc);
    fprintf(to, "\noptions\n");
    for (const struct argp_option *o = s->chosen; o->name != NULL; o++)
        write_option(to, o);
    if (s->doc[length] == '\v')
        write_examples(to, s->doc + length + 1);
}

static help_writer *used = write_text;
static const void *used_context;

void help_use(help_writer *writer, const void *context)
{
    used = writer;
    used_context = context;
}

void help_write(FILE *to, const help_subject *s)
{
    used(to, s, used_context);
}

int help_asked(int count, char *const arguments[])
{
    return count == 2 && (strcmp(arguments[1], "--help") == 0 || strcmp(arguments[1], "-h") == 0);
}
