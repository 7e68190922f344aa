#include "harness/analysis/analysis_impl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/model/model.h"
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
    s->damped = !s->massless && damping_acts(n->c->model);
    return s->damped ? sparse_alloc_like(&n->K, &s->C, f) : STATUS_OK;
}

void flutter_system_free(flutter_system *s)
{
    sparse_free_values(&s->M);
    sparse_free_values(&s->C);
}

status flutter_motions(const newton_run *n, flutter_system *s, int wanted, flutter_detail detail,
                       unsymmetric_result *r, fault *f)
{
    const unsymmetric_problem p = {.K = &n->K,
                                   .M = &s->M,
                                   .C = s->damped ? &s->C : NULL,
                                   .K_factor = n->factor,
                                   .wanted = wanted,
                                   .estimate =
                                       detail == FLUTTER_VALUE_ERRORS || detail == FLUTTER_ERRORS,
                                   .values_only = detail < FLUTTER_MODES,
                                   .rough = detail < FLUTTER_MODES};
    if (!s->massless)
        TRY(rotating_frame_inertia(&n->c->eq, n->state, 0, &s->M, NULL, f));
    if (s->damped)
        TRY(damping_matrix(&n->c->eq, n->state, 0, &s->C, f));
    const status found = unsymmetric_solve(&p, r, f);
    return found;
}

void flutter_take(unsymmetric_result *from, outcome_side *to)
{
    const double largest_error = 1e-2; /* if the error is larger, no digit is significant */
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
                     "frequency %d (with %d unknowns) is lost in round-off (error %.1e); use fewer "
                     "elements",
                     i + 1, from->n, to->error[i]);
        to->status = STATUS_NOT_CONVERGED;
    }
    from->frequency = from->mode = from->error = NULL;
}

