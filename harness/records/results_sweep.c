#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/numerics/numerics.h"

enum {
    VERSION = 1,
    NAME = 200,
    WORDS = 1 << 14,
    /* number of digits of a value of an axis; it is so small that different ranges share their
     * common points */
    DIGITS = 12,
    MOST_LISTED = 4096,
    RANKS = 4
};
static const hsize_t most_items = (hsize_t)1 << 28;

typedef struct name_row {
    char name[NAME];
} name_row;

typedef enum sweep_column {
    POINT,
    REFERENCE,
    VALUE,
    ERROR,
    COST,
    STATUS,
    LACKS,
    COLUMNS
} sweep_column;

typedef struct sweep_file {
    const char *path;
    hid_t at;
    char name[NAME], fixed[PARAMETERS_TEXT], status[WORDS];
    int points, axes, quantities, formulations, meshes;
    name_row *axis, *quantity, *formulation;
    char (*word)[WORDS];
    int *mesh;
    void *column[COLUMNS];
} sweep_file;

static double number(const sweep_file *s, sweep_column which, size_t at)
{
    return ((const double *)s->column[which])[at];
}

static status damaged(const sweep_file *s, const char *what, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.120s: %.120s is missing or damaged; remove the file, and repeat the "
                     "command that wrote it",
                     s->path, what);
}

static void free_file(sweep_file *s)
{
    for (int i = 0; i < COLUMNS; i++)
        free(s->column[i]);
    free(s->axis);
    free(s->quantity);
    free(s->formulation);
    free(s->word);
    free(s->mesh);
}

static hid_t open_set(const sweep_file *s, const char *name)
{
    return H5Lexists(s->at, name, H5P_DEFAULT) > 0 ? H5Dopen2(s->at, name, H5P_DEFAULT) : -1;
}

/* Reads a whole array of this shape. An extent of 0 accepts and receives the actual extent; the
 * array has at most most_items entries. Returns NULL if the array is missing or has another
 * shape. */
static void *read_array(const sweep_file *s, const char *name, hid_t type, int ranks,
                        hsize_t size[RANKS])
{
    hsize_t found[RANKS] = {0}, items = 1;
    const hid_t set = open_set(s, name), space = set >= 0 ? H5Dget_space(set) : -1;
    int good = space >= 0 && H5Sget_simple_extent_ndims(space) == ranks &&
               H5Sget_simple_extent_dims(space, found, NULL) == ranks;
    for (int i = 0; i < ranks && good; i++) {
        good =
            found[i] > 0 && found[i] <= most_items / items && (size[i] == 0 || size[i] == found[i]);
        size[i] = found[i];
        items *= good ? found[i] : 1;
    }
    void *out = good ? malloc((size_t)items * H5Tget_size(type)) : NULL;
    if (out != NULL && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0) {
        free(out);
        out = NULL;
    }
    handles_close(2, (const hid_t[]){space, set});
    return out;
}

/* Reads a text column of a table. Returns the number of rows; 0: the column is missing, or has too
 * many rows. */
static int read_names(const sweep_file *s, const char *table, const char *column, name_row **out)
{
    const table_column columns[] = {{column, FIELD_TEXT, 0, sizeof(name_row)}};
    void *rows;
    const int count = table_reader_rows(s->at, table, 1, columns, sizeof(name_row), &rows);
    *out = rows;
    return count > 0 && count <= MOST_LISTED ? count : 0;
}

/* Reads a text attribute of an array. `out` is empty if the attribute is missing. */
static void read_words(const sweep_file *s, const char *array, const char *name, char out[WORDS])
{
    const hid_t set = open_set(s, array);
    out[0] = '\0';
    if (set >= 0)
        table_reader_attribute_text(set, name, out, WORDS);
    handles_close(1, &set);
}

