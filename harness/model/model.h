/* model/: a scene meshed with one formulation. */
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
    const double *options; /* values of the formulation's options; NULL: their defaults */
    int elements;          /* number of elements per piece of a member */
    int keep_all;
    /* physics of the scene that is omitted in addition to the physics that the type does not
     * support */
    unsigned omit;
} model_request;

/* Creates the model; model_left_out lists the physics that it omits. REFUSED: the scene cannot be
 * solved with this formulation and this number of elements; the message gives the reason. */
status model_alloc(const model_request *, model **, fault *);
void model_free(model *);

/* The initial shape due to the imperfections of a scene. It consists of a copy of the scene, in
 * which nodes are shifted and bodies and offsets rotate with them, and of the shifts of members
 * between their nodes. */
typedef struct model_imperfect model_imperfect;
/* Creates the initial shape. x[free + driven]: sum of the modes of the perfect model. */
status model_imperfect_alloc(const model *perfect, const double x[], model_imperfect **, fault *);
void model_imperfect_free(model_imperfect *);
/* Creates the model with this shape, which must outlive the model. */
status model_imperfect_build(const model *perfect, const model_imperfect *, model **, fault *);
/* Sets shift[3] to the largest shift of a point of a member in a mode x. If several shifts are
 * equal, the first is used. */
void model_largest_shift(const model *, const double x[], double shift[3]);

typedef struct model_size {
    int elements, vertices, free, driven, strains,
        inner; /* strains, inner: numbers of strains and of internal unknowns of an element */
    /* number of kinds of elements; identical elements share a kind, which is prepared once */
    int kinds;
    unsigned features;
} model_size;
model_size model_sizes(const model *);
/* Returns 1 if elements have a consistent mass matrix in this motion. */
int model_spreads(const model *, int analysis);
/* Creates the same model with one element per piece of a member. */
status model_coarse(const model *, model **, fault *);
/* Creates the same model with twice as many elements. */
status model_halved(const model *, model **, fault *);
const scene *model_scene(const model *);
int model_keeps_all(const model *);
/* Returns the vertex that rigidly moves this vertex, which may be the vertex itself. */
int model_body(const model *, int vertex);
/* Returns 1 if the vertex belongs to a released end. Such vertices follow the vertices of the
 * nodes. */
int model_is_released(const model *, int vertex);
/* Returns the length [m] of the longest member, which is the scale of displacements. */
double model_length(const model *);
double model_mass(const model *); /* [kg] mass of all members */

/* Returns the physics of the scene that the model includes, as FEATURE_* bits. */
unsigned model_features(const model *);
/* Sets *lines to descriptions of the eliminated coordinates and the omitted physics, for example
 * "warping amplitudes of 12 element ends at which nothing warps", and returns their number. */
int model_left_out(const model *, const char *const **lines);

/* Returns one line that explains why the results since the last call are invalid
 * (element_type.trouble); NULL: the results are valid. */
const char *model_trouble(const model *);

/* Everything that changes along a path. */
typedef struct model_state model_state;

const char *model_formulation(const model *);
const double *model_options(const model *);
unsigned model_leaves(const model *);
/* Computes the shape of a mode x: the displacement (3), rotation (3) and warping of every vertex,
 * u[vertices x 7], and the undeformed position[vertices x 3]. Returns the number of vertices.
 * model_member_vertices gives their order along a member. */
int model_shape(const model *, const double x[], double *u, double *position);
int model_member_vertices(const model *, int member,
                          /* vertices of a member, in order; NULL: returns only their number */
                          int vertex[]);

/* Returns the number of stresses of all elements and springs: the number of elements times the
 * number of strains, plus six per spring. */
int model_stresses(const model *);
/* Returns the section constants that the model uses for a section of the scene. */
const section *model_section(const model *, int index);

typedef struct assemble_patterns assemble_patterns;
status assemble_patterns_alloc(assemble_patterns **, fault *);
void assemble_patterns_free(assemble_patterns *);

/* Returns a symmetric pattern for the undeformed state. with_driven 0: the pattern contains only
 * the unknowns; 1: it contains all coordinates. The pattern is created in the first call and
 * stored. sparse_alloc_like creates matrices with this pattern. */
status assemble_pattern(const model *, assemble_patterns *, int with_driven, const sparse **out,
                        fault *f);
/* Sets *out to the pattern of the tangent in any state. Both triangles are stored if tangents may
 * be unsymmetric (assemble_symmetric). A matrix with this pattern is then symmetric only if its
 * values are. */
status assemble_pattern_of_states(const model *, assemble_patterns *, int with_driven,
                                  const sparse **out, fault *f);
/* Like assemble_pattern_of_states, but both triangles are always stored, for states of a motion. */
status assemble_pattern_whole(const model *, assemble_patterns *, int with_driven,
                              const sparse **out, fault *f);
/* Sets *out to the pattern for the undeformed state. Both triangles are stored if springs are not
 * symmetric. damped 1: they are also stored if dashpots are not symmetric. */
status assemble_pattern_at_rest(const model *, assemble_patterns *, int damped, int with_driven,
                                const sparse **out, fault *f);
/* Returns 0 if a load, a support, a spring, a dashpot, or a formulation with a history may make
 * tangents unsymmetric. */
int assemble_symmetric(const model *);
/* Sets *out to the free x free pattern for motions. The pattern is always unsymmetric, because the
 * inertia of rotating masses has unsymmetric tangents. */
status assemble_pattern_in_time(const model *, assemble_patterns *, const sparse **out, fault *f);

