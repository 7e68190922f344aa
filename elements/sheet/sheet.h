#ifndef BEAMWORK_SHEET_SHEET_H
#define BEAMWORK_SHEET_SHEET_H

#include "elements/element.h"
#include "elements/field/field.h"
#include "elements/math/vec3.h"
#include "elements/shared/lanes.h"
#include "elements/shared/status.h"

/* Local coordinates of a two-node beam that is simply supported in a frame F that moves with it (N
 * Eqs. 12, 40, 42).
 *
 * F has the columns (n, j, k): n points from p to q, j is normal to n and to the z axis of p, and k
 * = n x j. In F, the triads of the nodes are F^T R^p = Ry(yp) Rz(zp) and F^T R^q = Ry(yq) Rz(zq)
 * Rx(px).
 */

/* Indices of the local coordinates: u, the elongation [m]; angles [rad] with the names of N, x for
 * twist, y and z for bending; W, the warping amplitudes [rad/m]. */
enum {
    SHEET_LOCAL_U,
    SHEET_LOCAL_PX,
    SHEET_LOCAL_YP,
    SHEET_LOCAL_YQ,
    SHEET_LOCAL_ZP,
    SHEET_LOCAL_ZQ,
    SHEET_LOCAL_WP,
    SHEET_LOCAL_WQ,
    SHEET_LOCAL_COORDINATES
};
enum { SHEET_LOCAL_NODAL = 2 * NODE_COORDINATES };

typedef struct sheet_local_state {
    real q[SHEET_LOCAL_COORDINATES];
    real F[9]; /* columns n j k */
    real l;    /* present distance of the nodes [m] */
    real tan_yp, sec_yp, cos_yq, sin_yq, tan_zq, sec_zq;
} sheet_local_state;

/* Computes the local coordinates. `chord` is the initial distance of the nodes [m], from which the
 * elongation is measured. F^T R^p = Ry(yp) Rz(zp), whose first row is n in the axes of p, and F^T
 * R^q = Ry(yq) Rz(zq) Rx(px). */
