/* A scene: pure data that says what a structure is, how it is held and driven,
 * what is analysed and which quantities are wanted.  No solver is called here
 * and no formulation is known: a file could hold the same data.
 *
 * Every scene_* function that adds something returns its index in its list, or
 * -1 when memory ran out (scene_valid then says so once, at the end). */
#ifndef BEAMWORK_SCENE_H
#define BEAMWORK_SCENE_H

#include "cases/scene/analysis.h"
#include "cases/scene/function.h"
#include "cases/scene/quantity.h"
#include "elements/feature.h"
#include "elements/section/section.h"
#include "elements/shared/status.h"

/* Of a limit, relative: what engineers ask of a model. A limit of its own within it is seen all the
 * same, by its uncertainty. */
#define SCENE_TOLERANCE 1e-3

/* Most numbers of elements that a scene or a command gives. */
enum { SCENE_MESHES = 24 };

/* Components of a node: three translations, three rotations (fixed axes). */
enum { SCENE_UX, SCENE_UY, SCENE_UZ, SCENE_RX, SCENE_RY, SCENE_RZ };

/* What an end of a member does with its warping coordinate. A value >= 0 is a name: ends with the
 * same value share it. */
enum { SCENE_WARP_FREE = -1, SCENE_WARP_FIXED = -2 };

/* How one coordinate moves. A value >= 0 is a driver's index. */
enum { SCENE_FREE = -1, SCENE_HELD = -2 };

/* Held in a plane: nothing leaves it, neither the nodes nor what lies between them; warping is
 * held.
 */
typedef enum scene_plane {
    SCENE_SPACE,
    SCENE_PLANE_YZ,
    SCENE_PLANE_XZ,
    SCENE_PLANE_XY
} scene_plane;
#define SCENE_PLANE_CHOICES "yz|xz|xy"

typedef enum scene_rotation {
    SCENE_ROTATION_SPATIAL,  /* three increments about fixed axes, each free or held (all held:
                                clamped) */
    SCENE_ROTATION_SEQUENCE, /* R = exp(axis_1 t_1) exp(axis_2 t_2) exp(axis_3 t_3); each angle
                                free, held or driven */
    SCENE_ROTATION_VECTOR, /* rotation vector = its three drivers' values: prescribed entirely, any
                              path */
    SCENE_ROTATION_FORK /* no turn about the section's own axis, the other two free: see scene_fork
                         */
} scene_rotation;

/* A rigid body that moves with a node. */
typedef struct scene_body {
    double mass;       /* [kg] */
    double centre[3];  /* of mass, from the node, undeformed [m] */
    double inertia[6]; /* of the undeformed body about its centre, about axes through it along x, y,
                          z: Ixx, Iyy, Izz = int (y^2 + z^2) dm ..., and the tensor's Ixy, Iyz, Izx
                          = -int x y dm ... [kg m^2] */
} scene_body;

typedef struct scene_node {
    double position[3]; /* [m] */
    int attached;       /* node this one is rigidly attached to (a rigid body is a node others are
                           attached to), or SCENE_NONE */
    int translation[3]; /* SCENE_FREE, SCENE_HELD or a driver */
    scene_rotation rotation;
    int angle[3]; /* SCENE_FREE, SCENE_HELD or a driver: of the spatial components, the angles or
                     the vector */
    double axis[3][3]; /* of the sequence; a zero axis ends it. Of a fork: the section's own axis,
                          and the web's direction */
    scene_body body;
    char name[SCENE_NAME]; /* "": none, as of every entry; cases/scene/names.h */
} scene_node;

/* What an end of a member does not pass on to its node, in the member's axes there (y as in
 * scene_member): turns, in their order, and shifts.  The end is at r + R_end s, R_end = R exp(a_1
 * t_1) exp(a_2 t_2) with the node's r, R: of two turns the axis of the first stays with the node,
 * that of the second with the member (a universal joint), shifts are along the turned end.  Three
 * turns are those of a ball. */
