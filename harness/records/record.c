#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* GROWTH: number of bytes by which the file in memory grows */
enum { GROWTH = 1 << 22, MOST_RANKS = 4 };

static void check(record_file *r, int good)
{
    r->bad |= !good;
}

/* Creates an HDF5 file of the oldest format, because an image of a newer format has a wrong
 * checksum in its header (HDF5 1.10). FAULT: nothing was created. */
static status open_file(record_file *r, const char *name, hid_t access, fault *f)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    r->scalar = H5Screate(H5S_SCALAR);
    r->file = access >= 0 ? H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, access) : -1;
    if (r->file >= 0 && r->scalar >= 0)
        return STATUS_OK;
    H5Sclose(r->scalar);
    return fault_memory(f, "results");
}

status record_open(record_file *r, fault *f)
{
    static unsigned number;
    char name[40];
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    snprintf(name, sizeof name, "beamwork-%u", number++);
    *r = (record_file){.file = -1};
    const int good = access >= 0 && H5Pset_fapl_core(access, GROWTH, 0) >= 0;
    const status outcome = open_file(r, name, good ? access : -1, f);
    H5Pclose(access);
    return outcome;
}

status record_open_beside(record_file *r, const char *path, fault *f)
{
    *r = (record_file){.file = -1};
    TRY(output_open_whole(path, &r->to, f));
    const status outcome = open_file(r, r->to.temporary, H5P_DEFAULT, f);
    return outcome == STATUS_OK ? STATUS_OK : output_finish(&r->to, outcome, f);
}

static status write_bytes(const char *image, size_t size, const char *path, fault *f)
{
    output file;
    char line[CHECKSUM_LENGTH + 1];
    TRY(output_open_whole(path, &file, f));
    checksum_write(image, size, line);
    fwrite(image, 1, size, file.stream);
    fputs(line, file.stream);
    return output_close(&file, f);
}

static status write_image(const record_file *r, const char *path, fault *f)
{
    if (r->bad)
        return fault_set(f, STATUS_FAULT,
                         "the results could not be stored in HDF5, probably because the memory is "
                         "full; close other programs, and run the command again");
    if (path == NULL)
        return STATUS_OK;
    const ssize_t size =
        H5Fflush(r->file, H5F_SCOPE_GLOBAL) >= 0 ? H5Fget_file_image(r->file, NULL, 0) : -1;
    char *image = size > 0 ? malloc((size_t)size) : NULL;
    if (image == NULL || H5Fget_file_image(r->file, image, (size_t)size) != size) {
        free(image);
        return fault_memory(f, "the contents of %.200s", path);
    }
    const status outcome = write_bytes(image, (size_t)size, path, f);
    free(image);
    return outcome;
}

static int close_file(record_file *r)
{
    H5Sclose(r->scalar);
    return H5Fclose(r->file) >= 0;
}

status record_drop(record_file *r, status outcome)
{
    close_file(r);
    return r->to.stream != NULL ? output_finish(&r->to, outcome, NULL) : outcome;
}

static status close_on_disk(record_file *r, fault *f)
{
    char line[CHECKSUM_LENGTH + 1];
    status outcome =
        close_file(r) && !r->bad
            ? checksum_of_file(r->to.temporary, line, f)
            : fault_set(f, STATUS_FAULT,
                        "%.200s could not be written, because the disk or the memory is full; free "
                        "disk space or memory, and run the command again",
                        r->to.to.path);
    if (outcome == STATUS_OK) {
        fseek(r->to.stream, 0, SEEK_END);
        fputs(line, r->to.stream);
    }
    return output_finish(&r->to, outcome, f);
}

status record_close(record_file *r, const char *path, fault *f)
{
    return r->to.stream != NULL ? close_on_disk(r, f) : record_drop(r, write_image(r, path, f));
}

hid_t record_group(record_file *r, hid_t at, const char *name)
{
    const hid_t g = H5Lexists(at, name, H5P_DEFAULT) > 0
                        ? H5Gopen2(at, name, H5P_DEFAULT)
                        : H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    check(r, g >= 0);
    return g;
}

hid_t record_text_type(size_t length)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length > 0 ? length : 1);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