static inline void sheet_local_of(double chord, const node_real x[2], sheet_local_state *out)
{
    const real *p = x[0].R, *q = x[1].R;
    real d[3], moved[3], D[3], F[3][3], M[9];
    for (int i = 0; i < 3; i++) {
        d[i] = x[1].r[i] - x[0].r[i];
        moved[i] = x[1].u[i] - x[0].u[i];
    }
    mat3_transpose_mul_vec(p, d, D);
    const real l = real_sqrt(vec3_dot(d, d)), h = real_sqrt(D[0] * D[0] + D[1] * D[1]);
    for (int i = 0; i < 3; i++) {
        F[0][i] = d[i] / l;
        F[1][i] = (p[3 * i + 1] * D[0] - p[3 * i] * D[1]) / h;
    }
    vec3_cross(F[0], F[1], F[2]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out->F[3 * i + k] = F[k][i];
    mat3_transpose_mul(out->F, q, M);
    const real m = real_sqrt(M[0] * M[0] + M[6] * M[6]);
    out->l = l;
    out->q[SHEET_LOCAL_U] = vec3_elongation(d, moved, chord);
    out->q[SHEET_LOCAL_YP] = real_atan2(D[2], h);
    out->q[SHEET_LOCAL_ZP] = real_atan2(-D[1], D[0]);
    out->q[SHEET_LOCAL_YQ] = real_atan2(-M[6], M[0]);
    out->q[SHEET_LOCAL_ZQ] = real_atan2(M[3], m);
    out->q[SHEET_LOCAL_PX] = real_atan2(-M[5], M[4]);
    out->q[SHEET_LOCAL_WP] = x[0].a;
    out->q[SHEET_LOCAL_WQ] = x[1].a;
    out->tan_yp = D[2] / h;
    out->sec_yp = l / h;
    out->cos_yq = M[0] / m;
    out->sin_yq = -M[6] / m;
    out->tan_zq = M[3] / m;
    out->sec_zq = 1 / m;
}

/* The linear solution between the nodes as linear functionals of the local coordinates (N Eqs.
 * 14-19). */

/* Linear functionals, each a row[8] with value = row . q. Primes denote d/ds. */
typedef struct sheet_fields {
    double uy[SHEET_LOCAL_COORDINATES], duy[SHEET_LOCAL_COORDINATES],
        duz[SHEET_LOCAL_COORDINATES]; /* u_y [m], u_y', u_z' */
    double phi_x[SHEET_LOCAL_COORDINATES],
        dphi_x[SHEET_LOCAL_COORDINATES]; /* phi_x [rad], phi_x' [rad/m] */
    double phi_y[SHEET_LOCAL_COORDINATES], dphi_y[SHEET_LOCAL_COORDINATES];
    double phi_z[SHEET_LOCAL_COORDINATES], dphi_z[SHEET_LOCAL_COORDINATES];
} sheet_fields;

/* Returns 1 if phi_x is cubic (N Eq. 19), or 0 if it is linear because Iw = 0 or warping is not
 * requested. */
int sheet_fields_warp(const element_request *request);

/* Returns the fields at s = x l0. Phi_y and Phi_z are those of N Eq. 18, and `warp` is the value of
 * sheet_fields_warp. */
sheet_fields sheet_fields_at(double l0, double x, double Phi_y, double Phi_z, int warp);

/* Deformation functions of the elements of N: eight generalized strains that are quadratic in the
 * local coordinates, e_i = (Lambda q)_i + 1/2 q^T Q_i q (N Eq. 37), minus the values of the
 * stress-free element. The nodes of the stress-free element are on an arc of constant torsion and
 * curvature, with initial elongation and shear. (With the linear initial stresses of N Eq. 52, the
 * element would not be stress-free: reference/ERRATA.md.) */

enum {
    SHEET_STRAINS = 8,
    SHEET_STRAINS_LISTED = 6,
    SHEET_STRAINS_TERMS = SHEET_STRAINS_LISTED * 36
};

typedef struct sheet_strains_table {
    double chord;   /* chord of the undeformed arc [m] */
    double torsion; /* initial torsion, from which the warping amplitudes of the nodes are measured
                       [rad/m] */
    double rest[SHEET_STRAINS]; /* strains of the stress-free element, which are subtracted [m] */
    double Lambda[SHEET_STRAINS * SHEET_LOCAL_COORDINATES]; /* [m per coordinate] */
    int terms; /* number of nonzero entries jk and kj of Q_i for j <= k; Q_7 and Q_8, which equal
                  Q_2, are not listed */
    struct {
        double c;
        int i, j, k;
    } term[SHEET_STRAINS_TERMS];
} sheet_strains_table;

/* Prepares the strains. Phi_y and Phi_z are shear parameters of the displacement fields (N Eq. 18).
 * If both are 0, the strains are those of N Eq. 37, without shear deformation. If they are the
 * values of the section, the strains are consistent with shear (derived here). Of the features of
 * the request, warping and trapeze are used. REFUSED: the length is not positive. */
status sheet_strains_prepare(const element_request *request, double Phi_y, double Phi_z,
                             sheet_strains_table *out, fault *f);

/* Sets the strains of the stress-free element, from which strains are measured. */
void sheet_strains_set_rest(const element_request *request, sheet_strains_table *out);

/* Implements element_type.strain. */
void sheet_strains_evaluate(const sheet_strains_table *table, const node_state x[2],
                            strain_output *out);

/* Returns the shear parameters Phi_y and Phi_z of N Eq. 18, which are 0 for a section that is rigid
 * in shear. */
double sheet_elastic_phi_y(const section *c, double l0);
double sheet_elastic_phi_z(const section *c, double l0);

/* Computes the stiffness S[8 x 8] [N/m] of the linear solution (N Eqs. 33-36). */
void sheet_elastic_stiffness(const section *c, double l0, double Phi_y, double Phi_z,
                             double S[SHEET_STRAINS * SHEET_STRAINS]);

/* Nonuniform torsion of an element (N Eq. 51), in x = s/L with lambda = L sqrt(GJ/EIw).
 *
 * If the twist rate is zero at both ends, a torque t(x) causes the twist rate kappa = (lambda^2/GJ)
 * g, where lambda^2 g - g'' = t and g(0) = g(1) = 0. The bimoment is L g' (N App. B, with M_x as
 * given). Twist rates Wp, Wq of the ends without torque cause kappa = Wp h_p + Wq h_q, where h_q =
 * sinh(lambda x)/sinh(lambda) and h_p(x) = h_q(1 - x).
 *
 * After integration by parts, the Hellinger-Reissner potential of N Eq. 44 contains the bimoment
 * only in the integrals below, which have no cancellation for lambda -> 0 and for lambda -> inf. */

enum { SHEET_TORSION_DEGREE = 3, SHEET_TORSION_MODES = 5 };
enum { SHEET_TORSION_PX, SHEET_TORSION_WP, SHEET_TORSION_WQ, SHEET_TORSION_TWISTS };

typedef struct sheet_torsion_integrals {
    double compliance[SHEET_TORSION_MODES]
                     [SHEET_TORSION_MODES]; /* lambda^2 int t_k g_l dx, a symmetric matrix */
    /* int t_k (phi' - h) dx, where phi' is the twist rate due to a unit value of px/L, Wp or Wq in
     * N Eq. 19, and h is that of the ends without torque */
    double work[SHEET_TORSION_MODES][SHEET_TORSION_TWISTS];
    double same,
        other; /* products of h_p with itself and with h_q: int (lambda^2 h h + h' h') dx */
} sheet_torsion_integrals;

/* Computes the integrals for the torque modes t_k(x) = sum_i t[k][i] x^i with integer coefficients.
 * If lambda is INFINITY, there is no warping, and the twist rate is uniform. */
void sheet_torsion_integrate(double lambda,
                             const double t[SHEET_TORSION_MODES][SHEET_TORSION_DEGREE + 1],
                             sheet_torsion_integrals *out);

/* Wagner torque: the energy int E c kx^4 ds of a twisted wide section (N Eqs. 45, 46), with kx of N
 * Eq. 26. */

enum { SHEET_WAGNER_POINTS = 5, SHEET_WAGNER_STRAINS = 3 }; /* exact for degree 8 */

typedef struct sheet_wagner_term {
    int active;
    double weight[SHEET_WAGNER_POINTS]; /* E c ds [N m^5] */
    double rate[SHEET_WAGNER_POINTS]
               [SHEET_WAGNER_STRAINS]; /* kx for a unit value of e2, e7, e8 [1/m^2] */
} sheet_wagner_term;

/* Prepares the term. Returns REFUSED if the term is active and the element has initial torsion. */
status sheet_wagner_prepare(const element_request *request, sheet_wagner_term *out, fault *f);

/* Adds the Wagner torque to energy[1], sigma[8] and C[8 x 8], each of which may be NULL, for one
 * element or several in lanes. */
static inline void sheet_wagner_add(const sheet_wagner_term *w, const real e[SHEET_STRAINS],
                                    real *energy, real *sigma, real *C)
{
    static const int strain_of[SHEET_WAGNER_STRAINS] = {1, 6, 7};
    if (!w->active)
        return;
    for (int i = 0; i < SHEET_WAGNER_POINTS; i++) {
        const double *rate = w->rate[i];
        const real kx = rate[0] * e[1] + rate[1] * e[6] + rate[2] * e[7],
                   square = w->weight[i] * kx * kx;
        if (energy != NULL)
            *energy += square * kx * kx;
        for (int k = 0; k < SHEET_WAGNER_STRAINS; k++) {
            if (sigma != NULL)
                sigma[strain_of[k]] += 4 * square * kx * rate[k];
            for (int m = 0; m < SHEET_WAGNER_STRAINS && C != NULL; m++)
                C[SHEET_STRAINS * strain_of[k] + strain_of[m]] += 12 * square * rate[k] * rate[m];
        }
    }
}

/* Strains and stresses of several sheet elements at once, bit-for-bit identical to those of single
 * elements. These functions are members of element_type. The second function of each pair is for
 * processors with AVX2 (elements/math/real.h). */

typedef void sheet_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
sheet_lanes_strains sheet_lanes_strain_plain, sheet_lanes_strain_avx2;

typedef void sheet_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);
sheet_lanes_stresses sheet_lanes_second_plain, sheet_lanes_second_avx2;
sheet_lanes_stresses sheet_lanes_third_plain, sheet_lanes_third_avx2;

