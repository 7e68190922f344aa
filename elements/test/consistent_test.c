/* beamw_consistent must be exact for uniform strains of any size, and its derivatives must agree
 * with finite differences at large rotations. To second order, the strains without shear must agree
 * with J Eq. 66. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/beamw/fields.h"
#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/kit.h"

enum { N = 14, STRAINS = 8 };

typedef struct pair_subject {
    const element_type *type;
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
} pair_subject;

static const element_data *data_of(const pair_subject *s)
{
    return (const element_data *)s->store.bytes;
}

static void start_with(pair_subject *s, const element_type *type, const section *c, double l0,
                       unsigned features, const char *option, double value)
{
    double options[ELEMENT_MAX_OPTIONS] = {0};
    for (int i = 0; i < parameter_count(type->options); i++)
        options[i] = strcmp(parameter_at(type->options, i)->name, option) == 0
                         ? value
                         : parameter_at(type->options, i)->value;
    const element_request request = {
        .section = c, .length = l0, .features = features, .options = options};
    fault f;
    s->type = type;
    gsl_test(type->data_size(&request) > sizeof s->store, "%s: data fits", type->name);
    gsl_test(type->prepare(&request, (element_data *)s->store.bytes, &f) != STATUS_OK,
             "%s: prepared", type->name);
}

static void start(pair_subject *s, const element_type *type, const section *c, double l0,
                  unsigned features)
{
    start_with(s, type, c, l0, features, "", 0);
}

/* Returns a sheet without warping shear, which N neglects. */
static section sheet(void)
{
    section_spec spec = section_spec_rectangle(2e11, 7.7e10, 0.06, 0.02);
    spec.shear_factor[0] = spec.shear_factor[1] = 0.85;
    spec.sheet_warping = 1;
    section c = sections_computed(&spec);
    c.F[8] = 0;
    return c;
}

extern const element_type element_beamw, element_beamw_consistent, element_sheet_second_consistent;

static void modified(const pair_subject *s, const node_state x[2], double ebar[STRAINS])
{
    double e[STRAINS];
    s->type->strain(data_of(s), x, &(strain_output){.e = e});
    for (int k = 0; k < STRAINS; k++) {
        double unit[STRAINS] = {0}, Q[STRAINS * STRAINS] = {0}, row[STRAINS];
        unit[k] = 1;
        if (s->type->geometric != NULL)
            s->type->geometric(data_of(s), unit, Q);
        dense_mul_vec(STRAINS, STRAINS, Q, e, row);
        ebar[k] = e[k];
        for (int i = 0; i < STRAINS; i++)
            ebar[k] += row[i] * e[i] / 2;
    }
}

static void state(double l0, double small, int planar, node_state x[2])
{
    static const double turn[2][3] = {{0.31, -0.62, 0.47}, {-0.55, 0.83, 0.29}},
                        whole[3] = {0.4, -1.1, 0.7};
    double d[N] = {0}, q[4];
    for (int node = 0; node < 2; node++)
        for (int i = 0; i < 3; i++)
            d[NODE_COORDINATES * node + 3 + i] = planar && i == 1 ? 0 : small * turn[node][i];
    d[6] = small * 3.7;
    d[13] = small * -5.9;
    d[7] = 0.37 * l0 * small * small;
    nodes_place(2, l0, d, x);
    rotation_exp(whole, q);
    for (int node = 0; node < 2; node++) {
        const double initial[3] = {x[node].r[0] - x[node].u[0], x[node].r[1] - x[node].u[1],
                                   x[node].r[2] - x[node].u[2]};
        rotation_apply(q, x[node].r, x[node].r);
        nodes_turn(x[node].R, whole);
        for (int i = 0; i < 3; i++)
            x[node].u[i] = x[node].r[i] - initial[i];
    }
}

/* If strains are equal to second order, halving the displacements divides their difference by
 * eight. */
