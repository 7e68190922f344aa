/* model/: a scene meshed with one formulation.
 *
 * Sections, in this order: model and its coordinates; matrix patterns; centre lines; division;
 * mesh; discrete elements; description of the division; eliminate; assemble; features; kinematics;
 * metric; missing; state; movable; loads put on nodes; sections that change; release; spring;
 * supports; turns; warping of ends. */
#ifndef BEAMWORK_MODEL_H
#define BEAMWORK_MODEL_H

#include <stddef.h>

#include "cases/scene/scene.h"
#include "elements/element.h"
#include "elements/field/field.h"
#include "elements/shared/status.h"
#include "harness/numerics/numerics.h"

/* A scene meshed with one formulation.
 *
 * Coordinates.  Every vertex of the mesh has a frame (position r, orientation q), and every element
 * end has a warping amplitude.  Scalars that can change are the model's coordinates, in this order:
 *   [0, free)                          unknowns
 *   [free, free + driven)              prescribed along the path by drivers
 * Scalars that are fixed or depend on other coordinates (rigid offsets, rotation
 * sequences, shared angles) are eliminated: they have no coordinate.  An unknown driver is a
 * prescribed coordinate whose increment is found together with the free coordinates; the coordinate
 * that its condition names is free.
 *
 * Increments of translations, warping and angles are additive; those of free rotations are spatial
 * rotation increments (exponential chart). All second derivatives (offsets, sequences) are included
 * in the tangent. */

typedef struct model model;

typedef struct model_request {
    const scene *scene;
    const element_type *type;
    const double *options; /* of the formulation; NULL: defaults */
    int elements;          /* per member */
    int keep_all;          /* 1: no elimination (same results, more work) */
    unsigned omit; /* physics of the scene to omit in addition to what the type does not support */
} model_request;

/* Creates the model and omits physics of the scene that the formulation does not support;
 * model_left_out lists it. REFUSED: no solvable problem remains, for the reason in
 * missing_refused. */
status model_alloc(const model_request *, model **, fault *);
void model_free(model *);

/* The initial shape due to a scene's imperfections: a copy of the scene with shifted nodes, bodies
 * and offsets rotated with them, and the shifts of members between nodes. */
typedef struct model_imperfect model_imperfect;
/* x[free + driven]: sum of the modes of the perfect model. The imperfections that shift nodes are
 * added here, as if the nodes had been given at the shifted positions. */
status model_imperfect_alloc(const model *perfect, const double x[], model_imperfect **, fault *);
void model_imperfect_free(model_imperfect *);
/* Creates the model with that shape, which must outlive the model. */
status model_imperfect_build(const model *perfect, const model_imperfect *, model **, fault *);
/* Sets shift[3] to the largest shift of a point of a member in a mode x, the first one if several
 * are equal. */
void model_largest_shift(const model *, const double x[], double shift[3]);

typedef struct model_size {
    int elements, vertices, free, driven, strains,
        inner; /* strains and internal unknowns: of each element */
    int kinds; /* of elements; identical elements share a kind, which is prepared once */
    unsigned features;
} model_size;
model_size model_sizes(const model *);
/* Returns 1 if elements have a consistent mass in this motion. */
int model_spreads(const model *, int analysis);
/* Creates the same model with one element per member. */
status model_coarse(const model *, model **, fault *);
/* Creates the same model with twice as many elements. */
status model_halved(const model *, model **, fault *);
const scene *model_scene(const model *);
int model_keeps_all(const model *); /* model_request.keep_all */
/* Returns the vertex that moves this one rigidly, or the vertex itself if it has its own
 * coordinates. */
int model_body(const model *, int vertex);
/* Returns 1 if the vertex belongs to a released end; these vertices follow those of the nodes. */
int model_is_released(const model *, int vertex);
/* Returns the length of the longest member [m], to which displacements are compared. */
double model_length(const model *);
double model_mass(const model *); /* mass of all members [kg] */

/* Returns the physics of the scene that the model includes, as FEATURE_* bits. */
unsigned model_features(const model *);
/* Sets *lines to the eliminated coordinates and the omitted physics, one line each ("warping
 * coordinates of 12 ends: nothing warps there"), and returns their number. */
int model_left_out(const model *, const char *const **lines);

/* Returns one line that explains why the results since the last call are invalid
 * (element_type.trouble); NULL: they are valid. */
const char *model_trouble(const model *);

/* Everything that changes along a path. A copy undoes a rejected step. */
typedef struct model_state model_state;

const char *model_formulation(const model *);
const double *model_options(const model *); /* all options of its formulation */
unsigned model_leaves(const model *);       /* LEAVES_* of its formulation */
/* Fills the shape of a mode or state, for identification and pictures: displacement (3), rotation
 * (3) and warping of every vertex, in order along the members. Returns the number of vertices. u:
 * [vertices x 7]; position: [vertices x 3], undeformed. */
int model_shape(const model *, const double x[], double *u, double *position);
int model_member_vertices(const model *, int member,
                          int vertex[]); /* n + 1 in order; NULL: only their number */

/* Returns the number of stresses of all elements and springs: elements x strains, then six per
 * spring. */
int model_stresses(const model *);
/* Returns the section constants that the model uses for a section of the scene. */
const section *model_section(const model *, int index);

/* Patterns of the matrices of a model. */

/* Patterns of one model that are in use. */
typedef struct assemble_patterns assemble_patterns;
status assemble_patterns_alloc(assemble_patterns **, fault *);
void assemble_patterns_free(assemble_patterns *);