typedef void sheet_lanes_equations(int count, const element_data *const data[],
                                   const node_state x[], const double *const e[],
                                   const double *const inner[], const double *const s[],
                                   equations_output out[], status outcome[]);
sheet_lanes_equations sheet_lanes_second_equations_plain, sheet_lanes_second_equations_avx2;
sheet_lanes_equations sheet_lanes_third_equations_plain, sheet_lanes_third_equations_avx2;

typedef enum sheet_base_shear {
    SHEET_BASE_PRINTED,   /* N Eq. 37: strains without shear */
    SHEET_BASE_CONSISTENT /* the integrals of N Eq. 37 for the complete linear solution, including
                             shear (derived here) */
} sheet_base_shear;

typedef struct sheet_base_data {
    double S[SHEET_STRAINS * SHEET_STRAINS]; /* N Eqs. 33-36 [N/m] */
    field_mass mass;
    sheet_strains_table table;
    sheet_wagner_term wagner;
} sheet_base_data;

enum {
    SHEET_BASE_OFFERS = FEATURE_WARPING | FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_TORQUE |
                        FEATURE_GEOMETRIC | FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA |
                        FEATURE_CURVATURE,
    SHEET_BASE_LIMITS =
        LIMIT_DOUBLY_SYMMETRIC | LIMIT_ORDER_DEPENDENT | LIMIT_QUARTER_TURN | LIMIT_WARPING_RIGID
};

