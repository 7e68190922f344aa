#include "harness/cli/identity.h"

#include <dirent.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/cli/case_input.h"
#include "harness/cli/command_words.h"
#include "harness/formulations/environment.h"
#include "harness/formulations/words.h"

static void name_build(char *out, size_t size)
{
    char hash[DIGEST_TEXT];
    const environment e = environment_now(1);
    digest program = digest_begin();
    const int known = digest_add_file(&program, "/proc/self/exe") == 0;
    digest_text(&program, hash);
    snprintf(out, size, "%.12s of %.40s, commit %.40s", known ? hash : "unknown", e.version,
             e.commit);
}

/* All words with blanks between them; a longer text ends in its digest. */
static void name_request(const json_t *words, char out[IDENTITY_TEXT])
{
    enum { KEPT = IDENTITY_TEXT - 2 * DIGEST_TEXT };
    char hash[DIGEST_TEXT];
    size_t index, at = 0;
    const json_t *word;
    digest all = digest_begin();
    out[0] = '\0';
    json_array_foreach(words, index, word)
    {
        const char *text = json_string_value(word);
        digest_add_text(&all, text);
        if (at < KEPT)
            at +=
                (size_t)snprintf(out + at, IDENTITY_TEXT - at, "%s%s", index > 0 ? " " : "", text);
    }
    digest_text(&all, hash);
    if (at >= KEPT)
        snprintf(out + KEPT, IDENTITY_TEXT - KEPT, " ... %s", hash);
}

static status add_file(digest *plan, const char *path, fault *f)
{
    if (path == NULL)
        return STATUS_OK;
    return digest_add_file(plan, path) == 0
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "%.200s: cannot be read", path);
}

/* Objects; the files that a command names. */
static status add_element(digest *plan, const char *element, fault *f)
{
    static const char exec[] = "exec:";
    struct stat there;
    char **word;
    if (strncmp(element, exec, sizeof exec - 1) != 0)
        return add_file(plan, element, f);
    TRY(words_split(element + sizeof exec - 1, &word, f));
    for (int i = 0; word[i] != NULL; i++)
        if (stat(word[i], &there) == 0 && S_ISREG(there.st_mode))
            digest_add_file(plan, word[i]);
    free(word);
    return STATUS_OK;
}

/* Every *.yaml of a folder, in the order of their names. */
static status add_folder(digest *plan, const char *folder, fault *f)
{
    struct dirent **entry;
    char path[PATH_MAX];
    const int count = scandir(folder, &entry, NULL, alphasort);
    status outcome =
        count >= 0 ? STATUS_OK : fault_set(f, STATUS_FAULT, "%.200s: cannot be read", folder);
    for (int i = 0; i < count; i++) {
        const char *name = entry[i]->d_name, *dot = strrchr(name, '.');
        if (outcome == STATUS_OK && dot != NULL && strcmp(dot, ".yaml") == 0 &&
            snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path)
            outcome = add_file(plan, path, f);
        free(entry[i]);
    }
    if (count >= 0)
        free(entry);
    return outcome;
}

static status add_scenes(digest *plan, const command_request *r, fault *f)
{
    for (int i = 0; i < r->scene_count; i++) {
        struct stat there;
        const char *path = r->scene_path[i];
        const int folder = stat(path, &there) == 0 && S_ISDIR(there.st_mode);
        TRY(folder ? add_folder(plan, path, f) : add_file(plan, path, f));
    }
    return STATUS_OK;
}

static status add_files(digest *plan, const command_request *r, fault *f)
{
    if (r->scene_count == 0 || r->built_in)
        TRY(add_file(plan, case_input_truths_path(r), f));
    for (int i = 0; i < r->own_truths_count; i++)
        TRY(add_file(plan, r->own_truths[i], f));
    for (int i = 0; i < r->elements; i++)
        TRY(add_element(plan, r->element[i], f));
    return add_scenes(plan, r, f);
}

static char *write_origin(const char *verb, const command_request *r)
{
    json_t *out =
        json_pack("{s:s,s:o?,s:o?}", "verb", verb, "arguments", command_words(r, PATHS_ABSOLUTE),
                  "as_given", command_words(r, PATHS_GIVEN));
    char *text = out != NULL ? json_dumps(out, JSON_COMPACT) : NULL;
    json_decref(out);
    return text;
}

status identity_make(const char *verb, const command_request *r, identity_texts *out, digest *plan,
                     fault *f)
{
    json_t *words = command_words(r, PATHS_LEAVES);
    *plan = digest_begin();
    name_build(out->build, sizeof out->build);
    name_request(words, out->request);
    json_decref(words);
    out->origin = write_origin(verb, r);
    if (out->origin == NULL)
        return fault_set(f, STATUS_FAULT, "out of memory, or the command line is no UTF-8");
    return add_files(plan, r, f);
}

static void add_count(digest *plan, int count)
{
    digest_add_number(plan, count);
}

void identity_add_sweep(digest *plan, const sweep *s)
{
    add_count(plan, s->points);
    for (int i = 0; i < s->points; i++) {
        const point *p = &s->point[i];
        digest_add_text(plan, p->type->name);
        digest_add_text(plan, p->text);
        for (int k = 0; k < parameters_count(p->type); k++)
            digest_add_number(plan, p->parameter[k]);
        add_count(plan, p->steps);
        add_count(plan, p->scene.quantities);
        for (int k = 0; k < p->scene.quantities; k++)
            digest_add_text(plan, p->scene.quantity[k].name);
    }
    add_count(plan, s->seriess);
    for (int i = 0; i < s->seriess; i++) {
        const series *one = &s->series[i];
        add_count(plan, one->point);
        digest_add_text(plan, one->formulation.key);
        digest_add_text(plan, one->missing);
        for (int k = 0; k < one->meshes; k++)
            add_count(plan, one->mesh[k]);
    }
}

void identity_set(identity_texts *texts, const digest *plan, work *w)
{
    digest_text(plan, texts->plan);
    w->build = texts->build;
    w->request = texts->request;
    w->plan = texts->plan;
    w->origin = texts->origin;
}

void identity_free(identity_texts *texts)
{
    free(texts->origin);
    texts->origin = NULL;
}
