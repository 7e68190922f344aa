/* The element interface: a beam formulation is a deformation function e = D(x), a stress function
 * sigma = S(e) that derives from an energy, and inertia (N section 2.5).
 *
 * Citations such as "J Eq. 66" and "N Eq. 37" refer to these papers:
 *   J: J.B. Jonker, the thin-walled beam element BEAMW with shear deformation and warping,
 *   N: M. Nijenhuis, J.P. Meijaard, M. Naves, R.G.K.M. Aarts (2024), third-order beam element for
 *      sheet flexures.
 * reference/ERRATA.md lists the misprints of both papers.
 *
 * Each file in elements/ defines one const element_type with the symbol element_<file name>. The
 * build generates the registry from these files.
 *
 * An element with n nodes has 7n coordinates, followed by the additional unknowns of its nodes if
 * the type has any (element_type.scalars). The coordinates of a node are dr (3, displacement
 * [m]), dphi (3, spatial rotation increment [rad]) and da (warping amplitude [rad/m]), in this
 * order. First derivatives are with respect to these coordinates. Second derivatives refer to the
 * exponential chart R(dphi) = exp(dphi~) R and are therefore symmetric. Matrices are row-major. An
 * output that is NULL is not computed. Elements allocate nothing and keep no state: the caller owns
 * all arrays, also the history of an element (element_type.history). */
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

enum { ELEMENT_ABI = 4 };
enum {
    ELEMENT_MAX_NODES = 8,
    NODE_COORDINATES = 7,
    ELEMENT_MAX_SCALARS = 6,
    ELEMENT_MAX_COORDINATES = 56,
    ELEMENT_MAX_STRAINS = 56,
    ELEMENT_MAX_OPTIONS = 6,
    ELEMENT_MAX_HISTORY = 256
};

/* Restrictions of a type. */
enum element_limit {
    LIMIT_DOUBLY_SYMMETRIC = 1 << 0, /* shear centre at the centroid, D diagonal */
    LIMIT_ORDER_DEPENDENT =
        1 << 1, /* exchanging the nodes p and q changes the result by a discretisation error */
    LIMIT_QUARTER_TURN = 1 << 2,  /* strains are sines of the rotation between the nodes, so another
                                     state has the same strains beyond pi/2 */
    LIMIT_WARPING_RIGID = 1 << 3, /* warping causes no shear strains, which is a different model of
                                     closed sections, where warping does cause shear strains */
    /* An initially curved element of length l and curvature k is too flexible in bending, by a
       fraction that depends only on r = EA l^4 k^2/(E Iz). The fraction is 1 % at r = 64 and 10 %
       at r = 256, where the arc rises by l^2 k/8 = 2 radii of gyration. The stiffness is indefinite
       beyond r = 6107. */
    LIMIT_FLAT_ARC = 1 << 4,
    /* strains represent rotations between the nodes up to pi, because frames do not contain the
     * number of full revolutions. All types without LIMIT_QUARTER_TURN have this limit */
    LIMIT_HALF_TURN = 1 << 5,
    LIMIT_TENSION = 1 << 6, /* an element that is too long for its axial force loses its transverse
                               stiffness; `tension` returns the ratio of the length to the limit */
    LIMIT_NOT_OBJECTIVE = 1 << 8,  /* rigid rotations of a deformed element change its strains */
    LIMIT_PATH_DEPENDENT = 1 << 9, /* strains depend on the path, which requires a history */
    LIMIT_EIGHTH_TWIST =
        1 << 7 /* the torsional strain is the sine of the twist between the nodes; beyond a twist of
                  pi/4 the torque decreases, and another state has the same strain */
};

/* Features that a type supports in only one direction. `list` and `solve` show these features.
 * Scenes in which the unsupported direction matters are not run. */
enum element_lack {
    LACKS_SHEAR_Y = 1 << 0 /* rigid in shear along y, although FEATURE_SHEAR is supported */
};

/* Derivatives that a type does not provide. The harness computes them by finite differences
 * (harness/formulations), which are of sixth order in the rotation chart, accurate to about ten
 * digits, and slow. Results report the use of finite differences, and the run times of the type are
 * not ranked. */
