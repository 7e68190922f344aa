/* Links and chains must agree with dense matrices of all coordinates. States on a polynomial path
 * must be extrapolated exactly. */
#include <gsl/gsl_test.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/kit.h"
#include "harness/model/model.h"
#include "harness/model/test/corner.h"
#include "harness/newton/newton_impl.h"

/* Tangent J^T C J + H of an element in the coordinates of its nodes (element.h). */
typedef struct link_element {
    int nodes, strains, joint; /* joint: number of leading coordinates of each node that are used */
    const double *J, *C, *H;   /* [strains x 7 nodes], [strains x strains], [7 nodes x 7 nodes] */
    const double *r;           /* [nodes x 3] positions of the nodes [m] */
} link_element;

enum { WIDE = ELEMENT_MAX_COORDINATES };

/* Returns the index in the element of coordinate i of the link, whose coordinates start with those
 * of the first joint. */
static int place(const link_element *el, int i)
{
    return NODE_COORDINATES * (i / el->joint) + i % el->joint;
}

/* Copies the columns of J that are used: J_p[strains x joint] of the first node, and J_y[strains x
 * y] of the other nodes. Also copies H[used x used]. */
static void take(const link_element *el, double J_p[], double J_y[], double H[])
{
    const int c = el->joint, n = c * el->nodes, y = n - c, all = NODE_COORDINATES * el->nodes;
    for (int k = 0; k < el->strains; k++)
        for (int i = 0; i < n; i++) {
            double *to = i < c ? &J_p[k * c + i] : &J_y[k * y + i - c];
            *to = el->J[k * all + place(el, i)];
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            H[i * n + j] = el->H[place(el, i) * all + place(el, j)];
}

/* Computes T[used x joint], the motion of all nodes when the element moves as a rigid body with its
 * first node. Warping amplitudes are zero. */
static void carry_along(const link_element *el, double T[])
{
    const int c = el->joint;
    memset(T, 0, (size_t)(c * el->nodes * c) * sizeof *T);
    for (int i = 0; i < c; i++)
        T[i * c + i] = 1;
    for (int k = 1; k < el->nodes; k++) {
        double *at = T + (size_t)(k * c * c);
        const double d[3] = {el->r[3 * k] - el->r[0], el->r[3 * k + 1] - el->r[1],
                             el->r[3 * k + 2] - el->r[2]};
        for (int i = 0; i < 6; i++)
            at[i * c + i] = 1;
        at[0 * c + 4] = d[2]; /* theta x d */
        at[0 * c + 5] = -d[1];
        at[1 * c + 5] = d[0];
        at[1 * c + 3] = -d[2];
        at[2 * c + 3] = d[1];
        at[2 * c + 4] = -d[0];
    }
}

/* Computes F = (J_y^T C J_y + H_yy)^-1. */
static status flexibility(const link_element *el, const double J_y[], const double H[],
                          chain_link *out)
{
    const int c = el->joint, n = c * el->nodes, y = n - c;
    double K[CHAIN_LINK * CHAIN_LINK], work[ELEMENT_MAX_STRAINS * CHAIN_LINK];
    for (int i = 0; i < y; i++)
        memcpy(&K[i * y], &H[(c + i) * n + c], (size_t)y * sizeof *K);
    dense_add_congruence(el->strains, y, J_y, el->C, K, work);
    out->negative = symmetric_inverse(y, K, out->F);
    return out->negative >= 0 ? STATUS_OK : STATUS_SINGULAR;
}

/* Makes the element a link. The rigid motion R of the element causes strains E = J R. Without
 * warping, these are rounding errors. The element then moves by R + d with d = -F (J_y^T C E + (H
 * R)_y), and B = (E + J_y d)^T C (E + J_y d) + (R + d)^T H (R + d). Entries of the size of K are
 * not subtracted. SINGULAR: the element, clamped at its first node, is in a critical state. */
static status link_of(const link_element *el, chain_link *out)
{
    const int c = el->joint, n = c * el->nodes, y = n - c, s = el->strains;
    double J_p[ELEMENT_MAX_STRAINS * CHAIN_JOINT], J_y[ELEMENT_MAX_STRAINS * CHAIN_LINK],
        H[WIDE * WIDE], T[WIDE * CHAIN_JOINT], E[ELEMENT_MAX_STRAINS * CHAIN_JOINT],
        CE[ELEMENT_MAX_STRAINS * CHAIN_JOINT], HT[WIDE * CHAIN_JOINT],
        work[WIDE * CHAIN_JOINT + ELEMENT_MAX_STRAINS * CHAIN_JOINT];
    take(el, J_p, J_y, H);
    carry_along(el, T);
    TRY(flexibility(el, J_y, H, out));
    dense_mul(s, y, c, J_y, T + c * c, E);
    for (int i = 0; i < s * c; i++)
        E[i] += J_p[i];
    dense_mul(s, s, c, el->C, E, CE);
    dense_mul(n, n, c, H, T, HT);
    dense_add_transpose_mul(y, s, c, J_y, CE, HT + c * c);
    dense_mul(y, y, c, out->F, HT + c * c, out->A);
    for (int i = 0; i < y * c; i++)
        out->A[i] = -out->A[i];
    dense_mul(s, y, c, J_y, out->A, CE);
    for (int i = 0; i < s * c; i++)
        E[i] += CE[i];
    for (int i = 0; i < y * c; i++)
        out->A[i] += T[c * c + i];
    memcpy(T + c * c, out->A, (size_t)(y * c) * sizeof *T);
    memset(out->B, 0, sizeof out->B);
    dense_add_congruence(s, c, E, el->C, out->B, work);
    dense_add_congruence(n, c, T, H, out->B, work);
    return STATUS_OK;
}

enum { LINKS = 5, STRAINS = 18, MOST = CHAIN_JOINT * (2 * LINKS + 1) };

typedef struct chain_row {
    int nodes, joint, joints,
        all; /* coordinates per joint, number of joints, and all = joints x joint */
    double J[LINKS][STRAINS * ELEMENT_MAX_COORDINATES], C[LINKS][STRAINS * STRAINS],
        H[LINKS][ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES], r[LINKS][9];
} chain_row;

static void fill(int nodes, int joint, double indefinite, uint64_t *seed, chain_row *out)
{
    const int n = NODE_COORDINATES * nodes;
    *out = (chain_row){.nodes = nodes, .joint = joint, .joints = (nodes - 1) * LINKS + 1};
    out->all = out->joints * joint;
    for (int e = 0; e < LINKS; e++) {
        for (int i = 0; i < STRAINS * n; i++)
            out->J[e][i] = random_number(seed);
        for (int i = 0; i < STRAINS; i++)
            out->C[e][i * STRAINS + i] = 2 + random_number(seed);
        for (int i = 0; i < n; i++)
            for (int j = 0; j <= i; j++)
                out->H[e][i * n + j] = out->H[e][j * n + i] = indefinite * random_number(seed);
        for (int i = 0; i < 3 * nodes; i++)
            out->r[e][i] = random_number(seed);
    }
}

static void assemble(const chain_row *of, double K[])
{
    const int n = NODE_COORDINATES * of->nodes, c = of->joint;
    double work[STRAINS * ELEMENT_MAX_COORDINATES];
    memset(K, 0, (size_t)(of->all * of->all) * sizeof *K);
    for (int e = 0; e < LINKS; e++) {
        double own[ELEMENT_MAX_COORDINATES * ELEMENT_MAX_COORDINATES];
        memcpy(own, of->H[e], sizeof own);
        dense_add_congruence(STRAINS, n, of->J[e], of->C[e], own, work);
        for (int i = 0; i < c * of->nodes; i++)
            for (int j = 0; j < c * of->nodes; j++) {
                const int at = NODE_COORDINATES * (i / c) + i % c,
                          other = NODE_COORDINATES * (j / c) + j % c,
                          first = e * (of->nodes - 1) * c;
                K[(first + i) * of->all + first + j] += own[at * n + other];
            }
    }
}

static status chain_of(const chain_row *of, chain **out)
{
    fault f;
    TRY(chain_alloc(LINKS, of->joint, of->joint * (of->nodes - 1), out, &f));
    chain_begin(*out);
    for (int e = 0; e < LINKS; e++) {
        const link_element el = {of->nodes, STRAINS,  of->joint, of->J[e],
                                 of->C[e],  of->H[e], of->r[e]};
        chain_link link;
        TRY(link_of(&el, &link));
        TRY(chain_add(*out, &link, &f));
    }
    return STATUS_OK;
}

static int negative_of(int n, double A[])
{
    double value[MOST];
    int negative = 0;
    LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'U', n, A, n, value);
    for (int i = 0; i < n; i++)
        negative += value[i] < 0;
    return negative;
}

