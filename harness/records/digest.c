#include "harness/records/records_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t constant[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t turned(uint32_t x, int by)
{
    return x >> by | x << (32 - by);
}

static void expand(const unsigned char block[64], uint32_t w[64])
{
    for (int i = 0; i < 16; i++)
        w[i] = (uint32_t)block[4 * i] << 24 | (uint32_t)block[4 * i + 1] << 16 |
               (uint32_t)block[4 * i + 2] << 8 | block[4 * i + 3];
    for (int i = 16; i < 64; i++) {
        const uint32_t a = w[i - 15], b = w[i - 2];
        w[i] = w[i - 16] + (turned(a, 7) ^ turned(a, 18) ^ a >> 3) + w[i - 7] +
               (turned(b, 17) ^ turned(b, 19) ^ b >> 10);
    }
}

static void compress(uint32_t state[8], const unsigned char block[64])
{
    uint32_t w[64], s[8];
    expand(block, w);
    memcpy(s, state, sizeof s);
    for (int i = 0; i < 64; i++) {
        const uint32_t chosen = (s[4] & s[5]) ^ (~s[4] & s[6]),
                       most = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]),
                       one = s[7] + (turned(s[4], 6) ^ turned(s[4], 11) ^ turned(s[4], 25)) +
                             chosen + constant[i] + w[i],
                       two = (turned(s[0], 2) ^ turned(s[0], 13) ^ turned(s[0], 22)) + most;
        memmove(s + 1, s, 7 * sizeof *s);
        s[4] += one;
        s[0] = one + two;
    }
    for (int i = 0; i < 8; i++)
        state[i] += s[i];
}

digest digest_begin(void)
{
    return (digest){.state = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f,
                              0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void digest_add(digest *d, const void *data, size_t size)
{
    const unsigned char *from = data;
    while (size > 0) {
        const size_t at = d->length % sizeof d->block, room = sizeof d->block - at,
                     part = size < room ? size : room;
        memcpy(d->block + at, from, part);
        d->length += part;
        from += part;
        size -= part;
        if (part == room)
            compress(d->state, d->block);
    }
}

void digest_add_text(digest *d, const char *text)
{
    digest_add(d, text, strlen(text) + 1);
}

void digest_add_number(digest *d, double value)
{
    const double same = value == 0 ? 0.0 : value;
    uint64_t bits = 0x7ff8000000000000U;
    unsigned char bytes[8];
    if (!isnan(same))
        memcpy(&bits, &same, sizeof bits);
    for (int i = 0; i < 8; i++)
        bytes[i] = (unsigned char)(bits >> 8 * i);
    digest_add(d, bytes, sizeof bytes);
}

void digest_text(const digest *d, char out[DIGEST_TEXT])
{
    static const unsigned char first = 0x80, none[64] = {0};
    digest last = *d;
    unsigned char bits[8];
    for (int i = 0; i < 8; i++)
        bits[i] = (unsigned char)(d->length * 8 >> 8 * (7 - i));
    digest_add(&last, &first, 1);
    digest_add(&last, none, (64 + 56 - last.length % 64) % 64);
    digest_add(&last, bits, sizeof bits);
    for (int i = 0; i < 8; i++)
        snprintf(out + 8 * i, 9, "%08x", (unsigned)last.state[i]);
}

int digest_add_file(digest *d, const char *path)
{
    static const size_t piece = 1 << 16;
    unsigned char buffer[1 << 16];
    size_t got;
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return -1;
    while ((got = fread(buffer, 1, piece, from)) > 0)
        digest_add(d, buffer, got);
    const int bad = ferror(from);
    fclose(from);
    return bad ? -1 : 0;
}

enum { MOST_RANK = 8, CHUNK = 1 << 20 };

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

/* Adds the names and values of the members of a row in order, except measured times. */
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

typedef struct table {
    hid_t set, space, type;
    int rank;
    hsize_t size[MOST_RANK];
    size_t row; /* number of bytes per value of the first index */
} table;

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

/* Called for each link. Links are visited, because the function that visits objects has changed in
 * HDF5 1.12. */
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
