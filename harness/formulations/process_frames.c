#include <math.h>
#include <string.h>
#include <unistd.h>

#include "elements/math/dense.h"
#include "harness/formulations/process_impl.h"

enum { FRAME = 1 << 23 }; /* [bytes] approximate size of a request and its answer */

static channel *frame_channel(const frame_question *q)
{
    return &q->data[0]->of->to;
}

/* Returns OK if the process still has the data of these elements, otherwise FAULT. */
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
        return channel_break(
            c, "its process was restarted between two requests; run the command again", f);
    return many ? channel_break(
                      c, "a request has more than 65536 kinds of elements; use fewer elements", f)
                : STATUS_OK;
}

static void frame_put(char **to, const void *from, size_t bytes)
{
    memcpy(*to, from, bytes);
    *to += bytes;
}

static void frame_take(const char **from, double to[], size_t count)
{
    memcpy(to, *from, count * sizeof(double));
    *from += count * sizeof(double);
}

/* Starts a request and writes the kinds of the elements. *to: memory for `each` bytes of every
 * element. FAULT: the process no longer has the data of these elements, or out of memory. */
static status frame_begin(const frame_question *q, size_t each, char **to, fault *f)
{
    TRY(known(q, f));
    channel_begin(frame_channel(q));
    *to = channel_add(frame_channel(q), (size_t)q->count * (sizeof(int64_t) + each));
    if (*to == NULL)
        return channel_break(
            frame_channel(q),
            "out of memory for a mesh; close other programs, or use fewer elements", f);
    for (int i = 0; i < q->count; i++) {
        const int64_t kind = q->data[i]->kind % PROCESS_KINDS;
        frame_put(to, &kind, sizeof kind);
    }
    return STATUS_OK;
}

/* Sends the request and waits for the answer. *body: count x answer bytes. */
static status frame_ask(const frame_question *q, const char **body, fault *f)
{
    const size_t bytes = (size_t)q->count * q->answer;
    size_t count;
    return channel_ask(frame_channel(q), q->what, q->mask, q->count, bytes, bytes, body, &count, f);
}

/* Returns the number of elements, with `each` bytes, that fit into a request; at least 1. More
 * elements need several requests. */
static int frame_fitting(size_t each)
{
    return (int)(FRAME / each) + 1;
}

static int frame_nodes(const element_data *d)
{
    return d->coordinates / (NODE_COORDINATES + d->scalars);
}

enum { NODE_NUMBERS = 16 };
_Static_assert(offsetof(node_state, scalar) == NODE_NUMBERS * sizeof(double),
               "a node is sent as its bytes");

/* Returns the size of the nodes of an element in a request [bytes]. */
static size_t frame_node_bytes(const element_data *d)
{
    return (size_t)(frame_nodes(d) * (NODE_NUMBERS + d->scalars)) * sizeof(double);
}

static void frame_put_nodes(char **to, const frame_question *q, const node_state x[])
{
    const element_data *d = q->data[0];
    for (int i = 0; i < q->count * frame_nodes(d); i++)
        frame_put(to, &x[i], NODE_NUMBERS * sizeof(double));
    for (int i = 0; i < q->count * frame_nodes(d) && d->scalars > 0; i++)
        frame_put(to, x[i].scalar, (size_t)d->scalars * sizeof(double));
}

static status strain_frame(const frame_question *q, const node_state x[], strain_output out[],
                           fault *f)
{
    const element_data *d = q->data[0];
    const size_t m = (size_t)d->strains, c = (size_t)d->coordinates, h = (size_t)d->history,
                 nodes = frame_node_bytes(d), s = q->mask & 4 ? m : 0;
    const char *from;
    char *to;
    TRY(frame_begin(q, nodes + (h + s) * sizeof(double), &to, f));
    frame_put_nodes(&to, q, x);
    for (int i = 0; i < q->count && h > 0; i++)
        frame_put(&to, out[i].history, h * sizeof(double));
    for (int i = 0; i < q->count && s > 0; i++)
        frame_put(&to, out[i].s, s * sizeof(double));
    TRY(frame_ask(q, &from, f));
    for (int i = 0; i < q->count && q->mask & 1; i++)
        frame_take(&from, out[i].e, m);
    for (int i = 0; i < q->count && q->mask & 2; i++)
        frame_take(&from, out[i].J, m * c);
    for (int i = 0; i < q->count && q->mask & 4; i++)
        frame_take(&from, out[i].H, c * c);
    return STATUS_OK;
}

static void fill_nan(double to[], size_t count)
{
    for (size_t i = 0; to != NULL && i < count; i++)
        to[i] = NAN;
}