static double largest(int n, const double a[], const double b[])
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(a[i] - (b != NULL ? b[i] : 0)));
    return most;
}

/* Checks that the dense matrix of the inner coordinates and the chain have equal numbers of
 * negative eigenvalues. Returns this number. The coordinates of the ends come first and last. */
static int held_inside(const chain_row *of, const double K[], const chain *s)
{
    const int inside = of->all - 2 * of->joint;
    double A[MOST * MOST];
    for (int i = 0; i < inside; i++)
        for (int j = 0; j < inside; j++)
            A[i * inside + j] = K[(of->joint + i) * of->all + of->joint + j];
    const int negative = negative_of(inside, A);
    gsl_test_int(chain_negative(s), negative,
                 "negative eigenvalues inside, %d nodes, %d coordinates", of->nodes, of->joint);
    return negative;
}

static void solutions(const chain_row *of, double K[], chain *s, uint64_t *seed)
{
    const int c = of->joint, n = of->all;
    double b[MOST], x[MOST], whole[4 * CHAIN_JOINT * CHAIN_JOINT], ends[2 * CHAIN_JOINT];
    int pivot[MOST];
    fault f;
    for (int i = 0; i < n; i++)
        x[i] = b[i] = random_number(seed);
    gsl_test(chain_stiffness(s, whole, &f) != STATUS_OK, "the stiffness of the ends");
    chain_reduce(s, b + c, ends);
    for (int i = 0; i < 2 * c; i++) {
        const int at = i < c ? i : n - 2 * c + i;
        K[at * n + at] += 5;
        whole[i * 2 * c + i] += 5;
        ends[i] += b[at];
    }
    LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, 1, K, n, pivot, x, 1);
    LAPACKE_dgesv(LAPACK_ROW_MAJOR, 2 * c, 1, whole, 2 * c, pivot, ends, 1);
    chain_expand(s, b + c, ends, b + c);
    memcpy(b, ends, (size_t)c * sizeof *b);
    const double error = largest(n, b, x) / largest(n, x, NULL),
                 most = of->H[0][0] == 0 ? 1e-10 : 1e-4;
    gsl_test(!(error < most), "%d nodes, %d coordinates: solution by way of the ends, off by %.1e",
             of->nodes, c, error);
}

