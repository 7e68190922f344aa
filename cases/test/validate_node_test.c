/* What nodes may not be: every refusal names its culprit and says what to do, in one
 * line; and what is refused is one thing only: the scene it was made from is accepted. */
#include <math.h>

#include "cases/test/refuse.h"

static const double x_axis[3] = {1, 0, 0}, zero[3] = {0, 0, 0};

static void position(scene *s)
{
    s->node[TIP].position[1] = NAN;
}

static void driver_of_node(scene *s)
{
    s->node[TIP].translation[0] = 7;
}

static void half_a_vector(scene *s)
{
    s->node[TIP].rotation = SCENE_ROTATION_VECTOR;
}

static void fork_and_held(scene *s)
{
    scene_fork(s, ROOT, x_axis, y_axis);
}

static void web_along(scene *s)
{
    scene_fork(s, TIP, x_axis, x_axis);
}

static void no_web(scene *s)
{
    scene_fork(s, TIP, x_axis, zero);
}

static void fork_across(scene *s)
{
    scene_fork(s, TIP, y_axis, x_axis);
}

static void body_of_body(scene *s)
{
    s->node[TIP].attached = BODY;
}

static void body_of_itself(scene *s)
{
    s->node[BODY].attached = BODY;
}

static void body_of_nothing(scene *s)
{
    s->node[BODY].attached = 9;
}

static void body_held(scene *s)
{
    scene_hold(s, BODY, SCENE_UZ, SCENE_UZ);
}

static void spoil_body(scene *s, scene_body b)
{
    scene_set_body(s, 1, b);
}

static void negative_mass(scene *s)
{
    spoil_body(s, (scene_body){.mass = -1});
}

static void endless_inertia(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {INFINITY, 1, 1}});
}

static void centre_of_nothing(scene *s)
{
    spoil_body(s, (scene_body){.centre = {0, 1, 0}});
}

static void no_triangle(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 2.1}});
}

static void products_too_large(scene *s)
{
    spoil_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 1, 0.6, 0, 0}});
}

static void loose_mass(scene *s)
{
    scene_set_body(s, scene_add_node(s, 0, 0, 7), (scene_body){.mass = 1});
}

static const refusal node_refusals[] = {
    {position, "node 1: ", "at = "},
    {driver_of_node, "node 1: ", "driver that does not exist"},
    {half_a_vector, "node 1: ", "three drivers"},
    {fork_and_held, "node 0: ", "a fork and RX held"},
    {web_along, "node 1: ", "not at right angles"},
    {no_web, "node 1: ", "not at right angles"},
    {fork_across, "node 1: ", "no member there runs along"},
    {body_of_body, "node 1: ", "attached to node 2, which is no body"},
    {body_of_itself, "node 2: ", "attached to node 2, which is no body"},
    {body_of_nothing, "node 2: ", "part_of: node 9 does not exist"},
    {body_held, "node 2: ", "it moves with node 1"},
    {negative_mass, "node 1: ", "mass = -"},
    {endless_inertia, "node 1: ", "inertia = "},
    {centre_of_nothing, "node 1: ", "a centre without a mass"},
    {no_triangle, "node 1: ", "no body has this inertia"},
    {products_too_large, "node 1: ", "no body has this inertia"},
    {loose_mass, "node 3: ", "nothing holds its mass"},
};

int main(void)
{
    refuse_all(sizeof node_refusals / sizeof node_refusals[0], node_refusals);
    return gsl_test_summary();
}
