/* A scene meshed with one formulation.
 *
 * Coordinates.  Every vertex of the mesh has a frame (position r, orientation q)
 * and every element end a warping amplitude.  Scalars that can change are the
 * model's coordinates, in this order:
 *   [0, free)                          unknowns
 *   [free, free + driven)              prescribed along the path by drivers
 * What is held or depends on other coordinates (rigid offsets, rotation
 * sequences, shared angles) has no coordinate: it was left out.  An unknown
 * driver is a driven coordinate whose increment is found with the free ones; the coordinate its
 * condition names is free.
 *
 * Increments of coordinates are additive for translations, warping and angles,
 * and spatial rotation increments (exponential chart) for free rotations.
 * All second derivatives (offsets, sequences) are included in the tangent. */
#ifndef BEAMWORK_MODEL_H
#define BEAMWORK_MODEL_H

#include "cases/scene/scene.h"
#include "elements/element.h"
#include "harness/algebra/phases.h"
#include "harness/algebra/sparse.h"

typedef struct model model;

typedef struct model_request {
    const scene *scene;
    const element_type *type;
    const double *options; /* of the formulation; NULL: defaults */
    int elements;          /* per member */
    int keep_all;          /* 1: leave nothing out (same answer, more work) */
} model_request;

/* REFUSED (with the reason) when the formulation does not offer what the scene needs: see
 * model_missing. */
status model_alloc(const model_request *, model **, fault *);
void model_free(model *);

/* Feature bits the scene needs and those of them the type does not offer, or a limit it hits, in
 * words; 0: it can run. */
unsigned model_needs(const scene *);
/* The same with the theory of shear in stability that the type has instead of the one the scene
 * asks for: FEATURE_* bits. */
unsigned model_needs_of(const scene *, const element_type *);
/* The theory of shear that values of the type on this scene follow: a bit of shear_theory; 0:
 * nothing is flexible in shear. */
unsigned model_theory(const scene *, const element_type *);
/* Those of them that one quantity depends on: inertia only where it is a frequency or of a rotating
 * structure. */
unsigned model_quantity_needs(const scene *, int quantity);
int model_missing(const scene *, const element_type *, char *words,
                  int size); /* words are empty if and only if it is 0 */
/* What the type offers in one direction only (element_lack) where the scene needs it, in words: 0:
 * nothing, 1: so little of it that it is shown and not refused, 2: model_missing says so too. */
int model_lacks(const scene *, const element_type *, char *words, int size);
/* Comma-free words of a feature, for results: "warping", "shear", ... */
const char *model_feature_name(unsigned bit);

typedef struct model_size {
    int elements, vertices, free, driven, strains, inner; /* per element for the last two */
    unsigned features;
} model_size;
model_size model_sizes(const model *);
int model_kinds(
    const model *); /* elements that differ in section, length, initial curvature or strain */
/* The same with one element per member. */
status model_coarse(const model *, model **, fault *);
/* 1: the supports leave a part of the undeformed structure loose: a node of it, and a rigid motion
 * (displacement of that node [m], turn [rad], of any size) that they allow. Coordinates that are
 * driven are held. */
int model_loose_part(const model *, int *node, double motion[6]);
double
model_length(const model *); /* longest member [m]: displacements are small or large beside it */

/* What was left out, one line each ("warping coordinates of 12 ends: nothing warps there"). */
int model_left_out(const model *, const char *const **lines);

/* Work done so far; the solver adds its own. */
typedef struct counters {
    long strain_evaluations, stress_evaluations, inertia_evaluations;
    long iterations, steps, rejected_steps, factorisations, solutions;
    long factor_entries;
    double factor_flops;
    long negative_pivots; /* most of a symmetric tangent at a state that was reached */
    double condition;     /* largest estimate of the solved systems (factor_condition), where it was
                             asked for; else 0 */
} counters;
counters *model_counters(model *);
phases *model_phases(model *);

/* Everything that changes along a path. A copy undoes a rejected step. */
typedef struct model_state model_state;
status model_state_alloc(const model *, model_state **, fault *); /* undeformed, path = 0 */
void model_state_free(model_state *);
const model_state *model_rest(const model *); /* undeformed */
void model_state_copy(const model *, const model_state *from, model_state *to);
double model_state_path(const model_state *);
/* First guess of the state at `path` from the last `count` ones (two: a line, three: a parabola),
 * oldest first. 0: there is none, because what is prescribed bends, or the step is too long; `out`
 * is untouched then. */
