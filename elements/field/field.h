/* Displacements between the nodes of an element, for what acts along it: the field that is exact
 * for the uniform straight beam, with the shear and the non-uniform torsion that its section and
 * its physics have.
 *
 * Two nodes: written as the nodes' values between p and q plus functionals of the deformation modes
 * e of J Eq. 7 (beamw/modes.h), along the mean m_k of the nodes' unit vectors n_k,
 *   r = lin(r) + m_y (nu_y . e) + m_z (nu_z . e),
 *   n_x = lin(n_x) + m_y (chi_z . e) - m_z (chi_y . e), and so on.
 * e belongs to the straight element: at rest it is the shape of a curved one.  The functionals are
 * those of J section 3.2 with the exact twist (beamw/twist.h): any load on such a field has the
 * right work on the nodes of an element that is exact without it, as the field contains every
 * solution without loads.
 * Three nodes: Lagrange's polynomials of r and n_k, and in r what the turns are beyond linear,
 *   (l/3) x (1-x)(1-2x) (n_x^1 - 2 n_x^2 + n_x^3). */
#ifndef BEAMWORK_FIELD_H
#define BEAMWORK_FIELD_H

#include "elements/beamw/stiffness.h"
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
 * derivative in the exponential chart (NULL: not wanted): symmetric for forces in fixed axes, which
 * have a potential.  rows[count]: where each of them acts; what acts on the line without an arm may
 * be integrated. */
void field_add_loads(const displacement_field *, const node_state x[], int count,
                     const field_rows rows[], const field_load load[], double forces[], double K[]);

#endif
