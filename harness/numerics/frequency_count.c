#include "harness/numerics/numerics_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

status subspace_alloc(subspace *b, eigen_product *S, void *context, const sparse *M,
                      const sparse *G, int room, fault *f)
{
    const size_t n = (size_t)M->n, most = (size_t)(room < M->n ? room : M->n);
    memset(b, 0, sizeof *b);
    b->S = S;
    b->context = context;
    b->M = M;
    b->G = G;
    b->n = M->n;
    b->room = (int)most;
    b->V = malloc((most * n + 1) * sizeof(double));
    b->SV = malloc((most * n + 1) * sizeof(double));
    b->MV = malloc((most * n + 1) * sizeof(double));
    b->GV = malloc((most * n + 1) * sizeof(double));
    b->Mp = calloc(most * most + 1, sizeof(double));
    b->Gp = calloc(most * most + 1, sizeof(double));
    const int good = b->V != NULL && b->SV != NULL && b->MV != NULL && b->GV != NULL &&
                     b->Mp != NULL && b->Gp != NULL;
    return good ? STATUS_OK : fault_memory(f, "a basis of %zu vectors", most);
}

void subspace_free(subspace *b)
{
    free(b->V);
    free(b->SV);
    free(b->MV);
    free(b->GV);
    free(b->Mp);
    free(b->Gp);
}

/* Computes y = G x for a skew-symmetric G, of which the upper triangle or all entries are
 * stored. */
static void subspace_skew_mul(const sparse *G, const double x[], double y[])
{
    if (!G->symmetric) {
        sparse_mul(G, x, y);
        return;
    }
    memset(y, 0, (size_t)G->n * sizeof *y);
    for (int j = 0; j < G->n; j++)
        for (int k = G->column[j]; k < G->column[j + 1]; k++) {
            y[G->row[k]] += G->value[k] * x[j];
            if (G->row[k] != j)
                y[j] -= G->value[k] * x[G->row[k]];
        }
}

int subspace_add(subspace *b, const double x[])
{
    const double negligible = 1e-7; /* relative size below which a vector adds no new direction */
    const size_t n = (size_t)b->n, at = (size_t)b->count * n;
    if (b->count == b->room)
        return 0;
    double *v = b->V + at, *Sv = b->SV + at;
    memcpy(v, x, n * sizeof *v);
    b->S(b->context, v, Sv);
    const double before = sqrt(fmax(0, dense_dot(b->n, v, Sv)));
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < b->count; i++) {
            const double c = dense_dot(b->n, b->SV + (size_t)i * n, v);
            for (size_t k = 0; k < n; k++)
                v[k] -= c * b->V[(size_t)i * n + k];
        }
    b->S(b->context, v, Sv);
    const double size = sqrt(fmax(0, dense_dot(b->n, v, Sv)));
    if (!(size > negligible * before))
        return 0;
    for (size_t k = 0; k < n; k++) {
        v[k] /= size;
        Sv[k] /= size;
    }
    sparse_mul(b->M, v, b->MV + at);
    subspace_skew_mul(b->G, v, b->GV + at);
    const int last = b->count++;
    for (int i = 0; i <= last; i++) {
        const double m = dense_dot(b->n, b->V + (size_t)i * n, b->MV + at),
                     g = dense_dot(b->n, b->V + (size_t)i * n, b->GV + at);
        b->Mp[i * b->room + last] = b->Mp[last * b->room + i] = m;
        b->Gp[i * b->room + last] = i == last ? 0 : g;
        b->Gp[last * b->room + i] = i == last ? 0 : -g;
    }
    return 1;
}

/* Parts of the work space, [n] each: K, M and G times the real part and the imaginary part of a
 * vector, its residual, and work space. */
enum { K_RE, K_IM, M_RE, M_IM, G_RE, G_IM, R_RE, R_IM, WORK, PARTS };

status estimate_alloc(int n, motion_estimate *e, fault *f)
{
    memset(e, 0, sizeof *e);
    e->work = calloc((size_t)PARTS * (size_t)n + 1, sizeof *e->work);
    return e->work != NULL ? STATUS_OK : fault_memory(f, "%d coordinates", n);
}

void estimate_free(motion_estimate *e)
{
    free(e->work);
}

static double *part(const motion_estimate *e, int which)
{
    return e->work + (size_t)which * (size_t)e->basis->n;
}

void estimate_stiffness(const gyroscopic_problem *p, const double x[], double y[])
{
    if (p->K_product != NULL)
        p->K_product(p->context, x, y);
    else
        sparse_mul(p->K, x, y);
}

/* The quadratic forms x^H K x, x^H M x and i x^H G x. */
typedef struct forms {
    double k, m, g;
} forms;