/* Centre lines of all members in a state, for pictures and other programs. Between two vertices of
 * the mesh, the line is a cubic whose tangents are the x axes of the vertices. Resultants are in
 * equilibrium with the element's nodal forces J^T sigma. */

typedef struct centreline_point {
    double r[3]; /* position [m] */
    double q[4]; /* orientation of the section's triad: x along the line, y and z principal axes */
    double force[3];  /* [N] N, Qy, Qz on the part before the point, in this triad */
    double moment[3]; /* [N m] Mx, My, Mz about the point */
    double bimoment;  /* [N m^2] linear between the ends of an element */
} centreline_point;

/* Returns the number of points of all members. first[members + 1]: index of the first point of each
 * member; NULL: not needed. */
int centreline_points(const model *m, int first[]);
/* Fills out[points] in the order of the members, and along each member from p to q. */
void centreline_fill(const model *m, const model_state *s, centreline_point out[]);
/* Computes the positions [m] of the nodes of the scene: out[nodes x 3]. */
void centreline_nodes(const model *m, const model_state *s, double out[]);
/* Creates a state: `from` moved by `scale` times the increments x[free + driven]. sigma[elements x
 * strains]: stresses of the state; NULL: the stresses of `from`. If *scale is 0, selects a scale
 * for which the displacement is visible (at most a tenth of the length of the longest member, and
 * half a radian), and stores it in *scale. */
status centreline_displaced(const model *m, const model_state *from, const double x[],
                            const double sigma[], double *scale, model_state **out, fault *f);

/* Division of the members of a scene into elements. Loads that begin, end or act between the ends
 * of a member divide it into pieces. Each piece has the requested number of elements of equal
 * length. */

typedef struct division {
    int *first; /* [members + 1] number of pieces of all previous members */
    /* [pieces + members] ends of the pieces of each member, 0 .. 1 of the initial length; a member
     * starts at place[first[member] + member] */
    double *place;
    int *each; /* [members] elements per piece */
} division;

/* Smallest length of a piece, relative to its member. */
#define DIVISION_LEAST 1e-3

/* division_place returns the position along the member of a point x in [0, 1] of an element.
 * division_inside returns x for a position. */
double division_place(const division *, int member, int number, double x);
double division_inside(const division *, int member, int number, double place);
/* Returns the element at a position along a member, and sets *x to the point in the element.
 * Between two elements, the element towards the end of the member is returned or, if `before` is 1,
 * the element towards its start. */
int division_at(const division *, int member, double place, int before, double *x);

/* The mesh of a model: elements, vertices and their connections. */

/* Largest number of coordinates of an element, for its nodes and released ends. */
enum {
    NONE = -1,
    VERTEX_COORDINATES = 6,
    MODEL_MAX_COORDINATES = ELEMENT_MAX_COORDINATES + 2 * SCENE_RELEASED
};

/* A frame, and the body that moves it. The first vertices are the nodes of the scene, in the order
 * of the scene. */
typedef struct mesh_vertex {
    double position[3]; /* undeformed [m] */
    int body;           /* vertex that rigidly moves this vertex, which may be the vertex itself */
    double offset[3];   /* [m] undeformed vector from the body to the vertex */
    int coordinate[6];  /* global coordinates of a body; NONE: fixed */
    int turned; /* 1: the translations are along the columns of `along`, not along the fixed axes */
    double along[9];
    /* 1: the vertex moves on an arm about the master of a diaphragm; the arm is perpendicular to
     * the first axis */
    int led;
    /* master of the diaphragm, even without an arm; NONE (only for nodes): no diaphragm */
    int leader;
    double arm[3]; /* [m] perpendicular to the first axis */
    int angles;    /* > 0: the rotation is a sequence of this number of angles about the axes */
    double axis[3][3];
    int idle;             /* bits of angles that are fixed because nothing depends on them */
    int vector_driver[3]; /* drivers of the prescribed rotation vector; NONE: not prescribed */
} mesh_vertex;

/* A released end of a member (see scene_release). */
typedef struct mesh_release {
    int node; /* node of the scene from which the end is released */
    int turns, slides;
    /* unit vectors of rotations and slides in the undeformed state */
    double turn[3][3], slide[3][3];
    int turn_of[3], slide_of[3]; /* the components, SCENE_UX .. SCENE_RZ */
} mesh_release;

/* A warping amplitude, or an additional unknown, that the ends of connected elements share. */
typedef struct mesh_warp {
    int coordinate;
    int scalar; /* 1: an additional unknown */
} mesh_warp;

typedef double mesh_triad[9]; /* the columns are the unit vectors nX, nY, nZ */

typedef struct mesh_element {
    int kind, member;
    int nodes;
    int vertex[ELEMENT_MAX_NODES];
    /* index of the warping amplitude; NONE: the amplitude is fixed at zero or does not exist */
    int warp[ELEMENT_MAX_NODES];
    /* scalars: number of additional unknowns of a node (element_type.scalars); scalar: index, among
     * the warping amplitudes, of the first unknown that is not fixed; held: bits of the unknowns
     * that are fixed at zero */
    int scalars, scalar[ELEMENT_MAX_NODES];
    unsigned held[ELEMENT_MAX_NODES];
    /* share of the element's mass at each node if the mass is lumped (mesh.c) */
    double share[ELEMENT_MAX_NODES];
    /* addition to resultants at the ends of an element with two nodes (time/deformable.c) */
    double couple[2];
    mesh_triad *triad; /* [nodes] initial triads; not owned, because equal triads are shared */
    /* number of coordinates after elimination: 7 per node, then the additional unknowns, then those
     * of released ends */
    int columns;
    int index[MODEL_MAX_COORDINATES]; /* global coordinate of each column; NONE: fixed */
    /* 1: there is no offset, rotated axis, sequence or released end, so elimination only selects
     * coordinates */
    int plain;
} mesh_element;

