#include "harness/ranges/ranges_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/catalogue/environment.h"
#include "harness/catalogue/parameters.h"
#include "harness/timing/price.h"
#include "harness/truth/checksum.h"

enum { MOST_RANKS = 4, LEVEL = 3, TEXT = 64, LONG_TEXT = 128 };
static const double piece_bytes = 256 * 1024, cache_bytes = 4 << 20;

/* A column of the file: its place in rows, its dimensions beside the points. */
typedef struct column {
    const char *name, *unit;
    hid_t type;
    int ranks, size[MOST_RANKS - 1];
    const void *first; /* of these rows; of points: NULL */
    int missing;       /* whole numbers: what stands where nothing was computed */
} column;

static int columns_of(const ranges *r, const rows *w, column out[RANGES_FILE_COLUMNS])
{
    const int f = r->formulations, m = r->meshes, q = r->quantities;
    const rows none = {.points = 0};
    const rows *from = w != NULL ? w : &none;
    const column all[RANGES_FILE_COLUMNS] = {
        {"points", NULL, H5T_NATIVE_DOUBLE, 1, {r->design.axes}, NULL, 0},
        {"reference", NULL, H5T_NATIVE_DOUBLE, 1, {q}, from->reference, 0},
        {"reference_doubt", "1", H5T_NATIVE_DOUBLE, 1, {q}, from->doubt, 0},
        {"reference_kind", NULL, H5T_NATIVE_UINT8, 1, {q}, from->kind, ROWS_NONE},
        {"value", NULL, H5T_NATIVE_DOUBLE, 3, {f, m, q}, from->value, 0},
        {"error", "1", H5T_NATIVE_DOUBLE, 3, {f, m, q}, from->error, 0},
        {"status", NULL, H5T_NATIVE_UINT8, 2, {f, m}, from->status, ROWS_NOT_COMPUTED},
        {"cost", "s", H5T_NATIVE_DOUBLE, 2, {f, m}, from->cost, 0},
        {"seconds", "s", H5T_NATIVE_DOUBLE, 2, {f, m}, from->seconds, 0},
        {"least", NULL, H5T_NATIVE_INT32, 2, {f, q}, from->least, 0}};
    memcpy(out, all, sizeof all);
    return RANGES_FILE_COLUMNS;
}

static hsize_t line_of(const column *c)
{
    hsize_t line = 1;
    for (int i = 0; i < c->ranks; i++)
        line *= (hsize_t)c->size[i];
    return line;
}

/* Points of a compressed piece: whole batches, as long as they are small. */
static hsize_t piece_of(const ranges *r, const column *c)
{
    const double most = fmax(1, piece_bytes / (double)(line_of(c) * H5Tget_size(c->type)));
    const long batch = r->points_in_batch;
    double points = batch <= most ? floor(most / (double)batch) * (double)batch : floor(most);
    points = fmin(points, (double)r->design.points);
    return (hsize_t)points;
}

static void put_unit(record *r, hid_t set, const char *unit)
{
    if (unit != NULL)
        record_text(r, set, "unit", unit);
}

static hid_t make_column(ranges_file *file, const column *c)
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
    const hid_t set =
        H5Dcreate2(file->record.file, c->name, c->type, space, H5P_DEFAULT, layout, access);
    file->record.bad |= set < 0;
    put_unit(&file->record, set, c->unit);
    H5Pclose(access);
    H5Pclose(layout);
    H5Sclose(space);
    return set;
}

/* Names by number, a line each. */
static void put_names(record *r, hid_t set, const char *name, const char *(*of)(int), int count)
{
    char text[16 * TEXT] = "";
    size_t used = 0;
    for (int i = 0; i < count && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i > 0 ? "\n" : "", of(i));
    record_text(r, set, name, text);
}

/* Words of an axis: its values in the file are their numbers. */
static void put_words(record *r, hid_t points, const axis *a)
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
    column all[RANGES_FILE_COLUMNS];
    record *r = &file->record;
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
}

/* A table of texts and numbers. */
typedef struct axis_row {
    char name[TEXT], unit[16], kind[8], scale[8];
    int count;
} axis_row;
typedef struct quantity_row {
    char name[SCENE_NAME], unit[SCENE_UNIT];
} quantity_row;
typedef struct worst_row {
    long point;
    char formulation[FORMULATION_KEY];
    int mesh;
    char quantity[SCENE_NAME];
    double error;
    char status[16], scene[LONG_TEXT];
} worst_row;

static void insert_text(hid_t table, const char *name, size_t offset, size_t length)
{
    const hid_t type = record_text_type(length);
    H5Tinsert(table, name, offset, type);
    H5Tclose(type);
}