static void no_strains(const frame_question *q, strain_output out[], const fault *why)
{
    const size_t m = (size_t)q->data[0]->strains, c = (size_t)q->data[0]->coordinates;
    channel_note(frame_channel(q), STATUS_REFUSED, why);
    for (int i = 0; i < q->count; i++) {
        fill_nan(out[i].e, m);
        fill_nan(out[i].J, m * c);
        if (out[i].s != NULL)
            fill_nan(out[i].H, c * c);
    }
}

static void strain_many(int count, const element_data *const data[], const node_state x[],
                        strain_output out[])
{
    if (count == 0)
        return;
    const element_data *d = data[0];
    const size_t m = (size_t)d->strains, c = (size_t)d->coordinates;
    const int mask = (out->e != NULL ? 1 : 0) + (out->J != NULL ? 2 : 0) +
                     (out->s != NULL && out->H != NULL ? 4 : 0);
    const size_t answer =
        sizeof(double) * ((mask & 1 ? m : 0) + (mask & 2 ? m * c : 0) + (mask & 4 ? c * c : 0));
    const int most = frame_fitting(answer + frame_node_bytes(d));
    status outcome = STATUS_OK;
    fault f = {""};
    pthread_mutex_lock(&d->of->to.lock);
    for (int i = 0; i < count && mask != 0; i += most) {
        const frame_question q = {CHANNEL_STRAIN, mask, i + most < count ? most : count - i,
                                  data + i, answer};
        if (outcome == STATUS_OK)
            outcome = strain_frame(&q, x + i * frame_nodes(d), out + i, &f);
        if (outcome != STATUS_OK)
            no_strains(&q, out + i, &f);
    }
    pthread_mutex_unlock(&d->of->to.lock);
}

static void strain(const element_data *d, const node_state x[], strain_output *out)
{
    strain_many(1, &d, x, out);
}

static void linear_stress(const element_data *d, const double e[], stress_output *out)
{
    const int m = d->strains;
    double sigma[ELEMENT_MAX_STRAINS], energy = 0;
    dense_mul_vec(m, m, d->C, e, sigma);
    for (int k = 0; k < m; k++)
        energy += sigma[k] * e[k] / 2;
    if (out->energy != NULL)
        *out->energy = energy;
    if (out->sigma != NULL)
        memcpy(out->sigma, sigma, (size_t)m * sizeof *sigma);
    if (out->C != NULL)
        memcpy(out->C, d->C, (size_t)(m * m) * sizeof *d->C);
}

static status stress_frame(const frame_question *q, const double *const e[], stress_output out[],
                           fault *f)
{
    const size_t m = (size_t)q->data[0]->strains;
    const char *from;
    char *to;
    TRY(frame_begin(q, m * sizeof(double), &to, f));
    for (int i = 0; i < q->count; i++)
        frame_put(&to, e[i], m * sizeof(double));
    TRY(frame_ask(q, &from, f));
    for (int i = 0; i < q->count && q->mask & 1; i++)
        frame_take(&from, out[i].energy, 1);
    for (int i = 0; i < q->count && q->mask & 2; i++)
        frame_take(&from, out[i].sigma, m);
    for (int i = 0; i < q->count && q->mask & 4; i++)
        frame_take(&from, out[i].C, m * m);
    return STATUS_OK;
}

static void stress_frames(int count, const element_data *const data[], const double *const e[],
                          stress_output out[], status outcome[])
{
    const size_t m = (size_t)data[0]->strains;
    const int mask =
        (out->energy != NULL ? 1 : 0) + (out->sigma != NULL ? 2 : 0) + (out->C != NULL ? 4 : 0);
    const size_t answer =
        sizeof(double) * ((mask & 1 ? 1 : 0) + (mask & 2 ? m : 0) + (mask & 4 ? m * m : 0));
    const int most = frame_fitting(answer + m * sizeof(double));
    pthread_mutex_lock(&data[0]->of->to.lock);
    for (int i = 0; i < count; i += most) {
        const frame_question q = {CHANNEL_STRESS, mask, i + most < count ? most : count - i,
                                  data + i, answer};
        fault f = {""};
        const status found = mask != 0 ? stress_frame(&q, e + i, out + i, &f) : STATUS_OK;
        for (int k = i; k < i + q.count; k++)
            outcome[k] = found;
        channel_note(&data[0]->of->to, found, &f);
    }
    pthread_mutex_unlock(&data[0]->of->to.lock);
}

