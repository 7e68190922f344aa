/* The element interface: a beam formulation is a deformation function e = D(x),
 * a stress function sigma = S(e) that derives from an energy, and inertia (N section 2.5).
 *
 * "J Eq. 66" and "N Eq. 37" are equations of
 *   J: J.B. Jonker, the thin-walled beam element BEAMW with shear deformation and warping,
 *   N: M. Nijenhuis, J.P. Meijaard, M. Naves, R.G.K.M. Aarts (2024), third-order beam element for
 *      sheet flexures; what they misprint: reference/ERRATA.md.
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
    LIMIT_ORDER_DEPENDENT = 1 << 1,  /* exchanging p and q changes the answer (by a discretisation
                                        error) */
    LIMIT_QUARTER_TURN = 1 << 2,     /* strains are sines of the turn between the nodes: beyond pi/2
                                        another state has the same ones */
    LIMIT_WARPING_RIGID = 1 << 3,    /* warping does not shear: closed cells, which warp by it, are
                                        another model */
    LIMIT_FLAT_ARC = 1 << 4,  /* an element of length l and curvature k at rest bends too easily by
                                 a part that EA l^4 k^2/(E Iz) alone decides: 1 % at 64, 10 % at
                                 256, where its arc rises by l^2 k/8 = 2 radii of gyration; beyond
                                 6107 it has no definite stiffness */
    LIMIT_HALF_TURN = 1 << 5, /* strains follow turns between the ends up to pi: frames do not say
                                 by how many circles they have turned. Types that declare neither
                                 turn are bound to this one */
    LIMIT_TENSION = 1 << 6,   /* an element that is long for the axial force in it loses its
                                 stiffness across it: `tension` says by how much it is too long */
    LIMIT_EIGHTH_TWIST = 1 << 7 /* the strain of torsion is the sine of the twist between the nodes:
                                   beyond pi/4 its torque falls, and another state has the same */
};

/* Features that a type supports in one direction only. `list` and `solve` show it; a scene in which
 * it matters is not run. */
enum element_lack {
    LACKS_SHEAR_Y = 1 << 0 /* rigid in shear along y, though FEATURE_SHEAR is supported */
};

/* Derivatives that the harness computes by differences (harness/formulations) for a type that does
 * not give them: of sixth order in the rotation chart, exact to about ten digits, and slow. Results
 * report it; such times are not ranked. */
enum element_left {
    LEAVES_J = 1 << 0,      /* strain gives e only */
    LEAVES_H = 1 << 1,      /* strain gives no H */
    LEAVES_FORCE = 1 << 2,  /* force gives the energy only */
    LEAVES_TANGENT = 1 << 3 /* force gives no K */
};

/* The theory of shear in stability that the equations of a type have, in bits; 0: rigid in shear.
 * A type is evaluated against the reference value of its own theory, whatever a scene specifies;
 * one that offers several takes that of the request's features. */
enum shear_theory {
    SHEAR_ENGESSER = 1 << 0, /* the axial force works on 1/2 (v'^2 + w'^2) of the fibre */
    SHEAR_HARINGX = 1 << 1,  /* it works on the rotation of the section (Simo-Reissner) */
    SHEAR_OWN = 1 << 2       /* neither: element_type.own_theory names it */
};

/* Kinds of results that an order of convergence depends on. */
typedef enum element_analysis {
    ELEMENT_STATICS,   /* equilibrium, linear or not, and what follows from its tangent (compliance,
                          critical points of a path) */
    ELEMENT_VIBRATION, /* whatever inertia has part in but motions in time: frequencies, states
                          that turn */
    ELEMENT_BUCKLING,  /* linear: the geometric stiffness of a prestress */
    ELEMENT_ANALYSES
} element_analysis;

/* Orders in the number of elements: the least that a smooth solution shows, and the highest that
 * any quantity can show, where leading terms vanish.  Loads along members have four where rotations
 * are large, but for those that the element takes (along).  In vibration the least is that of
 * frequencies without stress, of straight members of one material: with the mass of the
 * displacement field four, in bending, stretch and twist.  Under stress or in a frame that turns
 * shear, stretch and twist have two. */
typedef struct element_order {
    int least, highest; /* of a smooth solution; of any quantity */
} element_order;

