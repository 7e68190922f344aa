/* The linear solution between the nodes as linear functionals of the local coordinates (N Eqs.
 * 14-19). */
#ifndef BEAMWORK_SHEET_FIELDS_H
#define BEAMWORK_SHEET_FIELDS_H

#include "elements/sheet/local.h"

/* Each row[8]: value = row . q.  Primes are d/ds. */
typedef struct sheet_fields {
    double uy[SHEET_LOCAL_COORDINATES], duy[SHEET_LOCAL_COORDINATES],
        duz[SHEET_LOCAL_COORDINATES]; /* u_y [m], u_y', u_z' */
    double phi_x[SHEET_LOCAL_COORDINATES],
        dphi_x[SHEET_LOCAL_COORDINATES]; /* phi_x [rad], phi_x' [rad/m] */
    double phi_y[SHEET_LOCAL_COORDINATES], dphi_y[SHEET_LOCAL_COORDINATES];
    double phi_z[SHEET_LOCAL_COORDINATES], dphi_z[SHEET_LOCAL_COORDINATES];
} sheet_fields;

/* 1: phi_x is cubic (N Eq. 19); 0: where nothing warps or no amplitude is asked for it is linear.
 */
int sheet_fields_warp(const element_request *request);

/* At s = x l0.  Phi_y, Phi_z: N Eq. 18.  warp: as sheet_fields_warp says. */
sheet_fields sheet_fields_at(double l0, double x, double Phi_y, double Phi_z, int warp);

#endif
