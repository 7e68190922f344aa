#ifndef BEAMWORK_BEAMW_VARIANTS_H
#define BEAMWORK_BEAMW_VARIANTS_H

#include "elements/beamw/fields.h"
#include "elements/element.h"
#include "elements/shared/lanes.h"

/* A term: d2(row)/dy_i dy_j = c for i <= j. */
typedef struct beamw_quadratic_term {
    double c;
    short row, i, j;
    short to, mirrored; /* positions of c y_j and c y_i in the derivatives of the rows, row-major.
                           For i = j, `mirrored` is an unused position after the end */
    short entry;        /* position in a matrix of second derivatives */
} beamw_quadratic_term;

/* Returns the term with the second derivative c in row `row` of `rows` rows, for n variables. */
static inline beamw_quadratic_term beamw_quadratic_of(double c, int rows, int n, int row, int i,
                                                      int j, int entry)
{
    return (beamw_quadratic_term){.c = c,
                                  .row = (short)row,
                                  .i = (short)i,
                                  .j = (short)j,
                                  .to = (short)(n * row + i),
                                  .mirrored = (short)(i == j ? n * rows : n * row + j),
                                  .entry = (short)entry};
}

/* The stress function common to all BEAMW variants. The energy is 1/2 ebar^T S ebar of modified
 * modes ebar_i = e_i + 1/2 e^T Q_i e (J Eqs. 62-66). */

enum {
    BEAMW_STRAINS = 8,
    BEAMW_MODIFIED = 6, /* e7 and e8 are not modified */
    BEAMW_QUADRATIC_TERMS = BEAMW_MODIFIED * BEAMW_STRAINS * (BEAMW_STRAINS + 1) / 2
};

struct element_data {
    double l0;                       /* [m] */
    double S[8 * 8];                 /* [N/m] */
    double Q[BEAMW_MODIFIED][8 * 8]; /* [1/m], symmetric */
    int terms;                       /* number of nonzero terms in Q, which `term` lists */
    beamw_quadratic_term
        term[BEAMW_QUADRATIC_TERMS]; /* `entry` is a position in [8 x 8] with i <= j */
    int springs;                     /* number of nonzero terms in S */
    struct {
        double c;
        short i, j;
    } spring[BEAMW_STRAINS * BEAMW_STRAINS];
    beamw_spread spread;
    double free[BEAMW_STRAINS]; /* modified strains of the stress-free element */
};

/* Adds c (a b^T + b a^T), which represents the quadratic term c (a . e)(b . e), to Q. */
void beamw_variants_add_product(double Q[8 * 8], double c, const double a[8], const double b[8]);

/* Impose uniform torsion without warping. beamw_variants_merge_torsion replaces A[n x n] by T^T A
 * T, where T sets e7 and e8 to e2. beamw_variants_drop_warping transforms all data of a variant. */
void beamw_variants_merge_torsion(int n, double A[]);
void beamw_variants_drop_warping(element_data *d);
/* Lists the nonzero terms of S and Q, which must have been computed completely. */
void beamw_variants_list(element_data *d);

size_t beamw_variants_data_size(const element_request *);
void beamw_variants_strain(const element_data *d, const node_state x[], strain_output *out);
void beamw_variants_strain_many(int count, const element_data *const data[], const node_state x[],
                                strain_output out[]);
status beamw_variants_stress(const element_data *d, const double e[], const double inner[],
                             stress_output *out);
void beamw_variants_unstressed(const element_data *d, const double more[3], const node_state x[],
                               element_data *out);
void beamw_variants_stress_many(int count, const element_data *const data[],
                                const double *const e[], const double *const inner[],
                                stress_output out[], status outcome[]);
void beamw_variants_geometric(const element_data *d, const double sigma[], double G[]);

/* Sets the modes of J Eq. 66 as printed, which are consistent only if Phi = 0 and the shear centre
 * is at the centroid. */
void beamw_modified_printed(const section *c, unsigned features, element_data *d);

enum {
    BEAMW_MODIFIED_VARIABLES = BEAMW_STRAINS + 3
}; /* e, followed by z: the bending parts (y, z) and the warping part of h [3] */

