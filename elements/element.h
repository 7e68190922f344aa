/* The element interface: a beam formulation is a deformation function e = D(x),
 * a stress function sigma = S(e) that derives from an energy, and inertia (N section 2.5).
 *
 * "J Eq. 66" and "N Eq. 37" are equations of
 *   J: J.B. Jonker, the thin-walled beam element BEAMW with shear deformation and warping,
 *   N: M. Nijenhuis, J.P. Meijaard, M. Naves, R.G.K.M. Aarts (2024), third-order beam element for
 *      sheet flexures; for misprints see reference/ERRATA.md.
 *
 * One file in elements/ defines one const element_type whose symbol is
 * element_<file name>; the registry is generated from the files that exist.
 *
 * Coordinates of an element with n nodes: 7 per node, in the order
 * dr (3, [m]), dphi (3, spatial increment, [rad]), da (warping amplitude, [rad/m]).
 * First derivatives are with respect to these; second derivatives are those in
 * the exponential chart R(dphi) = exp(dphi~) R, hence symmetric.
 * Matrices are row-major.  NULL output: not needed and not computed.
 * Elements allocate nothing and keep no state: the caller owns all arrays. */
#ifndef BEAMWORK_ELEMENT_H
#define BEAMWORK_ELEMENT_H

#include <stddef.h>

#include "elements/feature.h"
#include "elements/output.h"
#include "elements/section/section.h"
#include "elements/shared/parameter.h"
#include "elements/shared/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { ELEMENT_ABI = 3 };
enum {
    ELEMENT_MAX_NODES = 3,
    NODE_COORDINATES = 7,
    ELEMENT_MAX_COORDINATES = 21,
    ELEMENT_MAX_STRAINS = 24,
    ELEMENT_MAX_OPTIONS = 6
};

/* Restrictions of a type. */
enum element_limit {
    LIMIT_DOUBLY_SYMMETRIC = 1 << 0, /* shear centre at the centroid, D diagonal */
    LIMIT_ORDER_DEPENDENT =
        1 << 1, /* exchanging p and q changes the result (by a discretisation error) */
    LIMIT_QUARTER_TURN = 1 << 2, /* strains are sines of the rotation between the nodes; beyond pi/2
                                    another state has the same strains */
    LIMIT_WARPING_RIGID = 1 << 3, /* warping causes no shear; sections with closed cells, where
                                   * warping does cause shear, are a different model */
    LIMIT_FLAT_ARC = 1 << 4,      /* an initially curved element of length l and curvature k is too
                                     flexible in bending, by a fraction that depends only on EA l^4
                                     k^2/(E Iz): 1 % at 64, 10 % at 256, where its arc rises by l^2 k/8 =
                                     2 radii of gyration; beyond 6107 its stiffness is indefinite */
    LIMIT_HALF_TURN = 1 << 5,     /* strains represent rotations between the ends up to pi, because
                                     frames do not contain the number of full rotations. Types that
                                   * declare neither rotation limit have this one */
    LIMIT_TENSION = 1 << 6, /* an element that is too long for its axial force loses its transverse
                             * stiffness; `tension` returns the ratio of its length to the limit */
    LIMIT_EIGHTH_TWIST =
        1 << 7 /* the torsional strain is the sine of the twist between the nodes; beyond pi/4 the
                  torque decreases, and another state has the same strain */
};

/* Features that a type supports in one direction only. `list` and `solve` show them; a scene in
 * which the feature matters in the other direction is not run. */
enum element_lack {
    LACKS_SHEAR_Y = 1 << 0 /* rigid in shear along y, although FEATURE_SHEAR is supported */
};

/* Derivatives that the harness computes by finite differences (harness/formulations) for a type
 * that does not provide them: they are of sixth order in the rotation chart, accurate to about ten
 * digits, and slow. Results report this, and their times are not ranked. */
enum element_left {
    LEAVES_J = 1 << 0,      /* strain returns e only */
    LEAVES_H = 1 << 1,      /* strain returns no H */
    LEAVES_FORCE = 1 << 2,  /* force returns the energy only */
    LEAVES_TANGENT = 1 << 3 /* force returns no K */
};