enum { SCENE_RELEASED = 5 };
typedef struct scene_release {
    int count;                     /* 0: joined */
    int component[SCENE_RELEASED]; /* SCENE_UX .. SCENE_RZ, each once */
} scene_release;

typedef struct scene_member {
    int p, q;
    int section, section_q; /* at p and at q; between them it changes linearly in its numbers
                               (elements/section/taper.h), each element has that of its middle */
    double y_axis[3]; /* direction of the y axis in which the section is described (its part across
                         the member) */
    int warp_p, warp_q;  /* SCENE_WARP_FREE, SCENE_WARP_FIXED or a shared name */
    double curvature[3]; /* initial torsion, curvatures about local y and z [1/m]; position of
                            interior nodes follows the arc */
    double strain[3];    /* initial elongation and shear strains that would leave no stress: heat, a
                            misfit */
    scene_release release[2]; /* at p, q */
    int divisions;            /* 0: the mesh's -n; else this many elements always */
    double damping; /* of motions: stresses gain damping x stiffness at rest x rates of the
                       strains [s] */
    char name[SCENE_NAME];
} scene_member;

/* Between two nodes, or a node and the ground: energy 1/2 d^T K d with d of the six components of
 * q's frame against p's since the undeformed state, in axes that turn with p and were the fixed
 * ones: how far apart, from the initial distance [m], and the rotation vector [rad], of less than 3
 * rad. */
typedef struct scene_spring {
    int p, q;             /* p: SCENE_NONE: the ground */
    double stiffness[36]; /* K, symmetric, row-major [N/m, N, N m] */
    double asymmetry;     /* of K as it was given, in parts of its diagonal: the mean is taken */
    char name[SCENE_NAME];
} scene_spring;

/* One scalar that moves coordinates; piecewise linear in the path parameter between its stations.
 */
typedef struct scene_driver {
    char name[SCENE_NAME];
    int stations;
    double *path, *value; /* [stations]; value in m or rad; NULL: unknown, fixed by the condition */
    scene_function function; /* of time in place of them; no pieces: none */
    int condition_node,
        condition_component; /* unknown driver: this coordinate is prescribed instead, by ... */
    int condition_driver;    /* ... the value of this driver; SCENE_NONE for a known driver */
} scene_driver;

typedef enum scene_load_kind {
    SCENE_FORCE,              /* [N] at a node */
    SCENE_MOMENT,             /* [N m] at a node */
    SCENE_DISTRIBUTED,        /* [N/m] along a member, per initial length */
    SCENE_DISTRIBUTED_MOMENT, /* [N m/m] along a member */
    SCENE_GRAVITY,            /* [m/s^2] on the mass of a member */
    SCENE_WEIGHT,             /* [m/s^2] on the mass of the body of a node, at its centre */
    SCENE_MEMBER_FORCE,       /* [N] at a place within a member */
    SCENE_MEMBER_MOMENT       /* [N m] at a place within a member */
} scene_load_kind;

/* Axes of a load: fixed, or those of its member before it is deformed, y as in scene_member. */
typedef enum scene_load_axes { SCENE_AXES_FIXED, SCENE_AXES_MEMBER } scene_load_axes;

typedef struct scene_load {
    scene_load_kind kind;
    int where;        /* node, or member: scene_load_along */
    double vector[3]; /* in `axes`, of the undeformed structure; at range[0] where it varies */
    double last[3];   /* where it varies: at range[1], linear between */
    int varies;       /* 0: the vector is the same all over the range */
    double range[2]; /* of a member, in parts of its initial length from p: where a distributed load
                        begins and ends (0 and 1: all of it, as of gravity); of a force or a moment
                        at a place both are that place. 0 and 0 of loads at nodes */
    int lumped;      /* of loads along a member: 0: it does its work on the displacements within the
                        elements; 1: an element's share goes to its nodes, halves to both, of order
                        two */
    double at[3];    /* of forces, in `axes`: where they act, from the node or the centroids, with
                            which it turns [m] */
    scene_load_axes axes; /* of both */
    int follower; /* 0: its direction stays (dead); 1: it turns with the node or the sections */
    int stations; /* 0: proportional to the path parameter (factor = path) */
    double *path, *factor;
    scene_function function; /* the factor over time in place of them; no pieces: none */
    char name[SCENE_NAME];
} scene_load;