/* Returns the index of an additional unknown of a node; NONE: fixed at zero. */
static inline int mesh_scalar(const mesh_element *el, int node, int i)
{
    const unsigned held = el->held[node];
    return held >> i & 1 ? NONE : el->scalar[node] + i - __builtin_popcount(held & ((1U << i) - 1));
}
/* Returns the number of coordinates of an element without those of released ends. */
static inline int mesh_own_coordinates(const mesh_element *el)
{
    return el->nodes * (NODE_COORDINATES + el->scalars);
}

/* A discrete element, in addition to the elements of members: the mass of a rigid body at a vertex,
 * or a spring between vertices. */
typedef struct mesh_discrete {
    mesh_element el; /* element without kind and warping; `member` is set only for a foundation */
    const scene_body *body;
    const scene_spring *spring; /* exactly one of the two pointers is not NULL */
    mesh_triad triad[ELEMENT_MAX_NODES];
} mesh_discrete;

/* Rates of the deformations d of all springs: known + g (d - from), where known and from have the
 * size [6 x springs]. */
typedef struct spring_rates {
    double g;
    const double *known, *from;
} spring_rates;

typedef struct mesh_kind {
    int section;
    double length, curvature[3], strain[3];
    /* elongation, and principal curvatures about y and z in addition to `curvature`, in the
     * unstressed state */
    double free[3];
    int next; /* another kind with the same section; NONE: there are no more kinds */
    element_data *data;
    size_t data_size;
    displacement_field field; /* displacements between the nodes, for loads */
    double *inner; /* field_inner, if a modal or harmonic analysis uses the consistent mass of this
                      field; otherwise NULL */
} mesh_kind;

/* Data that the inline functions below read. */
typedef struct model_mesh {
    const element_type *type;                                /* completed by adapters_complete */
    int nodes, coordinates, strains, inner, memory, history; /* numbers per element */
    int scalars;                                             /* number per node */
    /* positions of the nodes of an element, from 0 to 1, and their shares of a uniform load */
    double place[ELEMENT_MAX_NODES], share[ELEMENT_MAX_NODES];
    int vertices, elements, kinds, warps;
    /* index of the first vertex of released ends, which are the last vertices, and number of
     * released ends */
    int first_release, releases;
    mesh_release *release;
    mesh_vertex *vertex;
    mesh_element *element;
    mesh_kind *kind;
    mesh_warp *warp;
    /* number of discrete elements, and number of springs, which are the last discrete elements */
    int discretes, springs;
    mesh_discrete *discrete;
    int turns;              /* number of rotation vectors that are tracked */
    int *first_element;     /* [members + 1] */
    int *driver_coordinate; /* [drivers] or NONE */
    int free, driven;
    int takes; /* 1: elements include loads along them in their equilibrium (element_type.along) */
    int frees; /* 1: there are temperatures, or members with elongations or initial strains */
    /* number of doubles of an element in a linear_memory (harness/newton/newton.h) */
    int work_size;
    scene_tie *tie; /* [6 nodes] coordinates of nodes in constraints; NULL: none */
    int *joined;    /* [2 nodes] model_first_joined, model_next_joined; NULL: none */
} model_mesh;
static inline const model_mesh *model_mesh_of(const model *m)
{
    return (const model_mesh *)m;
}

/* Return the type of the elements, and the numbers of an element: nodes, coordinates of its nodes
 * (7 each, and the additional unknowns), strains, internal unknowns, and doubles that its type
 * stores in a linearisation. */
static inline const element_type *model_type(const model *m)
{
    return model_mesh_of(m)->type;
}
static inline int model_nodes(const model *m)
{
    return model_mesh_of(m)->nodes;
}
/* Return the positions of the nodes along an element (0 to 1), and their shares of a uniform
 * load. */
static inline const double *model_places(const model *m)
{
    return model_mesh_of(m)->place;
}
static inline const double *model_shares(const model *m)
{
    return model_mesh_of(m)->share;
}
static inline int model_own_coordinates(const model *m)
{
    return model_mesh_of(m)->coordinates;
}
static inline int model_scalars(const model *m)
{
    return model_mesh_of(m)->scalars;
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
static inline int model_history(const model *m)
{
    return model_mesh_of(m)->history;
}
/* Returns 1 if the strains of the elements are the motions of their nodes, because the type
 * computes forces with a history. Tangents may then be unsymmetric. */
static inline int model_absolute(const model *m)
{
    return model_mesh_of(m)->type->force != NULL && model_history(m) > 0;
}
static inline int model_takes_loads(const model *m)
{
    return model_mesh_of(m)->takes;
}
static inline int model_frees(const model *m)
{
    return model_mesh_of(m)->frees;
}
static inline int model_work_size(const model *m)
{
    return model_mesh_of(m)->work_size;
}

/* Numbers of coordinates. The unknowns come first, followed by the coordinates that drivers
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
/* Returns the constraint relation of a coordinate of a node; NULL: none. */
static inline const scene_tie *model_tie(const model *m, int node, int coordinate)
{
    const scene_tie *all = model_mesh_of(m)->tie;
    return all != NULL && all[6 * node + coordinate].node >= 0 ? &all[6 * node + coordinate] : NULL;
}
/* Returns 1 if the coordinate of the body is independent or determines other coordinates in a
 * constraint, and 0 if another coordinate determines it. The rotations of a body are treated
 * together. */
static inline int model_owns(const model *m, int vertex, int coordinate)
{
    int owns = 1;
    if (model_mesh_of(m)->tie == NULL || vertex >= model_scene(m)->nodes)
        return 1;
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        const scene_tie *tie = model_tie(m, vertex, c);
        if (tie != NULL && (c == coordinate || (c >= SCENE_RX && coordinate >= SCENE_RX &&
                                                model_mesh_of(m)->vertex[vertex].angles < 2)))
            owns &= tie->node == vertex && tie->coordinate == c;
    }
    return owns;
}
/* Return the bodies that constraints connect to a body, in ascending order: the first body, and the
 * body after `vertex` (NONE: there is none). */
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
/* Returns the index of the first element of a member. If `member` is the number of members, returns
 * the number of all elements. */
