#include "harness/time/reading.h"

#include "cases/scene/quantity_type.h"
#include "elements/math/rotation.h"
#include "elements/math/vec3.h"
#include "harness/model/model.h"
#include "harness/time/forms.h"

/* A state as kinds of quantities read it; rate NULL: not of a motion. */
typedef struct read_state {
    quantity_state as;
    const model *m;
    const model_state *state;
    const double *rate;
} read_state;

/* The interface is its first member. */
static const read_state *of(const quantity_state *s)
{
    return (const read_state *)s;
}

static double component_of(const quantity_state *s, int node, int component)
{
    return kinematics_component(of(s)->m, of(s)->state, node, component);
}

static double relative_of(const quantity_state *s, int from, int node, int component)
{
    return kinematics_relative(of(s)->m, of(s)->state, from, node, component);
}

static void frame_of(const quantity_state *s, int node, double place[3], double R[9])
{
    double turn[4];
    kinematics_frame(of(s)->m, of(s)->state, node, place, turn);
    rotation_matrix(turn, R);
}

/* Velocity of a node, which a body may carry, or angular velocity in the node's axes. */
static double rate_of(const quantity_state *s, int node, int component)
{
    const model *m = of(s)->m;
    const int moved_by = model_body(m, node);
    frame_rates body;
    forms_rates(m, of(s)->state, moved_by, of(s)->rate, NULL, &body);
    if (component >= SCENE_RX) {
        double own[3];
        mat3_transpose_mul_vec(body.R, body.w, own);
        return own[component - SCENE_RX];
    }
    double rho[3], carried[3];
    kinematics_offset(m, of(s)->state, node, rho);
    vec3_cross(body.w, rho, carried);
    return body.v[component] + (moved_by == node ? 0 : carried[component]);
}

static double driver_of(const quantity_state *s, int driver)
{
    return kinematics_driver_value(of(s)->m, of(s)->state, driver);
}

int reading_is_kinematic(const scene_quantity *q)
{
    return quantity_type_of(q)->read != NULL;
}

double reading_of(const model *m, const scene_quantity *q, const model_state *s,
                  const double rate[])
{
    const read_state state = {.as = {.component = component_of,
                                     .relative = relative_of,
                                     .frame = frame_of,
                                     .rate = rate_of,
                                     .driver = driver_of},
                              .m = m,
                              .state = s,
                              .rate = rate};
    return quantity_type_of(q)->read(q, &state.as);
}
