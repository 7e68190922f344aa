#include "harness/records/results_hash.h"

#include <hdf5.h>
#include <stdlib.h>
#include <string.h>

#include "harness/records/results_case.h"
#include "harness/study/study.h"

enum { MOST_RANK = 8, CHUNK = 1 << 20 /* [bytes] of rows that are read together */ };

typedef struct walk {
    digest d;
    long values;
    int bad;
} walk;

static void add_text(walk *w, const char *text, size_t room)
{
    const size_t length = strnlen(text, room);
    digest_add(&w->d, text, length);
    digest_add(&w->d, "", 1);
    w->values++;
}

static void add_float(walk *w, const char *at, size_t size)
{
    float narrow = 0;
    double value = 0;
    if (size == sizeof narrow) {
        memcpy(&narrow, at, sizeof narrow);
        value = narrow;
    } else
        memcpy(&value, at, sizeof value);
    digest_add_number(&w->d, value);
    w->values++;
}

static void add_value(walk *w, hid_t type, const char *at);

/* Members in their order; times are left out. */
static void add_compound(walk *w, hid_t type, const char *at)
{
    const int members = H5Tget_nmembers(type);
    for (int i = 0; i < members; i++) {
        char *name = H5Tget_member_name(type, (unsigned)i);
        const hid_t member = H5Tget_member_type(type, (unsigned)i);
        if (name != NULL && strncmp(name, "seconds", 7) != 0) {
            digest_add_text(&w->d, name);
            add_value(w, member, at + H5Tget_member_offset(type, (unsigned)i));
        }
        H5Tclose(member);
        H5free_memory(name);
    }
}

static void add_array(walk *w, hid_t type, const char *at)
{
    const hid_t of = H5Tget_super(type);
    const size_t size = H5Tget_size(of);
    for (size_t i = 0; size > 0 && i < H5Tget_size(type) / size; i++)
        add_value(w, of, at + i * size);
    H5Tclose(of);
}

static void add_value(walk *w, hid_t type, const char *at)
{
    const size_t size = H5Tget_size(type);
    switch (H5Tget_class(type)) {
    case H5T_COMPOUND:
        add_compound(w, type, at);
        break;
    case H5T_ARRAY:
        add_array(w, type, at);
        break;
    case H5T_STRING:
        if (H5Tis_variable_str(type) > 0)
            w->bad = 1;
        else
            add_text(w, at, size);
        break;
    case H5T_FLOAT:
        if (size == sizeof(double) || size == sizeof(float))
            add_float(w, at, size);
        else
            w->bad = 1;
        break;
    case H5T_INTEGER:
    case H5T_ENUM:
        digest_add(&w->d, at, size);
        w->values++;
        break;
    default:
        w->bad = 1;
    }
}

/* A dataset, opened. */
typedef struct table {
    hid_t set, space, type; /* of memory */
    int rank;
    hsize_t size[MOST_RANK];
    size_t row; /* [bytes] of all that has one first index */
} table;

/* Rows first to first + count - 1. */
static void add_rows(walk *w, const table *t, char *room, hsize_t first, hsize_t count)
{
    hsize_t start[MOST_RANK] = {first}, size[MOST_RANK];
    const size_t each = H5Tget_size(t->type);
    memcpy(size, t->size, sizeof size);
    size[0] = count;
    const int single = t->rank == 0;
    const hid_t memory = single ? H5Screate(H5S_SCALAR) : H5Screate_simple(t->rank, size, NULL);
    if ((!single && H5Sselect_hyperslab(t->space, H5S_SELECT_SET, start, NULL, size, NULL) < 0) ||
        H5Dread(t->set, t->type, memory, t->space, H5P_DEFAULT, room) < 0)
        w->bad = 1;
    for (size_t i = 0; !w->bad && i < count * t->row / each; i++)
        add_value(w, t->type, room + i * each);
    H5Sclose(memory);
}

static void add_table(walk *w, const table *t)
{
    const hsize_t together = t->row < CHUNK ? CHUNK / t->row : 1;
    char *room = malloc(together * t->row);
    w->bad |= room == NULL;
    for (hsize_t at = 0; !w->bad && at < t->size[0]; at += together)
        add_rows(w, t, room, at, at + together < t->size[0] ? together : t->size[0] - at);
    free(room);
}

static void open_table(walk *w, hid_t set)
{
    const hid_t stored = H5Dget_type(set);
    table t = {.set = set,
               .space = H5Dget_space(set),
               .type = H5Tget_native_type(stored, H5T_DIR_ASCEND),
               .size = {1}};
    t.rank = H5Sget_simple_extent_ndims(t.space);
    t.row = t.type >= 0 ? H5Tget_size(t.type) : 0;
    if (t.rank < 0 || t.rank > MOST_RANK || t.row == 0)
        w->bad = 1;
    else {
        H5Sget_simple_extent_dims(t.space, t.size, NULL);
        for (int i = 0; i < t.rank; i++) {
            digest_add_number(&w->d, (double)t.size[i]);
            t.row *= i > 0 ? t.size[i] : 1;
        }
        if (t.row > 0)
            add_table(w, &t);
    }
    H5Tclose(t.type);
    H5Tclose(stored);
    H5Sclose(t.space);
}

static int is_left_out(const char *path)
{
    const char *leaf = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path;
    return strcmp(leaf, "timings") == 0 || strncmp(leaf, "seconds", 7) == 0;
}

/* Of links, whose visit every version of HDF5 calls the same; that of objects changed in 1.12. */
static herr_t visit(hid_t file, const char *path, const H5L_info_t *link, void *context)
{
    walk *w = context;
    if (link->type != H5L_TYPE_HARD || is_left_out(path))
        return 0;
    const hid_t object = H5Oopen(file, path, H5P_DEFAULT);
    if (object < 0)
        w->bad = 1;
    else if (H5Iget_type(object) == H5I_DATASET) {
        digest_add_text(&w->d, path);
        open_table(w, object);
    }
    H5Oclose(object);
    return w->bad;
}

status results_hash_of(const char *path, results_hash *out, fault *f)
{
    walk w = {.d = digest_begin()};
    TRY(checksum_check(path, f));
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    const herr_t walked = file >= 0 ? H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &w) : -1;
    if (file >= 0)
        H5Fclose(file);
    digest_text(&w.d, out->text);
    out->values = w.values;
    return walked == 0 && !w.bad ? STATUS_OK : results_case_damaged(path, "", "a dataset", f);
}
