/* Rejected springs, members, motions and loads. */
#include <math.h>

#include "cases/scene/scene.h"
#include "cases/test/refuse.h"

static const double x_axis[3] = {1, 0, 0}, zero[3] = {0, 0, 0};

static void end_of_member(scene *s)
{
    s->member[0].q = 5;
}

static void no_section(scene *s)
{
    s->member[0].section = 1;
}

static void no_length(scene *s)
{
    memset(s->node[TIP].position, 0, sizeof zero);
}

static void y_along(scene *s)
{
    memcpy(s->member[0].y_axis, x_axis, sizeof x_axis);
}

static void no_y(scene *s)
{
    memset(s->member[0].y_axis, 0, sizeof zero);
}

static void divisions(scene *s)
{
    s->member[0].divisions = -3;
}

static void damping(scene *s)
{
    s->member[0].damping = -1e-3;
}

static void idle_driver(scene *s)
{
    scene_drive(s, TIP, SCENE_UY, SCENE_FREE);
}

static void value_of_driver(scene *s)
{
    s->driver[0].value[1] = INFINITY;
}

static void path_of_driver(scene *s)
{
    s->driver[0].path[1] = 0;
}

static void no_load_there(scene *s)
{
    s->load[0].where = 3;
}

static void no_member_loaded(scene *s)
{
    s->load[0] = scene_load_of(SCENE_DISTRIBUTED, 1, 0, 0, 0);
}

static void load(scene *s)
{
    s->load[0].vector[2] = NAN;
}

static scene_load *spread(scene *s, double from, double to)
{
    s->load[0] = scene_load_of(SCENE_DISTRIBUTED, 0, 0, 1, 0);
    s->load[0].range[0] = from;
    s->load[0].range[1] = to;
    return &s->load[0];
}

static void end_value(scene *s)
{
    scene_load *l = spread(s, 0, 1);
    l->varies = 1;
    l->last[1] = NAN;
}

static void no_range(scene *s)
{
    spread(s, 0, 0);
}

static void range_falls(scene *s)
{
    spread(s, 0.5, 0.25);
}

static void range_beyond(scene *s)
{
    spread(s, 0.5, 1.5);
}

static void range_before(scene *s)
{
    spread(s, -0.5, 0.5);
}

static void range_nowhere(scene *s)
{
    spread(s, NAN, 1);
}

static void moments_fall(scene *s)
{
    spread(s, 1, 0)->kind = SCENE_DISTRIBUTED_MOMENT;
}

static scene_load *within(scene *s, scene_load_kind kind, double place)
{
    s->loads = 0;
    return scene_load_at(s, scene_add_load_within(s, kind, 0, place, 0, 1, 0));
}

static void place_beyond(scene *s)
{
    within(s, SCENE_MEMBER_FORCE, 1.25);
}

static void place_nowhere(scene *s)
{
    within(s, SCENE_MEMBER_MOMENT, NAN);
}

static void two_places(scene *s)
{
    within(s, SCENE_MEMBER_FORCE, 0.25)->range[1] = 0.5;
}

static void place_of_no_member(scene *s)
{
    within(s, SCENE_MEMBER_FORCE, 0.25)->where = 1;
}

static void place_varies(scene *s)
{
    within(s, SCENE_MEMBER_FORCE, 0.25)->varies = 1;
}

static void place_lumped(scene *s)
{
    within(s, SCENE_MEMBER_FORCE, 0.25)->lumped = 1;
}

static void moment_within_beside(scene *s)
{
    within(s, SCENE_MEMBER_MOMENT, 0.25)->at[1] = 0.5;
}

static void node_varies(scene *s)
{
    s->load[0].varies = 1;
}

static void node_lumped(scene *s)
{
    s->load[0].lumped = 1;
}

static void node_range(scene *s)
{
    s->load[0].range[1] = 1;
}

static scene_load *heavy(scene *s)
{
    s->load[0] = scene_load_of(SCENE_GRAVITY, 0, 0, 0, -9.81);
    return &s->load[0];
}

static void gravity_on_part(scene *s)
{
    heavy(s)->range[1] = 0.5;
}

static void gravity_varies(scene *s)
{
    heavy(s)->varies = 1;
}

static void load_nowhere(scene *s)
{
    s->load[0].at[1] = INFINITY;
}

static void moment_beside(scene *s)
{
    s->load[0].kind = SCENE_MOMENT;
    s->load[0].at[0] = 1;
}

static void node_along(scene *s)
{
    s->load[0].axes = SCENE_AXES_MEMBER;
}

