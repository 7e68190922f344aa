/* Natural frequencies about the undeformed state, including the stresses of a linear analysis if
 * this analysis follows one: M x = (1/omega^2) K x. In this form, the mass matrix may be singular
 * for rotations. */
#include "harness/analysis/analysis_impl.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

int modal_wanted(const analysis_context *c, int analysis)
{
    /* number of additional modes, because axial modes and modes of other families may lie between
     * the requested modes */
    const int others = 6;
    int wanted = imperfection_modes(c->scene, analysis);
    for (int i = 0; i < c->scene->quantities; i++) {
        const scene_quantity *q = &c->scene->quantity[i];
        if ((scene_requests(q, analysis, SCENE_FREQUENCY) ||
             scene_requests(q, analysis, SCENE_DAMPING_RATIO)) &&
            wanted < scene_mode_of(q)->order + 1)
            wanted = scene_mode_of(q)->order + 1;
    }
    return wanted + others;
}

/* The quadratic form of K, which contains the stiffness of the structure, the stiffness due to the
 * prestress, and the shift. */
typedef struct modal_forms {
    quadratic_forms of;
    int prestressed;
    /* G: geometric stiffness of the prestress; it has no values if there is no prestress */
    sparse M, G;
    double shift;   /* [1/s^2] shift that K of the system and its forms contain */
    double *work;   /* [free] */
    double *square; /* [modes] squares of circular frequencies, without the shift [1/s^2] */
} modal_forms;

static double form_without_shift(modal_forms *f, const double mode[])
{
    double sum = quadratic_forms_stiffness(&f->of, mode);
    if (f->prestressed)
        sum += quadratic_forms_geometric(&f->of, mode);
    return sum;
}

static double mass_form(modal_forms *f, const double x[], const double y[])
{
    sparse_mul(&f->M, y, f->work);
    return dense_dot(f->of.free, x, f->work);
}

static double stiffness_form(void *context, const double mode[])
{
    modal_forms *f = context;
    double sum = form_without_shift(f, mode);
    if (f->shift > 0)
        sum += f->shift * mass_form(f, mode, mode);
    return sum;
}

static double stiffness_rounding(void *context, const double mode[])
{
    modal_forms *f = context;
    return quadratic_forms_stiffness_rounding(&f->of, mode);
}

static void add_product(const modal_forms *f, const sparse *A, double times, const double x[],
                        double y[])
{
    sparse_mul(A, x, f->work);
    for (int i = 0; i < f->of.free; i++)
        y[i] += times * f->work[i];
}

static void stiffness_product(void *context, const double mode[], double y[])
{
    modal_forms *f = context;
    quadratic_forms_product(&f->of, mode, y);
    if (f->prestressed)
        add_product(f, &f->G, 1, mode, y);
    if (f->shift > 0)
        add_product(f, &f->M, f->shift, mode, y);
}

/* Returns the square of the circular frequency, with the mass of the motions inside the elements.
 */
static double eigenvalue(modal_forms *about, double mu, double square, const double mode[])
{
    if (about->prestressed || square == 0)
        return square;
    memcpy(about->of.x, mode, (size_t)about->of.free * sizeof *mode);
    const double k = square * mu, b = rotating_frame_inner(about->of.eq->m, about->of.x);
    return 2 * k / (mu + sqrt(mu * mu + 4 * b * k));
}

/* Returns x^T B y, where B is the mass of the motions inside the elements. */
static double inner_product(modal_forms *about, const double x[], const double y[])
{
    const int n = about->of.free;
    double part[2];
    for (int minus = 0; minus < 2; minus++) {
        for (int i = 0; i < n; i++)
            about->of.x[i] = x[i] + (minus ? -y[i] : y[i]);
        part[minus] = rotating_frame_inner(about->of.eq->m, about->of.x);
    }
    return (part[0] - part[1]) / 4;
}

/* Replaces the modes [count x n] by their combinations with the columns of C [count x count]. row:
 * [count] work space. */
static void combine(size_t n, size_t count, const double C[], double mode[], double row[])
{
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < count; k++)
            row[k] = mode[k * n + i];
        for (size_t j = 0; j < count; j++)
            mode[j * n + i] = dense_dot((int)count, row, C + j * count);
    }
}

