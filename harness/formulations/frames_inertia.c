/* Inertia of a formulation that brings its own: one element in each request, as it is asked for. */
#include <string.h>

#include "harness/formulations/frame.h"

enum { OUTPUTS = 8, TURNING = 1 << 8, RATE = 1 << 9, ACCELERATION = 1 << 10 };

/* In the order of the mask. */
static void outputs_of(const inertia_output *out, double *to[OUTPUTS])
{
    double *const all[OUTPUTS] = {out->M, out->potential, out->force, out->N,
                                  out->G, out->taken,     out->C,     out->K};
    memcpy(to, all, sizeof all);
}

/* Numbers in an output; c: coordinates of the element. */
static size_t numbers_of(int output, size_t c)
{
    const int vector = output == 2 || output == 5;
    return output == 1 ? 1 : vector ? c : c * c;
}

static int mask_of(double *const to[OUTPUTS], const element_rotating_frame *turning,
                   const inertia_output *out)
{
    int mask = (turning != NULL ? TURNING : 0) | (out->rate != NULL ? RATE : 0) |
               (out->rate != NULL && out->acceleration != NULL ? ACCELERATION : 0);
    for (int i = 0; i < OUTPUTS; i++)
        mask |= to[i] != NULL ? 1 << i : 0;
    return mask;
}

static void put_motion(char **to, const frame_question *q, const element_rotating_frame *turning,
                       const inertia_output *out)
{
    const size_t bytes = (size_t)q->data[0]->coordinates * sizeof(double);
    if (q->mask & TURNING) {
        frame_put(to, turning->omega, sizeof turning->omega);
        frame_put(to, turning->centre, sizeof turning->centre);
    }
    if (q->mask & RATE)
        frame_put(to, out->rate, bytes);
    if (q->mask & ACCELERATION)
        frame_put(to, out->acceleration, bytes);
}

static status inertia_frame(const frame_question *q, const node_state x[],
                            const element_rotating_frame *turning, double *const to[OUTPUTS],
                            const inertia_output *out, fault *f)
{
    const size_t c = (size_t)q->data[0]->coordinates,
                 nodes = (size_t)frame_nodes(q->data[0]) * sizeof *x,
                 numbers = (q->mask & TURNING ? 6 : 0) + (q->mask & RATE ? c : 0) +
                           (q->mask & ACCELERATION ? c : 0);
    const char *from;
    char *at;
    TRY(frame_begin(q, nodes + numbers * sizeof(double), &at, f));
    frame_put(&at, x, nodes);
    put_motion(&at, q, turning, out);
    TRY(frame_ask(q, &from, f));
    for (int i = 0; i < OUTPUTS; i++)
        if (to[i] != NULL)
            frame_take(&from, to[i], numbers_of(i, c));
    return STATUS_OK;
}

static status inertia(const element_data *d, const node_state x[],
                      const element_rotating_frame *turning, inertia_output *out)
{
    double *to[OUTPUTS];
    outputs_of(out, to);
    frame_question q = {CHANNEL_INERTIA, mask_of(to, turning, out), 1, &d, 0};
    for (int i = 0; i < OUTPUTS; i++)
        if (to[i] != NULL)
            q.answer += numbers_of(i, (size_t)d->coordinates) * sizeof(double);
    if (q.answer == 0)
        return STATUS_OK;
    fault f = {""};
    pthread_mutex_lock(&d->of->to.lock);
    const status outcome = inertia_frame(&q, x, turning, to, out, &f);
    channel_note(&d->of->to, outcome, &f);
    pthread_mutex_unlock(&d->of->to.lock);
    return outcome;
}

void frames_serve_inertia(process *p)
{
    p->type.inertia = inertia;
}
