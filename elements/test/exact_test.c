#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/chain.h"
#include "elements/test/check_values.h"
#include "elements/test/kit.h"

extern const element_type element_geometrically_exact, element_collocation;

enum { MOST = ELEMENT_MAX_COORDINATES, STRAINS = ELEMENT_MAX_STRAINS };

static section steel(double width, double height)
{
    section_spec spec = section_spec_rectangle(200e9, 200e9 / 2.6, width, height);
    spec.given.Iw = pow(width * height, 3) / 144;
    spec.shear_factor[0] = spec.shear_factor[1] = 13.0 / 15.3;
    return sections_computed(&spec);
}

static section products(double EA, double GA, double GJ, double EI)
{
    section c;
    memset(&c, 0, sizeof c);
    c.young = c.shear_modulus = 1;
    c.A = EA;
    c.It = GJ;
    c.Iy = c.Iz = EI;
    c.Ip = 2 * EI;
    c.F[0] = c.F[4] = GA > 0 ? 1 / GA : 0;
    return c;
}

static void derivatives(const element_type *type, const double option[], double size)
{
    chain c;
    double d[MOST], weight[STRAINS], asymmetry = 0;
    nodes_departure worst = {0, 0, 0};
    const section s = steel(0.1, 0.00225);
    chain_start(&c, type, option, &s, 0.1, 1, FEATURE_SHEAR | FEATURE_WARPING);
    nodes_increments(c.per_element, 0.1, size, 91, d);
    nodes_move(c.per_element, 1, d, c.x);
    for (int i = 0; i < c.strains; i++)
        weight[i] = cos(3.7 * i + 0.3);
    for (unsigned seed = 1; seed <= 8; seed++) {
        nodes_increments(c.per_element, 0.1, 1, seed, d);
        const nodes_departure found =
            nodes_differences(type, chain_data(&c), c.per_element, c.strains, c.x, d, weight);
        worst.first = worst_of(worst.first, found.first);
        worst.second = worst_of(worst.second, found.second);
        asymmetry = found.asymmetry;
    }
    gsl_test(!(worst.first < 1e-11), "%s: J at %g rad (%.1e)", type->name, size, worst.first);
    gsl_test(!(worst.second < 1e-11), "%s: H at %g rad (%.1e)", type->name, size, worst.second);
    gsl_test(!(asymmetry < 1e-15), "%s: H is symmetric (%.1e)", type->name, asymmetry);
}

/* Computes the tip displacement u[2] of a Simo-Reissner cantilever: L = 1, EI = 10, transverse dead
 * force 10. */
static void shear_elastica(const element_type *type, const double option[], double GA, int n,
                           double u[2])
{
    chain c;
    const section s = products(1e9, GA, 10, 10);
    chain_start(&c, type, option, &s, 1, n, FEATURE_SHEAR | FEATURE_HARINGX | FEATURE_LARGE);
    const double none[7] = {0};
    for (int i = 1; i <= 4; i++) {
        const double load[7] = {0, 2.5 * i};
        gsl_test(!(chain_solve(&c, none, load) < 1e-10), "%s: shear_elastica converges",
                 type->name);
    }
    u[0] = c.x[c.nodes - 1].u[0];
    u[1] = c.x[c.nodes - 1].u[1];
}

static void check_order(const element_type *type, const char *what, const double value[2],
                        double exact, double error, double order)
{
    const double before = fabs(value[0] / exact - 1), now = fabs(value[1] / exact - 1),
                 observed = log2(before / now);
    gsl_test(!(now <= error), "%s: %s: error %.2e", type->name, what, now);
    gsl_test(!(observed > order), "%s: %s: order %.2f", type->name, what, observed);
}

static void shear_elastica_converges(const element_type *type, const double option[], int n,
                                     double error, double order)
{
    double coarse[2], fine[2];
    shear_elastica(type, option, 500, n, coarse);
    shear_elastica(type, option, 500, 2 * n, fine);
    check_order(type, "shear_elastica u", (const double[2]){coarse[0], fine[0]}, -0.061315655943,
                error, order);
    check_order(type, "shear_elastica v", (const double[2]){coarse[1], fine[1]}, 0.317813875879,
                error, order);
}

/* Solves the sheet flexure of N section 4.1. The tip is displaced transversely without rotation,
 * and warping is restrained at both ends. */
