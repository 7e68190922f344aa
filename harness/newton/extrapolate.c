#include "harness/newton/newton_impl.h"

#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/rotation.h"

/* Computes error[k] [m] for k = 1 ... most: the largest error of displacements and strains when
 * at[most] is extrapolated from the k previous states. k = 1: the previous state, unchanged.
 * INFINITY: the extrapolation is not possible. */
static void extrapolate_errors(const equations *, int most, const model_state *const at[],
                               double error[]);

enum { MANY_ELEMENTS = 1000, OF_MANY = 8 };
/* The second step is extrapolated linearly if the first step took at most this number of
 * iterations. */
enum { EASY_ITERATIONS = 4 };
/* Largest error of an extrapolation, relative to the error without extrapolation, for which an
 * extrapolation saves iterations. */
static const double worthwhile = 0.3;

static const model_state *const *last(const predictor *t, int count, int k)
{
    return (const model_state *const *)t->at + count - k;
}

status predictor_alloc(const model *m, predictor *t, fault *f)
{
    const int many = model_sizes(m).elements >= MANY_ELEMENTS;
    *t = (predictor){.most = many ? OF_MANY : MODEL_EXTRAPOLATED};
    t->count = 1; /* the undeformed state */
    return kinematics_state_alloc(m, &t->at[0], f);
}

void predictor_free(predictor *t)
{
    for (int i = 0; i <= MODEL_EXTRAPOLATED; i++)
        kinematics_state_free(t->at[i]);
}

void predictor_reset(predictor *t)
{
    t->count = 0;
}

status predictor_add(const equations *eq, const model_state *s, int iterations, predictor *t,
                     fault *f)
{
    const model *m = eq->m;
    t->iterations = iterations;
    if (t->count == t->most + 1) {
        model_state *oldest = t->at[0];
        for (int i = 1; i <= t->most; i++)
            t->at[i - 1] = t->at[i];
        t->at[--t->count] = oldest;
    }
    if (t->at[t->count] == NULL)
        TRY(kinematics_state_alloc(m, &t->at[t->count], f));
    kinematics_state_copy(m, s, t->at[t->count]);
    for (int k = 1; k <= MODEL_EXTRAPOLATED; k++)
        t->error[k] = INFINITY;
    extrapolate_errors(eq, t->count, last(t, t->count, t->count), t->error);
    t->count++;
    return STATUS_OK;
}

/* Returns the number of states from which to extrapolate: that with the smallest error for the
 * last state, or one more if this number included all states. 0: an extrapolation saves no
 * iterations. */
static int states_of_least_error(const predictor *t)
{
    int best = 2;
    for (int k = 3; k < t->count && k <= t->most; k++)
        if (t->error[k] < t->error[best])
            best = k;
    if (isinf(t->error[best]))
        return t->iterations <= EASY_ITERATIONS ? 2 : 0;
    if (!(t->error[best] < worthwhile * t->error[1]))
        return 0;
    return best + 1 == t->count && best < t->most ? best + 1 : best;
}

void predictor_guess(const equations *eq, const predictor *t, double path, model_state *s)
{
    for (int k = t->count >= 2 ? states_of_least_error(t) : 0; k >= 2; k--)
        if (extrapolate_state(eq, k, last(t, t->count, k), path, s))
            return;
}

/* far: largest step for which the state is extrapolated, relative to the last step. bent: largest
 * error of extrapolated prescribed values, relative to the largest of their steps. */
static const double far = 1.5 * (1 + 1e-9), bent = 0.25;

static void lagrange(int count, const model_state *const at[], double path, double weight[])
{
    for (int i = 0; i < count; i++) {
        weight[i] = 1;
        for (int k = 0; k < count; k++)
            if (k != i)
                weight[i] *= (path - at[k]->path) / (at[i]->path - at[k]->path);
    }
}

static int continues(int count, const double weight[], const double value[])
{
    const double rounding = 1e-12 * (fabs(value[count]) + fabs(value[count - 1]) + fabs(value[0]));
    double step = 0;
    for (int i = 0; i < count; i++)
        step = fmax(step, fabs(value[i + 1] - value[i]));
    return fabs(dense_dot(count, weight, value) - value[count]) <= bent * step + rounding;
}

/* Extrapolations from the last k states of at[most], k = 2 ... most, for the state at `path`. */
typedef struct guesses {
    /* good[k]: 1 if the extrapolation from k states is possible */
    int most, good[MODEL_EXTRAPOLATED + 1];
    double weight[MODEL_EXTRAPOLATED + 1][MODEL_EXTRAPOLATED];
} guesses;