/* What a section is called and came to, and of which description. */
typedef struct scene_computed {
    int known;
    section_spec of;
    section constants;
    char name[SCENE_NAME];
} scene_computed;

/* Physics that a scene may leave out: FEATURE_* bits. */
enum {
    SCENE_OMITTABLE = FEATURE_SHEAR | FEATURE_TRAPEZE | FEATURE_WAGNER_MOMENTS |
                      FEATURE_WAGNER_TORQUE | FEATURE_ROTARY_INERTIA | FEATURE_WARPING
};

/* Theory of shear in stability that a scene asks for. */
typedef enum scene_shear {
    SCENE_SHEAR_HARINGX,
    SCENE_SHEAR_ENGESSER,
    SCENE_SHEAR_OWN /* of each formulation the one that it has */
} scene_shear;
/* Those that a truth depends on. */
#define SCENE_SHEAR_THEORIES "engesser|haringx"

struct scene {
    char name[SCENE_NAME];
    int sections, nodes, members, springs, drivers, loads, analyses, quantities;
    section_spec *section;
    int computeds;
    scene_computed *computed; /* [computeds] kept by scene_constants */
    scene_node *node;
    scene_member *member;
    scene_spring *spring;
    scene_driver *driver;
    scene_load *load;
    scene_analysis *analysis;
    scene_quantity *quantity;
    scene_plane plane; /* that all is held in; SCENE_SPACE: none */
    unsigned omits;    /* of SCENE_OMITTABLE what the scene leaves out: scene_omit sets them */
    unsigned demands;  /* FEATURE_* bits beyond what its data call for: scene_demand sets them */
    scene_shear shear_theory;
    int lumped; /* 1: the mass of members is at nodes, but in motions that say otherwise */
    int meshes; /* default -n values of verify and converge */
    int mesh[SCENE_MESHES];
    int out_of_memory;
    /* What is pointed to when memory ran out, so that a case can write without asking. */
    union {
        scene_node node;
        scene_member member;
        scene_load load;
        scene_quantity quantity;
    } scrap;
};

void scene_init(scene *s, const char *name);
void scene_free(scene *s);

int scene_add_section(scene *s, const section_spec *spec);
int scene_add_node(scene *s, double x, double y, double z);
int scene_add_attached(scene *s, int body, double x, double y,
                       double z); /* absolute undeformed position */
int scene_add_member(scene *s, int p, int q, int profile,
                     const double y_axis[3]); /* profile: a section of the scene, at both ends */
/* Does its section change along it?  Does that of any member? */
int scene_member_tapers(const scene_member *m);
int scene_tapers(const scene *s);
/* The end of a member (0 at p, 1 at q) keeps this component to itself, behind those that it has
 * been told; more than SCENE_RELEASED are refused by scene_validate. */
void scene_release_end(scene *s, int member, int end, int component);
int scene_add_spring(scene *s, int p, int q, const double stiffness[36]);
int scene_add_driver(scene *s, const char *name, int stations, const double path[],
                     const double value[]);
/* A driver by a function of time, to be given in pieces. */
int scene_add_moving_driver(scene *s, const char *name);
/* A piece of the function of a driver or of the factor of a load, behind those that it has; until
 * [s]: of the last one for ever. */
void scene_drive_piece(scene *s, int driver, double until, const char *text);
void scene_load_piece(scene *s, int load, double until, const char *text);
int scene_add_unknown_driver(scene *s, const char *name, int node, int component,
                             int condition_driver);
