/* Finite rotations: unit quaternions q = (w, x, y, z), rotation vectors and matrices.
 *
 * Matrices are row-major double[9]; the columns of a triad are its unit vectors. Rotation
 * increments are spatial: an increment phi changes R to exp(phi~) R and q to rotation_exp(phi) o q.
 * Every function is accurate to a few eps for every angle, including angles near 0 and pi. */
#ifndef BEAMWORK_MATH_ROTATION_H
#define BEAMWORK_MATH_ROTATION_H

void rotation_identity(double q[4]);
void rotation_exp(const double phi[3], double q[4]); /* phi in rad */
void rotation_log(const double q[4], double phi[3]); /* |phi| <= pi, the shorter rotation */
/* Computes ab = a o b; ab may alias a or b. */
static inline void rotation_compose(const double a[4], const double b[4], double ab[4])
{
    const double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    const double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    const double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    const double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
    ab[0] = w;
    ab[1] = x;
    ab[2] = y;
    ab[3] = z;
}
static inline void rotation_conjugate(const double q[4], double inverse[4])
{
    inverse[0] = q[0];
    for (int i = 1; i < 4; i++)
        inverse[i] = -q[i];
}
void rotation_normalise(double q[4]);
void rotation_matrix(const double q[4], double R[9]);
void rotation_from_matrix(const double R[9], double q[4]);
void rotation_apply(const double q[4], const double v[3], double Rv[3]); /* Rv may alias v */
/* Computes the spatial increment from `from` to `to`, log(to o conj(from)). */
void rotation_between(const double from[4], const double to[4], double phi[3]);
/* Computes the triad whose x axis is along `x` and whose y axis is along the component of `y`
 * normal to `x`. Returns 0, or -1 if x is zero or y is parallel to x. */
int rotation_triad(const double x[3], const double y[3], double R[9]);

/* Computes a point of an arc of unit length along which the triad rotates at a constant rate.
 * `rotation` [rad] is the torsion and curvature of the arc times its length. In the axes at the
 * start of the arc, q = exp(x rotation~) and r = int_0^x exp(t rotation~) e dt for 0 <= x <= 1. e
 * is the direction of the axis in the rotating triad, (1, 0, 0) if there are no initial strains. */
void arc_at(const double rotation[3], const double e[3], double x, double r[3], double q[4]);
/* Computes e from r = arc_at(rotation, e, 1), for |rotation| below a full turn. */
void arc_to(const double rotation[3], const double r[3], double e[3]);
/* Computes r of arc_at minus x e, the value of r without rotation. */
void arc_beyond(const double rotation[3], const double e[3], double x, double r[3]);

/* Rigid connection of a point to the body that moves the point. With the offset rho, dr = dr_b +
 * theta x rho. The second derivatives in the exponential chart are d2(F . rho)/dtheta2 = sym(F
 * rho^T) - (F . rho) I. */

/* Transforms force[6] (force, moment) from the point to the body. */
void offset_force(const double rho[3], double force[6]);
/* Replaces K[n x n] by A^T K A, where the coordinates of the point start at `at`. If `force`, the
 * gradient of the potential at the point, is not NULL, adds its second derivatives. */
void offset_matrix(int n, int at, const double rho[3], const double force[3], double K[]);

#endif
