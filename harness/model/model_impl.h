#ifndef BEAMWORK_MODEL_IMPL_H
#define BEAMWORK_MODEL_IMPL_H

#include "cases/scene/scene.h"
#include "elements/element.h"
#include "harness/model/model.h"

/* Divides the members into elements. elements: number of elements per piece of each member that
 * does not specify a number. */
status division_make(const scene *, int elements, division *, fault *);
void division_free(division *);

int division_pieces(const division *, int member);
int division_elements(const division *, int member);
/* Sets ends[2] to the start and end of the piece that contains an element, which is counted along
 * its member. Returns the index of the element in the piece. */
int division_piece(const division *, int member, int number, double ends[2]);

status discrete_build(model *, fault *);
/* Computes the inertia of a body in the coordinates of its node [7: translation, spatial rotation,
 * warping, which does not move] (rigid_body.c). x contains the position and, in R, the rotation
 * since the undeformed state. frame NULL: the frame is at rest. */
void body_inertia(const scene_body *b, const node_state *x, const element_rotating_frame *frame,
                  inertia_output *out);

/* Returns 1 if elements of the type have distributed mass in this motion. */
int features_spreads(const scene *, int analysis, const element_type *, const double options[]);

/* Returns the features without which a requested quantity is meaningless. */
unsigned features_of_quantities(const scene *);

/* Removes omitted shear flexibilities and eccentricities from the constants of a section. */
void missing_omit(section *, unsigned omits);
/* Returns the description of the limit of the type that a section with this number of closed cells
 * exceeds; NULL: the section exceeds none. warps: 1 if the scene requires warping. */
const char *missing_in_section(const element_type *, const section *, int cells, int warps);

/* Sections of the elements. The sections of the scene come first, followed by one section for each
 * element of tapered members, which is evaluated at the middle of the element. Tapered members with
 * the same end sections and the same number of equal elements share these sections. */

status profile_scene(model *m, fault *f);
/* Computes the sections of all elements of tapered members. *sections: number of sections. */
status profile_members(model *m, int *sections, fault *f);

int release_count(const scene *);
/* Creates the vertices of released ends, and assigns them to the elements. */
status release_build(model *, fault *);

void release_add_local(const model *, const model_state *, int vertex, const double dx[],
                       double d[6]);
/* Transforms T[6 x count] of the node to the T of the end. The columns of released coordinates
 * start at `own`. */
void release_jacobian(const model *, const model_state *, int vertex, int count, int own,
                      double T[]);
/* Sets the positions and orientations of released ends. */
void release_follow(const model *, model_state *);

/* Transforms force[6] from the frame of the end to the frame of its node, and sets own[] to the
 * forces on the released coordinates. */
void release_force(const model *, const model_state *, int vertex, double force[6], double own[]);
/* Transforms K to the frame of the node, as release_force does for the force. The six coordinates
 * of the end start at `at`, and the released coordinates start at `own`. force[6]: force on the
 * end, which is transformed as well; NULL: second derivatives are omitted. */
void release_matrix(const model *, const model_state *, int vertex, int n, int at, int own,
                    double force[6], double K[]);

/* Allocates the tracked rotation vectors in the following order: nodes of the scene, springs
 * (relative between their ends), and relative vectors between nodes that quantities use. */
status turns_build(model *, fault *);

/* Updates the rotation vectors of a state after a change of orientations. */
void turns_follow(const model *, model_state *);
/* Returns the rotation vector between two nodes; NULL: no quantity needs it. */
const double *turns_between(const model *, const model_state *, int from, int node);

/* A tracked rotation vector of a node's frame. The vector is relative to the frame of another node
 * (NONE: to the fixed frame). */
typedef struct mesh_turn {
    int from, node;
} mesh_turn;

struct model {
    model_mesh mesh; /* public part; must be the first member */
    const scene *scene;
    const model_imperfect *imperfect;
    const element_type *given; /* type before it is completed */
    element_type completed;    /* copy of the type to which adapters have added missing functions */
    double options[ELEMENT_MAX_OPTIONS];
    int keep_all;
    unsigned features, omits; /* included features, and omitted physics of the scene */
    section *section;         /* sections of the scene, followed by those of tapered members */
    int *profile;             /* [members] index of the section of the first element */
    mesh_triad *triad;        /* [triads] with capacity for all nodes of all elements */
    int triads;
    int *kind_of_section;  /* [sections] first kind of element (model.h) with this section; NONE:
                              there is none */
    scene_spring *founded; /* springs of foundations at the vertices of their members */
    mesh_turn *turn;       /* [turns] in the order of model_turns */
    double size;           /* length of the longest member [m] */
    int requested;         /* requested number of elements per piece of a member */
    division division;
    model_state *rest;
    int lines;
    char **line; /* descriptions of eliminated coordinates and omitted physics */
};
_Static_assert(offsetof(struct model, mesh) == 0, "model_mesh_of finds it by the model's address");

/* Initial imperfections: displacements and rotations at points of members, interpolated linearly
 * between the points. */
struct model_imperfect {
    scene own;   /* scene with copies of nodes, members, loads and imperfections */
    scene lines; /* copy of the scene in which only nodes are shifted, for the lines of members */
    int modes;   /* 0: there are only shifts of nodes */
    int *first;  /* [members + 1] index of the first point of each member */
    /* [points] position 0 .. 1, shift [m], and rotation [rad] */
    double *place, (*shift)[3], (*turn)[3];
};

/* Creates a model. imperfect: initial shape of the requested scene, which must outlive the model;
 * NULL: the structure is perfect. */
status model_alloc_imperfect(const model_request *, const model_imperfect *, model **, fault *);
const scene *imperfect_lines(const model *);
/* Moves a point of the line of a member, and rotates its triad, by the imperfection at `place`. */
void imperfect_move(const model *, int member, double place, double position[3], double R[9]);
/* Computes the rotation of the imperfection at place[1] minus that at place[0] of a member [rad].
 */
void imperfect_turn(const model *, int member, const double place[2], double turn[3]);
/* Computes the increments of all vertices, [vertices x 6], including nodes without members
 * (centreline.c). */
void centreline_increments(const model *, const double x[], double out[]);

/* Sets the length and R of an arc with curvature k between two points (release.c). y: y axis at the
 * start of the arc. REFUSED: there is no such arc, or y is parallel to it. */
status member_arc_between(const scene *s, int member, const double chord[3], const double y[3],
                          member_arc *, fault *);

status mesh_build(model *m, fault *f);

status coordinates_number(model *m, fault *f);
status coordinates_note_left_out(model *m, fault *f, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

typedef struct model_words {
    char *text;
    size_t room, used;
} model_words;
void model_words_put(model_words *, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
