/* The mesh of a model, to read: elements, vertices, and what joins them. It stays once model_alloc
 * has returned. */
#ifndef BEAMWORK_MODEL_MESH_H
#define BEAMWORK_MODEL_MESH_H

#include "elements/field/field.h"
#include "harness/model/division.h"
#include "harness/model/model.h"

/* An element depends on the coordinates of its nodes and on those of released ends. */
enum {
    NONE = -1,
    VERTEX_COORDINATES = 6,
    MODEL_MAX_COORDINATES = ELEMENT_MAX_COORDINATES + 2 * SCENE_RELEASED
};

/* Where a frame is and what moves it. The first vertices are the scene's nodes, in order. */
typedef struct mesh_vertex {
    double position[3]; /* undeformed [m] */
    int body; /* vertex that moves this one rigidly; itself: it has coordinates of its own */
    double offset[3];  /* from the body, undeformed [m] */
    int coordinate[6]; /* of a body: global coordinate or NONE where held */
    int angles;        /* > 0: rotation is a sequence of so many angles about the axes */
    double axis[3][3];
    int idle;             /* bits of angles that are held: nothing depends on them */
    int vector_driver[3]; /* prescribed rotation vector: its drivers; NONE: not prescribed so */
} mesh_vertex;

/* What an end of a member keeps to itself: see release.h. */
typedef struct mesh_release {
    int node; /* of the scene, from which it is released */
    int turns, slides;
    double turn[3][3], slide[3][3]; /* undeformed axes, unit vectors */
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
    int warp[ELEMENT_MAX_NODES];     /* index, or NONE: held at zero or absent */
    double share[ELEMENT_MAX_NODES]; /* of its mass where that is at nodes: mesh.c */
    double couple[2];  /* of two nodes: what resultants at an end have beside: time/shares.c */
    mesh_triad *triad; /* [nodes] initial; not its own: equal ones share them */
    int columns; /* coordinates after elimination: 7 nodes, behind them those of released ends */
    int index[MODEL_MAX_COORDINATES]; /* the global one of each of them, or NONE */
    int plain; /* 1: no offset, sequence or released end: elimination is selection */
} mesh_element;

/* A rigid body's mass at a vertex, or a spring between vertices: an element beside those of the
 * members. */
typedef struct mesh_discrete {
    mesh_element el; /* no kind, no member, no warping */
    const scene_body *body;
    const scene_spring *spring; /* of both one, the other NULL */
    mesh_triad triad[ELEMENT_MAX_NODES];
} mesh_discrete;

/* What identical elements share. */
typedef struct mesh_kind {
    int section;
    double length, curvature[3], strain[3];
    int next; /* kind of the same section, or NONE */
    element_data *data;
    size_t data_size;         /* [bytes] */
    displacement_field field; /* displacements between the nodes, for loads */
    double *inner; /* field_inner where frequencies are asked for, or NULL: the type has another
                      mass */
} mesh_kind;

/* What the questions below read without a call: the first member of every model, which
 * harness/model alone fills. */
typedef struct model_mesh {
    const element_type *type;                       /* with what its file leaves out */
    int nodes, coordinates, strains, inner, memory; /* per element: nodes, 7 nodes, ... */
    int vertices, elements, kinds, warps;
    int first_release, releases; /* vertices of released ends are the last */
    mesh_release *release;
    mesh_vertex *vertex;
    mesh_element *element;
    mesh_kind *kind;
    mesh_warp *warp;
    int discretes, springs; /* springs: the last of them */
    mesh_discrete *discrete;
    int turns;              /* that are followed: turns.h */
    int *first_element;     /* [members + 1] */
    int *driver_coordinate; /* [drivers] or NONE */
    int free, driven;
    int takes;     /* elements take loads along them (element_type.along) */
    int work_size; /* of an element in a linear_memory: harness/newton/run_state.h */
} model_mesh;
static inline const model_mesh *model_mesh_of(const model *m)
{
    return (const model_mesh *)m;
}

/* Of an element: its type, nodes, their coordinates (7 each), strains, inner unknowns, and doubles
 * that its type remembers of a linearisation. */
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
/* 1: elements take loads along them (element_type.along). */
static inline int model_takes_loads(const model *m)
{
    return model_mesh_of(m)->takes;
}
/* Doubles of an element in a linear_memory (harness/newton/run_state.h). */
static inline int model_work_size(const model *m)
{
    return model_mesh_of(m)->work_size;
}

/* Coordinates: [0, unknowns) and, behind them, those that drivers prescribe. */
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
/* Of a driver, or NONE. */
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
/* The first of a member; of the number of members: behind the last. */
static inline int model_first_element(const model *m, int member)
{
    return model_mesh_of(m)->first_element[member];
}
/* Of members into elements. */
const division *model_division(const model *);
static inline int model_kinds(const model *m)
{
    return model_mesh_of(m)->kinds;
}
static inline const mesh_kind *model_kind(const model *m, int kind)
{
    return &model_mesh_of(m)->kind[kind];
}
/* What an element is prepared as. */
static inline const mesh_kind *model_kind_of(const model *m, int element)
{
    return &model_mesh_of(m)->kind[model_mesh_of(m)->element[element].kind];
}
/* Rigid bodies, behind them the springs. */
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

/* The first ones are those of the nodes, the last ones those of released ends. */
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
/* The axis about which alone a node is held, or driven, so that it takes a moment about it in
 * whatever way the node turns about the two others; NONE: of no or of several axes. */
int coordinates_held_turn(const model *, int node);
/* Warping amplitudes, and the coordinate of one. */
static inline int model_warps(const model *m)
{
    return model_mesh_of(m)->warps;
}
static inline int model_warp(const model *m, int warp)
{
    return model_mesh_of(m)->warp[warp].coordinate;
}
/* Rotation vectors that are followed (turns.h). */
static inline int model_turns(const model *m)
{
    return model_mesh_of(m)->turns;
}

/* What a slot of a linear_memory has at its end where elements take loads along them: does this
 * one, how its frame turns [3 x 14], and what stresses [strains x 3] and inner unknowns [inner x 3]
 * do then. */
enum { SLOT_TAKES, SLOT_TURN, SLOT_MIXED = SLOT_TURN + 3 * ELEMENT_ALONG_COORDINATES };
static inline int slot_followed(const model *m)
{
    return SLOT_MIXED + 3 * model_strains(m);
}
static inline int slot_along(const model *m)
{
    return slot_followed(m) + 3 * model_inner(m);
}

#endif