const char *flutter_damping(const model *m, int damped)
{
    return !damping_acts(m) ? "" : damped ? "with damping" : "undamped";
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int flutter_squares(const flutter_system *s, const unsymmetric_result *r, int most, double square[])
{
    const int all = s->massless || s->damped, count = r->count < most ? r->count : most;
    for (int i = 0; i < count; i++)
        square[i] = r->frequency[i] > 0
                        ? r->frequency[i] * r->frequency[i] + all * r->growth[i] * r->growth[i]
                        : -r->growth[i] * r->growth[i];
    qsort(square, (size_t)count, sizeof *square, ascending);
    return count;
}

flutter_kind flutter_of(const flutter_system *s, const unsymmetric_result *r, int *mode)
{
    const double rounding = 1e-6; /* relative rounding error of a double eigenvalue that diverges */
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
    return s->damped ? "flutter, growth with damping" : "flutter, undamped";
}

enum { MOTIONS = FLUTTER_MOTIONS, PARTS = 6 };
static const double most_error = 1e-2; /* if the error is larger, the mode is unknown */
static const double real_part =
    1e-6; /* smaller imaginary parts, relative to the magnitude, are rounding errors */

status flutter_check_begin(flutter_check *j, analysis_context *c, fault *f)
{
    if (j->begun)
        return STATUS_OK;
    j->begun = 1;
    j->first.path = NAN;
    TRY(newton_alloc(c, 0, &j->n, f));
    return lowest_values_alloc(j->n.free, &j->lowest, f);
}

/* Returns the stability according to the modes. An odd number of negative eigenvalues of K always
 * means divergence. */
static step_stability by_motions(const flutter_check *j, const unsymmetric_result *r)
{
    int mode = 0;
    if (factor_count(j->n.factor).determinant < 0)
        return STEP_GROWS;
    for (int i = 0; i < r->count; i++)
        if (!(r->error[i] <= most_error))
            return STEP_OPEN;
    if (r->count == 0)
        return STEP_OPEN;
    return flutter_of(&j->of, r, &mode) == FLUTTER_NONE ? STEP_STABLE : STEP_GROWS;
}

static status ask_motions(flutter_check *j, flutter_detail detail, step_record *record, fault *f)
{
    unsymmetric_result r = {0};
    fault why = {""};
    const status outcome = flutter_motions(&j->n, &j->of, MOTIONS, detail, &r, &why);
    if (outcome == STATUS_OK) {
        record->judged = by_motions(j, &r);
        j->here.modes = flutter_squares(&j->of, &r, MOTIONS, j->here.square);
    }
    unsymmetric_free(&r);
    return outcome == STATUS_FAULT ? fault_set(f, outcome, "%s", why.text) : STATUS_OK;
}

/* Counts the eigenvalues that have passed zero. An even number decides only if the eigenvalues are
 * real, because a pair may have passed near zero. */
static status count_passed(flutter_check *j, step_record *record, fault *f)
{
    left_of_axis left;
    int pairs = 0;
    TRY(left_count(j->n.factor, j->n.free, j->n.weight, &left, f));
    for (int i = 0; i < left.nearest; i++)
        pairs += creal(left.mu[i]) < 0 && fabs(cimag(left.mu[i])) > real_part * cabs(left.mu[i]);
    record->by_eigenvalues = left.count >= 0 && (pairs == 0 || left.count % 2 != 0);
    record->passed = left.count;
    return STATUS_OK;
}

/* Determines the stability of the state in which K was factored. inside 1: the state is inside a
 * step; the errors of its modes are estimated only if a mode grows. */
static status flutter_check_factored(flutter_check *j, int inside, step_record *record, fault *f)
{
    record->negative_pivots = factor_count(j->n.factor).negative_pivots;
    if (record->negative_pivots >= 0)
        return STATUS_OK;
    if (j->of.M.value == NULL)
        TRY(flutter_system_alloc(&j->n, &j->of, f));
    if (j->of.massless)
        return record->by_eigenvalues ? STATUS_OK : count_passed(j, record, f);
    if (inside)
        TRY(ask_motions(j, FLUTTER_VALUES, record, f));
    return inside && record->judged == STEP_STABLE
               ? STATUS_OK
               : ask_motions(j, FLUTTER_VALUE_ERRORS, record, f);
}

static status flutter_check_here(flutter_check *j, step_record *record, fault *f)
{
    step_record at = {0};
    fault why = {""};
    const status factored = newton_direction(&j->n, kinematics_state_path(j->n.state), &at, &why);
    record->negative_pivots = -1;
    if (factored == STATUS_FAULT)
        return fault_set(f, factored, "%s", why.text);
    return factored == STATUS_OK ? flutter_check_factored(j, 0, record, f) : STATUS_OK;
}

status flutter_check_state(flutter_check *j, analysis_context *c, const model_state *state,
                           step_record *record, fault *f)
{
    const counters work = c->run->counters;
    const int singular = c->work->singular;
    TRY(flutter_check_begin(j, c, f));
    kinematics_state_copy(c->model, state, j->n.state);
    const status outcome = flutter_check_here(j, record, f);
    c->work->singular = singular;
    c->run->counters = work;
    return outcome;
}

void flutter_check_free(flutter_check *j)
{
    if (!j->begun)
        return;
    flutter_system_free(&j->of);
    newton_free(&j->n);
    lowest_values_free(&j->lowest);
}

static const double near_enough =
    1e-5; /* limit of the last correction for a state that is only examined */

/* Sets j->here to the state in which K was factored: `unstable` is the number of negative
 * eigenvalues, or 1 if a mode grows; -1: unknown. */
static status degree(flutter_check *j, int inside, step_record *record, fault *f)
{
    j->here.modes = 0;
    TRY(flutter_check_factored(j, inside, record, f));
    j->here.unstable = record->negative_pivots;
    j->here.by_modes = record->negative_pivots < 0;
    if (record->by_eigenvalues)
        j->here.unstable = record->passed;
    else if (record->judged != STEP_OPEN)
        j->here.unstable = record->judged != STEP_STABLE;
    return STATUS_OK;
}

/* Sets the values of j->here to the lowest eigenvalues of the symmetric tangent K. */
static void lowest_of(flutter_check *j, const sparse *K, matrix_factor *factor)
{
    j->here.modes = lowest_values_find(&j->lowest, K, factor, j->here.square);
}

/* Factors K in the state of j->n, for the loads at `path`, and sets j->here. */
static status look(flutter_check *j, int inside, double path, step_record *record, fault *f)
{
    step_record unused = {0};
    fault why = {""};
    const status factored = newton_direction(&j->n, path, &unused, &why);
    record->negative_pivots = j->here.unstable = -1;
    if (factored == STATUS_FAULT)
        return fault_set(f, factored, "%s", why.text);
    if (factored != STATUS_OK)
        return STATUS_OK;
    TRY(degree(j, inside, record, f));
    if (j->here.unstable >= 0 && !j->here.by_modes)
        lowest_of(j, &j->n.K, j->n.factor);
    return STATUS_OK;
}

/* Returns 1 if the stability in the examined state differs from that at both ends of the step. */
static int differs(const flutter_check *j)
{
    const int first = j->first.unstable, last = j->last.unstable, here = j->here.unstable;
    return here >= 0 &&
           (here < (first < last ? first : last) || here > (first > last ? first : last));
}

/* Advances to `path`. Sets *reached to 0 if Newton's method did not converge. */
static status go_to(newton_run *n, double path, int *reached, fault *f)
{
    step_record record = {0};
    fault why = {""};
    kinematics_state_copy(n->c->model, n->state, n->backup);
    const status outcome = newton_to(n, path, &record, &why);
    history_drop_step(n->c->result, &record);
    *reached = outcome == STATUS_OK;
    return outcome == STATUS_FAULT ? fault_set(f, outcome, "%s", why.text) : STATUS_OK;
}

/* Examines the states at the ends of PARTS equal parts of the step. */
static status look_at_parts(flutter_check *j, const model_state *from, const model_state *to,
                            double *found, fault *f)
{
    const double begin = kinematics_state_path(from), end = kinematics_state_path(to);
    const model_state *const ends[] = {from, to};
    int reached = 1;
    kinematics_state_copy(j->n.c->model, from, j->n.state);
    for (int i = 1; i < PARTS; i++) {
        const double path = begin + (end - begin) * i / PARTS;
        extrapolate_state(&j->n.c->eq, 2, ends, path, j->n.state);
        step_record unused = {0};
        TRY(go_to(&j->n, path, &reached, f));
        if (!reached)
            return STATUS_OK;
        TRY(degree(j, 1, &unused, f));
        if (!differs(j))
            continue;
        *found = path;
        return STATUS_OK;
    }
    return STATUS_OK;
}

/* Returns the value nearest to zero of the parabola through the values at the ends and in the
 * middle of the step, relative to the value nearest to zero of these three. */
static double least_part(double a, double b, double c)
{
    const double slope = (c - a) / 2, bend = (a + c) / 2 - b,
                 least = fmin(fabs(a), fmin(fabs(b), fabs(c)));
    if (!(least > 0) || (a > 0) != (b > 0) || (a > 0) != (c > 0))
        return 0;
    if (bend == 0 || fabs(slope) >= 2 * fabs(bend) || (bend > 0) != (a > 0))
        return 1;
    return (fabs(b) - slope * slope / (4 * fabs(bend))) / least;
}

/* Returns the relative difference of two adjacent values. */
static double gap(const flutter_state *s, int i)
{
    return (s->square[i + 1] - s->square[i]) / (fabs(s->square[i + 1]) + fabs(s->square[i]));
}

/* Returns 1 if the values at the ends and in the middle show that none of them passes zero within
 * the step and, if the modes decide, that no two of them meet. */
static int stays(const flutter_check *j)
{
    const flutter_state *a = &j->first, *b = &j->here, *c = &j->last;
    const double enough = 0.5;
    if (b->modes == 0 || a->modes != b->modes || c->modes != b->modes ||
        a->by_modes != b->by_modes || c->by_modes != b->by_modes)
        return 0;
    for (int i = 0; i < b->modes; i++)
        if (!(least_part(a->square[i], b->square[i], c->square[i]) > enough))
            return 0;
    for (int i = 0; b->by_modes && i + 1 < b->modes; i++)
        if (!(least_part(gap(a, i), gap(b, i), gap(c, i)) > enough))
            return 0;
    return 1;
}

/* Sets *uniform to 1 if the step is so uniform that its stability cannot change and change back:
 * loads, state and tangent in its middle differ little from those between its ends. */
static status look_at_middle(flutter_check *j, const model_state *from, const model_state *to,
                             int *uniform, fault *f)
{
    const double middle = (kinematics_state_path(from) + kinematics_state_path(to)) / 2,
                 small_correction = 0.1, rounding_error = 1e-9;
    double moved;
    step_record unused = {0};
    newton_correction correction;
    *uniform = 0;
    kinematics_state_copy(j->n.c->model, from, j->n.state);
    if ((j->of.M.value != NULL && j->of.damped) ||
        !extrapolate_between(&j->n.c->eq, from, to, j->n.state, &moved))
        return STATUS_OK;
    TRY(look(j, 1, middle, &unused, f));
    if (j->here.unstable < 0 || differs(j) || !stays(j))
        return STATUS_OK;
    newton_advance(&j->n, middle, &correction);
    *uniform = correction.size <= small_correction * moved + rounding_error;
    return STATUS_OK;
}

static status examine(flutter_check *j, const model_state *s, step_record *record,
                      flutter_state *out, fault *f)
{
    kinematics_state_copy(j->n.c->model, s, j->n.state);
    TRY(look(j, 0, kinematics_state_path(s), record, f));
    *out = j->here;
    out->path = kinematics_state_path(s);
    return STATUS_OK;
}

/* Sets j->first and j->last. The tangent of the last iteration serves at the end if its pivots
 * decide. */
static status look_at_ends(flutter_check *j, const newton_run *n, step_record *record, fault *f)
{
    step_record unused = {0};
    const int own = n->condensed == NULL && n->c->options->newton != NEWTON_DENSE;
    if (record->negative_pivots >= 0 && own) {
        j->here = (flutter_state){.path = kinematics_state_path(n->state),
                                  .unstable = record->negative_pivots};
        lowest_of(j, &n->K, n->factor);
        j->last = j->here;
    } else {
        TRY(examine(j, n->state, record, &j->last, f));
    }
    return j->first.path == kinematics_state_path(n->backup)
               ? STATUS_OK
               : examine(j, n->backup, &unused, &j->first, f);
}

static status look_within(flutter_check *j, const newton_run *n, step_record *record, double *found,
                          fault *f)
{
    int uniform;
    TRY(look_at_ends(j, n, record, f));
    if (j->first.unstable < 0 || j->last.unstable < 0)
        return STATUS_OK;
    TRY(look_at_middle(j, n->backup, n->state, &uniform, f));
    if (!uniform)
        TRY(look_at_parts(j, n->backup, n->state, found, f));
    if (!isfinite(*found))
        j->first = j->last;
    return STATUS_OK;
}

status within_step(flutter_check *j, const newton_run *n, step_record *record, double *found,
                   fault *f)
{
    analysis_context *c = n->c;
    const counters work = c->run->counters;
    const int singular = c->work->singular;
    *found = INFINITY;
    TRY(flutter_check_begin(j, c, f));
    j->n.newton_convergence.criterion = fmax(near_enough, c->options->criterion);
    const status outcome = look_within(j, n, record, found, f);
    c->work->singular = singular;
    c->run->counters = work;
    return outcome;
}

enum {
    FEWEST = 6,
    MOST = 48,
    SPARE = 3
}; /* smallest and largest number of examined eigenvalues, and number of them that must not be on
      the left */
/* Eigenvalues below this fraction of the largest one may have the wrong sign. */
static const double rounding = 1e-6;

typedef struct metric_inverse {
    matrix_factor *K;
    int n;
    const double *weight;
} metric_inverse;

/* Computes y = D^1/2 K^-1 D^1/2 x. */
static void apply(void *context, const double x[], double y[])
{
    const metric_inverse *of = context;
    for (int k = 0; k < of->n; k++)
        y[k] = sqrt(of->weight[k]) * x[k];
    factor_solve(of->K, y);
    for (int k = 0; k < of->n; k++)
        y[k] *= sqrt(of->weight[k]);
}

/* Returns the number of eigenvalues to the left of the imaginary axis. Sets *sure to 0 if there may
 * be others that were not examined. */
static int count_of(const arnoldi_result *r, int wanted, int determinant, int *sure)
{
    int left = 0;
    for (int i = 0; i < r->count; i++)
        left += creal(r->theta[i]) < 0;
    const double least = cabs(r->theta[0]), last = cabs(r->theta[r->count - 1]);
    const int parity = left % 2 == 0 ? 1 : -1;
    *sure = (left <= wanted - SPARE || r->count < wanted) &&
            (parity == determinant || last < rounding * least);
    return left;
}

static void take(const arnoldi_result *r, left_of_axis *out)
{
    out->nearest = r->count < LEFT_NEAREST ? r->count : LEFT_NEAREST;
    for (int i = 0; i < out->nearest; i++)
        out->mu[i] = 1 / r->theta[i];
}

status left_count(matrix_factor *K, int n, const double weight[], left_of_axis *out, fault *f)
{
    metric_inverse of = {K, n, weight};
    memset(out, 0, sizeof *out);
    for (int wanted = FEWEST;; wanted *= 2) {
        arnoldi_result r = {0};
        const arnoldi_problem p = {.n = n,
                                   .wanted = wanted < n ? wanted : n,
                                   .apply = apply,
                                   .context = &of,
                                   .values_only = 1};
        fault why = {""};
        int sure = 0;
        const status outcome = arnoldi_solve(&p, &r, &why);
        out->nearest = 0;
        if (outcome == STATUS_OK && r.count > 0) {
            out->count = count_of(&r, p.wanted, factor_count(K).determinant, &sure);
            take(&r, out);
        }
        arnoldi_free(&r);
        if (outcome == STATUS_FAULT)
            return fault_set(f, outcome, "%s", why.text);
        if (sure)
            return STATUS_OK;
        if (outcome != STATUS_OK || wanted >= n || wanted >= MOST) {
            out->count = -1;
            return STATUS_OK;
        }
    }
}
