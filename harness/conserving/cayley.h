/* A step of one element as a common turn, which is taken out of it exactly, and a motion relative
 * to that: nodes j move by dr_j and turn by the Cayley vectors c_j, R_1 = cay(c) R_n. With the mean
 * c, kappa = 1/sqrt(1 + c.c/4),  b = kappa^2/(4 (1 + kappa)),  S = kappa 1 + b c c^T,  T = 1 - b c
 * c^T, G half the common turn and D_j = r_j - mean r, r(s) = (1 - s) G D_n + s G^T D_1,   R(s) =
 * exp(s phi) G R_n,   a(s) = a_n + s da, dr^_j = S (dD_j - c x Dm_j),   c^_j = T (c_j - c)/(kappa
 * (1 + c.c_j/4)),   phi_j = psi_j c^_j: zero for every rigid motion. */
#ifndef BEAMWORK_CAYLEY_H
#define BEAMWORK_CAYLEY_H

#include "elements/element.h"

/* Cayley vector 2 tan(|t|/2) t/|t| of a rotation vector, and back. */
void cayley_of_vector(const double t[3], double c[3]);
void cayley_to_vector(const double c[3], double t[3]);
/* T_c = (1 + c~/2)/(1 + c.c/4): the spatial turn at the end is T_c dc. */
void cayley_tangent(const double c[3], double T[9]);

typedef struct cayley_step {
    int nodes;
    double mean[3], kappa, b, S[9], T[9], G[9];
    double Dn[ELEMENT_MAX_NODES][3], D1[ELEMENT_MAX_NODES][3], Dm[ELEMENT_MAX_NODES][3];
    double dD[ELEMENT_MAX_NODES][3];
    double c[ELEMENT_MAX_NODES][3], relative[ELEMENT_MAX_NODES][3]; /* c_j; c^_j */
    double divisor[ELEMENT_MAX_NODES], psi[ELEMENT_MAX_NODES], z[ELEMENT_MAX_NODES];
    double y[ELEMENT_MAX_COORDINATES]; /* dr^, phi, da */
    const node_state *from;
} cayley_step;

/* dr, c of the nodes [nodes x 3], da[nodes]; `from` stays where it is. */
void cayley_begin(int nodes, const node_state from[], double dr[][3], double c[][3],
                  const double da[], cayley_step *);
/* The states at s between 0 and 1, in axes turned by half. */
void cayley_between(const cayley_step *, double s, node_state x[]);
/* What forces f[7 nodes] on dr^, phi, da are on dr, c, da. */
void cayley_forces(const cayley_step *, const double f[], double F[]);

/* What a change of one coordinate (dr, c, da of the nodes, in this order) does. */
typedef struct cayley_change {
    double kappa, S[9], T[9], spin[3]; /* of G */
    double D1[ELEMENT_MAX_NODES][3], phi[ELEMENT_MAX_NODES][3], z[ELEMENT_MAX_NODES];
    double a[ELEMENT_MAX_NODES];
} cayley_change;
void cayley_change_by(const cayley_step *, int coordinate, cayley_change *);
/* Increments y[7 nodes] of the states at s, spatial. */
void cayley_change_between(const cayley_step *, const cayley_change *, double s, double y[]);
/* Change of cayley_forces, f changed by df. */
void cayley_change_forces(const cayley_step *, const cayley_change *, const double f[],
                          const double df[], double dF[]);

#endif