static inline int model_first_element(const model *m, int member)
{
    return model_mesh_of(m)->first_element[member];
}
const division *model_division(const model *);
static inline int model_kinds(const model *m)
{
    return model_mesh_of(m)->kinds;
}
static inline const mesh_kind *model_kind(const model *m, int kind)
{
    return &model_mesh_of(m)->kind[kind];
}
static inline const mesh_kind *model_kind_of(const model *m, int element)
{
    return &model_mesh_of(m)->kind[model_mesh_of(m)->element[element].kind];
}
/* The discrete elements are the rigid bodies, followed by the springs of the scene and the springs
 * of foundations. */
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

/* The vertices of the nodes come first, and the vertices of released ends come last. */
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
/* Returns the only axis about which a node is fixed or prescribed. The support of such a node can
 * exert a moment about this axis at any rotation about the other two. Returns NONE if there is no
 * such axis or more than one, if the rotation is a sequence or is prescribed as a vector, or if
 * another node moves this node. */
int coordinates_held_turn(const model *, int node);
/* Return the number of warping amplitudes and additional unknowns, and the coordinate of one of
 * them. */
static inline int model_warps(const model *m)
{
    return model_mesh_of(m)->warps;
}
static inline int model_warp(const model *m, int warp)
{
    return model_mesh_of(m)->warp[warp].coordinate;
}
/* Returns the length [m] that makes a change of a warping amplitude dimensionless. Returns 1 for an
 * additional unknown, which is dimensionless. */
static inline double model_warp_length(const model *m, int warp)
{
    return model_mesh_of(m)->warp[warp].scalar ? 1 : model_length(m);
}
/* Returns the number of rotation vectors that are tracked beyond half a revolution. */
static inline int model_turns(const model *m)
{
    return model_mesh_of(m)->turns;
}

/* Offsets in the last part of a slot of a linear_memory, which exists if elements include loads
 * along them in their equilibrium. The part contains 1 if this element includes a load, the
 * derivative of the rotation of its frame [3 x 14], and the derivatives of the stresses [strains x
 * 3] and of the internal unknowns [inner x 3] with respect to this rotation. */
enum { SLOT_TAKES, SLOT_TURN, SLOT_MIXED = SLOT_TURN + 3 * ELEMENT_ALONG_COORDINATES };
static inline int slot_followed(const model *m)
{
    return SLOT_MIXED + 3 * model_strains(m);
}
static inline int slot_along(const model *m)
{
    return slot_followed(m) + 3 * model_inner(m);
}

/* Computes the internal minus the centrifugal force [7 nodes] in the rotating frame of the state,
 * and its tangent [7 nodes x 7 nodes], in coordinates of the model. The rates are deformation rates
 * of the dashpots; NULL: the structure is at rest. */
void discrete_equations(const model *, const model_state *, const mesh_discrete *,
                        const element_rotating_frame *, const spring_rates *, double force[],
                        double K[]);
/* Adds the inertia of the discrete elements to M and G (rotating_frame_inertia). G may be NULL. */
void discrete_inertia(const model *, const model_state *, const element_rotating_frame *, sparse *M,
                      sparse *G);
/* Add the two parts of the tangent (see stiffness_parts_material_products in newton.h).
 * discrete_material_product adds to y the product of the material part and x[free + driven].
 * discrete_geometric adds the geometric part to `out`. */
void discrete_material_product(const model *, const model_state *, const double x[], double y[]);
void discrete_geometric(const model *, const model_state *, const element_rotating_frame *,
                        sparse *out);
double discrete_material_rounding(const model *, const model_state *, const double x[]);
/* Functions for dashpots. They compute the deformations d[6 x springs] of all springs, the rates of
 * these deformations for the rates dx[free + driven] of the coordinates, and the dissipated power
 * [W]. They add the forces of the dashpots to out[free + driven], or those on the frame of a node
 * to F[6], and the damping matrix for small motions to C. */
void dashpots_deformations(const model *, const model_state *, double d[]);
void dashpots_rates(const model *, const model_state *, const double dx[], double rate[]);
double dashpots_power(const model *, const double rate[]);
/* Returns the work that a spring without a potential absorbs, in addition to its energy, while its
 * deformations d change by `change`: change . (K - K^T)/2 d. The work is 0 for symmetric
 * springs. */
double spring_circulated(const model *, int spring, const double d[6], const double change[6]);
void dashpots_add_forces(const model *, const model_state *, const double rate[], double out[]);
void dashpots_node_force(const model *, const model_state *, const double rate[], int node,
                         double F[6]);