static void weight_turns(scene *s)
{
    s->load[0] = scene_load_of(SCENE_GRAVITY, 0, 0, 0, 0);
    s->load[0].follower = 1;
}

static void weightless(scene *s)
{
    section_spec *spec = &s->section[0];
    spec->kind = SECTION_RECTANGLE;
    spec->young = spec->shear_modulus = spec->width = spec->height = 1;
    spec->density = 0;
    s->load[0] = scene_load_of(SCENE_GRAVITY, 0, 0, 0, -9.81);
}

static void body_weightless(scene *s)
{
    s->load[0] = scene_load_of(SCENE_WEIGHT, TIP, 0, 0, -9.81);
}

static void unknown_driver(scene *s)
{
    scene_drive(s, TIP, SCENE_UZ, scene_add_unknown_driver(s, "sought", TIP, SCENE_UY, SCENE_NONE));
}

static void condition_not_driven(scene *s)
{
    scene_drive(s, TIP, SCENE_UZ, scene_add_unknown_driver(s, "sought", TIP, SCENE_UX, 0));
}

static void condition_nowhere(scene *s)
{
    scene_drive(s, TIP, SCENE_UZ, scene_add_unknown_driver(s, "sought", 9, SCENE_UY, 0));
}

static scene_spring *spring_of(scene *s)
{
    const double stiffness[36] = {[0] = 4, [1] = 1, [6] = 1, [7] = 2, [35] = 3};
    const int i = scene_add_spring(s, 0, 1, stiffness);
    return &s->spring[i];
}

static void spring_nowhere(scene *s)
{
    spring_of(s)->q = 9;
}

static void spring_of_one(scene *s)
{
    spring_of(s)->p = 1;
}

static void unsymmetric_damping(scene *s)
{
    const double c[36] = {[0] = 1, [1] = 3, [6] = 1, [7] = 3};
    scene_spring *p = spring_of(s);
    memcpy(p->damping, c, sizeof c);
}

static void endless_spring(scene *s)
{
    spring_of(s)->stiffness[1] = INFINITY;
}

static void negative_spring(scene *s)
{
    spring_of(s)->stiffness[14] = -1;
}

static void indefinite_spring(scene *s)
{
    double *K = spring_of(s)->stiffness;
    K[1] = K[6] = 2.9;
}

static void coupled_to_nothing(scene *s)
{
    double *K = spring_of(s)->stiffness;
    K[2] = K[12] = 0.1;
}

static const refusal refusals[] = {
    {spring_nowhere, "spring 0: ", "to: node 9 does not exist"},
    {spring_of_one, "spring 0: ", "both ends are at node 1"},
    {unsymmetric_damping, "spring 0: ", "its damping would supply energy"},
    {endless_spring, "spring 0: ", "its stiffness would supply energy"},
    {negative_spring, "spring 0: ", "would supply energy"},
    {indefinite_spring, "spring 0: ", "would supply energy"},
    {coupled_to_nothing, "spring 0: ", "would supply energy"},
    {end_of_member, "member 0: ", "to: node 5 does not exist"},
    {no_section, "member 0: ", "the section does not exist"},
    {no_length, "member 0: ", "its ends coincide"},
    {y_along, "member 0: ", "its y axis is zero or parallel"},
    {no_y, "member 0: ", "its y axis is zero or parallel"},
    {divisions, "member 0: ", "divisions = -3"},
    {damping, "member 0: ", "damping = -0.001; give at least 0"},
    {idle_driver, "motion push", "prescribes no coordinate"},
    {unknown_driver, "motion sought: ", "motion: no motion is named"},
    {condition_not_driven, "motion sought: ", "the coordinate in its condition is not prescribed"},
    {condition_nowhere, "motion sought: ", "node: node 9 does not exist"},
    {value_of_driver, "motion push: ", "value 1 is NaN or Inf"},
    {path_of_driver, "motion push: ", "must ascend"},
    {no_load_there, "load 0: ", "does not exist"},
    {no_member_loaded, "load 0: ", "does not exist"},
    {load, "load 0: ", "NaN or Inf"},
    {load_nowhere, "load 0: ", "at = "},
    {end_value, "load 0: ", "NaN or Inf"},
    {no_range, "load 0: ", "from 0 to 0 of the member's length"},
    {range_falls, "load 0: ", "from 0.5 to 0.25 of the member's length"},
    {range_beyond, "load 0: ", "from 0.5 to 1.5 of the member's length"},
    {range_before, "load 0: ", "from -0.5 to 0.5 of the member's length"},
    {range_nowhere, "load 0: ", "from nan to 1 of the member's length"},
    {moments_fall, "load 0: ", "from 1 to 0 of the member's length"},
    {place_beyond, "load 0: ", "is the fraction 1.25 of the member's length"},
    {place_nowhere, "load 0: ", "is the fraction nan of the member's length"},
    {two_places, "load 0: ", "is the fraction 0.25 of the member's length"},
    {place_of_no_member, "load 0: ", "does not exist"},
    {place_varies, "load 0: ", "only a distributed load can vary"},
    {place_lumped, "load 0: ", "only distributed loads, and gravity on members, can be"},
    {moment_within_beside, "load 0: ", "only forces act at an offset"},
    {node_varies, "load 0: ", "only a distributed load can vary"},
    {node_lumped, "load 0: ", "only distributed loads, and gravity on members, can be"},
    {node_range, "load 0: ", "is at a node"},
    {gravity_on_part, "load 0: ", "the weight of a whole member"},
    {gravity_varies, "load 0: ", "only a distributed load can vary"},
    {moment_beside, "load 0: ", "only forces act at an offset"},
    {node_along, "load 0: ", "in a member's axes but acts on a node"},
    {weight_turns, "load 0: ", "gravity has fixed axes"},
    {weightless, "load 0: ", "no density"},
    {body_weightless, "load 0: ", "no mass"},
};