static void put_axes(record *r, const ranges *of)
{
    axis_row row[CASE_MAX_PARAMETERS];
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->design.axes; i++) {
        const axis *a = &of->axis[i];
        const int range = a->value == NULL, scattered = of->design.kind != DESIGN_GRID;
        snprintf(row[i].name, sizeof row[i].name, "%s", a->of->name);
        snprintf(row[i].unit, sizeof row[i].unit, "%s", a->of->unit);
        snprintf(row[i].kind, sizeof row[i].kind, "%s",
                 range && scattered ? design_name(of->design.kind) : axis_kind_name(a->kind));
        snprintf(row[i].scale, sizeof row[i].scale, "%s", range ? axis_kind_name(a->kind) : "");
        row[i].count = range && scattered ? (int)of->design.points : a->count;
    }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    insert_text(type, "name", offsetof(axis_row, name), sizeof row[0].name);
    insert_text(type, "unit", offsetof(axis_row, unit), sizeof row[0].unit);
    insert_text(type, "kind", offsetof(axis_row, kind), sizeof row[0].kind);
    insert_text(type, "scale", offsetof(axis_row, scale), sizeof row[0].scale);
    H5Tinsert(type, "count", offsetof(axis_row, count), H5T_NATIVE_INT);
    H5Dclose(record_table(r, r->file, "axes", type, of->design.axes, row));
    H5Tclose(type);
}

static void put_quantities(record *r, const ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->quantity[0]);
    insert_text(type, "name", offsetof(ranges_quantity, name), sizeof of->quantity[0].name);
    insert_text(type, "unit", offsetof(ranges_quantity, unit), sizeof of->quantity[0].unit);
    H5Dclose(record_table(r, r->file, "quantities", type, of->quantities, of->quantity));
    H5Tclose(type);
}

static void put_formulations(record *r, const ranges *of)
{
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof of->formulation[0]);
    insert_text(type, "key", offsetof(formulation, key), sizeof of->formulation[0].key);
    const hid_t stored = H5Tcopy(type);
    H5Tpack(stored);
    const hsize_t size = (hsize_t)of->formulations;
    const hid_t space = H5Screate_simple(1, &size, NULL),
                set = H5Dcreate2(r->file, "formulations", stored, space, H5P_DEFAULT, H5P_DEFAULT,
                                 H5P_DEFAULT);
    r->bad |= set < 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, of->formulation) < 0;
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(stored);
    H5Tclose(type);
}

static void put_request(record *r, const ranges *of, const char *plan)
{
    const environment e = environment_now(1);
    const ranges_request *q = &of->request;
    char program[2 * LONG_TEXT], fixed[PARAMETERS_TEXT], noise[TEXT];
    const hsize_t meshes = (hsize_t)of->meshes;
    snprintf(program, sizeof program, "beamwork %s (%s)", e.version, e.commit);
    parameters_text(q->type, of->base, fixed, sizeof fixed);
    record_count(r, r->file, "beamwork_sweep", RANGES_FILE_VERSION);
    record_text(r, r->file, q->file != NULL ? "scene" : "case",
                q->file != NULL ? scene_file_path(q->type) : q->type->name);
    record_text(r, r->file, "program", program);
    record_text(r, r->file, "plan", plan);
    record_text(r, r->file, "parameters", fixed);
    record_text(r, r->file, "design", design_name(of->design.kind));
    if (of->design.kind == DESIGN_RANDOM)
        record_count(r, r->file, "seed", (long)of->design.seed);
    if (q->select != NULL)
        record_text(r, r->file, "selection", q->select);
    snprintf(noise, sizeof noise, "%.15g", price_noise);
    record_text(r, r->file, "cost_noise", noise); /* ratios of costs below it tie */
    record_count(r, r->file, "axes", of->design.axes);
    const hid_t tolerance =
        H5Acreate2(r->file, "tolerance", H5T_NATIVE_DOUBLE, r->scalar, H5P_DEFAULT, H5P_DEFAULT);
    r->bad |= tolerance < 0 || H5Awrite(tolerance, H5T_NATIVE_DOUBLE, &q->tolerance) < 0;
    H5Aclose(tolerance);
    H5Dclose(record_array(r, r->file, "meshes", H5T_NATIVE_INT, 1, &meshes, of->mesh));
    put_axes(r, of);
    put_quantities(r, of);
    put_formulations(r, of);
}

static status failed(const ranges_file *file, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.200s: the sweep could not be written (disk or memory)",
                     file->to.to.path);
}

