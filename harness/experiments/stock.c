#include "harness/experiments/stock.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/deal.h"

static status path_of(const char *folder, const char *name, char out[PATH_MAX], fault *f)
{
    return snprintf(out, PATH_MAX, "%s/%s", folder, name) < PATH_MAX
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "%.200s: the name is too long", folder);
}

status stock_path(const stock *s, int batch, char out[PATH_MAX], fault *f)
{
    char name[BATCH_NAME];
    batch_name(s->stem, batch, name);
    return path_of(s->folder[s->where[batch]], name, out, f);
}

static status add_kind(stock *s, const machine *of, fault *f)
{
    for (int i = 0; i < s->kinds; i++)
        if (node_same_kind(&s->kind[i].node, of)) {
            s->kind[i].batches++;
            return STATUS_OK;
        }
    stock_kind *more = realloc(s->kind, ((size_t)s->kinds + 1) * sizeof *more);
    if (more == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for kinds of machines");
    s->kind = more;
    s->kind[s->kinds++] = (stock_kind){*of, 1};
    return STATUS_OK;
}

/* There are two files of one batch: the other one's label is read again. */
static status hold_against(stock *s, const batch_label *label, const char *path, fault *f)
{
    char other[PATH_MAX];
    batch_label first;
    TRY(stock_path(s, label->batch, other, f));
    TRY(batch_read_label(other, &first, f));
    const int same = strcmp(first.content, label->content) == 0;
    batch_label_free(&first);
    s->twice++;
    return same ? STATUS_OK
                : fault_set(f, STATUS_REFUSED,
                            "%.130s and %.130s are one batch with different answers; take one away",
                            other, path);
}

static status add(stock *s, const batch_label *label, const char *path, int folder, fault *f)
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

/* It is called as batches of this work are. */
static status look_inside(stock *s, const shard_work *w, const char *path, int batch, int folder,
                          FILE *tell, fault *f)
{
    batch_label label;
    fault why = {""};
    if (batch_open(path, &label, NULL, NULL, &why) != STATUS_OK) {
        s->damaged++;
        if (tell != NULL)
            fprintf(tell, "beamwork: %s; it counts as missing\n", why.text);
        return STATUS_OK;
    }
    status outcome = batch_belongs(&label, w, path, f);
    if (outcome == STATUS_OK && (label.batch != batch || label.batches != w->batches))
        outcome = fault_set(f, STATUS_REFUSED,
                            "%.200s: is batch %d of %d, not what it is called; take it away", path,
                            label.batch + 1, label.batches);
    if (outcome == STATUS_OK)
        outcome = add(s, &label, path, folder, f);
    batch_label_free(&label);
    return outcome;
}

/* Whose is it? Never that of this work. */
static status refuse_other(const shard_work *w, const char *path, fault *f)
{
    batch_label label;
    if (batch_read_label(path, &label, NULL) != STATUS_OK)
        return fault_set(
            f, STATUS_REFUSED,
            "%.200s: ends in " BATCH_ENDING " and is no batch of this program; take it away", path);
    status outcome = batch_belongs(&label, w, path, f);
    if (outcome == STATUS_OK)
        outcome = fault_set(f, STATUS_REFUSED, "%.200s: not called as it was written; take it away",
                            path);
    batch_label_free(&label);
    return outcome;
}

static status look_at(stock *s, const shard_work *w, const char *name, int folder,
                      const char *wanted, FILE *tell, fault *f)
{
    char path[PATH_MAX];
    const int batch = batch_of_name(name, s->stem);
    TRY(path_of(s->folder[folder], name, path, f));
    if (batch < 0 || batch >= w->batches)
        return refuse_other(w, path, f);
    return wanted == NULL || wanted[batch] ? look_inside(s, w, path, batch, folder, tell, f)
                                           : STATUS_OK;
}

static status unreadable(const char *folder, fault *f)
{
    return fault_set(f, STATUS_FAULT, "%.200s: cannot be read as a folder (%s)", folder,
                     strerror(errno));
}

static status look_through(stock *s, const shard_work *w, int folder, const char *wanted,
                           FILE *tell, fault *f)
{
    status outcome = STATUS_OK;
    DIR *d = opendir(s->folder[folder]);
    if (d == NULL)
        return unreadable(s->folder[folder], f);
    for (struct dirent *e = readdir(d); e != NULL && outcome == STATUS_OK; e = readdir(d))
        if (batch_is_name(e->d_name))
            outcome = look_at(s, w, e->d_name, folder, wanted, tell, f);
    closedir(d);
    return outcome;
}

status stock_take(const shard_work *w, const char *const folder[], int folders, const char *wanted,
                  FILE *tell, stock *out, fault *f)
{
    *out = (stock){.batches = w->batches, .folder = folder, .folders = folders};
    batch_stem(w, out->stem);
    out->where = malloc(((size_t)w->batches + 1) * sizeof *out->where);
    if (out->where == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory for batches");
    for (int i = 0; i < w->batches; i++)
        out->where[i] = -1;
    for (int i = 0; i < folders; i++)
        TRY(look_through(out, w, i, wanted, tell, f));
    return STATUS_OK;
}

void stock_free(stock *s)
{
    free(s->where);
    free(s->kind);
    *s = (stock){.batches = 0};
}

/* The ranges of what is missing; a long list ends in dots. */
static void write_ranges(FILE *to, const stock *s)
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

/* Whose they are, when all shards are of one number. */
static void write_shards(FILE *to, const stock *s, const shard_work *w)
{
    int *shard = malloc(((size_t)s->batches + 1) * sizeof *shard);
    const char *before = " (shards ";
    int told = 0;
    if (shard != NULL && s->shards > 1 && deal_out(s->batches, w->cost, s->shards, shard) == 0)
        for (int k = 0; k < s->shards; k++)
            for (int i = 0; i < s->batches; i++)
                if (shard[i] == k && s->where[i] < 0) {
                    fprintf(to, "%s%d/%d", before, k + 1, s->shards);
                    before = ", ";
                    told = 1;
                    break;
                }
    fputs(told ? ")" : "", to);
    free(shard);
}

void stock_missing(const stock *s, const shard_work *w, char *out, size_t size)
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

void stock_tell_kinds(const stock *s, FILE *to)
{
    if (s->kinds < 2)
        return;
    fprintf(to,
            "beamwork: the batches come from %d kinds of machines: the last digits may differ\n",
            s->kinds);
    for (int i = 0; i < s->kinds; i++)
        fprintf(to, "beamwork:   %d on %s (%s; %s)\n", s->kind[i].batches, s->kind[i].node.host,
                s->kind[i].node.processor, s->kind[i].node.blas);
}

static int is_batch(const struct dirent *e)
{
    return batch_is_name(e->d_name);
}

status stock_first(const char *folder, batch_label *out, fault *f)
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
                             "%.200s: no batches in it; run a verb with --shard K/N --into this "
                             "folder",
                             folder);
}
