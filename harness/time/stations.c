#include "harness/time/time_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"

enum { PARTS = 5, BALL = 3 };

/* Data of a coordinate in a step: its increment, and its rates and their derivatives at both ends.
 * The unit of time is the step size. */
typedef struct between_ends {
    double whole, rate[2], second[2];
} between_ends;

status dense_output_alloc(const equations *eq, dense_output *b, fault *f)
{
    const model *m = eq->m;
    const model_size size = model_sizes(m);
    const size_t all = (size_t)(size.free + size.driven) + 1;
    memset(b, 0, sizeof *b);
    b->eq = eq;
    b->m = m;
    b->part = calloc(PARTS * all, sizeof *b->part);
    b->room = calloc(3 * all, sizeof *b->room);
    return b->part != NULL && b->room != NULL ? STATUS_OK : fault_memory(f, "the time integration");
}

void dense_output_free(dense_output *b)
{
    free(b->part);
    free(b->room);
}

static void put(const dense_output *b, int coordinate, const between_ends *e)
{
    double *part = b->part + PARTS * (size_t)coordinate;
    const double D = e->whole, r = e->rate[0], t = e->rate[1], p = e->second[0], q = e->second[1];
    const double cubic[PARTS] = {r, 3 * D - 2 * r - t, r + t - 2 * D, 0, 0};
    const double quintic[PARTS] = {r, p / 2, 10 * D - 6 * r - 4 * t - 1.5 * p + 0.5 * q,
                                   8 * r + 7 * t + 1.5 * p - q - 15 * D,
                                   6 * D - 3 * r - 3 * t - 0.5 * p + 0.5 * q};
    memcpy(part, b->degree == DENSE_OUTPUT_CUBIC ? cubic : quintic, sizeof cubic);
}

static void put_plain(const dense_output *b, int c, double whole, double h)
{
    const motion_state *from = b->from, *to = b->to;
    if (c == NONE)
        return;
    put(b, c,
        &(between_ends){
            whole, {h * from->v[c], h * to->v[c]}, {h * h * from->a[c], h * h * to->a[c]}});
}

/* Computes the rates t' and t'' of the rotation vector t from the body rates W and W'. */
static void vector_rates(const double t[3], const double W[3], const double Wd[3], double rate[3],
                         double second[3])
{
    double inverse[9], D[9], more[3];
    rotation_rates_inverse(t, inverse);
    mat3_mul_vec(inverse, W, rate);
    rotation_rates_derivative(t, rate, D);
    mat3_mul_vec(D, rate, more);
    for (int k = 0; k < 3; k++)
        more[k] = Wd[k] - more[k];
    mat3_mul_vec(inverse, more, second);
}

static void turn_of(const dense_output *b, int vertex, double t[3])
{
    double back[4], q[4];
    rotation_conjugate(&b->from->state->q[4 * vertex], back);
    rotation_compose(back, &b->to->state->q[4 * vertex], q);
    rotation_log(q, t);
}

static void put_turn(const dense_output *b, int vertex, double h)
{
    const int *at = model_vertex(b->m, vertex)->coordinate + SCENE_RX;
    const motion_state *end[2] = {b->from, b->to};
    double t[2][3] = {{0}}, rate[2][3], second[2][3];
    turn_of(b, vertex, t[1]);
    for (int i = 0; i < 2; i++) {
        double W[3], Wd[3];
        for (int k = 0; k < 3; k++) {
            W[k] = at[k] != NONE ? h * end[i]->v[at[k]] : 0;
            Wd[k] = at[k] != NONE ? h * h * end[i]->a[at[k]] : 0;
        }
        vector_rates(t[i], W, Wd, rate[i], second[i]);
    }
    for (int k = 0; k < 3; k++)
        if (at[k] != NONE)
            put(b, at[k],
                &(between_ends){t[1][k], {rate[0][k], rate[1][k]}, {second[0][k], second[1][k]}});
}

static void put_ball(const dense_output *b, int vertex)
{
    const int *at = model_vertex(b->m, vertex)->coordinate + SCENE_RX;
    double t[3];
    turn_of(b, vertex, t);
    for (int k = 0; k < 3; k++)
        put(b, at[k], &(between_ends){t[k], {t[k], t[k]}, {0, 0}});
}

