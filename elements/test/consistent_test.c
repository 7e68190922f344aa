/* beamw_consistent: uniform strains of any size, derivatives at large turns, and to second order
 * the same element as J Eq. 66 without shear and as the sheet element that is consistent with
 * shear. */
#include "elements/test/pair.h"

extern const element_type element_beamw, element_beamw_consistent, element_sheet_second_consistent;

/* ebar_k = e_k + 1/2 e^T Q_k e, Q_k being the geometric stiffness of a unit stress. */
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

/* Local coordinates of size `small`, after a turn of the whole; the elongation of its square (N
 * counts it so). */
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

/* The difference of two elements' strains falls by eight when the state is halved: equal to second
 * order. */
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
        const double third = 1e-6; /* small^3 */
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
    /* N's e7 and e8 contain int phi_y' phi_z, which only bending in one plane leaves zero
     * (reference/ERRATA.md, N 37). */
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

/* A helix with extension and shear: e = (gamma, kappa) times lengths, whatever their size. */
static void uniform_strains(double size)
{
    const double l0 = 1.7, gamma[3] = {0.11 * size, -0.23 * size, 0.31 * size},
                 psi[3] = {0.5 * size, -0.9 * size, 0.7 * size};
    const section c = sheet();
    pair_subject s;
    start(&s, &element_beamw_consistent, &c, l0, FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_WARPING);
    /* r = int exp(x psi~) (e_x + gamma) l0 dx, closed form of the exponential's integral */
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

/* Pure bending by less than half a turn: no work but that of bending, so any number of elements
 * rolls up exactly. */
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

/* Gradient and second derivatives at nodes that are far apart and far turned. */
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

/* An inside that follows the stress has less energy, by terms of fourth order: sixteen times less
 * when the state is halved. */
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

/* Stiffness and stresses where so much compression is left that bending hardly counts in the modes
 * inside: their Hessian is factorised with pivots. */
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

int main(void)
{
    same_element();
    inside_compressed();
    inside_follows();
    const double sizes[] = {1e-9, 1e-3, 0.3, 0.8, 0.81, 1, 2.3}; /* turns by 1.24 times that */
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        uniform_strains(sizes[i]);
    pure_bending();
    const double turns[] = {0, 1e-9, 0.01, 0.4, 0.5, 0.7, 1.2};
    for (size_t i = 0; i < sizeof turns / sizeof turns[0]; i++)
        derivatives(turns[i]);
    return gsl_test_summary();
}