static void equal_to_second_order(const char *what, const pair_subject *a, const pair_subject *b,
                                  double l0, int planar, int strains)
{
    for (int k = 0; k < strains; k++) {
        double difference[2], largest = 0;
        for (int halved = 0; halved < 2; halved++) {
            node_state x[2];
            double one[STRAINS], other[STRAINS];
            state(l0, halved ? 0.005 : 0.01, planar, x);
            modified(a, x, one);
            modified(b, x, other);
            difference[halved] = fabs(one[k] - other[k]) / l0;
            if (!halved)
                largest = fabs(one[k]) / l0;
        }
        const double third = 1e-6;
        gsl_test(!(difference[0] < 2 * third &&
                   (difference[0] < 1e-15 || difference[1] < difference[0] / 7)),
                 "%s: strain %d (%.2e l0) differs by %.2e, with half the size by %.2e", what, k + 1,
                 largest, difference[0], difference[1]);
    }
}

static void same_element(void)
{
    const double l0 = 0.1;
    const section c = sheet();
    pair_subject consistent, other;
    const unsigned uniform = FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_TRAPEZE,
                   warped = uniform | FEATURE_WARPING;
    start(&consistent, &element_beamw_consistent, &c, l0, uniform);
    start(&other, &element_sheet_second_consistent, &c, l0, uniform);
    equal_to_second_order("sheet_second_consistent", &consistent, &other, l0, 0, 6);
    /* e7 and e8 of N contain int phi_y' phi_z, which is zero only for bending in one plane
     * (reference/ERRATA.md, N 37) */
    start(&consistent, &element_beamw_consistent, &c, l0, warped);
    start(&other, &element_sheet_second_consistent, &c, l0, warped);
    equal_to_second_order("sheet_second_consistent, warping", &consistent, &other, l0, 1, STRAINS);
    for (int haringx = 0; haringx < 2; haringx++) {
        const unsigned rigid =
            FEATURE_TRAPEZE | FEATURE_WARPING | (haringx ? FEATURE_HARINGX : FEATURE_ENGESSER);
        start(&consistent, &element_beamw_consistent, &c, l0, rigid);
        start(&other, &element_beamw, &c, l0, rigid);
        equal_to_second_order("J Eq. 66 without shear", &consistent, &other, l0, 0, STRAINS);
    }
}

static void uniform_strains(double size)
{
    const double l0 = 1.7, gamma[3] = {0.11 * size, -0.23 * size, 0.31 * size},
                 psi[3] = {0.5 * size, -0.9 * size, 0.7 * size};
    const section c = sheet();
    pair_subject s;
    start(&s, &element_beamw_consistent, &c, l0, FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_WARPING);
    /* r = int exp(x psi~) (e_x + gamma) l0 dx, by the closed form of the integral */
    const double U[3] = {l0 * (1 + gamma[0]), l0 * gamma[1], l0 * gamma[2]}, t = vec3_norm(psi);
    const double half = sin(t / 2), second = 2 * half * half / (t * t);
    const double third =
        t < 0.1 ? 1 / 6.0 - t * t / 120 + t * t * t * t / 5040 : (t - sin(t)) / (t * t * t);
    double once[3], twice[3], d[N] = {0}, e[STRAINS];
    node_state x[2];
    vec3_cross(psi, U, once);
    vec3_cross(psi, once, twice);
    for (int i = 0; i < 3; i++) {
        d[7 + i] = U[i] + second * once[i] + third * twice[i] - (i == 0 ? l0 : 0);
        d[10 + i] = psi[i];
    }
    d[6] = 0.3;
    d[13] = -0.2;
    nodes_place(2, l0, d, x);
    s.type->strain(data_of(&s), x, &(strain_output){.e = e});
    const double expected[STRAINS] = {l0 * gamma[0],
                                      l0 * psi[0],
                                      l0 * (psi[1] / 2 - gamma[2]),
                                      l0 * (psi[1] / 2 + gamma[2]),
                                      l0 * (psi[2] / 2 + gamma[1]),
                                      l0 * (psi[2] / 2 - gamma[1]),
                                      l0 * l0 * 0.3,
                                      l0 * l0 * -0.2};
    for (int k = 0; k < STRAINS; k++)
        gsl_test_abs(e[k], expected[k], 1e-14 * l0, "uniform strains, turn %.2f: e%d", t, k + 1);
}

