/* Mass along a two-node element, on displacements that are the nodes' values between them and
 * functionals of the deformation modes (beamw/inertia.c). */
#ifndef BEAMWORK_BEAMW_SPREAD_H
#define BEAMWORK_BEAMW_SPREAD_H

#include "elements/shared/lumped.h"

enum {
    BEAMW_GAUSS = 8,      /* points of the consistent mass, at most */
    BEAMW_FIELDS = 6,     /* and its functionals at each */
    BEAMW_FIELD_MODES = 8 /* of J Eq. 7 */
};

/* Data of a kind of element. */
typedef struct beamw_spread {
    double l0;                                                  /* [m] */
    lumped_mass lumped;                                         /* inertia of half the element */
    int points;                                                 /* of the consistent mass */
    double at[BEAMW_GAUSS], weight[BEAMW_GAUSS];                /* on [0, 1] */
    double field[BEAMW_GAUSS][BEAMW_FIELDS][BEAMW_FIELD_MODES]; /* functionals of e: inertia.c */
    double share; /* of the consistent mass: 0 lumped, 1 consistent, 1/2 averaged */
} beamw_spread;

status beamw_spread_inertia(const beamw_spread *, const node_state x[2],
                            const element_rotating_frame *, inertia_output *);

#endif
