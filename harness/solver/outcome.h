/* What an analysis leaves for those that follow it and for the quantities that are read from it. */
#ifndef BEAMWORK_OUTCOME_H
#define BEAMWORK_OUTCOME_H

#include "harness/algebra/eigen.h"
#include "harness/solver/modes.h"

/* Critical loads of one sign, ascending in size, or frequencies [rad/s], ascending; with their
 * modes. */
typedef struct outcome_side {
    int count;
    double *value, *mode; /* [count] NAN: lost in round-off; [count x free] */
    double *error; /* [count] estimate of what iteration and round-off leave, in parts of the value;
                      NULL: there is none */
    status status; /* NOT_CONVERGED: ... */
    char reason[FAULT_TEXT]; /* ... why there are no more, or some are lost */
} outcome_side;
/* Small motions about one state of a stationary rotation. */
typedef struct rotation_modes {
    int count;
    double *frequency, *growth; /* [count] [rad/s], [1/s] */
    mode_shape *shape;          /* [count] */
} rotation_modes;
void outcome_modes_free(rotation_modes *);

typedef struct analysis_outcome {
    status status;
    char reason[FAULT_TEXT];
    /* linear: displacements of all coordinates */
    double *x;
    /* static, continuation: the state at every station reached (the first `reached` of them) */
    int stations, reached;
    double *path;
    model_state **state;
    /* continuation: load factor and control value [m] at every point of the path, the first without
     * load */
    int points;
    double *factor, *control;
    model_state **point_state; /* [points]; NULL unless a curve of coordinates is wanted */
    /* buckling, modal; what was found stays where the analysis failed */
    outcome_side positive, negative;
    /* compliance: of the six components at the node, at every station [stations x 36]; rows of held
     * components are zero, columns that nothing asks for NAN; belongs to the result */
    const double *compliance;
    /* rotation: modes at every station; none where no quantity asks for them */
    rotation_modes *modes; /* [stations] */
} analysis_outcome;

void outcome_free(analysis_outcome *);
/* The values and modes of a side; they are taken from `from`. */
void outcome_take(eigen_side *from, outcome_side *to);
/* Room for the states of so many stations. */
status outcome_stations(analysis_outcome *, int stations, fault *);
/* A copy of the state becomes that of the next station. */
status outcome_keep(analysis_outcome *, const model *, const model_state *, double path, fault *);

#endif
