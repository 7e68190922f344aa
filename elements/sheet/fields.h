/* The linear solution between the nodes as linear functionals of the local coordinates (N Eqs. 14-19). */
#ifndef BEAMWORK_SHEET_FIELDS_H
#define BEAMWORK_SHEET_FIELDS_H

#include "elements/sheet/local.h"

/* Each row[8]: value = row . q.  Primes are d/ds. */
typedef struct fields {
    double uy[LOCAL_COORDINATES], duy[LOCAL_COORDINATES],
        duz[LOCAL_COORDINATES];                                 /* u_y [m], u_y', u_z' */
    double phi_x[LOCAL_COORDINATES], dphi_x[LOCAL_COORDINATES]; /* phi_x [rad], phi_x' [rad/m] */
    double phi_y[LOCAL_COORDINATES], dphi_y[LOCAL_COORDINATES];
    double phi_z[LOCAL_COORDINATES], dphi_z[LOCAL_COORDINATES];
} fields;

/* 1: phi_x is cubic (N Eq. 19); 0: where nothing warps or no amplitude is asked for it is linear. */
int fields_warp(const element_request *request);

/* At s = x l0.  Phi_y, Phi_z: N Eq. 18.  warp: as fields_warp says. */
fields fields_at(double l0, double x, double Phi_y, double Phi_z, int warp);

#endif
