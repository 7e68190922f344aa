#include "harness/analysis/flutter.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/model/model.h"
#include "harness/newton/newton.h"
#include "harness/time/time.h"

status flutter_system_alloc(const newton_run *n, flutter_system *s, fault *f)
{
    memset(s, 0, sizeof *s);
    TRY(sparse_alloc_like(&n->K, &s->M, f));
    TRY(rotating_frame_inertia(&n->c->eq, n->state, 0, &s->M, NULL, f));
    s->massless = 1;
    for (int k = 0; k < s->M.column[s->M.n]; k++)
        s->massless &= s->M.value[k] == 0;
    for (int j = 0; s->massless && j < s->M.n; j++)
        for (int k = s->M.column[j]; k < s->M.column[j + 1]; k++)
            if (s->M.row[k] == j)
                s->M.value[k] = n->weight[j];
    s->damped = !s->massless && damping_acts(n->c->scene);
    return s->damped ? sparse_alloc_like(&n->K, &s->C, f) : STATUS_OK;
}

void flutter_system_free(flutter_system *s)
{
    sparse_free_values(&s->M);
    sparse_free_values(&s->C);
}

status flutter_motions(const newton_run *n, flutter_system *s, int wanted, int estimate,
                       unsymmetric_result *r, fault *f)
{
    const unsymmetric_problem p = {.K = &n->K,
                                   .M = &s->M,
                                   .C = s->damped ? &s->C : NULL,
                                   .K_factor = n->factor,
                                   .wanted = wanted,
                                   .estimate = estimate};
    if (!s->massless)
        TRY(rotating_frame_inertia(&n->c->eq, n->state, 0, &s->M, NULL, f));
    if (s->damped)
        TRY(damping_matrix(&n->c->eq, n->state, &s->C, f));
    const status found = unsymmetric_solve(&p, r, f);
    n->c->run->counters.solutions += r->solutions;
    return found;
}

void flutter_take(unsymmetric_result *from, outcome_side *to)
{
    const double largest_error = 1e-2; /* beyond it no digit is worth telling */
    to->count = from->count;
    to->value = from->frequency;
    to->mode = from->mode;
    to->error = from->error;
    for (int i = 0; i < to->count; i++) {
        if (to->error[i] <= largest_error)
            continue;
        to->value[i] = NAN;
        if (to->status == STATUS_OK)
            snprintf(to->reason, sizeof to->reason,
                     "frequency %d of %d unknowns is lost in round-off (error %.1e): refine less",
                     i + 1, from->n, to->error[i]);
        to->status = STATUS_NOT_CONVERGED;
    }
    from->frequency = from->mode = from->error = NULL;
}

const char *flutter_damping(const scene *s, int damped)
{
    return !damping_acts(s) ? "" : damped ? "with the members' damping" : "undamped";
}

flutter_kind flutter_of(const flutter_system *s, const unsymmetric_result *r, int *mode)
{
    const double rounding = 1e-6; /* of a double value that diverges */
    flutter_kind kind = FLUTTER_NONE;
    double largest = 0;
    for (int i = 0; i < r->count; i++) {
        const double least = s->massless ? rounding * r->growth[i] : 0;
        const flutter_kind one = r->frequency[i] > least ? FLUTTER_OSCILLATES : FLUTTER_DIVERGES;
        if (!(r->growth[i] > largest) || (s->massless && one == FLUTTER_OSCILLATES))
            continue;
        largest = r->growth[i];
        kind = one;
        *mode = i;
    }
    return kind;
}

const char *flutter_name(const flutter_system *s, flutter_kind kind)
{
    if (s->massless)
        return kind == FLUTTER_NONE ? "no divergence" : "divergence";
    if (kind == FLUTTER_DIVERGES)
        return "divergence";
    return s->damped ? "flutter, growth with the members' damping" : "flutter, undamped";
}