enum element_left {
    LEAVES_J = 1 << 0,      /* strain returns e only */
    LEAVES_H = 1 << 1,      /* strain returns no H */
    LEAVES_FORCE = 1 << 2,  /* force returns the energy only */
    LEAVES_TANGENT = 1 << 3 /* force returns no K */
};

/* Shear theories for stability, as bits; 0 if the type is rigid in shear. A type is evaluated
 * against the reference value of the theory in its equations, whatever theory a scene specifies. A
 * type that supports several theories uses the theory that the features of the request select. */
enum shear_theory {
    SHEAR_ENGESSER = 1 << 0, /* the axial force does work on 1/2 (v'^2 + w'^2) of the fibre */
    SHEAR_HARINGX =
        1 << 1, /* the axial force does work on the rotation of the cross-section (Simo-Reissner) */
    SHEAR_OWN = 1 << 2 /* neither of the two theories; element_type.own_theory names the theory */
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

/* Orders of convergence with respect to the number of elements. The lowest order is that of smooth
 * solutions. The highest order is that of quantities whose leading error terms vanish. With loads
 * along members and large rotations the order is four, except for loads that the element includes
 * in its equilibrium (along). For vibration, the lowest order is that of frequencies of stress-free
 * straight members of one material. With the mass of the displacement field, this order is four in
 * bending, axial motion and twist. Under stress or in a rotating frame, frequencies of shear, axial
 * and torsional modes have order two. */
typedef struct element_order {
    int least, highest; /* lowest order for a smooth solution; highest order of any quantity */
} element_order;

/* Input of the preparation of an element. */
typedef struct element_request {
    const struct section *section; /* constants of the cross-section */
    double length;                 /* l0 [m] */
    unsigned features;     /* features that must be active, while all others must be inactive */
    const double *options; /* values of the options, in the order of type->options */
    const struct element_type *type; /* element type of the request */
    double curvature[3];             /* initial torsion and curvatures kx, ky, kz [1/m] */
    double
        strain[3]; /* initial elongation and shear strains gx, gy, gz of the stress-free element */
} element_request;

typedef struct element_data element_data; /* data of an element, known only to its type and shared
                                             by the elements of one kind */

/* State of a node. */
typedef struct node_state {
    double r[3]; /* position [m] */
    double u[3]; /* displacement from the undeformed state [m]. The initial position is r - u, from
                    which an elongation is computed without cancellation */
    double
        R[9]; /* node rotation times the initial triad of the element, with the columns nX nY nZ */
    double a; /* warping amplitude [rad/m], which is phi_x' in the shear-rigid limit */
    /* additional unknowns of the type (element_type.scalars); the others are undefined */
    double scalar[ELEMENT_MAX_SCALARS];
} node_state;

/* A frame that rotates at a constant rate. */
typedef struct element_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point on the rotation axis [m] */
} element_rotating_frame;

/* Sizes and orders that do not depend on options. */
typedef struct element_constants {
    int nodes, strains; /* numbers of nodes and strains; 0 for 2 nodes and 8 strains */
    element_order order[ELEMENT_ANALYSES]; /* orders of convergence; if the highest order is 0, the
                                              lowest order is 2 and the highest order 4 */
    int history;                           /* number of values of the history */
    double place[ELEMENT_MAX_NODES];       /* positions of the nodes; all 0: equally spaced */
    int scalars;                           /* number of additional unknowns of a node */
} element_constants;

