/* Hyperbolic twist of beamw_consistent: one element is exact in the linear theory whatever couples,
 * and its functions and points are accurate from no Saint-Venant torsion to boundary layers. */
#include "elements/test/pair.h"
#include "elements/test/sections.h"
#include "elements/test/worst.h"

extern const element_type element_beamw_consistent;

/* Branched and unsymmetric: everything couples. */
static section unsymmetric(void)
{
    static const double point[5][2] = {{0, 0}, {0.05, 0}, {0.05, 0.08}, {0.02, 0.08}, {0.05, 0.1}};
    static const int wall[4][2] = {{0, 1}, {1, 2}, {2, 3}, {2, 4}};
    static const double thickness[4] = {0.002, 0.003, 0.004, 0.001};
    const section_spec spec = section_spec_walls(2.1e11, 8e10, 4, point, wall, thickness);
    return sections_computed(&spec);
}

/* K [14 x 14] of a straight element at rest. */
static void linear_stiffness(const section *c, double l0, beamw_twist_kind torsion, double K[N * N])
{
    pair_subject s;
    const double none[N] = {0}, e[STRAINS] = {0};
    double J[STRAINS * N], S[STRAINS * STRAINS], work[STRAINS * N];
    node_state x[2];
    start_with(&s, &element_beamw_consistent, c, l0,
               FEATURE_SHEAR | FEATURE_WARPING | FEATURE_ECCENTRIC, "torsion", torsion);
    nodes_place(2, l0, none, x);
    s.type->strain(data_of(&s), x, &(strain_output){.J = J});
    s.type->stress(data_of(&s), e, NULL, &(stress_output){.C = S});
    memset(K, 0, N * N * sizeof *K);
    dense_add_congruence(STRAINS, N, J, S, K, work);
}

/* Two halves with their common node eliminated are the whole if and only if the linear solution
 * between the nodes is exact. Returns the largest difference, each coordinate scaled by the root of
 * its stiffness. */
static double halves_against_whole(const section *c, double l0, beamw_twist_kind torsion)
{
    enum { M = 7 };
    double whole[N * N], half[N * N], middle[M * M], sides[M * N], worst = 0;
    int pivot[M];
    linear_stiffness(c, l0, torsion, whole);
    linear_stiffness(c, l0 / 2, torsion, half);
    for (int i = 0; i < M; i++) {
        for (int j = 0; j < M; j++) {
            middle[M * i + j] = half[N * (M + i) + M + j] + half[N * i + j];
            sides[N * i + j] = half[N * (M + i) + j];
            sides[N * i + M + j] = half[N * i + M + j];
        }
    }
    double solved[M * N];
    memcpy(solved, sides, sizeof solved);
    gsl_test(dense_lu(M, middle, pivot), "the middle node is held");
    dense_lu_solve(M, N, middle, pivot, solved);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double sum = 0;
            if (i / M == j / M)
                sum = half[N * i + j];
            for (int k = 0; k < M; k++)
                sum -= sides[N * k + i] * solved[N * k + j];
            worst = worst_of(worst, fabs(sum - whole[N * i + j]) /
                                        sqrt(whole[(N + 1) * i] * whole[(N + 1) * j]));
        }
    return worst;
}

static void hyperbolic_twist(void)
{
    section c = unsymmetric();
    const double lengths[] = {0.03, 0.3, 3, 30};
    for (int i = 0; i < 4; i++) {
        const double cubic = halves_against_whole(&c, lengths[i], BEAMW_TWIST_CUBIC);
        const double exact = halves_against_whole(&c, lengths[i], BEAMW_TWIST_HYPERBOLIC);
        const double lambda = beamw_twist_of(&c, lengths[i], 1, BEAMW_TWIST_HYPERBOLIC).lambda;
        gsl_test(!(exact < 1e-10 && cubic > 1e-8),
                 "lambda %.3f: one hyperbolic element is two (%.1e), a cubic one is not (%.1e)",
                 lambda, exact, cubic);
    }
    c.It = 0;
    gsl_test(!(halves_against_whole(&c, 0.3, BEAMW_TWIST_HYPERBOLIC) < 1e-10),
             "without Saint-Venant torsion both are");
}