static void stress_many(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[])
{
    int linear = 1;
    (void)inner;
    for (int i = 0; i < count; i++) {
        linear &= data[i]->linear;
        if (out[i].residual != NULL)
            *out[i].residual = 0;
    }
    if (!linear) {
        stress_frames(count, data, e, out, outcome);
        return;
    }
    for (int i = 0; i < count; i++) {
        linear_stress(data[i], e[i], &out[i]);
        outcome[i] = STATUS_OK;
    }
}

static status stress(const element_data *d, const double e[], const double inner[],
                     stress_output *out)
{
    status outcome = STATUS_OK;
    stress_many(1, &d, &e, &inner, out, &outcome);
    return outcome;
}

static status force_frame(const frame_question *q, const node_state x[], force_output out[],
                          fault *f)
{
    const element_data *d = q->data[0];
    const size_t c = (size_t)d->coordinates, nodes = frame_node_bytes(d),
                 h = (size_t)d->history * sizeof(double);
    const char *from;
    char *to;
    TRY(frame_begin(q, nodes + h, &to, f));
    frame_put_nodes(&to, q, x);
    for (int i = 0; i < q->count && h > 0; i++)
        frame_put(&to, out[i].history, h);
    TRY(frame_ask(q, &from, f));
    for (int i = 0; i < q->count && q->mask & 1; i++)
        frame_take(&from, out[i].energy, 1);
    for (int i = 0; i < q->count && q->mask & 2; i++)
        frame_take(&from, out[i].F, c);
    for (int i = 0; i < q->count && q->mask & 4; i++)
        frame_take(&from, out[i].K, c * c);
    return STATUS_OK;
}

static void force_many(int count, const element_data *const data[], const node_state x[],
                       force_output out[], status outcome[])
{
    if (count == 0)
        return;
    const element_data *d = data[0];
    const size_t c = (size_t)d->coordinates;
    const int mask =
        (out->energy != NULL ? 1 : 0) + (out->F != NULL ? 2 : 0) + (out->K != NULL ? 4 : 0);
    const size_t answer =
        sizeof(double) * ((mask & 1 ? 1 : 0) + (mask & 2 ? c : 0) + (mask & 4 ? c * c : 0));
    const int most = frame_fitting(answer + frame_node_bytes(d));
    pthread_mutex_lock(&d->of->to.lock);
    for (int i = 0; i < count; i += most) {
        const frame_question q = {CHANNEL_FORCE, mask, i + most < count ? most : count - i,
                                  data + i, answer};
        fault f = {""};
        const status found =
            mask != 0 ? force_frame(&q, x + i * frame_nodes(d), out + i, &f) : STATUS_OK;
        for (int k = i; k < i + q.count; k++)
            outcome[k] = found;
        channel_note(&d->of->to, found, &f);
    }
    pthread_mutex_unlock(&d->of->to.lock);
}

static status force(const element_data *d, const node_state x[], force_output *out)
{
    status outcome = STATUS_OK;
    force_many(1, &d, x, out, &outcome);
    return outcome;
}

void frames_serve(process *p)
{
    element_type *t = &p->type;
    t->strain = p->whole ? NULL : strain;
    t->stress = p->whole ? NULL : stress;
    t->force = p->whole ? force : NULL;
    t->strain_many = p->whole ? NULL : strain_many;
    t->stress_many = p->whole ? NULL : stress_many;
    t->force_many = p->whole ? force_many : NULL;
}

enum { OUTPUTS = 8, TURNING = 1 << 8, RATE = 1 << 9, ACCELERATION = 1 << 10 };

static void outputs_of(const inertia_output *out, double *to[OUTPUTS])
{
    double *const all[OUTPUTS] = {out->M, out->potential, out->force, out->N,
                                  out->G, out->taken,     out->C,     out->K};
    memcpy(to, all, sizeof all);
}

/* Returns the number of values in an output. c: number of coordinates of the element. */
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
    const size_t c = (size_t)q->data[0]->coordinates, nodes = frame_node_bytes(q->data[0]),
                 numbers = (q->mask & TURNING ? 6 : 0) + (q->mask & RATE ? c : 0) +
                           (q->mask & ACCELERATION ? c : 0);
    const char *from;
    char *at;
    TRY(frame_begin(q, nodes + numbers * sizeof(double), &at, f));
    frame_put_nodes(&at, q, x);
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