/* An element type. Optional members may be NULL or 0. */
typedef struct element_type {
    /* Required. */
    unsigned abi;     /* ELEMENT_ABI, required in files outside elements/ */
    size_t size;      /* value of sizeof(element_type) at compilation, required in files outside
                         elements/ */
    const char *name; /* name of the file, of the exported symbol (without element_), on the command
                         line and in results */
    const char *summary; /* one line */
    const char *source;  /* paper and equations */
    const char *family; /* one word. Types of one family share code or theory, so their agreement is
                           weak evidence */
    unsigned offers;    /* supported features (element_feature), which agree with shear_theories */
    /* Returns the size of element_data [bytes]. */
    size_t (*data_size)(const element_request *);
    /* Prepares the data, once per kind of element. Rejects an unsupported request and states the
     * reason. */
    status (*prepare)(const element_request *, element_data *, fault *);

    /* Either the next two functions or `force` is required. */
    /* Computes the strains e from the states of the nodes, with their derivatives. */
    void (*strain)(const element_data *, const node_state x[], strain_output *);
    /* Computes the stresses for the strains e. Returns NOT_CONVERGED or SINGULAR if the formulation
     * cannot be evaluated in this state. */
    status (*stress)(const element_data *, const double e[], const double inner[], stress_output *);
    /* For codes that compute forces and tangents from node states, or an energy that is invariant
     * under rigid motion. The positions of the nodes relative to the first node then serve as
     * strains, and the element must be straight. Linear buckling includes the strains of the
     * prestress inside each element, with a relative error of the size of these strains. */
    status (*force)(const element_data *, const node_state x[], force_output *);

    /* Optional: properties for the evaluation. */
    unsigned leaves; /* derivatives that are not provided (element_left). Default: none */
    unsigned limits; /* restrictions of the type (element_limit); default: none */
    unsigned lacks;  /* features supported in only one direction (element_lack); default: none */
    const char *lacks_by; /* equation or assumption that excludes the features in `lacks` */
    /* supported theories (shear_theory); default: none, and the type is rigid in shear */
    unsigned shear_theories;
    const char *own_theory; /* for SHEAR_OWN: one line that states the theory and its source */
    element_order (*order)(element_analysis,
                           const double options[]); /* default: lowest 2, highest 4 */

    /* Optional: options, which -f name:key=value sets. */
    const parameter_type *options[PARAMETER_PARTS]; /* none */
    /* Optional: for each option, the features (element_feature) whose quantities `verify` evaluates
     * for all choices of the option. For 0 or by default (NULL), only the default choice is
     * evaluated. */
    const unsigned *judged;

    /* Optional: sizes, which may depend on the options (stages, nodes). */
    int (*nodes)(const double options[]);   /* 2 */
    int (*strains)(const double options[]); /* 8 */
    int (*inner)(const double options[]);  /* number of inner unknowns of the element; default: 0 */
    int (*memory)(const double options[]); /* number of doubles stored between stress and update;
                                              default: 0 */

    /* Optional, for types with inner unknowns. */
    /* Adds to `inner` the correction of the inner unknowns for the strain increment de, using the
     * `memory` of the last call of `stress`. Returns the dimensionless size of the change. */
    double (*update)(const element_data *, const double de[], const double memory[],
                     double inner[]);
    /* Computes the inner unknowns of the undeformed state; default: zero. */
    void (*rest)(const element_data *, double inner[]);

    /* Optional: functions for further physics. */
    /* Computes G[strains x strains], the derivative of C at e = 0 in the direction of the prestress
     * sigma. G is the sum of sigma_i Q_i. Default: zero. */
    void (*geometric)(const element_data *, const double sigma[], double G[]);
    /* Computes inertia. The frame does not rotate if its pointer is NULL. By default (NULL), the
     * mass is that of the displacement field that is exact if loads act only at the nodes
     * (field/field.h). Elements with more than two nodes have lumped mass by default. */
    status (*inertia)(const element_data *, const node_state x[], const element_rotating_frame *,
                      inertia_output *);

    /* Optional: functions that evaluate many elements in one call, for types for which this is
     * faster than single calls (several lanes, or another process). Values must not depend on the
     * order and number of elements. data[count] has an entry for each element. Elements of one kind
     * share their data and are often consecutive. The states of the nodes are x[count x nodes]. All
     * entries of out[count] request the same outputs. */
    void (*strain_many)(int count, const element_data *const data[], const node_state x[],
                        strain_output out[]);
    /* Computes the stresses of many elements. Array sizes: e[count][strains], inner[count][inner],
     * outcome[count]. */
    void (*stress_many)(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[]);
    /* Computes the forces of many elements, with their status in outcome[count]. */
    void (*force_many)(int count, const element_data *const data[], const node_state x[],
                       force_output out[], status outcome[]);

    /* Optional: constant values that replace `nodes`, `strains`, `order`, `history`, `places` and
     * `scalars` if they do not depend on options. */
    const element_constants *constants;
    /* Optional: returns one line that explains why results since the last call are invalid, or NULL
     * if the results are valid. */
    const char *(*trouble)(const element_data *);
    /* Optional: number of elements of one kind that strain_many and stress_many evaluate together
     * in the lanes of the processor. The functions are called with this number of elements. 0: any
     * number. */
    int lanes;
    /* Optional: computes strains, stresses and the resulting equations in one call, with results
     * bit-for-bit identical to those of separate calls. s[count][strains] are the independent
     * stresses. */
    void (*equations_many)(int count, const element_data *const data[], const node_state x[],
                           const double *const e[], const double *const inner[],
                           const double *const s[], equations_output out[], status outcome[]);
    /* Optional: support of transient analysis with consistent mass. If 1, `inertia` for two nodes
     * uses `rate` and the members below it. If 0, mass is lumped at the nodes. A type without
     * `inertia` has the value 1. */
    int spreads;
    /* For LIMIT_TENSION: returns the length of the element divided by the largest length that the
     * axial force allows. Default: 0, no limit. */
    double (*tension)(const element_data *, const double sigma[]);
    /* For a formulation with an uncorrected misprint, one line with the equation and its error. The
     * formulation is never ranked, chosen or included in an agreement. Default: NULL. */
    const char *misprint;
    /* Optional: includes dead forces along `count` elements of two nodes in the equilibrium of the
     * elements. Array sizes: x[count x nodes], outcome[count]. By default (NULL), loads do work on
     * a displacement field between the nodes that is common to all types, or on `line`. Follower
     * loads, moments and all loads in transient analyses always do. */
    void (*along)(int count, const element_data *const data[], const node_state x[],
                  along_output out[], status outcome[]);
    /* Optional: kind of mass. If 1, `inertia` of an undeformed two-node element with these options
     * is that of the displacement field that is exact if loads act only at the nodes
     * (field/field.h). With warping, the twist may be approximate. Frequencies are then corrected
     * for the motion inside the element. If 0, frequencies are those of the mass matrix alone. A
     * type without `inertia` has the value 1. */
    int (*mass_of_field)(const double options[]);
    /* Optional: computes the data of an element with an additional stress-free elongation [1] and
     * additional curvatures about y and z [1/m]. x contains the nodes of the element in the
     * stress-free state. `out` has the size of the original data. Strains are still computed from
     * the nodes. By default (NULL), strains are measured from the strains of x. If the stress
     * function is nonlinear, this causes an error of second order in curvature. */
    void (*unstressed)(const element_data *, const double more[3], const node_state x[],
                       element_data *out);
    /* Optional: values that an element stores along a path, for strains or forces that depend on
     * previous states, such as interpolated rotation increments. A history excludes `along`,
     * `equations_many` and `unstressed`. `strain` or `force` receives the values of the last
     * accepted state, the end of a load step or time step (strain_output.history,
     * force_output.history), and derivatives are those for constant values. A step that is repeated
     * starts from the same values.
     * With a history, the forces of `force` may depend on rigid rotations, need not derive from an
     * energy, which is not requested, and may have an unsymmetric K. Such elements have at
     * most seven nodes. Linear buckling, damping of members and energies are rejected. */
    int (*history)(const double options[]); /* number of doubles of each element; default: 0 */
    /* Computes the values in the undeformed state; default: zero. */
    void (*begin)(const element_data *, const node_state x[], double history[]);
    /* Required with a history: replaces the values by those of the state x, which is accepted and
     * was reached from the previous values. The strains, or the forces of `force`, at x must not
     * change, and a second call at x must change nothing, both to round-off. */
    void (*commit)(const element_data *, const node_state x[], double history[]);
    /* Optional: computes the positions of the nodes in the undeformed element, divided by its
     * length: 0 for the first node, 1 for the last node, in ascending order. Masses and loads are
     * lumped with the weights that integrate the polynomial through the nodes, which must be
     * positive. Default: equally spaced. */
    void (*places)(const double options[], double place[]);
    /* Optional: damping of the formulation itself, such as a viscous material. Computes the matrix
     * V [strains x strains] [N s/m], symmetric and positive semidefinite: strain rates e' = J x'
     * add V e' to the stresses, in motions, damped modes and harmonic analyses. V does not depend
     * on the state. Rigid motions, which have no strain rates, have no damping. The dissipated
     * power is e' . V e'. The damping of the member is added. Requires `strain` and `stress`.
     * Default: no damping. */
    void (*damping)(const element_data *, double V[]);
    /* Optional: motion of the sections between the nodes, for loads along the element. Computes
     * position and axes of the section at `count` points, and the generalised forces of loads
     * there. Loads along members, weights and partial loads do work on this motion, in all
     * analyses, with dead and follower forces and moments and with eccentric loads. A rigid motion
     * of the nodes must move the sections in the same way, so that nodal forces are in equilibrium
     * with the loads. Loads that `along` includes do not use it. Excludes `history`. By default
     * (NULL), loads do work on a displacement field that is common to all types (field/field.h). */
    void (*line)(const element_data *, const node_state x[], int count, line_output out[]);
    /* Optional: number of additional unknowns of each node, in addition to its 7 coordinates, for
     * example slopes or further modes of warping; default: 0. They are dimensionless numbers that
     * are zero in the undeformed state and do not change in a rigid motion. With w unknowns in each
     * node, the coordinates of an element are the 7n coordinates of its nodes, followed by the
     * unknowns of the first node, then those of the next node. J, F, M and all other arrays have 7n
     * + wn columns. The elements of a member share the unknowns of their common nodes. Members
     * share the unknowns of a node if they share the warping amplitude and have the same axes
     * there. All other unknowns of ends are free, except those in `held`. A type with additional
     * unknowns has no `along`, `line`, `equations_many` and `unstressed`. Without `inertia`, and in
     * transient analyses, the unknowns have no mass. */
    int (*scalars)(const double options[]);
    /* Additional unknowns that are zero at ends of members with restrained warping: bit i for
     * unknown i. Default: none. */
    unsigned held;
} element_type;

