#ifndef BEAMWORK_GEOMETRICALLY_EXACT_EXACT_H
#define BEAMWORK_GEOMETRICALLY_EXACT_EXACT_H

#include "elements/element.h"
#include "elements/math/vec3.h"
#include "elements/shared/beam_constants.h"

/* Measure of the rotation between two nodes, in lanes (real.h): a vector along the rotation axis,
 * whose length is a function of the angle. */

typedef enum exact_measure_kind {
    EXACT_MEASURE_QUARTER, /* length 4 tan(angle/4): value of the interpolated quaternion in the
                              middle of two nodes */
    EXACT_MEASURE_ANGLE,   /* length equal to the angle */
    EXACT_MEASURE_EIGHTH   /* length 8 tan(angle/8) */
} exact_measure_kind;

/* Computes the factor m for which 4 m y is the angle, where y = tan(angle/4), and the first and
 * second derivatives of m with respect to t = y^2. */
void exact_measure_angle(double t, double m[3]);

/* Computes the factor m and its derivatives of the measure `kind`. x is the measure
 * EXACT_MEASURE_QUARTER of the rotation. */
static inline void exact_measure_ratio(exact_measure_kind kind, const real x[3], real m[3])
{
    const real t = vec3_dot(x, x) * (1.0 / 16);
    if (kind == EXACT_MEASURE_EIGHTH) { /* factor 2 tan(angle/8)/tan(angle/4) */
        const real r = real_sqrt(1 + t), s = 1 + r;
        m[0] = 2 / s;
        m[1] = -1 / (r * s * s);
        m[2] = (1 + 3 * r) / (2 * (r * r * r) * (s * s * s));
        return;
    }
    for (int lane = 0; lane < LANES; lane++) {
        double one[3];
        exact_measure_angle(real_lane(&t, lane), one);
        for (int i = 0; i < 3; i++)
            real_put(&m[i], lane, one[i]);
    }
}

/* Computes the measure for x [3] and its derivative T [3 x 3]. */
static inline void exact_measure_of(const real m[3], const real x[3], real out[3], real T[9])
{
    const real slope = m[1] * 0.125;
    for (int i = 0; i < 3; i++) {
        out[i] = m[0] * x[i];
        for (int j = 0; j < 3; j++)
            T[3 * i + j] = slope * x[i] * x[j];
        T[4 * i] += m[0];
    }
}

/* Computes the second derivative [3 x 3] of n . measure(x). */
static inline void exact_measure_second(const real m[3], const real x[3], const real n[3],
                                        real H[9])
{
    const real along = vec3_dot(n, x), slope = m[1] * 0.125, bent = m[2] * (1.0 / 64) * along;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            H[3 * i + j] = slope * (n[i] * x[j] + x[i] * n[j]) + bent * x[i] * x[j];
        H[4 * i] += slope * along;
    }
}

/* Strains of the Simo-Reissner beam at points of an element, computed from interpolated quaternions
 * of the nodes (deformed.h). From e[6 g] on, the strains of point g are l0 gamma (3) with gamma =
 * R^T r' - e_x, and l0^2 kappa (3), where l0 kappa is the rotation measure of the line. From e[6
 * points] on, the strains are l0^2 a of each node. All strains are in [m] and are relative to their
 * values in the undeformed state, which may be curved. */

enum { EXACT_MAX_NODES = 3, EXACT_STRAIN_MAX_POINTS = 2 };

typedef struct exact_strain_line {
    int nodes, points;
    double l0; /* [m] */
    exact_measure_kind rotation;
    double N[EXACT_STRAIN_MAX_POINTS][EXACT_MAX_NODES],
        dN[EXACT_STRAIN_MAX_POINTS][EXACT_MAX_NODES]; /* dN: derivatives with respect to x/l0 */
    double initial[EXACT_STRAIN_MAX_POINTS]
                  [3]; /* R^T r' minus `rest`, in the stress-free element */
    /* dimensionless R^T r' and rotation measure on the arc without initial strain */
    double rest[EXACT_STRAIN_MAX_POINTS][6];
} exact_strain_line;

/* Prepares Gauss points between evenly spaced nodes, for constant initial curvature [1/m] and
 * strain. The strains of the stress-free element are zero. */
void exact_strain_prepare(int nodes, int points, double l0, const double curvature[3],
                          const double strain[3], exact_measure_kind rotation,
                          exact_strain_line *line);