/* Adds the damping of all springs, and `more` [s] times their stiffness, to C. */
void dashpots_matrix(const model *, const model_state *, double more, sparse *C);
/* dashpots_strains computes the deformations of a spring and their derivatives J[6 x columns] with
 * respect to its coordinates. dashpots_stressed computes force[columns] and the geometric stiffness
 * K[columns x columns] for the stresses of the dashpot. */
void dashpots_strains(const model *, const model_state *, int spring, double d[], double J[]);
void dashpots_stressed(const model *, const model_state *, int spring, const double sigma[],
                       double force[], double K[]);
/* Returns the name of a spring, such as "spring s" or "foundation of member beam". Springs of
 * members follow those of the scene. */
scene_words model_spring_called(const model *, int spring);
/* Returns the energy of all springs [J]. */
double discrete_stored(const model *, const model_state *);
/* Adds to F[6: N, N m] the force and moment on a node's frame that hold the discrete elements in
 * the state. */
void discrete_node_force(const model *, const model_state *, const element_rotating_frame *,
                         int node, double F[6]);

/* Writes text such as "beam has 6 elements, 2 in each of 3 pieces, because loads begin, end or act
 * at 0.3, 0.5 of the length". A long list is truncated. If `elements` is 0, writes the text for any
 * number n. The text is "" if each member is a single piece. */
void division_words(const scene *, int elements, char *text, size_t room);

/* Transform forces, or a matrix K[columns x columns], from element coordinates to coordinates of
 * the model, in place. eliminate_matrix needs the internal forces for second derivatives. Arguments
 * that are NULL are skipped. */

void eliminate_forces(const model *m, const model_state *s, const mesh_element *el,
                      double force[]); /* [columns] */
void eliminate_matrix(const model *m, const model_state *s, const mesh_element *el,
                      const double force[], double K[]);

typedef struct mesh_entry {
    short local; /* row * columns + column in the element's matrix */
    short column;
    int offset; /* offset in the pattern from the start of its column */
} mesh_entry;

/* Entries of elements that have the same relative positions in the columns of a pattern. */
typedef struct mesh_layout {
    int entries;
    mesh_entry *entry; /* [entries] */
} mesh_layout;

typedef struct mesh_pattern {
    int made;
    sparse matrix;
    int layouts;
    mesh_layout *layout;
    int *layout_of;              /* [elements] */
    const mesh_element *element; /* of the model */
    matrix_factor *analysed;     /* symbolic analysis of a symmetric pattern; NULL: not yet made */
} mesh_pattern;

/* Allocates a factor for a matrix with one of the patterns. Factors of a symmetric pattern share
 * its symbolic analysis, which is made by the first call, and the patterns must outlive them. */
status assemble_factor(assemble_patterns *, const sparse *, matrix_factor **out, fault *f);
/* Returns the pattern of the matrix, including the positions of the entries of elements. */
const mesh_pattern *assemble_of(const assemble_patterns *, const sparse *a);
void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out);
/* Adds K of a discrete element to the matrix. Searches the pattern for the positions of the
 * entries. */
void assemble_discrete(const mesh_element *el, const double K[], sparse *out);
void assemble_vector(const mesh_element *el, const double local[], double out[]);
/* Subtracts a value from an entry. Has no effect if the entry is not stored. */
void assemble_subtract(sparse *a, int row, int column, double value);
/* Adds block[rows x columns] to the entries of these rows and columns that are stored. */
void assemble_add_block(sparse *a, int rows, const int row[], int columns, const int column[],
                        const double block[]);

/* An arc of constant torsion and curvature between two points. The arc is straight if the curvature
 * is zero. */
typedef struct member_arc {
    double length;         /* along the arc [m] */
    double start[3], R[9]; /* position and triad at p */
    double k[3];           /* [1/m] torsion and two curvatures, in the axes of the triad */
    /* [m] amplitude of the deviation from the arc, bow sin(half_waves pi s/length), in the axes of
     * the arc */
    double bow[2];
    int half_waves;
} member_arc;

/* Computes the axis of a member. axes_angle [rad]: angle of the axes of the section. REFUSED: no
 * arc of this curvature connects the ends of the member, or its y axis is parallel to the
 * member. */
status member_arc_of(const scene *s, int member, double axes_angle, member_arc *out, fault *f);
/* Computes the position, and the triad without the bow, at the arc length s [m]. */
void member_arc_at(const member_arc *a, double s, double position[3], double R[9]);

unsigned features_needed(const scene *);
/* Returns the physics that the scene omits although it has an effect. */
unsigned features_omitted(const scene *);
/* Returns the physics that the analyses of the scene need, that the scene does not omit, and that a
 * section given by constants or matrices does not define. A constant that is given as zero is
 * defined. */
unsigned features_not_given(const scene *, int section);
/* Returns 1 if a section of walls has a bimoment that causes torsion and the analyses depend on it.
 * No formulation models this effect. Returns 0 if no analysis includes stresses, if the scene is
 * confined to a plane, or if warping or the Wagner torque is omitted. */
int features_one_sided(const scene *, int section);
/* Like features_needed, but if the type does not support the requested shear theory in stability,
 * the theories of the type replace it. */
unsigned features_needed_of(const scene *, const element_type *);
/* Returns the shear theory in stability that the type uses for this scene, as a bit of
 * shear_theory; 0: there is no shear flexibility, or no analysis includes stresses. */
unsigned features_theory(const scene *, const element_type *);
/* Returns 1 if the scene has shear flexibility and an analysis that depends on the shear theory. */
int features_sheared(const scene *);
/* Returns the name of the theory, such as "Haringx". Returns the text of the type for SHEAR_OWN,
 * and "" for 0. */