/* Shear theories in stability that the equations of a type follow, as bits; 0: rigid in shear. A
 * type is evaluated against the reference value of its own theory, whatever a scene specifies. A
 * type that supports several theories uses the one that the features of the request select. */
enum shear_theory {
    SHEAR_ENGESSER = 1 << 0, /* the axial force does work on 1/2 (v'^2 + w'^2) of the fibre */
    SHEAR_HARINGX =
        1 << 1, /* the axial force does work on the rotation of the section (Simo-Reissner) */
    SHEAR_OWN = 1 << 2 /* neither: element_type.own_theory names it */
};

/* Kinds of results with different orders of convergence. */
typedef enum element_analysis {
    ELEMENT_STATICS, /* equilibrium, linear or nonlinear, and results from its tangent (compliance,
                        critical points of a path) */
    ELEMENT_VIBRATION, /* results that depend on inertia, except in transient analyses: frequencies,
                          states of rotation */
    ELEMENT_BUCKLING,  /* linear buckling: the geometric stiffness of a prestress */
    ELEMENT_ANALYSES
} element_analysis;

/* Orders of convergence in the number of elements: the lowest order for a smooth solution, and the
 * highest order of any quantity, which is attained if leading error terms vanish. With loads along
 * members and large rotations the order is four, except for loads that the element includes in its
 * equilibrium (along). For vibration the lowest order is that of frequencies of stress-free
 * straight members of one material: four in bending, stretch and twist with the mass of the
 * displacement field. Under stress or in a rotating frame, shear, stretch and twist have order two.
 */
typedef struct element_order {
    int least, highest; /* lowest for a smooth solution; highest for any quantity */
} element_order;

/* Input of the preparation of an element. */
typedef struct element_request {
    const struct section *section;   /* its constants */
    double length;                   /* l0 [m] */
    unsigned features;               /* exactly the features that must be active */
    const double *options;           /* values in the order of type->options */
    const struct element_type *type; /* as defined in its file */
    double curvature[3];             /* initial torsion and curvatures kx, ky, kz [1/m] */
    double
        strain[3]; /* initial elongation and shear strains gx, gy, gz of the stress-free element */
} element_request;

typedef struct element_data
    element_data; /* opaque; one per kind of element, shared by identical elements */

/* State of a node. */
typedef struct node_state {
    double r[3]; /* position [m] */
    double u[3]; /* displacement from the undeformed state [m]; r - u is the initial position, so
                  * that an elongation is computed without cancellation */
    double R[9]; /* node rotation times the element's initial triad; columns nX nY nZ */
    double a;    /* warping amplitude [rad/m]; phi_x' in the shear-rigid limit */
} node_state;

/* A frame that rotates at a constant rate. */
typedef struct element_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point of its axis [m] */
} element_rotating_frame;

/* Sizes and orders that do not depend on options. */
typedef struct element_constants {
    int nodes, strains;                    /* 0: 2 nodes, 8 strains */
    element_order order[ELEMENT_ANALYSES]; /* highest 0: least 2, highest 4 */
} element_constants;

