/* Buckling loads and frequencies of a simply supported beam of many elements: how far round-off
 * lets them be computed. */
#include <gsl/gsl_test.h>

#include "elements/math/pi.h"
#include "harness/numerics/test/eigen_problems.h"

typedef struct beam {
    int elements;
    double h;
    sparse K, G, M; /* G: at unit tension */
} beam;

/* Ends that cannot move across and are free to turn, length 1, EI = 1, mass per length 1. */
static void beam_init(beam *b, int elements)
{
    double k[16], g[16], m[16];
    b->elements = elements;
    b->h = 1.0 / elements;
    matrices_beam(b->h, k, g, m);
    b->K = matrices_chain(elements + 1, 2);
    b->G = matrices_chain(elements + 1, 2);
    b->M = matrices_chain(elements + 1, 2);
    matrices_add_elements(&b->K, elements, 2, 0, k);
    matrices_add_elements(&b->G, elements, 2, 0, g);
    matrices_add_elements(&b->M, elements, 2, 0, m);
    sparse *const all[] = {&b->K, &b->G, &b->M};
    for (int i = 0; i < 3;
         i++) { /* the two held deflections become unknowns of their own that carry nothing */
        const int held[2] = {0, 2 * elements};
        for (int e = 0; e < 2; e++)
            for (int j = 0; j < all[i]->n; j++)
                for (int l = all[i]->column[j]; l < all[i]->column[j + 1]; l++)
                    if (all[i]->row[l] == held[e] || j == held[e])
                        all[i]->value[l] = all[i]->row[l] == j && i == 0 ? 1 / b->h : 0;
    }
}

static void beam_free(beam *b)
{
    matrices_free(&b->K);
    matrices_free(&b->G);
    matrices_free(&b->M);
}

/* Bending strains: the slopes less that of the chord. */
static double beam_energy(void *context, const double x[])
{
    const beam *b = context;
    double sum = (x[0] * x[0] + x[2 * b->elements] * x[2 * b->elements]) / b->h;
    for (int i = 0; i < b->elements; i++) {
        const double left = i > 0 ? x[2 * i] : 0, right = i + 1 < b->elements ? x[2 * i + 2] : 0,
                     chord = (right - left) / b->h;
        const double p = x[2 * i + 1] - chord, q = x[2 * i + 3] - chord;
        sum += 4 / b->h * (p * p + p * q + q * q);
    }
    return sum;
}

/* mu of the mesh: w = W sin(k pi j h) and slope = S cos(k pi j h) at node j leave two unknowns, W
 * and S. For coarse meshes: the determinants cancel like (k pi h)^4. */
static double mesh_value(const beam *b, int k, int vibration)
{
    double K[16], G[16], M[16], form[2][3];
    const double phase = k * PI * b->h;
    matrices_beam(b->h, K, G, M);
    const double *const both[] = {K, vibration ? M : G};
    for (int which = 0; which < 2; which++) {
        const double *e = both[which];
        form[which][0] = e[0] + e[10] + 2 * e[2] * cos(phase);
        form[which][1] = (e[6] - e[3]) * sin(phase);
        form[which][2] = e[5] + e[15] + 2 * e[7] * cos(phase);
    }
    /* det(form[1] - mu form[0]) = 0, the larger root */
    const double *c = form[0], *d = form[1];
    const double p = c[0] * c[2] - c[1] * c[1], q = d[0] * c[2] + d[2] * c[0] - 2 * d[1] * c[1],
                 r = d[0] * d[2] - d[1] * d[1];
    return (q + sqrt(q * q - 4 * p * r)) / (2 * p);
}

/* Euler's loads and frequencies (k pi)^2: the mesh's loads are above by (k pi h)^4/720 of
 * themselves, its frequencies by half of that. */
static double expected_value(const beam *b, int k, int vibration)
{
    if (b->elements <= 20)
        return vibration ? 1 / sqrt(mesh_value(b, k, 1)) : 1 / mesh_value(b, k, 0);
    return k * PI * k * PI * (1 + pow(k * PI * b->h, 4) / (vibration ? 1440 : 720));
}

/* The values and the errors that the solver estimates: they must cover the actual ones, and
 * rounding in n^2 of the form of A. */
static void compare(const beam *b, const eigen_side *found, int vibration, double allowed)
{
    const double rounding = 1e-15 + 1e-17 * b->elements * b->elements;
    for (int i = 0; i < found->count; i++) {
        const double exact = expected_value(b, i + 1, vibration),
                     value = 1 / (vibration ? sqrt(found->mu[i]) : found->mu[i]);
        const double actual = fabs(value / exact - 1);
        const char *what = vibration ? "frequency" : "load";
        gsl_test(!(actual < allowed), "%d elements: %s %d is off by %.1e (residual %.1e)",
                 b->elements, what, i + 1, actual, found->residual[i]);
        gsl_test(b->elements > 20 && !(actual < 3 * found->error[i] + rounding),
                 "%d elements: %s %d: estimated %.1e", b->elements, what, i + 1, found->error[i]);
    }
}