/* Reads the lists. Returns the name of a damaged part; NULL: none. */
static const char *read_lists(sweep_file *s)
{
    hsize_t meshes[RANKS] = {0};
    s->axes = read_names(s, "axes", "name", &s->axis);
    s->quantities = read_names(s, "quantities", "name", &s->quantity);
    s->formulations = read_names(s, "formulations", "key", &s->formulation);
    s->mesh = read_array(s, "meshes", H5T_NATIVE_INT, 1, meshes);
    s->meshes = s->mesh != NULL && meshes[0] <= MOST_LISTED ? (int)meshes[0] : 0;
    for (int i = 0; i < s->meshes; i++)
        if (s->mesh[i] < 1 || s->mesh[i] > RESULTS_MOST_ELEMENTS)
            return "meshes";
    s->word = calloc((size_t)s->axes + 1, sizeof *s->word);
    for (int i = 0; s->word != NULL && i < s->axes; i++)
        read_words(s, "points", s->axis[i].name, s->word[i]);
    read_words(s, "status", "names", s->status);
    return s->axes == 0           ? "axes"
           : s->quantities == 0   ? "quantities"
           : s->formulations == 0 ? "formulations"
           : s->meshes == 0       ? "meshes"
                                  : NULL;
}

static const char *read_columns(sweep_file *s)
{
    const hsize_t a = (hsize_t)s->axes, q = (hsize_t)s->quantities, f = (hsize_t)s->formulations,
                  m = (hsize_t)s->meshes;
    const struct {
        const char *name;
        hid_t type;
        int ranks;
        hsize_t size[RANKS]; /* extents; the first, which is the number of points, is set below */
    } column[COLUMNS] = {{"points", H5T_NATIVE_DOUBLE, 2, {0, a}},
                         {"reference", H5T_NATIVE_DOUBLE, 2, {0, q}},
                         {"value", H5T_NATIVE_DOUBLE, 4, {0, f, m, q}},
                         {"error", H5T_NATIVE_DOUBLE, 4, {0, f, m, q}},
                         {"cost", H5T_NATIVE_DOUBLE, 3, {0, f, m}},
                         {"status", H5T_NATIVE_UCHAR, 3, {0, f, m}},
                         {"not_modelled", H5T_NATIVE_INT, 2, {0, f}}};
    for (int i = 0; i < COLUMNS; i++) {
        hsize_t size[RANKS];
        memcpy(size, column[i].size, sizeof size);
        size[0] = (hsize_t)s->points;
        s->column[i] = read_array(s, column[i].name, column[i].type, column[i].ranks, size);
        if (s->column[i] == NULL)
            return column[i].name;
        s->points = (int)size[0];
    }
    return NULL;
}

static const char *read_request(sweep_file *s, stored_results *out)
{
    char from[WORDS], select[WORDS];
    snprintf(s->name, sizeof s->name, "scene");
    if (table_reader_attribute_text(s->at, "scene", from, sizeof from)) {
        const char *leaf = strrchr(from, '/') != NULL ? strrchr(from, '/') + 1 : from;
        snprintf(s->name, sizeof s->name, "%.*s", (int)strcspn(leaf, "."), leaf);
    } else if (!table_reader_attribute_text(s->at, "case", s->name, sizeof s->name)) {
        return "case";
    }
    if (!table_reader_attribute_text(s->at, "parameters", s->fixed, sizeof s->fixed))
        return "parameters";
    if (!table_reader_attribute_text(s->at, "selection", select, sizeof select))
        return NULL;
    out->part.select = select_matches(select, "") >= 0 ? strdup(select) : NULL;
    return out->part.select != NULL ? NULL : "selection";
}

/* Copies line `at` of a text, at most size - 1 bytes. `out` is empty if there is no such line. */
static void take_line(const char *lines, double at, char *out, int size)
{
    const char *line = lines;
    for (int i = 0; i < at && line != NULL; i++)
        line = strchr(line, '\n') != NULL ? strchr(line, '\n') + 1 : NULL;
    snprintf(out, (size_t)size, "%.*s", line != NULL ? (int)strcspn(line, "\n") : 0,
             line != NULL ? line : "");
}

