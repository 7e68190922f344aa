/* Loads at nodes without members and springs, which only supports, motions and constraints carry.
 */
#include "cases/scene/scene_impl.h"

#include <math.h>

#include "elements/math/dense.h"

static int is_at(const scene *s, int end, int body)
{
    return end >= 0 && end < s->nodes && (end == body || s->node[end].attached == body);
}

static int body_of(const scene *s, int node)
{
    return s->node[node].attached == SCENE_NONE ? node : s->node[node].attached;
}

int scene_is_joined(const scene *s, int node)
{
    const int body = body_of(s, node);
    for (int i = 0; i < s->members; i++)
        if (is_at(s, s->member[i].p, body) || is_at(s, s->member[i].q, body))
            return 1;
    for (int i = 0; i < s->springs; i++)
        if (is_at(s, s->spring[i].p, body) || is_at(s, s->spring[i].q, body))
            return 1;
    return 0;
}

/* Writes the direction of a coordinate of the node. Returns the component in this direction, or
 * SCENE_NONE if the direction is not along one of the node's axes. */
static int direction_of(const scene_node *n, int coordinate, double direction[3])
{
    const int first = coordinate < SCENE_RX ? SCENE_UX : SCENE_RX, own = coordinate - first;
    int component = SCENE_NONE;
    double R[9];
    scene_node_axes(n, R);
    for (int k = 0; k < 3; k++)
        direction[k] = first == SCENE_RX && n->rotation == SCENE_ROTATION_SEQUENCE ? n->axis[own][k]
                                                                                   : R[3 * k + own];
    for (int c = 0; c < 3; c++) {
        const double axis[3] = {R[c], R[3 + c], R[6 + c]};
        if (vec3_dot(axis, direction) > (1 - 1e-14) * vec3_norm(direction))
            component = first + c;
    }
    return component;
}

/* Returns 1 if the coordinate of the node is free and no constraint contains it. */
static int is_loose(const scene *s, int node, int coordinate, int component,
                    const double direction[3])
{
    const scene_node *n = &s->node[node];
    const int turns = coordinate >= SCENE_RX;
    if ((turns ? n->angle[coordinate - SCENE_RX] : n->translation[coordinate]) != SCENE_FREE ||
        (turns && n->rotation == SCENE_ROTATION_FORK) ||
        (component != SCENE_NONE && scene_is_constrained(s, node, 1u << component)))
        return 0;
    if (s->plane == SCENE_SPACE)
        return 1;
    const int across = fabs(direction[scene_normal(s)]) > 0.5 * vec3_norm(direction);
    return turns == across;
}

/* Checks the force and the moment that a load exerts on a node. place[3]: point where the force
 * acts. */
static status check_wrench(const scene *s, int load, int node, const double place[3],
                           const double force[3], const double moment[3], fault *f)
{
    static const char *const name[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
    const int body = body_of(s, node);
    double arm[3], total[3], direction[3];
    for (int k = 0; k < 3; k++)
        arm[k] = place[k] - s->node[body].position[k];
    vec3_cross(arm, force, total);
    const double size = vec3_norm(moment) + vec3_norm(arm) * vec3_norm(force);
    for (int k = 0; k < 3; k++)
        total[k] += moment[k];
    for (int c = SCENE_UX; c <= SCENE_RZ; c++) {
        const int component = direction_of(&s->node[body], c, direction);
        if (!is_loose(s, body, c, component, direction))
            continue;
        const double *acts = c < SCENE_RX ? force : total,
                     largest = c < SCENE_RX ? vec3_norm(force) : size;
        if (fabs(vec3_dot(acts, direction)) > 1e-12 * largest * vec3_norm(direction))
            return fault_set(f, STATUS_REFUSED,
                             "%s: it acts on %s of %s, which no member, spring, support or "
                             "constraint carries; fix this component with 'hold', join a member "
                             "or a spring, or remove this component of the load",
                             scene_called(s, SCENE_LOADS, load).text,
                             component == SCENE_NONE ? "a rotation" : name[component],
                             scene_called(s, SCENE_NODES, body).text);
    }
    return STATUS_OK;
}

status scene_validate_carried(const scene *s, int i, fault *f)
{
    const scene_load *load = &s->load[i];
    const scene_node *n = &s->node[load->where];
    double force[3] = {0}, moment[3] = {0}, place[3];
    if (scene_load_along(load))
        return STATUS_OK;
    for (int k = 0; k < 3; k++) {
        const double apart =
            load->towards == SCENE_NONE ? 0 : s->node[load->towards].position[k] - n->position[k];
        place[k] = n->position[k] + (load->kind == SCENE_WEIGHT ? n->body.centre[k] : load->at[k]);
        force[k] = load->kind == SCENE_MOMENT ? 0 : load->vector[k] + load->tension * apart;
        moment[k] = load->kind == SCENE_MOMENT ? load->vector[k] : 0;
    }
    if (!scene_is_joined(s, load->where))
        TRY(check_wrench(s, i, load->where, place, force, moment, f));
    return load->towards == SCENE_NONE || scene_is_joined(s, load->towards)
               ? STATUS_OK
               : check_wrench(s, i, load->towards, s->node[load->towards].position, force, moment,
                              f);
}