/* Returns a symmetric pattern for the undeformed state. `with_driven` 0: free x free; 1: all
 * coordinates. It is made at the first call and stored; sparse_alloc_like makes matrices on it. */
status assemble_pattern(const model *, assemble_patterns *, int with_driven, const sparse **out,
                        fault *f);
/* Sets *out to the pattern of the tangent in any state. It is stored in full if a load may make
 * tangents unsymmetric; the values then decide whether such a matrix is symmetric. */
status assemble_pattern_of_states(const model *, assemble_patterns *, int with_driven,
                                  const sparse **out, fault *f);
/* Like assemble_pattern_of_states, but always stored in full, for states of a motion. */
status assemble_pattern_whole(const model *, assemble_patterns *, int with_driven,
                              const sparse **out, fault *f);
/* Sets *out to the pattern for the undeformed state, stored in full if springs or, with `damped`,
 * dashpots are not symmetric. */
status assemble_pattern_at_rest(const model *, assemble_patterns *, int damped, int with_driven,
                                const sparse **out, fault *f);
/* Returns 0 if a load, a spring or a support may make tangents unsymmetric. */
int assemble_symmetric(const model *);
/* Sets *out to the free x free pattern for motions, which is always stored as unsymmetric, because
 * rotating masses have unsymmetric tangents. */
status assemble_pattern_in_time(const model *, assemble_patterns *, const sparse **out, fault *f);

/* Centre lines of all members in a state, for pictures and other programs. Between two vertices of
 * the mesh the line is a cubic with the vertices' x axes as tangents. It is independent of the
 * displacement field of the formulation. Resultants are in equilibrium with the element's nodal
 * forces J^T sigma. */

typedef struct centreline_point {
    double r[3];      /* position [m] */
    double q[4];      /* of the section's triad: x along the line, y and z principal */
    double force[3];  /* N, Qy, Qz [N] on the part before the point, in that triad */
    double moment[3]; /* Mx, My, Mz about the point [N m] */
    double bimoment;  /* linear between an element's ends [N m^2] */
} centreline_point;

/* Returns the number of points of all members. first[members + 1]: index of the first point of each
 * member; NULL: not needed. */
int centreline_points(const model *m, int first[]);
/* Fills out[points] in the order of the members, each from p to q. */
void centreline_fill(const model *m, const model_state *s, centreline_point out[]);
/* Positions of the scene's nodes: out[nodes x 3] [m]. */
void centreline_nodes(const model *m, const model_state *s, double out[]);
/* Creates a state: `from` moved by scale x the increments x[free + driven]. sigma[elements x
 * strains]: its stresses; NULL: those of `from`. scale 0: selects a scale that makes the
 * displacement visible (a tenth of the scene's size or half a radian). *scale returns the scale
 * used. */
status centreline_displaced(const model *m, const model_state *from, const double x[],
                            const double sigma[], double *scale, model_state **out, fault *f);

/* How the members of a scene are divided into elements.
 *
 * The mesh has a node where a load starts, ends or acts within a member, because resultants have a
 * slope discontinuity or a jump there, which an element cannot represent. Each of these pieces has
 * the requested number of elements of equal length. A mesh of twice this number contains all nodes
 * of the coarser one. */

typedef struct division {
    int *first;    /* [members + 1] number of pieces before each member */
    double *place; /* [pieces + 1] ends of the pieces, 0 .. 1 of the initial length; a member starts
                      at place[first[member] + member] */
    int *each;     /* [members] elements per piece */
} division;

/* Smallest length of a piece, relative to its member; a shorter piece lies inside an element. */
#define DIVISION_LEAST 1e-3

/* Returns the position along the member of a point x in [0, 1] of an element; the second function
 * returns the inverse. */
double division_place(const division *, int member, int number, double x);
double division_inside(const division *, int member, int number, double place);
/* Returns the element at a position along a member and sets *x to the point in it. Between two
 * elements, this is the one towards the end of the member or, if `before` is 1, towards its
 * start. */
int division_at(const division *, int member, double place, int before, double *x);

/* The mesh of a model, read-only: elements, vertices and their connections. It does not change
 * after model_alloc. */

/* Largest number of coordinates of an element: those of its nodes and of released ends. */
enum {
    NONE = -1,
    VERTEX_COORDINATES = 6,
    MODEL_MAX_COORDINATES = ELEMENT_MAX_COORDINATES + 2 * SCENE_RELEASED
};

/* A frame, and the body that moves it. The first vertices are the scene's nodes, in order. */
typedef struct mesh_vertex {
    double position[3]; /* undeformed [m] */
    int body; /* vertex that moves this one rigidly; the vertex itself if it has its own coordinates
               */
    double offset[3];  /* from the body, undeformed [m] */
    int coordinate[6]; /* if it is a body: global coordinates, NONE where fixed */
    int turned; /* 1: its translations are along the columns of `along`, not the fixed axes */
    double along[9];
    int led, leader; /* 1: it moves with the master of a diaphragm, on an arm about the master's
                        first axis */
    double arm[3];   /* [m] across that axis */
    int angles;      /* > 0: the rotation is a sequence of this number of angles about the axes */
    double axis[3][3];
    int idle;             /* bits of angles that are fixed because nothing depends on them */
    int vector_driver[3]; /* drivers of the prescribed rotation vector; NONE: not prescribed */
} mesh_vertex;

