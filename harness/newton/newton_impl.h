/* Internal declarations of newton/. */
#ifndef BEAMWORK_NEWTON_IMPL_H
#define BEAMWORK_NEWTON_IMPL_H

#include <stddef.h>

#include "elements/shared/status.h"
#include "harness/model/model.h"
#include "harness/newton/newton.h"

/* Strains and stresses of all elements are evaluated before the loop that uses them, for types that
 * evaluate all elements in one call (element_type.strain_many, stress_many, without lanes). For
 * other types, and when memory is short, every element is evaluated in the loop; those with lanes
 * in small batches (chunk.c). */

/* Strains and stresses evaluated for all elements in one call. */
typedef struct run_ahead {
    int what, stresses; /* which strains, and whether the stresses, are valid */
    const element_data **data;
    const double **at, **inner;
    node_state *x;
    strain_output *strain;
    stress_output *stress;
    status *outcome;
    double *e, *sigma, *J, *H, *C, *memory;
} run_ahead;

enum { AHEAD_E = 1, AHEAD_J = 2, AHEAD_H = 4 }; /* values of `what` */

/* Evaluates strains in batches at the nodes of s; sigma[elements x strains] for H. Valid until
 * ahead_end. */
void ahead_strains(const equations *eq, const model_state *s, int what, const double sigma[]);
/* At e[elements x strains], or NULL: at the strains evaluated before; sigma and C. */
void ahead_stresses(const equations *eq, const double e[], const double inner[]);
void ahead_end(const equations *eq);

void ahead_copy_strain(const equations *eq, int i, const strain_output *out);
status ahead_copy_stress(const equations *eq, int i, const stress_output *out);

/* Return the values of element i at x or e, in loops between ahead_strains or ahead_stresses and
 * ahead_end: from the batch, or from the functions of the type. */
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

/* For a run: see free_strain_data. */
status free_strain_begin(const model *, struct run_free **, fault *);
void free_strain_end(struct run_free *);

/* Solutions with the tangent bordered by released coordinates (tangent.c). */

/* Factors of the bordered system. */
typedef struct bordered {
    double *Z; /* [count x free] K^-1 U */
    double S[TANGENT_BORDER * TANGENT_BORDER];
    int pivot[TANGENT_BORDER];
    double *solution;                 /* [TANGENT_COMPONENTS x all] for unit loads */
    double *x, *load, *rest, *weight; /* [all] work space for refinement */
} bordered;

/* SINGULAR: the structure is not supported when the prescribed motion is released. Call
 * bordered_free in either case. */
status bordered_alloc(node_tangent *t, counters *n, bordered *out, fault *f);
void bordered_free(bordered *s);
/* In place; fixed and prescribed coordinates do not change. x: [columns x all] */
void bordered_solve(node_tangent *t, counters *n, const bordered *s, int columns, double x[]);
/* Iterative refinement of s->x for s->load, with residuals whose stiff part comes from the element
 * strains (refinement_judge). SINGULAR: round-off leaves insufficient accuracy. */
status bordered_refine(const equations *eq, node_tangent *t, const bordered *s, fault *f);

/* A chain of links, condensed to its two ends, and the expansion of solutions.
 *
 * A link joins joint p to joint q; y are the coordinates inside, followed by those of q. For forces
 * g on the link,
 *   y = A x_p + F g_y,   g_p = B x_p - A^T g_y:
 * where A is its rigid motion with p, F its flexibility with p clamped, and B the stiffness of that
 * motion (prestress, warping). Joined links form a link (the star product of R. Redheffer, J. Math.
 * Phys. 41, 1962): with F of the row before joint m and B, A of the next link
 *   x_m = Z (a_m + F (r_m + A^T g_y)),   Z = (1 + F B)^-1,   F <- F_qq + A_q Z F A_q^T.
 * Flexibilities add without cancellation. Rounding therefore grows about in proportion to the
 * number of links, and not to its fourth power as for assembled stiffnesses. */

enum { CHAIN_JOINT = 7, CHAIN_LINK = 2 * CHAIN_JOINT };

/* Data of an element that is added to a chain. */
typedef struct chain_link {
    double A[CHAIN_LINK * CHAIN_JOINT];  /* [y x joint] */
    double F[CHAIN_LINK * CHAIN_LINK];   /* [y x y] symmetric */
    double B[CHAIN_JOINT * CHAIN_JOINT]; /* symmetric */
    int negative;                        /* number of negative eigenvalues of F */
} chain_link;

typedef struct chain chain;

/* joint: number of coordinates of each joint; y: number of coordinates of a link without its first
 * joint. */
status chain_alloc(int links, int joint, int y, chain **out, fault *);
void chain_free(chain *);

void chain_begin(chain *);
/* Adds the next link. SINGULAR: the chain so far, clamped at its start, is in a critical state. */
status chain_add(chain *, const chain_link *, fault *);
/* K[2 joint x 2 joint] of the ends after all links have been added. SINGULAR: the chain, clamped at
 * both ends, is in a critical state. */
status chain_stiffness(const chain *, double K[], fault *);
/* Number of negative eigenvalues of the inner coordinates, with both ends clamped. */
int chain_negative(const chain *);

/* Loads r[links x y] on all coordinates except those of the ends (the last joint is not read), in
 * the order of the links; ends[2 joint]: resulting forces on the ends. */
void chain_reduce(chain *, const double r[], double ends[]);
/* x[links x y] for these loads and for motions of the ends[2 joint]; the last joint is an end. x
 * may be r. */
void chain_expand(chain *, const double r[], const double ends[], double x[]);

/* Members of a chain: chain.c builds the chain and solves with it. */

/* Size of a symmetric matrix whose rows are stored up to the diagonal. */
static inline int chain_packed(int n)
{
    return n * (n + 1) / 2;
}

