/* Inside of the consistent mass (inertia.c): its moving vectors at the points of quadrature. */
#ifndef BEAMWORK_BEAMW_INERTIA_POINT_H
#define BEAMWORK_BEAMW_INERTIA_POINT_H

#include "elements/beamw/modes.h"
#include "elements/beamw/spread.h"
#include "elements/shared/moving.h"

enum { N = 14, RP = 0, TP = 3, AP = 6, RQ = 7, TQ = 10, AQ = 13 };
enum { NU_Y, NU_Z, CHI_X, CHI_Y, CHI_Z, PSI }; /* the last: warping amplitude */

/* The element's state, and what the points gather for the second derivatives. */
typedef struct beamw_inertia_state {
    double vector[2][3][3]; /* node, direction: unit vectors */
    double mean[3][3];      /* m_k */
    double e[8], J[8 * N];
    double s[8];       /* F . m_k of the functionals: stresses of the strains */
    double turn[6][8]; /* d(F . m_k)/dtheta of p and q, with them */
    const node_state *x;
    const element_rotating_frame *frame;
    inertia_output *out;
} beamw_inertia_state;

/* The functionals at a point: their values and gradients. */
typedef struct beamw_inertia_values {
    double x, mass; /* mass: weight */
    const double (*field)[8];
    double value[BEAMW_FIELDS], gradient[BEAMW_FIELDS][N];
} beamw_inertia_values;

enum { POSITION = -1, NOTHING = -2, TERMS = 2 };

/* y = lin(a vector of the nodes) + sum sign m_k field. */
typedef struct beamw_inertia_vector {
    int director; /* unit vector, or one of the above */
    int terms;
    struct {
        int k, field;
        double sign;
    } term[TERMS];
} beamw_inertia_vector;

/* inertia_point.c */
void beamw_inertia_values_at(const beamw_inertia_state *, const beamw_spread *, int point,
                             beamw_inertia_values *);
/* dy/dx but for what turns with the nodes. */
void beamw_inertia_gradient(const beamw_inertia_state *, const beamw_inertia_values *,
                            const beamw_inertia_vector *, double T[3 * N]);
/* Position in the frame; and the vectors fixed to the nodes, with their weights. */
void beamw_inertia_place(const beamw_inertia_state *, const beamw_inertia_values *,
                         const beamw_inertia_vector *, double r[3], double fixed[2][3]);
#endif
