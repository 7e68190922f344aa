/* One element against an independent prototype, and one-element claims that are exact. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "elements/element.h"
#include "elements/math/dense.h"
#include "elements/math/rotation.h"
#include "elements/test/check_values.h"
#include "elements/test/sections.h"

extern const element_type element_beamw_first, element_beamw, element_beamw_vlasov,
    element_beamw_consistent;

/* The prototype's section; unit 1 = mm and kN. */
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
    compare("force", type->name, 14, force, expected->force,
            1e-12); /* determines sigma: J has full rank */
    compare("tangent", type->name, 14 * 14, H, expected->tangent, 1e-12);
}

/* C of a form at e = 0 is its linear stiffness. */
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

/* Cantilever of one element under tip forces and moments, It = 0: the coupled stiffness is nodally
 * exact.  Exact beam: bending (with torsion and warping) in the stress resultants of the shear
 * centre plus the constant shear strains F Q/G. */
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
    /* Root clamped with warping: the last seven coordinates remain. */
    double A[49], b[7] = {0, 1.3, -0.7, 40, 25, -60, 500};
    int pivot[7];
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++)
            A[NODE_COORDINATES * i + j] =
                K[2 * NODE_COORDINATES * (NODE_COORDINATES + i) + NODE_COORDINATES + j];
    const double Fy = b[1], Fz = b[2], Mx = b[3], My = b[4], Mz = b[5], B = b[6];
    gsl_test(dense_lu(7, A, pivot), "coupled stiffness of a cantilever is regular");
    dense_lu_solve(7, 1, A, pivot, b);
    /* Torque about the shear centre is Mx + zs Fy - ys Fz, carried by warping alone: EIw a'' = -T
     * etc. */
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

int main(void)
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
    return gsl_test_summary();
}