static void axis_value_text(const sweep_file *s, int axis, double value, char *out)
{
    const parameter_type plain = {.name = s->axis[axis].name};
    char digits[ASSIGNMENT_VALUE];
    if (s->word[axis][0] != '\0') {
        take_line(s->word[axis], value, out, ASSIGNMENT_VALUE);
        return;
    }
    snprintf(digits, sizeof digits, "%.*g", DIGITS, value);
    assignment_value_text(&plain, strtod(digits, NULL), out, ASSIGNMENT_VALUE);
}

static int compare_words(const void *a, const void *b)
{
    return strcmp(a, b);
}

enum { WORD = NAME + ASSIGNMENT_VALUE + 1, MOST_WORDS = 2 * CASE_MAX_PARAMETERS };

static int fixed_words(const sweep_file *s, char word[MOST_WORDS][WORD])
{
    int count = 0;
    for (const char *at = s->fixed; *at != '\0' && count < CASE_MAX_PARAMETERS;) {
        const size_t length = strcspn(at, ";"), name = strcspn(at, "=");
        int varies = 0;
        for (int i = 0; i < s->axes; i++)
            varies |= strlen(s->axis[i].name) == name && strncmp(at, s->axis[i].name, name) == 0;
        if (!varies)
            snprintf(word[count++], WORD, "%.*s", (int)length, at);
        at += length + (at[length] == ';');
    }
    return count;
}

static void point_text(const sweep_file *s, int which, char *out, size_t size)
{
    char word[MOST_WORDS][WORD];
    int count = fixed_words(s, word);
    size_t used = 0;
    for (int i = 0; i < s->axes && count < MOST_WORDS; i++) {
        char value[ASSIGNMENT_VALUE];
        axis_value_text(s, i, number(s, POINT, (size_t)which * (size_t)s->axes + (size_t)i), value);
        snprintf(word[count++], WORD, "%s=%s", s->axis[i].name, value);
    }
    qsort(word, (size_t)count, sizeof *word, compare_words);
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i > 0 ? ";" : "", word[i]);
}

/* Adds a cell named case/parameters/`of` with memory for its values; NULL: out of memory. */
static result_cell *add_cell(const sweep_file *s, const char *text, const char *of,
                             stored_results *out)
{
    char name[2 * NAME + PARAMETERS_TEXT + NAME];
    snprintf(name, sizeof name, "%s/%s/%s", s->name, text, of);
    result_cell *cell = results_add(out);
    if (cell == NULL || (cell->name = strdup(name)) == NULL ||
        (cell->value = calloc((size_t)s->quantities, sizeof *cell->value)) == NULL)
        return NULL;
    for (int i = 0; i < s->quantities; i++) {
        result_value *v = &cell->value[cell->values++];
        snprintf(v->quantity, sizeof v->quantity, "%.47s", s->quantity[i].name);
        v->value = v->error = v->limit = NAN;
    }
    return cell;
}

/* Adds a cell with the reference values of a point, which belong to no mesh. Returns 0 if out of
 * memory. */
static int add_references(const sweep_file *s, int which, const char *text, stored_results *out)
{
    result_cell *cell = add_cell(s, text, "reference", out);
    for (int i = 0; cell != NULL && i < s->quantities; i++)
        cell->value[i].value =
            number(s, REFERENCE, (size_t)which * (size_t)s->quantities + (size_t)i);
    if (cell != NULL)
        snprintf(cell->status, sizeof cell->status, "ok");
    return cell != NULL;
}