static void put_release(const dense_output *b, int vertex, double h)
{
    const model *m = b->m;
    const mesh_release *r = release_of(m, vertex);
    const int *at = model_vertex(m, vertex)->coordinate;
    const model_state *from = b->from->state, *to = b->to->state;
    for (int k = 0; k < r->slides; k++) {
        const int i = 3 * (vertex - model_first_release(m)) + k;
        put_plain(b, at[k], to->shift[i] - from->shift[i], h);
    }
    for (int k = 0; k < r->turns && r->turns < BALL; k++)
        put_plain(b, at[SCENE_RX + k], to->angle[3 * vertex + k] - from->angle[3 * vertex + k], h);
    if (r->turns == BALL)
        put_ball(b, vertex);
}

void dense_output_set(dense_output *b, dense_output_degree degree, const motion_state *from,
                      const motion_state *to)
{
    const model *m = b->m;
    const double h = to->time - from->time;
    b->degree = degree;
    b->from = from;
    b->to = to;
    for (int i = 0; i < model_first_release(m); i++) {
        const mesh_vertex *v = model_vertex(m, i);
        if (v->body != i)
            continue;
        double moved[3];
        for (int k = 0; k < 3; k++)
            moved[k] = to->state->u[3 * i + k] - from->state->u[3 * i + k];
        kinematics_to_own(v, moved);
        for (int k = 0; k < 3; k++) {
            const int at = 3 * i + k;
            if (model_owns(m, i, k))
                put_plain(b, v->coordinate[k], moved[k], h);
            if (v->angles > 0 && model_owns(m, i, SCENE_RX + k))
                put_plain(b, v->coordinate[SCENE_RX + k],
                          to->state->angle[at] - from->state->angle[at], h);
        }
        if (v->angles == 0 && model_owns(m, i, SCENE_RX))
            put_turn(b, i, h);
    }
    for (int i = model_first_release(m); i < model_vertices(m); i++)
        put_release(b, i, h);
    for (int i = 0; i < model_warps(m); i++)
        put_plain(b, model_warp(m, i), to->state->warp[i] - from->state->warp[i], h);
}

static void turn_rates(const dense_output *b, int vertex, const double inc[], const double rate[],
                       const double second[], motion_state *at)
{
    const int *index = model_vertex(b->m, vertex)->coordinate + SCENE_RX;
    double t[3], first[3], then[3], Jr[9], D[9], W[3], Wd[3], more[3];
    for (int k = 0; k < 3; k++) {
        t[k] = index[k] != NONE ? inc[index[k]] : 0;
        first[k] = index[k] != NONE ? rate[index[k]] : 0;
        then[k] = index[k] != NONE ? second[index[k]] : 0;
    }
    rotation_rates_jacobian(t, Jr);
    rotation_rates_derivative(t, first, D);
    mat3_mul_vec(Jr, first, W);
    mat3_mul_vec(Jr, then, Wd);
    mat3_mul_vec(D, first, more);
    for (int k = 0; k < 3; k++)
        if (index[k] != NONE) {
            at->v[index[k]] = W[k];
            at->a[index[k]] = Wd[k] + more[k];
        }
}

static void blend(size_t count, double s, const double from[], const double to[], double out[])
{
    for (size_t i = 0; i < count; i++)
        out[i] = (1 - s) * from[i] + s * to[i];
}

static void blend_elements(const dense_output *b, double s, model_state *at)
{
    const model *m = b->m;
    const model_state *from = b->from->state, *to = b->to->state;
    const size_t strains = (size_t)model_elements(m) * (size_t)model_strains(m),
                 inner = (size_t)model_elements(m) * (size_t)model_inner(m);
    blend(strains, s, from->e, to->e, at->e);
    blend(strains, s, from->sigma, to->sigma, at->sigma);
    blend(inner, s, from->inner, to->inner, at->inner);
}

