/* Lines of CSV, read back as RFC 4180 says: whatever a text holds, every field is where its name
 * is. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/records.h"

enum { MOST_FIELDS = 8, ROOM = 256, LINES = 2 };

/* A record of every kind of value. */
typedef struct thing {
    char first[ROOM], last[ROOM];
    int count;
    double size;
} thing;

static const schema_field fields[] = {{"first", "", FIELD_TEXT, "a text", AT(thing, first)},
                                      {"count", "1", FIELD_INT, "a number", AT(thing, count)},
                                      {"size", "m", FIELD_DOUBLE, "a length", AT(thing, size)},
                                      {"last", "", FIELD_TEXT, "another text", AT(thing, last)},
                                      {NULL}};
static const record_type type = {.name = "thing", .table = "things", .part = {fields}};

/* The fields of one record from *at on, which moves behind its line. */
static int read_line(const char **at, char field[MOST_FIELDS][ROOM])
{
    int count = 0;
    for (int more = 1; more && count < MOST_FIELDS; count++) {
        int used = 0, quoted = **at == '"';
        *at += quoted;
        while (**at != '\0' && (quoted || (**at != ',' && **at != '\n'))) {
            if (quoted && **at == '"' && *++*at != '"')
                break;
            if (used + 1 < ROOM)
                field[count][used++] = **at;
            ++*at;
        }
        field[count][used] = '\0';
        more = **at == ',';
        if (**at != '\0')
            ++*at;
    }
    return count;
}

static void compare(const char *first, const char *last)
{
    char *text = NULL, field[MOST_FIELDS][ROOM];
    size_t length = 0;
    thing it = {.count = -3, .size = 0.1};
    const csv_part part = {&type, {.record = &it}};
    snprintf(it.first, sizeof it.first, "%s", first);
    snprintf(it.last, sizeof it.last, "%s", last);
    FILE *to = open_memstream(&text, &length);
    csv_record_head(to, 1, &part);
    for (int i = 0; i < LINES; i++)
        csv_record_line(to, 1, &part);
    fclose(to);
    const char *at = text;
    gsl_test_int(read_line(&at, field), 4, "'%s', '%s': columns", first, last);
    for (int k = 0; k < 4; k++)
        gsl_test(strcmp(field[k], fields[k].name) != 0, "column %d is %s", k, field[k]);
    for (int i = 0; i < LINES; i++) {
        gsl_test_int(read_line(&at, field), 4, "'%s', '%s': fields", first, last);
        gsl_test(strcmp(field[0], first) != 0 || strcmp(field[3], last) != 0,
                 "'%s', '%s': read as '%s', '%s'", first, last, field[0], field[3]);
        gsl_test(strcmp(field[1], "-3") != 0 || strtod(field[2], NULL) != 0.1,
                 "'%s', '%s': numbers %s, %s", first, last, field[1], field[2]);
    }
    gsl_test(*at != '\0', "'%s', '%s': nothing behind the last line", first, last);
    free(text);
}

/* What is no number leaves its field empty. */
static void no_number(void)
{
    static const double none[] = {NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        char *text = NULL, field[MOST_FIELDS][ROOM];
        size_t length = 0;
        thing it = {.size = none[i]};
        const csv_part part = {&type, {.record = &it}};
        FILE *to = open_memstream(&text, &length);
        csv_record_line(to, 1, &part);
        fclose(to);
        const char *at = text;
        gsl_test_int(read_line(&at, field), 4, "%g: fields", none[i]);
        gsl_test(field[2][0] != '\0', "%g: its field holds '%s'", none[i], field[2]);
        free(text);
    }
}

int main(void)
{
    static const char *const text[] = {"",           "plain",    "a,b",
                                       "\"",         "\"\"",     "'newton=\"dense\"'",
                                       "two\nlines", ",\",\n\"", "\xc3\xa4"};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++)
        for (size_t k = 0; k < sizeof text / sizeof text[0]; k++)
            compare(text[i], text[k]);
    no_number();
    return gsl_test_summary();
}