status ranges_file_open(const char *path, const ranges *r, const char *plan, ranges_file *out,
                        fault *f)
{
    memset(out, 0, sizeof *out);
    out->of = r;
    TRY(output_open_whole(path, &out->to, f));
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    out->record =
        (record){.file = H5Fcreate(out->to.temporary, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                 .scalar = H5Screate(H5S_SCALAR)};
    for (int i = 0; i < RANGES_FILE_COLUMNS; i++)
        out->column[i] = -1;
    out->record.bad = out->record.file < 0 || out->record.scalar < 0;
    if (!out->record.bad)
        put_request(&out->record, r, plan);
    if (!out->record.bad)
        put_columns(out);
    if (!out->record.bad)
        return STATUS_OK;
    return ranges_file_close(out, NULL, "", failed(out, f), f);
}

static void write_piece(record *r, hid_t set, const column *c, long first, int points,
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

/* Words by their number in the list. */
static double place_of(const axis *a, double value)
{
    int i = 0;
    while (a->kind == AXIS_WORDS && i < a->count && a->value[i] != value)
        i++;
    return a->kind == AXIS_WORDS ? i : value;
}

static status add_points(ranges_file *file, long first, int points, const column *c, fault *f)
{
    const int axes = file->of->design.axes;
    double *at = malloc((size_t)points * (size_t)axes * sizeof *at);
    status outcome = at != NULL ? design_points(&file->of->design, first, points, at, f)
                                : fault_set(f, STATUS_FAULT, "out of memory for points");
    for (int i = 0; i < points * axes && outcome == STATUS_OK; i++)
        at[i] = place_of(&file->of->axis[i % axes], at[i]);
    if (outcome == STATUS_OK)
        write_piece(&file->record, file->column[0], c, first, points, at);
    free(at);
    return outcome;
}

status ranges_file_add(ranges_file *file, long first, const rows *w, fault *f)
{
    column all[RANGES_FILE_COLUMNS];
    const int count = columns_of(file->of, w, all);
    TRY(add_points(file, first, w->points, &all[0], f));
    for (int i = 1; i < count && !file->record.bad; i++)
        write_piece(&file->record, file->column[i], &all[i], first, w->points, all[i].first);
    return file->record.bad ? failed(file, f) : STATUS_OK;
}

static void put_worst(record *r, const ranges *of, const tally *t)
{
    worst_row row[RANGES_FORMULATIONS * TALLY_WORST];
    int count = 0;
    memset(row, 0, sizeof row);
    for (int i = 0; i < of->formulations; i++)
        for (int k = 0; k < t->worsts[i]; k++) {
            const tally_worst *w = &t->worst[i][k];
            worst_row *out = &row[count++];
            out->point = w->point;
            out->mesh = of->mesh[of->meshes - 1];
            out->error = w->error;
            snprintf(out->formulation, sizeof out->formulation, "%s", of->formulation[i].key);
            snprintf(out->quantity, sizeof out->quantity, "%s",
                     w->quantity >= 0 ? of->quantity[w->quantity].name : "");
            snprintf(out->status, sizeof out->status, "%s", rows_status_name(w->status));
            snprintf(out->scene, sizeof out->scene, "%s", w->scene);
        }
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof row[0]);
    H5Tinsert(type, "point", offsetof(worst_row, point), H5T_NATIVE_LONG);
    insert_text(type, "formulation", offsetof(worst_row, formulation), sizeof row[0].formulation);
    H5Tinsert(type, "mesh", offsetof(worst_row, mesh), H5T_NATIVE_INT);
    insert_text(type, "quantity", offsetof(worst_row, quantity), sizeof row[0].quantity);
    H5Tinsert(type, "error", offsetof(worst_row, error), H5T_NATIVE_DOUBLE);
    insert_text(type, "status", offsetof(worst_row, status), sizeof row[0].status);
    insert_text(type, "scene", offsetof(worst_row, scene), sizeof row[0].scene);
    H5Dclose(record_table(r, r->file, "worst", type, count, row));
    H5Tclose(type);
}

/* The last line behind what the library has written, and the file in its place. */
static status seal(ranges_file *file, fault *f)
{
    char line[CHECKSUM_LENGTH + 1];
    const status summed = checksum_of_file(file->to.temporary, line, f);
    if (summed == STATUS_OK) {
        fseek(file->to.stream, 0, SEEK_END);
        fputs(line, file->to.stream); /* the stream remembers an error until it is closed */
    }
    return output_finish(&file->to, summed, f);
}

status ranges_file_close(ranges_file *file, const tally *t, const char *content, status written,
                         fault *f)
{
    record *r = &file->record;
    if (written == STATUS_OK) {
        record_text(r, r->file, "content", content);
        put_worst(r, file->of, t);
    }
    for (int i = 0; i < RANGES_FILE_COLUMNS; i++)
        if (file->column[i] >= 0)
            r->bad |= H5Dclose(file->column[i]) < 0;
    H5Sclose(r->scalar);
    r->bad |= H5Fclose(r->file) < 0;
    if (written == STATUS_OK && r->bad)
        written = failed(file, f);
    return written == STATUS_OK ? seal(file, f) : output_finish(&file->to, written, f);
}
