#include "harness/study/own_table.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/line.h"

/* A quote that does not end in its line would take the next lines along. */
static int quotes_are_even(const char *line)
{
    int quotes = 0;
    for (; *line != '\0'; line++)
        quotes += *line == '"';
    return quotes % 2 == 0;
}

static status add_row(int number, char *line, int columns, own_table *out, mistakes *m, fault *f)
{
    own_table_row row = {.line = number};
    if (!line_is_text(line) || !quotes_are_even(line)) {
        mistakes_add(m, number, 1, "no line of UTF-8 text whose quotes end in it");
        return STATUS_OK;
    }
    own_table_row *more = realloc(out->row, ((size_t)out->rows + 1) * sizeof *more);
    row.text = more != NULL ? strdup(line) : NULL;
    out->row = more != NULL ? more : out->row;
    if (row.text == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for %.100s", m->file);
    const int fields = line_split(row.text, row.field, columns);
    if (fields != columns) {
        mistakes_add(m, number, 1, "%d fields; the table has %d columns", fields, columns);
        free(row.text);
        return STATUS_OK;
    }
    out->row[out->rows++] = row;
    return STATUS_OK;
}

static int count_columns(const char *columns)
{
    int count = 1;
    for (; *columns != '\0'; columns++)
        count += *columns == ',';
    return count;
}

/* With a line that own_table_read frees. */
static status read_lines(FILE *from, const char *columns, char **line, own_table *out, mistakes *m,
                         fault *f)
{
    size_t room = 0;
    int number = 0;
    ssize_t length;
    while ((length = getline(line, &room, from)) >= 0) {
        if (strlen(*line) != (size_t)length) {
            mistakes_add(m, number + 1, 1, "no text: a byte of zero");
            return STATUS_OK;
        }
        char *text = line_trim(*line);
        if (++number == 1 && strcmp(text, columns) != 0) {
            mistakes_add(m, 1, 1, "the first line must be %s", columns);
            return STATUS_OK;
        }
        if (number > 1 && text[0] != '\0')
            TRY(add_row(number, text, count_columns(columns), out, m, f));
    }
    if (ferror(from))
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", m->file, strerror(errno));
    if (number == 0)
        mistakes_add(m, 1, 1, "the file is empty; its first line must be %s", columns);
    return STATUS_OK;
}

status own_table_read(const char *path, const char *columns, own_table *out, mistakes *m, fault *f)
{
    char *line = NULL;
    *out = (own_table){0};
    *m = (mistakes){.file = path};
    FILE *from = line_open(path);
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.120s: cannot be read (%s)", path, strerror(errno));
    const status outcome = read_lines(from, columns, &line, out, m, f);
    free(line);
    fclose(from);
    return outcome;
}

void own_table_free(own_table *t)
{
    for (int i = 0; i < t->rows; i++)
        free(t->row[i].text);
    free(t->row);
    *t = (own_table){0};
}