/* End release of a member: see scene_release. */
typedef struct mesh_release {
    int node; /* node of the scene from which it is released */
    int turns, slides;
    double turn[3][3], slide[3][3]; /* unit vectors in the undeformed state */
    int turn_of[3], slide_of[3];    /* the components, SCENE_UX .. SCENE_RZ */
} mesh_release;

/* A warping amplitude, shared by the element ends that meet there. */
typedef struct mesh_warp {
    int coordinate; /* global */
} mesh_warp;

typedef double mesh_triad[9]; /* columns nX nY nZ */

typedef struct mesh_element {
    int kind, member;
    int nodes;
    int vertex[ELEMENT_MAX_NODES];
    int warp[ELEMENT_MAX_NODES];     /* index, or NONE: fixed at zero or absent */
    double share[ELEMENT_MAX_NODES]; /* share of its mass at each node if lumped: mesh.c */
    double couple[2];  /* for two nodes: added to resultants at an end: time/deformable.c */
    mesh_triad *triad; /* [nodes] initial; identical triads are shared; not owned */
    int columns;       /* after elimination: 7 per node, then those of released ends */
    int index[MODEL_MAX_COORDINATES]; /* global coordinate of each, or NONE */
    int plain; /* 1: no offset, sequence or released end: elimination is selection */
} mesh_element;

/* A discrete element in addition to those of the members: the mass of a rigid body at a vertex, or
 * a spring between vertices. */
typedef struct mesh_discrete {
    mesh_element el; /* without kind and warping; `member` is set for a foundation only */
    const scene_body *body;
    const scene_spring *spring; /* exactly one is not NULL */
    mesh_triad triad[ELEMENT_MAX_NODES];
} mesh_discrete;

/* Rates of the deformations d of all springs: known + g (d - from), where known and from have the
 * size [6 x springs]. */
typedef struct spring_rates {
    double g;
    const double *known, *from;
} spring_rates;

/* Data that identical elements share. */
typedef struct mesh_kind {
    int section;
    double length, curvature[3], strain[3];
    double free[3]; /* elongation, and principal curvatures about y and z (in addition to
                       `curvature`), in the unstressed state */
    int next;       /* another kind with the same section, or NONE */
    element_data *data;
    size_t data_size;         /* [bytes] */
    displacement_field field; /* displacements between the nodes, for loads */
    double
        *inner; /* field_inner if frequencies are requested; NULL: the type computes its own mass */
} mesh_kind;

/* Data that the inline functions below read: the first member of every model. Only harness/model
 * sets it. */
typedef struct model_mesh {
    const element_type *type;                       /* completed by adapters_complete */
    int nodes, coordinates, strains, inner, memory; /* numbers per element */
    int vertices, elements, kinds, warps;
    int first_release, releases; /* vertices of released ends are the last ones */
    mesh_release *release;
    mesh_vertex *vertex;
    mesh_element *element;
    mesh_kind *kind;
    mesh_warp *warp;
    int discretes, springs; /* springs: the last ones of the discretes */
    mesh_discrete *discrete;
    int turns;              /* number of rotation vectors that are tracked */
    int *first_element;     /* [members + 1] */
    int *driver_coordinate; /* [drivers] or NONE */
    int free, driven;
    int takes;      /* elements take loads along them (element_type.along) */
    int frees;      /* temperatures or prestrained members exist */
    int work_size;  /* doubles of an element in a linear_memory: harness/newton/newton.h */
    scene_tie *tie; /* [6 nodes]: coordinates of nodes in constraints; NULL: none */
    int *joined;    /* [2 nodes]: model_first_joined, model_next_joined; NULL: none */
} model_mesh;
static inline const model_mesh *model_mesh_of(const model *m)
{
    return (const model_mesh *)m;
}

/* Sizes of an element: its type, number of nodes, coordinates of the nodes (7 each), strains,
 * internal unknowns, and doubles that its type stores from a linearisation. */
static inline const element_type *model_type(const model *m)
{
    return model_mesh_of(m)->type;
}
static inline int model_nodes(const model *m)
{
    return model_mesh_of(m)->nodes;
}
static inline int model_own_coordinates(const model *m)
{
    return model_mesh_of(m)->coordinates;
}
static inline int model_strains(const model *m)
{
    return model_mesh_of(m)->strains;
}
static inline int model_inner(const model *m)
{
    return model_mesh_of(m)->inner;
}
static inline int model_memory(const model *m)
{
    return model_mesh_of(m)->memory;
}
/* Returns 1 if elements take loads along them (element_type.along). */
static inline int model_takes_loads(const model *m)
{
    return model_mesh_of(m)->takes;
}
/* Returns 1 if elements have strains without stress (free_strain_subtract). */
static inline int model_frees(const model *m)
{
    return model_mesh_of(m)->frees;
}
/* Returns the number of doubles of an element in a linear_memory (harness/newton/newton.h). */
static inline int model_work_size(const model *m)
{
    return model_mesh_of(m)->work_size;
}

/* Numbers of coordinates: the unknowns come first, followed by the coordinates that drivers
 * prescribe. */
static inline int model_unknowns(const model *m)
{
    return model_mesh_of(m)->free;
}
static inline int model_driven(const model *m)
{
    return model_mesh_of(m)->driven;
}
static inline int model_all_coordinates(const model *m)
{
    return model_mesh_of(m)->free + model_mesh_of(m)->driven;
}
/* Returns the relation that a node's coordinate follows in a constraint; NULL: none. */
static inline const scene_tie *model_tie(const model *m, int node, int coordinate)
{
    const scene_tie *all = model_mesh_of(m)->tie;
    return all != NULL && all[6 * node + coordinate].node >= 0 ? &all[6 * node + coordinate] : NULL;
}
/* Returns 1 if the body's coordinate is independent or other coordinates in a constraint follow it,
 * and 0 if it follows another one. The rotations of a body follow together. */