static void sheet(const element_type *type, const double option[], int n, double deflection,
                  double C[2])
{
    chain c;
    double compliance[36];
    const section s = steel(0.1, 0.00225);
    chain_start(&c, type, option, &s, 0.1, n,
                FEATURE_SHEAR | FEATURE_WARPING | FEATURE_TRAPEZE | FEATURE_HARINGX |
                    FEATURE_LARGE);
    c.held[1] = c.held[5] = c.held[6] = 1;
    const double none[7] = {0}, step[7] = {0, deflection / 5};
    for (int i = 1; i <= 5; i++)
        gsl_test(!(chain_solve(&c, step, none) < 1e-10), "%s: sheet converges", type->name);
    chain_compliance(&c, compliance);
    C[0] = compliance[0];
    C[1] = compliance[14];
}

static void sheet_converges(const element_type *type, const double option[], int n, double error,
                            double order)
{
    double coarse[2], fine[2];
    sheet(type, option, n, 0.015, coarse);
    sheet(type, option, 2 * n, 0.015, fine);
    check_order(type, "sheet C_xx", (const double[2]){coarse[0], fine[0]}, 3.972596107e-7, error,
                order);
    check_order(type, "sheet C_zz", (const double[2]){coarse[1], fine[1]}, 2.620413704e-8, error,
                order);
}

/* Rolls a cantilever up to a full circle by an end moment. Returns the distance of the tip from the
 * root, which should be zero. */
static double roll_up(const element_type *type, const double option[], int n)
{
    chain c;
    const section s = products(1e6, 0, 1, 1);
    chain_start(&c, type, option, &s, 1, n, FEATURE_LARGE);
    const double none[7] = {0};
    for (int i = 1; i <= 10; i++) {
        const double load[7] = {0, 0, 0, 0, 0, 0.62831853071795864769 * i};
        gsl_test(!(chain_solve(&c, none, load) < 1e-10), "%s: roll_up converges", type->name);
    }
    return hypot(c.x[c.nodes - 1].r[0], c.x[c.nodes - 1].r[1]);
}

static void one_element(const element_type *type, double stages, double deflection,
                        const double exact[2], const double error[2])
{
    double C[2];
    sheet(type, &stages, 1, deflection, C);
    for (int i = 0; i < 2; i++)
        gsl_test(!(fabs(C[i] / exact[i] - 1) <= error[i]),
                 "%s: %s of one sheet with %g stages moved by %g m: error %.2e", type->name,
                 i == 0 ? "C_xx" : "C_zz", stages + 3, deflection, C[i] / exact[i] - 1);
}

static void geometrically_exact(void)
{
    const element_type *type = &element_geometrically_exact;
    const double two[1] = {0}, three[1] = {1};
    for (int i = 0; i < 4; i++) {
        const double size[4] = {0, 1e-3, 0.4, 1.5};
        derivatives(type, two, size[i]);
        derivatives(type, three, size[i]);
    }
    shear_elastica_converges(type, two, 8, 7e-4, 1.99);
    shear_elastica_converges(type, three, 4, 8e-6, 3.9);
    sheet_converges(type, two, 16, 2e-3, 1.95);
    sheet_converges(type, three, 4, 5e-4, 3.8);
    const double closed = roll_up(type, two, 6),
                 circle[2] = {roll_up(type, three, 4), roll_up(type, three, 8)};
    gsl_test(!(closed < 1e-13), "%s: regular polygons close (%.1e)", type->name, closed);
    gsl_test(!(circle[1] < 2e-4 && circle[0] / circle[1] > 15),
             "%s: three nodes close the circle (%.1e, %.1e)", type->name, circle[0], circle[1]);
}

static void collocation(void)
{
    const element_type *type = &element_collocation;
    const double three[1] = {0}, four[1] = {1}, five[1] = {2};
    const double small[2] = {3.972596107351e-7, 2.620413704209e-8},
                 large[2] = {1.832361796194e-6, 1.287708251249e-7};
    derivatives(type, five, 0.4);
    shear_elastica_converges(type, three, 4, 2e-9, 5.7);
    sheet_converges(type, three, 4, 8e-7, 6);
    sheet_converges(type, four, 3, 2e-8, 7);
    one_element(type, 1, 0.015, small, (const double[2]){4.0e-4, 8.8e-4});
    one_element(type, 2, 0.015, small, (const double[2]){5.7e-6, 7.8e-5});
    one_element(type, 3, 0.015, small, (const double[2]){4.0e-7, 2.3e-5});
    one_element(type, 5, 0.015, small, (const double[2]){3.0e-10, 1.2e-8});
    one_element(type, 2, 0.05, large, (const double[2]){2.8e-4, 2.5e-4});
    one_element(type, 5, 0.05, large, (const double[2]){3.6e-7, 2.7e-6});
    const double circle[2] = {roll_up(type, five, 2), roll_up(type, five, 4)};
    gsl_test(!(circle[1] < 1e-10 && circle[0] / circle[1] > 900),
             "%s: two and four elements close the circle (%.1e, %.1e)", type->name, circle[0],
             circle[1]);
}

