#include "harness/experiments/experiments_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/model/model.h"

enum { MOST_RANKS = 4, LEVEL = 3, LINE = 1024 };
static const double piece_bytes = 256 * 1024, cache_bytes = 4 << 20;

/* A column of the file: the position in `rows`, and the dimensions after the points. */
typedef struct file_column {
    const char *name, *unit;
    hid_t type;
    int ranks, size[MOST_RANKS - 1];
    const void *first;
    int missing; /* value of missing entries, for columns of whole numbers */
} file_column;

static int columns_of(const parameter_ranges *r, const rows *w,
                      file_column out[RANGES_FILE_COLUMNS])
{
    const int f = r->formulations, m = r->meshes, q = r->quantities;
    const rows none = {.points = 0};
    const rows *from = w != NULL ? w : &none;
    const file_column all[RANGES_FILE_COLUMNS] = {
        {"points", NULL, H5T_NATIVE_DOUBLE, 1, {r->design.axes}, NULL, 0},
        {"reference", NULL, H5T_NATIVE_DOUBLE, 1, {q}, from->reference, 0},
        {"reference_doubt", "1", H5T_NATIVE_DOUBLE, 1, {q}, from->uncertainty, 0},
        {"reference_kind", NULL, H5T_NATIVE_UINT8, 1, {q}, from->kind, ROWS_NONE},
        {"value", NULL, H5T_NATIVE_DOUBLE, 3, {f, m, q}, from->value, 0},
        {"error", "1", H5T_NATIVE_DOUBLE, 3, {f, m, q}, from->error, 0},
        {"status", NULL, H5T_NATIVE_UINT8, 2, {f, m}, from->status, ROWS_NOT_COMPUTED},
        {"cost", "s", H5T_NATIVE_DOUBLE, 2, {f, m}, from->cost, 0},
        {"seconds", "s", H5T_NATIVE_DOUBLE, 2, {f, m}, from->seconds, 0},
        {"least", NULL, H5T_NATIVE_INT32, 2, {f, q}, from->least, 0},
        {"not_modelled", NULL, H5T_NATIVE_INT32, 1, {f}, from->lacks, 0}};
    memcpy(out, all, sizeof all);
    return RANGES_FILE_COLUMNS;
}

static hsize_t line_of(const file_column *c)
{
    hsize_t line = 1;
    for (int i = 0; i < c->ranks; i++)
        line *= (hsize_t)c->size[i];
    return line;
}

/* Returns the number of points in a compressed chunk. If batches are small, a chunk contains whole
 * batches. */
static hsize_t piece_of(const parameter_ranges *r, const file_column *c)
{
    const double most = fmax(1, piece_bytes / (double)(line_of(c) * H5Tget_size(c->type)));
    const long batch = r->points_in_batch;
    double points = batch <= most ? floor(most / (double)batch) * (double)batch : floor(most);
    points = fmin(points, (double)r->design.points);
    return (hsize_t)points;
}

static void put_unit(record_file *r, hid_t set, const char *unit)
{
    if (unit != NULL)
        record_text(r, set, "unit", unit);
}

static hid_t make_column(ranges_file *file, const file_column *c)
{
    hsize_t size[MOST_RANKS] = {(hsize_t)file->of->design.points}, piece[MOST_RANKS];
    piece[0] = piece_of(file->of, c);
    for (int i = 0; i < c->ranks; i++)
        size[i + 1] = piece[i + 1] = (hsize_t)c->size[i];
    const hid_t space = H5Screate_simple(c->ranks + 1, size, NULL),
                layout = H5Pcreate(H5P_DATASET_CREATE), access = H5Pcreate(H5P_DATASET_ACCESS);
    H5Pset_chunk(layout, c->ranks + 1, piece);
    H5Pset_shuffle(layout);
    H5Pset_deflate(layout, LEVEL);
    if (c->type == H5T_NATIVE_DOUBLE)
        H5Pset_fill_value(layout, H5T_NATIVE_DOUBLE, &(const double){NAN});
    else
        H5Pset_fill_value(layout, H5T_NATIVE_INT, &c->missing);
    H5Pset_chunk_cache(access, H5D_CHUNK_CACHE_NSLOTS_DEFAULT, (size_t)cache_bytes,
                       H5D_CHUNK_CACHE_W0_DEFAULT);
    const hid_t set = H5Dcreate2(file->at, c->name, c->type, space, H5P_DEFAULT, layout, access);
    file->record.bad |= set < 0;
    put_unit(&file->record, set, c->unit);
    H5Pclose(access);
    H5Pclose(layout);
    H5Sclose(space);
    return set;
}

