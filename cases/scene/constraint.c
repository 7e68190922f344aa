#include "cases/scene/scene_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/math/dense.h"

enum { ALL = 6 };

static const char *const component_name[ALL] = {"ux", "uy", "uz", "rx", "ry", "rz"};

int scene_add_constraint(scene *s, unsigned components, double ratio)
{
    const int i = scene_grow(s, &s->constraint, &s->constraints, sizeof *s->constraint);
    if (i >= 0) {
        s->constraint[i].components = components;
        s->constraint[i].ratio = ratio;
        s->constraint[i].master = s->constraint[i].normal = SCENE_NONE;
    }
    return i;
}

static void turn_across(scene_node *n, int normal)
{
    if (n->rotation != SCENE_ROTATION_SPATIAL)
        return;
    const int given[3] = {n->angle[0], n->angle[1], n->angle[2]};
    n->rotation = SCENE_ROTATION_SEQUENCE;
    memset(n->axis, 0, sizeof n->axis);
    for (int k = 0; k < 3; k++) {
        n->angle[k] = given[(normal + k) % 3];
        n->axis[k][(normal + k) % 3] = 1;
    }
    if (n->angle[1] == SCENE_HELD && n->angle[2] == SCENE_HELD) {
        memset(n->axis[1], 0, sizeof n->axis[1]);
        memset(n->axis[2], 0, sizeof n->axis[2]);
    }
}

int scene_add_diaphragm(scene *s, int master, int normal)
{
    const unsigned across = 1u << (normal + 1) % 3 | 1u << (normal + 2) % 3;
    const int i = scene_add_constraint(s, across | 1u << (SCENE_RX + normal), 1);
    if (i < 0)
        return i;
    s->constraint[i].master = master;
    s->constraint[i].normal = normal;
    if (master >= 0 && master < s->nodes)
        turn_across(&s->node[master], normal);
    return i;
}

void scene_constrain(scene *s, int constraint, int node)
{
    if (constraint < 0)
        return;
    scene_constraint *c = &s->constraint[constraint];
    const int i = scene_grow(s, &c->node, &c->nodes, sizeof *c->node);
    if (i >= 0)
        c->node[i] = node;
    if (c->master != SCENE_NONE && node >= 0 && node < s->nodes)
        turn_across(&s->node[node], c->normal);
}

int scene_is_constrained(const scene *s, int node, unsigned components)
{
    for (int i = 0; i < s->constraints; i++)
        for (int k = -1; k < s->constraint[i].nodes; k++)
            if ((k < 0 ? s->constraint[i].master : s->constraint[i].node[k]) == node &&
                (s->constraint[i].components & components) != 0)
                return 1;
    return 0;
}

static status refuse(const scene *s, int constraint, int node, int component, const char *why,
                     fault *f)
{
    return fault_set(f, STATUS_REFUSED, "%s: %s of %s %s",
                     scene_called(s, SCENE_CONSTRAINTS, constraint).text, component_name[component],
                     scene_called(s, SCENE_NODES, node).text, why);
}

/* Returns 1 if all rotations of the node are free and the constraint couples all three rotations
 * with ratio 1. */
static int turns_together(const scene_node *n, const scene_constraint *c)
{
    return n->rotation == SCENE_ROTATION_SPATIAL && n->angle[0] == SCENE_FREE &&
           n->angle[1] == SCENE_FREE && n->angle[2] == SCENE_FREE && c->ratio == 1 &&
           (c->components & SCENE_TURNS) == SCENE_TURNS;
}

/* Returns the angle about the axis of a component if all other angles are fixed, otherwise
 * SCENE_NONE. */
static int angle_of(const scene *s, int node, int component)
{
    const scene_node *n = &s->node[node];
    const int turn = component - SCENE_RX;
    double R[9];
    scene_node_axes(n, R);
    if (n->rotation == SCENE_ROTATION_SEQUENCE) {
        const double *axis = n->axis[0], along[3] = {R[turn], R[3 + turn], R[6 + turn]};
        return !(vec3_norm(n->axis[1]) > 0) &&
                       vec3_dot(axis, along) >= (1 - 1e-14) * vec3_norm(axis)
                   ? 0
                   : SCENE_NONE;
    }
    if (n->rotation != SCENE_ROTATION_SPATIAL)
        return SCENE_NONE;
    for (int k = 0; k < 3; k++)
        if (k != turn && n->angle[k] != SCENE_HELD &&
            (s->plane == SCENE_SPACE || k == scene_normal(s)))
            return SCENE_NONE;
    return turn;
}

