#include "harness/experiments/experiments_impl.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* Replaces the ending of a path: "sweep.h5" becomes "sweep.worst", for example. REFUSED: the name
 * is too long. */
static status beside(const char *path, const char *ending, char out[PATH_MAX], fault *f)
{
    const char *leaf = strrchr(path, '/'), *dot = strrchr(path, '.');
    const int stem = dot != NULL && dot > (leaf != NULL ? leaf + 1 : path) ? (int)(dot - path)
                                                                           : (int)strlen(path);
    return snprintf(out, PATH_MAX, "%.*s%s", stem, path, ending) < PATH_MAX
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "%.200s: the name is too long; give -o a shorter one, such as sweep.h5",
                           path);
}

/* Returns 1 if the name is "." or "..", or that of a file written by worst_write. */
static int is_ours(const char *name)
{
    int end = 0;
    long index;
    return strcmp(name, ".") == 0 || strcmp(name, "..") == 0 ||
           (sscanf(name, "point_%ld.yaml%n", &index, &end) == 1 && end > 0 && name[end] == '\0');
}

/* Returns 1 if the folder does not exist or contains only files of an earlier sweep. */
static int is_former(const char *folder)
{
    DIR *at = opendir(folder);
    int ours = 1;
    for (const struct dirent *e; at != NULL && (e = readdir(at)) != NULL;)
        ours = ours && is_ours(e->d_name);
    if (at != NULL)
        closedir(at);
    return ours;
}

static void remove_former(const char *folder)
{
    DIR *at = opendir(folder);
    char path[PATH_MAX];
    for (const struct dirent *e; at != NULL && (e = readdir(at)) != NULL;)
        if (is_ours(e->d_name) && e->d_name[0] != '.' &&
            snprintf(path, sizeof path, "%s/%s", folder, e->d_name) < (int)sizeof path)
            unlink(path);
    if (at != NULL)
        closedir(at);
}

static status check_folder(const char *folder, fault *f)
{
    file_place where;
    if (folder[0] == '\0' || (access(folder, F_OK) == 0 && is_former(folder)))
        return STATUS_OK;
    return output_folder_try(folder, &where, f);
}

static status write_scenes(const char *folder, tally *t, fault *f)
{
    int worsts = 0;
    for (int i = 0; i < t->of->formulations; i++)
        worsts += t->worsts[i];
    if (folder[0] == '\0')
        return STATUS_OK;
    if (is_former(folder))
        remove_former(folder);
    if (worsts > 0)
        return worst_write(folder, t, f);
    rmdir(folder);
    return STATUS_OK;
}

static status place_output(const range_sweep_request *r, range_sweep *s, fault *f)
{
    if (r->output == NULL)
        return STATUS_OK;
    s->output = r->output;
    if (r->partial) {
        TRY(output_partial(r->output, s->partial, f));
        s->output = s->partial;
    }
    TRY(beside(s->output, ".worst", s->worst, f));
    return check_folder(s->worst, f);
}

static status hold_batches(const char *folder, fault *f)
{
    struct stat there = {.st_nlink = 0};
    while (there.st_nlink == 0) {
        const int made = mkdir(folder, 0777),
                  held = made == 0 || errno == EEXIST
                             ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                             : -1;
        if (held < 0)
            return fault_set(f, STATUS_FAULT,
                             "%.200s: the folder cannot be created (%s); give -o a path in an "
                             "existing, writable folder",
                             folder, strerror(errno));
        if (flock(held, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            close(held);
            return fault_set(f, STATUS_REFUSED,
                             "%.200s: another 'beamwork sweep' is using this folder; wait until it "
                             "ends, or give -o another name",
                             folder);
        }
        if (fstat(held, &there) != 0)
            there.st_nlink = 1;
    }
    return STATUS_OK;
}

static status place_batches(const char *path, char folder[PATH_MAX], fault *f)
{
    if (path != NULL) {
        TRY(beside(path, ".batches", folder, f));
        return hold_batches(folder, f);
    }
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, PATH_MAX, "%s/beamwork-sweep-XXXXXX", temporary != NULL ? temporary : "/tmp");
    return mkdtemp(folder) != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT,
                           "%.200s: the folder cannot be created (%s); set the environment "
                           "variable TMPDIR to a writable folder, such as /var/tmp",
                           folder, strerror(errno));
}

