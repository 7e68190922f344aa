#include <stdlib.h>
#include <string.h>

#include "cases/format/write.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/library/call.h"
#include "harness/library/source.h"
#include "harness/library/text.h"
#include "harness/study/study.h"

/* At its defaults; the file and its name are taken. */
static status new_scene(const case_type *type, scene_file *file, char *name, bw_scene **out,
                        fault *f)
{
    source *from;
    TRY(source_new(type, file, name, &from, f));
    bw_scene *s = calloc(1, sizeof *s);
    if (s == NULL) {
        source_release(from);
        return fault_set(f, STATUS_FAULT, "out of memory for a scene");
    }
    s->from = from;
    parameters_default(type, s->parameter);
    *out = s;
    return STATUS_OK;
}

static status find(const char *name, bw_scene **out, fault *f)
{
    if (out != NULL)
        *out = NULL;
    if (name == NULL || out == NULL)
        return fault_set(f, STATUS_REFUSED, "bw_scene_case: give a name and a place for the scene");
    const case_type *type = case_find(name, f);
    return type != NULL ? new_scene(type, NULL, NULL, out, f) : STATUS_REFUSED;
}

bw_status bw_scene_case(const char *name, bw_scene **out, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, find(name, out, &c.fault));
}

/* All of them, as JSON. */
static void tell(const mistakes *m, call *c)
{
    document_text t;
    fault f;
    if (m->count > 0 && text_begin(&t, &f) == STATUS_OK)
        text_end(&t, mistakes_json(m, t.to, &f), &c->text, &f);
}

/* A text of that size; NULL: the file of that name. */
static status read_file(const char *bytes, size_t size, const char *name, scene_file **out,
                        mistakes *m, fault *f)
{
    return bytes != NULL ? scene_file_read_bytes(bytes, size, name, out, m, f)
                         : scene_file_read(name, out, m, f);
}

static status read_scene(const char *bytes, size_t size, const char *name, bw_scene **out, call *c)
{
    scene_file *file;
    mistakes m;
    char *kept = strdup(name);
    if (kept == NULL)
        return fault_set(&c->fault, STATUS_FAULT, "out of memory for a scene");
    const status outcome = read_file(bytes, size, kept, &file, &m, &c->fault);
    if (outcome == STATUS_OK)
        return new_scene(scene_file_case(file), file, kept, out, &c->fault);
    tell(&m, c);
    free(kept);
    return outcome;
}

bw_status bw_scene_read(const char *bytes, size_t size, const char *name, bw_scene **out,
                        char **why)
{
    call c;
    call_begin(&c, why);
    if (out != NULL)
        *out = NULL;
    if (bytes == NULL || out == NULL)
        return call_end(&c, fault_set(&c.fault, STATUS_REFUSED,
                                      "bw_scene_read: give a text and a place for the scene"));
    return call_end(&c, read_scene(bytes, size, name != NULL ? name : "scene", out, &c));
}

bw_status bw_scene_open(const char *path, bw_scene **out, char **why)
{
    call c;
    call_begin(&c, why);
    if (out != NULL)
        *out = NULL;
    if (path == NULL || out == NULL)
        return call_end(&c, fault_set(&c.fault, STATUS_REFUSED,
                                      "bw_scene_open: give a path and a place for the scene"));
    return call_end(&c, read_scene(NULL, 0, path, out, &c));
}

bw_status bw_scene_set(bw_scene *s, const char *assignment, char **why)
{
    call c;
    call_begin(&c, why);
    if (s == NULL || assignment == NULL)
        return call_end(
            &c, fault_set(&c.fault, STATUS_REFUSED, "bw_scene_set: give a scene and NAME=VALUE"));
    return call_end(&c, parameters_set(source_case(s->from), assignment, s->parameter, &c.fault));
}

static status write_yaml(FILE *to, const bw_scene *handle, fault *f)
{
    const case_type *type = source_case(handle->from);
    const write_head head = {type->name, type->summary, type->source};
    scene s = {0};
    status outcome = cell_scene(type, handle->parameter, NULL, &s, f);
    if (outcome == STATUS_OK)
        outcome = write_scene(to, &s, &head, f);
    scene_free(&s);
    return outcome;
}

static status write_list(FILE *to, const bw_scene *handle, fault *f)
{
    return list_json_case(to, source_case(handle->from), handle->parameter, f);
}

static status document(const bw_scene *s, char **out, const char *what,
                       status (*write)(FILE *, const bw_scene *, fault *), fault *f)
{
    document_text t;
    if (out != NULL)
        *out = NULL;
    if (s == NULL || out == NULL)
        return fault_set(f, STATUS_REFUSED, "%s: give a scene and a place for the text", what);
    TRY(text_begin(&t, f));
    return text_end(&t, write(t.to, s, f), out, f);
}

bw_status bw_scene_write(const bw_scene *s, char **yaml, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, document(s, yaml, "bw_scene_write", write_yaml, &c.fault));
}

bw_status bw_scene_json(const bw_scene *s, char **json, char **why)
{
    call c;
    call_begin(&c, why);
    return call_end(&c, document(s, json, "bw_scene_json", write_list, &c.fault));
}

void bw_scene_free(bw_scene *s)
{
    if (s == NULL)
        return;
    source_release(s->from);
    free(s);
}
