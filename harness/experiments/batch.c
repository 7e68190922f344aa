#include "harness/experiments/experiments_impl.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "harness/numerics/numerics.h"

void batch_stem(const shard_work *w, char out[BATCH_STEM])
{
    char hash[DIGEST_TEXT];
    digest d = digest_begin();
    digest_add_text(&d, w->build);
    digest_add_text(&d, w->request);
    digest_add_text(&d, w->plan);
    digest_text(&d, hash);
    snprintf(out, BATCH_STEM, "%.30s-%.12s", w->verb, hash);
}

void batch_name(const char *stem, int batch, char out[BATCH_NAME])
{
    snprintf(out, BATCH_NAME, "%.*s-%06d%s", BATCH_STEM, stem, batch + 1, BATCH_ENDING);
}

int batch_of_name(const char *name, const char *stem)
{
    char same[BATCH_NAME];
    const size_t length = strlen(stem);
    if (strncmp(name, stem, length) != 0 || name[length] != '-')
        return -1;
    const long number = strtol(name + length + 1, NULL, 10);
    if (number < 1 || number > INT_MAX)
        return -1;
    batch_name(stem, (int)number - 1, same);
    return strcmp(name, same) == 0 ? (int)number - 1 : -1;
}

int batch_is_name(const char *name)
{
    const size_t length = strlen(name), ending = strlen(BATCH_ENDING);
    return length > ending && strcmp(name + length - ending, BATCH_ENDING) == 0;
}

static int write_label(FILE *to, const batch_label *b, size_t size)
{
    json_t *out = json_pack(
        "{s:i,s:s,s:s,s:s,s:s,s:i,s:i,s:i,s:i,s:s,s:f,s:f,s:s,s:s,s:s,s:O?,s:I}", "beamwork_batch",
        1, "verb", b->verb, "build", b->build, "request", b->request, "plan", b->plan, "batch",
        b->batch + 1, "batches", b->batches, "shard", b->shard + 1, "shards", b->shards, "content",
        b->content, "seconds", b->seconds, "processor_seconds", b->processor_seconds, "host",
        b->node.host, "processor", b->node.processor, "blas", b->node.blas, "origin", b->origin,
        "size", (json_int_t)size);
    const int bad = out == NULL || json_dumpf(out, to, JSON_COMPACT) != 0 || fputc('\n', to) == EOF;
    json_decref(out);
    return bad ? -1 : 0;
}

/* Assembles the contents of the file: the label, the bytes and the last line. The caller frees
 * *out. Returns 0, or -1 if out of memory. */
static int assemble(const batch_label *b, const void *bytes, size_t size, char **out,
                    size_t *length)
{
    char end[CHECKSUM_LENGTH + 1];
    *out = NULL;
    FILE *to = open_memstream(out, length);
    if (to == NULL)
        return -1;
    int bad = write_label(to, b, size) != 0 || (size > 0 && fwrite(bytes, size, 1, to) != 1) ||
              fflush(to) != 0;
    if (!bad) {
        checksum_write(*out, *length, end);
        bad = fputs(end, to) == EOF;
    }
    return fclose(to) != 0 || bad ? -1 : 0;
}

static void keep_names(const char *folder)
{
    const int there = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (there >= 0) {
        fsync(there);
        close(there);
    }
}

static status write_locked(const char *path, const char *bytes, size_t length, fault *f)
{
    output file;
    TRY(output_open_whole(path, &file, f));
    const int held = dup(fileno(file.stream));
    if (held >= 0)
        flock(held, LOCK_EX | LOCK_NB);
    fwrite(bytes, length, 1, file.stream);
    const status outcome = output_close(&file, f);
    if (held >= 0)
        close(held);
    return outcome;
}

status batch_write(const char *folder, const batch_label *label, const void *bytes, size_t size,
                   fault *f)
{
    char path[PATH_MAX], stem[BATCH_STEM], name[BATCH_NAME], *whole;
    size_t length;
    const shard_work w = {label->verb, label->build, label->request, label->plan, .batches = 0};
    batch_stem(&w, stem);
    batch_name(stem, label->batch, name);
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path)
        return fault_set(f, STATUS_FAULT,
                         "%.200s: the name of the folder is too long; give a shorter one, such as "
                         "--into batches",
                         folder);
    const status outcome = assemble(label, bytes, size, &whole, &length) == 0
                               ? write_locked(path, whole, length, f)
                               : fault_memory(f, "a batch");
    free(whole);
    if (outcome == STATUS_OK)
        keep_names(folder);
    return outcome;
}