/* Sets positions and rates at a time [s] inside the step or close to it. */
static void between_places(const dense_output *b, double time, motion_state *at)
{
    const model *m = b->m;
    const int all = model_all_coordinates(m);
    const double h = b->to->time - b->from->time, s = (time - b->from->time) / h;
    double *inc = b->room, *rate = inc + all, *second = rate + all;
    for (int c = 0; c < all; c++) {
        const double *p = b->part + PARTS * (size_t)c;
        inc[c] = s * (p[0] + s * (p[1] + s * (p[2] + s * (p[3] + s * p[4]))));
        rate[c] = (p[0] + s * (2 * p[1] + s * (3 * p[2] + s * (4 * p[3] + s * 5 * p[4])))) / h;
        second[c] = (2 * p[1] + s * (6 * p[2] + s * (12 * p[3] + s * 20 * p[4]))) / (h * h);
    }
    memcpy(at->v, rate, (size_t)all * sizeof *rate);
    memcpy(at->a, second, (size_t)all * sizeof *second);
    for (int i = 0; i < model_first_release(m); i++)
        if (model_vertex(m, i)->body == i && model_vertex(m, i)->angles == 0)
            turn_rates(b, i, inc, rate, second, at);
    if (b->degree == DENSE_OUTPUT_CUBIC)
        blend((size_t)all, s, b->from->a, b->to->a, at->a);
    drive_at(b->eq, b->from->state, time, inc, at->v, at->a);
    memcpy(at->algorithm, at->a, (size_t)all * sizeof *at->a);
    increment_apply(m, b->from->state, inc, time, at->state);
    memcpy(at->state->history, b->to->state->history,
           (size_t)model_elements(m) * (size_t)model_history(m) * sizeof *at->state->history);
    at->time = time;
    at->ends_known = 0;
}

enum { SLOPE = 5 };

/* Returns the derivative at x of the polynomial through the values at 0.1, 0.3, ..., 0.9. */
static double slope_of(const double value[SLOPE], double x)
{
    double sum = 0;
    for (int i = 0; i < SLOPE; i++) {
        double whole = 0, scale = 1;
        for (int k = 0; k < SLOPE; k++) {
            double product = 1;
            for (int l = 0; l < SLOPE; l++)
                product *= l != i && l != k ? x - (0.1 + 0.2 * l) : 1;
            whole += k != i ? product : 0;
            scale *= k != i ? 0.2 * (i - k) : 1;
        }
        sum += value[i] * whole / scale;
    }
    return sum;
}

double dense_output_reading(const dense_output *b, const scene_quantity *q, double time,
                            motion_state *at)
{
    const double begin = b->from->time, h = b->to->time - begin;
    const int slope = reading_is_slope(q);
    double value[SLOPE];
    for (int i = 0; i < (slope ? SLOPE : 1); i++) {
        between_places(b, slope ? begin + h * (0.1 + 0.2 * i) : time, at);
        value[i] = reading_of(b->m, q, at->state, at->v, at->a);
    }
    return slope ? slope_of(value, (time - begin) / h) / h : value[0];
}

void dense_output_at(const dense_output *b, double time, motion_state *at)
{
    between_places(b, time, at);
    blend_elements(b, (time - b->from->time) / (b->to->time - b->from->time), at->state);
}

/* Distance to the end of a step, relative to the step size, below which a station counts as this
 * end. */
static const double same_instant = 1e-9;

static int is_slope(const stations *s, int quantity)
{
    const scene_quantity *q = &s->c->scene->quantity[quantity];
    return q->analysis == s->analysis && reading_is_slope(q);
}

static void take_slopes(stations *s, const motion_state *from, const motion_state *to)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    const double near = same_instant * (to->time - from->time);
    int first = s->out->path.reached;
    while (first > 0 && s->sloped == 0 && path->value[first - 1] >= from->time - near)
        first--;
    s->sloped = 1;
    dense_output_set(&s->inside, s->scheme->degree, from, to);
    for (int i = first; i < path->stations && path->value[i] <= to->time + near; i++)
        for (int q = 0; q < s->c->scene->quantities; q++)
            if (is_slope(s, q))
                s->out->slope[(size_t)q * (size_t)path->stations + (size_t)i] =
                    dense_output_reading(&s->inside, &s->c->scene->quantity[q], path->value[i],
                                         &s->at);
}

