/* A step of one element as a common turn, which is taken out of it exactly, and a motion relative
 * to that: nodes j move by dr_j and turn by the Cayley vectors c_j, R_1 = cay(c) R_n. With the mean
 * c, kappa = 1/sqrt(1 + c.c/4),  b = kappa^2/(4 (1 + kappa)),  S = kappa 1 + b c c^T,  T = 1 - b c
 * c^T, G half the common turn and D_j = r_j - mean r,
 *   r(s) = (1 - s) G D_n + s G^T D_1,   R(s) = exp(s phi) G R_n,   a(s) = a_n + s da,
 *   dr^_j = S (dD_j - c x Dm_j),   c^_j = T (c_j - c)/(kappa (1 + c.c_j/4)),   phi_j = psi_j c^_j:
 * zero for every rigid motion. What is fixed to the ground turns with nothing: c = 0, D_j = r_j. */
#ifndef BEAMWORK_CAYLEY_H
#define BEAMWORK_CAYLEY_H

#include "elements/element.h"

/* Cayley vector 2 tan(|t|/2) t/|t| of a rotation vector, and back. */
void cayley_of_vector(const double t[3], double c[3]);
void cayley_to_vector(const double c[3], double t[3]);
/* T_c = (1 + c~/2)/(1 + c.c/4): the spatial turn at the end is T_c dc. */
void cayley_tangent(const double c[3], double T[9]);
/* v~ */
void cayley_skew(const double v[3], double A[9]);

typedef struct cayley_step {
    int nodes;
    double share; /* of a node in the means: 1/nodes, on the ground 0 */
    double mean[3], kappa, b, S[9], T[9], G[9];
    double Dn[ELEMENT_MAX_NODES][3], D1[ELEMENT_MAX_NODES][3], Dm[ELEMENT_MAX_NODES][3];
    double dD[ELEMENT_MAX_NODES][3];
    double c[ELEMENT_MAX_NODES][3], relative[ELEMENT_MAX_NODES][3]; /* c_j; c^_j */
    double divisor[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], z[ELEMENT_MAX_NODES];
    double y[ELEMENT_MAX_COORDINATES]; /* dr^, phi, da */
    const node_state *from;
} cayley_step;

/* dr, c of the nodes [nodes x 3], da[nodes]; `from` stays where it is. */
void cayley_begin(int nodes, int ground, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *);

/* The relative motion at s in [0, 1]: r(s), R(s), a(s), and exp(s phi) of every node. */
typedef struct cayley_point {
    double at;
    double turn[ELEMENT_MAX_NODES][9];
    node_state x[ELEMENT_MAX_NODES];
} cayley_point;
void cayley_between(const cayley_step *, double at, cayley_point *);

/* Forces f on the relative motion, columns of f[7 nodes x columns], become those on dr, c, da:
 * F_j = S f_j, M_j = z_j T m_j - mean (z_i T m_i + Dm_i x S f_i). */
void cayley_forces(const cayley_step *, int columns, double f[]);

#endif