/* Linear stiffness at rest K [14 x 14] and, along the nodes' displacement d [14], the energy of
 * third order 1/2 sum_i s_i (d . H_i d + e . Q_i e), e = J d, s = S e: what a prestress of the same
 * kind adds to the stiffness. */
static double third_order(const section *c, double l0, beamw_twist_kind torsion, unsigned features,
                          const double d[N])
{
    pair_subject s;
    const double none[N] = {0}, zero[STRAINS] = {0};
    double J[STRAINS * N], S[STRAINS * STRAINS], e[STRAINS], sigma[STRAINS], G[STRAINS * STRAINS],
        H[N * N], energy = 0;
    node_state x[2];
    start_with(&s, &element_beamw_consistent, c, l0, features, "torsion", torsion);
    nodes_place(2, l0, none, x);
    s.type->strain(data_of(&s), x, &(strain_output){.J = J});
    s.type->stress(data_of(&s), zero, NULL, &(stress_output){.C = S});
    dense_mul_vec(STRAINS, N, J, d, e);
    dense_mul_vec(STRAINS, STRAINS, S, e, sigma);
    s.type->strain(data_of(&s), x, &(strain_output){.s = sigma, .H = H});
    s.type->geometric(data_of(&s), sigma, G);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            energy += d[i] * H[N * i + j] * d[j] / 2;
    for (int i = 0; i < STRAINS; i++)
        for (int j = 0; j < STRAINS; j++)
            energy += e[i] * G[STRAINS * i + j] * e[j] / 2;
    return energy;
}

/* The middle of two halves in linear equilibrium between displaced ends. */
static void middle_of(const section *c, double l0, beamw_twist_kind torsion, const double p[7],
                      const double q[7], double out[7])
{
    enum { M = 7 };
    double half[N * N], A[M * M];
    int pivot[M];
    linear_stiffness(c, l0 / 2, torsion, half);
    for (int i = 0; i < M; i++) {
        out[i] = 0;
        for (int j = 0; j < M; j++) {
            A[M * i + j] = half[N * (M + i) + M + j] + half[N * i + j];
            out[i] -= half[N * (M + i) + j] * p[j] + half[N * i + M + j] * q[j];
        }
    }
    dense_lu(M, A, pivot);
    dense_lu_solve(M, 1, A, pivot, out);
}

/* Energy of third order of two halves beside that of the whole, of the sizes of both: zero if and
 * only if the geometric stiffness is integrated over the exact linear solution, since the middle
 * node, being in equilibrium, may follow to first order only. */
static double third_order_apart(const section *c, double l0, beamw_twist_kind torsion,
                                unsigned features, unsigned seed)
{
    double d[N], halves[2][N], middle[7];
    nodes_increments(2, l0, 2, seed, d);
    middle_of(c, l0, torsion, d, d + NODE_COORDINATES, middle);
    memcpy(halves[0], d, NODE_COORDINATES * sizeof *d);
    memcpy(halves[0] + NODE_COORDINATES, middle, sizeof middle);
    memcpy(halves[1], middle, sizeof middle);
    memcpy(halves[1] + NODE_COORDINATES, d + NODE_COORDINATES, NODE_COORDINATES * sizeof *d);
    const double first = third_order(c, l0 / 2, torsion, features, halves[0]),
                 second = third_order(c, l0 / 2, torsion, features, halves[1]),
                 whole = third_order(c, l0, torsion, features, d);
    return fabs(first + second - whole) / (fabs(first) + fabs(second) + fabs(whole));
}

