#include "harness/ranges/ranges_collect.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "harness/ranges/worst.h"
#include "harness/record/output_folder.h"
#include "harness/shards/merge.h"

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
    place where;
    if (o->folder[0] == '\0' || (access(o->folder, F_OK) == 0 && is_former(o->folder)))
        return STATUS_OK;
    return output_folder_try(o->folder, &where, f);
}

static status write_scenes(const ranges_output *o, tally *t, fault *f)
{
    if (o->folder[0] == '\0')
        return STATUS_OK;
    if (is_former(o->folder))
        remove_former(o->folder);
    return worst_write(o->folder, t, f);
}

static status take_all(ranges_work *w, const stock *s, const ranges_output *o, fault *f)
{
    const work all = ranges_work_of(w);
    TRY(merge_take(&all, s, f));
    return write_scenes(o, w->tally, f);
}

static status into_file(ranges_work *w, const stock *s, const ranges_output *o, fault *f)
{
    ranges_file file;
    char content[DIGEST_TEXT];
    TRY(ranges_file_open(o->path, w->of, w->identity.plan, &file, f));
    w->file = &file;
    const status taken = take_all(w, s, o, f);
    w->file = NULL;
    digest_text(&w->content, content);
    return ranges_file_close(&file, w->tally, content, taken, f);
}

status ranges_collect(ranges_work *w, const stock *s, const ranges_output *o, tally *out, fault *f)
{
    TRY(tally_alloc(w->of, out, f));
    w->tally = out;
    w->content = digest_begin();
    return o->path != NULL ? into_file(w, s, o, f) : take_all(w, s, o, f);
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
