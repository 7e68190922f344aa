#include "harness/ranges/ranges_identity.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "harness/catalogue/environment.h"
#include "harness/catalogue/parameters.h"

/* Text that grows up to a room. */
typedef struct line {
    char *text;
    size_t room, used;
} line;

__attribute__((format(printf, 2, 3))) static void say(line *l, const char *format, ...)
{
    va_list values;
    if (l->used >= l->room)
        return;
    va_start(values, format);
    const int more = vsnprintf(l->text + l->used, l->room - l->used, format, values);
    va_end(values);
    l->used += more > 0 ? (size_t)more : 0;
}

static void say_request(const ranges *r, char out[RANGES_REQUEST])
{
    const ranges_request *q = &r->request;
    line l = {out, RANGES_REQUEST, 0};
    char fixed[PARAMETERS_TEXT];
    parameters_text(q->type, r->base, fixed, sizeof fixed);
    say(&l, "%s%s%s;", q->type->name, fixed[0] != '\0' ? " " : "", fixed);
    for (int i = 0; i < q->varies; i++)
        say(&l, " --vary %s", q->vary[i]);
    say(&l, " --design %s", design_name(q->design));
    if (q->design != DESIGN_GRID)
        say(&l, " --points %ld", q->points);
    if (q->design == DESIGN_RANDOM)
        say(&l, " --seed %lu", q->seed);
    for (int i = 0; i < r->formulations; i++)
        say(&l, " -f %s", r->formulation[i].key);
    for (int i = 0; i < r->meshes; i++)
        say(&l, "%s%d", i == 0 ? " -n " : ",", r->mesh[i]);
    if (q->select != NULL)
        say(&l, " -k '%s'", q->select);
    say(&l, " --error %.17g --time-limit %d%s", q->tolerance, q->time_limit,
        q->derive != NULL ? " --derive" : "");
}

status ranges_identity_make(const ranges *r, const char *truths_path, ranges_identity *out,
                            fault *f)
{
    const environment e = environment_now(1);
    const char *path = r->request.file != NULL ? scene_file_path(r->request.type) : NULL;
    digest all = digest_begin();
    snprintf(out->build, sizeof out->build, "beamwork %s (%s), %s, %s", e.version, e.commit,
             e.compiler, e.flags);
    say_request(r, out->request);
    digest_add_text(&all, out->build);
    digest_add_text(&all, out->request);
    for (int i = 0; i < r->request.varies; i++)
        digest_add_text(&all, r->request.vary[i]);
    digest_add(&all, r->base, sizeof r->base);
    for (int i = 0; i < r->quantities; i++)
        digest_add_text(&all, r->quantity[i].name);
    digest_add(&all, &r->points_in_batch, sizeof r->points_in_batch);
    if (path != NULL && digest_add_file(&all, path) != 0)
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be read again", path);
    if (truths_path != NULL && digest_add_file(&all, truths_path) != 0)
        return fault_set(f, STATUS_FAULT, "%.200s: cannot be read again", truths_path);
    digest_text(&all, out->plan);
    return STATUS_OK;
}
