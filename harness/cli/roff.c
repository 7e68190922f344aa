#include "harness/cli/roff.h"

#include <ctype.h>
#include <string.h>
#include <time.h>

#include "harness/formulations/environment.h"

enum { WIDTH = 78 };

/* As it is typed: what formatters would set in another way stands behind a backslash. Returns the
 * characters written. */
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

/* A word that a formatter would take for a request is none behind "\&". */
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
            column = 0 * fputc('\n', to); /* a new sentence, a new line */
    }
    fputc('\n', to);
}

void roff_argument(FILE *to, const char *text)
{
    fputs(" \"\\&", to);
    write_escaped(to, text, strlen(text));
    fputc('"', to);
}

void roff_literal(FILE *to, const char *line, size_t length)
{
    write_word(to, line, length);
    fputc('\n', to);
}

/* "2026-11-21" as mdoc(7) has it: "November 21, 2026". */
static void write_date(FILE *to, const char *released)
{
    struct tm day = {0};
    char text[40];
    if (strptime(released, "%Y-%m-%d", &day) == NULL ||
        strftime(text, sizeof text, "%B %e, %Y", &day) == 0)
        snprintf(text, sizeof text, "January 1, 1970");
    fprintf(to, ".Dd %s\n", text);
}

void roff_page(FILE *to, const char *name, int section, const char *about)
{
    const environment e = environment_now(1);
    write_date(to, e.released);
    fprintf(to, ".Dt ");
    for (const char *at = name; *at != '\0'; at++)
        fputc(toupper((unsigned char)*at), to);
    fprintf(to, " %d\n.Os beamwork %s\n.Sh NAME\n.Nm %s\n.Nd ", section, e.version, name);
    roff_text(to, about);
}

void roff_see(FILE *to, const roff_reference list[], int count)
{
    fprintf(to, ".Sh SEE ALSO\n");
    for (int i = 0; i < count; i++)
        fprintf(to, ".Xr %s %d%s\n", list[i].name, list[i].section, i + 1 < count ? " ," : "");
}