static void history_of(const element_data *d, enum channel_request what, const node_state x[],
                       double history[])
{
    const size_t nodes = frame_node_bytes(d), count = (size_t)d->history,
                 given = what == CHANNEL_COMMIT ? count * sizeof *history : 0;
    const frame_question q = {what, 0, 1, &d, count * sizeof *history};
    const char *from;
    char *to;
    fault f = {""};
    pthread_mutex_lock(&d->of->to.lock);
    status outcome = frame_begin(&q, nodes + given, &to, &f);
    if (outcome == STATUS_OK) {
        frame_put_nodes(&to, &q, x);
        frame_put(&to, history, given);
        outcome = frame_ask(&q, &from, &f);
    }
    if (outcome == STATUS_OK)
        frame_take(&from, history, count);
    else
        fill_nan(history, count);
    channel_note(&d->of->to, outcome == STATUS_OK ? STATUS_OK : STATUS_REFUSED, &f);
    pthread_mutex_unlock(&d->of->to.lock);
}

static void begin(const element_data *d, const node_state x[], double history[])
{
    history_of(d, CHANNEL_BEGIN, x, history);
}

static void commit(const element_data *d, const node_state x[], double history[])
{
    history_of(d, CHANNEL_COMMIT, x, history);
}

void frames_serve_history(process *p)
{
    p->type.begin = begin;
    p->type.commit = commit;
}

static void damping(const element_data *d, double V[])
{
    const size_t square = (size_t)d->strains * (size_t)d->strains;
    memcpy(V, d->C + square, square * sizeof *V);
}

void frames_serve_damping(process *p)
{
    p->type.damping = damping;
}

static void put_points(char **to, int count, const line_output out[])
{
    for (int i = 0; i < count; i++)
        frame_put(to, &out[i].at, sizeof out->at);
    for (int i = 0; i < count; i++)
        frame_put(to, out[i].force, sizeof out->force);
    for (int i = 0; i < count; i++)
        frame_put(to, out[i].moment, sizeof out->moment);
}

static status line_frame(const frame_question *q, const node_state x[], line_output out[], fault *f)
{
    const size_t c = (size_t)q->data[0]->coordinates, nodes = frame_node_bytes(q->data[0]);
    const char *from;
    char *to;
    TRY(frame_begin(q, nodes + 7 * sizeof(double), &to, f));
    for (int i = 0; i < q->count * frame_nodes(q->data[0]); i++)
        frame_put(&to, &x[i % frame_nodes(q->data[0])], NODE_NUMBERS * sizeof(double));
    put_points(&to, q->count, out);
    TRY(frame_ask(q, &from, f));
    for (int i = 0; i < q->count; i++)
        frame_take(&from, out[i].r, 3);
    for (int i = 0; i < q->count; i++)
        frame_take(&from, out[i].R, 9);
    for (int i = 0; i < q->count && q->mask & 4; i++)
        frame_take(&from, out[i].P, 3 * c);
    for (int i = 0; i < q->count && q->mask & 8; i++)
        frame_take(&from, out[i].T, 3 * c);
    for (int i = 0; i < q->count && q->mask & 16; i++)
        frame_take(&from, out[i].H, c * c);
    return STATUS_OK;
}

static void no_motion(size_t c, line_output *out)
{
    fill_nan(out->r, 3);
    fill_nan(out->R, 9);
    fill_nan(out->P, 3 * c);
    fill_nan(out->T, 3 * c);
    fill_nan(out->H, c * c);
}

static void line(const element_data *d, const node_state x[], int count, line_output out[])
{
    enum { TOGETHER = 64 };
    const size_t c = (size_t)d->coordinates;
    const element_data *data[TOGETHER];
    fault f = {""};
    for (int i = 0; i < TOGETHER; i++)
        data[i] = d;
    pthread_mutex_lock(&d->of->to.lock);
    for (int i = 0; i < count; i += TOGETHER) {
        const int mask =
            3 | (out->P != NULL ? 4 : 0) | (out->T != NULL ? 8 : 0) | (out->H != NULL ? 16 : 0);
        const size_t numbers =
            12 + (mask & 4 ? 3 * c : 0) + (mask & 8 ? 3 * c : 0) + (mask & 16 ? c * c : 0);
        const frame_question q = {CHANNEL_LINE, mask, count - i < TOGETHER ? count - i : TOGETHER,
                                  data, numbers * sizeof(double)};
        const status outcome = line_frame(&q, x, out + i, &f);
        for (int k = i; k < i + q.count && outcome != STATUS_OK; k++)
            no_motion(c, &out[k]);
        channel_note(&d->of->to, outcome == STATUS_OK ? STATUS_OK : STATUS_REFUSED, &f);
    }
    pthread_mutex_unlock(&d->of->to.lock);
}

void frames_serve_line(process *p)
{
    p->type.line = line;
}
