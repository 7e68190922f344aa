/* What a file of a batch says of itself. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/batch.h"
#include "harness/study/study.h"

static status no_batch(const char *path, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.200s: no batch of this program, or damaged", path);
}

/* 0, or -1: it is not there or too long. */
static int get_text(const json_t *from, const char *key, char *out, size_t size)
{
    const char *text = json_string_value(json_object_get(from, key));
    if (text == NULL || strlen(text) >= size)
        return -1;
    memcpy(out, text, strlen(text) + 1);
    return 0;
}

/* A whole number from 0; -1: it is none. */
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

/* The stream stands behind the line. *size: of the bytes that follow. */
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
    return fault_set(f, STATUS_FAULT, "%.200s: cannot be read (%s)", path, strerror(errno));
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

/* The bytes are all that stands between the two lines. */
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
        return fault_set(f, STATUS_FAULT, "%.200s: cut short, damaged or altered", path);
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
                         "%.120s: a batch of another request (%.20s %.100s); keep the batches of a "
                         "request in a folder of their own",
                         path, b->verb, b->request);
    if (strcmp(b->build, w->build) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.120s: a batch of another build (%.60s; this is %.60s); use the program "
                         "that computed it, or a new folder",
                         path, b->build, w->build);
    if (strcmp(b->plan, w->plan) != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%.120s: a batch of the same request with other truths, scenes or "
                         "formulations behind it; use those, or a new folder",
                         path);
    return STATUS_OK;
}
