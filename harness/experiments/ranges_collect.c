#include "harness/experiments/ranges_collect.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/experiments/worst.h"
#include "harness/records/records.h"

status ranges_collect_beside(const char *path, const char *ending, char out[PATH_MAX], fault *f)
{
    const char *leaf = strrchr(path, '/'), *dot = strrchr(path, '.');
    const int stem = dot != NULL && dot > (leaf != NULL ? leaf + 1 : path) ? (int)(dot - path)
                                                                           : (int)strlen(path);
    return snprintf(out, PATH_MAX, "%.*s%s", stem, path, ending) < PATH_MAX
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED, "%.200s: the name is too long", path);
}

/* What worst_write writes. */
static int is_ours(const char *name)
{
    int end = 0;
    long index;
    return strcmp(name, ".") == 0 || strcmp(name, "..") == 0 ||
           (sscanf(name, "point_%ld.yaml%n", &index, &end) == 1 && end > 0 && name[end] == '\0');
}

/* Files of an earlier sweep, all of the folder; 0: there are others. */
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

status ranges_collect_check(const ranges_output *o, fault *f)
{
    file_place where;
    if (o->folder[0] == '\0' || (access(o->folder, F_OK) == 0 && is_former(o->folder)))
        return STATUS_OK;
    return output_folder_try(o->folder, &where, f);
}

static status write_scenes(const ranges_output *o, tally *t, fault *f)
{
    int worsts = 0;
    for (int i = 0; i < t->of->formulations; i++)
        worsts += t->worsts[i];
    if (o->folder[0] == '\0')
        return STATUS_OK;
    if (is_former(o->folder))
        remove_former(o->folder);
    if (worsts > 0)
        return worst_write(o->folder, t, f);
    rmdir(o->folder);
    return STATUS_OK;
}

status ranges_collect_begin(ranges_work *w, const ranges_output *o, ranges_collect *out, fault *f)
{
    memset(out, 0, sizeof *out);
    out->work = w;
    out->output = o;
    TRY(tally_alloc(w->of, &out->tally, f));
    w->tally = &out->tally;
    w->content = digest_begin();
    if (o->path == NULL)
        return STATUS_OK;
    TRY(ranges_file_open(o->path, w->of, o->plan, &out->file, f));
    w->file = &out->file;
    return STATUS_OK;
}

status ranges_collect_end(ranges_collect *c, status taken, fault *f)
{
    char content[DIGEST_TEXT];
    digest_text(&c->work->content, content);
    if (taken == STATUS_OK)
        taken = write_scenes(c->output, &c->tally, f);
    if (c->work->file != NULL)
        taken = ranges_file_close(c->work->file, &c->tally, content, taken, f);
    c->work->file = NULL;
    c->work->tally = NULL;
    return taken;
}

status ranges_collect_remove(const stock *s, const char *folder, fault *f)
{
    char path[PATH_MAX];
    for (int i = 0; i < s->batches; i++) {
        if (s->where[i] < 0)
            continue;
        TRY(stock_path(s, i, path, f));
        unlink(path);
    }
    rmdir(folder);
    return STATUS_OK;
}