/* Sets modes derived from the full shear interpolation. The modes are consistent with shear and
 * eccentricity (reference/ERRATA.md), and follow either shear theory in stability. They include the
 * monosymmetric Wagner moments if requested. ebar = e + 1/2 y^T Q y, where y = (e, z). */
void beamw_modified_consistent(
    const section *c, unsigned features, double l0, const beamw_twist *t,
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES]);

/* Inserts z = hg e, which holds in the unstressed element, and computes Q for e alone. */
void beamw_modified_reduce(
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES], element_data *d);

/* A stress function with condensed internal modes. Bending, shear and warping share the
 * antisymmetric deformation h according to equilibrium of the stressed element, so the modes depend
 * on the stress. z is the bending and warping part of h. The energy is the stationary value over z
 * and q of 1/2 sum_r k_r u_r^2 + 1/2 z^T Ka z + q . (h - z) - 1/2 q^T F q/(G l). Here u = (e1, e2,
 * e3 + e4, e5 + e6, (e7 - e8)/2) and h are computed from ebar = e + 1/2 (e, z)^T Q (e, z). q is
 * conjugate to h, so F = 0 is possible. */

enum {
    BEAMW_CONDENSED_EVEN = 5,
    BEAMW_CONDENSED_ALL = BEAMW_CONDENSED_EVEN + 3,
    BEAMW_CONDENSED_ROWS = 6,
    BEAMW_CONDENSED_TERMS =
        BEAMW_CONDENSED_ROWS * BEAMW_MODIFIED_VARIABLES * (BEAMW_MODIFIED_VARIABLES + 1) / 2
};

/* A term c e_i in a row of (u, h). */
typedef struct beamw_condensed_linear {
    double c;
    short row, i;
} beamw_condensed_linear;

typedef struct beamw_condensed {
    double k[BEAMW_CONDENSED_EVEN]; /* [N/m] */
    double Ka[3];                   /* [N m, N m, N m^3] */
    double f[3 * 3];                /* F/(G l) */
    double hg[3 * BEAMW_STRAINS];   /* matrix hg of the unstressed element, where z = hg e */
    double share;                   /* coefficient of the quadratic part of u2 in h_w [1/m^2] */
    double odd[BEAMW_STRAINS *
               BEAMW_STRAINS]; /* second derivative of 1/2 k5 u5^2 with respect to e [N/m] */
    int linears; /* number of linear terms of (u, h) in e, with the rows of k first, then the rows
                    of h */
    beamw_condensed_linear linear[BEAMW_CONDENSED_ALL * BEAMW_STRAINS];
    int mixed, own,
        terms; /* list of quadratic terms. Terms of e alone are entries of [8 x 8]. Terms from
                  `mixed` on contain e_i and z_j and are entries (j, i) of [3 x 8]. Terms from `own`
                  on contain z alone and are entries of [3 x 3] */
    beamw_quadratic_term term[BEAMW_CONDENSED_TERMS];
} beamw_condensed;

/* Prepares condensed modes from Q of beamw_modified_consistent. `warping` is 0 for uniform torsion
 * without warping, where e7 = e8 = e2. */
void beamw_condensed_prepare(
    const section *c, double l0, int shear, int warping, const beamw_twist *t,
    const beamw_stiffness_fields *fields,
    double Q[BEAMW_MODIFIED][BEAMW_MODIFIED_VARIABLES * BEAMW_MODIFIED_VARIABLES],
    beamw_condensed *out);

/* Computes the outputs of element_type.stress. Returns NOT_CONVERGED if no equilibrium of the
 * internal modes was found. */
status beamw_condensed_stress(const beamw_condensed *d, const double e[BEAMW_STRAINS],
                              stress_output *out);

/* Inertia of the two-node beam: lumped at the nodes (J Eq. 73), consistent with the linear fields
 * of J section 3.2 in the deformed state of the element, or the mean of both. The effects of a
 * rotating frame derive from the same kinetic energy. */

typedef enum beamw_inertia_kind {
    BEAMW_INERTIA_LUMPED,
    BEAMW_INERTIA_CONSISTENT,
    BEAMW_INERTIA_AVERAGED
} beamw_inertia_kind;

