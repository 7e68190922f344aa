/* Internal declarations of newton/. */
#ifndef BEAMWORK_NEWTON_IMPL_H
#define BEAMWORK_NEWTON_IMPL_H

#include <stddef.h>

#include "elements/field/field.h"
#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

enum { LUMPS_NOTHING, LUMPS_WEIGHTS, LUMPS_LOADS };

/* Returns the strain rates of springs; NULL: the structure is at rest or undamped. */
static inline const spring_rates *damping_of_springs(const run_damping *d)
{
    return d != NULL ? &d->springs : NULL;
}

/* Returns the rotating frame at a path parameter: its centre and its angular velocity. */
element_rotating_frame loading_frame(const loading *, double path);

/* Returns 1 for a uniform load on the whole length of a member without `lumped`. Its nodal shares
 * are those of the mass. */
int applied_with_mass(const scene_load *);
/* Like applied_each for a load along a member, but only for its part on this element. */
void applied_element(const model *, const model_state *, const scene_load *, double scale,
                     int element, void (*take)(void *context, const applied *), void *context);
/* Finds the range [from, to] of an element on which a load along its member acts. For a point load,
 * both limits are its position. A point load between two elements belongs to the second one.
 * Returns 0 if the load does not act on this element. */
int applied_part(const model *, int element, const scene_load *, double part[2]);
int applied_inside(double x);
/* Computes the vector of a load along the member at x in [0, 1] of an element, in the components of
 * the scene. */
void applied_vector(const model *, int element, const scene_load *, double x, double vector[3]);
/* Computes the axes of the undeformed member, with y as in the scene. triad: axes of the member
 * whose y and z are the principal axes of the section. */
void applied_member_axes(const double triad[9], const section *, double axes[9]);

/* Adds `value` to entry (row, column) of a stiffness matrix. `value` may be zero, and several calls
 * may add to one entry. */
typedef void (*loads_entry)(void *context, int row, int column, double value);
void applied_stiffness(const model *, const model_state *, const scene_load *, double scale,
                       loads_entry take, void *context);

/* Condenses members to their ends before the tangent is solved, and expands the solution. The
 * remaining system is as small as with one element per member. */

/* Allocates a condensation. *out is NULL if all members have fewer elements than `from` (0: so few
 * that rounding does not spoil an assembled tangent), if there are more than MOST_ENDS end
 * coordinates, or if the members cannot be condensed (see the conditions in condensation.c).
 * released[count]: prescribed coordinates that are also unknowns. */
status condensation_alloc(const equations *, int from, int count, const int released[],
                          condensation **out, fault *);
/* Allocates a condensation with other released coordinates and the members of `of`, which must
 * outlive the condensation. See condensation_take. */
status condensation_alloc_like(const condensation *of, int count, const int released[],
                               condensation **out, fault *);
void condensation_free(condensation *);

/* Computes the tangent, with condensed members, from the last linearise_state with the same
 * arguments. SINGULAR: a member is in a critical state (chain_add, chain_stiffness). */
status condensation_at(condensation *, const model_state *, double path, fault *);
/* Computes the tangent with the members of `of` in its state. `of` remains their owner. */
void condensation_take(condensation *, const condensation *of, const model_state *);
/* Returns the matrix of all end coordinates. */
sparse *condensation_ends(condensation *);
/* Factors the matrix of the unknowns. Returns the failures of factor_numeric. */
status condensation_factor(condensation *, fault *);
void condensation_solve(condensation *, int transposed, double x[]);
factor_counts condensation_count(const condensation *);
/* Creates a factor that uses the condensation for solutions. The factor owns the condensation. */
status condensation_as_factor(condensation *, matrix_factor **, fault *);

/* Condenses members if at least one member has many elements (solve_options.condensed). *out is
 * NULL as for condensation_alloc, or if the condition of the tangent of all coordinates was
 * requested. */
status context_condensation(const analysis_context *, int count, const int released[],
                            condensation **out, fault *);
/* Like context_factor, for a tangent with condensed members. */
status context_factor_condensed(analysis_context *, condensation *, fault *);

/* Finds the released coordinates of the node of the compliance analysis, and allocates the matrices
 * of the border. */