/* Returns 1 if the writer of a temporary file has ended; the file is then not locked. */
static int is_orphan(const char *path, int certainly_ended)
{
    enum { OLD = 60 }; /* [s] */
    struct stat there;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0)
        return 0;
    const int settled = fstat(file, &there) == 0 &&
                        (certainly_ended || there.st_size > 0 || time(NULL) - there.st_mtime > OLD);
    const int ended = settled && flock(file, LOCK_EX | LOCK_NB) == 0;
    close(file);
    return ended;
}

void batch_clean(const char *folder, const char *name, int ended)
{
    char path[PATH_MAX];
    const size_t length = strlen(name);
    DIR *d = opendir(folder);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d))
        if (strncmp(e->d_name, name, length) == 0 &&
            strncmp(e->d_name + length, ".part-", 6) == 0 &&
            snprintf(path, sizeof path, "%s/%s", folder, e->d_name) < (int)sizeof path &&
            is_orphan(path, ended))
            unlink(path);
    if (d != NULL)
        closedir(d);
}

static status no_batch(const char *path, fault *f)
{
    return fault_set(f, STATUS_FAULT,
                     "%.200s is not a batch of this program, or it is damaged; delete it, and "
                     "start its shard again",
                     path);
}

static int get_text(const json_t *from, const char *key, char *out, size_t size)
{
    const char *text = json_string_value(json_object_get(from, key));
    if (text == NULL || strlen(text) >= size)
        return -1;
    memcpy(out, text, strlen(text) + 1);
    return 0;
}

static int get_index(const json_t *from, const char *key)
{
    const json_int_t value = json_integer_value(json_object_get(from, key));
    return value >= 1 && value <= INT_MAX ? (int)value - 1 : -1;
}

static int get_label(const json_t *from, batch_label *b)
{
    if (get_index(from, "beamwork_batch") != 0 ||
        get_text(from, "verb", b->verb, sizeof b->verb) != 0 ||
        get_text(from, "build", b->build, sizeof b->build) != 0 ||
        get_text(from, "request", b->request, sizeof b->request) != 0 ||
        get_text(from, "plan", b->plan, sizeof b->plan) != 0 ||
        get_text(from, "content", b->content, sizeof b->content) != 0 ||
        get_text(from, "host", b->node.host, sizeof b->node.host) != 0 ||
        get_text(from, "processor", b->node.processor, sizeof b->node.processor) != 0 ||
        get_text(from, "blas", b->node.blas, sizeof b->node.blas) != 0)
        return -1;
    b->batch = get_index(from, "batch");
    b->batches = get_index(from, "batches") + 1;
    b->shard = get_index(from, "shard");
    b->shards = get_index(from, "shards") + 1;
    b->seconds = json_number_value(json_object_get(from, "seconds"));
    b->processor_seconds = json_number_value(json_object_get(from, "processor_seconds"));
    b->origin = json_incref(json_object_get(from, "origin"));
    return b->batch >= 0 && b->batch < b->batches && b->shard >= 0 ? 0 : -1;
}

/* Reads the line with the label, and moves the stream to the first byte of the results. *size: size
 * of the results [bytes]. */
static status read_line(FILE *from, const char *path, batch_label *out, long *size, fault *f)
{
    char *line = NULL;
    size_t room = 0;
    memset(out, 0, sizeof *out);
    const ssize_t length = getline(&line, &room, from);
    json_t *label = length > 0 ? json_loadb(line, (size_t)length, 0, NULL) : NULL;
    free(line);
    const int bad = !json_is_object(label) || get_label(label, out) != 0;
    if (bad)
        batch_label_free(out);
    *size = bad ? -1 : (long)json_integer_value(json_object_get(label, "size"));
    json_decref(label);
    return bad ? no_batch(path, f) : STATUS_OK;
}

static status unreadable(const char *path, fault *f)
{
    return fault_unreadable(f, path, errno);
}

status batch_read_label(const char *path, batch_label *out, fault *f)
{
    long size;
    FILE *from = fopen(path, "rbe");
    memset(out, 0, sizeof *out);
    if (from == NULL)
        return unreadable(path, f);
    const status outcome = read_line(from, path, out, &size, f);
    fclose(from);
    return outcome;
}

static status check_size(FILE *from, const char *path, long size, fault *f)
{
    const long begin = ftell(from);
    if (begin >= 0 && fseek(from, 0, SEEK_END) == 0 &&
        ftell(from) == begin + size + CHECKSUM_LENGTH && fseek(from, begin, SEEK_SET) == 0)
        return STATUS_OK;
    return no_batch(path, f);
}