static void test_beam(int elements, double allowed)
{
    beam b;
    eigen_result r = {0};
    fault f = {""};
    enum { WANTED = 6 };
    beam_init(&b, elements);
    eigen_problem p = {.K = &b.K, .A = &b.G, .sign = 1, .largest = WANTED, .smallest = 2};
    p.K_energy = beam_energy;
    p.context = &b;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "column of %d elements: %s",
                 elements, f.text);
    gsl_test_int(r.positive.count, WANTED, "column of %d elements: buckling loads", elements);
    gsl_test_int(r.negative.count, 0, "column of %d elements: it does not buckle in tension",
                 elements);
    compare(&b, &r.positive, 0, allowed);
    eigen_free(&r);
    p.A = &b.M;
    p.smallest = 0;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_OK, "beam of %d elements: %s",
                 elements, f.text);
    compare(&b, &r.positive, 1, allowed);
    eigen_free(&r);
    beam_free(&b);
}

/* The matrix of the test has lost digits, its elements have not. */
typedef struct spoilt {
    const sparse *K; /* as it should be */
    double rounding; /* of x^T K x, in parts of it */
} spoilt;

static double spoilt_energy(void *context, const double x[])
{
    return matrices_energy(((const spoilt *)context)->K, x);
}

static double spoilt_rounding(void *context, const double x[])
{
    return ((const spoilt *)context)->rounding * spoilt_energy(context, x);
}

static void spoilt_product(void *context, const double x[], double y[])
{
    sparse_mul(((const spoilt *)context)->K, x, y);
}

/* Whatever assembling K has changed, the answer is that of the elements; and an error that is told
 * is the error. */
static void test_spoilt(double part)
{
    enum { ELEMENTS = 60, WANTED = 5 };
    beam b;
    sparse good = {0};
    eigen_result exact = {0}, r = {0};
    fault f = {""};
    beam_init(&b, ELEMENTS);
    eigen_problem p = {.K = &b.K, .A = &b.G, .sign = 1, .largest = WANTED};
    gsl_test_int((int)eigen_problems_solve(&p, &exact, &f), STATUS_OK, "column as it should be: %s",
                 f.text);
    gsl_test_int((int)sparse_alloc_like(&b.K, &good, &f), STATUS_OK, "copy");
    memcpy(good.value, b.K.value, (size_t)b.K.column[b.K.n] * sizeof *good.value);
    for (int j = 0; j < b.K.n; j++)
        for (int k = b.K.column[j]; k < b.K.column[j + 1]; k++)
            if (b.K.row[k] == j &&
                j % 2 == 1) /* turning meets a spring of its own, stiffer along the column */
                b.K.value[k] += part * 20 * b.h * (1 + 3.0 * j / b.K.n);
    spoilt context = {&good, 1e-4};
    p.K_energy = spoilt_energy;
    p.context = &context;
    for (int refined = 0; refined < 2; refined++) {
        p.K_product = refined ? spoilt_product : NULL;
        p.K_rounding = refined ? spoilt_rounding : NULL;
        const status outcome = eigen_problems_solve(&p, &r, &f);
        gsl_test(refined && outcome != STATUS_OK, "K spoilt by %g: %s", part, f.text);
        double worst = 0;
        for (int i = 0; i < r.positive.count; i++) {
            worst = fmax(worst, fabs(r.positive.mu[i] / exact.positive.mu[i] - 1));
            gsl_test(refined && !(r.positive.error[i] >= 1e-4 && r.positive.error[i] < 1.1e-4),
                     "the error that is told is that of the form and not of the matrix: %.2e",
                     r.positive.error[i]);
        }
        gsl_test_int(r.positive.count, WANTED, "all are found");
        gsl_test(refined ? !(worst < 1e-7) : part >= 1e-2 && worst < 1e-6,
                 "K spoilt by %g, %s: off by %.1e", part, refined ? "refined" : "as it is", worst);
        eigen_free(&r);
    }
    context.rounding = 0.5;
    gsl_test_int((int)eigen_problems_solve(&p, &r, &f), STATUS_NOT_CONVERGED,
                 "no digit is left: %s", f.text);
    gsl_test(r.positive.count != WANTED || !isnan(r.positive.mu[0]), "and no value given");
    eigen_free(&r);
    eigen_free(&exact);
    sparse_free_values(&good);
    beam_free(&b);
}

int main(void)
{
    test_spoilt(1e-4);
    test_spoilt(1e-2);
    test_spoilt(0.05);
    test_beam(12, 1e-12);
    test_beam(600, 1e-12);
    test_beam(2000, 3e-9);
    return gsl_test_summary();
}