enum { MODEL_EXTRAPOLATED = 3 };
int model_state_extrapolate(const model *, int count, const model_state *const at[], double path,
                            model_state *out);

/* Frame of a scene node in a state. */
void model_frame(const model *, const model_state *, int node, double r[3], double q[4]);
/* Displacement [m] or rotation-vector component [rad] of a scene node since the undeformed
 * state. */
double model_component(const model *, const model_state *, int node, int component);
double model_driver_value(const model *, const model_state *, int driver);

/* Continuation: derivative of the loads by the path parameter in a state, out[free + driven];
 * weights [free + driven] of the square of an increment, (displacement/size)^2 + rotation^2 in the
 * mean over the bodies; the same distance between two states; and the largest angle [rad] between
 * the orientations of a node in two states. */
void model_load_rate(const model *, const model_state *, double path, double out[]);
void model_metric(const model *, double weight[]);
double model_distance(const model *, const model_state *, const model_state *);
double model_turn_between(const model *, const model_state *, const model_state *);

/* Threads that share the loop over elements; one until this is called. Sums keep their order:
 * results do not depend on it. */
status model_set_threads(model *, int threads, fault *);

unsigned model_limits(const model *); /* LIMIT_* of its formulation */
/* Largest angle [rad] that an element's nodes have turned against each other, or against its chord,
 * and that element. */
double model_largest_turn(const model *, const model_state *, int *element_index);

/* Coordinate index of a component of a node, or -1 where it is held, or dependent. */
int model_coordinate(const model *, int node, int component);
/* Jacobian of the node's six spatial increments with respect to the coordinates it depends on:
 * returns the count m <= size, fills index[m] and T[6 x m] (row-major, leading dimension m). */
int model_node_jacobian(const model *, const model_state *, int node, int size, int index[],
                        double T[]);

/* Patterns. `with_driven` 0: free x free; 1: all coordinates. Made at the first call and owned by
 * the model; matrices on it come from sparse_alloc_like. Symmetric unless the formulation's or the
 * loads' tangent is not. */
status model_pattern(model *, int with_driven, const sparse **out, fault *f);

/* Increments of the driven coordinates (dx[free .. free+driven)) that take the state to `path`; the
 * rest of dx untouched. */
void model_drive(const model *, const model_state *, double path, double dx[]);

/* An unknown driver: the driven coordinate `unknown` moves by what makes the free one `coordinate`
 * move by `increment`. The force on that coordinate stays free of reactions, the one on the driver
 * is whatever it takes. */
enum { MODEL_MAX_CONDITIONS = 4 };
typedef struct model_condition {
    int unknown, coordinate;
    double increment;
} model_condition;
int model_conditions(const model *, const model_state *, double path,
                     model_condition out[MODEL_MAX_CONDITIONS]);

/* Internal less external force of every coordinate is what equilibrium makes zero on the free ones.
 * Mixed linearisation (simultaneous in coordinates, strains and stresses; N section 4), condensed
 * per element:
 *   K dx = f(path) - J^T [P'(e) + P''(e) (D(x) - e)],  K = J^T P'' J + sum sigma_i H_i
 * The driven part of dx is known: its share is taken to the right-hand side here. */
typedef struct model_linearisation {
    double path;
    int displacement;    /* 1: displacement-only Newton: e and sigma are taken from D(x) first */
    const double *drive; /* [free + driven] increments; only the driven part is read; NULL: none */
    int conditions;      /* columns of K wanted for the unknowns of conditions ... */
    const model_condition *condition;
    double *column; /* ... [conditions x (free + driven)] */
    sparse *K;      /* on a pattern of model_pattern; NULL: not wanted */
    double
        *residual; /* [free + driven] right-hand side; of driven coordinates: less their reaction */
    double incompatibility; /* out: max |D(x) - e|/l over elements */
} model_linearisation;
status model_linearise(model *, const model_state *, model_linearisation *, fault *);
/* K x of the last linearisation in two parts. The stiff one goes through the element strains, y +=
 * sum J^T P'' (J x): as a sum of matrices it would lose all digits of the soft motions. x, y: [free
 * + driven]. The other is a matrix on the pattern of G: sum sigma_i H_i with the second derivatives
 * of offsets and sequences, less the loads' and the rotation's stiffness. */