status batch_open(const char *path, batch_label *out, FILE **from, long *end, fault *f)
{
    long size;
    memset(out, 0, sizeof *out);
    if (checksum_check(path, NULL) != STATUS_OK)
        return fault_set(
            f, STATUS_FAULT,
            "%.200s is truncated, damaged or altered; delete it, and start its shard again", path);
    FILE *file = fopen(path, "rbe");
    if (file == NULL)
        return unreadable(path, f);
    status outcome = read_line(file, path, out, &size, f);
    if (outcome == STATUS_OK)
        outcome = check_size(file, path, size, f);
    if (outcome == STATUS_OK && from != NULL) {
        *from = file;
        *end = ftell(file) + size;
        return STATUS_OK;
    }
    fclose(file);
    if (outcome != STATUS_OK)
        batch_label_free(out);
    return outcome;
}

void batch_label_free(batch_label *b)
{
    json_decref(b->origin);
    b->origin = NULL;
}

status batch_belongs(const batch_label *b, const shard_work *w, const char *path, fault *f)
{
    if (strcmp(b->verb, w->verb) != 0 || strcmp(b->request, w->request) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.120s: the batch belongs to another request (%.20s %.100s); give --into "
                         "a separate folder for each request",
                         path, b->verb, b->request);
    if (strcmp(b->build, w->build) != 0)
        return fault_set(
            f, STATUS_REFUSED,
            "%.120s: the batch was computed by another build of beamwork (%.60s; this build is "
            "%.60s); use that build, or compute all batches again with --into a new folder",
            path, b->build, w->build);
    if (strcmp(b->plan, w->plan) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.120s: the batch was computed with other reference values, scene files "
                         "or formulations of the same names; use those, or compute all batches "
                         "again with --into a new folder",
                         path);
    return STATUS_OK;
}

static double processor_seconds(void)
{
    static const int whose[] = {RUSAGE_SELF, RUSAGE_CHILDREN};
    double all = 0;
    for (int i = 0; i < 2; i++) {
        struct rusage used;
        getrusage(whose[i], &used);
        all += (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
               1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    }
    return all;
}

static status compute(const batch_worker *c, int batch, double *seconds, fault *f)
{
    const shard_work *w = c->w;
    char *bytes = NULL;
    size_t size = 0;
    digest content = digest_begin();
    batch_label label = {.batch = batch,
                         .batches = w->batches,
                         .shard = c->request->index,
                         .shards = c->request->count,
                         .node = c->here};
    const double begun = clock_wall_seconds(), worked = processor_seconds();
    FILE *to = open_memstream(&bytes, &size);
    if (to == NULL)
        return fault_memory(f, "a batch");
    status outcome = w->run(w->context, batch, to, &content, f);
    if (fclose(to) != 0 && outcome == STATUS_OK)
        outcome = fault_memory(f, "a batch");
    *seconds = clock_wall_seconds() - begun;
    if (outcome == STATUS_OK) {
        snprintf(label.verb, sizeof label.verb, "%s", w->verb);
        snprintf(label.build, sizeof label.build, "%s", w->build);
        snprintf(label.request, sizeof label.request, "%s", w->request);
        snprintf(label.plan, sizeof label.plan, "%s", w->plan);
        label.seconds = *seconds;
        label.processor_seconds = processor_seconds() - worked;
        label.origin = w->origin != NULL ? json_loads(w->origin, 0, NULL) : NULL;
        digest_text(&content, label.content);
        outcome = batch_write(c->request->into, &label, bytes, size, f);
        batch_label_free(&label);
    }
    free(bytes);
    return outcome;
}

void batch_worker_run(const batch_worker *c, int self, int to)
{
    batch_queue *s = c->queue;
    for (;;) {
        const int i = atomic_fetch_add(&s->next, 1);
        if (i >= c->count)
            break;
        batch_report report;
        fault f = {""};
        memset(&report, 0, sizeof report);
        report.batch = c->list[i];
        s->at[self] = report.batch;
        report.status = compute(c, report.batch, &report.seconds, &f);
        memcpy(report.text, f.text, sizeof report.text);
        if (write(to, &report, sizeof report) != (ssize_t)sizeof report)
            break;
        s->at[self] = -1;
        if (report.status != STATUS_OK)
            break;
    }
    _exit(0);
}
