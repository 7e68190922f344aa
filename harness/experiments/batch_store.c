#include "harness/experiments/experiments_impl.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Returns 1 if the two machines have the same processor and BLAS library. Host names may differ. */
static int node_same_kind(const machine *, const machine *);

static status path_of(const char *folder, const char *name, char out[PATH_MAX], fault *f)
{
    return snprintf(out, PATH_MAX, "%s/%s", folder, name) < PATH_MAX
               ? STATUS_OK
               : fault_set(
                     f, STATUS_FAULT,
                     "%.200s: the path of the batch is too long; move the folder to a shorter path",
                     folder);
}

status batch_store_path(const batch_store *s, int batch, char out[PATH_MAX], fault *f)
{
    char name[BATCH_NAME];
    batch_name(s->stem, batch, name);
    return path_of(s->folder[s->where[batch]], name, out, f);
}

static status add_kind(batch_store *s, const machine *of, fault *f)
{
    for (int i = 0; i < s->kinds; i++)
        if (node_same_kind(&s->kind[i].node, of)) {
            s->kind[i].batches++;
            return STATUS_OK;
        }
    batch_store_kind *more = realloc(s->kind, ((size_t)s->kinds + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "the kinds of machines");
    s->kind = more;
    s->kind[s->kinds++] = (batch_store_kind){*of, 1};
    return STATUS_OK;
}

static status hold_against(batch_store *s, const batch_label *label, const char *path, fault *f)
{
    char other[PATH_MAX];
    batch_label first;
    TRY(batch_store_path(s, label->batch, other, f));
    TRY(batch_read_label(other, &first, f));
    const int same = strcmp(first.content, label->content) == 0;
    batch_label_free(&first);
    s->twice++;
    return same ? STATUS_OK
                : fault_set(f, STATUS_REFUSED,
                            "%.130s and %.130s contain different results of the same batch; remove "
                            "the wrong one",
                            other, path);
}

static status add(batch_store *s, const batch_label *label, const char *path, int folder, fault *f)
{
    if (s->where[label->batch] >= 0)
        return hold_against(s, label, path, f);
    if (s->there == 0)
        s->shards = label->shards;
    else if (s->shards != label->shards)
        s->shards = 0;
    s->where[label->batch] = folder;
    s->there++;
    s->seconds += label->seconds;
    return add_kind(s, &label->node, f);
}

static status look_inside(batch_store *s, const shard_work *w, const char *path, int batch,
                          int folder, FILE *messages, fault *f)
{
    batch_label label;
    fault why = {""};
    if (batch_open(path, &label, NULL, NULL, &why) != STATUS_OK) {
        s->damaged++;
        if (messages != NULL)
            fprintf(messages, "beamwork: %s (this batch counts as missing)\n", why.text);
        return STATUS_OK;
    }
    status outcome = batch_belongs(&label, w, path, f);
    if (outcome == STATUS_OK && (label.batch != batch || label.batches != w->batches))
        outcome = fault_set(f, STATUS_REFUSED,
                            "%.200s contains batch %d of %d, which does not match the name of the "
                            "file; remove the file",
                            path, label.batch + 1, label.batches);
    if (outcome == STATUS_OK)
        outcome = add(s, &label, path, folder, f);
    batch_label_free(&label);
    return outcome;
}

static status refuse_other(const shard_work *w, const char *path, fault *f)
{
    batch_label label;
    if (batch_read_label(path, &label, NULL) != STATUS_OK)
        return fault_set(f, STATUS_REFUSED,
                         "%.200s: its name ends in " BATCH_ENDING
                         ", but the file is not a batch of this program; remove it",
                         path);
    status outcome = batch_belongs(&label, w, path, f);
    if (outcome == STATUS_OK)
        outcome =
            fault_set(f, STATUS_REFUSED, "%.200s: the file has been renamed; remove it", path);
    batch_label_free(&label);
    return outcome;
}

static status look_at(batch_store *s, const shard_work *w, const char *name, int folder,
                      const char *wanted, FILE *messages, fault *f)
{
    char path[PATH_MAX];
    const int batch = batch_of_name(name, s->stem);
    TRY(path_of(s->folder[folder], name, path, f));
    if (batch < 0 || batch >= w->batches)
        return refuse_other(w, path, f);
    return wanted == NULL || wanted[batch] ? look_inside(s, w, path, batch, folder, messages, f)
                                           : STATUS_OK;
}

static status unreadable(const char *folder, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s: the folder cannot be read (%s); give an existing, readable folder "
                     "that contains batches",
                     folder, strerror(errno));
}