static void keep_continuing(const double value[], guesses *g)
{
    for (int k = 2; k <= g->most; k++)
        g->good[k] = g->good[k] && continues(k, g->weight[k], value + g->most - k);
}

/* next: the state at `path`; NULL: not known yet. */
static void keep_smooth(const equations *eq, const model_state *const at[], const model_state *next,
                        double path, guesses *g)
{
    const model *m = eq->m;
    double value[MODEL_EXTRAPOLATED + 1];
    for (int d = 0; d < model_scene(m)->drivers; d++) {
        const scene_driver *driver = &model_scene(m)->driver[d];
        if (driver->value == NULL)
            continue;
        for (int i = 0; i < g->most; i++)
            value[i] = at[i]->driver[d];
        value[g->most] = next != NULL ? next->driver[d] : loads_driver_value(eq, driver, path);
        keep_continuing(value, g);
    }
    for (int l = 0; l < model_scene(m)->loads; l++) {
        for (int i = 0; i <= g->most; i++)
            value[i] =
                applied_factor(eq, &model_scene(m)->load[l], i < g->most ? at[i]->path : path);
        keep_continuing(value, g);
    }
}

static void prescribe(const model *m, const mesh_vertex *v, const model_state *last,
                      const model_state *out, double turn[3])
{
    for (int c = 0; c < 3; c++) {
        const int coordinate = v->coordinate[3 + c];
        if (coordinate < model_unknowns(m) || v->vector_driver[0] != NONE)
            continue;
        turn[c] = 0;
        for (int d = 0; d < model_scene(m)->drivers; d++)
            if (model_driver_coordinate(m, d) == coordinate)
                turn[c] = out->driver[d] - last->driver[d];
    }
}

/* Extrapolates a rotation, and with `moves` also a displacement along arcs, like advance_state. The
 * rotation vectors and arcs of all states are relative to the last state. */
static void extrapolate_motion(const model *m, int vertex, int moves, int count,
                               const double weight[], const model_state *const at[],
                               model_state *out)
{
    const model_state *last = at[count - 1];
    double turn[3] = {0}, direction[3] = {0}, step[4], arc[3];
    for (int i = 0; i + 1 < count; i++) {
        double back[3], moved[3], along[3] = {0};
        rotation_between(&last->q[4 * vertex], &at[i]->q[4 * vertex], back);
        for (int c = 0; c < 3; c++)
            moved[c] = at[i]->u[3 * vertex + c] - last->u[3 * vertex + c];
        if (moves)
            arc_to(back, moved, along);
        for (int c = 0; c < 3; c++) {
            turn[c] += weight[i] * back[c];
            direction[c] += weight[i] * along[c];
        }
    }
    prescribe(m, model_vertex(m, vertex), last, out, turn);
    arc_at(turn, direction, 1, arc, step);
    for (int c = 0; moves && c < 3; c++)
        out->u[3 * vertex + c] = last->u[3 * vertex + c] + arc[c];
    rotation_compose(step, &last->q[4 * vertex], &out->q[4 * vertex]);
    rotation_normalise(&out->q[4 * vertex]);
}

static int turns_by_itself(const model *m, int vertex)
{
    const mesh_release *r = release_of(m, vertex);
    return r != NULL
               ? r->turns == 3
               : model_vertex(m, vertex)->body == vertex && model_vertex(m, vertex)->angles == 0;
}

static void weigh(const equations *eq, int least, int most, const model_state *const at[],
                  const model_state *next, double path, guesses *g)
{
    g->most = most;
    for (int k = 2; k <= most; k++) {
        const double step = path - at[most - 1]->path;
        g->good[k] = k >= least && step <= far * (at[most - 1]->path - at[most - 2]->path);
        if (g->good[k])
            lagrange(k, at + most - k, path, g->weight[k]);
    }
    keep_smooth(eq, at, next, path, g);
}

enum { PART = 8 };

/* Adds sum_i weight[i] x_i to sum[size], where x_i = at[i]->block + from. */
static inline __attribute__((always_inline)) void add_weighted(int count, const double weight[],
                                                               const model_state *const at[],
                                                               ptrdiff_t from, size_t size,
                                                               double sum[])
{
    for (int i = 0; i < count; i++) {
        const double *x = at[i]->block + from;
        for (size_t k = 0; k < size; k++)
            sum[k] += weight[i] * x[k];
    }
}

