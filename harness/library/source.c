#include "harness/library/source.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "harness/library/known.h"

struct source {
    atomic_int holders;
    const case_type *type;
    scene_file *file;
    char *name;
    int is_known; /* 1: it was read */
    truths known;
};

status source_new(const case_type *type, scene_file *file, char *name, source **out, fault *f)
{
    *out = calloc(1, sizeof **out);
    if (*out == NULL) {
        scene_file_free(file);
        free(name);
        return fault_set(f, STATUS_FAULT, "out of memory for a scene");
    }
    **out = (source){.type = type, .file = file, .name = name};
    atomic_init(&(*out)->holders, 1);
    return STATUS_OK;
}

source *source_hold(source *s)
{
    atomic_fetch_add(&s->holders, 1);
    return s;
}

void source_release(source *s)
{
    if (s == NULL || atomic_fetch_sub(&s->holders, 1) > 1)
        return;
    truths_free(&s->known);
    scene_file_free(s->file);
    free(s->name);
    free(s);
}

const case_type *source_case(const source *s)
{
    return s->type;
}

const scene_file *source_file(const source *s)
{
    return s->file;
}

status source_known(source *s, const truths **out, fault *f)
{
    status outcome = STATUS_OK;
    known_hold();
    if (!s->is_known)
        outcome = known_read_held(s->file == NULL ? s->type : NULL, &s->known, f);
    s->is_known |= outcome == STATUS_OK;
    *out = s->is_known ? &s->known : NULL;
    known_let_go();
    return outcome;
}
