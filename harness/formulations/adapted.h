/* Data of an element whose interface an adapter completes: the data of the adapter, followed by the
 * data of the type. */
#ifndef BEAMWORK_ADAPTED_H
#define BEAMWORK_ADAPTED_H

#include <stddef.h>

#include "elements/element.h"
#include "elements/field/field.h"

struct element_data {
    const element_type *given;
    int nodes, strains; /* numbers of nodes and strains of the completed type */
    int history;
    int scalars;
    double length;
    double place[ELEMENT_MAX_NODES]; /* positions of the nodes, from 0 to 1 */
    field_mass mass;
    max_align_t own[]; /* element_data of the type */
};

static inline int adapted_coordinates(const element_data *d)
{
    return d->nodes * (NODE_COORDINATES + d->scalars);
}

static inline const element_data *adapted_own(const element_data *d)
{
    return (const element_data *)d->own;
}

/* Copies the pointers to the data of the given type for one call of it. Returns their number, which
 * is at most ADAPTED_TOGETHER. */
enum { ADAPTED_TOGETHER = 1024 };
static inline int adapted_owns(int count, const element_data *const data[],
                               const element_data *own[ADAPTED_TOGETHER])
{
    const int part = count < ADAPTED_TOGETHER ? count : ADAPTED_TOGETHER;
    for (int i = 0; i < part; i++)
        own[i] = adapted_own(data[i]);
    return part;
}

/* Computes the requested strains e, Jacobian J and second derivatives H with the functions of the
 * given type. J and H that it does not compute are obtained by finite differences (differences.c).
 * They are NaN if the type requires a history and the history is NULL. */
void differences_strain(const element_data *d, const node_state x[], strain_output *out);
/* Like differences_strain, for many elements. The perturbed states are passed to strain_many in
 * groups. Requires strain_many. */
void differences_strain_many(int count, const element_data *const data[], const node_state x[],
                             strain_output out[]);
/* Computes the second derivatives H of the strains by finite differences of the Jacobian.
 * jacobian(d, x, J) fills J [strains x coordinates]. */
typedef void differences_jacobian(const element_data *d, const node_state x[],
                                  const double *history, double J[]);
void differences_curvature(const element_data *d, const node_state x[], differences_jacobian *,
                           const double s[], double H[]);

/* Like relative_stress, for many elements. The perturbed states are passed to force_many in groups.
 * Requires force_many. */
void relative_stress_many(int count, const element_data *const data[], const double *const e[],
                          const double *const inner[], stress_output out[], status outcome[]);
status relative_stress(const element_data *d, const double e[], const double inner[],
                       stress_output *out);
/* Computes the derivative of C in the undeformed state, in the direction of the strains that belong
 * to the prestress sigma, by finite differences. G is NaN if the element cannot be evaluated. */
void relative_geometric(const element_data *d, const double sigma[], double G[]);

/* Strains and stresses of a type that computes forces with a history (absolute.c). The strains are
 * the motions of the nodes: for each node the displacement u, 2 l (q - q0), and l^2 a [m], where q
 * is the quaternion of the rotation of the node, and q0 its initial value. */
enum { ABSOLUTE_NODE = 8, ABSOLUTE_KEPT = 11, ABSOLUTE_NODES = 7 };
enum { ABSOLUTE_MOST = ABSOLUTE_NODE * ABSOLUTE_NODES };
_Static_assert((int)ABSOLUTE_MOST <= (int)ELEMENT_MAX_STRAINS, "too many strains");
int absolute_is(const element_type *given, const double options[]);
/* Returns the function for the number of strains of an element with this number of nodes. */
int (*absolute_strains(int nodes))(const double options[]);
void absolute_strain(const element_data *d, const node_state x[], strain_output *out);
status absolute_stress(const element_data *d, const double e[], const double inner[],
                       stress_output *out);
/* Like absolute_stress, for many elements. Requires force_many. */
void absolute_stress_many(int count, const element_data *const data[], const double *const e[],
                          const double *const inner[], stress_output out[], status outcome[]);
/* The history of the completed type starts with the values of the given type. For each node, it
 * then contains the initial position (3), q0 (4), and q in the last accepted state (4), which
 * determines the sign of q. */
void absolute_begin(const element_data *d, const node_state x[], double history[]);
void absolute_commit(const element_data *d, const node_state x[], double history[]);

#endif
