#include "harness/records/records_impl.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const results_work_names[RESULTS_WORKS] = {
    "iterations", "evaluations", "factorisations", "flops", "solutions", "entries"};

/* Appends an item filled with zeros to *list, which grows by `step` items (`list` is the address of
 * a pointer). Returns the item; NULL: out of memory. */
static void *add(void *list, int *count, int step, size_t size)
{
    char *all;
    memcpy(&all, list, sizeof all);
    if (*count % step == 0) {
        char *longer = realloc(all, ((size_t)*count + (size_t)step) * size);
        if (longer == NULL)
            return NULL;
        all = longer;
        memcpy(list, &all, sizeof all);
    }
    return memset(all + (size_t)(*count)++ * size, 0, size);
}

result_cell *results_add(stored_results *r)
{
    return add(&r->cell, &r->cells, 1024, sizeof *r->cell);
}

static result_series *results_add_series(stored_results *r)
{
    return add(&r->series, &r->seriess, 1024, sizeof *r->series);
}

static result_mesh *results_add_mesh(result_series *s)
{
    return add(&s->mesh, &s->meshes, 8, sizeof *s->mesh);
}

static result_limit *results_add_limit(result_series *s)
{
    return add(&s->limit, &s->limits, 8, sizeof *s->limit);
}

int results_order(const result_cell *a, const result_cell *b)
{
    const int names = strcmp(a->name, b->name);
    return names != 0 ? names : (a->elements > b->elements) - (a->elements < b->elements);
}

void results_free(stored_results *r)
{
    for (int i = 0; i < r->cells; i++) {
        free(r->cell[i].name);
        free(r->cell[i].value);
    }
    for (int i = 0; i < r->seriess; i++) {
        free(r->series[i].name);
        free(r->series[i].mesh);
        free(r->series[i].limit);
    }
    results_part_free(&r->part);
    free(r->cell);
    free(r->series);
    memset(r, 0, sizeof *r);
}

static void take_errors(result_series *s, const result_cell *cell)
{
    result_error here = {0};
    for (int i = 0; i < cell->values; i++) {
        const double size = fabs(cell->value[i].error);
        if (!isfinite(size))
            continue;
        s->errors++;
        s->decades += log10(fmax(size, RESULTS_FLOOR));
        if (here.elements == 0 || size > here.size) {
            here = (result_error){size, cell->elements, ""};
            memcpy(here.quantity, cell->value[i].quantity, sizeof here.quantity);
        }
    }
    if (here.elements > 0 && (s->least.elements == 0 || here.size <= s->least.size))
        s->least = here;
    if (here.elements > 0 && (s->largest.elements == 0 || here.size > s->largest.size))
        s->largest = here;
}

static int take_limits(result_series *s, const result_cell *cell)
{
    for (int i = 0; i < cell->values; i++) {
        const result_value *v = &cell->value[i];
        result_limit *limit = isfinite(v->limit) ? results_add_limit(s) : NULL;
        if (limit == NULL && isfinite(v->limit))
            return 0;
        if (limit == NULL)
            continue;
        limit->value = v->limit;
        limit->near_zero = v->near_zero;
        memcpy(limit->quantity, v->quantity, sizeof limit->quantity);
    }
    return 1;
}

static int take_cell(result_series *s, const result_cell *cell)
{
    result_mesh *mesh = results_add_mesh(s);
    if (mesh == NULL)
        return 0;
    mesh->elements = cell->elements;
    memcpy(mesh->status, cell->status, sizeof mesh->status);
    for (int k = 0; k < RESULTS_WORKS; k++)
        s->work[k] += cell->work[k];
    take_errors(s, cell);
    return take_limits(s, cell);
}

int results_series_restrict(const stored_results *r, const result_series *to, result_series *out)
{
    int good = 1;
    for (int i = 0; i < r->cells && good; i++)
        for (int k = 0; strcmp(r->cell[i].name, to->name) == 0 && k < to->meshes && good; k++)
            if (to->mesh[k].elements == r->cell[i].elements)
                good = take_cell(out, &r->cell[i]);
    return good && out->meshes == to->meshes;
}

status results_series_summarise(stored_results *r, fault *f)
{
    result_series *s = NULL;
    for (int i = 0; i < r->cells; i++) {
        if (s == NULL || strcmp(s->name, r->cell[i].name) != 0) {
            s = results_add_series(r);
            if (s == NULL || (s->name = strdup(r->cell[i].name)) == NULL)
                return fault_memory(f, "results");
        }
        if (!take_cell(s, &r->cell[i]))
            return fault_memory(f, "results");
    }
    return STATUS_OK;
}

