/* Displacements between the nodes of an element, for what acts along it: the field that is exact
 * for the uniform straight beam, with the shear and the non-uniform torsion that its section and
 * its physics have.
 *
 * Two nodes: written as the nodes' values between p and q plus functionals of the deformation modes
 * e of J Eq. 7 (beamw/modes.h), along the mean m_k of the nodes' unit vectors n_k,
 *   r = lin(r) + m_y (nu_y . e) + m_z (nu_z . e),
 *   n_x = lin(n_x) + m_y (chi_z . e) - m_z (chi_y . e), and so on.
 * e belongs to the straight element: at rest it is the shape of a curved one.  The functionals are
 * those of J section 3.2 with the exact twist (beamw/fields.h): any load on such a field has the
 * right work on the nodes of an element that is exact without it, as the field contains every
 * solution without loads.
 * Three nodes: Lagrange's polynomials of r and n_k, and in r what the turns are beyond linear,
 *   (l/3) x (1-x)(1-2x) (n_x^1 - 2 n_x^2 + n_x^3). */
#ifndef BEAMWORK_FIELD_FIELD_H
#define BEAMWORK_FIELD_FIELD_H

#include "elements/beamw/fields.h"
#include "elements/element.h"

enum { FIELD_NU_Y, FIELD_NU_Z, FIELD_CHI_X, FIELD_CHI_Y, FIELD_CHI_Z, FIELD_FUNCTIONALS };
enum { FIELD_MODES = 8 };

/* At a point x in [0, 1], or integrated over points. */
typedef struct field_rows {
    double part[ELEMENT_MAX_NODES]; /* of the nodes' r and n_k */
    double lean[ELEMENT_MAX_NODES]; /* three nodes: of n_x in r [m] */
    double functional[FIELD_FUNCTIONALS][FIELD_MODES];
} field_rows;

/* Data of a kind of element. */
typedef struct displacement_field {
    int nodes;
    double l0, ys, zs; /* [m] */
    int warps;         /* 0: uniform torsion, e7 and e8 follow e2 */
    beamw_stiffness_fields linear;
    beamw_twist twist;
    field_rows whole; /* integrated over [0, 1] */
} displacement_field;

/* nodes: of an element. Sections whose constants describe no beam of their own (by matrices) have
 * the field of those constants. */
void field_prepare(const element_request *, int nodes, displacement_field *);
void field_at(const displacement_field *, double x, field_rows *);
/* psi . e: the warping amplitude [1/m], of two nodes. */
void field_warping_at(const displacement_field *, double x, double psi[FIELD_MODES]);
/* Its shear flexibility is that of the physics that counts. */
section field_section(const element_request *);
/* out += size times what is there. */
void field_gather(double size, const field_rows *at, field_rows *out);

enum { FIELD_MOST_POINTS = BEAMW_TWIST_MAX_POINTS };
/* Points and weights that integrate the functionals times polynomials over [from, to] in [0, 1];
 * returns how many. */
int field_points(const displacement_field *, double from, double to, double x[FIELD_MOST_POINTS],
                 double weight[FIELD_MOST_POINTS]);

/* Loads at one point. */
typedef struct field_load {
    double force[3], moment[3]; /* [N, N m] in fixed axes; follower: in those of the section */
    double arm[3]; /* from the line to where the force acts, in the axes of the section [m] */
    int follower;
} field_load;

/* forces[7 nodes] += what the loads do on the coordinates of the nodes, K[7 nodes x 7 nodes] -= its
 * derivative in the exponential chart (NULL: not needed): symmetric for forces in fixed axes, which
 * have a potential.  rows[count]: where each of them acts; what acts on the line without an arm may
 * be integrated. */
void field_add_loads(const displacement_field *, const node_state x[], int count,
                     const field_rows rows[], const field_load load[], double forces[], double K[]);

/* Mass along an element on the displacement field.  Two nodes: the consistent mass of the
 * field; its frequencies converge with order 4 in slender bending, and with what is inside of the
 * element (below) with order 4 in any motion of a straight one.  Three nodes: lumped by Simpson's
 * rule, of order 4. */

typedef struct field_mass {
    int nodes;
    beamw_spread spread; /* two nodes */
    lumped_mass lumped;  /* three nodes: of the whole element */
} field_mass;

/* Order of frequencies without prestress, for two nodes and a stiffness that is exact without
 * loads; slender bending has the highest. */
#define FIELD_MASS_ORDER ((element_order){4, 8})

/* nodes: of an element. */
void field_mass_prepare(const element_request *, int nodes, field_mass *);
status field_mass_inertia(const field_mass *, const node_state x[], const element_rotating_frame *,
                          inertia_output *);

enum { FIELD_INNER = 2 * NODE_COORDINATES };

/* Effect of the mass of a straight element of two nodes that does not move as the field does: a
 * motion v of the nodes [14, in the axes of the element] of the eigenvalue lambda = omega^2 obeys
 *   v . K v = lambda v . M v + lambda^2 v . B v + O(lambda^3),   B = M_bu^T K_bb^-1 M_bu,
 * b the displacements between fixed ends: B is the flexibility of the fixed element under the
 * inertia of its static field, twice the complementary energy
 *   min over r: int s . C s dx,   s = s_p v + s_r r,
 * of resultants s_p in equilibrium with that inertia and those s_r of forces at the ends, and of
 * bimoments, alone.  B [14 x 14, kg s^2 and with m for each rotation, likewise warping], symmetric
 * and positive; zero for sections by matrices that couple and where a stiffness is zero. */
void field_inner(const element_request *, const displacement_field *,
                 double B[FIELD_INNER * FIELD_INNER]);

#endif