static int add_mesh(const sweep_file *s, size_t row, int mesh, const char *text,
                    stored_results *out)
{
    const size_t at = row * (size_t)s->meshes + (size_t)mesh;
    const int lacks = ((const int *)s->column[LACKS])[row];
    result_cell *cell = add_cell(s, text, s->formulation[row % (size_t)s->formulations].name, out);
    if (cell == NULL)
        return 0;
    cell->elements = s->mesh[mesh];
    cell->cost = number(s, COST, at);
    take_line(s->status, ((const unsigned char *)s->column[STATUS])[at], cell->status,
              sizeof cell->status);
    if (lacks != 0 && strcmp(cell->status, "ok") == 0)
        snprintf(cell->status, sizeof cell->status, "other model");
    for (int i = 0; i < s->quantities; i++) {
        cell->value[i].value = number(s, VALUE, at * (size_t)s->quantities + (size_t)i);
        cell->value[i].error = number(s, ERROR, at * (size_t)s->quantities + (size_t)i);
    }
    return 1;
}

static status check_size(const sweep_file *s, fault *f)
{
    char what[FAULT_TEXT];
    const double two = 2;
    const double cells = (double)s->points * (s->formulations * (double)s->meshes + 1);
    snprintf(what, sizeof what, "%.120s: %.0f runs", s->path, cells);
    if (cells > most_items)
        return fault_set(f, STATUS_REFUSED,
                         "%s are more than can be compared; compare sweeps of fewer points", what);
    return memory_check(
        two * cells *
            (double)(sizeof(result_cell) + NAME + (size_t)s->quantities * sizeof(result_value)),
        what, "compare sweeps of fewer points", f);
}

static status add_point(const sweep_file *s, int which, stored_results *out, fault *f)
{
    char text[PARAMETERS_TEXT + NAME];
    point_text(s, which, text, sizeof text);
    int good = add_references(s, which, text, out);
    for (int i = 0; i < s->formulations; i++)
        for (int k = 0; k < s->meshes && good; k++)
            good = add_mesh(s, (size_t)which * (size_t)s->formulations + (size_t)i, k, text, out);
    return good ? STATUS_OK : fault_memory(f, "the runs of a sweep");
}

static status read_file(sweep_file *s, stored_results *out, fault *f)
{
    long version = 0;
    const char *bad = NULL;
    table_reader_attribute_count(s->at, KEPT_SWEEP_MARK, &version);
    if (version != VERSION)
        return fault_set(f, STATUS_FAULT,
                         "%.120s: the sweep has format version %ld, but this version of beamwork "
                         "reads version %d; remove the file, and repeat the command that wrote it",
                         s->path, version, VERSION);
    if ((bad = read_request(s, out)) != NULL || (bad = read_lists(s)) != NULL)
        return damaged(s, bad, f);
    if (s->word == NULL)
        return fault_memory(f, "the choices of a sweep");
    if ((bad = read_columns(s)) != NULL)
        return damaged(s, bad, f);
    TRY(check_size(s, f));
    for (int i = 0; i < s->points; i++)
        TRY(add_point(s, i, out, f));
    return STATUS_OK;
}

status results_sweep_read(const char *path, hid_t at, stored_results *out, fault *f)
{
    sweep_file s = {.path = path, .at = at};
    const status outcome = read_file(&s, out, f);
    out->whole = out->swept = 1;
    free_file(&s);
    return outcome;
}

enum { MOST_ROWS = 50000000 };
static const size_t most_bytes = (size_t)1 << 31;

/* Returns the memory type for a stored member; -1: the member is of another kind. */
static hid_t memory_type(hid_t member, const table_column *c)
{
    const H5T_class_t class = H5Tget_class(member);
    if (c->kind == FIELD_INT)
        return class == H5T_INTEGER ? H5Tcopy(H5T_NATIVE_INT) : -1;
    if (c->kind == FIELD_LONG)
        return class == H5T_INTEGER ? H5Tcopy(H5T_NATIVE_LONG) : -1;
    if (c->kind == FIELD_FLAG)
        return class == H5T_ENUM && H5Tget_size(member) == 1 ? H5Tcopy(member) : -1;
    if (c->kind == FIELD_DOUBLE)
        return class == H5T_FLOAT ? H5Tcopy(H5T_NATIVE_DOUBLE) : -1;
    if (class != H5T_STRING || H5Tis_variable_str(member) != 0 || H5Tget_size(member) >= c->room)
        return -1;
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, c->room);
    H5Tset_cset(type, H5Tget_cset(member));
    return type;
}

