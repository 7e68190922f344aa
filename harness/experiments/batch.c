#include "harness/experiments/batch.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "harness/records/records.h"
#include "harness/study/study.h"

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

/* Label, bytes and the last line as they stand in the file; the caller frees them. 0, or -1: out of
 * memory. */
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

/* Names that were written last longer than a power cut; a folder that cannot be synchronised needs
 * no such thing. */
static void keep_names(const char *folder)
{
    const int there = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (there >= 0) {
        fsync(there);
        close(there);
    }
}

/* The lock says that its writer lives; it ends with the process, whatever ends that. */
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
        return fault_set(f, STATUS_FAULT, "%.200s: the name is too long", folder);
    const status outcome = assemble(label, bytes, size, &whole, &length) == 0
                               ? write_locked(path, whole, length, f)
                               : fault_set(f, STATUS_FAULT, "out of memory for a batch");
    free(whole);
    if (outcome == STATUS_OK)
        keep_names(folder);
    return outcome;
}

/* Its writer is gone: nobody holds it. One that is empty may not be held yet, unless its writer is
 * known to be gone or it is old. */
static int is_orphan(const char *path, int gone_for_sure)
{
    enum { OLD = 60 }; /* [s] */
    struct stat there;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0)
        return 0;
    const int settled = fstat(file, &there) == 0 &&
                        (gone_for_sure || there.st_size > 0 || time(NULL) - there.st_mtime > OLD);
    const int gone = settled && flock(file, LOCK_EX | LOCK_NB) == 0;
    close(file);
    return gone;
}

void batch_clean(const char *folder, const char *name, int gone)
{
    char path[PATH_MAX];
    const size_t length = strlen(name);
    DIR *d = opendir(folder);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d))
        if (strncmp(e->d_name, name, length) == 0 &&
            strncmp(e->d_name + length, ".part-", 6) == 0 &&
            snprintf(path, sizeof path, "%s/%s", folder, e->d_name) < (int)sizeof path &&
            is_orphan(path, gone))
            unlink(path);
    if (d != NULL)
        closedir(d);
}