static int leaves_plane(const scene *s, int node, int component)
{
    double R[9];
    const int normal = scene_normal(s);
    if (normal == SCENE_NONE)
        return 0;
    scene_node_axes(&s->node[node], R);
    const int along = fabs(R[3 * normal + component % 3]) > 0.5;
    return component < SCENE_RX ? along : !along;
}

static int is_condition(const scene *s, int node, int component, int motion)
{
    if (motion >= 0 && s->driver[motion].value == NULL && s->driver[motion].function.pieces == 0)
        return 1;
    for (int d = 0; d < s->drivers; d++)
        if (s->driver[d].value == NULL && s->driver[d].function.pieces == 0 &&
            s->driver[d].condition_node == node && s->driver[d].condition_component == component)
            return 1;
    return 0;
}

static status refuse_attached(const scene *s, int constraint, int node, fault *f)
{
    const scene_words other = scene_called(s, SCENE_NODES, s->node[node].attached);
    return fault_set(f, STATUS_REFUSED, "%s: %s is rigidly connected to %s; name %s instead",
                     scene_called(s, SCENE_CONSTRAINTS, constraint).text,
                     scene_called(s, SCENE_NODES, node).text, other.text, other.text);
}

static status coordinate_of(const scene *s, int constraint, int node, int component,
                            int *coordinate, int *motion, fault *f)
{
    const scene_node *n = &s->node[node];
    const int angle = component < SCENE_RX ? 0 : angle_of(s, node, component);
    if (n->attached != SCENE_NONE)
        return refuse_attached(s, constraint, node, f);
    if (leaves_plane(s, node, component))
        return refuse(s, constraint, node, component,
                      "leaves the plane of the scene and is therefore fixed; remove this component",
                      f);
    *coordinate = component;
    if (component >= SCENE_RX && turns_together(n, &s->constraint[constraint]) &&
        s->plane == SCENE_SPACE) {
        *motion = SCENE_FREE;
        return STATUS_OK;
    }
    if (angle == SCENE_NONE)
        return refuse(s, constraint, node, component,
                      "is not a rotation about a fixed axis; fix the node's other "
                      "two rotations, or name rx, ry and rz of nodes that rotate "
                      "freely",
                      f);
    *coordinate = component < SCENE_RX ? component : SCENE_RX + angle;
    *motion = component < SCENE_RX ? n->translation[component] : n->angle[angle];
    if (*motion == SCENE_HELD)
        return refuse(s, constraint, node, component,
                      "is both fixed and constrained; free it, or remove it from the constraint",
                      f);
    if (is_condition(s, node, component, *motion))
        return refuse(s, constraint, node, component,
                      "is driven by a motion of unknown value, or determines such a value; remove "
                      "it from the constraint",
                      f);
    return STATUS_OK;
}

/* Follows the chain of relations. Returns the coordinate at its end and the product of the
 * ratios. */
static scene_tie follow(const scene_tie tie[], int node, int coordinate)
{
    scene_tie at = {node, coordinate, 1};
    for (;;) {
        const scene_tie *next = &tie[ALL * at.node + at.coordinate];
        if (next->node == SCENE_NONE ||
            (next->node == at.node && next->coordinate == at.coordinate))
            return at;
        at = (scene_tie){next->node, next->coordinate, at.ratio * next->ratio};
    }
}

/* Returns SCENE_FREE, SCENE_HELD or the driver of a coordinate. */
static int motion_at(const scene *s, scene_tie at)
{
    const scene_node *n = &s->node[at.node];
    return at.coordinate < SCENE_RX ? n->translation[at.coordinate]
                                    : n->angle[at.coordinate - SCENE_RX];
}