static void exact_tests(void)
{
    geometrically_exact();
    collocation();
}

extern const element_type element_beamw_first, element_beamw, element_beamw_vlasov,
    element_beamw_consistent;

static section check_section(void)
{
    static const double point[5][2] = {{0, 0}, {50, 0}, {50, 80}, {20, 80}, {50, 100}};
    static const int wall[4][2] = {{0, 1}, {1, 2}, {2, 3}, {2, 4}};
    static const double thickness[4] = {2, 3, 4, 1};
    section_spec spec = section_spec_walls(210, 80, 4, point, wall, thickness);
    spec.density = 7.85e-9;
    return sections_computed(&spec);
}

static void check_state_of(double l, node_state x[2])
{
    for (int node = 0; node < 2; node++) {
        double q[4];
        const double *step = check_state + NODE_COORDINATES * node;
        memcpy(x[node].u, step, sizeof x[node].u);
        memcpy(x[node].r, step, sizeof x[node].r);
        x[node].r[0] += node * l;
        rotation_exp(step + 3, q);
        rotation_matrix(q, x[node].R);
        x[node].a = step[6];
    }
}

static void compare(const char *what, const char *name, int n, const double got[],
                    const double expected[], double tolerance)
{
    double scale = 0, worst = 0;
    for (int i = 0; i < n; i++)
        scale = fmax(scale, fabs(expected[i]));
    for (int i = 0; i < n; i++)
        worst = fmax(worst, fabs(got[i] - expected[i]) / scale);
    gsl_test(!(worst <= tolerance), "%s: %s agrees with the prototype (%.1e)", name, what, worst);
}

static void check_form_of(const element_type *type, const check_form *expected)
{
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
    element_data *data = (element_data *)store.bytes;
    const section c = check_section();
    const double lumped[ELEMENT_MAX_OPTIONS] = {0};
    const element_request request = {.section = &c,
                                     .length = 300,
                                     .features = type->offers & ~FEATURE_HARINGX,
                                     .options = lumped};
    fault f;
    gsl_test(type->data_size(&request) > sizeof store, "%s: data fits", type->name);
    gsl_test(type->prepare(&request, data, &f) != STATUS_OK, "%s: prepared", type->name);
    node_state x[2];
    check_state_of(300, x);
    double e[8], J[8 * 14], H[14 * 14], sigma[8], C[64], energy, force[14] = {0}, work[8 * 14];
    type->strain(data, x, &(strain_output){.e = e, .J = J});
    type->stress(data, e, NULL, &(stress_output){.energy = &energy, .sigma = sigma, .C = C});
    type->strain(data, x, &(strain_output){.s = sigma, .H = H});
    dense_add_transpose_mul(14, 8, 1, J, sigma, force);
    dense_add_congruence(8, 14, J, C, H, work);
    compare("e", type->name, 8, e, expected->e, 1e-14);
    compare("energy", type->name, 1, &energy, &expected->energy, 1e-12);
    compare("force", type->name, 14, force, expected->force, 1e-12);
    compare("tangent", type->name, 14 * 14, H, expected->tangent, 1e-12);
}

static void linear_stiffness(const element_type *type, const section *c, double l, unsigned without,
                             double S[64])
{
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
    element_data *data = (element_data *)store.bytes;
    const double lumped[ELEMENT_MAX_OPTIONS] = {0}, e[8] = {0};
    const element_request request = {
        .section = c, .length = l, .features = type->offers & ~without, .options = lumped};
    fault f;
    gsl_test(type->prepare(&request, data, &f) != STATUS_OK, "%s: prepared", type->name);
    type->stress(data, e, NULL, &(stress_output){.C = S});
}

