#include "harness/import_export/import_export.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "elements/shared/choice.h"

typedef enum column {
    QUANTITY,
    UNIT,
    ELEMENTS,
    UNKNOWNS,
    SECONDS,
    X,
    VALUE,
    UNCERTAINTY,
    COLUMNS
} column;
static const char *const names[COLUMNS] = {"quantity", "unit", "elements", "unknowns",
                                           "seconds",  "x",    "value",    "uncertainty"};
static const int needed[COLUMNS] = {[QUANTITY] = 1, [UNIT] = 1, [ELEMENTS] = 1, [VALUE] = 1};

enum { FIELDS = 32, MOST_ELEMENTS = 10000000 };

typedef struct file_reader {
    import_set *set;
    const char *path;
    mistakes *m;
    int line, rows;
    int versioned; /* 1: the first line of the format has been read, or reported as missing */
    int placed;
    int place[FIELDS]; /* column of each field; -1: none */
    int fields;
    import_header header;
    int open; /* 1: the block accepts rows */
    import_block block;
} file_reader;

static const char *name_at(const void *context, int i)
{
    const char *const *list = context;
    return list[i];
}

static const char *const header_names[] = {"beamwork-import", "program",    "version", "case",
                                           "model",           "convention", "axes",    NULL};

static void take_text(char to[IMPORT_TEXT], int *line, const file_reader *r, const char *value)
{
    if (strlen(value) >= IMPORT_TEXT)
        mistakes_add(r->m, r->line, 1, "the text is too long; use at most %d characters",
                     IMPORT_TEXT - 1);
    snprintf(to, IMPORT_TEXT, "%s", value);
    *line = r->line;
}

static status close_block(file_reader *r, fault *f)
{
    if (!r->open)
        return STATUS_OK;
    r->open = 0;
    return import_block_close(&r->block, f);
}

static void take_header(file_reader *r, const char *key, const char *value)
{
    import_header *h = &r->header;
    if (strcmp(key, "beamwork-import") == 0) {
        if (strcmp(value, "1") != 0)
            mistakes_add(r->m, r->line, 1,
                         "format version '%.20s' is unknown; write '# beamwork-import: 1'", value);
        r->versioned = 1;
    } else if (strcmp(key, "program") == 0)
        take_text(h->program, &h->program_line, r, value);
    else if (strcmp(key, "version") == 0)
        take_text(h->version, &h->version_line, r, value);
    else if (strcmp(key, "case") == 0)
        take_text(h->of, &h->of_line, r, value);
    else if (strcmp(key, "model") == 0)
        take_text(h->model, &h->model_line, r, value);
    else if (strcmp(key, "convention") == 0)
        take_text(h->convention, &h->convention_line, r, value);
    else if (!axes_parse(value, &h->axes))
        mistakes_add(r->m, r->line, 1,
                     "axes '%.60s' are not valid; give the program's axis = beamwork's axis for "
                     "all three axes, such as x=x y=-z z=y",
                     value);
}

/* Reads "# key: value # remark". Other lines that start with # are comments. */
static void read_header(file_reader *r, char *line)
{
    char *key = line_trim(line + 1), *colon = strchr(key, ':');
    if (colon == NULL || strcspn(key, " \t") < (size_t)(colon - key))
        return;
    *colon = '\0';
    char *value = colon + 1, *remark = strstr(value, " #");
    if (remark != NULL)
        *remark = '\0';
    value = line_trim(value);
    for (int i = 0; header_names[i] != NULL; i++)
        if (strcmp(header_names[i], key) == 0) {
            take_header(r, key, value);
            return;
        }
    const char *near = choice_nearest(key, name_at, header_names);
    mistakes_add(r->m, r->line, 1, "unknown header '%.40s'%s%s%s", key,
                 near != NULL ? "; did you mean '"
                              : "; the headers are program, version, case, model, convention, axes",
                 near != NULL ? near : "", near != NULL ? "'?" : "");
}

static void find_column(file_reader *r, const char *name, int field)
{
    for (int c = 0; c < COLUMNS; c++)
        if (strcmp(names[c], name) == 0) {
            for (int i = 0; i < field; i++)
                if (r->place[i] == c)
                    mistakes_add(r->m, r->line, field + 1,
                                 "column '%s' is given twice; remove one of them", name);
            r->place[field] = c;
            return;
        }
    const char *all[COLUMNS + 1] = {0};
    memcpy(all, names, sizeof names);
    const char *near = choice_nearest(name, name_at, all);
    mistakes_add(r->m, r->line, field + 1, "unknown column '%.40s'%s%s%s", name,
                 near != NULL ? "; did you mean '"
                              : "; the columns are quantity, unit, elements, unknowns, seconds, x, "
                                "value, uncertainty",
                 near != NULL ? near : "", near != NULL ? "'?" : "");
}

static void read_columns(file_reader *r, char *const field[], int count)
{
    r->placed = 1;
    r->fields = count;
    for (int i = 0; i < count; i++)
        r->place[i] = -1;
    for (int i = 0; i < count; i++)
        find_column(r, field[i], i);
    for (int c = 0; c < COLUMNS; c++) {
        int found = !needed[c];
        for (int i = 0; i < count; i++)
            found |= r->place[i] == c;
        if (!found)
            mistakes_add(r->m, r->line, FIELDS + c,
                         "column '%s' is missing; add it to this line and to the lines of values",
                         names[c]);
    }
}

/* Reads a number. Returns NAN for an empty field, which is an error in a required column, and for a
 * text that is not a number. */