/* Sets the members lumped, field and share. Without FEATURE_ROTARY_INERTIA, only the translations
 * and the twist (polar moment of inertia) have inertia. The mass matrix is then singular in the
 * other rotations and in warping. `fields` is NULL for lumped mass. */
void beamw_inertia_prepare(const section *c, unsigned features, beamw_inertia_kind kind,
                           const beamw_stiffness_fields *fields, element_data *d);

status beamw_inertia_of(const element_data *d, const node_state x[],
                        const element_rotating_frame *frame, inertia_output *out);

/* Strains and stresses of several BEAMW elements at once, with results bit-for-bit identical to
 * those of single elements. The second function of each pair is for processors with AVX2
 * (elements/math/real.h). */

typedef void beamw_lanes_strains(int count, const element_data *const data[], const node_state x[],
                                 strain_output out[]);
typedef void beamw_lanes_stresses(int count, const element_data *const data[],
                                  const double *const e[], const double *const inner[],
                                  stress_output out[], status outcome[]);
beamw_lanes_strains beamw_lanes_modes_plain, beamw_lanes_modes_avx2;
beamw_lanes_strains beamw_lanes_helicoidal_plain, beamw_lanes_helicoidal_avx2;
beamw_lanes_stresses beamw_lanes_modified_plain, beamw_lanes_modified_avx2;
/* Stresses of elements prepared by beamw_prepare_consistent, whose internal modes may depend on the
 * stress. */
beamw_lanes_stresses beamw_lanes_consistent_plain, beamw_lanes_consistent_avx2;

typedef enum beamw_prepare_modes {
    BEAMW_PREPARE_FIRST_ORDER, /* ebar = e */
    BEAMW_PREPARE_PRINTED      /* J Eq. 66 */
} beamw_prepare_modes;

/* Prepares a variant. If the request does not include FEATURE_SHEAR, the stiffness is rigid in
 * shear for any value of `shear`. REFUSED: the length is not positive, or the stiffness
 * overflows. */
status beamw_prepare_variant(const element_request *request, beamw_stiffness_shear shear,
                             beamw_prepare_modes modes, element_data *out, fault *f);

/* Data of an element prepared by beamw_prepare_consistent. `condensed` is 1 if the internal modes
 * depend on the stress. */
typedef struct beamw_consistent_data {
    element_data variant;
    int condensed;
    beamw_condensed internal;
} beamw_consistent_data;

static inline const beamw_consistent_data *beamw_prepare_whole(const element_data *d)
{
    return (const beamw_consistent_data *)(const void *)d;
}

status beamw_prepare_consistent(const element_request *request, beamw_consistent_data *out,
                                fault *f);

extern const parameter_type beamw_prepare_mass[], beamw_prepare_inside[];
/* Common to all variants. */
int beamw_prepare_mass_of_field(const double options[]);
element_order beamw_prepare_order(element_analysis, const double options[]);
/* Member element_type.judged of types with either list of options. */
extern const unsigned beamw_prepare_judged[];

#define BEAMW_VARIANT_TYPE                                                                         \
    .family = "beamw", .abi = ELEMENT_ABI, .limits = LIMIT_QUARTER_TURN | LIMIT_EIGHTH_TWIST,      \
    .options = {beamw_prepare_mass}, .judged = beamw_prepare_judged,                               \
    .data_size = beamw_variants_data_size, .strain = beamw_variants_strain,                        \
    .stress = beamw_variants_stress, .geometric = beamw_variants_geometric,                        \
    .unstressed = beamw_variants_unstressed, .strain_many = beamw_variants_strain_many,            \
    .stress_many = beamw_variants_stress_many, .lanes = LANES_TOGETHER,                            \
    .inertia = beamw_inertia_of, .spreads = 1, .mass_of_field = beamw_prepare_mass_of_field,       \
    .order = beamw_prepare_order
enum {
    BEAMW_OFFERS = FEATURE_TRAPEZE | FEATURE_WARPING | FEATURE_ECCENTRIC | FEATURE_GEOMETRIC |
                   FEATURE_LARGE | FEATURE_MASS | FEATURE_ROTARY_INERTIA
};

#endif
