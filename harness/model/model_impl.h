/* Inside of a model, shared by the files of harness/model and harness/newton only. */
#ifndef BEAMWORK_MODEL_IMPL_H
#define BEAMWORK_MODEL_IMPL_H

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

/* What has a rotation vector that is followed: a node's frame against another's, NONE: against the
 * fixed one. */
typedef struct mesh_turn {
    int from, node;
} mesh_turn;

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

/* An entry of an element's matrix that a pattern stores. */
typedef struct mesh_entry {
    short local;  /* row * columns + column of the element's matrix */
    short column; /* of the element's matrix */
    int offset;   /* in the pattern: from the begin of its column */
} mesh_entry;

/* What elements share whose entries stand alike in the columns of a pattern. */
typedef struct mesh_layout {
    int entries;
    mesh_entry *entry; /* [entries] */
} mesh_layout;

/* Pattern with the places of every element's entries in it. */
typedef struct mesh_pattern {
    int made;
    sparse matrix;
    int layouts;
    mesh_layout *layout;
    int *layout_of;              /* [elements] */
    const mesh_element *element; /* of the model */
} mesh_pattern;

struct model {
    const scene *scene;
    const element_type *given; /* as its file has it */
    const element_type *type;  /* with what that leaves out: given, or &completed */
    element_type completed;
    double options[ELEMENT_MAX_OPTIONS];
    int keep_all, nodes, coordinates, strains, inner, memory; /* per element: nodes, 7 nodes, ... */
    unsigned features, omits; /* what it has, and what it has not of what the scene has */
    section *section; /* of the scene; behind them of members whose section changes: profile.h */
    int *profile;     /* [members] section of the first element */
    int vertices, elements, kinds, warps;
    int first_release, releases; /* vertices of released ends are the last */
    mesh_release *release;
    mesh_vertex *vertex;
    mesh_element *element;
    mesh_triad *triad; /* [triads], room for those of all nodes of all elements */
    int triads;
    mesh_kind *kind;
    int *kind_of_section; /* [sections] the first, or NONE */
    mesh_warp *warp;
    int discretes, springs; /* springs: the last of them */
    mesh_discrete *discrete;
    int turns;
    mesh_turn *turn;        /* [turns] in the order of turns.h */
    int *first_element;     /* [members + 1] */
    int *driver_coordinate; /* [drivers] or NONE */
    int free, driven;
    double size;       /* length of the longest member [m] */
    int asked;         /* elements of a piece of a member */
    division division; /* of the members into elements */
    int work_size;     /* of an element in a linear_memory: harness/newton/run_state.h */
    model_state *rest; /* undeformed */
    int takes;         /* elements take loads along them (element_type.along) */
    int lines;
    char **line; /* what was left out */
};

/* What a slot of a linear_memory has at its end where elements take loads along them: does this
 * one, how its frame turns [3 x 14], and what stresses [strains x 3] and inner unknowns [inner x 3]
 * do then. */
enum { SLOT_TAKES, SLOT_TURN, SLOT_MIXED = SLOT_TURN + 3 * ELEMENT_ALONG_COORDINATES };
static inline int slot_followed(const model *m)
{
    return SLOT_MIXED + 3 * m->strains;
}
static inline int slot_along(const model *m)
{
    return slot_followed(m) + 3 * m->inner;
}

struct model_state {
    double path;
    size_t size; /* doubles in block */
    double *block;
    double *u;      /* [vertices x 3] displacement */
    double *q;      /* [vertices x 4] orientation */
    double *angle;  /* [vertices x 3] of sequences; accumulated spatial increments otherwise */
    double *shift;  /* [releases x 3] along slides */
    double *warp;   /* [warps] */
    double *driver; /* [drivers] present value */
    double *e, *sigma, *inner; /* [elements x strains], [.. inner] */
    double *turn;              /* [turns x 3] rotation vectors that have been followed: turns.h */
};

/* features.c */
int features_eccentric(const section *c); /* its shear centre is not its centroid */
status features_of_section(const model *m, int section, unsigned *features, fault *f);

/* mesh.c */
status mesh_build(model *m, fault *f);

/* coordinates.c */
status coordinates_number(model *m, fault *f);
/* The axis about which alone a node is held, or driven, so that it takes a moment about it in
 * whatever way the node turns about the two others; NONE: of no or of several axes. */
int coordinates_held_turn(const model *m, int node);
status coordinates_note_left_out(model *m, fault *f, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* kinematics.c */
void kinematics_gather(const model *m, const model_state *s, const mesh_element *el,
                       node_state x[]);
void kinematics_position(const model *m, const model_state *s, int vertex, double r[3]);
/* Spatial axes of a sequence's angles in the present state: b[angles][3]. */
void kinematics_axes(const model *m, const model_state *s, int vertex, double b[3][3]);
/* Recomputes what depends on bodies' coordinates. */
void kinematics_follow(const model *m, model_state *s);
/* Increments of an element's own coordinates from those of the model: local[7 nodes]. */
void kinematics_local(const model *m, const model_state *s, const mesh_element *el,
                      const double dx[], double local[]);

/* eliminate.c: element coordinates -> model coordinates, in place; K[columns x columns]. force:
 * internal, for the second derivatives; NULL entries are skipped. */
void eliminate_forces(const model *m, const model_state *s, const mesh_element *el,
                      double force[]); /* [columns] */
void eliminate_matrix(const model *m, const model_state *s, const mesh_element *el,
                      const double force[], double K[]);

/* assemble.c */
/* That on which a matrix was made. */
struct assemble_patterns;
const mesh_pattern *assemble_of(const struct assemble_patterns *, const sparse *a);
void assemble_matrix(const mesh_pattern *p, int element, const double K[], sparse *out);
/* The same of a discrete element, whose places are looked for. */
void assemble_discrete(const mesh_element *el, const double K[], sparse *out);
void assemble_vector(const mesh_element *el, const double local[], double out[]);
/* Nothing where it is not stored. */
void assemble_subtract(sparse *a, int row, int column, double value);

#endif
