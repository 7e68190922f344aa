#include "harness/tables/paragraph.h"

#include <string.h>

/* Columns of so many bytes of UTF-8. */
static int columns_of(const char *text, size_t bytes)
{
    int columns = 0;
    for (size_t i = 0; i < bytes; i++)
        columns += ((unsigned char)text[i] & 0xc0) != 0x80;
    return columns;
}

void paragraph_write(FILE *to, int at, int indent, const char *text)
{
    int column = at, begun = 0; /* begun: a word stands on this line */
    for (text += strspn(text, " "); *text != '\0'; text += strspn(text, " ")) {
        const size_t word = strcspn(text, " ");
        const int wide = columns_of(text, word);
        if (begun && column + 1 + wide > PARAGRAPH_WIDTH) {
            fputc('\n', to);
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