static void put(record_file *r, hid_t at, const char *name, hid_t type, const void *value)
{
    const hid_t a = r->bad ? -1 : H5Acreate2(at, name, type, r->scalar, H5P_DEFAULT, H5P_DEFAULT);
    check(r, a >= 0 && H5Awrite(a, type, value) >= 0);
    H5Aclose(a);
}

void record_text(record_file *r, hid_t at, const char *name, const char *text)
{
    const hid_t type = record_text_type(strlen(text));
    put(r, at, name, type, text);
    H5Tclose(type);
}

void record_count(record_file *r, hid_t at, const char *name, long value)
{
    put(r, at, name, H5T_NATIVE_LONG, &value);
}

void record_number(record_file *r, hid_t at, const char *name, double value)
{
    put(r, at, name, H5T_NATIVE_DOUBLE, &value);
}

void record_version(record_file *r, hid_t at, const char *name, const int version[2])
{
    const hsize_t size = 2;
    const hid_t space = H5Screate_simple(1, &size, NULL);
    const hid_t a =
        r->bad ? -1 : H5Acreate2(at, name, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT);
    check(r, a >= 0 && H5Awrite(a, H5T_NATIVE_INT, version) >= 0);
    H5Aclose(a);
    H5Sclose(space);
}

void record_ascii(record_file *r, hid_t at, const char *name, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    put(r, at, name, type, text);
    H5Tclose(type);
}

/* Returns the layout of a data set. Large data sets are compressed, in chunks along the first
 * dimension. */
static hid_t layout_of(hid_t type, int rank, const hsize_t size[])
{
    enum { LEAST = 4096, PIECE = 1 << 20, LEVEL = 3 }; /* [bytes]; LEVEL: of compression */
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    hsize_t piece[MOST_RANKS], line = H5Tget_size(type);
    for (int i = 1; i < rank; i++) {
        piece[i] = size[i];
        line *= size[i];
    }
    if (rank == 0 || line == 0 || line * size[0] < LEAST)
        return layout;
    piece[0] = PIECE / line > 0 ? PIECE / line : 1;
    piece[0] = piece[0] < size[0] ? piece[0] : size[0];
    H5Pset_chunk(layout, rank, piece);
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, LEVEL);
    return layout;
}

