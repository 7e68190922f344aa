/* What is wanted of an analysis: a name, how it is judged, and what is extracted, one struct for
 * each kind.  What a kind has is read through its function below, which ends the program when the
 * quantity is of another kind: nothing else names the union. */
#ifndef BEAMWORK_SCENE_QUANTITY_H
#define BEAMWORK_SCENE_QUANTITY_H

#include "cases/scene/analysis.h"

typedef struct scene scene;

typedef enum scene_quantity_kind {
    SCENE_COORDINATE,       /* displacement or rotation-vector component of a node */
    SCENE_REACTION,         /* of a prescribed component at a node */
    SCENE_COMPLIANCE_ENTRY, /* of the 6 x 6 matrix of the analysis' node */
    SCENE_STIFFNESS_ENTRY,  /* 1 / compliance entry (i, i), only the non-held coordinates free */
    SCENE_CRITICAL_FACTOR,  /* load factor of linear buckling */
    SCENE_GROWTH,           /* largest rate of growth of a small motion [1/s]; 0: stable */
    SCENE_FREQUENCY,        /* [Hz] */
    SCENE_FACTOR_AT,        /* load factor of a continuation where the control coordinate is ... */
    SCENE_CRITICAL_POINT,   /* of a continuation */
    SCENE_DRIVER_VALUE,     /* of an unknown driver */
    SCENE_INTERNAL,         /* resultant of the stresses on a section of a member */
    SCENE_STRESS,           /* largest of a section or a member */
    SCENE_RATE,             /* velocity of a node, or its angular velocity in its own axes */
    SCENE_BALANCE,          /* energy or momentum of a motion */
    SCENE_RELATIVE,         /* displacement or rotation of a node in the axes of another */
    SCENE_READING           /* what a file of cases/quantities reads of nodes, as it says itself */
} scene_quantity_kind;

/* A point of a path at which the tangent stiffness is singular. */
typedef enum scene_critical { SCENE_LIMIT_POINT, SCENE_BIFURCATION } scene_critical;

typedef enum scene_family {
    SCENE_ANY,
    SCENE_NOT_AXIAL,
    SCENE_AXIAL,
    SCENE_BENDING_Y,
    SCENE_BENDING_Z,
    SCENE_TORSION
} scene_family;

typedef enum scene_reduction {
    SCENE_LAST,
    SCENE_MAX,
    SCENE_MIN,
    SCENE_AT,
    SCENE_CURVE,
    /* of a motion, wherever its stations lie: places and rates only */
    SCENE_MAX_TIME,   /* when the largest value is met [s] */
    SCENE_MIN_TIME,   /* when the least one is [s] */
    SCENE_CROSSING,   /* when a level is passed [s] */
    SCENE_PERIOD,     /* from one crossing to the next of its direction, mean of all [s] */
    SCENE_PER_SECOND, /* one by that [Hz] */
    SCENE_MEAN,       /* over time */
    SCENE_REDUCTIONS
} scene_reduction;

/* Which way a level is passed. */
typedef enum scene_direction { SCENE_RISING, SCENE_FALLING, SCENE_EITHER } scene_direction;
#define SCENE_DIRECTION_CHOICES "rising|falling|either"
#define SCENE_TAKE_CHOICES      "last|max|min|curve|max_time|min_time|crossing|period|per_second|mean"

/* What of a motion a value is taken of. */
typedef struct scene_passing {
    double level; /* as extracted, in SI units */
    scene_direction direction;
    int order;          /* among the crossings of that direction, from 0 */
    double from, until; /* [s] window; until 0: to the end */
} scene_passing;

typedef struct scene_component {
    int node, component; /* SCENE_UX .. SCENE_RZ */
} scene_component;

/* Resultants of the stresses of what lies towards the end q of a member on what lies towards p, in
 * the principal axes of the turned section, moments about its centroid. The parts of the torque add
 * up to that about the shear centre, Mx - (ys Qz - zs Qy): of Saint-Venant's torsion, of the
 * restrained warping (the bimoment falls by it along the member), and of what stresses along the
 * fibres, which the twist turns, add. */
typedef enum scene_resultant {
    SCENE_N,
    SCENE_QY,
    SCENE_QZ,
    SCENE_MX,
    SCENE_MY,
    SCENE_MZ,
    SCENE_BIMOMENT,
    SCENE_MX_SAINT_VENANT,
    SCENE_MX_WARPING,
    SCENE_MX_WAGNER,
    SCENE_RESULTANTS
} scene_resultant;

