#include "harness/cli/cli_impl.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "cases/format/format.h"
#include "harness/formulations/formulations.h"

enum { WIDTH = 78 };

/* Writes text literally, with escapes for characters that formatters would change. Returns the
 * number of characters written. */
static int write_escaped(FILE *to, const char *text, size_t length)
{
    static const char *const shown[256] = {
        ['\\'] = "\\e",  ['-'] = "\\-",   ['\''] = "\\(aq", ['"'] = "\\(dq",
        ['`'] = "\\(ga", ['^'] = "\\(ha", ['~'] = "\\(ti",
    };
    int written = 0;
    for (size_t i = 0; i < length; i++) {
        const char *other = shown[(unsigned char)text[i]];
        written += other != NULL ? fprintf(to, "%s", other) : fprintf(to, "%c", text[i]);
    }
    return written;
}

/* Writes a word. If it starts with a period, "\&" precedes it, so that it is not interpreted as a
 * request. */
static int write_word(FILE *to, const char *word, size_t length)
{
    const int guard = length > 0 && word[0] == '.';
    return (guard ? fprintf(to, "\\&") : 0) + write_escaped(to, word, length);
}

void roff_text(FILE *to, const char *text)
{
    static const char blank[] = " \n";
    int column = 0;
    for (text += strspn(text, blank); *text != '\0'; text += strspn(text, blank)) {
        const size_t length = strcspn(text, blank);
        if (column > 0 && column + 1 + (int)length > WIDTH)
            column = 0 * fputc('\n', to);
        if (column > 0)
            column += fprintf(to, " ");
        column += write_word(to, text, length);
        text += length;
        if (text[-1] == '.' && *text != '\0')
            column = 0 * fputc('\n', to);
    }
    fputc('\n', to);
}

static void roff_argument(FILE *to, const char *text)
{
    fputs(" \"\\&", to);
    write_escaped(to, text, strlen(text));
    fputc('"', to);
}

static void roff_literal(FILE *to, const char *line, size_t length)
{
    write_word(to, line, length);
    fputc('\n', to);
}

/* Converts "2026-11-21" to the form of mdoc(7), "November 21, 2026". */
static void write_date(FILE *to, const char *released)
{
    struct tm day = {0};
    char text[40];
    if (strptime(released, "%Y-%m-%d", &day) == NULL ||
        strftime(text, sizeof text, "%B %e, %Y", &day) == 0)
        snprintf(text, sizeof text, "January 1, 1970");
    fprintf(to, ".Dd %s\n", text);
}

static void roff_page(FILE *to, const char *name, int chapter, const char *about)
{
    const environment e = environment_now(1);
    write_date(to, e.released);
    fprintf(to, ".Dt ");
    for (const char *at = name; *at != '\0'; at++)
        fputc(toupper((unsigned char)*at), to);
    fprintf(to, " %d\n.Os beamwork %s\n.Sh NAME\n.Nm %s\n.Nd ", chapter, e.version, name);
    roff_text(to, about);
}

void roff_see(FILE *to, const roff_reference list[], int count)
{
    fprintf(to, ".Sh SEE ALSO\n");
    for (int i = 0; i < count; i++)
        fprintf(to, ".Xr %s %d%s\n", list[i].name, list[i].section, i + 1 < count ? " ," : "");
}

static void write_verbs(FILE *to, const verb *const *list)
{
    int open = 0;
    for (; *list != NULL; list++) {
        if ((*list)->answer != NULL) {
            fprintf(to, ".It Xr beamwork\\-%s 1\n", (*list)->name);
            roff_text(to, (*list)->summary);
            continue;
        }
        fprintf(to, "%s.Ss To %s\n.Bl -tag -width \"beamwork-element-test(1)\" -compact\n",
                open ? ".El\n" : "", (*list)->name);
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

static void write_program_examples(FILE *to, const manual_row *row)
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
        {"BEAMWORK_TRUTHS", "file of reference values, if --truths does not name one"},
        {NULL, NULL}};
    static const roff_reference see[] = {
        {"beamwork-results", 5}, {"beamwork-scene", 5}, {"beamwork-element", 7}};
    roff_page(to, "beamwork", 1, p->summary);
    fprintf(to, ".Sh SYNOPSIS\n.Nm beamwork\n.Ar VERB\n.Op Ar OPTION ...\n.Nm beamwork\n"
                ".Cm help\n.Ar VERB\n.Nm beamwork\n.Fl \\-version\n.Sh DESCRIPTION\n");
    roff_text(to, p->question);
    fprintf(to, "Values are in SI units, unless a scene file selects other units.\nEach verb has "
                "its own page; its options are also printed by\n.Ql beamwork VERB \\-h .\n");
    write_verbs(to, p->verbs);
    fprintf(to, ".Sh ENVIRONMENT\n");
    write_rows(to, "BEAMWORK_TRUTHS", variables);
    fprintf(to, ".Sh EXIT STATUS\n");
    write_rows(to, "Ds", p->statuses);
    fprintf(to, ".Pp\n");
    roff_text(to, p->of_compare);
    write_program_examples(to, p->examples);
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}

static void write_option(FILE *to, const verb_option *o)
{
    const int optional = verb_optional(o);
    fprintf(to, ".It ");
    if (o->letter != 0)
        fprintf(to, "Fl %c , ", o->letter);
    fprintf(to, "Fl \\-");
    for (const char *at = o->name; *at != '\0'; at++)
        fprintf(to, *at == '-' ? "\\-" : "%c", *at);
    if (o->argument != NULL) {
        char value[80]; /* without the brackets */
        snprintf(value, sizeof value, "%.*s", (int)strlen(o->argument) - 2 * optional,
                 o->argument + optional);
        fprintf(to, optional ? " Ns Oo = Ns Ar" : " Ns = Ns Ar");
        roff_argument(to, value);
        fprintf(to, optional ? " Oc" : "");
    }
    fputc('\n', to);
    roff_text(to, o->help);
}