static inline int model_owns(const model *m, int vertex, int coordinate)
{
    int owns = 1;
    if (model_mesh_of(m)->tie == NULL || vertex >= model_scene(m)->nodes)
        return 1;
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        const scene_tie *tie = model_tie(m, vertex, c);
        if (tie != NULL && (c == coordinate || (c >= SCENE_RX && coordinate >= SCENE_RX)))
            owns &= tie->node == vertex && tie->coordinate == c;
    }
    return owns;
}
/* Bodies joined by constraints, in ascending order: the first one, and the next one; NONE: there is
 * no next one. */
static inline int model_first_joined(const model *m, int vertex)
{
    const model_mesh *mesh = model_mesh_of(m);
    return mesh->joined == NULL || vertex >= model_scene(m)->nodes ? vertex
                                                                   : mesh->joined[2 * vertex];
}
static inline int model_next_joined(const model *m, int vertex)
{
    const model_mesh *mesh = model_mesh_of(m);
    return mesh->joined == NULL || vertex >= model_scene(m)->nodes ? NONE
                                                                   : mesh->joined[2 * vertex + 1];
}
/* Returns the coordinate of a driver, or NONE. */
static inline int model_driver_coordinate(const model *m, int driver)
{
    return model_mesh_of(m)->driver_coordinate[driver];
}

static inline int model_elements(const model *m)
{
    return model_mesh_of(m)->elements;
}
static inline const mesh_element *model_element(const model *m, int element)
{
    return &model_mesh_of(m)->element[element];
}
/* Returns the first element of a member; for member = number of members, one past the last
 * element. */
static inline int model_first_element(const model *m, int member)
{
    return model_mesh_of(m)->first_element[member];
}
/* Division of the members into elements. */
const division *model_division(const model *);
static inline int model_kinds(const model *m)
{
    return model_mesh_of(m)->kinds;
}
static inline const mesh_kind *model_kind(const model *m, int kind)
{
    return &model_mesh_of(m)->kind[kind];
}
/* Kind of an element. */
static inline const mesh_kind *model_kind_of(const model *m, int element)
{
    return &model_mesh_of(m)->kind[model_mesh_of(m)->element[element].kind];
}
/* The discrete elements are the rigid bodies, then the springs of the scene, then those of
 * foundations. */
static inline int model_discretes(const model *m)
{
    return model_mesh_of(m)->discretes;
}
static inline int model_springs(const model *m)
{
    return model_mesh_of(m)->springs;
}
static inline const mesh_discrete *model_discrete(const model *m, int discrete)
{
    return &model_mesh_of(m)->discrete[discrete];
}

/* The vertices of the nodes come first, those of released ends last. */
static inline int model_vertices(const model *m)
{
    return model_mesh_of(m)->vertices;
}
static inline const mesh_vertex *model_vertex(const model *m, int vertex)
{
    return &model_mesh_of(m)->vertex[vertex];
}
static inline int model_releases(const model *m)
{
    return model_mesh_of(m)->releases;
}
static inline int model_first_release(const model *m)
{
    return model_mesh_of(m)->first_release;
}
/* Returns the only axis about which a node is fixed or prescribed, so it can support a moment about
 * this axis at any rotation about the two others. NONE: there is no such axis, or there are
 * several. */
int coordinates_held_turn(const model *, int node);
/* Number of warping amplitudes, and the coordinate of a warping amplitude. */
static inline int model_warps(const model *m)
{
    return model_mesh_of(m)->warps;
}
static inline int model_warp(const model *m, int warp)
{
    return model_mesh_of(m)->warp[warp].coordinate;
}
/* Returns the number of rotation vectors that are tracked beyond half a revolution. */
static inline int model_turns(const model *m)
{
    return model_mesh_of(m)->turns;
}

/* End of a slot of a linear_memory where elements take loads along them: whether this element does,
 * the rotation of its frame [3 x 14], and the changes of stresses [strains x 3] and internal
 * unknowns [inner x 3] with it. */
enum { SLOT_TAKES, SLOT_TURN, SLOT_MIXED = SLOT_TURN + 3 * ELEMENT_ALONG_COORDINATES };
static inline int slot_followed(const model *m)
{
    return SLOT_MIXED + 3 * model_strains(m);
}
static inline int slot_along(const model *m)
{
    return slot_followed(m) + 3 * model_inner(m);
}

/* Discrete elements, in addition to those of the members: rigid bodies at nodes, and springs. */

/* Computes the internal minus the centrifugal force (in the state's rotating frame), [7 nodes], and
 * its tangent [7 nodes x 7 nodes] in model coordinates. rates: of the dashpots; NULL: at rest. */
void discrete_equations(const model *, const model_state *, const mesh_discrete *,
                        const element_rotating_frame *, const spring_rates *, double force[],
                        double K[]);
/* Adds the inertia of the discrete elements to M and G (rotating_frame_inertia). G NULL: not
 * needed. */
void discrete_inertia(const model *, const model_state *, const element_rotating_frame *, sparse *M,
                      sparse *G);
/* Add the two parts of the tangent, as in newton.h: the first function adds the product of the
 * material part with x[free + driven] to y; the second adds the other part to out. */
void discrete_material_product(const model *, const model_state *, const double x[], double y[]);
void discrete_geometric(const model *, const model_state *, const element_rotating_frame *,
                        sparse *out);