/* Which section of a member. */
typedef enum scene_along {
    SCENE_ALONG_PLACE,  /* at a place of it */
    SCENE_ALONG_MAX,    /* where the value is largest */
    SCENE_ALONG_MIN,    /* where it is least */
    SCENE_ALONG_LARGEST /* where its magnitude is largest: that magnitude */
} scene_along;

typedef struct scene_internal {
    int member;
    scene_resultant resultant;
    scene_along along;
    double place; /* of SCENE_ALONG_PLACE: 0 at p .. 1 at q, of the initial length */
    int before;   /* of what jumps there: 1 on the side of p, 0 on that of q */
} scene_internal;

/* Of all points of a section (elements/section/stress.h) [Pa]. */
typedef enum scene_stress_measure {
    SCENE_VON_MISES,
    SCENE_NORMAL_MAX, /* along the fibres, tension positive */
    SCENE_NORMAL_MIN
} scene_stress_measure;

typedef struct scene_stress {
    int member;
    scene_stress_measure measure;
    int whole;    /* 1: of all sections of the member; 0: of the one at ... */
    double place; /* 0 at p .. 1 at q, of the initial length */
    int before;   /* as of scene_internal */
} scene_stress;

/* Of a whole motion. */
typedef enum scene_balance {
    SCENE_KINETIC,    /* [J] */
    SCENE_STRAIN,     /* stored in members and springs [J] */
    SCENE_ENERGY,     /* both */
    SCENE_WORK,       /* of loads and of what is driven, since the begin */
    SCENE_DISSIPATED, /* by damping, since the begin */
    SCENE_DRIFT,      /* energy and what was dissipated, less energy of the begin and work */
    SCENE_PX,         /* momentum [kg m/s] */
    SCENE_PY,
    SCENE_PZ,
    SCENE_LX, /* angular momentum about the origin [kg m^2/s] */
    SCENE_LY,
    SCENE_LZ,
    SCENE_BALANCES
} scene_balance;
#define SCENE_BALANCE_CHOICES "kinetic|strain|energy|work|dissipated|drift|px|py|pz|lx|ly|lz"

/* Of a node as seen from another that carries it along: how its place has moved in the axes of
 * that, and its turn against it. */
typedef struct scene_relative {
    int node, component, from;
} scene_relative;

/* What a kind reads that has no struct of its own: as its table of keys says. */
typedef struct scene_reading {
    const struct quantity_type *type;
    int node[4], component[4];
    double number[4];
} scene_reading;

typedef struct scene_entry {
    int row, column; /* response, load: SCENE_UX .. SCENE_RZ */
} scene_entry;

typedef struct scene_critical_load {
    int sign;  /* 1: of positive factors, -1: of negative ones */
    int order; /* among those of the sign by size, from 0 */
} scene_critical_load;

typedef struct scene_mode {
    int order; /* among the modes of the family and half-waves, from 0 */
    scene_family family;
    int half_waves; /* 0: any */
} scene_mode;

typedef enum scene_ordinate { SCENE_LOAD_FACTOR, SCENE_CONTROL } scene_ordinate;

typedef struct scene_point {
    scene_critical kind;
    int order;               /* among the points of the kind along the path, from 0 */
    scene_ordinate ordinate; /* what of it: load factor, or control coordinate [m] */
} scene_point;

/* What is extracted; made by the functions of the kinds. */
typedef struct scene_extract {
    scene_quantity_kind kind;
    union {
        scene_component component; /* coordinate, reaction, rate */
        scene_entry entry;         /* of compliance and stiffness */
        scene_critical_load load;
        scene_mode mode;
        scene_point point;
        int driver;
        scene_internal internal;
        scene_stress stress;
        scene_balance balance;
        scene_relative relative;
        scene_reading reading;
    } of;
} scene_extract;

scene_extract scene_coordinate(int node, int component);
scene_extract scene_reaction(int node, int component);
scene_extract scene_compliance_entry(int row, int column);
scene_extract scene_stiffness_entry(int component);
scene_extract scene_critical_factor(int sign, int order);
scene_extract scene_growth(void);
/* Of any number of half-waves. */
scene_extract scene_frequency(int order, scene_family family);
scene_extract scene_frequency_of(int order, scene_family family, int half_waves);
scene_extract scene_factor_at(void);
scene_extract scene_critical_point(scene_critical kind, int order, scene_ordinate ordinate);
scene_extract scene_driver_value(int driver);
scene_extract scene_rate(int node, int component);
/* Of its rotation matrix: 0 .. 2. */
scene_extract scene_orientation_entry(int node, int row, int column);
scene_extract scene_balance_of(scene_balance what);
scene_extract scene_relative_to(int node, int component, int from);
/* place: 0 at p .. 1 at q, on the side of q */
scene_extract scene_internal_at(int member, double place, scene_resultant resultant);
scene_extract scene_internal_along(int member, scene_along along, scene_resultant resultant);
/* Over a member: of its sections the one that has most, of SCENE_NORMAL_MIN least. */
scene_extract scene_stress_along(int member, scene_stress_measure measure);
scene_extract scene_stress_at(int member, double place, scene_stress_measure measure);
/* A resultant or a stress at a place, on the side of p of what jumps there (before) or of q. */
scene_extract scene_beside(scene_extract what, int before);
/* What scene files call it. */
#define SCENE_STRESS_CHOICES    "von_mises|normal_max|normal_min"
#define SCENE_RESULTANT_CHOICES "N|Qy|Qz|Mx|My|Mz|bimoment|Mx_saint_venant|Mx_warping|Mx_wagner"