status border_alloc(const analysis_context *, const scene_compliance *, border *, fault *);
void border_free(border *);

/* Loads along members between vertices. Their nodal forces follow from their work on the
 * displacements inside elements (elements/field), or the element includes them in its
 * equilibrium. */

typedef struct distributed_loads {
    const equations *eq;
    const model *m;
    int element;
    double path;
} distributed_loads;

/* Returns 1 if nodal forces follow from the work of the load inside elements; 0: the load is lumped
 * at the nodes, or does not act along a member. */
int distributed_spreads(const equations *, const scene_load *);

/* Returns 1 if the element includes the load in its equilibrium (element_type.along). Only dead
 * forces along the whole line of an element are included, and none during motions. */
int distributed_takes(const equations *, int element, const scene_load *);
/* Sum of the loads that an element includes in its equilibrium. */
typedef struct distributed_taken {
    int acts;
    double force[3 * ELEMENT_ALONG_POINTS], mixed[3 * ELEMENT_MAX_STRAINS],
        H[ELEMENT_ALONG_COORDINATES * ELEMENT_ALONG_COORDINATES];
    /* output that points to the arrays above; its stresses are added to those of a slot */
    along_output out;
} distributed_taken;
/* Computes *out for the loads at `path`. out->acts is 0 if there are no such loads. */
void distributed_take(const equations *, int element, double path, distributed_taken *out);
/* Adds to forces[14] the part of the loads that J^T sigma does not contain, and subtracts its
 * derivative from K[14 x 14]. gap[strains]: D(x) - e. */
void distributed_add_taken(const model *, const along_output *out, const double J[],
                           const double gap[], double forces[], double K[]);

/* Adds to forces[7 nodes] the forces of a load along a member on one of its elements, multiplied by
 * `scale`. Subtracts their derivative from K[7 nodes x 7 nodes], which may be NULL. Returns 0 if
 * the load exerts no force on the element. If the element includes the load in its equilibrium,
 * adds the derivative of the forces with respect to the magnitude of the load, multiplied by
 * `scale`. */
int distributed_add_one(const equations *, const model_state *, const node_state x[], int element,
                        const scene_load *, double scale, double forces[], double K[]);
/* Like distributed_add_one, for all loads at `path`. For loads that the element includes in its
 * equilibrium, it adds only the part that J^T sigma does not contain; in the state kinematics_rest,
 * it adds their full forces. */
int distributed_add(const equations *, const model_state *, const node_state x[], int element,
                    double path, double forces[], double K[]);
/* Like distributed_add, but only for loads that the element includes in its equilibrium. */
int distributed_add_own(const equations *, const model_state *, const node_state x[], int element,
                        double path, double forces[], double K[]);
/* Computes the stresses of a state under the loads at `path` (sigma and C of stress_output).
 * Returns 0 if the element includes no loads in its equilibrium. */
int distributed_stress(const equations *, const model_state *, const node_state x[], int element,
                       double path, const stress_output *, status *outcome);
int distributed_add_field(const equations *, const node_state x[], int element, double path,
                          double forces[], double K[]);

/* Like field_add_loads, for a type that computes the motion of its sections. Adds loads at `count`
 * points of an element, at most ELEMENT_ALONG_POINTS. at: positions divided by the length. */
void line_add_loads(const model *, int element, const node_state x[], int count, const double at[],
                    const field_load load[], double forces[], double K[]);

int distributed_acts(const distributed_loads *);
/* Returns the index of a load that starts, ends or acts at a point inside the element; SCENE_NONE:
 * none. */
int distributed_jumps(const distributed_loads *);
/* Computes the load per initial length on the section with this frame at x in [0, 1] of the
 * element: loads on its member, and inertia in a rotating frame, including rotary inertia unless
 * omitted. context: a distributed_loads. */
void distributed_at(void *context, double x, const span_frame *, span_load *out);

/* Subtracts the centrifugal force from `force` and adds its stiffness to K (may be NULL), in
 * element coordinates. Without a rotating frame, both are unchanged. */
status rotating_frame_add(const equations *eq, const node_state x[], int element, double path,
                          double force[], double K[], fault *f);

/* Adds all loads to out[free + driven] (loads.c). loads_add_at_vertices adds only the loads on
 * vertices. */
