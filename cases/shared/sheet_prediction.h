/* Closed-form solution of a clamped-free sheet flexure (N section 3.5, Eq. 54), by hand for the
 * state of sheet_cantilever: tip displaced along y and not turned.  One Hellinger-Reissner
 * interpolation for the whole sheet: a prediction, with an error of its own. */
#ifndef BEAMWORK_CASES_SHEET_PREDICTION_H
#define BEAMWORK_CASES_SHEET_PREDICTION_H

#include "cases/scene/scene.h"

extern const char sheet_prediction_source[];

typedef struct sheet_prediction {
    double u_x;        /* tip displacement along x [m] */
    double F_y, M_z;   /* reactions [N, N m] */
    double C_xx, C_zz; /* compliance of the tip, spatial moments [m/N] */
} sheet_prediction;

/* tip_warps: 1, the tip is free to warp; shear: 0, rigid in shear; k: shear factor.  Values that do
 * not exist are NAN. */
sheet_prediction sheet_prediction_of(const section *c, double length, double deflection,
                                     int tip_warps, int shear, scene_moments moments);

#endif