static status plan(const void *requested, void *found, fault *f)
{
    range_sweep *s = found;
    s->requested = requested;
    TRY(ranges_make(&s->requested->of, &s->ranges, f));
    TRY(ranges_work_make(&s->ranges, &s->work, f));
    s->work.csv = s->requested->csv;
    s->all = ranges_work_of(&s->work);
    return place_output(s->requested, s, f);
}

static status run(const void *requested, void *found, fault *f)
{
    const range_sweep_request *r = requested;
    range_sweep *s = found;
    shard_outcome done = {0};
    if (r->take != NULL)
        return STATUS_OK;
    TRY(place_batches(r->output, s->batches, f));
    const shard_request request = {.count = 1,
                                   .into = s->batches,
                                   .jobs = r->jobs,
                                   .progress = r->progress,
                                   .messages = stderr};
    return shard_run(&s->all, &request, &done, f);
}

static status begin(range_sweep *s, fault *f)
{
    TRY(tally_alloc(&s->ranges, &s->tally, f));
    s->work.tally = &s->tally;
    s->work.content = digest_begin();
    if (s->requested->output == NULL)
        return STATUS_OK;
    TRY(ranges_file_open(s->output, &s->ranges, s->all.plan, &s->file, f));
    s->work.file = &s->file;
    return STATUS_OK;
}

static status end(range_sweep *s, status taken, fault *f)
{
    char content[DIGEST_TEXT];
    digest_text(&s->work.content, content);
    if (taken == STATUS_OK)
        taken = write_scenes(s->worst, &s->tally, f);
    if (s->work.file != NULL)
        taken = ranges_file_close(s->work.file, &s->tally, content, taken, f);
    s->work.file = NULL;
    s->work.tally = NULL;
    s->evaluated = taken == STATUS_OK;
    return taken;
}

static status take_all(range_sweep *s, const batch_store *there, fault *f)
{
    const range_sweep_request *r = s->requested;
    status outcome = begin(s, f);
    if (outcome == STATUS_OK)
        outcome = there != NULL ? merge_read(&s->all, there, f) : r->take(r->context, &s->all, f);
    return end(s, outcome, f);
}

static status remove_batches(const batch_store *there, const char *folder, fault *f)
{
    char path[PATH_MAX];
    for (int i = 0; i < there->batches; i++) {
        if (there->where[i] < 0)
            continue;
        TRY(batch_store_path(there, i, path, f));
        unlink(path);
    }
    rmdir(folder);
    return STATUS_OK;
}

/* Reads the computed batches and removes them. If batches are missing, none is read, and the folder
 * of the batches remains if there is an output. */
static status collect(range_sweep *s, fault *f)
{
    const char *const folder[] = {s->batches};
    batch_store there = {.batches = 0};
    status outcome = batch_store_read(&s->all, folder, 1, NULL, stderr, &there, f);
    s->lost = there.batches - there.there;
    if (outcome == STATUS_OK && s->lost == 0)
        outcome = take_all(s, &there, f);
    if (outcome == STATUS_OK && (s->lost == 0 || s->requested->output == NULL))
        outcome = remove_batches(&there, s->batches, f);
    batch_store_free(&there);
    return outcome;
}

static status evaluate(const void *requested, void *found, fault *f)
{
    const range_sweep_request *r = requested;
    range_sweep *s = found;
    if (r->take == NULL)
        return collect(s, f);
    const status outcome = take_all(s, NULL, f);
    return outcome == STATUS_NO_VALUE ? STATUS_OK : outcome;
}

static status write_form(FILE *to, const char *format, const void *found, fault *f)
{
    const range_sweep *s = found;
    if (s->evaluated && !s->requested->quiet && strcmp(format, "text") == 0)
        ranges_table(to, &s->tally, s->requested->verbose, s->worst, f);
    return STATUS_OK;
}

void range_sweep_free(range_sweep *s)
{
    tally_free(&s->tally);
    ranges_work_free(&s->work);
    ranges_free(&s->ranges);
    truths_free(&s->truths);
}

const experiment_type experiment_sweep = {
    .name = KEPT_SWEEP, .plan = plan, .run = run, .evaluate = evaluate, .write = write_form};