static int against_dense(int nodes, int joint, double indefinite, uint64_t *seed)
{
    static double K[MOST * MOST];
    chain_row of;
    chain *s = NULL;
    int negative = 0;
    fill(nodes, joint, indefinite, seed, &of);
    assemble(&of, K);
    const status made = chain_of(&of, &s);
    gsl_test(made != STATUS_OK, "a chain of %d links", LINKS);
    if (made == STATUS_OK) {
        negative = held_inside(&of, K, s);
        solutions(&of, K, s, seed);
    }
    chain_free(s);
    return negative;
}

static void random_rows(void)
{
    uint64_t seed = 5;
    int negative = 0;
    for (int trial = 0; trial < 12; trial++)
        for (int nodes = 2; nodes <= 3; nodes++)
            for (int joint = 6; joint <= 7; joint++)
                negative += against_dense(nodes, joint, trial < 3 ? 0 : 2.0 * trial, &seed);
    gsl_test(negative < 20, "%d negative eigenvalues were there to be counted", negative);
}

static void uniform_link(double l, double J[], double C[], double H[], double r[])
{
    const int n = 2 * NODE_COORDINATES;
    memset(J, 0, 6 * (size_t)n * sizeof *J);
    memset(C, 0, 36 * sizeof *C);
    memset(H, 0, (size_t)(n * n) * sizeof *H);
    memset(r, 0, 6 * sizeof *r);
    r[3] = l;
    for (int i = 0; i < 6; i++) {
        J[i * n + NODE_COORDINATES + i] = 1;
        J[i * n + i] = -1;
        C[i * 6 + i] = i == 0 || i == 3 ? 1 / l : i < 3 ? 12 / (l * l * l) : 4 / l;
    }
    J[1 * n + 5] = -l;
    J[2 * n + 4] = l;
    C[1 * 6 + 5] = C[5 * 6 + 1] = -6 / (l * l);
    C[2 * 6 + 4] = C[4 * 6 + 2] = 6 / (l * l);
}