void loads_add(const equations *eq, const model_state *s, double path, double out[]);
void loads_add_at_vertices(const equations *eq, const model_state *s, double path, double out[]);
/* Calls the function for each entry of the stiffness of the loads on vertices. */
void loads_stiffness_at_vertices(const equations *eq, const model_state *s, double path,
                                 loads_entry, void *context);
void loads_subtract_at_vertices(const equations *eq, const model_state *s, double path, sparse *K);
/* Subtracts the stiffness of all loads from K, which has a pattern of model.h. */
void loads_subtract_stiffness(const equations *eq, const model_state *s, double path, sparse *K);
/* Checks that the loads have a potential. REFUSED: the stiffness of a moment is not symmetric, so a
 * symmetric matrix cannot contain it. */
status loads_have_potential(const equations *eq, const model_state *s, double path, fault *f);

/* Adds the effect of reaction moments at nodes that are fixed about one axis only. K of elements
 * and loads contains the derivatives of work in the exponential chart of a node's rotation. At such
 * a node with the fixed axis h, only the moments about the other two axes i and j are in
 * equilibrium. The derivatives of these moments differ by the reaction moment R: K_ij += R/2, K_ji
 * -= R/2, with h, i, j in cyclic order. */
void linearise_add_held_moments(const equations *eq, const model_state *s, double path, sparse *K);
/* Checks that there is no reaction moment of linearise_add_held_moments. REFUSED: there is one, and
 * it has no potential. */
status linearise_held_have_potential(const equations *eq, const double sigma[], double path,
                                     fault *f);

/* Computes the loads at `path` on the undeformed state: f[free + driven]. */
void loads_reference(const equations *, double path, double f[]);

/* Computes the increments of the prescribed coordinates (dx[free .. free + driven)) from the state
 * to `path`. Other entries are unchanged. */
void loads_drive(const equations *, const model_state *, double path, double dx[]);

/* Changes K for a node that rotates by a sequence of angles when the moment M of the prescribed
 * angles becomes a load. */
void loads_release_moment(const model *, const model_state *, int node, const double M[3],
                          sparse *K);

/* Evaluation of one element. */
typedef struct chunk_element {
    int index;     /* input: index of the element */
    double *force; /* input: array for the forces [7 nodes] */
    double *K;     /* input: array for sum sigma_i H_i [7 nodes x 7 nodes]; may be NULL */
    node_state x[ELEMENT_MAX_NODES];
    distributed_taken along; /* loads that the stresses include */
    status outcome;
    int complete; /* 1: `force` is J^T sigma of the slot, and K also contains J^T C J */
    double present[ELEMENT_MAX_COORDINATES]; /* J^T sigma of the state, if `complete` is 1 */
} chunk_element;

/* Evaluates strains and stresses of `count` elements into their slots (linearise_slot), and sets
 * the outputs of each chunk_element. */
void chunk_evaluate(const equations *eq, const linear_memory *memory, const model_state *s,
                    double path, int count, chunk_element element[]);
/* Computes x[count x nodes] and sum sigma_i H_i of these elements: H[count x own x own
 * coordinates]. count: at most CHUNK_MOST. */
void chunk_second_derivatives(const equations *eq, const model_state *s, int count,
                              const int element[], node_state x[], double H[]);

/* Adds an iteration of the current trial step. energy [J]: |r . K^-1 r| of the residual r; NAN:
 * unknown. */
status history_add_iteration(solve_result *r, step_record *step, const iteration_record *one,
                             double energy, fault *f);

/* Adds the free strain: the elongation, and the curvatures about the principal axes. */
void free_strain_amounts(const equations *, int element, double path, double strain[3],
                         double curvature[3]);
/* Compute the first-order free strains about the undeformed state: out[strains].
 * free_strain_linear: due to temperatures at `path`. free_strain_own: due to initial strains of
 * members. */
void free_strain_linear(const equations *, int element, double path, double out[]);
void free_strain_own(const model *, int element, double out[]);
/* Returns the largest strain due to temperatures. Curvatures are multiplied by the length of the
 * model. */
double free_strain_size(const equations *, double path);
/* Computes the change of the free strains in a state due to a temperature load times `scale`:
 * out[strains]. Returns 0 if the load does not act on the element. */
