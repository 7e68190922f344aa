#include "harness/study/follow_match.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

/* Frequencies whose shapes are not their own: relative distance. */
static const double alike = 1e-6;

static status allocate(int modes, int rows, follow_shapes *out, fault *f)
{
    *out = (follow_shapes){.modes = modes, .rows = rows};
    out->frequency = calloc((size_t)modes + 1, sizeof *out->frequency);
    out->match = calloc((size_t)modes + 1, sizeof *out->match);
    out->shape = calloc((size_t)modes * (size_t)rows + 1, sizeof *out->shape);
    return out->frequency != NULL && out->match != NULL && out->shape != NULL
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT, "out of memory for modes");
}

void follow_match_free(follow_shapes *s)
{
    free(s->frequency);
    free(s->match);
    free(s->shape);
    memset(s, 0, sizeof *s);
}

/* Scales x to x^T M x = 1; y[rows]: becomes M x. */
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

status follow_match_first(const state_matrices *s, int modes, follow_shapes *out, fault *f)
{
    double *work = malloc(((size_t)s->M.rows + 1) * sizeof *work);
    status outcome = allocate(modes, s->M.rows, out, f);
    if (outcome == STATUS_OK)
        outcome = work != NULL ? first(s, out, work)
                               : fault_set(f, STATUS_FAULT, "out of memory for modes");
    free(work);
    return outcome;
}

/* The group of equal frequencies that begins at mode j ends before this one. */
static int group_end(const state_matrices *s, int j)
{
    int end = j + 1;
    while (end < s->modes && s->frequency[end] - s->frequency[end - 1] <= alike * s->frequency[end])
        end++;
    return end;
}

/* Of a state: its modes of unit mass, and M times them. */
typedef struct match_workspace {
    double *mode, *product; /* [modes x rows] */
    double *share;          /* [modes] of the followed shape */
    int *taken;             /* [modes] followed modes in the group that begins here */
} match_workspace;

/* Mode i of before: the group that it is in most, and the mean frequency of it there. */
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
            "the structure has %d free coordinates here and had %d: modes of different "
            "coordinates are not compared; vary a parameter that leaves them alone",
            s->M.rows, before->rows);
    }
    status outcome = allocate(before->modes, before->rows, out, f);
    if (w.mode == NULL || w.taken == NULL)
        outcome = fault_set(f, STATUS_FAULT, "out of memory for modes");
    if (outcome == STATUS_OK) {
        w.product = w.mode + modes * n;
        w.share = w.product + modes * n;
        match_all(before, s, &w, out, least);
    }
    free(w.mode);
    free(w.taken);
    return outcome;
}