const char *features_theory_words(const element_type *, unsigned theory);
/* Returns the features on which a quantity depends. Inertia is included only for modal and harmonic
 * analyses and for rotating structures. */
unsigned features_needed_by_quantity(const scene *, int quantity);

/* returns 1 if the shear centre differs from the centroid */
int features_eccentric(const section *c);
status features_of_section(const model *m, int section, unsigned *features, fault *f);

status kinematics_state_alloc(const model *, model_state **, fault *); /* undeformed, path = 0 */
/* Creates a state that contains only the path and the members that kinematics_component and
 * kinematics_driver_value need. */
status kinematics_nodes_alloc(const model *, const model_state *from, model_state **, fault *);
void kinematics_state_free(model_state *);
const model_state *kinematics_rest(const model *);
void kinematics_state_copy(const model *, const model_state *from, model_state *to);
/* Sets the histories of all elements to those of this accepted state, at which a step starts.
 * Before this call, results and tangent of the state belong to the step that led to it. */
void kinematics_commit(const model *, model_state *);
double kinematics_state_path(const model_state *);
const double *kinematics_strains(const model_state *); /* [elements x strains] */

/* Returns the frame of a node of the scene in a state: position [m] and unit quaternion. The
 * function is for tests in other folders, which cannot read the members of a state. */
void kinematics_frame(const model *, const model_state *, int node, double r[3], double q[4]);
/* Returns the displacement [m] or rotation-vector component [rad] of a node of the scene relative
 * to the undeformed state. NaN: the vector has lost its direction at a full revolution. */
double kinematics_component(const model *, const model_state *, int node, int component);
/* Like kinematics_component, but relative to the axes of another node `from`: change of the
 * position [m], or relative rotation vector [rad]. */
double kinematics_relative(const model *, const model_state *, int from, int node, int component);
double kinematics_driver_value(const model *, const model_state *, int driver);
/* Returns the largest angle [rad] between the orientations of the nodes of an element, and sets
 * *element_index to this element. If `chords` is 1, also considers the angles between the chord of
 * an element and the x axes of its ends. Angles up to a full revolution are distinguished. */
double kinematics_largest_turn(const model *, const model_state *, int chords, int *element_index);
/* Returns the largest angle [rad], from 0 to pi, between the first and the last node of an element
 * about its undeformed x axis, and sets *element_index to this element. */
double kinematics_largest_twist(const model *, const model_state *, int *element_index);
/* Returns the largest rise of the arc of an undeformed element due to its curvature about z, in
 * radii of gyration, and sets *element_index to this element. */
double kinematics_largest_rise(const model *, int *element_index);

/* Returns the index of a coordinate of a node; -1: the coordinate is fixed or dependent. */
int kinematics_coordinate(const model *, int node, int component);
enum { KINEMATICS_MOST = 6 + SCENE_RELEASED };
/* Computes the Jacobian T[6 x m] (row-major) of the six spatial increments of a vertex with respect
 * to the m coordinates on which it depends. index[m]: indices of these coordinates. If the state is
 * NULL, it is the undeformed one. Returns m <= size; m is at most 6 for a node. */
int kinematics_node_jacobian(const model *, const model_state *, int node, int size, int index[],
                             double T[]);
/* Computes the current vector [m] from the body of a vertex to the vertex. */
void kinematics_offset(const model *, const model_state *, int vertex, double rho[3]);

/* Transform three coordinates or forces of a vertex, whose translations may be along rotated axes,
 * to fixed axes and back, in place. */
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
/* Transforms A[3 x 3] from the translation axes of the vertex to the fixed axes. */
void kinematics_turn_back(const mesh_vertex *, double A[9]);
/* Transforms rows and columns of K[n x n] from fixed axes. The six coordinates of the vertex start
 * at `at`. */
void kinematics_turn_matrix(const mesh_vertex *, int n, int at, double K[]);

/* Fills x[nodes], the nodes of an element in a state, in the form that its type requires. */
void kinematics_gather(const model *m, const model_state *s, const mesh_element *el,
                       node_state x[]);
void kinematics_position(const model *m, const model_state *s, int vertex, double r[3]);
/* Computes the derivative of the position of a body moved by a diaphragm with respect to the first
 * angle of the body. */
void kinematics_arm(const model *, const model_state *, int vertex, double moved[3]);
/* Computes the displacement of the body that results if the angle of kinematics_arm increases by
 * `more` [rad] from the state. */
void kinematics_swing(const model *, const model_state *, int vertex, double more, double by[3]);
/* Computes the spatial axes b[angles][3] of the angles of a sequence in the current state. */
void kinematics_axes(const model *m, const model_state *s, int vertex, double b[3][3]);
/* Recomputes everything that depends on the coordinates of the bodies. */
void kinematics_follow(const model *m, model_state *s);
/* Computes the increments of an element's coordinates, local[7 nodes, and the additional unknowns],
 * from the increments of the model's coordinates. */
void kinematics_local(const model *m, const model_state *s, const mesh_element *el,
                      const double dx[], double local[]);

/* Sets the weights [free + driven] for the square of an increment, which is the mean over the
 * bodies of (displacement/size)^2 + rotation^2. */
void metric_of(const model *, double weight[]);
/* Returns the share of nodal displacements in the squared norm of an increment [free + driven]
 * (metric_of). */
double metric_shift_part(const model *, const double dx[]);
/* Returns the distance between two states (square root of the mean of metric_of). light[vertices
 * without released ends x 2 x 9]: projections (3 x 3, row-major) onto the excluded displacements
 * and onto the excluded rotations, the latter in the axes of the vertex; NULL: nothing is excluded.
 */