int free_strain_by_load(const equations *, const model_state *, int element, const scene_load *,
                        double scale, double out[]);

/* Linear stresses and forces about the undeformed state. */

status linear_stresses(const equations *, const double x[], double sigma[],
                       fault *); /* computes sigma = S J x, [model_stresses] */
/* Computes the stresses of the loads (including temperatures) that vary between path 0 and `path`.
 * x: displacements due to these loads. */
status linear_growing_stresses(const equations *, const double x[], double path, double sigma[],
                               fault *);
void linear_forces(const equations *, const double sigma[],
                   double f[]); /* computes f[free + driven] = sum J^T sigma */
/* Quadratic forms from element strains. */
double linear_strain_energy2(const equations *, const double x[]);
double linear_strain_rounding(const equations *,
                              const double x[]); /* returns a bound of the rounding error */
double linear_geometric_energy2(const equations *, const double sigma[], const double x[]);
/* Returns the rounding error of the geometric form, for the stresses sigma of the displacements
 * load_x[free + driven]. */
double linear_geometric_rounding(const equations *, const double load_x[], const double sigma[],
                                 const double x[]);

/* Returns REFINEMENT_ENDS if the accuracy is sufficient, otherwise REFINEMENT_LOST. correction: the
 * last correction or another measure of the error. */
refinement_state refinement_evaluate(solution_refinement *, double correction);
/* Returns SINGULAR. The message contains the remaining accuracy of `what` and a remedy. */
status refinement_refuse(const solution_refinement *, const char *what, fault *);
/* Returns |change|/|x| in the norm with n weights; 0: there is no change. `least`: lower limit of
 * |x|. */
double refinement_part(int n, const double weight[], const double change[], const double x[],
                       double least);

/* Returns 1 if mass is lumped at nodes, because of the scene or of a motion that starts from this
 * state. */
int rotating_frame_lumps(const equations *);

/* Computes minus the stiffness of the loads, which is their part of the tangent, for example of
 * moments and of loads on offsets. */
void rotating_frame_load_stiffness(const equations *, const model_state *, double path,
                                   sparse *out);

/* Strains and stresses of all elements from one call. */
typedef struct run_ahead {
    /* `what`: AHEAD_* bits of the valid strain outputs; `stresses` 1: the stresses are valid */
    int what, stresses;
    const element_data **data;
    const double **at, **inner;
    node_state *x;
    strain_output *strain;
    stress_output *stress;
    status *outcome;
    double *e, *sigma, *J, *H, *C, *memory;
} run_ahead;

enum { AHEAD_E = 1, AHEAD_J = 2, AHEAD_H = 4 }; /* bits of `what` */

/* Evaluates the strains of all elements at the nodes of s if the type has strain_many without
 * lanes. sigma[elements x strains]: needed for H. Values are valid until ahead_end. */
void ahead_strains(const equations *eq, const model_state *s, int what, const double sigma[]);
/* Evaluates sigma and C at e[elements x strains] with the histories of s; e NULL: at the strains of
 * the last evaluation. */
void ahead_stresses(const equations *eq, const model_state *s, const double e[],
                    const double inner[]);
void ahead_end(const equations *eq);

void ahead_copy_strain(const equations *eq, int i, const strain_output *out);
status ahead_copy_stress(const equations *eq, int i, const stress_output *out);

/* Return the values of element i at x or e, from the batch or from the functions of the type. Call
 * them between ahead_strains or ahead_stresses and ahead_end. */
static inline void ahead_strain(const equations *eq, int i, const node_state x[],
                                strain_output *out)
{
    if (eq->run->ahead != NULL && eq->run->ahead->what != 0)
        ahead_copy_strain(eq, i, out);
    else
        model_type(eq->m)->strain(model_kind_of(eq->m, i)->data, x, out);
}

static inline status ahead_stress(const equations *eq, int i, const element_data *data,
                                  const double e[], const double inner[], stress_output *out)
{
    if (eq->run->ahead != NULL && eq->run->ahead->stresses)
        return ahead_copy_stress(eq, i, out);
    return model_type(eq->m)->stress(data, e, inner, out);
}

status free_strain_begin(const model *, struct run_free **, fault *);
void free_strain_end(struct run_free *);

