#include "harness/terminal/paragraph.h"

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

/* Bytes of the word that begins here; in commands blanks within quotes are of it. */
static size_t word_at(const char *text, int command)
{
    size_t length = strcspn(text, " \n'");
    if (!command)
        return strcspn(text, " \n");
    while (text[length] == '\'') {
        const char *end = strchr(text + length + 1, '\'');
        length = end != NULL ? (size_t)(end - text) + 1 : strlen(text);
        length += strcspn(text + length, " \n'");
    }
    return length;
}

/* joint: what ends a line that is continued. */
static void write_words(FILE *to, int at, int indent, const char *joint, const char *text)
{
    const int width = PARAGRAPH_WIDTH - columns_of(joint, strlen(joint));
    int column = at, begun = 0; /* begun: a word stands on this line */
    static const char blank[] = " \n";
    for (text += strspn(text, blank); *text != '\0'; text += strspn(text, blank)) {
        const size_t word = word_at(text, joint[0] != '\0');
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

FILE *paragraph_begin(paragraph *p, FILE *to)
{
    *p = (paragraph){.to = to};
    p->words = open_memstream(&p->text, &p->size);
    return p->words != NULL ? p->words : to;
}

static void end_with(paragraph *p, int at, int indent, const char *joint)
{
    if (p->words == NULL)
        fputc('\n', p->to);
    else if (fclose(p->words) == 0)
        write_words(p->to, at, indent, joint, p->text);
    free(p->text);
}

void paragraph_end(paragraph *p, int at, int indent)
{
    end_with(p, at, indent, "");
}

void paragraph_end_command(paragraph *p, int at, int indent)
{
    end_with(p, at, indent, " \\");
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