static void put_names(record_file *r, hid_t set, const char *name, const char *(*of)(int),
                      int count)
{
    char text[LINE] = "";
    size_t used = 0;
    for (int i = 0; i < count && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i > 0 ? "\n" : "", of(i));
    record_text(r, set, name, text);
}

static const char *name_of_bit(int bit)
{
    static char words[OMIT_WORDS];
    missing_omit_words(1u << bit, words);
    return words;
}

static void put_words(record_file *r, hid_t points, const sweep_axis *a)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    for (int i = 0; to != NULL && i < a->count; i++) {
        char word[ASSIGNMENT_VALUE];
        axis_text(a, a->value[i], word, sizeof word);
        fprintf(to, "%s%s", i > 0 ? "\n" : "", word);
    }
    r->bad |= to == NULL || fclose(to) != 0;
    if (!r->bad)
        record_text(r, points, a->of->name, text);
    free(text);
}

static void put_columns(ranges_file *file)
{
    file_column all[RANGES_FILE_COLUMNS];
    record_file *r = &file->record;
    const int count = columns_of(file->of, NULL, all);
    for (int i = 0; i < count && !r->bad; i++)
        file->column[i] = make_column(file, &all[i]);
    if (r->bad)
        return;
    for (int i = 0; i < file->of->design.axes; i++)
        if (file->of->axis[i].kind == AXIS_WORDS)
            put_words(r, file->column[0], &file->of->axis[i]);
    put_names(r, file->column[3], "names", rows_reference_name, ROWS_REFERENCES);
    put_names(r, file->column[6], "names", rows_status_name, ROWS_STATUSES);
    put_names(r, file->column[10], "bits", name_of_bit, OMIT_BITS);
}

static status failed(const ranges_file *file, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s could not be written, because the disk or the memory is full; free "
                     "disk space or memory, and run the same command again",
                     file->path);
}

status ranges_file_open(const char *path, const parameter_ranges *r, const char *plan,
                        ranges_file *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->of = r;
    out->path = path;
    TRY(record_open_beside(&out->record, path, f));
    out->at = kept_group(&out->record, KEPT_SWEEP);
    for (int i = 0; i < RANGES_FILE_COLUMNS; i++)
        out->column[i] = -1;
    if (!out->record.bad)
        ranges_file_request(&out->record, out->at, r, plan);
    if (!out->record.bad)
        put_columns(out);
    if (!out->record.bad)
        return STATUS_OK;
    return ranges_file_close(out, NULL, "", failed(out, f), f);
}

static void write_piece(record_file *r, hid_t set, const file_column *c, long first, int points,
                        const void *value)
{
    hsize_t from[MOST_RANKS] = {(hsize_t)first}, size[MOST_RANKS] = {(hsize_t)points};
    for (int i = 0; i < c->ranks; i++)
        size[i + 1] = (hsize_t)c->size[i];
    const hid_t file = H5Dget_space(set), memory = H5Screate_simple(c->ranks + 1, size, NULL);
    H5Sselect_hyperslab(file, H5S_SELECT_SET, from, NULL, size, NULL);
    r->bad |= H5Dwrite(set, c->type, memory, file, H5P_DEFAULT, value) < 0;
    H5Sclose(memory);
    H5Sclose(file);
}

/* Returns the number stored for a value of an axis: the index of a word in the list, or the
 * value. */
static double frame_motion_of(const sweep_axis *a, double value)
{
    int i = 0;
    while (a->kind == AXIS_WORDS && i < a->count && a->value[i] != value)
        i++;
    return a->kind == AXIS_WORDS ? i : value;
}