/* Optional members may be NULL or 0; the end of their comment gives the default. */
typedef struct element_type {
    /* Required. */
    unsigned abi; /* ELEMENT_ABI; required in files outside elements/ */
    size_t size;  /* sizeof(element_type) in the header used for compilation; required in files
                     outside elements/ */
    const char
        *name; /* file name = exported symbol without element_ = command line = results key */
    const char *summary; /* one line */
    const char *source;  /* paper and equations */
    const char *family;  /* one word; types of one family share code or theory, so that their
                            agreement proves little */
    unsigned offers;     /* element_feature; shear theories as in shear_theories */
    /* Bytes of its element_data. */
    size_t (*data_size)(const element_request *);
    /* Called once per kind of element. Rejects an unsupported request and states the reason. */
    status (*prepare)(const element_request *, element_data *, fault *);

    /* Required: these two functions, or `force` instead. */
    /* Computes strains e from the states of the nodes, with their derivatives. */
    void (*strain)(const element_data *, const node_state x[], strain_output *);
    /* Computes stresses for strains e. NOT_CONVERGED or SINGULAR: the formulation cannot be
     * evaluated in this state. */
    status (*stress)(const element_data *, const double e[], const double inner[], stress_output *);
    /* For codes that compute the force and tangent from node states, or an energy that is invariant
     * under rigid motion. The strains are then the positions of the nodes relative to the first
     * node. Straight elements only. Linear buckling includes the strains of the prestress inside
     * each element, which causes a relative error of the size of these strains. */
    status (*force)(const element_data *, const node_state x[], force_output *);

    /* Optional: properties for the evaluation. */
    unsigned leaves;         /* element_left; default: nothing is computed by finite differences */
    unsigned limits;         /* element_limit: none */
    unsigned lacks;          /* element_lack: nothing */
    const char *lacks_by;    /* equation or assumption that omits it */
    unsigned shear_theories; /* shear_theory; default: none, rigid in shear */
    const char *own_theory;  /* for SHEAR_OWN, one line: the theory and where it is derived */
    element_order (*order)(element_analysis,
                           const double options[]); /* default: lowest 2, highest 4 */

    /* Optional: -f name:key=value. */
    const parameter_type *options[PARAMETER_PARTS]; /* none */
    /* [options] element_feature: `verify` evaluates every choice of an option for quantities that
     * depend on one of these features; 0: only the default choice. Default (NULL): only the default
     * choices of all options. */
    const unsigned *judged;

    /* Optional: sizes, which may depend on the options (stages, nodes). */
    int (*nodes)(const double options[]);   /* 2 */
    int (*strains)(const double options[]); /* 8 */
    int (*inner)(const double options[]);  /* number of inner unknowns of the element; default: 0 */
    int (*memory)(const double options[]); /* number of doubles stored between stress and update;
                                              default: 0 */

    /* Optional, for types with inner unknowns. */
    /* Adds to `inner` the correction from the last call of `stress` for the strain increment de.
     * Returns the dimensionless size of the change. */
    double (*update)(const element_data *, const double de[], const double memory[],
                     double inner[]);
    /* Computes the inner unknowns of the undeformed state; default: zero. */
    void (*rest)(const element_data *, double inner[]);

    /* Optional: further physics. */
    /* Computes G[strains x strains], the derivative of C at e = 0 in the direction of the prestress
     * sigma, which is sum sigma_i Q_i; default: zero. */
    void (*geometric)(const element_data *, const double sigma[], double G[]);
    /* Computes inertia. frame NULL: the frame does not rotate. Default (NULL): the mass of the
     * displacement field that is exact without loads (field/field.h); for three nodes, lumped
     * mass. */
    status (*inertia)(const element_data *, const node_state x[], const element_rotating_frame *,
                      inertia_output *);

    /* Optional: many elements in one call, if that is cheaper than single calls (lanes over
     * elements, another process). Values must not depend on the order and number of elements.
     * data[count], one for each element: elements of one kind share their data and are often
     * consecutive. x[count x nodes]; the same outputs are requested in all of out[count]. */
    void (*strain_many)(int count, const element_data *const data[], const node_state x[],
                        strain_output out[]);
    /* e[count][strains], inner[count][inner], outcome[count]. */
    void (*stress_many)(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[]);
    /* outcome[count]. */
    void (*force_many)(int count, const element_data *const data[], const node_state x[],
                       force_output out[], status outcome[]);

    /* Optional: replaces nodes, strains and order if they do not depend on options. */
    const element_constants *constants;
    /* Optional: returns one line that explains why results since the last call are invalid; NULL:
     * they are valid. */
    const char *(*trouble)(const element_data *);
    /* Optional: number of elements of one kind that strain_many and stress_many evaluate together
     * (lanes of the processor); they are called with this number. 0: any number (another process).
     */
    int lanes;
    /* Optional: strains, stresses and the resulting equations in one call, bit-for-bit as in
     * separate calls. s[count][strains]: independent stresses. */
    void (*equations_many)(int count, const element_data *const data[], const node_state x[],
                           const double *const e[], const double *const inner[],
                           const double *const s[], equations_output out[], status outcome[]);
    /* Optional: support of transient analysis with consistent mass. 1: `inertia` for two nodes
     * supports it (rate and the members below it); 0: mass is lumped at the nodes. For a type
     * without `inertia`: 1. */
    int spreads;
    /* For LIMIT_TENSION: length of the element divided by the largest length that its axial force
     * allows; default: 0, no limit. */
    double (*tension)(const element_data *, const double sigma[]);
    /* For a formulation with an uncorrected misprint: one line with the equation and its error. The
     * formulation is never ranked, chosen or included in an agreement. Default: NULL. */
    const char *misprint;
    /* Optional: includes dead forces along elements of two nodes in the equilibrium of the element,
     * for `count` elements: x[count x nodes], outcome[count]. By default (NULL), and always for
     * follower loads, for moments and in scenes with a motion, loads do work on a displacement
     * field between the nodes that is the same for all types. */
    void (*along)(int count, const element_data *const data[], const node_state x[],
                  along_output out[], status outcome[]);
    /* Optional: kind of mass. 1: with these options, `inertia` for two nodes in the undeformed
     * state is that of the displacement field that is exact without loads (field/field.h);
     * frequencies are then corrected for the motion inside the element. 0: frequencies are those of
     * the mass matrix alone. For a type without `inertia`: 1. */
    int (*mass_of_field)(const double options[]);
    /* Optional: data of the same element with an additional stress-free elongation and curvatures
     * about y and z [1, 1/m, 1/m]. x: nodes of the element in the stress-free state; out: data of
     * the same size. Strains are still computed from the nodes. Default (NULL): strains are
     * measured from the strains of x, which causes an error of second order in curvature if the
     * stress function is nonlinear. */
    void (*unstressed)(const element_data *, const double more[3], const node_state x[],
                       element_data *out);
} element_type;