/* Sets the numbers `from` to `end` - 1 of the block of `out` to the weighted sum. */
static void weighted_sum(int count, const double weight[], const model_state *const at[],
                         size_t from, size_t end, model_state *out)
{
    for (; from + PART <= end; from += PART) {
        double sum[PART] = {0};
        add_weighted(count, weight, at, (ptrdiff_t)from, PART, sum);
        memcpy(out->block + from, sum, sizeof sum);
    }
    memset(out->block + from, 0, (end - from) * sizeof *out->block);
    add_weighted(count, weight, at, (ptrdiff_t)from, end - from, out->block + from);
}

/* Returns the maximum of `largest` and |sum_i weight[i] x_i - x_count| over `size` numbers. */
static inline __attribute__((always_inline)) double largest_of(int count, const double weight[],
                                                               const model_state *const at[],
                                                               ptrdiff_t from, size_t size,
                                                               double largest)
{
    double sum[PART];
    for (size_t k = 0; k < size; k++)
        sum[k] = -at[count]->block[from + (ptrdiff_t)k];
    add_weighted(count, weight, at, from, size, sum);
    for (size_t k = 0; k < size; k++)
        largest = fabs(sum[k]) > largest ? fabs(sum[k]) : largest;
    return largest;
}

static double largest_error(int count, const double weight[], const model_state *const at[],
                            const double *first, size_t size)
{
    ptrdiff_t from = first - at[0]->block;
    double largest = 0;
    for (; size >= PART; size -= PART, from += PART)
        largest = largest_of(count, weight, at, from, PART, largest);
    return size > 0 ? largest_of(count, weight, at, from, size, largest) : largest;
}

static void extrapolate_errors(const equations *eq, int most, const model_state *const at[],
                               double error[])
{
    const model *m = eq->m;
    guesses g;
    weigh(eq, 2, most, at, at[most], at[most]->path, &g);
    g.good[1] = 1;
    g.weight[1][0] = 1;
    for (int k = 1; k <= most; k++) {
        const model_state *const *last = at + most - k;
        error[k] = INFINITY;
        if (g.good[k])
            error[k] =
                fmax(largest_error(k, g.weight[k], last, last[0]->u, 3 * (size_t)model_vertices(m)),
                     largest_error(k, g.weight[k], last, last[0]->e,
                                   (size_t)model_elements(m) * (size_t)model_strains(m)));
    }
}

int extrapolate_state(const equations *eq, int count, const model_state *const at[], double path,
                      model_state *out)
{
    const model *m = eq->m;
    guesses g;
    if (count < 2)
        return 0;
    weigh(eq, count, count, at, NULL, path, &g);
    if (!g.good[count])
        return 0;
    const double *weight = g.weight[count];
    const int on_arcs = advance_on_arcs(eq);
    const size_t before = (size_t)(out->history - out->block),
                 after = before + (size_t)model_elements(m) * (size_t)model_history(m);
    weighted_sum(count, weight, at, 0, before, out);
    weighted_sum(count, weight, at, after, out->size, out);
    for (int v = 0; v < model_vertices(m); v++)
        if (turns_by_itself(m, v))
            extrapolate_motion(m, v, on_arcs && advance_is_free(m, v), count, weight, at, out);
    memcpy(out->turn, at[count - 1]->turn, 3 * (size_t)model_turns(m) * sizeof *out->turn);
    kinematics_follow(m, out);
    return 1;
}

int extrapolate_between(const equations *eq, const model_state *from, const model_state *to,
                        model_state *middle, double *moved)
{
    enum { PARTS = 24 };
    const model *m = eq->m;
    const model_state *const ends[] = {from, to};
    const double step = to->path - from->path;
    const int straight =
        !eq->loading.in_time && along_path_is_straight(model_scene(m), from->path, to->path);
    for (int i = 1; i < PARTS && !straight; i++) {
        guesses g;
        weigh(eq, 2, 2, ends, NULL, from->path + step * i / PARTS, &g);
        if (!g.good[2])
            return 0;
    }
    *moved = 0;
    for (int v = 0; v < model_vertices(m); v++) {
        double turn[3];
        rotation_between(&from->q[4 * v], &to->q[4 * v], turn);
        for (int c = 0; c < 3; c++)
            *moved = fmax(*moved, fmax(fabs(turn[c]), fabs(to->u[3 * v + c] - from->u[3 * v + c]) /
                                                          model_length(m)));
    }
    return extrapolate_state(eq, 2, ends, from->path + step / 2, middle);
}