static forms forms_of(const motion_estimate *e, const double re[], const double im[])
{
    const int n = e->basis->n;
    estimate_stiffness(e->p, re, part(e, K_RE));
    estimate_stiffness(e->p, im, part(e, K_IM));
    sparse_mul(e->p->M, re, part(e, M_RE));
    sparse_mul(e->p->M, im, part(e, M_IM));
    subspace_skew_mul(e->p->G, re, part(e, G_RE));
    subspace_skew_mul(e->p->G, im, part(e, G_IM));
    return (forms){dense_dot(n, re, part(e, K_RE)) + dense_dot(n, im, part(e, K_IM)),
                   dense_dot(n, re, part(e, M_RE)) + dense_dot(n, im, part(e, M_IM)),
                   -2 * dense_dot(n, re, part(e, G_IM))};
}

/* Returns the root of k - omega^2 m + omega g = 0 that is closer to the estimated frequency, or
 * this estimate if a root is not finite. */
static double quotient(const forms *of, double frequency)
{
    const double root = sqrt(of->g * of->g + 4 * of->k * of->m),
                 sum = of->g >= 0 ? of->g + root : of->g - root, large = sum / (2 * of->m),
                 small = -2 * of->k / sum;
    if (!isfinite(large) || !isfinite(small))
        return frequency;
    return fabs(large - frequency) < fabs(small - frequency) ? large : small;
}

/* Computes the residual r = (K + lambda^2 M + lambda G) x from its parts. */
static void residual(const motion_estimate *e, double complex lambda)
{
    const double complex square = lambda * lambda;
    for (int k = 0; k < e->basis->n; k++) {
        const double complex r = part(e, K_RE)[k] + I * part(e, K_IM)[k] +
                                 square * (part(e, M_RE)[k] + I * part(e, M_IM)[k]) +
                                 lambda * (part(e, G_RE)[k] + I * part(e, G_IM)[k]);
        part(e, R_RE)[k] = creal(r);
        part(e, R_IM)[k] = cimag(r);
    }
}

/* Returns half^T S^-1 half, for the real or the imaginary part of a residual. */
static double size_of(motion_estimate *e, const double half[])
{
    double *x = part(e, WORK);
    memcpy(x, half, (size_t)e->basis->n * sizeof *x);
    factor_solve(e->S_factor, x);
    return fmax(0, dense_dot(e->basis->n, half, x));
}

/* Returns |w^H (lambda^2 M - K) x| for vectors with w^H S w = x^H S x = 1. */
static double energy(const motion_estimate *e, int i, double complex lambda, int grows)
{
    const subspace *b = e->basis;
    const size_t at = (size_t)i * (size_t)b->room;
    const double complex *x = e->pairs->c + at, *w = grows ? e->pairs->left + at : x,
                         times = lambda * lambda + e->shift;
    double complex sum = 0;
    for (int j = 0; j < e->pairs->size; j++) {
        double complex Mx = 0;
        for (int k = 0; k < e->pairs->size; k++)
            Mx += b->Mp[j * b->room + k] * x[k];
        sum += conj(w[j]) * (times * Mx - x[j]);
    }
    return cabs(sum);
}

/* Returns |x_k^H r|^2 for another pair k. */
static double share(const motion_estimate *e, int k)
{
    const subspace *b = e->basis;
    const double complex *c = e->pairs->c + (size_t)k * (size_t)b->room;
    double complex sum = 0;
    for (int j = 0; j < e->pairs->size; j++) {
        const double *v = b->V + (size_t)j * (size_t)b->n;
        sum += conj(c[j]) *
               (dense_dot(b->n, v, part(e, R_RE)) + I * dense_dot(b->n, v, part(e, R_IM)));
    }
    return creal(sum * conj(sum));
}

static double missed(motion_estimate *e, int i, double complex lambda, double own)
{
    const double size = cabs(lambda);
    double sum = 0, rest = size_of(e, part(e, R_RE)) + size_of(e, part(e, R_IM));
    for (int k = 0; k < e->found; k++) {
        if (k == i)
            continue;
        const double complex other = e->pairs->lambda[k];
        const double both = own * energy(e, k, other,
                                         gyroscopic_index_grows(e->pairs, e->basis, e->shift, k)),
                     apart = cabs(other - lambda) / size, square = share(e, k) / both;
        sum += square >= apart * apart ? apart : square / apart;
    }
    rest /= own;
    const double next = e->found < e->pairs->count ? cabs(e->pairs->lambda[e->found]) : INFINITY,
                 apart = fmin(1, fabs(next - size) / size);
    sum += rest >= apart * apart ? sqrt(rest) : rest / apart;
    return 2 * sum;
}

/* Returns a bound of the rounding error of x^H (K + lambda^2 M + lambda G) x. */
static double rounding(const motion_estimate *e, double size, const double re[], const double im[])
{
    const double operations = 4;
    const gyroscopic_problem *p = e->p;
    const double k = p->K_rounding != NULL
                         ? p->K_rounding(p->context, re) + p->K_rounding(p->context, im)
                         : sparse_rounding(p->K, re, re) + sparse_rounding(p->K, im, im);
    const double m = sparse_rounding(p->M, re, re) + sparse_rounding(p->M, im, im),
                 g = 2 * sparse_rounding(p->G, re, im);
    return operations * (k + size * size * m + size * g);
}

