#include "harness/study/study_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"
#include "elements/math/scalar.h"

/* Frequencies count as equal below this relative difference; their shapes are then not unique. */
static const double alike = 1e-6;

static status allocate(int modes, int rows, follow_shapes *out, fault *f)
{
    *out = (follow_shapes){.modes = modes, .rows = rows};
    out->frequency = calloc((size_t)modes + 1, sizeof *out->frequency);
    out->match = calloc((size_t)modes + 1, sizeof *out->match);
    out->shape = calloc((size_t)modes * (size_t)rows + 1, sizeof *out->shape);
    return out->frequency != NULL && out->match != NULL && out->shape != NULL
               ? STATUS_OK
               : fault_memory(f, "modes");
}

void follow_match_free(follow_shapes *s)
{
    free(s->frequency);
    free(s->match);
    free(s->shape);
    memset(s, 0, sizeof *s);
}

/* Scales x so that x^T M x = 1, and sets y[rows] to M x. */
static void normalise(const triplets *M, double x[], double y[])
{
    triplets_mul(M, x, y);
    const double size = sqrt(fabs(dense_dot(M->rows, x, y)));
    for (int i = 0; i < M->rows && size > 0; i++) {
        x[i] /= size;
        y[i] /= size;
    }
}

static status first(const state_matrices *s, follow_shapes *out, double work[])
{
    for (int i = 0; i < out->modes; i++) {
        double *x = out->shape + (size_t)i * (size_t)out->rows;
        memcpy(x, s->mode + (size_t)i * (size_t)out->rows, (size_t)out->rows * sizeof *x);
        normalise(&s->M, x, work);
        out->frequency[i] = s->frequency[i];
        out->match[i] = 1;
    }
    return STATUS_OK;
}

static status follow_match_first(const state_matrices *s, int modes, follow_shapes *out, fault *f)
{
    double *work = malloc(((size_t)s->M.rows + 1) * sizeof *work);
    status outcome = allocate(modes, s->M.rows, out, f);
    if (outcome == STATUS_OK)
        outcome = work != NULL ? first(s, out, work) : fault_memory(f, "modes");
    free(work);
    return outcome;
}

static int group_end(const state_matrices *s, int j)
{
    int end = j + 1;
    while (end < s->modes && s->frequency[end] - s->frequency[end - 1] <= alike * s->frequency[end])
        end++;
    return end;
}

typedef struct match_workspace {
    double *mode, *product; /* [modes x rows] */
    double *share;          /* [modes] contribution of each mode to the followed shape */
    int *taken;
} match_workspace;

/* Among the groups of equal frequencies, finds the group whose modes span the largest part of shape
 * i of `before`. Stores this part as the new shape, with the match and the mean frequency. */
static void match_one(const follow_shapes *before, int i, const state_matrices *s,
                      match_workspace *w, follow_shapes *out)
{
    const size_t n = (size_t)out->rows;
    const double *old = before->shape + (size_t)i * n;
    double *x = out->shape + (size_t)i * n, best = -1, old_mass = 0;
    int from = 0, to = 0;
    triplets_mul(&s->M, old, x);
    old_mass = dense_dot(out->rows, old, x);
    for (int j = 0; j < s->modes; j++)
        w->share[j] = dense_dot(out->rows, old, w->product + (size_t)j * n);
    for (int j = 0; j < s->modes; j = group_end(s, j)) {
        const double sum = dense_dot(group_end(s, j) - j, w->share + j, w->share + j);
        if (sum > best) {
            best = sum;
            from = j;
            to = group_end(s, j);
        }
    }
    out->match[i] = ++w->taken[from] > to - from ? 0 : best / old_mass;
    memset(x, 0, n * sizeof *x);
    for (int j = from; j < to; j++) {
        out->frequency[i] += w->share[j] * w->share[j] / best * s->frequency[j];
        for (size_t k = 0; k < n; k++)
            x[k] += w->share[j] * w->mode[(size_t)j * n + k];
    }
}

static void match_all(const follow_shapes *before, const state_matrices *s, match_workspace *w,
                      follow_shapes *out, double *least)
{
    const size_t n = (size_t)out->rows;
    memcpy(w->mode, s->mode, (size_t)s->modes * n * sizeof *w->mode);
    for (int j = 0; j < s->modes; j++)
        normalise(&s->M, w->mode + (size_t)j * n, w->product + (size_t)j * n);
    *least = 1;
    for (int i = 0; i < out->modes; i++) {
        match_one(before, i, s, w, out);
        *least = fmin(*least, out->match[i]);
    }
    for (int i = 0; i < out->modes; i++)
        normalise(&s->M, out->shape + (size_t)i * n, w->product);
}