/* Returns a bound of the round-off of x^T K x for the material part K. */
double discrete_material_rounding(const model *, const model_state *, const double x[]);
/* Dashpots. These functions compute the deformations of all springs [6 x springs], and their rates
 * for increments dx[free + driven] per unit time; the power dissipated by dashpots [W]; the dashpot
 * forces in coordinates (added to out[free + driven]) and on a node's frame (added to F[6]); and
 * the damping matrix for small motions (added to C). */
void dashpots_deformations(const model *, const model_state *, double d[]);
void dashpots_rates(const model *, const model_state *, const double dx[], double rate[]);
double dashpots_power(const model *, const double rate[]);
/* Returns the work that a spring without a potential absorbs, in addition to its energy, while its
 * deformations d change by `change`: change . (K - K^T)/2 d; 0 for symmetric springs. */
double spring_circulated(const model *, int spring, const double d[6], const double change[6]);
void dashpots_add_forces(const model *, const model_state *, const double rate[], double out[]);
void dashpots_node_force(const model *, const model_state *, const double rate[], int node,
                         double F[6]);
/* Adds the damping of all springs, and `more` [s] times their stiffness, to C. */
void dashpots_matrix(const model *, const model_state *, double more, sparse *C);
/* For one spring: its deformations, their derivatives J[6 x columns] with respect to its
 * coordinates, and from dashpot stresses the force[columns] and the geometric stiffness K[columns x
 * columns]. */
void dashpots_strains(const model *, const model_state *, int spring, double d[], double J[]);
void dashpots_stressed(const model *, const model_state *, int spring, const double sigma[],
                       double force[], double K[]);
/* Returns the name of a spring: "spring s", or "foundation of beam". Springs of members follow
 * those of the scene. */
scene_words model_spring_called(const model *, int spring);
/* Returns the energy of all springs [J]. */
double discrete_stored(const model *, const model_state *);
/* Adds to F[6: N, N m] the force and moment on a node's frame that hold the discrete elements in
 * the state. */
void discrete_node_force(const model *, const model_state *, const element_rotating_frame *,
                         int node, double F[6]);

/* Describes members that have more elements than requested. */

/* Writes text such as "beam has 6 elements, 2 in each of 3 pieces: its loads begin, end or act at
 * 0.3, 0.5 of its length"; a long list is truncated. elements 0: writes it for any number n. The
 * text is "" if each member has the requested number. */
void division_words(const scene *, int elements, char *text, size_t room);

/* Transforms from element coordinates to coordinates of the model, in place; K: [columns x
 * columns]. force: internal forces, for the second derivatives. NULL arguments are skipped. */

void eliminate_forces(const model *m, const model_state *s, const mesh_element *el,
                      double force[]); /* [columns] */
void eliminate_matrix(const model *m, const model_state *s, const mesh_element *el,
                      const double force[], double K[]);

/* Positions of element entries in the matrices and vectors of a model. */

/* An entry of an element's matrix that a pattern stores. */
typedef struct mesh_entry {
    short local;  /* row * columns + column in the element's matrix */
    short column; /* column in the element's matrix */
    int offset;   /* offset in the pattern from the start of its column */
} mesh_entry;

/* Entries of elements that occupy the same relative positions in the columns of a pattern. */
typedef struct mesh_layout {
    int entries;
    mesh_entry *entry; /* [entries] */
} mesh_layout;

/* Pattern with the positions of every element's entries in it. */
typedef struct mesh_pattern {
    int made;
    sparse matrix;
    int layouts;
    mesh_layout *layout;
    int *layout_of;              /* [elements] */
    const mesh_element *element; /* of the model */
} mesh_pattern;

/* Returns the pattern of the matrix with the positions of the elements' entries. */
const mesh_pattern *assemble_of(const assemble_patterns *, const sparse *a);
void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out);
/* Adds K of a discrete element; its positions are searched for. */
void assemble_discrete(const mesh_element *el, const double K[], sparse *out);
void assemble_vector(const mesh_element *el, const double local[], double out[]);
/* Subtracts a value from an entry; no effect if the entry is not stored. */
void assemble_subtract(sparse *a, int row, int column, double value);

/* Returns the features that a scene requires (FEATURE_* bits). */

unsigned features_needed(const scene *);
/* Returns the physics that the scene omits although it has an effect. */
unsigned features_omitted(const scene *);
/* Returns physics, not omitted, that the analyses of the scene need but that a section given by its
 * constants does not define; a constant given as zero is defined. */
unsigned features_not_given(const scene *, int section);
/* Returns 1 for a section of walls whose bimoment causes torsion, which no formulation models, if
 * the analyses have stresses and neither warping nor the Wagner torque is omitted. */
int features_one_sided(const scene *, int section);
/* Like features_needed, but with the type's own shear theory in stability instead of the requested
 * one. */
unsigned features_needed_of(const scene *, const element_type *);
/* Returns the shear theory in stability that the type uses for this scene, a bit of shear_theory;
 * 0: no shear flexibility, or no stress. */
unsigned features_theory(const scene *, const element_type *);
/* Returns 1 if the scene has shear flexibility and an analysis that depends on the shear theory. */
int features_sheared(const scene *);
/* Returns the name of the theory, such as "Haringx"; for SHEAR_OWN the type's text; "" for 0. */
const char *features_theory_words(const element_type *, unsigned theory);
/* Returns the features on which one quantity depends: inertia only for a frequency or a rotating
 * structure. */