static status add_points(ranges_file *file, long first, int points, const file_column *c, fault *f)
{
    const int axes = file->of->design.axes;
    double *at = malloc((size_t)points * (size_t)axes * sizeof *at);
    status outcome = at != NULL ? design_points(&file->of->design, first, points, at, f)
                                : fault_memory(f, "points");
    for (int i = 0; i < points * axes && outcome == STATUS_OK; i++)
        at[i] = frame_motion_of(&file->of->axis[i % axes], at[i]);
    if (outcome == STATUS_OK)
        write_piece(&file->record, file->column[0], c, first, points, at);
    free(at);
    return outcome;
}

status ranges_file_add(ranges_file *file, long first, const rows *w, fault *f)
{
    file_column all[RANGES_FILE_COLUMNS];
    const int count = columns_of(file->of, w, all);
    TRY(add_points(file, first, w->points, &all[0], f));
    for (int i = 1; i < count && !file->record.bad; i++)
        write_piece(&file->record, file->column[i], &all[i], first, w->points, all[i].first);
    return file->record.bad ? failed(file, f) : STATUS_OK;
}

status ranges_file_close(ranges_file *file, const tally *t, const char *content, status written,
                         fault *f)
{
    record_file *r = &file->record;
    if (written == STATUS_OK) {
        record_text(r, file->at, "content", content);
        ranges_file_worst(r, file->at, file->of, t);
    }
    for (int i = 0; i < RANGES_FILE_COLUMNS; i++)
        if (file->column[i] >= 0)
            r->bad |= H5Dclose(file->column[i]) < 0;
    H5Gclose(file->at);
    return written == STATUS_OK ? kept_close(r, KEPT_SWEEP, file->path, f)
                                : record_drop(r, written);
}

static void write_text(FILE *to, const void *text)
{
    fputs(text, to);
}

/* Writes the scene of a point as a string, which the caller frees. The string is "" if the scene
 * cannot be written as a scene file. */
static status text_of(const parameter_ranges *r, long index, char **text, fault *f)
{
    double at[CASE_MAX_PARAMETERS], value[CASE_MAX_PARAMETERS];
    char where[FAULT_TEXT], summary[2 * FAULT_TEXT];
    const case_type *type = r->request.type;
    scene s;
    fault why;
    TRY(design_points(&r->design, index, 1, at, f));
    ranges_points_values(r, at, value);
    ranges_points_text(r, at, where, sizeof where);
    snprintf(summary, sizeof summary, "%.200s, at %s", type->summary, where);
    const write_head head = {type->name, summary, type->source};
    const status built = cell_scene(type, value, NULL, &s, &why);
    *text = write_scene_text(built == STATUS_OK ? &s : NULL, &head);
    scene_free(&s);
    return *text != NULL ? STATUS_OK : fault_memory(f, "a scene");
}

/* Returns the name of the scene if the point occurs earlier in the list; otherwise NULL. */
static const char *name_known(const tally *t, int which, int k, long index)
{
    for (int i = 0; i <= which; i++)
        for (int j = 0; j < t->worsts[i] && (i < which || j < k); j++)
            if (t->worst[i][j].point == index)
                return t->worst[i][j].scene;
    return NULL;
}

static status write_one(const output_folder *folder, tally *t, int which, int k, fault *f)
{
    tally_worst *w = &t->worst[which][k];
    char name[TALLY_SCENE], *text;
    const char *other = name_known(t, which, k, w->point);
    if (other != NULL) {
        snprintf(w->scene, sizeof w->scene, "%s", other);
        return STATUS_OK;
    }
    TRY(text_of(t->of, w->point, &text, f));
    snprintf(name, sizeof name, "point_%ld.yaml", w->point);
    status outcome = STATUS_OK;
    if (text[0] != '\0') {
        outcome = output_folder_file(folder, name, write_text, text, f);
        snprintf(w->scene, sizeof w->scene, "%s", name);
    }
    free(text);
    return outcome;
}

static status write_all(const output_folder *folder, tally *t, fault *f)
{
    for (int i = 0; i < t->of->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++)
            TRY(write_one(folder, t, i, k, f));
    return STATUS_OK;
}

status worst_write(const char *folder, tally *t, fault *f)
{
    output_folder out;
    TRY(output_folder_open(folder, &out, f));
    return output_folder_finish(&out, write_all(&out, t, f), f);
}