double metric_distance(const model *, const model_state *, const model_state *,
                       const double light[]);
/* Returns the largest angle [rad], over the bodies, between the orientations of a body in two
 * states. */
double metric_turn_between(const model *, const model_state *, const model_state *);

/* Physics that a scene requires and a formulation does not support. */

/* Physics that can be omitted and has no FEATURE_* bit. */
enum {
    OMIT_SHEAR_Y = FEATURE_END,             /* shear flexibility along y */
    OMIT_SHEAR_COUPLING = FEATURE_END << 1, /* shear coupling between y and z, and with warping */
    OMIT_SHEAR_WARPING = FEATURE_END << 2   /* shear flexibility due to warping */
};
enum { OMIT_WORDS = 200, OMIT_BITS = 17 }; /* length of their names; number of bits */

/* Writes the names of the physics that the type does not support, or a limit that the scene
 * exceeds, to `words`, which is empty if and only if there is none. Returns 0 if the type supports
 * everything that the scene requires. */
int missing_words(const scene *, const element_type *, char *words, int size);
/* Writes the names of missing physics that prevents any solution of the scene to `words`. Returns 0
 * if the scene can be solved. */
int missing_refused(const scene *, const element_type *, char *words, int size);
/* Returns the physics that a solution omits, as bits of FEATURE_* and OMIT_*. */
unsigned missing_omits(const scene *, const element_type *);
void missing_omit_words(unsigned omits, char words[OMIT_WORDS]);

/* Writes to `words` the features that the scene requires and that the type supports in one
 * direction only (element_lack). Returns 0: there are no such features; 1: they are negligible; 2:
 * missing_words also names them. */
int lacks_of(const scene *, const element_type *, char *words, int size);

struct model_state {
    double path;
    size_t size;
    double *block;
    double *u; /* [vertices x 3] displacement */
    double *q; /* [vertices x 4] orientation */
    /* [vertices x 3] angles of sequences; accumulated spatial increments of other rotations */
    double *angle;
    double *shift;             /* [releases x 3] displacements along slides */
    double *warp;              /* [warps] warping amplitudes and additional unknowns */
    double *driver;            /* [drivers] current value */
    double *e, *sigma, *inner; /* [elements x strains], [elements x strains], [elements x inner] */
    double *history;           /* [elements x history] */
    double *turn;              /* [turns x 3] tracked rotation vectors */
    double *feedback; /* [loads] integrals of the feedback errors; empty if there is no feedback */
};

/* Returns the history of an element in this state; NULL: the formulation has none, or the state
 * has only nodes. */
static inline const double *model_history_of(const model *m, const model_state *s, int element)
{
    return model_history(m) > 0 && s->history != NULL
               ? &s->history[(size_t)element * (size_t)model_history(m)]
               : NULL;
}

/* Possible motions [6: displacement, rotation] of a node: the span of the columns of its Jacobian.
 * Computed axes have rounding errors, so ranks are determined relative to the size of the columns,
 * and never by a comparison with zero. */

typedef struct movable {
    int count;
    unsigned components; /* bit i: at least one motion contains component i */
    int whole; /* 1: each motion is a single component; 0: a motion combines several components */
    int component[6]; /* [count] components of these motions */
    /* [6 x count] a basis, with lengths in units of `length`: unit vectors if they span the
     * motions, otherwise orthonormal vectors */
    double span[36];
    /* [count x 6] dual basis, with dual span = 1: the combinations of components, of smallest norm,
     * that give the share of each basis vector in a motion */
    double dual[36];
} movable;

/* Finds the possible motions from T[6 x columns]. The columns of T are motions of order 1:
 * displacement per displacement, or rotation per angle. length [m] > 0: size of the structure. */
void movable_of(int columns, const double *T, double length, movable *out);
/* Sets out[3] to the moment m without its part along the rotations in the columns of T. These
 * rotations are not prescribed, so a moment along them is a residual of Newton's method. */
void movable_prescribed(int columns, const double *T, const double m[3], double out[3]);

/* Describes what is lumped, with the order of convergence in space: loads with `lumped`, masses
 * that a motion, the scene or the formulation lumps, loads that are lumped with these masses, and
 * foundations. A long list is truncated. The text is "" if nothing is lumped. */
void on_nodes(const scene *s, const element_type *type, const double options[], char *text,
              size_t room);

/* Returns the index in m->section of an element of a member, counted along the member. */
int profile_at(const model *m, int member, int number);

/* Released ends of members, whose rotations and displacements are independent of the node
 * (scene_release). Each released end, and each end with an offset, has a vertex after all other
 * vertices, in the list `release`. R and r are the frame of the node's body, rho is the vector from
 * the body to the end, with its offset but without its released displacements, and a, d are the
 * axes of the undeformed member at the end. Then R_end = R exp(a_1 t_1) exp(a_2 t_2), r_end = r + R
 * rho + R_end (sum d_i s_i). Three released rotations have no order: R_end is free, with spatial
 * increments. The coordinates t, s of the end follow those of the element's nodes. */

/* Returns the released end at this vertex; NULL: none. */
static inline const mesh_release *release_of(const model *m, int vertex)
{
    const int first = model_first_release(m);
    return vertex < first ? NULL : &model_mesh_of(m)->release[vertex - first];
}

/* Returns the rotation or displacement of a member's end (0 at p, 1 at q) relative to its node, by
 * component; 0: the component is not released. For three released rotations, this is a component of
 * the rotation vector, which is NAN beyond 3 rad. */