static void pure_bending(void)
{
    const double l0 = 1.3, turn = 2.9;
    const section c = sheet();
    pair_subject s;
    start(&s, &element_beamw_consistent, &c, l0,
          FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_WARPING | FEATURE_TRAPEZE);
    double d[N] = {0}, e[STRAINS], energy;
    node_state x[2];
    d[7] = l0 * (sin(turn) / turn - 1);
    d[8] = l0 * (1 - cos(turn)) / turn;
    d[12] = turn;
    nodes_place(2, l0, d, x);
    s.type->strain(data_of(&s), x, &(strain_output){.e = e});
    s.type->stress(data_of(&s), e, NULL, &(stress_output){.energy = &energy});
    gsl_test_rel(energy, c.young * c.Iz * turn * turn / (2 * l0), 1e-12, "pure bending by %.1f",
                 turn);
}

static void derivatives(double size)
{
    static const double s[STRAINS] = {0.7, -1.1, 0.4, 0.9, -0.3, 1.3, 0.2, -0.5};
    static const double v[N] = {0.3,  -0.7, 0.2, 0.5,  -0.4, 0.8, 1.1,
                                -0.6, 0.1,  0.9, -0.2, 0.6,  0.3, -0.8};
    static const double there[N] = {0,    0,   0,    0.1, -0.2, 0.3, 0.1,
                                    -0.4, 0.7, -0.3, 1.2, -0.9, 1.4, 0.2};
    const double l0 = 1.7;
    const section c = sheet();
    pair_subject of;
    double d[N];
    node_state x[2];
    start(&of, &element_beamw_consistent, &c, l0,
          FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_WARPING);
    for (int i = 0; i < N; i++)
        d[i] = size * there[i];
    nodes_place(2, l0, d, x);
    const nodes_departure found = nodes_differences(of.type, data_of(&of), 2, STRAINS, x, v, s);
    gsl_test(!(found.first < 1e-10), "J at size %g (%.1e)", size, found.first);
    gsl_test(!(found.second < 1e-10), "H at size %g (%.1e)", size, found.second);
}

/* Internal modes that depend on the stress reduce the energy by terms of fourth order, so halving
 * the displacements must divide the reduction by sixteen. */
static void inside_follows(void)
{
    const double l0 = 0.1;
    const section c = sheet();
    for (int haringx = 0; haringx < 2; haringx++) {
        const unsigned features = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WARPING |
                                  (haringx ? FEATURE_HARINGX : FEATURE_ENGESSER);
        double gain[2];
        for (int halved = 0; halved < 2; halved++) {
            node_state x[2];
            double e[STRAINS], energy[2];
            state(l0, halved ? 0.005 : 0.01, 0, x);
            for (int following = 0; following < 2; following++) {
                pair_subject s;
                start_with(&s, &element_beamw_consistent, &c, l0, features, "inside", following);
                s.type->strain(data_of(&s), x, &(strain_output){.e = e});
                gsl_test(s.type->stress(data_of(&s), e, NULL,
                                        &(stress_output){.energy = &energy[following]}) !=
                             STATUS_OK,
                         "inside: evaluated");
            }
            gain[halved] = (energy[0] - energy[1]) / energy[0];
        }
        gsl_test(!(gain[0] > 1e-7 && fabs(gain[0] / gain[1] - 4) < 0.2),
                 "inside that follows: %.2e of the energy, %.2e halved", gain[0], gain[1]);
    }
}

