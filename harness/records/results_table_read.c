/* Reading the short table of a run. Nothing is believed: a file may be foreign, cut short or
 * damaged. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/results.h"
#include "harness/records/results_table.h"

enum {
    SERIES,
    MESHES,
    WORK,
    ERRORS = WORK + RESULTS_WORKS,
    DECADES,
    LEAST,
    LARGEST = LEAST + 3,
    LIMITS = LARGEST + 3,
    FIELDS
};
enum { LONGEST_NAME = 1200, LONGEST_LINE = 16384, MOST_ERRORS = 100000000 };
static const long most_work = 1000000000000000000L;
static const double most_number = 1e300;

/* Splits a line into its fields, of which the first may be quoted; 0: there are not FIELDS of
 * them. */
static int split(char *line, char *field[FIELDS])
{
    char *at = line;
    if (*at == '"') {
        field[0] = at + 1;
        at = strchr(at + 1, '"');
        if (at == NULL)
            return 0;
        *at++ = '\0';
    } else {
        field[0] = at;
        at += strcspn(at, ",");
    }
    for (int i = 1; i < FIELDS; i++) {
        if (*at != ',')
            return 0;
        *at++ = '\0';
        field[i] = at;
        at += strcspn(at, ",");
    }
    return *at == '\0';
}

static int whole(const char *text, long most, long *out)
{
    char *end;
    errno = 0;
    *out = strtol(text, &end, 10);
    return end != text && *end == '\0' && errno == 0 && *out >= 0 && *out <= most;
}

static int number(const char *text, double *out)
{
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == '\0' && fabs(*out) < most_number;
}

/* A text that is neither empty nor too long. */
static int word(const char *text, char *out, size_t size)
{
    const size_t length = strlen(text);
    if (length == 0 || length >= size)
        return 0;
    memcpy(out, text, length + 1);
    return 1;
}

/* "4" or "4:singular", in ascending order. */
static int take_mesh(char *text, result_series *s)
{
    long elements = 0;
    char *end = strchr(text, ':');
    if (end != NULL)
        *end++ = '\0';
    result_mesh *mesh = results_add_mesh(s);
    if (mesh == NULL || !whole(text, RESULTS_MOST_ELEMENTS, &elements) || elements < 1)
        return 0;
    mesh->elements = (int)elements;
    return word(end != NULL ? end : "ok", mesh->status, sizeof mesh->status) &&
           (s->meshes == 1 || mesh[-1].elements < mesh->elements);
}

/* "quantity=1.234". */
static int take_limit(char *text, result_series *s)
{
    char *value = strrchr(text, '=');
    result_limit *limit = value != NULL ? results_add_limit(s) : NULL;
    if (limit == NULL)
        return 0;
    *value++ = '\0';
    return word(text, limit->quantity, sizeof limit->quantity) && number(value, &limit->value);
}

/* Every word of a list. */
static int take_words(char *list, result_series *s, int take(char *text, result_series *s))
{
    char *rest;
    for (char *one = strtok_r(list, " ", &rest); one != NULL; one = strtok_r(NULL, " ", &rest))
        if (!take(one, s))
            return 0;
    return 1;
}

/* Size, elements, quantity; all of them or, where no value has an error, none. */
static int take_error(char *field[], int errors, result_error *e)
{
    long elements = 0;
    if (errors == 0)
        return field[0][0] == '\0' && field[1][0] == '\0' && field[2][0] == '\0';
    const int good = number(field[0], &e->size) && e->size >= 0 &&
                     whole(field[1], RESULTS_MOST_ELEMENTS, &elements) && elements > 0 &&
                     word(field[2], e->quantity, sizeof e->quantity);
    e->elements = (int)elements;
    return good;
}

static int take(char *field[FIELDS], result_series *s)
{
    long errors = 0;
    char name[LONGEST_NAME];
    for (int k = 0; k < RESULTS_WORKS; k++)
        if (!whole(field[WORK + k], most_work, &s->work[k]))
            return 0;
    if (!word(field[SERIES], name, sizeof name) || strchr(name, '"') != NULL ||
        !whole(field[ERRORS], MOST_ERRORS, &errors) || !number(field[DECADES], &s->decades) ||
        fabs(s->decades) > 1e9 || !take_error(&field[LEAST], (int)errors, &s->least) ||
        !take_error(&field[LARGEST], (int)errors, &s->largest) ||
        !take_words(field[MESHES], s, take_mesh) || !take_words(field[LIMITS], s, take_limit))
        return 0;
    s->errors = (int)errors;
    s->name = strdup(name);
    return s->name != NULL && s->meshes > 0;
}

/* A line with its end, which is taken off. */
static int take_line(char *line)
{
    const size_t length = strcspn(line, "\n");
    const int ended = line[length] == '\n';
    line[length] = '\0';
    return ended;
}

static status take_row(char *line, const char *path, int row, stored_results *out, fault *f)
{
    char *field[FIELDS];
    if (take_line(line) && split(line, field)) {
        result_series *s = results_add_series(out);
        if (s == NULL)
            return fault_set(f, STATUS_FAULT, "out of memory for results");
        if (take(field, s)) {
            out->limits = out->limits || s->limits > 0;
            return STATUS_OK;
        }
    }
    return fault_set(f, STATUS_FAULT,
                     "%.120s:%d: the row is damaged or cut short; "
                     "write the table again with 'beamwork compare -o'",
                     path, row);
}

status results_table_read(const char *path, FILE *from, stored_results *out, fault *f)
{
    char line[LONGEST_LINE];
    if (fgets(line, sizeof line, from) == NULL || !take_line(line) ||
        strcmp(line, results_table_head) != 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: neither results of 'beamwork verify -o' (HDF5) nor a table of "
                         "'beamwork compare -o'",
                         path);
    for (int row = 2; fgets(line, sizeof line, from) != NULL; row++)
        TRY(take_row(line, path, row, out, f));
    return ferror(from) ? fault_set(f, STATUS_FAULT, "%.120s: cannot be read", path) : STATUS_OK;
}