/* Replaces the modes [count x n], which the shift makes nearly equal and which may be any
 * combinations of the true modes, by those that diagonalise K without the shift. Sets square[count]
 * to their eigenvalues. */
static status remove_shift_once(modal_forms *about, int count, double mode[], double square[],
                                fault *f)
{
    const size_t n = (size_t)about->of.free, m = (size_t)count;
    double *K = calloc(2 * m * m + m + n, sizeof *K), *M = K + m * m, *row = M + m * m,
           *both = row + m;
    if (K == NULL)
        return fault_memory(f, "%zu modes", m);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i <= j; i++) {
            const double *x = mode + i * n, *y = mode + j * n;
            double part[2];
            for (int minus = 0; minus < 2 && i != j; minus++) {
                for (size_t k = 0; k < n; k++)
                    both[k] = x[k] + (minus ? -y[k] : y[k]);
                part[minus] = form_without_shift(about, both);
            }
            K[j * m + i] = i == j ? form_without_shift(about, x) : (part[0] - part[1]) / 4;
            M[j * m + i] = mass_form(about, x, y);
        }
    const int info =
        LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'U', count, K, count, M, count, square);
    if (info == 0)
        combine(n, m, K, mode, row);
    free(K);
    return info == 0 ? STATUS_OK
                     : fault_set(f, STATUS_NOT_CONVERGED,
                                 "%d modes near zero were not separated (LAPACK returned %d); use "
                                 "another number of elements",
                                 count, info);
}

static void lose(eigen_side *side, int i)
{
    side->mu[i] = NAN;
    side->status = STATUS_NOT_CONVERGED;
    snprintf(
        side->reason, sizeof side->reason,
        "mode %d is lost in round-off, because the supports are much softer than the elements; "
        "use fewer elements",
        i + 1);
}

/* Sets the squares of the circular frequencies. With a shift, those that are not much larger than
 * the shift are found again without it. Small squares are zero if the structure can move without
 * deformation, and are otherwise lost in rounding errors. */
static status find_squares(const analysis_context *c, modal_forms *about, eigen_side *side,
                           fault *f)
{
    const double large = 1e3, rounding = 4 * DBL_EPSILON, digits = 10, zero_of_free = 1e-9;
    const size_t n = (size_t)about->of.free;
    double motion[6];
    int node, count = 0;
    about->square = calloc((size_t)side->count + 1, sizeof *about->square);
    if (about->square == NULL)
        return fault_memory(f, "%d modes", side->count);
    for (int i = 0; i < side->count; i++) {
        about->square[i] = 1 / side->mu[i] - about->shift;
        count += count == i && about->square[i] <= large * about->shift;
    }
    if (about->shift == 0 || count == 0)
        return STATUS_OK;
    for (int pass = 0; pass < 2; pass++)
        TRY(remove_shift_once(about, count, side->mode, about->square, f));
    const int moves = supports_loose_part(c->model, &node, motion) ||
                      singular_mechanism(c, STATUS_OK, NULL) != STATUS_OK;
    for (int i = 0; i < count; i++) {
        double *x = side->mode + (size_t)i * n, error = rounding * about->shift;
        const int zero = about->square[i] <= (moves ? zero_of_free * about->shift : digits * error);
        if (zero)
            about->square[i] = 0;
        else
            side->error[i] += error / about->square[i];
        side->mu[i] = 1 / (about->square[i] + about->shift);
        for (size_t k = 0; k < n; k++)
            x[k] *= sqrt(side->mu[i]);
        if (zero && !moves)
            lose(side, i);
    }
    return STATUS_OK;
}

/* Replaces the modes of an eigenvalue with this multiplicity, which may be any basis, by those for
 * which B is diagonal, because `eigenvalue` treats the modes one by one. */