static void write_verb_examples(FILE *to, const char *lines)
{
    fprintf(to, ".Sh EXAMPLES\n.Bd -literal\n");
    while (*lines != '\0') {
        const size_t length = strcspn(lines, "\n");
        roff_literal(to, lines, length);
        lines += length + (lines[length] == '\n');
    }
    fprintf(to, ".Ed\n");
}

static int takes(const verb *v, const char *name)
{
    const verb_option *o;
    int i = 0;
    while ((o = verb_option_at(v, i, NULL)) != NULL && strcmp(o->name, name) != 0)
        i++;
    return o != NULL;
}

static void write_references(FILE *to, const verb *v)
{
    roff_reference list[4] = {{"beamwork", 1}};
    int count = 1;
    if (takes(v, "output"))
        list[count++] = (roff_reference){"beamwork-results", 5};
    if (takes(v, "scene"))
        list[count++] = (roff_reference){"beamwork-scene", 5};
    if (takes(v, "element"))
        list[count++] = (roff_reference){"beamwork-element", 7};
    roff_see(to, list, count);
}

void manual_write_verb(FILE *to, const verb *v)
{
    const verb_option *o;
    char name[80];
    snprintf(name, sizeof name, "beamwork-%s", v->name);
    roff_page(to, name, 1, v->summary);
    fprintf(to, ".Sh SYNOPSIS\n.Nm beamwork\n.Cm %s\n", v->name);
    if (v->arguments[0] != '\0') {
        fprintf(to, ".Ar");
        roff_argument(to, v->arguments);
        fputc('\n', to);
    }
    fprintf(to, ".Op Ar OPTION ...\n.Sh DESCRIPTION\n");
    roff_text(to, v->about);
    fprintf(to, ".Pp\nThe options:\n.Bl -tag -width Ds\n");
    for (int i = 0; (o = verb_option_at(v, i, NULL)) != NULL; i++)
        write_option(to, o);
    fprintf(to, ".El\n.Sh EXIT STATUS\nSee\n.Xr beamwork 1 .\n");
    write_verb_examples(to, v->examples);
    write_references(to, v);
}

static const char opening[] = ".Bl -tag -width 2n -offset %s -compact\n";

typedef struct keys {
    FILE *to;
    int depth; /* number of open lists */
} keys;

static void close_to(keys *k, int depth)
{
    for (; k->depth > depth; k->depth--)
        fprintf(k->to, ".El\n");
}

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
    roff_page(to, "beamwork-scene", 5, "scene files with your structures");
    fprintf(to, ".Sh DESCRIPTION\n");
    roff_text(to, "A scene file is written in YAML. Values are in SI units, unless the key 'units' "
                  "selects other units. Numbers may be expressions. All errors of a file are "
                  "reported in one run, with line and column.");
    fprintf(to, ".Pp\n");
    roff_text(to, key_list_head[0]);
    fprintf(to, ".Ss Every entry\n");
    roff_text(to, key_list_head[1]);
    fprintf(to, ".Pp\n");
    write_keys(to, key_list_loops);
    fprintf(to, ".Ss All keys\n");
    write_keys(to, key_list_all);
    fprintf(
        to,
        ".Sh EXAMPLES\nA clamped leaf spring with a transverse force at its tip:\n.Bd -literal\n");
    for (const char *at = example; *at != '\0'; at++) {
        const char *line = at;
        while (*at != '\n')
            at++;
        roff_literal(to, line, (size_t)(at - line));
    }
    fprintf(to, ".Ed\n");
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}

static void write_record(FILE *to, results_record r)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int count = schema_fields(r.type, KEY_AROUND, list);
    char place[200];
    snprintf(place, sizeof place, "%s%s", r.place, r.type->table);
    fprintf(to, ".Ss");
    roff_argument(to, place);
    fputc('\n', to);
    roff_text(to, r.type->summary);
    fprintf(to, ".Pp\n.Bl -tag -width 24n -compact\n");
    for (int i = 0; i < count; i++) {
        const results_field f = results_field_of(list[i]);
        char kind[100];
        snprintf(kind, sizeof kind, "%s%s%s", f.kind, f.unit[0] != '\0' ? " " : "", f.unit);
        fprintf(to, ".It Va");
        roff_argument(to, list[i]->name);
        fprintf(to, " No");
        roff_argument(to, kind);
        fputc('\n', to);
        roff_text(to, f.text);
    }
    fprintf(to, ".El\n");
}

void manual_write_results(FILE *to, const verb *const *verbs)
{
    static const roff_reference see[] = {
        {"beamwork", 1}, {"beamwork-schema", 1}, {"beamwork-verify", 1}};
    char head[60];
    snprintf(head, sizeof head, "Version %d.", SCHEMA_VERSION);
    roff_page(to, "beamwork-results", 5, "results files written by beamwork");
    fprintf(to, ".Sh DESCRIPTION\n");
    roff_text(to, head);
    for (int i = 0; results_about[i] != NULL; i++) {
        roff_text(to, results_about[i]);
        fprintf(to, results_about[i + 1] != NULL ? ".Pp\n" : "");
    }
    for (int i = 0; results_record_at(verbs, i).type != NULL; i++)
        write_record(to, results_record_at(verbs, i));
    fprintf(to, ".Sh EXAMPLES\nFrom Python:\n.Bd -literal\nimport h5py\n"
                "rows = h5py.File(\\(dqresults.h5\\(dq)[\\(dqcases/elastica/quantities\\(dq][()]\n"
                ".Ed\n");
    roff_see(to, see, (int)(sizeof see / sizeof see[0]));
}