/* Input of the preparation of an element. */
typedef struct element_request {
    const section *section;          /* its constants */
    double length;                   /* l0 [m] */
    unsigned features;               /* exactly what is to be active */
    const double *options;           /* values in the order of type->options */
    const struct element_type *type; /* as its file gives it */
    double curvature[3];             /* initial torsion and curvatures kx, ky, kz [1/m] */
    double
        strain[3]; /* initial elongation and shear strains gx, gy, gz of the stress-free element */
} element_request;

typedef struct element_data
    element_data; /* opaque; one per kind of element, shared by identical ones */

/* A node as it is. */
typedef struct node_state {
    double r[3]; /* position [m] */
    double u[3]; /* displacement since the undeformed state [m]: r - u is the initial position, so
                    that an elongation needs no cancellation */
    double R[9]; /* node rotation times the element's initial triad; columns nX nY nZ */
    double a;    /* warping amplitude [rad/m]; phi_x' in the shear-rigid limit */
} node_state;

/* A frame that turns steadily. */
typedef struct element_rotating_frame {
    double omega[3];  /* angular velocity [rad/s] */
    double centre[3]; /* a point of its axis [m] */
} element_rotating_frame;

/* Sizes and orders that no option changes. */
typedef struct element_constants {
    int nodes, strains;                    /* 0: 2 nodes, 8 strains */
    element_order order[ELEMENT_ANALYSES]; /* highest 0: least 2, highest 4 */
} element_constants;