status sheet_base_prepare(const element_request *request, sheet_base_shear shear,
                          sheet_base_data *out, fault *f);

void sheet_base_strain(const element_data *d, const node_state x[], strain_output *out);
void sheet_base_strain_many(int count, const element_data *const data[], const node_state x[],
                            strain_output out[]);
status sheet_base_inertia(const element_data *d, const node_state x[],
                          const element_rotating_frame *frame, inertia_output *out);
int sheet_base_mass_of_field(const double options[]);
element_order sheet_base_order(element_analysis, const double options[]);

#define SHEET_BASE_TYPE                                                                            \
    .family = "sheet", .abi = ELEMENT_ABI, .order = sheet_base_order, .strain = sheet_base_strain, \
    .inertia = sheet_base_inertia, .spreads = 1, .mass_of_field = sheet_base_mass_of_field,        \
    .lanes = LANES_TOGETHER, .strain_many = sheet_base_strain_many
#define SHEET_BASE_WITHOUT_SHEAR                                                                   \
    .offers = SHEET_BASE_OFFERS, .shear_theories = SHEAR_OWN,                                      \
    .own_theory = "N Eq. 37: generalized strains that exclude shear (reference/ERRATA.md, N 37)"

/* Members of element_type for the second-order elements of N sections 2.3-2.4, which have a
 * quadratic deformation function and a linear stress function (N Eqs. 33-36). */

size_t sheet_second_data_size(const element_request *request);
status sheet_second_prepare(const element_request *request, sheet_base_shear shear,
                            element_data *out, fault *f);
status sheet_second_stress(const element_data *d, const double e[], const double inner[],
                           stress_output *out);
void sheet_second_stress_many(int count, const element_data *const data[], const double *const e[],
                              const double *const inner[], stress_output out[], status outcome[]);
void sheet_second_equations_many(int count, const element_data *const data[], const node_state x[],
                                 const double *const e[], const double *const inner[],
                                 const double *const s[], equations_output out[], status outcome[]);

#define SHEET_SECOND_TYPE                                                                          \
    SHEET_BASE_TYPE, .limits = SHEET_BASE_LIMITS, .data_size = sheet_second_data_size,             \
        .stress = sheet_second_stress, .stress_many = sheet_second_stress_many,                    \
        .equations_many = sheet_second_equations_many

/* Members of element_type for the third-order elements of N section 3. The deformation function is
 * that of the second-order element. The stress function is derived from the Hellinger-Reissner
 * potential P = P0 + 1/2 b^T A^-1 b, whose coefficients are integrated once per section and
 * length. */

size_t sheet_third_data_size(const element_request *request);
/* Prepares an element. If `printed` is 1, u_y has the sign of N Eq. 49 as printed. REFUSED:
 * sheet_base_prepare or sheet_coefficients_prepare rejects the request, there is an initial shear
 * strain along the thickness, or the initial curvature is too large for the length. */
status sheet_third_prepare(const element_request *request, int printed, element_data *out,
                           fault *f);
/* Returns SINGULAR if A is not positive definite for the strains e. */
status sheet_third_stress(const element_data *d, const double e[], const double inner[],
                          stress_output *out);
void sheet_third_stress_many(int count, const element_data *const data[], const double *const e[],
                             const double *const inner[], stress_output out[], status outcome[]);
void sheet_third_equations_many(int count, const element_data *const data[], const node_state x[],
                                const double *const e[], const double *const inner[],
                                const double *const s[], equations_output out[], status outcome[]);
void sheet_third_geometric(const element_data *d, const double sigma[], double G[]);
double sheet_third_tension(const element_data *d, const double sigma[]);

#define SHEET_THIRD_TYPE                                                                           \
    SHEET_BASE_TYPE, SHEET_BASE_WITHOUT_SHEAR,                                                     \
        .limits = SHEET_BASE_LIMITS | LIMIT_FLAT_ARC | LIMIT_TENSION, .lacks = LACKS_SHEAR_Y,      \
        .lacks_by = "N Eq. 50", .data_size = sheet_third_data_size, .stress = sheet_third_stress,  \
        .stress_many = sheet_third_stress_many, .equations_many = sheet_third_equations_many,      \
        .geometric = sheet_third_geometric, .tension = sheet_third_tension

#endif