hid_t record_array(record_file *r, hid_t at, const char *name, hid_t type, int rank,
                   const hsize_t size[], const void *value)
{
    const hid_t space = rank > 0 ? H5Screate_simple(rank, size, NULL) : r->scalar,
                layout = layout_of(type, rank, size);
    const hid_t set =
        r->bad ? -1 : H5Dcreate2(at, name, type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    int empty = 0;
    for (int i = 0; i < rank; i++)
        empty |= size[i] == 0;
    check(r, set >= 0 && (empty || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0));
    H5Pclose(layout);
    if (rank > 0)
        H5Sclose(space);
    return set;
}

hid_t record_values(record_file *r, hid_t at, const char *name, int rank, const hsize_t size[],
                    const double value[], const char *unit)
{
    const hid_t set = record_array(r, at, name, H5T_NATIVE_DOUBLE, rank, size, value);
    if (unit != NULL)
        record_text(r, set, "unit", unit);
    return set;
}

hid_t record_table(record_file *r, hid_t at, const char *name, hid_t type, int count,
                   const void *row)
{
    const hsize_t size = (hsize_t)count;
    return record_array(r, at, name, type, 1, &size, row);
}

/* Returns the texts of text[count] in one block, each padded to the length of the longest text,
 * *longest; NULL: out of memory. */
static char *side_by_side(int count, const char *const text[], size_t *longest)
{
    *longest = 1;
    for (int i = 0; i < count; i++)
        *longest = strlen(text[i]) > *longest ? strlen(text[i]) : *longest;
    char *all = calloc((size_t)count + 1, *longest);
    if (all != NULL)
        for (int i = 0; i < count; i++)
            memcpy(all + (size_t)i * *longest, text[i], strlen(text[i]));
    return all;
}

void record_texts(record_file *r, hid_t at, const char *name, int count, const char *const text[])
{
    size_t longest;
    char *all = side_by_side(count, text, &longest);
    const hid_t type = record_text_type(longest);
    check(r, all != NULL);
    H5Dclose(record_table(r, at, name, type, count, all));
    free(all);
    H5Tclose(type);
}

void record_text_list(record_file *r, hid_t at, const char *name, int count,
                      const char *const text[])
{
    size_t longest;
    char *all = side_by_side(count, text, &longest);
    const hsize_t size = (hsize_t)count;
    const hid_t type = record_text_type(longest), space = H5Screate_simple(1, &size, NULL);
    const hid_t a =
        r->bad || all == NULL ? -1 : H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    check(r, a >= 0 && H5Awrite(a, type, all) >= 0);
    H5Aclose(a);
    H5Sclose(space);
    H5Tclose(type);
    free(all);
}

/* A column: its field, and its offset and size in a row [byte]. */
typedef struct rows_column {
    const schema_field *field;
    size_t offset, size;
} rows_column;

/* number of bytes of a value; for a text, the length of the longest text in the column */
static const size_t size_of_kind[FIELD_KINDS] = {[FIELD_INT] = sizeof(int),
                                                 [FIELD_LONG] = sizeof(long),
                                                 [FIELD_DOUBLE] = sizeof(double),
                                                 [FIELD_FLAG] = 1};

static size_t times(const schema_field *which)
{
    return which->count > 0 ? (size_t)which->count : 1;
}

static size_t longest_text(const schema_field *which, int count, const subject row[])
{
    size_t longest = 1;
    for (int i = 0; i < count; i++) {
        field_value v;
        schema_read(&row[i], which, &v);
        const size_t length = strlen(v.text);
        longest = length > longest ? length : longest;
    }
    return longest;
}

static size_t lay_out(int fields, const schema_field *const list[], int count, const subject row[],
                      rows_column out[])
{
    size_t size = 0;
    for (int i = 0; i < fields; i++) {
        const size_t fixed = size_of_kind[list[i]->kind] * times(list[i]);
        out[i] =
            (rows_column){list[i], size, fixed > 0 ? fixed : longest_text(list[i], count, row)};
        size += out[i].size;
    }
    return size;
}

static hid_t boolean_type(void)
{
    const hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
    H5Tenum_insert(type, "FALSE", &(signed char){0});
    H5Tenum_insert(type, "TRUE", &(signed char){1});
    return type;
}

static hid_t type_of(const rows_column *c)
{
    const hsize_t side = (hsize_t)lround(sqrt(c->field->count)), square[2] = {side, side};
    if (c->field->count > 0)
        return H5Tarray_create2(H5T_NATIVE_DOUBLE, 2, square);
    if (c->field->kind == FIELD_INT || c->field->kind == FIELD_LONG)
        return H5Tcopy(c->field->kind == FIELD_INT ? H5T_NATIVE_INT : H5T_NATIVE_LONG);
    if (c->field->kind == FIELD_DOUBLE)
        return H5Tcopy(H5T_NATIVE_DOUBLE);
    return c->field->kind == FIELD_FLAG ? boolean_type() : record_text_type(c->size);
}

static hid_t row_type(int fields, const rows_column list[], size_t size)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, size);
    for (int i = 0; i < fields; i++) {
        const hid_t one = type_of(&list[i]);
        H5Tinsert(type, list[i].field->name, list[i].offset, one);
        H5Tclose(one);
    }
    return type;
}

static void pack(const rows_column *c, const subject *s, char *to)
{
    field_value v;
    schema_read(s, c->field, &v);
    const int whole = (int)v.whole;
    if (c->field->kind == FIELD_INT)
        memcpy(to, &whole, sizeof whole);
    else if (c->field->kind == FIELD_LONG)
        memcpy(to, &v.whole, sizeof v.whole);
    else if (c->field->kind == FIELD_DOUBLE)
        memcpy(to, v.numbers, c->size);
    else if (c->field->kind == FIELD_FLAG)
        *to = (char)(v.whole != 0);
    else
        memcpy(to, v.text, strlen(v.text));
}

static void put_attributes(record_file *r, hid_t set, int fields, const schema_field *const list[])
{
    const char *unit[SCHEMA_MOST_FIELDS], *summary[SCHEMA_MOST_FIELDS];
    for (int i = 0; i < fields; i++) {
        unit[i] = list[i]->unit;
        summary[i] = list[i]->summary;
    }
    record_text_list(r, set, "units", fields, unit);
    record_text_list(r, set, "summaries", fields, summary);
}