/* Optional members may be NULL or 0; the end of their comment says what that means. */
typedef struct element_type {
    /* Required. */
    unsigned abi; /* ELEMENT_ABI; of files outside elements/ */
    size_t size;  /* sizeof(element_type) of the header it was compiled with; likewise */
    const char
        *name; /* file name = exported symbol without element_ = command line = results key */
    const char *summary; /* one line */
    const char *source;  /* paper and equations */
    const char *family;  /* one word; types of one family share code or theory: that they agree
                            proves little */
    unsigned offers;     /* element_feature; theories of shear as in shear_theories */
    /* Bytes of its element_data. */
    size_t (*data_size)(const element_request *);
    /* Once per kind of element.  Refuses what it cannot do, naming it. */
    status (*prepare)(const element_request *, element_data *, fault *);

    /* Required: these two, or `force` in their place. */
    /* Strains e of its nodes' states, with their derivatives. */
    void (*strain)(const element_data *, const node_state x[], strain_output *);
    /* NOT_CONVERGED or SINGULAR when the state is outside what the formulation can evaluate. */
    status (*stress)(const element_data *, const double e[], const double inner[], stress_output *);
    /* Codes that give force and tangent of node states, or an energy that is the same wherever a
     * rigid motion takes the element. The positions of the nodes relative to the first one are its
     * strains. Straight elements only; in linear buckling the strains of the prestress count inside
     * each element: an error of their size. */
    status (*force)(const element_data *, const node_state x[], force_output *);

    /* Optional: what it is evaluated by. */
    unsigned leaves;         /* element_left: nothing is computed by differences */
    unsigned limits;         /* element_limit: none */
    unsigned lacks;          /* element_lack: nothing */
    const char *lacks_by;    /* the equations that omit it */
    unsigned shear_theories; /* shear_theory: none, rigid in shear */
    const char *own_theory;  /* of SHEAR_OWN, one line: what it is and where it is derived */
    element_order (*order)(element_analysis, const double options[]); /* least 2, highest 4 */

    /* Optional: -f name:key=value. */
    const parameter_type *options[PARAMETER_PARTS]; /* none */
    /* [options] element_feature: verify judges every choice of an option where a quantity depends
     * on one of these, 0: its default alone. NULL: the defaults alone. */
    const unsigned *judged;

    /* Optional: sizes, which may depend on the options (stages, nodes). */
    int (*nodes)(const double options[]);   /* 2 */
    int (*strains)(const double options[]); /* 8 */
    int (*inner)(const double options[]);   /* element unknowns of its own: 0 */
    int (*memory)(const double options[]);  /* doubles kept between stress and update: 0 */

    /* Optional: of types with inner unknowns. */
    /* inner += (correction from the last stress) for the strain increment de; returns the
     * dimensionless size of the change. */
    double (*update)(const element_data *, const double de[], const double memory[],
                     double inner[]);
    /* Inner unknowns of the undeformed state: zero. */
    void (*rest)(const element_data *, double inner[]);

    /* Optional: further physics. */
    /* G[strains x strains] = derivative of C at e = 0 in the direction of the prestress sigma: sum
     * sigma_i Q_i: zero. */
    void (*geometric)(const element_data *, const double sigma[], double G[]);
    /* frame NULL: the frame is at rest. Default (NULL): the mass of the displacement field that is
     * exact without loads (field/field.h), lumped for three nodes. */
    status (*inertia)(const element_data *, const node_state x[], const element_rotating_frame *,
                      inertia_output *);

    /* Optional: many elements at once, where that costs less than one after the other (lanes over
     * elements, another process): the same values in any order and number. data[count], one for
     * each element: elements of one kind share theirs and often follow each other. x[count x
     * nodes]; all of out[count] want the same outputs. */
    void (*strain_many)(int count, const element_data *const data[], const node_state x[],
                        strain_output out[]);
    /* e[count][strains], inner[count][inner], outcome[count]. */
    void (*stress_many)(int count, const element_data *const data[], const double *const e[],
                        const double *const inner[], stress_output out[], status outcome[]);
    /* outcome[count]. */
    void (*force_many)(int count, const element_data *const data[], const node_state x[],
                       force_output out[], status outcome[]);

    /* Optional: in place of nodes, strains and order where no option changes them. */
    const element_constants *constants;
    /* Optional: why nothing that was computed since the last question counts, one line; NULL:
     * nothing is wrong. */
    const char *(*trouble)(const element_data *);
    /* Optional: how many of one kind strain_many and stress_many evaluate in one go (lanes of the
     * processor): this number is requested at a time. 0: as many as there are (another process). */
    int lanes;
    /* Optional: strains, stresses and the equations that follow from them in one go, the bits of
     * those one after the other. s[count][strains]: independent stresses. */
    void (*equations_many)(int count, const element_data *const data[], const node_state x[],
                           const double *const e[], const double *const inner[],
                           const double *const s[], equations_output out[], status outcome[]);
    /* Optional: 1: `inertia` of two nodes gives what motions in time with consistent mass need
     * (rate and what is below it). 0: they have the mass lumped at the nodes. Of a type without
     * `inertia`: 1. */
    int spreads;
    /* For LIMIT_TENSION: length of the element over the largest one that the axial force of its
     * stresses allows; 0: any. */
    double (*tension)(const element_data *, const double sigma[]);
    /* A formulation kept as it was printed: the equation and what is wrong in it, one line. It is
     * never ranked, chosen or counted in an agreement. NULL: none. */
    const char *misprint;
    /* Optional: forces along elements of two nodes that keep their direction, inside the element's
     * own equilibrium, of count elements: x[count x nodes], outcome[count]. Default (NULL), and for
     * follower loads, moments, and in scenes with a motion: their work on one field of
     * displacements between nodes, for all types alike. */
    void (*along)(int count, const element_data *const data[], const node_state x[],
                  along_output out[], status outcome[]);
    /* Optional: 1: with these options `inertia` of two nodes at rest is that of the displacement
     * field which is exact without loads (field/field.h): frequencies are improved by what is
     * inside of the element.  0: they are those of the mass matrix alone.  Of a type without
     * `inertia`: 1. */
    int (*mass_of_field)(const double options[]);
    /* Optional: the same element, but that it has an elongation and curvatures about y and z
     * [1, 1/m, 1/m] more without stress; x: its nodes where it is free; out: its data, as large.
     * Strains stay those of the nodes. Default (NULL): strains are counted from those of x, an
     * error of second order in curvature where stresses follow from the sizes of strains. */
    void (*unstressed)(const element_data *, const double more[3], const node_state x[],
                       element_data *out);
} element_type;

static inline element_order element_order_in(const element_type *t, element_analysis a,
                                             const double options[])
{
    const element_order usual = {2, 4};
    if (t->order)
        return t->order(a, options);
    return t->constants && t->constants->order[a].highest > 0 ? t->constants->order[a] : usual;
}
/* Order in transient analyses: masses along elements have four in slender bending and two with
 * shear, stretch and twist, lumped at two nodes two. */
static inline element_order element_order_of_motion(void)
{
    return (element_order){2, 4};
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
/* 1: motions in time can have its mass along the element. */
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

#endif