static double number_of(const file_reader *r, const char *text, column c)
{
    double value;
    if (text == NULL || text[0] == '\0') {
        if (needed[c])
            mistakes_add(r->m, r->line, 10 + c, "the field '%s' is missing or empty; fill it in",
                         names[c]);
        return NAN;
    }
    if (!line_number(text, &value)) {
        mistakes_add(
            r->m, r->line, 10 + c,
            "%s '%.40s' is not a number; write a number with a decimal point, such as 1.5e-3",
            names[c], text);
        return NAN;
    }
    if ((c == SECONDS || c == UNCERTAINTY) && value < 0)
        mistakes_add(r->m, r->line, 10 + c, "%s is negative; give zero or a positive number",
                     names[c]);
    return value;
}

static int count_of(const file_reader *r, const char *text, column c)
{
    const double value = number_of(r, text, c);
    if (isnan(value))
        return 0;
    if (value >= 1 && value <= MOST_ELEMENTS && value == floor(value))
        return (int)value;
    mistakes_add(r->m, r->line, 10 + c,
                 "%s '%.40s' is not valid; give a whole number from 1 to %d, such as 8", names[c],
                 text, MOST_ELEMENTS);
    return 0;
}

static void take_fields(const file_reader *r, const char *const at[COLUMNS], imported_row *row)
{
    *row = (imported_row){.line = r->line,
                          .elements = count_of(r, at[ELEMENTS], ELEMENTS),
                          .unknowns = count_of(r, at[UNKNOWNS], UNKNOWNS),
                          .seconds = number_of(r, at[SECONDS], SECONDS),
                          .x = number_of(r, at[X], X),
                          .value = number_of(r, at[VALUE], VALUE),
                          .uncertainty = number_of(r, at[UNCERTAINTY], UNCERTAINTY)};
    if (strlen(at[UNIT]) >= sizeof row->unit || strlen(at[QUANTITY]) >= sizeof row->quantity)
        mistakes_add(r->m, r->line, 1,
                     "the name of the quantity or its unit is too long to be valid; give a name "
                     "that 'beamwork list CASE' shows, and a unit such as N/m");
    snprintf(row->unit, sizeof row->unit, "%s", at[UNIT]);
    snprintf(row->quantity, sizeof row->quantity, "%s", at[QUANTITY]);
}

static void read_row(file_reader *r, char *const field[], int count)
{
    const char *at[COLUMNS] = {0};
    imported_row row;
    for (int i = 0; i < count && count <= r->fields; i++)
        if (r->place[i] >= 0)
            at[r->place[i]] = field[i];
    if (at[QUANTITY] == NULL || at[UNIT] == NULL) {
        if (count != r->fields)
            mistakes_add(r->m, r->line, 1,
                         "the line has %d fields, but there are %d columns; write one field for "
                         "each column (it may be empty, as in a,,b)",
                         count, r->fields);
        return;
    }
    take_fields(r, at, &row);
    if (!r->open)
        r->block = import_block_open(r->set, &r->header, r->path, r->m);
    r->open = 1;
    if (row.elements > 0 && isfinite(row.value))
        import_block_add(&r->block, &row);
}

static void read_fields(file_reader *r, char *line)
{
    char *field[FIELDS];
    if (!r->versioned) {
        mistakes_add(r->m, r->line, 1,
                     "the first line of values must follow the line '# beamwork-import: 1'; add it "
                     "at the beginning of the file");
        r->versioned = 1;
    }
    const int count = line_split(line, field, FIELDS);
    if (count > FIELDS)
        mistakes_add(r->m, r->line, 1,
                     "the line has more than %d fields; remove columns that are not used", FIELDS);
    else if (!r->placed || strcmp(field[0], names[QUANTITY]) == 0)
        read_columns(r, field, count);
    else if (++r->rows > IMPORT_ROWS)
        mistakes_add(r->m, r->line, 1,
                     "the file has more than %d lines of values; divide it into several files, and "
                     "import them together",
                     IMPORT_ROWS);
    else
        read_row(r, field, count);
}

static status read_line(file_reader *r, char *line, fault *f)
{
    if (line[0] == '\0')
        return STATUS_OK;
    if (line[0] == '#') {
        TRY(close_block(r, f));
        read_header(r, line);
    } else {
        read_fields(r, line);
    }
    return STATUS_OK;
}

static status read_lines(file_reader *r, FILE *from, char **line, fault *f)
{
    size_t room = 0;
    ssize_t length;
    while (r->rows <= IMPORT_ROWS && (length = getline(line, &room, from)) >= 0) {
        r->line++;
        char *text = line_text(*line, (size_t)length);
        if (text == NULL) {
            mistakes_add(r->m, r->line, 1, LINE_NOT_TEXT);
            break;
        }
        TRY(read_line(r, text, f));
    }
    if (ferror(from))
        return fault_unreadable(f, r->path, errno);
    TRY(close_block(r, f));
    if (r->rows == 0 && r->m->count == 0)
        mistakes_add(
            r->m, r->line > 0 ? r->line : 1, 1,
            "the file has no values; after the lines that begin with #, write a line with the "
            "names of the columns (quantity,unit,elements,value), and then a line for each value");
    return mistakes_status(r->m, f);
}

status import_file_read(const char *path, import_set *into, mistakes *m, fault *f)
{
    FILE *from = line_open(path);
    if (from == NULL)
        return fault_unreadable(f, path, errno);
    file_reader r = {.set = into, .path = path, .m = m, .header = {.axes = axes_same}};
    char *line = NULL;
    const status outcome = read_lines(&r, from, &line, f);
    if (r.open)
        imported_free(r.block.found);
    free(line);
    fclose(from);
    return outcome;
}