/* Energy as a function of the strains. Each Gauss point represents a part of the element (reduced
 * integration, without locking). With ebar = e + 1/2 (e . Q_g e) r_g, the energy is 1/2 ebar . S
 * ebar plus the quartic term of the Wagner torque.
 *
 * Fields that do not depend on the nodes are eliminated in advance:
 *   - Bubble functions of the warping amplitude, one per point: a = sum L_k a_k + sum c_j beta_j.
 *     The twist rate is the interpolation of the point values plus the part of a that they do not
 *     represent, kappa_x(s) = P kappa + a - P a, where P is the interpolation through the points.
 *     Without warping shear, kappa_x = a everywhere, without a penalty.
 *   - The part of the bending moment that the polynomial through the points does not represent.
 *     With two nodes it is the linear part (MacNeal's residual bending flexibility). The element
 *     is then exact for end loads in linear problems, even if it is rigid in shear. With three
 *     nodes it is the quadratic part (derived here), only for sections that are rigid in shear
 * along y or z, which would otherwise have no shear flexibility. This part is computed from the
 * difference between Q and the slope of M in section axes. */

enum {
    EXACT_STIFFNESS_MAX_STRAINS = 6 * EXACT_STRAIN_MAX_POINTS + EXACT_MAX_NODES,
    EXACT_STIFFNESS_MAX_FIELD = 4 * EXACT_STRAIN_MAX_POINTS + 1
};

typedef struct exact_stiffness {
    int strains, points, field;
    double l0;
    int modified; /* 0 if the energy is 1/2 e . S e */
    double S[EXACT_STIFFNESS_MAX_STRAINS * EXACT_STIFFNESS_MAX_STRAINS]; /* [N/m] */
    /* Number and indices of the strains on which the twist rate depends; position of a strain in
     * `place`, or -1. */
    int twisting, place[EXACT_STIFFNESS_MAX_STRAINS], order[EXACT_STIFFNESS_MAX_STRAINS];
    double Q[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS]
            [EXACT_STIFFNESS_MAX_STRAINS]; /* mean of l0^3 kappa_x^2 about a point, as a quadratic
                                              form in these strains [1/m] */
    double r[3];                           /* factors of gamma_x, kappa_y, kappa_z at the
                                            * point */
    double torque[EXACT_STIFFNESS_MAX_FIELD]; /* weight of (l0^2 kappa_x)^4 [N/m^3] */
    double twist[EXACT_STIFFNESS_MAX_FIELD]
                [EXACT_STIFFNESS_MAX_STRAINS]; /* l0^2 kappa_x = twist . e, summed over the strains
                                                  in `place` */
    double Sr[EXACT_STRAIN_MAX_POINTS][EXACT_STIFFNESS_MAX_STRAINS];
    double coupling[EXACT_STRAIN_MAX_POINTS][EXACT_STRAIN_MAX_POINTS]; /* products r_g . S r_h */
} exact_stiffness;

typedef struct exact_gauss {
    exact_strain_line line;
    exact_stiffness stiffness;
} exact_gauss;

status exact_stiffness_prepare(const element_request *request, int nodes, exact_stiffness *out,
                               fault *f);
status exact_stiffness_stress(const exact_stiffness *k, const double e[], stress_output *out);
/* Computes the geometric part of the derivative of C at e = 0 with respect to the strains that
 * cause the prestress sigma. */
void exact_stiffness_geometric(const exact_stiffness *k, const double sigma[], double G[]);

/* Variables of the energy of an element with strains at Gauss points, and the elimination of fields
 * that do not depend on the nodes, as explained at exact_stiffness. All values are dimensionless
 * (beam_constants.h). */

enum {
    EXACT_FIELDS_MAX_BUBBLES = EXACT_STRAIN_MAX_POINTS, /* bubbles of the warping amplitude */
    EXACT_FIELDS_STRESSES = 5, /* stresses Q_y, Q_z, M_w, M_y, M_z of a point */
    EXACT_FIELDS_MAX_FREE = EXACT_STIFFNESS_MAX_STRAINS + EXACT_FIELDS_MAX_BUBBLES,
    EXACT_FIELDS_MAX_ALL = EXACT_FIELDS_MAX_FREE + EXACT_FIELDS_STRESSES * EXACT_STRAIN_MAX_POINTS
};