/* Buckling: under any prestress, with both theories of shear and all that couples. */
static void hyperbolic_twist_under_stress(void)
{
    const section c = unsymmetric();
    const unsigned all = FEATURE_SHEAR | FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_TRAPEZE |
                         FEATURE_WAGNER_MOMENTS;
    const double lengths[] = {0.03, 0.1, 0.3, 3, 30};
    for (int i = 0; i < 5; i++)
        for (int haringx = 0; haringx < 2; haringx++) {
            const unsigned features = all | (haringx ? FEATURE_HARINGX : FEATURE_ENGESSER);
            double exact = 0, cubic = 0;
            for (unsigned seed = 1; seed <= 10; seed++) {
                exact = worst_of(exact, third_order_apart(&c, lengths[i], BEAMW_TWIST_HYPERBOLIC,
                                                          features, seed));
                cubic = worst_of(
                    cubic, third_order_apart(&c, lengths[i], BEAMW_TWIST_CUBIC, features, seed));
            }
            gsl_test(
                !(exact < 1e-10 && cubic > 1e-8),
                "%g m, %s: geometric stiffness of one hyperbolic element is that of two (%.1e), "
                "of a cubic one not (%.1e)",
                lengths[i], haringx ? "haringx" : "engesser", exact, cubic);
        }
}

/* Functions and points for every lambda: limits, means, squares in closed form. */
static void twist_functions(void)
{
    section c = sheet();
    const double lambdas[] = {1e-8, 1e-3, 0.5, 1.9, 2.1, 30, 79, 81, 1e3, 1e4};
    for (size_t k = 0; k < sizeof lambdas / sizeof lambdas[0]; k++) {
        double x[BEAMW_TWIST_MAX_POINTS], w[BEAMW_TWIST_MAX_POINTS], even = 0, odd = 0, square = 0,
                                                                     turn = 0;
        c.Iw = c.shear_modulus * c.It * 1.3 * 1.3 / (c.young * lambdas[k] * lambdas[k]);
        const beamw_twist t = beamw_twist_of(&c, 1.3, 0, BEAMW_TWIST_HYPERBOLIC);
        const double h = t.lambda / 2, moment = 1 / (tanh(h) * t.lambda) -
                                                (h < 300 ? 1 / (2 * sinh(h) * sinh(h)) : 0);
        const int points = beamw_twist_points(&t, 0, 1, x, w);
        gsl_test_rel(t.lambda, lambdas[k], 1e-14, "lambda");
        for (int i = 0; i < points; i++) {
            const beamw_twist_shapes s = beamw_twist_at(&t, x[i]);
            even += w[i] * s.even;
            odd += w[i] * s.odd;
            square += w[i] * s.odd * s.odd;
            turn += w[i] * (s.odd_integral + (x[i] - 0.5) * s.odd); /* by parts: zero */
        }
        gsl_test(!(points > 0 && fabs(even) < 1e-13 && fabs(odd) < 1e-14 && fabs(turn) < 1e-14),
                 "lambda %g: means %.1e %.1e %.1e", lambdas[k], even, odd, turn);
        if (lambdas[k] > 0.1)
            gsl_test_rel(square, moment, 1e-12, "lambda %g: square of the odd rate", lambdas[k]);
        const beamw_twist_shapes end = beamw_twist_at(&t, 1), start_of = beamw_twist_at(&t, 0);
        gsl_test_rel(end.odd, -1, 1e-14, "lambda %g: odd rate at the end", lambdas[k]);
        gsl_test_rel(start_of.even, -1, 1e-12, "lambda %g: even rate at the end", lambdas[k]);
        gsl_test(fabs(end.odd_integral) + fabs(end.even_integral) > 1e-14,
                 "lambda %g: no turn at the end", lambdas[k]);
        if (lambdas[k] < 1e-2) {
            const beamw_twist_shapes hyperbolic = beamw_twist_at(&t, 0.3),
                                     cubic = beamw_twist_at(&(beamw_twist){.soft = 1}, 0.3);
            const double close = lambdas[k] * lambdas[k] + 1e-14;
            gsl_test_rel(hyperbolic.odd, cubic.odd, close, "odd -> linear");
            gsl_test_rel(hyperbolic.even, cubic.even, close, "even -> quadratic");
            gsl_test_rel(hyperbolic.odd_integral, cubic.odd_integral, close,
                         "turn of odd -> quadratic");
            gsl_test_rel(hyperbolic.even_integral, cubic.even_integral, close,
                         "turn of even -> cubic");
        }
    }
}

int main(void)
{
    hyperbolic_twist();
    hyperbolic_twist_under_stress();
    twist_functions();
    return gsl_test_summary();
}