typedef struct bordered {
    double *Z;
    double S[TANGENT_BORDER * TANGENT_BORDER];
    int pivot[TANGENT_BORDER];
    /* [TANGENT_COMPONENTS x all] solutions for unit loads; the loads and the residuals of a
     * refinement */
    double *solution, *load, *rest;
    double *weight; /* [all] */
} bordered;

/* Allocates and factors the bordered system. SINGULAR: the structure is unsupported when the
 * prescribed motion is released. Call bordered_free also after a failure. */
status bordered_alloc(node_tangent *t, bordered *out, fault *f);
void bordered_free(bordered *s);

/* A chain of links, condensed to its two ends, and the expansion of solutions.
 *
 * A link connects joint p to joint q. The vector y contains the coordinates inside the link,
 * followed by those of q. Forces g on the link give y = A x_p + F g_y and g_p = B x_p - A^T g_y,
 * where A is the rigid motion of the link with p, F is its flexibility with p clamped, and B is the
 * stiffness of the rigid motion (prestress, warping). Two joined links form a link (star product of
 * R. Redheffer, J. Math. Phys. 41, 1962). With F of the links before joint m, and B and A of the
 * next link: x_m = Z (a_m + F (r_m + A^T g_y)), Z = (1 + F B)^-1, F <- F_qq + A_q Z F A_q^T. */

enum { CHAIN_JOINT = NODE_COORDINATES, CHAIN_LINK = (ELEMENT_MAX_NODES - 1) * CHAIN_JOINT };

typedef struct chain_link {
    double A[CHAIN_LINK * CHAIN_JOINT];  /* [y x joint] */
    double F[CHAIN_LINK * CHAIN_LINK];   /* [y x y] symmetric */
    double B[CHAIN_JOINT * CHAIN_JOINT]; /* symmetric */
    int negative;                        /* number of negative eigenvalues of F */
} chain_link;

typedef struct chain chain;

/* Allocates a chain. joint: number of coordinates of each joint. y: number of coordinates of a link
 * without its first joint. */
status chain_alloc(int links, int joint, int y, chain **out, fault *);
void chain_free(chain *);

void chain_begin(chain *);
/* Adds the next link. SINGULAR: the chain up to this link, clamped at its start, is in a critical
 * state. */
status chain_add(chain *, const chain_link *, fault *);
/* Computes K[2 joint x 2 joint] of the ends, after all links have been added. SINGULAR: the chain,
 * clamped at both ends, is in a critical state. */
status chain_stiffness(const chain *, double K[], fault *);
/* Returns the number of negative eigenvalues of the stiffness for the inner coordinates, with both
 * ends clamped. */
int chain_negative(const chain *);

/* Reduces loads to the ends. r[links x y]: loads on all coordinates except those of the ends, in
 * the order of the links (those of the last joint are not read). ends[2 joint]: resulting forces on
 * the ends. */
void chain_reduce(chain *, const double r[], double ends[]);
/* Computes x[links x y] for these loads and for the motions ends[2 joint] of the ends. The last
 * joint is an end. x may be r. */
void chain_expand(chain *, const double r[], const double ends[], double x[]);

/* Returns the size of a symmetric matrix of which only the lower triangle is stored. */
static inline int chain_packed(int n)
{
    return n * (n + 1) / 2;
}

/* Stored values: A and F of each link; Z, B Z and Z F of its junction with the previous links. */
struct chain {
    int links, count; /* `links`: number of links in all; `count`: number of links added so far */
    int c, y, inside; /* c, y: number of coordinates of a joint and of a link; inside = y - c */
    int negative;
    double *kept;
    /* [(links + 1) x c] displacements of the joints without the forces of later links; chain_expand
     * overwrites them with forces */
    double *a;
    double F[CHAIN_JOINT * CHAIN_JOINT]; /* flexibility of the links that have been joined so far */
    double A[CHAIN_JOINT * CHAIN_JOINT], B[CHAIN_JOINT * CHAIN_JOINT];
};

typedef struct kept_link {
    double *A, *Z;         /* [y x c], [c x c] */
    double *own, *BZ, *ZF; /* packed: F of the link [y x y], B Z and Z F [c x c] */
} kept_link;