/* For each link its A and F are stored, and for its junction with the previous row Z, B Z and Z F.
 */
struct chain {
    int links, count; /* count: number added so far */
    int c, y, inside; /* number of coordinates of a joint; of a link; inside = y - c */
    int negative;
    double *kept;
    double *a; /* [(links + 1) x c] displacements of joints without later forces; then the forces on
                  the joints */
    double F[CHAIN_JOINT * CHAIN_JOINT]; /* of the row so far */
    double A[CHAIN_JOINT * CHAIN_JOINT], B[CHAIN_JOINT * CHAIN_JOINT];
};

typedef struct kept_link {
    double *A, *Z;         /* [y x c], [c x c] */
    double *own, *BZ, *ZF; /* packed: F of the link, [y x y]; [c x c] */
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

/* Members of condensation. */

/* Structures with more coordinates of ends are not condensed, because the pattern is built densely.
 */
enum { MOST_ENDS = 2000, MEMBER_COLUMNS = 2 * NODE_COORDINATES + 2 * SCENE_RELEASED };

typedef struct condensed_member {
    mesh_element
        ends; /* element from the first node of the first element to the last node of the last */
    mesh_triad triad[2];
    int first, links, joint, y;
    chain *chain;
} condensed_member;

struct condensation {
    const equations *eq;
    const model *m;
    const model_state *at;
    int members, all, unknowns;
    int lent; /* 1: another condensation owns chains and r */
    condensed_member *member;
    int *number;   /* [all] index of a coordinate among those of ends; NONE: not of an end */
    int *unknown;  /* [unknowns] coordinates of the reduced system */
    sparse K;      /* matrix of the ends, on all their coordinates */
    sparse inside; /* matrix of the unknowns */
    int *from;     /* [entries of inside] positions in K */
    matrix_factor *factor;
    double *r;      /* of the longest member: loads, then displacements, [links x y] */
    double *small;  /* [unknowns] */
    double *driven; /* [driven] */
    double *end;    /* [members x MEMBER_COLUMNS] forces of the ends */
    int negative;   /* number of negative eigenvalues of the condensed coordinates */
    long factorisations;
};

/* condensation.c: numbers the coordinates of ends, and the unknown ones among them. Returns the
 * number of the former; s->unknown NULL: out of memory. */
int condensation_number(condensation *s, int count, const int released[]);
/* Patterns of both matrices. */
status condensation_patterns(condensation *s, int ends, fault *f);

/* Springs about the undeformed state, as linear_stresses for elements: sigma[6 x springs] are the
 * last of the stresses. */

void linear_springs_stiffness(const model *, sparse *K); /* += */
void linear_springs_stresses(const model *, const double x[], double sigma[]);
void linear_springs_forces(const model *, const double sigma[], double f[]); /* += */
/* F[6] += forces of springs on the frame of a node. */
void linear_springs_node_force(const model *, const double sigma[], int node, double F[6]);
void linear_springs_geometric_stiffness(const model *, const double sigma[], sparse *G); /* += */
double linear_springs_energy2(const model *, const double x[]);
double linear_springs_rounding(const model *, const double x[]);
double linear_springs_geometric_energy2(const model *, const double sigma[], const double x[]);

/* An element as a link of a chain. */

/* Tangent J^T C J + H of an element in the coordinates of its nodes (element.h). */
typedef struct link_element {
    int nodes, strains, joint; /* joint: number of leading coordinates of each node that are used */
    const double *J, *C, *H;   /* [strains x 7 nodes], [strains x strains], [7 nodes x 7 nodes] */
    const double *r;           /* [nodes x 3] positions of the nodes [m] */
} link_element;

/* The rigid motion R of the element causes strains E = J R, which are rounding errors except for
 * warping; the element follows by R + d, d = -F (J_y^T C E + (H R)_y), and B = (E + J_y d)^T C (E +
 * J_y d) + (R + d)^T H (R + d): no entries of the size of K are subtracted from each other.
 * SINGULAR: the element, clamped at its first node, is in a critical state. */
status link_of(const link_element *, chain_link *, fault *);

/* Members as rigid parts of a linkage with joints at released ends. */

/* Returns 1 when the undeformed structure with its supports is a mechanism because of released
 * ends: gives the node that moves most, or -1 and a member between nodes at rest, and its motion
 * (displacement [m], rotation [rad], arbitrary scale). Not searched for more than 200 parts. */
int linkage_mechanism(const model *, int *node, int *member, double motion[6]);

/* Small symmetric matrices whose rows may have different units. */

enum { SYMMETRIC_MOST = 14 };

/* Number of negative eigenvalues of A[n x n], which is overwritten; -1: singular, a pivot is a
 * rounding error. LDL^T without pivoting, which does not depend on the units of the rows. */
int symmetric_negative(int n, double A[]);
/* inverse[n x n]; returns the number of negative eigenvalues, or -1: singular. */
int symmetric_inverse(int n, const double A[], double inverse[]);

/* Derivatives of elements in the undeformed state, which never changes: evaluated once and stored.
 */

/* de/dx [strains x 7 nodes], dsigma/de [strains x strains] and, for a member with initial strains,
 * the stresses [strains] of an element with fixed nodes, to first order (NULL: none). Valid until
 * the next request. */
typedef struct undeformed_element {
    const double *J, *C, *initial;
} undeformed_element;

/* In large models consecutive elements of one kind with equal orientation, up to the rounding of
 * their positions, share one. FAULT: out of memory. */
status undeformed_of(const equations *, int element, undeformed_element *, fault *);
/* Evaluates missing elements together, if the formulation can; valid until ahead_end. */
void undeformed_begin(const equations *);

#endif