static void inside_compressed(void)
{
    static const double v[STRAINS] = {0.1, -0.7, 0.6, 0.5, -0.9, 0.4, 0.3, 0.8};
    const double l0 = 2, h = 1e-7 * l0;
    const section c = sheet();
    double C[STRAINS * STRAINS], sigma[3][STRAINS], energy[3], Cv[STRAINS], work = 0;
    pair_subject s;
    start(&s, &element_beamw_consistent, &c, l0,
          FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_WARPING | FEATURE_TRAPEZE);
    for (int side = -1; side <= 1; side++) {
        double e[STRAINS] = {-0.9, 0, 1e-3, 1.1e-3, -1e-3, -0.9e-3, 0, 0};
        for (int i = 0; i < STRAINS; i++)
            e[i] = l0 * e[i] + side * h * v[i];
        gsl_test(s.type->stress(data_of(&s), e, NULL,
                                &(stress_output){.energy = &energy[side + 1],
                                                 .sigma = sigma[side + 1],
                                                 .C = side == 0 ? C : NULL}) != STATUS_OK,
                 "compressed inside: evaluated");
    }
    dense_mul_vec(STRAINS, STRAINS, C, v, Cv);
    for (int i = 0; i < STRAINS; i++) {
        const double size = vec3_norm(Cv);
        work += sigma[1][i] * v[i];
        gsl_test(!(fabs((sigma[2][i] - sigma[0][i]) / (2 * h) - Cv[i]) < 1e-6 * size),
                 "compressed inside: C in the direction of e%d is %.10g, differences %.10g", i + 1,
                 Cv[i], (sigma[2][i] - sigma[0][i]) / (2 * h));
    }
    gsl_test_rel(work, (energy[2] - energy[0]) / (2 * h), 1e-6, "compressed inside: work");
}

static void consistent_tests(void)
{
    same_element();
    inside_compressed();
    inside_follows();
    const double sizes[] = {1e-9, 1e-3, 0.3, 0.8,
                            0.81, 1,    2.3}; /* the element rotates by 1.24 times this value */
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        uniform_strains(sizes[i]);
    pure_bending();
    const double turns[] = {0, 1e-9, 0.01, 0.4, 0.5, 0.7, 1.2};
    for (size_t i = 0; i < sizeof turns / sizeof turns[0]; i++)
        derivatives(turns[i]);
}

extern const element_type element_beamw_consistent;

static section unsymmetric(void)
{
    static const double point[5][2] = {{0, 0}, {0.05, 0}, {0.05, 0.08}, {0.02, 0.08}, {0.05, 0.1}};
    static const int wall[4][2] = {{0, 1}, {1, 2}, {2, 3}, {2, 4}};
    static const double thickness[4] = {0.002, 0.003, 0.004, 0.001};
    const section_spec spec = section_spec_walls(2.1e11, 8e10, 4, point, wall, thickness);
    return sections_computed(&spec);
}

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

/* Returns the largest difference between the stiffness of one element and that of two halves with
 * their common node eliminated. The difference is zero if and only if the linear solution between
 * the nodes is exact. Each coordinate is scaled by the square root of its stiffness. */
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

/* Returns the third-order energy 1/2 sum_i s_i (d . H_i d + e . Q_i e) for the displacement d [14]
 * of the nodes, where e = J d and s = S e. This is the contribution of a prestress proportional to
 * d. */
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

/* Returns the difference of the third-order energies of two halves and of the whole, relative to
 * their magnitude. The difference is zero if and only if the geometric stiffness is integrated over
 * the exact linear solution. */
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
            turn += w[i] * (s.odd_integral + (x[i] - 0.5) * s.odd);
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

static void twist_tests(void)
{
    hyperbolic_twist();
    hyperbolic_twist_under_stress();
    twist_functions();
}

int main(void)
{
    consistent_tests();
    twist_tests();
    return gsl_test_summary();
}
