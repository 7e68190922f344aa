/* Geometry at one point of a line whose section turns: quaternions of the nodes are interpolated as
 * vectors of R^4, Q = sum N_k q_k, and normalised.  Turning all q_k turns Q with them, so that what
 * is measured in the section's axes is objective (ours).  No function of an angle is needed, and
 * every derivative is rational in Q.
 *
 *   kappa = 2 Im(Q^-1 Q'),  v = R(Q)^T y.
 *
 * Derivatives are given with respect to the 4-vectors Q, Q' and to y; turning node k by the spatial
 * increment theta makes q_k -> exp(theta/2) q_k: first derivative 1/2 theta q_k, second -1/4
 * |theta|^2 q_k.  The caller chooses the unit of length. */
#ifndef BEAMWORK_EXACT_POINT_H
#define BEAMWORK_EXACT_POINT_H

typedef struct exact_point {
    double m, u[4];  /* Q = m u, |u| = 1 */
    double eta;      /* m'/m */
    double R[9];     /* axes of the section, columns */
    double kappa[3]; /* twist rate and curvatures in the section's axes */
    double v[3];     /* y in the section's axes */
} exact_point;

/* Signs of q[1..] are changed so that neighbours are on the same side. */
void exact_point_align(int nodes, double q[][4]);

/* q [nodes x 4], N and dN [nodes]. */
void exact_point_at(int nodes, const double q[], const double N[], const double dN[],
                    const double y[3], exact_point *p);

/* Gradient of n . kappa + f . v with respect to Q and Q'.  That with respect to y is R f. */
void exact_point_gradient(const exact_point *p, const double n[3], const double f[3], double Q[4],
                          double S[4]);

/* Its second derivatives: QQ symmetric, QS [Q x Q'], QY [Q x y]; those with respect to Q' and Q',
 * Q' and y, y and y vanish. */
void exact_point_hessian(const exact_point *p, const double n[3], const double f[3], double QQ[16],
                         double QS[16], double QY[12]);

/* theta q as a matrix [4 x 3] on theta. */
void exact_point_increment(const double q[4], double P[12]);

#endif