status follow_match_next(const follow_shapes *before, const state_matrices *s, follow_shapes *out,
                         double *least, fault *f)
{
    const size_t n = (size_t)s->M.rows, modes = (size_t)s->modes;
    match_workspace w = {.mode = malloc((2 * modes * n + modes + 1) * sizeof(double)),
                         .taken = calloc(modes + 1, sizeof(int))};
    memset(out, 0, sizeof *out);
    if (s->M.rows != before->rows) {
        free(w.mode);
        free(w.taken);
        return fault_set(
            f, STATUS_REFUSED,
            "the structure has %d free coordinates here but had %d before, so the modes cannot be "
            "compared; vary a parameter that does not change supports or the number of members",
            s->M.rows, before->rows);
    }
    status outcome = allocate(before->modes, before->rows, out, f);
    if (w.mode == NULL || w.taken == NULL)
        outcome = fault_memory(f, "modes");
    if (outcome == STATUS_OK) {
        w.product = w.mode + modes * n;
        w.share = w.product + modes * n;
        match_all(before, s, &w, out, least);
    }
    free(w.mode);
    free(w.taken);
    return outcome;
}

static int count_wanted(const scene *s, int *analysis)
{
    int count = 0;
    for (*analysis = 0; *analysis < s->analyses; ++*analysis)
        if (s->analysis[*analysis].kind == SCENE_MODAL)
            break;
    for (int i = 0; i < s->quantities; i++)
        count += scene_requests(&s->quantity[i], *analysis, SCENE_FREQUENCY);
    return *analysis < s->analyses ? count : 0;
}

static status solve_at(follow_state *w, double value, cell_result *cell,
                       const state_matrices **state, fault *f)
{
    cell_request request = w->of->cell;
    scene own;
    request.parameter[w->of->parameter] = value;
    request.solve.systems = 1;
    memset(cell, 0, sizeof *cell);
    const status built = cell_scene(request.type, request.parameter, NULL, &own, f);
    status outcome = built;
    if (built == STATUS_OK) {
        if (w->out->modes == 0)
            w->out->modes = count_wanted(&own, &w->analysis);
        request.scene = &own;
        outcome = cell_run(&request, cell, f);
    }
    scene_free(&own);
    TRY(outcome);
    for (int i = 0; i < cell->solve.systems.states; i++)
        if (cell->solve.systems.state[i].analysis == w->analysis)
            *state = &cell->solve.systems.state[i];
    if (*state == NULL || w->out->modes == 0)
        return fault_set(f, STATUS_REFUSED,
                         "there are no modes to follow; add an analysis with 'modal' to the scene, "
                         "and frequencies as quantities");
    return STATUS_OK;
}

status follow_solve(follow_state *w, double value, const follow_shapes *before, follow_shapes *out,
                    double *least, fault *f)
{
    cell_result cell;
    const state_matrices *state = NULL;
    memset(out, 0, sizeof *out);
    *least = 1;
    status outcome = solve_at(w, value, &cell, &state, f);
    if (outcome == STATUS_OK && before == NULL) {
        w->out->modes = w->out->modes < state->modes ? w->out->modes : state->modes;
        outcome = follow_match_first(state, w->out->modes, out, f);
    } else if (outcome == STATUS_OK) {
        outcome = follow_match_next(before, state, out, least, f);
    }
    cell_result_free(&cell);
    return outcome;
}

enum { MOST_REFINEMENTS = 30 };
static const double equal = 1e-9; /* relative difference of equal frequencies */
static const double exact =
    1e-12; /* accuracy of the parameter value at a crossing, relative to the step */
static const double close_enough =
    0.1; /* largest reported gap of a veering, relative to the mean frequency */

/* Computes f_i - f_j at a parameter value where modes are matched with sample k. *mean: mean of
 * both frequencies [Hz]. If the worst match is below *least, *least is set to it. */
static status difference_at(follow_state *w, int k, double value, const int mode[2],
                            double *difference, double *mean, double *least, fault *f)
{
    follow_shapes s;
    double match = 1;
    const status outcome = follow_solve(w, value, &w->shapes[k], &s, &match, f);
    *least = fmin(*least, match);
    if (outcome == STATUS_OK) {
        *difference = (s.frequency[mode[0]] - s.frequency[mode[1]]) / (2 * PI);
        *mean = (s.frequency[mode[0]] + s.frequency[mode[1]]) / (4 * PI);
    }
    follow_match_free(&s);
    return outcome;
}