/* Makes a symbol visible outside its shared object, even with -fvisibility=hidden. */
#if defined(__GNUC__)
#define ELEMENT_EXPORT __attribute__((visibility("default")))
#else
#define ELEMENT_EXPORT
#endif
/* The formulation of a shared object, to be defined after inclusion of this header, in C or C++. */
ELEMENT_EXPORT extern const element_type beamwork_element;
/* Alternative for languages whose constants cannot contain addresses of functions (Fortran): a
 * function that returns the formulation, which must exist until the program ends. */
ELEMENT_EXPORT const element_type *beamwork_element_type(void);

static inline element_order element_order_in(const element_type *t, element_analysis a,
                                             const double options[])
{
    const element_order usual = {2, 4};
    if (t->order)
        return t->order(a, options);
    return t->constants && t->constants->order[a].highest > 0 ? t->constants->order[a] : usual;
}
/* Returns the orders of convergence in transient analyses. With consistent mass, the order is four
 * in slender bending and two with shear, stretch and twist. With mass lumped at two nodes, it is
 * two. */
static inline element_order element_order_of_motion(void)
{
    const element_order usual = {2, 4};
    return usual;
}
static inline unsigned element_judged(const element_type *t, int option)
{
    return t->judged ? t->judged[option] : 0;
}
static inline int element_nodes(const element_type *t, const double options[])
{
    if (t->nodes)
        return t->nodes(options);
    return t->constants && t->constants->nodes > 0 ? t->constants->nodes : 2;
}
/* Returns 1 if transient analyses can use the consistent mass of the type. */
static inline int element_spreads(const element_type *t, const double options[])
{
    return t->spreads && t->inertia != NULL && element_nodes(t, options) == 2 &&
           (t->mass_of_field == NULL || t->mass_of_field(options));
}
static inline int element_strains(const element_type *t, const double options[])
{
    if (t->strains)
        return t->strains(options);
    return t->constants && t->constants->strains > 0 ? t->constants->strains : 8;
}
static inline int element_inner(const element_type *t, const double options[])
{
    return t->inner ? t->inner(options) : 0;
}
static inline int element_memory(const element_type *t, const double options[])
{
    return t->memory ? t->memory(options) : 0;
}

#ifdef __cplusplus
}
#endif

#endif
