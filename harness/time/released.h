/* Masses of ends of members that are released from their nodes: they move with the coordinates of
 * the node's body and with turns and shifts of their own (harness/model/model.h). */
#ifndef BEAMWORK_RELEASED_H
#define BEAMWORK_RELEASED_H

#include "harness/model/model.h"
#include "harness/time/forms.h"

/* What such an end, or any other vertex, depends on. */
typedef struct released_masses {
    int count, own;             /* the first of its own coordinates among them */
    int body, ball;             /* first of three turns whose rates are an angular velocity in the
                                   axes of the body, of the end; -1: none */
    int index[KINEMATICS_MOST]; /* [count] coordinates */
    double T[6 * KINEMATICS_MOST]; /* [6 x count] its spatial motion by increments of them */
} released_masses;
void released_columns(const model *, const model_state *, int vertex, released_masses *);

/* As forms_rates and forms_add_force have it of nodes. */
void released_rates(const model *, const model_state *, int vertex, const double v[],
                    const double a[], frame_rates *);
void released_add_force(const model *, const model_state *, int vertex, const double F[6],
                        double out[]);

/* Velocities of the frame whose mass with its first moment [kg m] moves by own[6]: velocity of the
 * centre, angular velocity in the frame's axes. */
void released_moving(const double own[6], double mass, const double moment[3], frame_rates *);

/* out[6 x count]: T, whose columns are multiplied: by `plain`, those of turns in the axes of body
 * and end by matrices [3 x 3] from the right. */
void released_motion(const released_masses *, double plain, const double body[9],
                     const double ball[9], double out[6 * KINEMATICS_MOST]);
/* out[count x count] += T^T A motion */
void released_project(const released_masses *, const double A[36], const double motion[],
                      double out[KINEMATICS_MOST * KINEMATICS_MOST]);

#endif
