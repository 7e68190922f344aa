#include "cases/format/line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

void line_skip_mark(FILE *from)
{
    static const int mark[] = {0xef, 0xbb, 0xbf};
    for (int i = 0; i < 3; i++) {
        const int got = getc(from);
        if (got == mark[i])
            continue;
        if (got != EOF)
            ungetc(got, from);
        while (i > 0)
            ungetc(mark[--i], from);
        return;
    }
}

FILE *line_open(const char *path)
{
    FILE *from = fopen(path, "r");
    if (from != NULL)
        line_skip_mark(from);
    return from;
}

char *line_trim(char *line)
{
    size_t length = strlen(line);
    while (length > 0 && is_blank(line[length - 1]))
        line[--length] = '\0';
    while (is_blank(*line))
        line++;
    return line;
}

/* Bytes that follow the first one of a character; 0: it is none of several. */
static int following(unsigned char first)
{
    if (first < 0xc2 || first >= 0xf5)
        return 0;
    if (first < 0xe0)
        return 1;
    return first < 0xf0 ? 2 : 3;
}

/* Bytes of the character that begins here; 0: none that is allowed. */
static int character_length(const unsigned char *at)
{
    if (at[0] < 0x80)
        return at[0] >= 0x20 && at[0] != 0x7f ? 1 : at[0] == '\t';
    const int more = following(at[0]);
    for (int i = 1; i <= more; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    const int long_form = (at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xf0 && at[1] < 0x90);
    const int beyond = (at[0] == 0xed && at[1] > 0x9f) || (at[0] == 0xf4 && at[1] > 0x8f);
    return more == 0 || long_form || beyond ? 0 : more + 1;
}

int line_is_text(const char *line)
{
    const unsigned char *at = (const unsigned char *)line;
    while (*at != '\0') {
        const int length = character_length(at);
        if (length == 0)
            return 0;
        at += length;
    }
    return 1;
}

/* Ends the field that begins at `at`; where the next one begins, or NULL. */
static char *end_field(char *at)
{
    char *end = at;
    for (int quoted = 0; *end != '\0' && (quoted || *end != ','); end++)
        quoted ^= *end == '"';
    if (*end == '\0')
        return NULL;
    *end = '\0';
    return end + 1;
}

static char *unquoted(char *field)
{
    field = line_trim(field);
    const size_t length = strlen(field);
    if (length < 2 || field[0] != '"' || field[length - 1] != '"')
        return field;
    char *to = field;
    for (const char *from = field + 1; from < field + length - 1; from++) {
        from += from[0] == '"' && from[1] == '"' && from + 1 < field + length - 1;
        *to++ = *from;
    }
    *to = '\0';
    return field;
}

int line_split(char *line, char *field[], int most)
{
    int count = 0;
    while (line != NULL && count <= most) {
        char *next = end_field(line);
        if (count < most)
            field[count] = unquoted(line);
        count++;
        line = next;
    }
    return count;
}

int line_words(char *line, char *word[], int most)
{
    int count = 0;
    for (line += strspn(line, " \t\r\n,"); *line != '\0' && count <= most;) {
        if (count < most)
            word[count] = line;
        count++;
        line += strcspn(line, " \t\r\n,");
        if (*line != '\0')
            *line++ = '\0';
        line += strspn(line, " \t\r\n,");
    }
    return count;
}

int line_number(const char *text, double *value)
{
    char copy[64], *end;
    const size_t length = strlen(text);
    if (length == 0 || length >= sizeof copy || strspn(text, "+-.0123456789eEdD") != length)
        return 0;
    for (size_t i = 0; i <= length; i++)
        copy[i] = (char)(text[i] == 'D' || text[i] == 'd' ? 'e' : text[i]);
    *value = strtod(copy, &end);
    return *end == '\0' && isfinite(*value);
}
