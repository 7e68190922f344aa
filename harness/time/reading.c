#include "harness/time/reading.h"

#include <math.h>

#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/kinematics.h"
#include "harness/time/forms.h"

int reading_is_kinematic(scene_quantity_kind kind)
{
    return kind == SCENE_COORDINATE || kind == SCENE_RATE || kind == SCENE_RELATIVE ||
           kind == SCENE_ORIENTATION || kind == SCENE_DRIVER_VALUE;
}

/* Velocity of a node, which a body may carry, or angular velocity in the node's axes. */
static double rate_of(const model *m, const model_state *s, const scene_component *what,
                      const double rate[])
{
    const int moved_by = model_body(m, what->node);
    frame_rates body;
    forms_rates(m, s, moved_by, rate, NULL, &body);
    if (what->component >= SCENE_RX) {
        double own[3];
        mat3_transpose_mul_vec(body.R, body.w, own);
        return own[what->component - SCENE_RX];
    }
    double rho[3], carried[3];
    kinematics_offset(m, s, what->node, rho);
    vec3_cross(body.w, rho, carried);
    return body.v[what->component] + (moved_by == what->node ? 0 : carried[what->component]);
}

double reading_of(const model *m, const scene_quantity *q, const model_state *s,
                  const double rate[])
{
    switch (q->what.kind) {
    case SCENE_COORDINATE:
        return kinematics_component(m, s, scene_component_of(q)->node,
                                    scene_component_of(q)->component);
    case SCENE_RATE:
        return rate_of(m, s, scene_component_of(q), rate);
    case SCENE_RELATIVE:
        return kinematics_relative(m, s, scene_relative_of(q)->from, scene_relative_of(q)->node,
                                   scene_relative_of(q)->component);
    case SCENE_ORIENTATION: {
        const scene_orientation *what = scene_orientation_of(q);
        double place[3], turn[4], all[9];
        kinematics_frame(m, s, what->node, place, turn);
        rotation_matrix(turn, all);
        return all[3 * what->row + what->column];
    }
    case SCENE_DRIVER_VALUE:
        return kinematics_driver_value(m, s, scene_driver_of(q));
    default:
        return NAN;
    }
}