double release_value(const model *, const model_state *, int member, int end, int component);
/* Like release_value, but for small motions x about the undeformed state `rest`, and without the
 * contribution of the rotation of the node. Sets `node` such that this contribution is the scalar
 * product of `node` and the rotation. */
double release_linear_value(const model *, const model_state *rest, const double x[], int member,
                            int end, int component, double node[3]);
/* Changes the released coordinates of the end by dx. Returns the largest change: a displacement
 * relative to model_length, or an angle [rad]. */
double release_advance(const model *, model_state *, int vertex, const double dx[]);

/* Computes the spatial axes of the rotations [turns x 3]. The axes of three rotations are the fixed
 * axes. */
void release_turn_axes(const model *, const model_state *, int vertex, double b[3][3]);
/* Computes the spatial directions of the released displacements [slides x 3], and the displacement
 * of the end relative to the body of its node [m], without the offset of the end. */
void release_slide_axes(const model *, const model_state *, int vertex, double along[3][3],
                        double apart[3]);

/* A spring between two frames, or between a frame and the ground. */

enum { SPRING_STRAINS = 6 };

/* Computes the stress [N, N m] for the deformations e, from the stiffness and the tables, and its
 * derivative S[6 x 6] (NULL: not needed). */
void spring_law(const scene_spring *, const double e[6], double sigma[6], double S[36]);
double spring_energy(const scene_spring *, const double e[6]);
/* Computes the discrete-gradient stress and its derivative with respect to e. The work of this
 * stress on the increment from `from` to e equals the change of energy for each component. */
void spring_mean(const scene_spring *, const double from[6], const double e[6], double sigma[6],
                 double S[36]);
/* Computes S at rest. */
void spring_at_rest(const scene_spring *, double S[36]);

/* Computes S of a spring, including its tables, for its current deformation. */
void spring_slopes(const model *, const model_state *, int spring, double S[36]);

/* Computes the deformation d of a spring in the axes of p: R_p^T (r_q - r_p) minus its initial
 * value [m], and the rotation vector of R_p^T R_q [rad]. If q is the only node, p is the ground. In
 * x[nodes], R is the rotation relative to the undeformed state. The output is out->e[6], out->J[6 x
 * 7 nodes], and out->H[7 nodes x 7 nodes] for the stresses out->s[6], in the exponential chart.
 * near: tracked rotation vector, which distinguishes several revolutions; NULL: the rotation is
 * less than half a revolution. */
void spring_strain(int nodes, const node_state x[], const double near[3], strain_output *out);

/* Check whether the supports fix all parts of a structure. A rigid motion of a part has six
 * components: the displacement of an origin, and the rotation times the size of the model. */

/* Returns 1 if a part of the undeformed structure can move in spite of the supports. Then sets
 * *node to a node of this part, and `motion` to a rigid motion that the supports allow, with
 * arbitrary scale (displacement of the node [m], rotation [rad]). Prescribed coordinates count as
 * fixed. Only parts with members are checked. Returns 0 without a check if the scene has
 * constraints, or if out of memory. */
int supports_loose_part(const model *, int *node, double motion[6]);

/* Smallest relative eigenvalue of the sum of squares for which a part counts as fixed. */
extern const double supports_loose;

void supports_join(const model *, int apart, int part[]);
int supports_root(const int part[], int vertex);
/* Returns the vertex that rigidly moves this vertex. If `apart` is 1, a released end counts as
 * independent and is returned itself. */
int supports_mover(const model *, int vertex, int apart);
/* Computes G[6 x 6], which gives the motion [m, rad] of a position from the rigid motion of the
 * origin: its displacement [m], and the rotation times `length` [m]. */
void supports_rigid(const double position[3], double length, double G[36]);
/* Computes the matrix out[6 x 6] of the motions that the supports of a node prevent, for rigid
 * motions about the origin. */
void supports_prevented(const model *, int node, const double origin[3], double out[36]);
/* Adds to sum[6 x 6] the squares of the motions that springs between the part and the ground
 * prevent. The stiffness of the springs has no effect. */
void supports_add_springs(const model *, const int part[], int root, const double origin[3],
                          double sum[36]);

/* Message for a rotation vector that is NaN: its direction is not known. */
extern const char turns_lost[];

/* Returns the rotation vector [3] of a node in a state; NaN: the vector has lost its direction. */
const double *turns_of_node(const model_state *, int node);
const double *turns_of_spring(const model *, const model_state *, int spring);

/* Relative rotation vectors depend on the quantities of a run. For a motion that another run
 * continues, these functions return the number of these vectors, and store and restore the two
 * nodes and the three components [5] of each vector. */
int turns_between_count(const model *);
void turns_put_between(const model *, const model_state *, double out[]);
void turns_take_between(const model *, int count, const double in[], model_state *);

/* Returns 1 if a vector of more than half a revolution has clearly changed its direction. */
int turns_swung(const double from[3], const double to[3]);
/* Returns 1 if the angle `size` is within `near` [rad] of one or more full revolutions. */
int turns_full(double size, double near);
/* Sets rotation vectors that have lost their direction since `from` to NaN. */
void turns_lose(const model *, const model_state *from, model_state *);

/* Describes the warping at the ends of members with sections that warp, for example "held at
 * base_a, base_b; shared at fold; free at tip". The text lists nodes, or ends in the form "leaf at
 * base" if the ends at a node differ. A long list is truncated. The text is "" if nothing warps. */
void warping_ends(const scene *s, char *text, size_t room);

#endif