/* Adds a column to a row type. Returns 0 if the stored type has no such column. */
static int add_column(hid_t type, hid_t stored, const table_column *c)
{
    const int index = H5Tget_member_index(stored, c->name);
    const hid_t member = index >= 0 ? H5Tget_member_type(stored, (unsigned)index) : -1;
    const hid_t own = member >= 0 ? memory_type(member, c) : -1;
    const int good = own >= 0 && H5Tinsert(type, c->name, c->offset, own) >= 0;
    handles_close(2, (const hid_t[]){own, member});
    return good;
}

/* Returns the type of a row in memory; -1: failure. */
static hid_t row_type(hid_t stored, int columns, const table_column column[], size_t size)
{
    if (stored < 0 || H5Tget_class(stored) != H5T_COMPOUND)
        return -1;
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    for (int i = 0; i < columns; i++)
        if (!add_column(type, stored, &column[i])) {
            H5Tclose(type);
            return -1;
        }
    return type;
}

static int read_rows(hid_t set, hid_t type, hid_t stored, size_t size, void **rows)
{
    hsize_t count = 0;
    const hid_t space = H5Dget_space(set);
    const int good = space >= 0 && H5Sget_simple_extent_ndims(space) == 1 &&
                     H5Sget_simple_extent_dims(space, &count, NULL) == 1 && count <= MOST_ROWS &&
                     count * (size + H5Tget_size(stored)) <= most_bytes;
    if (space >= 0)
        H5Sclose(space);
    *rows = good ? calloc((size_t)count + 1, size) : NULL;
    if (*rows == NULL ||
        (count > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *rows) < 0))
        return -1;
    return (int)count;
}

int table_reader_rows(hid_t at, const char *name, int columns, const table_column column[],
                      size_t size, void **rows)
{
    *rows = NULL;
    const hid_t set = H5Lexists(at, name, H5P_DEFAULT) > 0 ? H5Dopen2(at, name, H5P_DEFAULT) : -1;
    const hid_t stored = set >= 0 ? H5Dget_type(set) : -1,
                type = row_type(stored, columns, column, size);
    const int count = type >= 0 ? read_rows(set, type, stored, size, rows) : -1;
    if (count < 0) {
        free(*rows);
        *rows = NULL;
    }
    handles_close(3, (const hid_t[]){type, stored, set});
    return count;
}

int table_reader_attribute_text(hid_t at, const char *name, char *text, size_t size)
{
    const hid_t a = H5Aexists(at, name) > 0 ? H5Aopen(at, name, H5P_DEFAULT) : -1;
    const hid_t type = a >= 0 ? H5Aget_type(a) : -1, space = a >= 0 ? H5Aget_space(a) : -1;
    const int good = type >= 0 && H5Tget_class(type) == H5T_STRING && !H5Tis_variable_str(type) &&
                     H5Tget_size(type) < size && H5Sget_simple_extent_npoints(space) == 1;
    memset(text, 0, size);
    const int read = good && H5Aread(a, type, text) >= 0;
    handles_close(3, (const hid_t[]){space, type, a});
    return read;
}

int table_reader_attribute_count(hid_t at, const char *name, long *out)
{
    const hid_t a = H5Aexists(at, name) > 0 ? H5Aopen(at, name, H5P_DEFAULT) : -1;
    const hid_t space = a >= 0 ? H5Aget_space(a) : -1;
    const int good = space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                     H5Aread(a, H5T_NATIVE_LONG, out) >= 0;
    handles_close(2, (const hid_t[]){space, a});
    return good;
}