/* A load that stays, all along its member where it is distributed. */
scene_load scene_load_of(scene_load_kind kind, int where, double x, double y, double z);
int scene_add_load(scene *s, scene_load_kind kind, int where, double x, double y, double z);
/* A force or a moment within a member: place: 0 at p .. 1 at q, of the initial length. */
int scene_add_load_within(scene *s, scene_load_kind kind, int member, double place, double x,
                          double y, double z);
/* Entry of the list, to say more of it; never NULL. */
scene_load *scene_load_at(scene *s, int index);
/* Does it act on a member: along it, or at a place within it? */
int scene_load_along(const scene_load *load);
/* At a place within a member? */
int scene_load_within(const scene_load *load);
/* Is its vector a moment, not a force? */
int scene_load_turns(const scene_load *load);
/* Is it not zero all over its range? */
int scene_load_acts(const scene_load *load);
/* May its stiffness make a tangent unsymmetric? Not that of a load of zero. */
int scene_load_unsymmetric(const scene_load *load);
/* The load is its vector times a factor, piecewise linear over the path parameter. */
void scene_set_factor(scene *s, int load, int stations, const double path[], const double factor[]);
/* Entry of a list, to be filled further; never NULL. */
scene_node *scene_node_at(scene *s, int index);
scene_member *scene_member_at(scene *s, int index);
void scene_hold(scene *s, int node, int first,
                int last); /* components SCENE_UX .. SCENE_RZ, inclusive */
void scene_hold_all(scene *s, int node);
void scene_drive(scene *s, int node, int component,
                 int driver); /* a translation, or a spatial rotation component */
/* A fork: its guides stand on both sides of the web, and their normal n = web x axis is fixed.  The
 * web stays between them, R web . n = 0, whichever way the section is bent: R = exp(n t_1) exp(web
 * t_2).  While the bending is in the plane of axis and web, the section does not turn about its own
 * present axis, R axis, and the fork's moment is along it.  (A held SCENE_RX is a moment along the
 * fixed x axis.) axis, web: of the undeformed section, at right angles, of any length. Translations
 * are held by themselves. */
void scene_fork(scene *s, int node, const double axis[3], const double web[3]);
/* A body of its own, at the node itself or beside it, rigidly joined to it. */
void scene_set_body(scene *s, int node, scene_body body);
/* Has the node a mass or an inertia? */
int scene_has_body(const scene_node *n);
/* Has anything? */
int scene_has_mass(const scene *s);
/* Turns of a node that all its members release and nothing else meets, so that it has no angle of
 * its own there and is held: 0: none; SCENE_IDLE_AXIS: about `axis`, which turns with it. */
enum { SCENE_IDLE_AXIS = 1, SCENE_IDLE_ALL };
int scene_idle_turn(const scene *s, int node, double axis[3]);
/* Convention of moments that a quantity depends on, or NULL. */
const char *scene_convention(const scene *s, const scene_quantity *q);
/* The axis across the plane that the scene is held in, 0 to 2, or SCENE_NONE. */
int scene_normal(const scene *s);
/* "xy"; "" in space. */
const char *scene_plane_name(const scene *s);
/* Leaves physics (bits of SCENE_OMITTABLE) out. A scene has all that its sections, loads and
 * analyses call for, but for this. */
void scene_omit(scene *s, unsigned features);
/* FEATURE_* bits that a formulation must offer beyond what the data call for. */
void scene_demand(scene *s, unsigned features);
void scene_meshes(scene *s, int count, const int mesh[]);
/* first, twice that, and so on up to last. */
void scene_meshes_doubled(scene *s, int first, int last);

/* What section i comes to; computed once, and again when its description has changed.  Not for two
 * threads at once. */
status scene_constants(const scene *s, int i, section *out, fault *f);

/* Indices in range, members of positive length, supports that do not contradict, drivers that are
 * used, curves and names unique: refused with the culprit. */
status scene_validate(const scene *s, fault *f);

#endif