unsigned features_needed_by_quantity(const scene *, int quantity);

int features_eccentric(const section *c); /* 1: its shear centre differs from its centroid */
status features_of_section(const model *m, int section, unsigned *features, fault *f);

/* States of a model and the motion of its nodes. */

status kinematics_state_alloc(const model *, model_state **, fault *); /* undeformed, path = 0 */
/* Creates a state with only those members that kinematics_component, kinematics_driver_value and
 * the path need; no other function may be called with it. */
status kinematics_nodes_alloc(const model *, const model_state *from, model_state **, fault *);
void kinematics_state_free(model_state *);
const model_state *kinematics_rest(const model *); /* the undeformed state */
void kinematics_state_copy(const model *, const model_state *from, model_state *to);
double kinematics_state_path(const model_state *);
const double *kinematics_strains(const model_state *); /* [elements x strains] */

/* Returns the frame of a scene node in a state, position [m] and unit quaternion, for tests in
 * other folders, which do not access the members of a state. */
void kinematics_frame(const model *, const model_state *, int node, double r[3], double q[4]);
/* Returns the displacement [m] or rotation-vector component [rad] of a scene node relative to the
 * undeformed state, including full revolutions along the path. NaN: the vector has lost its
 * direction at a full revolution. */
double kinematics_component(const model *, const model_state *, int node, int component);
/* Like kinematics_component, but relative to the axes of another node `from`: change of the
 * position [m], or relative rotation vector [rad]. */
double kinematics_relative(const model *, const model_state *, int from, int node, int component);
double kinematics_driver_value(const model *, const model_state *, int driver);
/* Returns the largest angle [rad] between the orientations of an element's nodes (chords 1: or
 * between a node and its chord), and that element. Angles below two full revolutions are
 * distinguished. */
double kinematics_largest_turn(const model *, const model_state *, int chords, int *element_index);
/* Returns the largest angle of this kind about the element's axis. */
double kinematics_largest_twist(const model *, const model_state *, int *element_index);
/* Returns the largest rise of an undeformed element's arc due to its curvature about z, in radii of
 * gyration, and that element. */
double kinematics_largest_rise(const model *, int *element_index);

/* Returns the index of a coordinate of a node, or -1 if the coordinate is fixed or dependent. */
int kinematics_coordinate(const model *, int node, int component);
/* Largest number of coordinates on which a vertex depends: the coordinates of a body and of a
 * released end. */
enum { KINEMATICS_MOST = 6 + SCENE_RELEASED };
/* Fills the Jacobian T[6 x m] of the six spatial increments of a vertex with respect to the m
 * coordinates on which it depends (row-major, leading dimension m), and their numbers index[m].
 * Returns m <= size; m = 6 for a node. */
int kinematics_node_jacobian(const model *, const model_state *, int node, int size, int index[],
                             double T[]);
/* Computes the current offset of a vertex from its body [m]. */
void kinematics_offset(const model *, const model_state *, int vertex, double rho[3]);

/* For a vertex whose translations may be along rotated axes: transform three of its coordinates, or
 * forces, to fixed axes and back, in place. */
static inline void kinematics_to_fixed(const mesh_vertex *v, double d[3])
{
    const double x = d[0], y = d[1], z = d[2];
    for (int i = 0; i < 3 && v->turned; i++)
        d[i] = v->along[3 * i] * x + v->along[3 * i + 1] * y + v->along[3 * i + 2] * z;
}
static inline void kinematics_to_own(const mesh_vertex *v, double d[3])
{
    const double x = d[0], y = d[1], z = d[2];
    for (int i = 0; i < 3 && v->turned; i++)
        d[i] = v->along[i] * x + v->along[3 + i] * y + v->along[6 + i] * z;
}
/* Transforms A[3 x 3] from the vertex's own translation axes to the fixed axes. */
void kinematics_turn_back(const mesh_vertex *, double A[9]);
/* Transforms rows and columns of K[n x n] from fixed axes; the six coordinates of the vertex start
 * at `at`. */
void kinematics_turn_matrix(const mesh_vertex *, int n, int at, double K[]);

/* Fills x[nodes], the nodes of an element in a state, in the form of its type. */
void kinematics_gather(const model *m, const model_state *s, const mesh_element *el,
                       node_state x[]);
void kinematics_position(const model *m, const model_state *s, int vertex, double r[3]);
/* For a body moved by a diaphragm: computes the derivative of its position with respect to its
 * first angle. */
void kinematics_arm(const model *, const model_state *, int vertex, double moved[3]);
/* Computes the body's displacement if that angle increases by `more` from the state. */
void kinematics_swing(const model *, const model_state *, int vertex, double more, double by[3]);
/* Computes the spatial axes of a sequence's angles in the current state, b[angles][3]. */
void kinematics_axes(const model *m, const model_state *s, int vertex, double b[3][3]);
/* Recomputes everything that depends on the bodies' coordinates. */
void kinematics_follow(const model *m, model_state *s);
/* Computes the increments of an element's coordinates, local[7 nodes], from those of the model. */
void kinematics_local(const model *m, const model_state *s, const mesh_element *el,
                      const double dx[], double local[]);

/* Distance between two states. */

/* Sets the weights [free + driven] of the square of an increment: the mean over the bodies of
 * (displacement/size)^2 + rotation^2. */