static int is_across(const scene *s, int node, int component)
{
    for (int i = 0; i < s->constraints; i++)
        for (int k = -1; k < s->constraint[i].nodes && s->constraint[i].master != SCENE_NONE; k++)
            if ((k < 0 ? s->constraint[i].master : s->constraint[i].node[k]) == node &&
                (s->constraint[i].components >> component & 1u) != 0)
                return 1;
    return 0;
}

/* Makes the component of node k `ratio` times that of the first node. */
static status join(const scene *s, int constraint, int k, int component, scene_tie tie[], fault *f)
{
    const scene_constraint *c = &s->constraint[constraint];
    int at[2] = {0, 0}, motion;
    TRY(coordinate_of(s, constraint, c->node[0], component, &at[0], &motion, f));
    TRY(coordinate_of(s, constraint, c->node[k], component, &at[1], &motion, f));
    for (int i = 0; i < 2; i++)
        if (is_across(s, c->node[i == 0 ? 0 : k], component))
            return refuse(s, constraint, c->node[i == 0 ? 0 : k], component,
                          "also belongs to a diaphragm; remove it from one of them", f);
    const scene_tie first = follow(tie, c->node[0], at[0]), other = follow(tie, c->node[k], at[1]);
    const double ratio = c->ratio * first.ratio / other.ratio;
    if (first.node == other.node && first.coordinate == other.coordinate)
        return refuse(s, constraint, c->node[k], component,
                      "already follows from other constraints; remove it from this one", f);
    if (motion_at(s, first) >= 0 && motion_at(s, other) >= 0)
        return refuse(s, constraint, c->node[k], component,
                      "is driven twice, by a motion and by the constraint; remove one of them", f);
    const int reversed = motion_at(s, other) >= 0 ||
                         (motion_at(s, first) < 0 && ALL * other.node + other.coordinate <
                                                         ALL * first.node + first.coordinate);
    const scene_tie *from = reversed ? &first : &other, *to = reversed ? &other : &first;
    tie[ALL * to->node + to->coordinate] = (scene_tie){to->node, to->coordinate, 1};
    tie[ALL * from->node + from->coordinate] =
        (scene_tie){to->node, to->coordinate, reversed ? 1 / ratio : ratio};
    return STATUS_OK;
}

static status check_across(const scene *s, int i, int node, fault *f)
{
    const scene_constraint *c = &s->constraint[i];
    const scene_node *n = &s->node[node];
    const scene_words owner_name = scene_called(s, SCENE_CONSTRAINTS, i),
                      node_name = scene_called(s, SCENE_NODES, node);
    double R[9];
    if (s->plane != SCENE_SPACE)
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a diaphragm requires a three-dimensional scene; connect the nodes by part_of",
            owner_name.text);
    if (n->attached != SCENE_NONE)
        return refuse_attached(s, i, node, f);
    if (scene_node_axes(n, R))
        return fault_set(f, STATUS_REFUSED,
                         "%s: %s has its own axes, but a diaphragm uses those of the "
                         "scene; remove the axes",
                         owner_name.text, node_name.text);
    if (n->rotation != SCENE_ROTATION_SEQUENCE || !(n->axis[0][c->normal] > 0) ||
        n->axis[0][(c->normal + 1) % 3] != 0 || n->axis[0][(c->normal + 2) % 3] != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: the rotation of %s must be given by components, or by a sequence "
                         "that begins with the normal of the diaphragm; remove 'rotation' there",
                         owner_name.text, node_name.text);
    return STATUS_OK;
}

static status join_across(const scene *s, int i, scene_tie tie[], fault *f)
{
    const scene_constraint *c = &s->constraint[i];
    const int of[3] = {(c->normal + 1) % 3, (c->normal + 2) % 3, SCENE_RX};
    for (int k = -1; k < c->nodes; k++) {
        const int node = k < 0 ? c->master : c->node[k];
        TRY(check_across(s, i, node, f));
        for (int j = 0; j < 3; j++) {
            const int named = of[j] < SCENE_RX ? of[j] : SCENE_RX + c->normal;
            scene_tie *at = &tie[ALL * node + of[j]];
            if (at->node != SCENE_NONE)
                return refuse(s, i, node, named,
                              "also belongs to another constraint; remove it from one of them", f);
            if (k >= 0 && motion_at(s, (scene_tie){node, of[j], 1}) != SCENE_FREE)
                return refuse(s, i, node, named,
                              "is fixed or driven, but follows the master of the diaphragm; fix or "
                              "drive the master",
                              f);
            *at = (scene_tie){c->master, of[j], 1};
        }
    }
    return STATUS_OK;
}