static status look_through(batch_store *s, const shard_work *w, int folder, const char *wanted,
                           FILE *messages, fault *f)
{
    status outcome = STATUS_OK;
    DIR *d = opendir(s->folder[folder]);
    if (d == NULL)
        return unreadable(s->folder[folder], f);
    for (struct dirent *e = readdir(d); e != NULL && outcome == STATUS_OK; e = readdir(d))
        if (batch_is_name(e->d_name))
            outcome = look_at(s, w, e->d_name, folder, wanted, messages, f);
    closedir(d);
    return outcome;
}

status batch_store_read(const shard_work *w, const char *const folder[], int folders,
                        const char *wanted, FILE *messages, batch_store *out, fault *f)
{
    *out = (batch_store){.batches = w->batches, .folder = folder, .folders = folders};
    batch_stem(w, out->stem);
    out->where = malloc(((size_t)w->batches + 1) * sizeof *out->where);
    if (out->where == NULL)
        return fault_memory(f, "batches");
    for (int i = 0; i < w->batches; i++)
        out->where[i] = -1;
    for (int i = 0; i < folders; i++)
        TRY(look_through(out, w, i, wanted, messages, f));
    return STATUS_OK;
}

void batch_store_free(batch_store *s)
{
    free(s->where);
    free(s->kind);
    *s = (batch_store){.batches = 0};
}

static void write_ranges(FILE *to, const batch_store *s)
{
    enum { MOST = 20 };
    int ranges = 0;
    for (int i = 0; i < s->batches; i++) {
        int last = i;
        if (s->where[i] >= 0)
            continue;
        if (++ranges > MOST) {
            fprintf(to, ", ...");
            return;
        }
        while (last + 1 < s->batches && s->where[last + 1] < 0)
            last++;
        fprintf(to, "%s%d", ranges > 1 ? ", " : "", i + 1);
        if (last > i)
            fprintf(to, "-%d", last + 1);
        i = last;
    }
}

static void write_shards(FILE *to, const batch_store *s, const shard_work *w)
{
    int *shard = malloc(((size_t)s->batches + 1) * sizeof *shard);
    const char *before = " (shards ";
    int written = 0;
    if (shard != NULL && s->shards > 1 &&
        batches_assign(s->batches, w->cost, s->shards, shard) == 0)
        for (int k = 0; k < s->shards; k++)
            for (int i = 0; i < s->batches; i++)
                if (shard[i] == k && s->where[i] < 0) {
                    fprintf(to, "%s%d/%d", before, k + 1, s->shards);
                    before = ", ";
                    written = 1;
                    break;
                }
    fputs(written ? ")" : "", to);
    free(shard);
}

void batch_store_missing(const batch_store *s, const shard_work *w, char *out, size_t size)
{
    const int missing = s->batches - s->there;
    out[0] = '\0';
    FILE *to = missing > 0 ? fmemopen(out, size, "w") : NULL;
    if (to == NULL)
        return;
    fprintf(to, "%d of %d batches %s missing: ", missing, s->batches, missing == 1 ? "is" : "are");
    write_ranges(to, s);
    write_shards(to, s, w);
    fclose(to);
    out[size - 1] = '\0';
}

void batch_store_print_kinds(const batch_store *s, FILE *to)
{
    if (s->kinds < 2)
        return;
    fprintf(to,
            "beamwork: the batches were computed on %d kinds of machines, so the last digits may "
            "differ\n",
            s->kinds);
    for (int i = 0; i < s->kinds; i++)
        fprintf(to, "beamwork:   %d on %s (%s; %s)\n", s->kind[i].batches, s->kind[i].node.host,
                s->kind[i].node.processor, s->kind[i].node.blas);
}

static int is_batch(const struct dirent *e)
{
    return batch_is_name(e->d_name);
}

status batch_store_first(const char *folder, batch_label *out, fault *f)
{
    struct dirent **entry;
    char path[PATH_MAX];
    int found = 0;
    memset(out, 0, sizeof *out);
    const int count = scandir(folder, &entry, is_batch, alphasort);
    if (count < 0)
        return unreadable(folder, f);
    for (int i = 0; i < count; i++) {
        found = found || (path_of(folder, entry[i]->d_name, path, NULL) == STATUS_OK &&
                          batch_read_label(path, out, NULL) == STATUS_OK);
        free(entry[i]);
    }
    free(entry);
    return found ? STATUS_OK
                 : fault_set(f, STATUS_REFUSED,
                             "%.200s contains no batch that can be read; give a folder that was "
                             "written with --into",
                             folder);
}

int batches_cut(int items, const double cost[], double most, int first[])
{
    int batches = 0;
    double all = 0;
    for (int i = 0; i < items; i++) {
        if (i == 0 || all + cost[i] > most) {
            first[batches++] = i;
            all = 0;
        }
        all += cost[i];
    }
    first[batches] = items;
    return batches;
}