const char results_table_head[] = "series,meshes,iterations,evaluations,factorisations,flops,"
                                  "solutions,entries,errors,decades,least,least_elements,"
                                  "least_quantity,largest,largest_elements,largest_quantity,limits";

static void write_meshes(FILE *to, const result_series *s)
{
    for (int i = 0; i < s->meshes; i++) {
        const result_mesh *mesh = &s->mesh[i];
        fprintf(to, "%s%d", i > 0 ? " " : ",", mesh->elements);
        if (strcmp(mesh->status, "ok") != 0)
            fprintf(to, ":%s", mesh->status);
    }
}

static void write_error(FILE *to, const result_error *e)
{
    if (e->elements > 0)
        fprintf(to, ",%.*g,%d,%s", RESULTS_ERROR_DIGITS, e->size, e->elements, e->quantity);
    else
        fputs(",,,", to);
}

static void write_limits(FILE *to, const result_series *s)
{
    for (int i = 0; i < s->limits; i++)
        fprintf(to, "%s%s=%.*g", i > 0 ? " " : "", s->limit[i].quantity, RESULTS_LIMIT_DIGITS,
                s->limit[i].value);
}

void results_table_write(FILE *to, const stored_results *r)
{
    fprintf(to, "%s\n", results_table_head);
    for (int i = 0; i < r->seriess; i++) {
        const result_series *s = &r->series[i];
        fprintf(to, "\"%s\"", s->name);
        write_meshes(to, s);
        for (int k = 0; k < RESULTS_WORKS; k++)
            fprintf(to, ",%ld", s->work[k]);
        fprintf(to, ",%d,%.*f", s->errors, RESULTS_DECADES_DECIMALS, s->decades);
        write_error(to, &s->least);
        write_error(to, &s->largest);
        fputc(',', to);
        write_limits(to, s);
        fputc('\n', to);
    }
}

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

/* Splits a line into fields, of which the first may be in quotes. Returns 0 if their number is not
 * FIELDS. */
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

/* Copies a text. Returns 0 if the text is empty or too long. */
static int word(const char *text, char *out, size_t size)
{
    const size_t length = strlen(text);
    if (length == 0 || length >= size)
        return 0;
    memcpy(out, text, length + 1);
    return 1;
}

/* Reads "4" or "4:singular". Meshes must be in ascending order. */
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

/* Reads a limit, such as "quantity=1.234". */
static int take_limit(char *text, result_series *s)
{
    char *value = strrchr(text, '=');
    result_limit *limit = value != NULL ? results_add_limit(s) : NULL;
    if (limit == NULL)
        return 0;
    *value++ = '\0';
    return word(text, limit->quantity, sizeof limit->quantity) && number(value, &limit->value);
}

/* Reads all words of a list with the function `take`. Returns 0 if a word is invalid. */
static int take_words(char *list, result_series *s, int take(char *text, result_series *s))
{
    char *rest;
    for (char *one = strtok_r(list, " ", &rest); one != NULL; one = strtok_r(NULL, " ", &rest))
        if (!take(one, s))
            return 0;
    return 1;
}

/* Reads the size, the elements and the quantity of an error. Either all three are given or, if no
 * value has an error, none of them. */
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

/* Removes the line end. Returns 0 if the line has no line end. */
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
            return fault_memory(f, "results");
        if (take(field, s)) {
            out->limits = out->limits || s->limits > 0;
            return STATUS_OK;
        }
    }
    return fault_set(f, STATUS_FAULT,
                     "%.120s:%d: the row is damaged or truncated; write the table again, for "
                     "example with 'beamwork compare results.h5 -o %.120s'",
                     path, row, path);
}

status results_table_read(const char *path, FILE *from, stored_results *out, fault *f)
{
    char line[LONGEST_LINE];
    if (fgets(line, sizeof line, from) == NULL || !take_line(line) ||
        strcmp(line, results_table_head) != 0)
        return fault_set(f, STATUS_FAULT,
                         "%.120s is neither a results file (HDF5) nor a table written by 'beamwork "
                         "compare -o'; give a file written by 'beamwork verify -o FILE.h5'",
                         path);
    for (int row = 2; fgets(line, sizeof line, from) != NULL; row++)
        TRY(take_row(line, path, row, out, f));
    return ferror(from) ? fault_unreadable(f, path, EIO) : STATUS_OK;
}