/* Makes a symbol visible outside a shared object, even with -fvisibility=hidden. */
#if defined(__GNUC__)
#define ELEMENT_EXPORT __attribute__((visibility("default")))
#else
#define ELEMENT_EXPORT
#endif
/* The formulation of a shared object, which must be defined after inclusion of this header, in C or
 * C++. */
ELEMENT_EXPORT extern const element_type beamwork_element;
/* Returns the formulation of a shared object. Alternative to `beamwork_element` for languages whose
 * constants cannot contain addresses of functions, such as Fortran. The formulation must exist
 * until the program ends. */
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
/* Computes the positions of the nodes along the element, from 0 to 1. */
static inline void element_places(const element_type *t, const double options[], double place[])
{
    const int last = element_nodes(t, options) - 1,
              given = t->constants != NULL && t->constants->place[last] > 0;
    for (int k = 0; k <= last; k++)
        place[k] = given ? t->constants->place[k] : (double)k / last;
    if (t->places)
        t->places(options, place);
}
/* Returns the number of additional unknowns of a node. */
static inline int element_scalars(const element_type *t, const double options[])
{
    if (t->scalars)
        return t->scalars(options);
    return t->constants ? t->constants->scalars : 0;
}
/* Returns 1 if transient analyses can use the consistent mass of the type. */
static inline int element_spreads(const element_type *t, const double options[])
{
    return t->spreads && element_scalars(t, options) == 0 && t->inertia != NULL &&
           element_nodes(t, options) == 2 &&
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

/* Returns the number of values of the history of an element, or 0 without a history. */
static inline int element_history(const element_type *t, const double options[])
{
    if (t->history)
        return t->history(options);
    return t->constants ? t->constants->history : 0;
}

#ifdef __cplusplus
}
#endif

#endif