void record_rows(record_file *r, hid_t at, const char *name, int fields,
                 const schema_field *const list[], int count, const subject row[])
{
    rows_column columns[SCHEMA_MOST_FIELDS];
    const size_t size = lay_out(fields, list, count, row, columns);
    char *rows = calloc((size_t)count + 1, size);
    r->bad |= rows == NULL;
    if (rows != NULL)
        for (int i = 0; i < count; i++)
            for (int k = 0; k < fields; k++)
                pack(&columns[k], &row[i], rows + (size_t)i * size + columns[k].offset);
    if (rows != NULL) {
        const hid_t type = row_type(fields, columns, size),
                    set = record_table(r, at, name, type, count, rows);
        put_attributes(r, set, fields, list);
        H5Dclose(set);
        H5Tclose(type);
    }
    free(rows);
}

static void rows_with(record_file *r, hid_t at, const record_type *type, int keys, int count,
                      const subject row[])
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(type, keys, list);
    record_rows(r, at, type->table, fields, list, count, row);
}

void record_rows_of_type(record_file *r, hid_t at, const record_type *type, int count,
                         const subject row[])
{
    rows_with(r, at, type, KEY, count, row);
}

void record_rows_alone(record_file *r, hid_t at, const record_type *type, int count,
                       const subject row[])
{
    rows_with(r, at, type, KEY_AROUND, count, row);
}

static void put_field(record_file *r, hid_t at, const schema_field *which, const field_value *v)
{
    if (which->kind == FIELD_TEXT || which->kind == FIELD_ENUM)
        record_text(r, at, which->name, v->text);
    else if (which->kind == FIELD_DOUBLE)
        record_number(r, at, which->name, *v->numbers);
    else
        record_count(r, at, which->name, v->whole);
}

void record_fields(record_file *r, hid_t at, const record_type *type, const subject *s)
{
    const schema_field *list[SCHEMA_MOST_FIELDS];
    const int fields = schema_fields(type, KEY_AROUND, list);
    for (int i = 0; i < fields; i++) {
        field_value v;
        schema_read(s, list[i], &v);
        put_field(r, at, list[i], &v);
    }
}

void follow_record_csv(FILE *to, const char *parameter, const follow_curves *c)
{
    fprintf(to, "%s,asked,mode,frequency,match\n", parameter);
    for (int k = 0; k < c->samples; k++)
        for (int i = 0; i < c->modes; i++)
            fprintf(to, "%.17g,%d,%d,%.17g,%.17g\n", c->sample[k].value, c->sample[k].requested,
                    i + 1, c->sample[k].frequency[i], c->sample[k].match[i]);
}

static json_t *curve_of(const follow_curves *c, int mode)
{
    json_t *frequency = json_array(), *match = json_array();
    for (int k = 0; k < c->samples; k++) {
        json_array_append_new(frequency, json_real(c->sample[k].frequency[mode]));
        json_array_append_new(match, json_real(c->sample[k].match[mode]));
    }
    return json_pack("{s:i,s:o,s:o}", "mode", mode + 1, "frequency", frequency, "match", match);
}

static json_t *event_of(const follow_event *e)
{
    return json_pack("{s:s,s:[i,i],s:f,s:f,s:f}", "kind", e->crossing ? "crossing" : "veering",
                     "modes", e->mode[0] + 1, e->mode[1] + 1, "value", e->value, "frequency",
                     e->frequency, "gap", e->gap);
}

status follow_record_json(FILE *to, const char *parameter, const follow_curves *c, fault *f)
{
    json_t *value = json_array(), *requested = json_array(), *curves = json_array(),
           *events = json_array();
    for (int k = 0; k < c->samples; k++) {
        json_array_append_new(value, json_real(c->sample[k].value));
        json_array_append_new(requested, json_boolean(c->sample[k].requested));
    }
    for (int i = 0; i < c->modes; i++)
        json_array_append_new(curves, curve_of(c, i));
    for (int i = 0; i < c->events; i++)
        json_array_append_new(events, event_of(&c->event[i]));
    return json_finish(json_pack("{s:s,s:o,s:o,s:o,s:o}", "parameter", parameter, "values", value,
                                 "asked", requested, "curves", curves, "events", events),
                       to, f);
}