void model_stiff_part(const model *, const model_state *, const double x[], double y[]);
status model_soft_part(model *, const model_state *, sparse *G, fault *);
/* After K dx = residual: strains, stresses, inner unknowns of every element and then the frames
 * take their increments. dx[free + driven]. Returns the largest correction, dimensionless:
 * translations by the size of the scene, rotations in rad, warping by the element length, inner
 * unknowns as the element says. */
double model_advance(model *, model_state *, const double dx[], double path);
/* The uncondensed dense system (column-major A[n x n], b[n] with n = model_full_size + conditions),
 * unknowns in the order free coordinates, strains, stresses, drivers of conditions; load[free +
 * driven] is work space. */
int model_full_size(const model *);
status model_full_system(model *, const model_state *, double path, const double drive[],
                         int conditions, const model_condition condition[], double A[], double b[],
                         double load[], fault *);
/* Forgets the independent strains and stresses: e = D(x), sigma = P'(e). */
status model_make_compatible(model *, model_state *, fault *);
/* Force and spatial moment that act from outside on a node's frame (loads and reactions) in the
 * state: F[6] [N, N m]. */
void model_node_force(model *, const model_state *, int node, double F[6]);
/* K of a node turned by a sequence of angles, when the moment M that the angles' prescription
 * exerts becomes a load that is conservative in the exponential chart: the angles' own second
 * derivatives no longer belong to it. */
void model_release_moment(const model *, const model_state *, int node, const double M[3],
                          sparse *K);
/* The loads' part of it at the state's path. */
void model_node_load(const model *, const model_state *, int node, double F[6]);

/* Linear analyses about the undeformed state. */
status model_linear_stiffness(model *, sparse *K, fault *); /* J^T S J at e = 0 */
status model_linear_stresses(model *, const double x[], double sigma[],
                             fault *); /* sigma = S J x, [elements x strains] */
void model_linear_forces(model *, const double sigma[],
                         double f[]); /* f[free + driven] = sum J^T sigma */
status model_geometric_stiffness(model *, const double sigma[], sparse *G,
                                 fault *); /* sum sigma H + J^T G(sigma) J; offsets included */
/* Quadratic forms from the element strains, free of the cancellation of x^T (K x): error eps n^2
 * instead of eps n^4. */
double model_strain_energy2(model *, const double x[]);  /* x^T K x = sum (Jx)^T S (Jx) */
double model_strain_rounding(model *, const double x[]); /* what rounding may change in it */
double model_geometric_energy2(model *, const double sigma[], const double x[]);
/* Size of what rounding changes in it, with sigma the stresses of the displacements load_x[free +
 * driven]. */
double model_geometric_rounding(model *, const double load_x[], const double sigma[],
                                const double x[]);
/* Loads at factor 1 as a vector on the free coordinates. */
status model_reference_load(model *, double f[], fault *);

/* Mass matrix on the pattern of M about a state (NULL: undeformed); G: gyroscopic matrix of a
 * turning frame, of which a symmetric pattern stores the upper triangle, or NULL: not wanted. */
status model_inertia(model *, const model_state *, double path, sparse *M, sparse *G, fault *);

/* From here on the scene's axes turn with omega [rad/s] about an axis through `centre` [m]; times
 * the path parameter if that is followed. Zero: they are at rest. What is linearised contains the
 * centrifugal forces and their stiffness. */
void model_set_spin(model *, const double omega[3], const double centre[3], int follows_path);
/* x^T K x of the tangent of a state in equilibrium, but for what loads add to it: from the strains,
 * as above. x[free + driven]. */
status model_tangent_energy2(model *, const model_state *, double path, const double x[],
                             double *energy);
/* What loads on offsets and moments add to K. */
void model_load_stiffness(const model *, const model_state *, double path, sparse *out);

/* Shape of a mode or state for identification and pictures: displacement (3), rotation (3) and
 * warping of every vertex in order along the members; returns vertices. u[vertices x 7],
 * position[vertices x 3] (undeformed). */
int model_shape(const model *, const double x[], double *u, double *position);
int model_member_vertices(const model *, int member,
                          int vertex[]); /* n + 1 in order; vertex NULL: count only */

/* Section constants the model uses for a section of the scene. */
const section *model_section(const model *, int index);

#endif
