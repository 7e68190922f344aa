#include "harness/cli/cli_impl.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { BUILD_DIGITS = 12 };

/* Writes the first digits of the build id, which the linker computes from the contents of the
 * program, and which is at the beginning of the file. Returns 0 if there is none. */
static int read_build_id(char out[BUILD_DIGITS + 1])
{
    enum { HEAD = 4096 };
    static const char note[] = "\4\0\0\0\x14\0\0\0\3\0\0\0GNU"; /* lengths, type, owner */
    char head[HEAD];
    FILE *from = fopen("/proc/self/exe", "rb");
    if (from == NULL)
        return 0;
    const size_t got = fread(head, 1, HEAD - BUILD_DIGITS, from);
    fclose(from);
    const char *at = memmem(head, got, note, sizeof note);
    for (size_t i = 0; at != NULL && i < BUILD_DIGITS / 2; i++)
        snprintf(out + 2 * i, 3, "%02x", (unsigned char)at[sizeof note + i]);
    return at != NULL;
}

static void name_build(char *out, size_t size)
{
    char hash[DIGEST_TEXT] = "unknown";
    const environment e = environment_now(1);
    if (!read_build_id(hash)) {
        digest program = digest_begin();
        if (digest_add_file(&program, "/proc/self/exe") == 0)
            digest_text(&program, hash);
    }
    snprintf(out, size, "%.*s of %.40s, commit %.40s", BUILD_DIGITS, hash, e.version, e.commit);
}

/* Joins all words with blanks. A text that is too long is cut and ends with its digest. */
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

typedef enum path_form { PATHS_GIVEN, PATHS_ABSOLUTE, PATHS_LEAVES } path_form;

static void add_path(json_t *to, const char *path, path_form form)
{
    char whole[PATH_MAX];
    const char *slash = strrchr(path, '/');
    if (form == PATHS_ABSOLUTE && realpath(path, whole) != NULL)
        path = whole;
    else if (form == PATHS_LEAVES && slash != NULL && slash[1] != '\0')
        path = slash + 1;
    json_array_append_new(to, json_string(path));
}

/* Adds an option and its value. The path of an input file is written in the given form; the command
 * of "exec:COMMAND" does not change. */
static void add_given(json_t *to, const given_option *g, path_form form)
{
    char text[160];
    const char *value = g->value;
    const int optional = verb_optional(g->option) && value != NULL,
              file = (g->option->traits & OPTION_INPUT) != 0 && strncmp(value, "exec:", 5) != 0;
    snprintf(text, sizeof text, "--%s%s%s", g->option->name, optional ? "=" : "",
             optional ? value : "");
    json_array_append_new(to, json_string(text));
    if (value != NULL && !optional)
        add_path(to, value, file ? form : PATHS_GIVEN);
}

/* Lists the arguments and options that affect results, in the fixed order of the options of the
 * verb. */
static json_t *words_of(const command_line *l, path_form form)
{
    json_t *to = json_array();
    const verb_option *o;
    for (int i = 0; i < l->arguments; i++)
        json_array_append_new(to, json_string(l->argument[i]));
    for (int i = 0; (o = verb_option_at(l->verb, i, NULL)) != NULL; i++)
        for (int k = 0; (o->traits & (OPTION_ASIDE | OPTION_OUTPUT)) == 0 && k < l->givens; k++)
            if (l->given[k].option == o) {
                add_given(to, &l->given[k], form);
                if (o->argument == NULL)
                    break;
            }
    return to;
}

static status add_file(const void *context, const char *path, fault *f)
{
    return digest_add_file(*(digest *const *)context, path) == 0 ? STATUS_OK
                                                                 : fault_unreadable(f, path, errno);
}

/* Adds the length and the checksum of the reference values, which are checked when they are
 * read. */
static status add_packed(digest *plan, fault *f)
{
    const truths_options usual = {.packed = NULL};
    char line[CHECKSUM_LENGTH + 1];
    TRY(checksum_read(user_tables_packed(&usual), line, f));
    digest_add_text(plan, line);
    return STATUS_OK;
}

static status add_files(digest *plan, const command_line *l, fault *f)
{
    const int built_in = given_value(l, "scene") == NULL || given_value(l, "built-in") != NULL;
    const given_option *g;
    if (built_in && given_value(l, "truths") == NULL)
        TRY(add_packed(plan, f));
    for (int i = 0; (g = given_next(l, OPTION_INPUT, &i)) != NULL;)
        if ((g->option->traits & OPTION_VERDICT) == 0)
            TRY(files_named(g->value, add_file, &plan, f));
    return STATUS_OK;
}

static char *write_origin(const command_line *l)
{
    json_t *out = json_pack("{s:s,s:o?,s:o?}", "verb", l->verb->name, "arguments",
                            words_of(l, PATHS_ABSOLUTE), "as_given", words_of(l, PATHS_GIVEN));
    char *text = out != NULL ? json_dumps(out, JSON_COMPACT) : NULL;
    json_decref(out);
    return text;
}

status identity_make(const command_line *l, identity_texts *out, digest *plan, fault *f)
{
    json_t *words = words_of(l, PATHS_LEAVES);
    *plan = digest_begin();
    name_build(out->build, sizeof out->build);
    name_request(words, out->request);
    json_decref(words);
    out->origin = write_origin(l);
    if (out->origin == NULL)
        return fault_set(
            f, STATUS_FAULT,
            "out of memory, or the command line is not valid UTF-8; use file names in UTF-8");
    return add_files(plan, l, f);
}

static void add_count(digest *plan, int count)
{
    digest_add_number(plan, count);
}

void identity_add_sweep(digest *plan, const sweep *s)
{
    add_count(plan, s->points);
    for (int i = 0; i < s->points; i++) {
        const sweep_point *p = &s->point[i];
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

void identity_set(identity_texts *texts, const digest *plan, shard_work *w)
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
