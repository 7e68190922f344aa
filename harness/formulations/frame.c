#include "harness/formulations/frame.h"

#include <string.h>
#include <unistd.h>

enum { FRAME = 1 << 23 }; /* bytes of an answer and its request, about */

channel *frame_channel(const frame_question *q)
{
    return &q->data[0]->of->to;
}

/* The process still knows these elements. */
static status known(const frame_question *q, fault *f)
{
    const process *p = q->data[0]->of;
    channel *c = frame_channel(q);
    int lost = c->process.process == 0 || c->process.owner != getpid(), many = 0;
    for (int i = 0; i < q->count; i++) {
        lost |= q->data[i]->started != c->started;
        many |= q->data[i]->kind < p->kinds - PROCESS_KINDS;
    }
    if (lost && c->trouble[0] != '\0')
        return fault_set(f, STATUS_FAULT, "%s", c->trouble);
    if (lost)
        return channel_break(c, "its process was started anew between two requests", f);
    return many ? channel_break(c, "more than 65536 kinds of elements at once", f) : STATUS_OK;
}

void frame_put(char **to, const void *from, size_t bytes)
{
    memcpy(*to, from, bytes);
    *to += bytes;
}

void frame_take(const char **from, double to[], size_t count)
{
    memcpy(to, *from, count * sizeof(double));
    *from += count * sizeof(double);
}

status frame_begin(const frame_question *q, size_t each, char **to, fault *f)
{
    TRY(known(q, f));
    channel_begin(frame_channel(q));
    *to = channel_add(frame_channel(q), (size_t)q->count * (sizeof(int64_t) + each));
    if (*to == NULL)
        return channel_break(frame_channel(q), "out of memory for a mesh", f);
    for (int i = 0; i < q->count; i++) {
        const int64_t kind = q->data[i]->kind % PROCESS_KINDS;
        frame_put(to, &kind, sizeof kind);
    }
    return STATUS_OK;
}

status frame_ask(const frame_question *q, const char **body, fault *f)
{
    const size_t bytes = (size_t)q->count * q->answer;
    size_t count;
    return channel_ask(frame_channel(q), q->what, q->mask, q->count, bytes, bytes, body, &count, f);
}

int frame_fitting(size_t each)
{
    return (int)(FRAME / each) + 1;
}

int frame_nodes(const element_data *d)
{
    return d->coordinates / NODE_COORDINATES;
}