/* Abscissa of a curve. */
typedef struct scene_abscissa {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    int is_quantity; /* 1: the curve of the quantity that is called so, station by station, in its
                        unit; else: */
    double factor, offset; /* the path parameter, or the control coordinate, times factor plus
                              offset */
} scene_abscissa;

/* Of an analytic model with an error of its own: shown, never judged. */
typedef struct scene_prediction {
    double value;       /* [unit of the quantity] */
    const char *source; /* NULL: there is none */
} scene_prediction;

typedef struct scene_quantity {
    char name[SCENE_NAME], unit[SCENE_UNIT];
    int analysis;
    scene_extract what;
    scene_reduction reduction; /* of the stations of a path */
    double at;                 /* path parameter or control coordinate, of SCENE_AT */
    scene_passing passing;     /* of a motion */
    scene_abscissa x;          /* of a curve */
    double factor, offset;     /* reported value = factor * extracted value + offset */
    double near_zero;   /* absolute scale for relative errors of values near zero; 0: |value| */
    double tolerance;   /* relative, of the limit against the truth: SCENE_TOLERANCE unless a case
                         says why not */
    double least_order; /* of convergence in the number of elements */
    scene_prediction prediction;
} scene_quantity;

/* The new quantity, to be filled further, never NULL: of the last station, factor 1, tolerance
 * SCENE_TOLERANCE, the rest 0. */
scene_quantity *scene_add_quantity(scene *s, const char *name, const char *unit, int analysis,
                                   scene_extract what);
/* All along the path, over its parameter or the control coordinate times factor plus offset. */
void scene_set_curve(scene_quantity *q, const char *x_name, const char *x_unit, double factor,
                     double offset);
/* All along the path, over another quantity whose curve is of the same stations. */
void scene_set_curve_over(scene_quantity *q, const char *quantity, const char *unit);
/* Index of the quantity that a curve is over; SCENE_NONE: it is over its path. */
int scene_abscissa_of(const scene *s, const scene_quantity *q);
/* At one value of the path parameter or the control coordinate. */
void scene_set_at(scene_quantity *q, double at);
/* Of a motion, of its whole time: SCENE_MAX_TIME to SCENE_MEAN, SCENE_MAX, SCENE_MIN. */
void scene_set_passing(scene_quantity *q, scene_reduction, scene_passing);
/* Is it read between the stations of a motion? */
int scene_is_passed(const scene_quantity *q, scene_analysis_kind);

const scene_component *scene_component_of(const scene_quantity *q);
const scene_entry *scene_entry_of(const scene_quantity *q);
const scene_critical_load *scene_critical_load_of(const scene_quantity *q);
const scene_mode *scene_mode_of(const scene_quantity *q);
const scene_point *scene_point_of(const scene_quantity *q);
int scene_driver_of(const scene_quantity *q);
const scene_relative *scene_relative_of(const scene_quantity *q);
scene_balance scene_balance_in(const scene_quantity *q);
const scene_internal *scene_internal_of(const scene_quantity *q);
const scene_stress *scene_stress_of(const scene_quantity *q);
/* Is it of this kind and this analysis? */
int scene_asks(const scene_quantity *q, int analysis, scene_quantity_kind kind);
/* Is the analysis read: by a quantity, or by an analysis that follows it and is read itself? Where
 * there are no quantities, all of them are. */
int scene_reads(const scene *s, int analysis);
/* Takes away the quantities whose names the other scene does not have. */
void scene_keep_quantities(scene *s, const scene *of);
/* Of a response to a force or a moment, SCENE_UX to SCENE_RZ both. */
const char *scene_compliance_unit(int row, int column);
/* Can it be extracted from an analysis of this kind? */
int scene_gives(scene_analysis_kind analysis, const scene_quantity *q);

#endif