static inline int chain_kept_size(int c, int y)
{
    return y * c + c * c + chain_packed(y) + 2 * chain_packed(c);
}

static inline kept_link chain_kept(const chain *s, int link, int c, int y)
{
    kept_link k;
    k.A = s->kept + (size_t)link * (size_t)chain_kept_size(c, y);
    k.Z = k.A + y * c;
    k.own = k.Z + c * c;
    k.BZ = k.own + chain_packed(y);
    k.ZF = k.BZ + chain_packed(c);
    return k;
}

/* Internals of a condensation. */

/* Structures with more end coordinates are not condensed, because the pattern is built as a dense
 * matrix. */
enum { MOST_ENDS = 2000, MEMBER_COLUMNS = 2 * NODE_COORDINATES + 2 * SCENE_RELEASED };

/* Pieces of a member: equal numbers of successive elements, whose coordinates between the ends are
 * eliminated. The coordinates of a piece are the motion of its first node (the start), and the
 * motions of its other nodes relative to the rigid motion of the piece with the start. Entries of
 * the size of an element stiffness therefore cancel only within a piece. Successive pieces form a
 * group, with one piece in each lane. */
enum {
    PIECE_LANES = 4,
    PIECE_ELEMENTS = 32,
    PIECE_MARGIN = 3, /* unused entries at the end of a row of `front` */
    PIECE_MOST_WIDTH = ELEMENT_MAX_COORDINATES + CHAIN_JOINT + PIECE_MARGIN
};

typedef struct piece_form {
    int joint, nodes, strains; /* joint: number of leading coordinates of a node that are used */
} piece_form;

/* An element of each piece of a group. */
typedef struct piece_element {
    int first; /* 1: it is the first element of its piece */
    /* tangent J^T C J + H in the coordinates of its nodes (element.h): [strains x 7 nodes],
     * [strains x strains], [7 nodes x 7 nodes] */
    const double *J[PIECE_LANES], *C[PIECE_LANES], *H[PIECE_LANES];
    const double *arm; /* [nodes x 3 x lanes] vectors from the start to the nodes [m] */
} piece_element;

/* Returns the number of rows of `front`: the nodes of an element, then the start. */
static inline int piece_rows(const piece_form *p)
{
    return p->joint * (p->nodes + 1);
}

/* Returns the number of stored values of an eliminated node. */
static inline int piece_kept(const piece_form *p)
{
    return p->joint * piece_rows(p) - p->joint * (p->joint - 1) / 2;
}

/* Adds the element to front[rows x (rows + margin) x lanes], of which the lower triangle is used.
 * work[2 x (strains + rows) x (rows + margin) x lanes]. */
void triangular_pieces_add_plain(const piece_form *, const piece_element *, double work[],
                                 double front[]);
void triangular_pieces_add_avx2(const piece_form *, const piece_element *, double work[],
                                double front[]);
/* Eliminates the first node of `front` into kept[piece_kept x lanes], counts negative pivots in
 * negative[lanes], and moves the next node to its place. kept NULL: the node is the start, which
 * has no relative motion. Returns 0 if a pivot is zero or not finite. */
int triangular_pieces_next_plain(const piece_form *, double front[], double kept[], int negative[]);
int triangular_pieces_next_avx2(const piece_form *, double front[], double kept[], int negative[]);
/* Reduces the loads r[blocks x joint x lanes] on the eliminated nodes to loads on the two ends of a
 * piece: ends[2 x joint x lanes]. `expand` computes the motions from r of `reduce` and the motions
 * of the ends. arm[(blocks + 2) x 3 x lanes]: see piece_group. */
void triangular_pieces_reduce_plain(const piece_form *, int blocks, const double kept[],
                                    const double arm[], double r[], double ends[]);
void triangular_pieces_reduce_avx2(const piece_form *, int blocks, const double kept[],
                                   const double arm[], double r[], double ends[]);
void triangular_pieces_expand_plain(const piece_form *, int blocks, const double kept[],
                                    const double arm[], const double ends[], double r[]);
void triangular_pieces_expand_avx2(const piece_form *, int blocks, const double kept[],
                                   const double arm[], const double ends[], double r[]);