static status check_names(const scene *s, int i, fault *f)
{
    const scene_constraint *c = &s->constraint[i];
    const int diaphragm = c->master != SCENE_NONE || c->normal != SCENE_NONE;
    const scene_words owner_name = scene_called(s, SCENE_CONSTRAINTS, i);
    int single = c->components != 0 && (c->components & (c->components - 1)) == 0;
    if (c->components == 0 || c->components >> ALL != 0)
        return fault_set(f, STATUS_REFUSED,
                         "%s: no components are given; give one or more of ux, uy, uz, rx, ry, rz",
                         owner_name.text);
    if (diaphragm && (c->master < 0 || c->master >= s->nodes || c->normal < 0 || c->normal > 2))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: the master node or the normal is invalid; name an existing node and x, y or "
            "z",
            owner_name.text);
    if (c->nodes < (diaphragm ? 1 : 2))
        return fault_set(f, STATUS_REFUSED,
                         "%s: the constraint has too few nodes; name at least %s", owner_name.text,
                         diaphragm ? "one" : "two");
    if (!isfinite(c->ratio) || !(fabs(c->ratio) >= 1e-6 && fabs(c->ratio) <= 1e6))
        return fault_set(f, STATUS_REFUSED,
                         "%s: ratio = %g; give a magnitude from 1e-6 to 1e6, or fix the component",
                         owner_name.text, c->ratio);
    if (c->ratio != 1 && !(single && c->nodes == 2))
        return fault_set(
            f, STATUS_REFUSED,
            "%s: a ratio relates one component of two nodes; write one entry for each component",
            owner_name.text);
    for (int k = 0; k < c->nodes; k++) {
        if (c->node[k] < 0 || c->node[k] >= s->nodes)
            return fault_set(f, STATUS_REFUSED, "%s: one of the nodes does not exist; add it first",
                             owner_name.text);
        for (int j = diaphragm ? -1 : 0; j < k; j++)
            if ((j < 0 ? c->master : c->node[j]) == c->node[k])
                return fault_set(f, STATUS_REFUSED, "%s: %s is named twice; name another node",
                                 owner_name.text, scene_called(s, SCENE_NODES, c->node[k]).text);
    }
    return STATUS_OK;
}

status scene_ties(const scene *s, scene_tie tie[], fault *f)
{
    for (int i = 0; i < ALL * s->nodes; i++)
        tie[i] = (scene_tie){SCENE_NONE, 0, 1};
    for (int i = 0; i < s->constraints; i++) {
        TRY(check_names(s, i, f));
    }
    for (int i = 0; i < s->constraints; i++)
        if (s->constraint[i].master != SCENE_NONE)
            TRY(join_across(s, i, tie, f));
    for (int i = 0; i < s->constraints; i++) {
        for (int k = 1; s->constraint[i].master == SCENE_NONE && k < s->constraint[i].nodes; k++)
            for (int c = 0; c < ALL; c++)
                if (s->constraint[i].components >> c & 1u)
                    TRY(join(s, i, k, c, tie, f));
    }
    for (int i = 0; i < ALL * s->nodes; i++)
        if (tie[i].node != SCENE_NONE)
            tie[i] = follow(tie, i / ALL, i % ALL);
    return STATUS_OK;
}

status scene_validate_constraints(const scene *s, fault *f)
{
    if (s->constraints == 0)
        return STATUS_OK;
    scene_tie *tie = malloc((size_t)(ALL * s->nodes + 1) * sizeof *tie);
    if (tie == NULL)
        return fault_memory(f, "constraints");
    const status outcome = scene_ties(s, tie, f);
    free(tie);
    return outcome;
}