static void reports_out_of_memory(void)
{
    scene s;
    fault f = {""};
    refuse_unchanged(&s);
    s.out_of_memory = 1;
    gsl_test_int((int)scene_validate(&s, &f), STATUS_FAULT, "no memory: %s", f.text);
    gsl_test(strstr(f.text, "sound: out of memory") == NULL, "no memory: %s", f.text);
    scene_free(&s);
}

static void reports_what_paths_lack(void)
{
    scene s;
    fault f = {""};
    refuse_unchanged(&s);
    scene_drive(&s, TIP, SCENE_UZ, scene_add_unknown_driver(&s, "sought", TIP, SCENE_UY, 0));
    gsl_test_int((int)scene_inputs_check(&s, 0, &f), STATUS_OK, "sought along a path: %s", f.text);
    const int other[] = {scene_add_linear(&s), scene_add_buckling(&s, SCENE_NONE)};
    for (int i = 0; i < 2; i++)
        gsl_test(scene_inputs_check(&s, other[i], &f) != STATUS_REFUSED ||
                     strstr(f.text, "motion sought") == NULL,
                 "an unknown motion in analysis %d: %s", other[i], f.text);
    scene_free(&s);
}

static void accepts(void)
{
    static const double place[] = {0, 0.5, 1};
    for (int i = 0; i < 12; i++) {
        scene s;
        fault f = {""};
        refuse_unchanged(&s);
        if (i < 6) {
            scene_load *l =
                within(&s, i % 2 ? SCENE_MEMBER_FORCE : SCENE_MEMBER_MOMENT, place[i / 2]);
            l->axes = SCENE_AXES_MEMBER;
            l->follower = 1;
            l->at[2] = i % 2 ? 0.1 : 0;
        } else {
            scene_load *l = spread(&s, place[i / 6 - 1], place[1 + i % 2]);
            l->kind = i % 3 ? SCENE_DISTRIBUTED : SCENE_DISTRIBUTED_MOMENT;
            l->lumped = l->varies = i % 2;
        }
        gsl_test(scene_validate(&s, &f) != STATUS_OK, "load %d on a member: %s", i, f.text);
        scene_free(&s);
    }
}

static void acts_where_it_ends(void)
{
    scene_load l = scene_load_of(SCENE_DISTRIBUTED, 0, 0, 0, 0);
    l.follower = 1;
    l.last[1] = 2;
    gsl_test(scene_load_acts(&l) || scene_load_unsymmetric(&l), "what does not vary has no end");
    l.varies = 1;
    gsl_test(!scene_load_acts(&l) || !scene_load_unsymmetric(&l), "it acts where it ends");
    gsl_test(l.range[0] != 0 || l.range[1] != 1, "all along its member");
    l = scene_load_of(SCENE_MEMBER_MOMENT, 0, 0, 1, 0);
    gsl_test(!scene_load_unsymmetric(&l), "a moment within a member");
    l = scene_load_of(SCENE_MEMBER_FORCE, 0, 0, 1, 0);
    gsl_test(scene_load_unsymmetric(&l) || !scene_load_along(&l), "a force within a member");
}

int main(void)
{
    accepts();
    acts_where_it_ends();
    reports_what_paths_lack();
    refuse_all(sizeof refusals / sizeof refusals[0], refusals);
    reports_out_of_memory();
    return gsl_test_summary();
}