void metric_of(const model *, double weight[]);
/* Returns the share of nodal displacements in an increment [free + driven], in the same measure. */
double metric_shift_part(const model *, const double dx[]);
/* Returns the distance between two states in the same measure. light[9 x (2 i + block)], row-major:
 * projections of the displacement (block 0) and of the rotation in its own axes (block 1) of vertex
 * i that are excluded; NULL: nothing is excluded. */
double metric_distance(const model *, const model_state *, const model_state *,
                       const double light[]);
/* Returns the largest angle [rad] between the orientations of a node in two states. */
double metric_turn_between(const model *, const model_state *, const model_state *);

/* Physics that a scene requires and a formulation does not support. There are three kinds: physics
 * that can be omitted, physics whose absence leads to a different model, and physics whose absence
 * prevents a solution. */

/* Physics that can be omitted and has no FEATURE_* bit. */
enum {
    OMIT_SHEAR_Y = FEATURE_END,            /* shear flexibility along y */
    OMIT_SHEAR_COUPLING = FEATURE_END << 1 /* shear coupling between y and z, and with warping */
};
enum { OMIT_WORDS = 200, OMIT_BITS = 16 }; /* length of their names; number of bits */

/* Names the physics that the type does not support, or a limit that the scene exceeds; words is
 * empty if and only if there is none. Returns 0 if the type supports everything that the scene
 * requires. */
int missing_words(const scene *, const element_type *, char *words, int size);
/* Names missing physics that prevents any solution of the scene; returns 0 if the scene can be
 * solved. */
int missing_refused(const scene *, const element_type *, char *words, int size);
/* Returns the physics that a solution omits: bits of FEATURE_* and OMIT_*. */
unsigned missing_omits(const scene *, const element_type *);
/* Describes these bits in words. */
void missing_omit_words(unsigned omits, char words[OMIT_WORDS]);

/* Names the features that the scene requires and the type supports in one direction only
 * (element_lack). Returns 0: none; 1: negligible, printed but not rejected; 2: missing_words also
 * names them. */
int lacks_of(const scene *, const element_type *, char *words, int size);

/* Members of a model's state, for functions that advance it. */

struct model_state {
    double path;
    size_t size; /* number of doubles in block */
    double *block;
    double *u;      /* [vertices x 3] displacement */
    double *q;      /* [vertices x 4] orientation */
    double *angle;  /* [vertices x 3] of sequences; accumulated spatial increments otherwise */
    double *shift;  /* [releases x 3] displacement along slides */
    double *warp;   /* [warps] */
    double *driver; /* [drivers] current value */
    double *e, *sigma, *inner; /* [elements x strains], [elements x inner] */
    double *turn;              /* [turns x 3] tracked rotation vectors */
    double *feedback; /* [loads] integrals of the feedback errors; empty without feedback */
};

/* Possible motions [6: displacement, rotation] of a node: the span of the columns of its Jacobian.
 * Computed axes have round-off errors; therefore ranks are determined relative to the size of the
 * columns, never by comparison with zero. */

typedef struct movable {
    int count;           /* dimension */
    unsigned components; /* bit i: some motion contains component i */
    int whole;           /* 1: the motions are single components ... */
    int component[6];    /* ... [count] */
    double span[36]; /* [6 x count] a basis: unit vectors if these span it, otherwise orthonormal
                        with lengths in units of `length` */
    double dual[36]; /* [count x 6] dual span = 1: the smallest combination of components that gives
                        the share of a basis vector */
} movable;

/* Finds the possible motions from T[6 x columns], whose columns are motions of order 1:
 * displacement per displacement, or rotation per angle. length [m] > 0: size of the structure. */
void movable_of(int columns, const double *T, double length, movable *out);
/* Sets out[3] to m without its part along the rotations among the columns of T. These rotations are
 * not prescribed, so a moment along them is a residual of Newton's method. */
void movable_prescribed(int columns, const double *T, const double m[3], double out[3]);

/* Description of the loads and masses of members that are lumped at nodes by convention. */

/* Describes, with their order of convergence in space: loads with `lumped`; masses that a motion,
 * the scene or the formulation lumps; loads that are lumped with them. A long list is truncated.
 * "": nothing is lumped. */
void on_nodes(const scene *s, const element_type *type, const double options[], char *text,
              size_t room);

/* Returns the index in m->section of an element of a member, counted along the member. */
int profile_at(const model *m, int member, int number);

/* Released ends of members, which have rotations and displacements of their own (scene_release).
 *
 * A released end has its own vertex after all others, in the list `release`. With the frame r, R of
 * its node's body, the node at the offset rho from it, and the member's undeformed axes a, d at the
 * end, R_end = R exp(a_1 t_1) exp(a_2 t_2), r_end = r + R rho + R_end (sum d_i s_i). If three
 * rotations are released, they have no order: R_end is free, with spatial increments. The end's
 * coordinates t, s follow those of the element's nodes. The chain rule transforms forces and
 * matrices of the element to all of them, including the second derivatives of the frame: 1/2 b_i x
 * b_j for two rotations, where rotation i comes before j. Those of the body come first;
 * displacements come after the rotations of the end. */

/* Returns the released end at this vertex; NULL: none. */
static inline const mesh_release *release_of(const model *m, int vertex)
{
    const int first = model_first_release(m);
    return vertex < first ? NULL : &model_mesh_of(m)->release[vertex - first];
}

/* Returns the rotation or displacement of a member's end (0 at p, 1 at q) relative to its node, by
 * component; 0: it is not released. For three released rotations this is the rotation vector, NAN
 * beyond 3 rad. */
