/* Displacements between the nodes of an element, for loads and masses along the element. The field
 * is the exact displacement field of a uniform straight beam with loads only at its ends, including
 * the shear and the non-uniform torsion of its section if these physics are active.
 *
 * With two nodes, the field is the linear interpolation lin() between p and q plus functionals of
 * the deformation modes e of J Eq. 7 (beamw/modes.h) along m_k, the mean of the unit vectors n_k of
 * the nodes:
 *   r = lin(r) + m_y (nu_y . e) + m_z (nu_z . e),
 *   n_x = lin(n_x) + m_y (chi_z . e) - m_z (chi_y . e), and so on.
 * e refers to the straight element. The initial value of e describes the shape of a curved element.
 * The functionals are those of J section 3.2 with the exact twist (beamw/fields.h). With more
 * nodes, r and n_k are the polynomials through the n nodes at x_k. r then has an additional term,
 * whose derivative is the term of the highest degree in l n_x: (l/n) prod (x - x_j) sum_k
 * n_x^k/prod_(j != k) (x_k - x_j). */
#ifndef BEAMWORK_FIELD_FIELD_H
#define BEAMWORK_FIELD_FIELD_H

#include "elements/beamw/fields.h"
#include "elements/element.h"

enum { FIELD_NU_Y, FIELD_NU_Z, FIELD_CHI_X, FIELD_CHI_Y, FIELD_CHI_Z, FIELD_FUNCTIONALS };
enum { FIELD_MODES = 8 };

/* Weights and functionals at a point x in [0, 1], or the integrals of both. */
typedef struct field_rows {
    double part[ELEMENT_MAX_NODES]; /* weights of the vectors r and n_k of each node */
    double lean[ELEMENT_MAX_NODES]; /* more than two nodes: weights of n_x in r [m] */
    double functional[FIELD_FUNCTIONALS][FIELD_MODES];
} field_rows;

typedef struct displacement_field {
    int nodes;
    double place[ELEMENT_MAX_NODES]; /* positions of the nodes, from 0 to 1 */
    double l0, ys, zs;               /* [m] */
    int warps;                       /* 0 for uniform torsion, where e7 and e8 equal e2 */
    beamw_stiffness_fields linear;
    beamw_twist twist;
    field_rows whole; /* rows integrated over [0, 1] */
} displacement_field;

/* Prepares the field of an element with `nodes` nodes. For sections given by matrices, the field
 * uses the constants of these sections. */
void field_prepare(const element_request *, int nodes, displacement_field *);
void field_at(const displacement_field *, double x, field_rows *);
/* Computes psi [1/m], where psi . e is the warping amplitude, for two nodes. */
void field_warping_at(const displacement_field *, double x, double psi[FIELD_MODES]);
/* Returns the section of the request with the shear flexibility of the active physics. */
section field_section(const element_request *);
/* Adds the rows at a point, multiplied by `size`, to `out`. */
void field_gather(double size, const field_rows *at, field_rows *out);

enum { FIELD_MOST_POINTS = BEAMW_TWIST_MAX_POINTS };
/* Computes points and weights that integrate the functionals times polynomials over [from, to] in
 * [0, 1]. Returns the number of points. */
int field_points(const displacement_field *, double from, double to, double x[FIELD_MOST_POINTS],
                 double weight[FIELD_MOST_POINTS]);

/* Load at one point. */
typedef struct field_load {
    double force[3], moment[3]; /* force and moment [N, N m] in global axes, or in axes of the
                                   section if they follow it */
    double
        arm[3]; /* vector from the line to the point of application, in axes of the section [m] */
    int follower;
} field_load;

/* Adds the generalised forces of the loads on the coordinates of the nodes to forces[7 nodes].
 * Subtracts the derivative of these forces in the exponential chart from K[7 nodes x 7 nodes],
 * which may be NULL. The derivative is symmetric for forces in global axes, which have a potential.
 * rows[count] are those of the points where the loads act; for loads on the line without an arm,
 * they may be integrals. */
void field_add_loads(const displacement_field *, const node_state x[], int count,
                     const field_rows rows[], const field_load load[], double forces[], double K[]);

/* Mass of an element that moves with the displacement field. Two-node elements have the consistent
 * mass of the field. Elements with more nodes have lumped mass (lumped_shares), with order 4 or
 * more. */

typedef struct field_mass {
    int nodes;
    beamw_spread spread; /* two nodes */
    lumped_mass lumped;  /* more nodes: lumped mass of the whole element */
    double share[ELEMENT_MAX_NODES];
} field_mass;

/* Orders of convergence of frequencies without prestress, for two-node elements whose stiffness is
 * exact if loads act only at the nodes. */
#define FIELD_MASS_ORDER ((element_order){4, 8})

void field_mass_prepare(const element_request *, int nodes, field_mass *);
status field_mass_inertia(const field_mass *, const node_state x[], const element_rotating_frame *,
                          inertia_output *);

enum { FIELD_INNER = 2 * NODE_COORDINATES };

/* Computes B, which represents the motion of a straight two-node element relative to the field. A
 * mode v of the nodes [14, in the axes of the element] with the eigenvalue lambda = omega^2 obeys
 *   v . K v = lambda v . M v + lambda^2 v . B v + O(lambda^3), B = M_bu^T K_bb^-1 M_bu,
 * where b are the displacements between fixed ends and u those of the nodes. B is the flexibility
 * of the element with fixed ends under the inertia forces of the static field. The matrix B gives
 * twice the complementary energy
 *   min over r: int s . C s dx, s = s_p v + s_r r,
 * where the resultants s_p are in equilibrium with these inertia forces, and s_r are due only to
 * forces and bimoments at the ends. B [14 x 14] is symmetric and positive semidefinite. The unit of
 * an entry is kg s^2, multiplied by m once if its row and once if its column is a rotation. B is
 * zero for more than two nodes, for matrices with off-diagonal entries, if EA, EIy, EIz or GIt is
 * zero, and if the equations for s_r are singular.
 */
void field_inner(const element_request *, const displacement_field *,
                 double B[FIELD_INNER * FIELD_INNER]);

#endif
