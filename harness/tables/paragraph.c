#include "harness/tables/paragraph.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Columns of so many bytes of UTF-8. */
static int columns_of(const char *text, size_t bytes)
{
    int columns = 0;
    for (size_t i = 0; i < bytes; i++)
        columns += ((unsigned char)text[i] & 0xc0) != 0x80;
    return columns;
}

int paragraph_columns(const char *text)
{
    return columns_of(text, strlen(text));
}

/* joint: what ends a line that is continued. */
static void write_words(FILE *to, int at, int indent, const char *joint, const char *text)
{
    const int width = PARAGRAPH_WIDTH - columns_of(joint, strlen(joint));
    int column = at, begun = 0; /* begun: a word stands on this line */
    for (text += strspn(text, " "); *text != '\0'; text += strspn(text, " ")) {
        const size_t word = strcspn(text, " ");
        const int wide = columns_of(text, word);
        if (begun && column + 1 + wide > width) {
            fprintf(to, "%s\n", joint);
            column = begun = 0;
        }
        const int blanks = begun ? 1 : column < indent ? indent - column : 0;
        fprintf(to, "%*s%.*s", blanks, "", (int)word, text);
        column += blanks + wide;
        begun = 1;
        text += word;
    }
    fputc('\n', to);
}

void paragraph_write(FILE *to, int at, int indent, const char *text)
{
    write_words(to, at, indent, "", text);
}

void paragraph_command(FILE *to, int at, int indent, const char *text)
{
    write_words(to, at, indent, " \\", text);
}

void paragraph_say(FILE *to, int at, int indent, const char *format, ...)
{
    char *text = NULL;
    va_list arguments;
    va_start(arguments, format);
    if (vasprintf(&text, format, arguments) >= 0) {
        paragraph_write(to, at, indent, text);
        free(text);
    }
    va_end(arguments);
}