double release_value(const model *, const model_state *, int member, int end, int component);
/* Changes the end's own coordinates by dx; returns the largest change [1, rad]. */
double release_advance(const model *, model_state *, int vertex, const double dx[]);

/* Computes the spatial axes of the rotations [turns x 3]; for three rotations, the fixed axes. */
void release_turn_axes(const model *, const model_state *, int vertex, double b[3][3]);
/* Computes the spatial directions of the displacements [slides x 3], and the vector from the node
 * to the end [m]. */
void release_slide_axes(const model *, const model_state *, int vertex, double along[3][3],
                        double apart[3]);

/* Inserts columns for released ends after those of the nodes: K[7 nodes x 7 nodes] -> K[columns x
 * columns]. */
void release_widen(const mesh_element *, double K[]);

/* A spring between two frames, or between a frame and the ground. */

enum { SPRING_STRAINS = 6 };

/* Computes the stress [N, N m] at deformations e, from the stiffness and the tables, and its
 * derivative S[6 x 6] (NULL: not needed). */
void spring_law(const scene_spring *, const double e[6], double sigma[6], double S[36]);
double spring_energy(const scene_spring *, const double e[6]);
/* Computes the discrete-gradient stress, whose work on the increment to e equals the change of
 * energy for each component, and its derivative with respect to e. */
void spring_mean(const scene_spring *, const double from[6], const double e[6], double sigma[6],
                 double S[36]);
/* Computes S at rest. */
void spring_at_rest(const scene_spring *, double S[36]);

/* Computes S of a spring, including its tables, at its present deformation. */
void spring_slopes(const model *, const model_state *, int spring, double S[36]);

/* Computes the deformation d = (R_p^T (r_q - r_p) minus its initial value [m], rotation vector of
 * R_p^T R_q [rad]) in the axes of p; if q is the only node, p is the ground. In x[nodes], R is the
 * rotation relative to the undeformed state. Output: out->e[6], out->J[6 x 7 nodes], and out->H[7
 * nodes x 7 nodes] for the stresses out->s[6], in the exponential chart, as for strains of
 * elements. near: the tracked rotation vector, which resolves several revolutions; NULL: the
 * rotation is less than half a revolution.
 *
 * At a full revolution the transverse derivatives of the vector are unbounded; within 1e-3 rad of
 * it they are kept constant. The moment remains exact if it is along the rotation vector. */
void spring_strain(int nodes, const node_state x[], const double near[3], strain_output *out);

/* Checks whether the supports hold all parts of a structure. A rigid motion of a part has six
 * components: the displacement of an origin, and the rotation times the size of the model.
 * Constraints are sums of squares of lengths. */

/* Returns 1 if the supports leave a part of the undeformed structure loose. *node: a node of this
 * part; motion: a rigid motion (displacement of the node [m], rotation [rad], any size) that the
 * supports allow. Prescribed coordinates count as fixed. */
int supports_loose_part(const model *, int *node, double motion[6]);

/* Smallest relative eigenvalue of the sums of squares at which a part counts as held. Fixed points
 * whose distance is below its square root times the length count as one point. */
extern const double supports_loose;

/* Finds the parts connected by elements, springs and bodies. part[vertices]: a representative
 * vertex of each part, by supports_root. apart 1: released ends are not connected to their
 * nodes. */
void supports_join(const model *, int apart, int part[]);
int supports_root(const int part[], int vertex);
/* Returns the vertex that moves this one rigidly. */
int supports_mover(const model *, int vertex, int apart);
/* Computes G[6 x 6], the rigid motion (m, rad) of a position for the motions of the origin. */
void supports_rigid(const double position[3], double length, double G[36]);
/* Sets out[6 x 6] to the sum of squares of the motions about the origin that the supports of a node
 * prevent. */
void supports_prevented(const model *, int node, const double origin[3], double out[36]);
/* Adds to sum[6 x 6] the squares of the motions that springs between the part and the ground
 * prevent, whatever their stiffness. */
void supports_add_springs(const model *, const int part[], int root, const double origin[3],
                          double sum[36]);

/* Rotations beyond half a revolution: an orientation repeats after a revolution, but the rotation
 * vector does not. */

/* Message that says why a rotation vector is NaN. */
extern const char turns_lost[];

/* Returns the rotation vector [3] of a node in a state; NaN if it has lost its direction. */
const double *turns_of_node(const model_state *, int node);
const double *turns_of_spring(const model *, const model_state *, int spring);

/* Relative rotation vectors depend on the quantities of a run. These functions store them for a
 * continued motion: their number, and for each vector its two nodes and its three components [5]. A
 * vector that is not restored starts within half a revolution, from the orientations of its
 * nodes. */
int turns_between_count(const model *);
void turns_put_between(const model *, const model_state *, double out[]);
void turns_take_between(const model *, int count, const double in[], model_state *);

/* Returns 1 if a vector of more than half a revolution has changed its direction. Near a full
 * revolution this takes a very short time; at the full revolution the result is round-off. */
int turns_swung(const double from[3], const double to[3]);
/* Returns 1 if the size is within `near` [rad] of one or more full revolutions. */
int turns_full(double size, double near);
/* Sets rotation vectors that have lost their direction since `from` to NaN. */
void turns_lose(const model *, const model_state *from, model_state *);

/* Description of the warping at the ends of members. */

/* Describes warping at the ends of members whose section warps: "held at base_a, base_b; shared at
 * fold; free at tip", by nodes, or "leaf at base" if ends at one node differ. A long list is
 * truncated. "": nothing warps. */
void warping_ends(const scene *s, char *text, size_t room);

#endif