static status separate_equal(modal_forms *about, int multiplicity, double mu[], double square[],
                             double mode[], fault *f)
{
    const size_t n = (size_t)about->of.free, m = (size_t)multiplicity;
    double *B = calloc(m * m + 3 * m, sizeof *B), *b = B + m * m, *before = b + m,
           *row = before + m;
    if (B == NULL)
        return fault_memory(f, "%zu modes", m);
    memcpy(before, mu, m * sizeof *mu);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i <= j; i++)
            B[j * m + i] = inner_product(about, mode + i * n, mode + j * n);
    const int info = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', multiplicity, B, multiplicity, b);
    if (info == 0)
        combine(n, m, B, mode, row);
    for (size_t j = 0; info == 0 && j < m; j++) {
        mu[j] = 0;
        for (size_t k = 0; k < m; k++)
            mu[j] += B[j * m + k] * B[j * m + k] * before[k];
        square[j] = square[j] == 0 ? 0 : 1 / mu[j] - about->shift;
    }
    free(B);
    return STATUS_OK;
}

static status separate(modal_forms *about, eigen_side *side, fault *f)
{
    const double equal = 1e-6;
    for (int first = 0, next; first < side->count && !about->prestressed; first = next) {
        const double *square = about->square;
        for (next = first + 1;
             next < side->count && square[next] - square[next - 1] <= equal * square[next];)
            next++;
        if (next - first > 1)
            TRY(separate_equal(about, next - first, side->mu + first, about->square + first,
                               side->mode + (size_t)first * (size_t)about->of.free, f));
    }
    return STATUS_OK;
}

