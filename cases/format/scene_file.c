#include "cases/format/scene_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/build.h"
#include "cases/format/expression.h"
#include "cases/format/keys.h"
#include "cases/format/scene_file_impl.h"

enum { VERSION = 1 };

static void check_version(const scene_file *file, mistakes *m)
{
    const document_node *n = document_find(file->root, "beamwork");
    if (strcmp(n->text, "1") != 0)
        document_mistake(m, n, 0, "format version '%.20s'; this program reads version %d", n->text,
                         VERSION);
    else if (strcmp(file->root->key[0]->text, "beamwork") != 0)
        document_mistake(m, file->root, 0, "'beamwork: 1' stands first; move it up");
}

/* Of the file, without its ending: what a name cannot have becomes '_', one for each character. */
static const char *name_of_file(scene_file *file)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_"
                                  "0123456789";
    char name[SCENE_NAME];
    const char *slash = strrchr(file->path, '/');
    const char *at = slash != NULL ? slash + 1 : file->path;
    size_t count = 0;
    if (*at == '\0' || *at == '.' || (*at >= '0' && *at <= '9'))
        count = (size_t)snprintf(name, sizeof name, "scene_");
    for (; *at != '\0' && *at != '.' && count < SCENE_NAME - 1; at++)
        if (((unsigned char)*at & 0xc0) != 0x80) /* else it continues a character */
            name[count++] = strspn(at, letters) > 0 ? *at : '_';
    return arena_copy(&file->arena, name, count);
}

static void read_name(scene_file *file, mistakes *m)
{
    const document_node *n = document_find(file->root, "name");
    const char *text = n != NULL ? n->text : name_of_file(file);
    if (text == NULL)
        return;
    file->type.name = text;
    const size_t length = strlen(text);
    if (length == 0 || length >= SCENE_NAME || scope_name_length(text) != length)
        document_mistake(m, n != NULL ? n : file->root, 0,
                         "name '%.60s': use at most %d letters, digits and _, a letter first", text,
                         SCENE_NAME - 1);
}

static const char *line_of(const scene_file *file, const char *key)
{
    const document_node *n = document_find(file->root, key);
    return n != NULL ? n->text : "";
}

/* Built with memory of its own; mistakes are told in m. */
static void build_at(const scene_file *file, const double value[], build_ends ends, scene *s,
                     mistakes *m)
{
    arena a = {0};
    build_scene(file->root, parameter_table_names(file->parameter, value, &a), ends, &a, m, s);
    arena_free(&a);
}

static status build_from(const void *context, const double value[], scene *s, fault *f)
{
    const scene_file *file = context;
    mistakes m = {.file = file->path};
    build_at(file, value, BUILD_BY_SUPPORTS, s, &m);
    return mistakes_status(&m, f);
}

status scene_file_build_before(const scene_file *file, const double value[], scene *s, fault *f)
{
    mistakes m = {.file = file->path};
    scene_init(s, file->type.name);
    build_at(file, value, BUILD_FREE, s, &m);
    return mistakes_status(&m, f);
}

/* Tree, form, parameters: each where what is before it has no mistake. */
static void read_form(scene_file *file, const char *bytes, size_t size, mistakes *m)
{
    file->root = document_read(bytes, size, &file->arena, m);
    if (file->root == NULL || !keys_check(file->root, m))
        return;
    check_version(file, m);
    read_name(file, m);
    file->type.summary = line_of(file, "summary");
    file->type.source = line_of(file, "source");
    parameter_table_read(file, m);
}

/* Scene and truths at values of the parameters. */
static void check_at(const scene_file *file, const double value[], mistakes *m)
{
    scene s;
    scene_init(&s, file->type.name);
    build_at(file, value, BUILD_BY_SUPPORTS, &s, m);
    if (m->count == 0)
        scene_file_truths_check(file, &s, value, m);
    scene_free(&s);
}

status scene_file_check(const scene_file *file, const double value[], mistakes *m, fault *f)
{
    memset(m, 0, sizeof *m);
    m->file = file->path;
    check_at(file, value, m);
    return mistakes_status(m, f);
}

/* built: at its defaults too. */
static status read_from(const char *bytes, size_t size, const char *path, int built,
                        scene_file **out, mistakes *m, fault *f)
{
    memset(m, 0, sizeof *m);
    m->file = path;
    *out = NULL;
    scene_file *file = calloc(1, sizeof *file);
    if (file == NULL)
        return fault_set(f, STATUS_FAULT, "%.200s: out of memory", path);
    file->path = path;
    file->type.build_from = build_from;
    file->type.context = file;
    file->type.file = path;
    read_form(file, bytes, size, m);
    if (built && m->count == 0 && !m->out_of_memory && !file->arena.failed) {
        double value[CASE_MAX_PARAMETERS] = {0};
        parameter_defaults(file->type.parameters, value);
        check_at(file, value, m);
    }
    m->out_of_memory |= file->arena.failed;
    const status outcome = mistakes_status(m, f);
    if (outcome == STATUS_OK)
        *out = file;
    else
        scene_file_free(file);
    return outcome;
}

status scene_file_read_bytes(const char *bytes, size_t size, const char *path, scene_file **out,
                             mistakes *m, fault *f)
{
    return read_from(bytes, size, path, 1, out, m, f);
}

/* All bytes of a file, at most one more than a scene file may have: a longer one is refused as
 * such. */
static status read_bytes(const char *path, char *bytes, size_t room, size_t *size, fault *f)
{
    FILE *from = fopen(path, "rb");
    if (from == NULL)
        return fault_set(f, STATUS_FAULT, "%.200s cannot be read: %s", path, strerror(errno));
    *size = fread(bytes, 1, room, from);
    const int failed = ferror(from);
    fclose(from);
    return failed ? fault_set(f, STATUS_FAULT, "%.200s cannot be read", path) : STATUS_OK;
}

/* With bytes that scene_file_read frees. */
static status read_file(const char *path, char *bytes, size_t room, int built, scene_file **out,
                        mistakes *m, fault *f)
{
    size_t size = 0;
    TRY(read_bytes(path, bytes, room, &size, f));
    return read_from(bytes, size, path, built, out, m, f);
}

static status read_path(const char *path, int built, scene_file **out, mistakes *m, fault *f)
{
    const size_t room = DOCUMENT_BYTES + 1;
    char *bytes = malloc(room);
    *out = NULL;
    memset(m, 0, sizeof *m);
    m->file = path;
    if (bytes == NULL)
        return fault_set(f, STATUS_FAULT, "%.200s: out of memory", path);
    const status outcome = read_file(path, bytes, room, built, out, m, f);
    free(bytes);
    return outcome;
}

status scene_file_read(const char *path, scene_file **out, mistakes *m, fault *f)
{
    return read_path(path, 1, out, m, f);
}

status scene_file_read_form(const char *path, scene_file **out, mistakes *m, fault *f)
{
    return read_path(path, 0, out, m, f);
}

void scene_file_free(scene_file *file)
{
    if (file == NULL)
        return;
    arena_free(&file->arena);
    free(file);
}

int scene_file_states(const scene_file *file, const char *key)
{
    return document_find(file->root, key) != NULL;
}

const case_type *scene_file_case(const scene_file *file)
{
    return &file->type;
}

const document_node *scene_file_document(const scene_file *file)
{
    return file->root;
}

const char *scene_file_path(const case_type *type)
{
    return type->build_from == build_from ? ((const scene_file *)type->context)->path : NULL;
}