status stations_alloc(stations *s, fault *f)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    TRY(dense_output_alloc(&s->c->eq, &s->inside, f));
    TRY(motion_state_alloc(s->c->model, &s->at, f));
    TRY(outcome_stations(&s->out->path, path->stations, f));
    s->out->at_station = calloc((size_t)path->stations + 1, sizeof *s->out->at_station);
    for (int i = 0; i < s->c->scene->quantities; i++)
        s->slopes |= is_slope(s, i);
    if (s->slopes)
        s->out->slope =
            calloc((size_t)s->c->scene->quantities * (size_t)path->stations, sizeof *s->out->slope);
    return s->out->at_station != NULL && (s->out->slope != NULL || !s->slopes)
               ? STATUS_OK
               : fault_memory(f, "states of a motion");
}

void stations_free(stations *s)
{
    dense_output_free(&s->inside);
    motion_state_free(&s->at);
}

static double next_of(const stations *s)
{
    const scene_path *path = scene_path_of(&s->c->scene->analysis[s->analysis]);
    const int next = s->out->path.reached;
    return next < path->stations ? path->value[next] : INFINITY;
}

static status keep(stations *s, const motion_state *at, const double balance[SCENE_BALANCES],
                   fault *f)
{
    const model *m = s->c->model;
    const model_size size = model_sizes(m);
    const size_t bytes = (size_t)(size.free + size.driven + 1) * sizeof(double);
    outcome_instant *to = &s->out->at_station[s->out->path.reached];
    to->rate = malloc(2 * bytes);
    if (to->rate == NULL)
        return fault_memory(f, "a state of a motion");
    to->acceleration = to->rate + bytes / sizeof(double);
    memcpy(to->rate, at->v, bytes - sizeof(double));
    memcpy(to->acceleration, at->a, bytes - sizeof(double));
    memcpy(to->balance, balance, sizeof to->balance);
    return outcome_keep(&s->out->path, m, at->state, 1, next_of(s), f);
}

static int reads_forces(const stations *s, double time)
{
    const scene *what = s->c->scene;
    for (int i = 0; i < what->quantities; i++) {
        const scene_quantity *q = &what->quantity[i];
        if (q->analysis == s->analysis &&
            (scene_reads_forces(q) || q->what.kind == SCENE_BALANCE) &&
            (q->reduction == SCENE_AT ? fabs(q->at - time) <= same_instant * fmax(1, fabs(time))
                                      : q->reduction == SCENE_CURVE))
            return 1;
    }
    return 0;
}

static status step_to(stations *s, const motion_state *from, double time, fault *f)
{
    double balance[SCENE_BALANCES];
    TRY(probe_step(s->c, s->scheme, from, time, &s->at, f));
    TRY(balance_of(&s->c->eq, s->masses, &s->at, balance, f));
    balance[SCENE_DRIFT] -= s->out->origin;
    return keep(s, &s->at, balance, f);
}

status stations_inside(stations *s, const motion_state *from, const motion_state *to, fault *f)
{
    const double end = to->time - same_instant * (to->time - from->time);
    double none[SCENE_BALANCES];
    int taken = 0;
    if (s->slopes)
        take_slopes(s, from, to);
    for (int i = 0; i < SCENE_BALANCES; i++)
        none[i] = NAN;
    while (next_of(s) < end) {
        if (reads_forces(s, next_of(s))) {
            TRY(step_to(s, from, next_of(s), f));
            continue;
        }
        if (!taken++)
            dense_output_set(&s->inside, s->scheme->degree, from, to);
        dense_output_at(&s->inside, next_of(s), &s->at);
        TRY(keep(s, &s->at, none, f));
    }
    return STATUS_OK;
}

status stations_here(stations *s, const motion_state *now, const double balance[SCENE_BALANCES],
                     fault *f)
{
    const double tolerance =
        same_instant * scene_motion_of(&s->c->scene->analysis[s->analysis])->step;
    while (next_of(s) <= now->time + tolerance)
        TRY(keep(s, now, balance, f));
    return STATUS_OK;
}