/* The energy before elimination. The order of the variables is strains, bubble functions,
 * stresses. */
typedef struct exact_fields {
    int nodes, points, strains, warping_bubbles, free, all, field;
    double x[EXACT_STRAIN_MAX_POINTS], w[EXACT_STRAIN_MAX_POINTS];
    double at[EXACT_STIFFNESS_MAX_FIELD],
        weight[EXACT_STIFFNESS_MAX_FIELD]; /* points that integrate the fourth power of the twist
                                              rate */
    double through[EXACT_STIFFNESS_MAX_FIELD]
                  [EXACT_STRAIN_MAX_POINTS]; /* Lagrange polynomials of the points `x`, evaluated at
                                                `at` */
    double twist[EXACT_STIFFNESS_MAX_FIELD][EXACT_FIELDS_MAX_FREE]; /* kappa_x */
    double slope[EXACT_STIFFNESS_MAX_FIELD][EXACT_FIELDS_MAX_FREE]; /* a' */
    double mean[EXACT_STRAIN_MAX_POINTS][EXACT_FIELDS_MAX_FREE];    /* P a at the points */
    double energy[EXACT_FIELDS_MAX_ALL * EXACT_FIELDS_MAX_ALL];     /* symmetric matrix of twice the
                                                                     * energy */
} exact_fields;

void exact_fields_prepare(const beam_constants *c, int nodes, exact_fields *f);

/* Computes the bubble functions and stresses as linear functions X[all - strains][strains] of the
 * strains. Returns 0, or the number of the pivot that fails. */
int exact_fields_eliminate(const exact_fields *f, double X[]);

/* Sections given by matrices (elements/section/section.h) in the elements of this folder. The
 * energy per length is 1/2 (gamma, kappa) . C (gamma, kappa), without other terms. */

/* Computes S [strains x strains] [N/m] for Gauss points that each represent a part of the element.
 * With one point, the moment is linear along the element with the slope M' = -e_x x N. This slope
 * adds M' . (C^-1)_kk M'/12 to the flexibility of the forces, so end loads are represented exactly.
 * Warping amplitudes have no stiffness. */
status exact_coupled_stiffness(const beam_constants *c, int points, int strains, double length,
                               double S[], fault *f);

/* Energy of non-uniform torsion along an element with given twist rates at Gauss points. The
 * warping amplitude a(x) may be any function with the given values at the ends. With P the
 * projection on the polynomials represented by the points, the twist rate is P kappa + a - P a;
 * without warping shear, P kappa = P a. For given kappa at the points, the function a with the
 * smallest energy is a polynomial plus two boundary layers, exp(-lambda x) and exp(-lambda (1 -
 * x)), where lambda^2 = GJ/EIw. Therefore long elements need no refinement at their ends (derived
 * here). All equations are linear, and a is eliminated in advance. All values are dimensionless
 * (beam_constants.h). */

enum { EXACT_WARPING_MAX_STAGES = 8, EXACT_WARPING_MAX = EXACT_WARPING_MAX_STAGES + 2 };

/* Computes S of the energy 1/2 z . S z, which is added to GJ kappa^2/2 at the points. z contains
 * the twist rate minus the shear due to Q_y and Q_z at each Gauss point, then the amplitudes at p
 * and at q. x and w [stages] are the Gauss points and weights. */
void exact_warping_energy(const beam_constants *c, int stages, const double x[], const double w[],
                          double S[EXACT_WARPING_MAX * EXACT_WARPING_MAX]);

/* Strains of one geometrically exact element. The second function is for processors with AVX2 and
 * gives bit-for-bit identical results (elements/math/real.h). */

typedef void exact_alone_strains(const exact_strain_line *, const node_state x[], strain_output *);

exact_alone_strains exact_alone_strain_plain, exact_alone_strain_avx2;

/* Strains and stresses of several geometrically exact elements at once, bit-for-bit identical to
 * those of single elements. These functions are members of element_type. The second function of
 * each pair is for processors with AVX2 (elements/math/real.h). */

typedef void exact_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
typedef void exact_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);

exact_lanes_strains exact_lanes_gauss_strain_plain, exact_lanes_gauss_strain_avx2;
exact_lanes_stresses exact_lanes_gauss_stress_plain, exact_lanes_gauss_stress_avx2;

#endif