void estimate_pair(motion_estimate *e, int i, const double re[], const double im[], int grows,
                   double complex *lambda, double *error)
{
    const forms of = forms_of(e, re, im);
    if (!grows)
        *lambda = I * quotient(&of, cimag(*lambda));
    const double size = cabs(*lambda), own = energy(e, i, *lambda, grows),
                 change = rounding(e, size, re, im);
    residual(e, *lambda);
    *error = missed(e, i, *lambda, own) + fmin(change / own, sqrt(change / of.m) / size);
}

/* Allocates the pattern of the Hermitian A + i B as a real symmetric matrix of twice the size, with
 * [a, -b; b, a] for each entry. Its eigenvalues occur in pairs. */
static status doubled_alloc(const sparse *pattern, sparse *out, fault *f)
{
    const int n = pattern->n, entries = pattern->column[n];
    memset(out, 0, sizeof *out);
    out->n = 2 * n;
    out->symmetric = 1;
    out->column = calloc(2 * (size_t)n + 1, sizeof *out->column);
    out->row = malloc((4 * (size_t)entries + 1) * sizeof *out->row);
    out->value = malloc((4 * (size_t)entries + 1) * sizeof *out->value);
    return out->column != NULL && out->row != NULL && out->value != NULL
               ? STATUS_OK
               : fault_memory(f, "a matrix of %d coordinates", 2 * n);
}

static void doubled_free(sparse *a)
{
    free(a->column);
    free(a->row);
    free(a->value);
}

static void fill(const sparse *K, const sparse *M, const sparse *G, double omega, sparse *out)
{
    int at = 0;
    for (int j = 0; j < K->n; j++)
        for (int half = 0; half < 2; half++) {
            for (int k = K->column[j]; k < K->column[j + 1]; k++) {
                const int i = K->row[k];
                const double a = K->value[k] - omega * omega * M->value[k], b = omega * G->value[k];
                if (i < j) {
                    out->row[at] = 2 * i;
                    out->value[at++] = half == 0 ? a : -b;
                    out->row[at] = 2 * i + 1;
                    out->value[at++] = half == 0 ? b : a;
                } else if (i == j) {
                    out->row[at] = 2 * i + half;
                    out->value[at++] = a;
                }
            }
            out->column[2 * j + half + 1] = at;
        }
}

static status count(const sparse *K, const sparse *M, const sparse *G, double omega,
                    sparse *doubled, matrix_factor **factors, int *below, fault *f)
{
    TRY(doubled_alloc(K, doubled, f));
    fill(K, M, G, omega, doubled);
    TRY(factor_alloc(doubled, factors, f));
    TRY(factor_numeric(*factors, doubled, f));
    *below = factor_count(*factors).negative_pivots / 2;
    return STATUS_OK;
}

status gyroscopic_count(const sparse *K, const sparse *M, const sparse *G, double omega, int *below,
                        fault *f)
{
    sparse doubled;
    matrix_factor *factors = NULL;
    const status outcome = count(K, M, G, omega, &doubled, &factors, below, f);
    factor_free(factors);
    doubled_free(&doubled);
    return outcome;
}

/* Returns x^H (K + |lambda|^2 M) x relative to the size of its terms. c^H c = 1 means that x^H (K +
 * shift M) x = 1. */
static double index_energy(const ritz *r, const subspace *b, double shift, int i)
{
    const double complex *c = r->c + (size_t)i * (size_t)b->room;
    const double size = cabs(r->lambda[i]);
    double unit = 0, mass = 0;
    for (int j = 0; j < r->size; j++) {
        double complex sum = 0;
        for (int k = 0; k < r->size; k++)
            sum += b->Mp[j * b->room + k] * c[k];
        unit += creal(conj(c[j]) * c[j]);
        mass += creal(conj(c[j]) * sum);
    }
    const double potential = unit - shift * mass, kinetic = size * size * mass;
    return (potential + kinetic) / (fabs(potential) + kinetic);
}

/* Energies below this relative size count as zero. */
static const double no_energy = 1e-6;
/* A real part above this fraction of |lambda| is growth and not a rounding error. */
static const double clear_growth = 1e-3;

int gyroscopic_index_grows(const ritz *r, const subspace *b, double shift, int i)
{
    const double part = fabs(creal(r->lambda[i])) / cabs(r->lambda[i]);
    return part > clear_growth ||
           (part > ritz_imaginary && fabs(index_energy(r, b, shift, i)) <= no_energy);
}

gyroscopic_index gyroscopic_index_of(const ritz *r, const subspace *b, double shift, int count)
{
    gyroscopic_index out = {0, 0};
    for (int i = 0; i < count; i++) {
        const double complex lambda = r->lambda[i];
        if (gyroscopic_index_grows(r, b, shift, i)) {
            out.negative += fabs(cimag(lambda)) > ritz_imaginary * cabs(lambda) ? 2 : 1;
            continue;
        }
        const double e = index_energy(r, b, shift, i);
        out.negative += e < -no_energy ? 2 : 0;
        out.crossed += (e > no_energy) - (e < -no_energy);
    }
    return out;
}