typedef struct batch_costs {
    const double *cost;
} batch_costs;

static int most_expensive_first(const void *left, const void *right, void *context)
{
    const double *cost = ((const batch_costs *)context)->cost;
    const int a = *(const int *)left, b = *(const int *)right;
    if (cost[a] != cost[b])
        return cost[a] > cost[b] ? -1 : 1;
    return a < b ? -1 : 1;
}

void batches_order(int batches, const double cost[], int order[])
{
    batch_costs by = {cost};
    for (int i = 0; i < batches; i++)
        order[i] = i;
    qsort_r(order, (size_t)batches, sizeof *order, most_expensive_first, &by);
}

/* Cost of the batches that have been assigned to a shard. In a heap, the shard with the lowest cost
 * is at the top. If costs are equal, the shard with the lowest number is at the top. */
typedef struct existing_batch {
    double sum;
    int shard;
} existing_batch;

static int is_before(const existing_batch *a, const existing_batch *b)
{
    return a->sum < b->sum || (a->sum == b->sum && a->shard < b->shard);
}

static void sift(existing_batch heap[], int count)
{
    const existing_batch moved = heap[0];
    int at = 0;
    for (int below = 1; below < count; below = 2 * at + 1) {
        if (below + 1 < count && is_before(&heap[below + 1], &heap[below]))
            below++;
        if (!is_before(&heap[below], &moved))
            break;
        heap[at] = heap[below];
        at = below;
    }
    heap[at] = moved;
}

int batches_assign(int batches, const double cost[], int shards, int shard[])
{
    int *order = malloc(((size_t)batches + 1) * sizeof *order);
    existing_batch *heap = malloc(((size_t)shards + 1) * sizeof *heap);
    const int good = order != NULL && heap != NULL;
    if (good) {
        batches_order(batches, cost, order);
        for (int k = 0; k < shards; k++)
            heap[k] = (existing_batch){0, k};
        for (int i = 0; i < batches; i++) {
            shard[order[i]] = heap[0].shard;
            heap[0].sum += cost[order[i]];
            sift(heap, shards);
        }
    }
    free(order);
    free(heap);
    return good ? 0 : -1;
}

static status take(const shard_work *w, const batch_store *s, int batch, fault *f)
{
    char path[PATH_MAX];
    batch_label label;
    FILE *from = NULL;
    long end = 0;
    TRY(batch_store_path(s, batch, path, f));
    TRY(batch_open(path, &label, &from, &end, f));
    batch_label_free(&label);
    status outcome = w->take(w->context, batch, from, f);
    if (outcome == STATUS_OK && ftell(from) != end)
        outcome = fault_set(f, STATUS_FAULT,
                            "%.200s: the size of the file does not match its contents; remove it, "
                            "and start its shard again",
                            path);
    fclose(from);
    return outcome;
}

status merge_read(const shard_work *w, const batch_store *s, fault *f)
{
    for (int i = 0; i < s->batches; i++)
        if (s->where[i] >= 0)
            TRY(take(w, s, i, f));
    return STATUS_OK;
}

/* Calls a function of the BLAS library without arguments, and returns its string. Returns NULL if
 * the library does not have this function. */
static const char *answer_of(const char *name)
{
    char *(*function)(void);
    void *const found = dlsym(RTLD_DEFAULT, name);
    if (found == NULL)
        return NULL;
    memcpy(&function, &found, sizeof function);
    return function();
}

static void name_blas(char *out, size_t size)
{
    const char *config = answer_of("openblas_get_config"),
               *core = answer_of("openblas_get_corename");
    char path[PATH_MAX];
    Dl_info where;
    void *const product = dlsym(RTLD_DEFAULT, "dgemm_");
    if (config != NULL)
        snprintf(out, size, "%.150s%s%.80s", config, core != NULL ? ", kernels of " : "",
                 core != NULL ? core : "");
    else if (product != NULL && dladdr(product, &where) != 0 &&
             realpath(where.dli_fname, path) != NULL)
        snprintf(out, size, "%.200s", strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path);
    else
        snprintf(out, size, product == NULL ? "a static library" : "unknown");
}

machine node_here(void)
{
    machine out = {.host = "unknown"};
    const environment e = environment_now(1);
    gethostname(out.host, sizeof out.host - 1);
    snprintf(out.processor, sizeof out.processor, "%s", e.processor);
    name_blas(out.blas, sizeof out.blas);
    return out;
}

static int node_same_kind(const machine *a, const machine *b)
{
    return strcmp(a->processor, b->processor) == 0 && strcmp(a->blas, b->blas) == 0;
}
