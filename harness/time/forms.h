/* How the coordinates of a frame's rotation change in time, and what the rates of a model's
 * coordinates mean: translations, warping amplitudes and angles have their derivatives, a rotation
 * that is free or given by a vector has the angular velocity in axes that turn with the frame. */
#ifndef BEAMWORK_FORMS_H
#define BEAMWORK_FORMS_H

#include "harness/model/model.h"

typedef enum rotation_form {
    FORM_BODY,    /* three coordinates: components of the angular velocity in the frame's axes */
    FORM_AXIS,    /* about one fixed axis at most: an angle */
    FORM_SEQUENCE /* angles one after the other */
} rotation_form;

/* REFUSED: two turns about fixed axes that move while the third is held or moves otherwise, with
 * its row kept or left out alike. They hold a component of the angular velocity at zero, which has
 * no integral: exp(-b e_j~) exp(-a e_i~) exp(b e_j~) exp(a e_i~) = 1 - a b e_k~ + ..., so that no
 * state of the coordinates says where the node is. */
status forms_check(const model *, fault *);
rotation_form forms_of(const model *, int vertex);

/* Velocity and acceleration of a node's frame, spatial [m/s, rad/s, m/s^2,
 * rad/s^2], from rates v[free + driven] and their derivatives a (NULL: zero). */
typedef struct frame_rates {
    double R[9];
    double v[3], w[3], a[3], wd[3];
} frame_rates;
void forms_rates(const model *, const model_state *, int vertex, const double v[], const double a[],
                 frame_rates *out);

/* F[6] (force, moment) on a node's frame into the rows of the coordinates that move it. */
void forms_add_force(const model *, const model_state *, int vertex, const double F[6],
                     double out[]);

#endif