static void one_element_is_exact(void)
{
    section c = check_section();
    c.It = 0;
    const double l = 300, G = c.shear_modulus, E = c.young;
    double S[64], L[8][14] = {{0}}, K[14 * 14] = {0}, work[8 * 14];
    linear_stiffness(&element_beamw_consistent, &c, l, FEATURE_HARINGX, S);
    node_state x[2] = {{.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                       {.r = {l, 0, 0}, .R = {1, 0, 0, 0, 1, 0, 0, 0, 1}}};
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
    element_data *data = (element_data *)store.bytes;
    const double lumped[ELEMENT_MAX_OPTIONS] = {0};
    const element_request request = {
        .section = &c, .length = l, .features = FEATURE_WARPING | FEATURE_SHEAR, .options = lumped};
    fault f;
    element_beamw_consistent.prepare(&request, data, &f);
    element_beamw_consistent.strain(data, x, &(strain_output){.J = &L[0][0]});
    dense_add_congruence(8, 14, &L[0][0], S, K, work);
    double A[49], b[7] = {0, 1.3, -0.7, 40, 25, -60, 500};
    int pivot[7];
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++)
            A[NODE_COORDINATES * i + j] =
                K[2 * NODE_COORDINATES * (NODE_COORDINATES + i) + NODE_COORDINATES + j];
    const double Fy = b[1], Fz = b[2], Mx = b[3], My = b[4], Mz = b[5], B = b[6];
    gsl_test(dense_lu(7, A, pivot), "coupled stiffness of a cantilever is regular");
    dense_lu_solve(7, 1, A, pivot, b);
    /* the torque about the shear centre is Mx + zs Fy - ys Fz, which only warping resists: EIw a''
     * = -T */
    const double T = Mx + c.zs * Fy - c.ys * Fz, Q[3] = {Fy, Fz, T};
    double g[3];
    mat3_mul_vec(c.F, Q, g);
    for (int i = 0; i < 3; i++)
        g[i] /= G;
    const double theta_z = (Fy * l * l / 2 + Mz * l) / (E * c.Iz),
                 theta_y = (-Fz * l * l / 2 + My * l) / (E * c.Iy);
    const double a = (T * l * l / 2 + B * l) / (E * c.Iw);
    const double vs = (Fy * l * l * l / 3 + Mz * l * l / 2) / (E * c.Iz) + g[0] * l,
                 ws = (Fz * l * l * l / 3 - My * l * l / 2) / (E * c.Iy) + g[1] * l;
    const double phi = (T * l * l * l / 3 + B * l * l / 2) / (E * c.Iw) + g[2] * l;
    const double exact[7] = {0, vs + c.zs * phi, ws - c.ys * phi, phi, theta_y, theta_z, a};
    for (int i = 1; i < 7; i++)
        gsl_test_rel(b[i], exact[i], 1e-9,
                     "one coupled element of an unsymmetric cantilever is exact, coordinate %d", i);
}

static void rigid_motion(void)
{
    const section c = check_section();
    union {
        double align;
        unsigned char bytes[1 << 15];
    } store;
    element_data *data = (element_data *)store.bytes;
    const double lumped[ELEMENT_MAX_OPTIONS] = {0}, l = 300, turn[3] = {0.7, -1.9, 2.3},
                 shift[3] = {231.7, -87.9, 512.3};
    const element_request request = {
        .section = &c, .length = l, .features = element_beamw.offers, .options = lumped};
    fault f;
    element_beamw.prepare(&request, data, &f);
    node_state x[2];
    double q[4], e[8];
    rotation_exp(turn, q);
    for (int node = 0; node < 2; node++) {
        const double at[3] = {node * l, 0, 0};
        rotation_matrix(q, x[node].R);
        rotation_apply(q, at, x[node].r);
        for (int i = 0; i < 3; i++) {
            x[node].r[i] += shift[i];
            x[node].u[i] = x[node].r[i] - at[i];
        }
        x[node].a = 0;
    }
    element_beamw.strain(data, x, &(strain_output){.e = e});
    for (int i = 0; i < 8; i++)
        gsl_test_abs(e[i] / l, 0, 1e-14, "rigid motion leaves e%d alone", i + 1);
}

static void element_check_tests(void)
{
    double S[64];
    const section c = check_section();
    linear_stiffness(&element_beamw, &c, 300, FEATURE_HARINGX, S);
    compare("stiffness (App. A)", "beamw", 64, S, check_stiffness[0], 1e-13);
    linear_stiffness(&element_beamw_consistent, &c, 300, FEATURE_HARINGX, S);
    compare("coupled stiffness", "beamw_consistent", 64, S, check_coupled_stiffness[0], 1e-12);
    check_form_of(&element_beamw_first, &check_beamw_first);
    check_form_of(&element_beamw, &check_beamw);
    check_form_of(&element_beamw_vlasov, &check_beamw_vlasov);
    one_element_is_exact();
    rigid_motion();
}

int main(void)
{
    exact_tests();
    element_check_tests();
    return gsl_test_summary();
}