static void long_chain(void)
{
    enum { MANY = 100000 };
    double J[6 * 2 * NODE_COORDINATES], C[36], H[4 * NODE_COORDINATES * NODE_COORDINATES], r[6],
        K[144];
    chain *s = NULL;
    chain_link link;
    fault f;
    uniform_link(1.0 / MANY, J, C, H, r);
    int good = chain_alloc(MANY, 6, 6, &s, &f) == STATUS_OK &&
               link_of(&(link_element){2, 6, 6, J, C, H, r}, &link) == STATUS_OK;
    if (good)
        chain_begin(s);
    for (int i = 0; i < MANY && good; i++)
        good = chain_add(s, &link, &f) == STATUS_OK;
    good = good && chain_stiffness(s, K, &f) == STATUS_OK;
    gsl_test(!good, "a chain of %d links", MANY);
    if (good) {
        gsl_test_rel(K[0], 1, 1e-8, "elongation of %d links", MANY);
        gsl_test_rel(K[1 * 12 + 1], 12, 1e-8, "shift of %d links", MANY);
        gsl_test_rel(K[5 * 12 + 1], 6, 1e-8, "moment of a shift of %d links", MANY);
        gsl_test_rel(K[5 * 12 + 5], 4, 1e-8, "turn of %d links", MANY);
        gsl_test_rel(K[5 * 12 + 11], 2, 1e-8, "turn of the other end of %d links", MANY);
        gsl_test_int(chain_negative(s), 0, "it is stable");
    }
    chain_free(s);
}

static void chain_tests(void)
{
    random_rows();
    long_chain();
}

enum { MOST_DEGREE = MODEL_EXTRAPOLATED };

static void extrapolate_fill(const model *m, int degree, double path, model_state *s)
{
    uint64_t seed = 42;
    s->path = path;
    for (size_t k = 0; k < s->size; k++) {
        double value = 0;
        for (int p = 0; p <= MOST_DEGREE; p++) {
            const double c = random_number(&seed);
            value += p <= degree ? c * pow(path, p) : 0;
        }
        s->block[k] = value;
    }
    for (int v = 0; v < model_vertices(m); v++) {
        double turn[3], angle = 0;
        for (int p = 1; p <= degree; p++)
            angle += 0.3 / p * pow(path, p);
        for (int c = 0; c < 3; c++)
            turn[c] = angle * random_number(&seed);
        rotation_exp(turn, &s->q[4 * v]);
    }
}