static void swap(double *a, double *b, int count)
{
    for (int i = 0; i < count; i++) {
        const double kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

/* Moves the modes to the outcome with their circular frequencies in ascending order. */
static void keep(modal_forms *about, eigen_side *side, analysis_outcome *o)
{
    const int n = about->of.free;
    for (int i = 0; i < side->count; i++) {
        side->mu[i] = sqrt(
            eigenvalue(about, side->mu[i], about->square[i], side->mode + (size_t)i * (size_t)n));
        side->error[i] /= 2;
        for (int k = i; k > 0 && side->mu[k] < side->mu[k - 1]; k--) {
            swap(&side->mu[k - 1], &side->mu[k], 1);
            swap(&side->error[k - 1], &side->error[k], 1);
            swap(side->mode + (size_t)(k - 1) * (size_t)n, side->mode + (size_t)k * (size_t)n, n);
        }
    }
    outcome_take(side, &o->left.spectrum.positive);
}

/* Reports a mode without stiffness and without mass, whose frequency is arbitrary. */
static status explain_massless(analysis_context *c, fault *f)
{
    c->work->singular = 0;
    fault_set(f, STATUS_SINGULAR,
              "a coordinate has neither stiffness nor mass, such as the rotation of a point mass, "
              "or of a bar without density about its axis; give bodies an inertia or sections a "
              "density, or fix the coordinate");
    return singular_mechanism(c, STATUS_SINGULAR, f);
}

static status shifted_system(analysis_context *c, linear_system *s, const sparse *M, double *shift,
                             fault *f)
{
    double k = 0, mass = 0;
    for (int j = 0; j < M->n; j++) {
        k += sparse_diagonal(&s->K, j);
        mass += sparse_diagonal(M, j);
    }
    *shift = 1e-9 * k / mass;
    for (int i = 0; i < M->column[M->n]; i++)
        s->K.value[i] += *shift * M->value[i];
    c->run->counters.factorisations++;
    const status outcome = context_factor(c, s->factor, &s->K, f);
    return outcome == STATUS_SINGULAR && isfinite(k) && isfinite(mass) ? explain_massless(c, f)
                                                                       : outcome;
}

/* Adds to K the matrix G of the stresses due to the displacements load_x, under the loads at
 * `path`. */
static status add_stresses(analysis_context *c, double path, linear_system *s, modal_forms *about,
                           fault *f)
{
    about->prestressed = 1;
    TRY(quadratic_forms_load(&c->eq, &about->of, path, 1, f));
    TRY(sparse_alloc_like(&s->K, &about->G, f));
    TRY(linear_geometric_stiffness(&c->eq, about->of.sigma, path, &about->G, f));
    for (int i = 0; i < s->K.column[s->K.n]; i++)
        s->K.value[i] += about->G.value[i];
    c->run->counters.factorisations++;
    return context_factor(c, s->factor, &s->K, f);
}

/* Adds to K the matrix G of the stresses of the linear analysis that this analysis follows. */
static status add_prestress(analysis_context *c, int follows, linear_system *s, modal_forms *about,
                            fault *f)
{
    const model_size size = model_sizes(c->model);
    const double *x = c->scene->analysis[follows].kind == SCENE_LINEAR
                          ? outcome_displacements(&c->outcomes[follows], c->eq.loading.acting)
                          : NULL;
    if (x == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "the linear analysis of the base state has no solution; correct that analysis first");
    memcpy(about->of.load_x, x, (size_t)(size.free + size.driven) * sizeof *x);
    return add_stresses(c, 1, s, about, f);
}

/* Adds to K the matrix G of the stresses due to initial strains without loads. K may belong to a
 * free structure and then includes its shift. */
static status add_strains(const analysis_context *c, linear_system *s, modal_forms *about, fault *f)
{
    analysis_context unloaded = context_unloaded(c);
    TRY(linear_system_solve(&unloaded, s, 0, about->of.load_x, f));
    return add_stresses(&unloaded, 0, s, about, f);
}

static status assemble(analysis_context *c, int analysis, linear_system *s, modal_forms *about,
                       fault *f)
{
    const int follows = c->scene->analysis[analysis].follows;
    const status solved = linear_system_alloc(c, s, f);
    int singular = solved == STATUS_SINGULAR;
    if (!singular)
        TRY(solved);
    TRY(quadratic_forms_alloc(&c->eq, &s->K, &about->of, f));
    if (follows != SCENE_NONE && !singular) {
        const status stressed = add_prestress(c, follows, s, about, f);
        singular = stressed == STATUS_SINGULAR;
        if (!singular)
            TRY(stressed);
    }
    TRY(sparse_alloc_like(&s->K, &about->M, f));
    about->work = calloc((size_t)s->K.n + 1, sizeof *about->work);
    if (about->work == NULL)
        return fault_memory(f, "modes");
    TRY(rotating_frame_inertia(&c->eq, NULL, 0, &about->M, NULL, f));
    if (singular)
        TRY(shifted_system(c, s, &about->M, &about->shift, f));
    if (follows == SCENE_NONE && linear_initial(c->model) > 0)
        TRY(add_strains(c, s, about, f));
    return STATUS_OK;
}

static status solve(analysis_context *c, int analysis, linear_system *s, modal_forms *about,
                    eigen_result *e, fault *f)
{
    TRY(assemble(c, analysis, s, about, f));
    const eigen_problem p = {.K = &s->K,
                             .A = &about->M,
                             .K_factor = s->factor,
                             .sign = 1,
                             .largest = modal_wanted(c, analysis),
                             .K_energy = stiffness_form,
                             .K_rounding = stiffness_rounding,
                             .K_product = stiffness_product,
                             .context = about};
    const status result = eigen_solve(&p, e, f);
    context_count_eigen(c, e);
    return result;
}

status modal_analysis(analysis_context *c, int analysis, analysis_outcome *o, fault *f)
{
    linear_system s = {0};
    eigen_result e = {0};
    modal_forms about = {0};
    status result = solve(c, analysis, &s, &about, &e, f);
    const status squares = find_squares(c, &about, &e.positive, f);
    if (result == STATUS_OK)
        result = squares;
    if (result == STATUS_OK && e.positive.status != STATUS_OK)
        result = fault_set(f, e.positive.status, "%s", e.positive.reason);
    if (result == STATUS_OK)
        result = separate(&about, &e.positive, f);
    if (about.square != NULL)
        keep(&about, &e.positive, o);
    snprintf(o->left.spectrum.meaning, sizeof o->left.spectrum.meaning, "%s",
             flutter_damping(c->model, 0));
    if (about.prestressed && c->scene->analysis[analysis].follows == SCENE_NONE) {
        o->left.spectrum.strained = about.of.load_x;
        about.of.load_x = NULL;
    }
    eigen_free(&e);
    linear_system_free(&s);
    quadratic_forms_free(&about.of);
    sparse_free_values(&about.M);
    sparse_free_values(&about.G);
    free(about.work);
    free(about.square);
    return result;
}