typedef struct piece_group {
    int first, pieces, elements; /* first element, number of pieces, and elements of each */
    int link;                    /* index of the first piece among those of the member */
    int blocks;                  /* number of eliminated nodes of a piece */
    double *kept;                /* [blocks x piece_kept x lanes] */
    double *arm;                 /* [(blocks + 2) x 3 x lanes] */
} piece_group;

typedef struct condensed_member {
    /* element from the first node of the first element to the last node of the last element */
    mesh_element ends;
    mesh_triad triad[2];
    int first, elements, groups, links; /* links: number of pieces */
    piece_form form;
    piece_group *group;
    chain *chain;
    double *r; /* [links x joint] loads on the ends of pieces, then their motions */
} condensed_member;

status pieces_alloc(condensed_member *, fault *);
void pieces_free(condensed_member *);
/* Builds the chain of the pieces. force[14]: internal forces at the ends of the member in the
 * state.
 */
status pieces_fill(const equations *, const model_state *, condensed_member *, double path,
                   double force[], fault *);
/* Reduces loads x on the coordinates of the member to loads ends[2 x joint] on its ends.
 * pieces_expand computes the motions from those of the ends. */
void pieces_reduce(const model *, condensed_member *, double x[], double ends[]);
void pieces_expand(const model *, condensed_member *, const double ends[], double x[]);
/* Adds the numbers of entries and operations of the factors of the pieces. */

struct condensation {
    const equations *eq;
    const model *m;
    const model_state *at;
    int members, all, unknowns;
    int lent; /* 1: another condensation owns the pieces of the members */
    condensed_member *member;
    int *number;   /* [all] index among the end coordinates; NONE: not an end coordinate */
    int *unknown;  /* [unknowns] coordinates of the reduced system */
    sparse K;      /* matrix on all end coordinates */
    sparse inside; /* matrix of the unknowns */
    int *from;     /* [entries of inside] positions in K */
    matrix_factor *factor;
    double *small;  /* [unknowns] */
    double *driven; /* [driven] */
    double *end;    /* [members x MEMBER_COLUMNS] forces on the ends */
    int negative;   /* number of negative eigenvalues of the condensed coordinates */
    long factorisations;
};

/* Springs about the undeformed state, like linear_stresses for elements. sigma[6 x springs] is the
 * last part of the stresses. */

void linear_springs_stiffness(const model *, sparse *K); /* adds to K */
void linear_springs_stresses(const model *, const double x[], double sigma[]);
void linear_springs_forces(const model *, const double sigma[], double f[]); /* adds to f */
/* Adds the forces of springs on a node's frame to F[6]. */
void linear_springs_node_force(const model *, const double sigma[], int node, double F[6]);
void linear_springs_geometric_stiffness(const model *, const double sigma[],
                                        sparse *G); /* adds to G */
double linear_springs_energy2(const model *, const double x[]);
double linear_springs_rounding(const model *, const double x[]);
double linear_springs_geometric_energy2(const model *, const double sigma[], const double x[]);

/* Returns 1 if released ends or constraints make the undeformed structure with its supports a
 * mechanism. Sets *node to the node with the largest motion. If no node moves, sets *node to -1 and
 * *member to a moving member. motion: displacement [m] and rotation [rad], with an arbitrary
 * factor. Returns 0 without a check if there are more than 200 parts, or if out of memory. */
int linkage_mechanism(const model *, int *node, int *member, double motion[6]);

enum { SYMMETRIC_MOST = CHAIN_LINK };

/* Computes inverse[n x n]. Returns the number of negative eigenvalues, or -1 if A is singular. */
int symmetric_inverse(int n, const double A[], double inverse[]);

/* Derivatives of an element: de/dx [strains x 7 nodes] and dsigma/de [strains x strains].
 * `initial`: first-order stresses [strains] due to initial strains in the element with fixed nodes;
 * NULL: the member has no initial strains. */
typedef struct undeformed_element {
    const double *J, *C, *initial;
} undeformed_element;

/* Returns the derivatives of an element. FAULT: out of memory. Other statuses are those of the
 * element. */
status undeformed_of(const equations *, int element, undeformed_element *, fault *);
/* Before the first undeformed_of of a run, evaluates all elements together if the formulation can.
 * Values are valid until ahead_end. */
void undeformed_begin(const equations *);

#endif