static double apart(const model *m, const model_state *a, const model_state *b)
{
    double worst = 0;
    for (int v = 0; v < model_vertices(m); v++) {
        double turn[3];
        if (model_vertex(m, v)->body != v)
            continue;
        rotation_between(&a->q[4 * v], &b->q[4 * v], turn);
        for (int c = 0; c < 3; c++)
            worst = worst_of(worst, fmax(fabs(a->u[3 * v + c] - b->u[3 * v + c]), fabs(turn[c])));
    }
    for (int i = 0; i < model_elements(m) * model_strains(m); i++)
        worst = worst_of(worst, fmax(fabs(a->e[i] - b->e[i]), fabs(a->sigma[i] - b->sigma[i])));
    return worst;
}

/* Returns the error of the state predicted for the parameter `to` from the states at path[count].
 * The path is a polynomial of |path - kink|. */
static double error_of_guess(const model *m, int degree, double kink, int count,
                             const double path[], double to)
{
    predictor t;
    run_state run;
    model_state *s, *exact;
    fault f = {""};
    run_state_begin(&run, m, 1, NULL);
    equations eq = {.m = m, .run = &run};
    gsl_test(predictor_alloc(m, &t, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &s, &f) != STATUS_OK ||
                 kinematics_state_alloc(m, &exact, &f) != STATUS_OK,
             "states: %s", f.text);
    for (int i = 0; i < count; i++) {
        extrapolate_fill(m, degree, fabs(path[i] - kink), s);
        s->path = path[i];
        gsl_test(predictor_add(&eq, s, 3, &t, &f) != STATUS_OK, "a state: %s", f.text);
    }
    predictor_guess(&eq, &t, to, s);
    run_state_end(&run);
    extrapolate_fill(m, degree, fabs(to - kink), exact);
    const double error = apart(m, s, exact);
    predictor_free(&t);
    kinematics_state_free(s);
    kinematics_state_free(exact);
    return error;
}

static void smooth_paths(const model *m)
{
    static const double path[] = {0.04, 0.09, 0.15, 0.2,  0.26, 0.33, 0.39, 0.46,
                                  0.53, 0.6,  0.68, 0.75, 0.83, 0.9,  0.98};
    for (int count = MODEL_EXTRAPOLATED + 1; count <= 14; count++)
        for (int degree = 0; degree <= MOST_DEGREE; degree++) {
            const double error = error_of_guess(m, degree, 0, count, path, path[count]);
            if (degree < MODEL_EXTRAPOLATED)
                gsl_test(!(error < 1e-11), "degree %d after %d steps: error %.1e", degree, count,
                         error);
            else
                gsl_test(!(error > 1e-6), "degree %d after %d steps: no guess is exact (%.1e)",
                         degree, count, error);
        }
}

static void long_steps(const model *m)
{
    static const double path[] = {0.1, 0.2, 0.3, 0.4, 0.5};
    const double within = error_of_guess(m, 2, 0, 5, path, 0.5 + 0.149),
                 beyond = error_of_guess(m, 2, 0, 5, path, 0.5 + 0.151);
    gsl_test(!(within < 1e-13), "a longer step is guessed (%.1e)", within);
    gsl_test(!(beyond > 1e-3), "a much longer one starts where the last ended (%.1e)", beyond);
}

static void slope_jumps(const model *m)
{
    static const double path[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
    const double error = error_of_guess(m, 1, 0.45, 7, path, 0.8);
    gsl_test(!(error < 1e-12), "behind a kink: error %.1e", error);
}

static void extrapolate_tests(void)
{
    scene s;
    model *m = NULL;
    if (corner("geometrically_exact", 2, 0, &s, &m)) {
        smooth_paths(m);
        long_steps(m);
        slope_jumps(m);
    }
    model_free(m);
    scene_free(&s);
}

int main(void)
{
    chain_tests();
    extrapolate_tests();
    return gsl_test_summary();
}