static double difference_of(const follow_sample *s, const int mode[2])
{
    return s->frequency[mode[0]] - s->frequency[mode[1]];
}

static double gap_of(const follow_sample *s, const int mode[2])
{
    return 2 * fabs(difference_of(s, mode)) / (s->frequency[mode[0]] + s->frequency[mode[1]]);
}

/* Finds the crossing between samples a and b, where the frequency differences have opposite signs,
 * by the Illinois variant of regula falsi. */
static status find_crossing(follow_state *w, int a, int b, follow_event *e, double *least, fault *f)
{
    const follow_sample *s = w->out->sample;
    double x[2] = {s[a].value, s[b].value},
           d[2] = {difference_of(&s[a], e->mode), difference_of(&s[b], e->mode)}, change;
    const double width = fabs(x[1] - x[0]);
    int kept = -1;
    e->value = x[0];
    for (int i = 0; i < MOST_REFINEMENTS; i++) {
        const double next = (x[0] * d[1] - x[1] * d[0]) / (d[1] - d[0]);
        double here;
        change = fabs(next - e->value);
        e->value = next;
        TRY(difference_at(w, a, next, e->mode, &here, &e->frequency, least, f));
        if (*least < follow_sure || fabs(here) <= equal * e->frequency || change <= exact * width)
            return STATUS_OK;
        const int side = (here > 0) == (d[1] > 0);
        x[side] = next;
        d[side] = here;
        d[!side] /= kept == !side ? 2 : 1;
        kept = !side;
    }
    return STATUS_OK;
}

static status add_event(follow_curves *c, const follow_event *e, fault *f)
{
    follow_event *more = realloc(c->event, ((size_t)c->events + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "curves of modes");
    c->event = more;
    more[c->events++] = *e;
    return STATUS_OK;
}

status follow_events_step(follow_state *w, double *least, fault *f)
{
    const int last = w->out->samples - 1;
    const follow_sample *s = w->out->sample;
    for (int i = 0; i < w->out->modes; i++)
        for (int j = i + 1; j < w->out->modes; j++) {
            follow_event e = {.crossing = 1, .mode = {i, j}};
            if (gap_of(&s[last - 1], e.mode) <= equal || gap_of(&s[last], e.mode) <= equal ||
                difference_of(&s[last - 1], e.mode) * difference_of(&s[last], e.mode) > 0)
                continue;
            TRY(find_crossing(w, last - 1, last, &e, least, f));
            TRY(add_event(w->out, &e, f));
        }
    return STATUS_OK;
}

static status find_veerings(follow_state *w, const int mode[2], fault *f)
{
    const follow_sample *s = w->out->sample;
    for (int k = 1; k + 1 < w->out->samples; k++) {
        const double gap = gap_of(&s[k], mode), d = difference_of(&s[k], mode);
        if (!(gap < close_enough && gap > equal && gap < gap_of(&s[k - 1], mode) &&
              gap <= gap_of(&s[k + 1], mode) && d * difference_of(&s[k - 1], mode) > 0 &&
              d * difference_of(&s[k + 1], mode) > 0))
            continue;
        const follow_event e = {
            0, {mode[0], mode[1]}, s[k].value, s[k].frequency[mode[0]] - d / 2, gap};
        TRY(add_event(w->out, &e, f));
    }
    return STATUS_OK;
}

static status find_crossings(follow_state *w, const int mode[2], fault *f)
{
    const follow_sample *s = w->out->sample;
    for (int k = 0, last = -1; k < w->out->samples; k++) {
        if (gap_of(&s[k], mode) <= equal)
            continue;
        if (last >= 0 && last < k - 1 &&
            difference_of(&s[last], mode) * difference_of(&s[k], mode) < 0) {
            follow_event e = {.crossing = 1, .mode = {mode[0], mode[1]}};
            double least = 1;
            TRY(find_crossing(w, last, k, &e, &least, f));
            TRY(add_event(w->out, &e, f));
        }
        last = k;
    }
    return STATUS_OK;
}

static int by_value(const void *a, const void *b)
{
    const double x = ((const follow_event *)a)->value, y = ((const follow_event *)b)->value;
    return (x > y) - (x < y);
}

status follow_events_rest(follow_state *w, fault *f)
{
    for (int i = 0; i < w->out->modes; i++)
        for (int j = i + 1; j < w->out->modes; j++) {
            TRY(find_crossings(w, (const int[2]){i, j}, f));
            TRY(find_veerings(w, (const int[2]){i, j}, f));
        }
    if (w->out->events > 0)
        qsort(w->out->event, (size_t)w->out->events, sizeof *w->out->event, by_value);
    return STATUS_OK;
}
