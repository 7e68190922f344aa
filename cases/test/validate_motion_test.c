/* Rejected transient analyses and functions of time. */
#include <math.h>
#include <stdlib.h>

#include "cases/test/refuse.h"

static scene_motion *moves_from(scene *s, int follows)
{
    const double station[] = {0.5, 2};
    s->section[0] = section_spec_rectangle(1e9, 4e8, 0.01, 0.01);
    s->section[0].density = 1000;
    const int i = scene_add_motion(
        s, follows, 2, station,
        (scene_motion){.alpha = scene_alpha_of_radius(0.9), .step = 0.1, .tolerance = 1e-4});
    return &s->analysis[i].of.motion;
}

static scene_motion *moves(scene *s)
{
    return moves_from(s, 0);
}

static void drives(scene *s, const char *first, const char *then)
{
    moves(s);
    scene_drive_piece(s, 0, then != NULL ? 1 : 0, first);
    if (then != NULL)
        scene_drive_piece(s, 0, 0, then);
}

static void requests(scene *s, scene_extract what)
{
    moves(s);
    scene_add_quantity(s, "asked", "1", 1, what);
}

static void step_of_nothing(scene *s)
{
    moves(s)->step = 0;
}

static void step_without_end(scene *s)
{
    moves(s)->step = INFINITY;
}

static void tolerance_below(scene *s)
{
    moves(s)->tolerance = -1e-4;
}

static void tolerance_above(scene *s)
{
    moves(s)->tolerance = 1;
}

static void station_before(scene *s)
{
    moves(s)->path.value[0] = -0.5;
}

static void stations_fall(scene *s)
{
    moves(s)->path.value[1] = 0.25;
}

static void alpha_unstable(scene *s)
{
    moves(s)->alpha = (scene_alpha){0.3, 0.2};
}

static void alpha_beyond(scene *s)
{
    moves(s)->alpha = (scene_alpha){0.3, 0.6};
}

static void alpha_of_radius_beyond(scene *s)
{
    moves(s)->alpha = scene_alpha_of_radius(1.1);
}

static void integrator_unknown(scene *s)
{
    moves(s)->scheme = SCENE_SCHEMES;
}

static void starts_nowhere(scene *s)
{
    moves(s)->start.spin[2] = NAN;
}

static void without_mass(scene *s)
{
    moves(s);
    s->section[0].density = 0;
}

static void after_linear(scene *s)
{
    moves_from(s, scene_add_linear(s));
}

static void modes_of_motion(scene *s)
{
    moves(s);
    scene_add_modal(s, 1);
}

static void unknown_driver(scene *s)
{
    moves(s);
    scene_add_unknown_driver(s, "slide", TIP, SCENE_UY, 0);
    scene_drive(s, TIP, SCENE_UX, 1);
}

static void values_over_no_path(scene *s)
{
    moves_from(s, SCENE_NONE);
}

static void factors_over_no_path(scene *s)
{
    const double path[] = {0, 1};
    moves_from(s, SCENE_NONE);
    s->driver[0].value[1] = 0;
    scene_drive_piece(s, 0, 0, "t");
    scene_set_factor(s, 0, 2, path, path);
}

static void begins_elsewhere(scene *s)
{
    drives(s, "t^2", NULL);
}

static void driver_jumps(scene *s)
{
    drives(s, "1 + t^2", "3*t - 0.5");
}

static void driver_hits(scene *s)
{
    drives(s, "1 + t^2", "2");
}

static void driver_without_acceleration(scene *s)
{
    drives(s, "1 + t^1.5", NULL);
}

static void driver_unread(scene *s)
{
    drives(s, "1 + x", NULL);
}

static void pieces_fall(scene *s)
{
    moves(s);
    scene_load_piece(s, 0, 2, "1");
    scene_load_piece(s, 0, 1, "2");
    scene_load_piece(s, 0, 0, "3");
}

static void load_without_value(scene *s)
{
    moves(s);
    scene_load_piece(s, 0, 0, "1/t");
}

static void idle_function(scene *s)
{
    scene_load_piece(s, 0, 0, "t");
}

static void relative_to_itself(scene *s)
{
    requests(s, scene_relative_to(TIP, SCENE_UX, TIP));
}

static void orientation_of_nothing(scene *s)
{
    requests(s, scene_orientation_entry(TIP, 3, 0));
}

static void rate_of_nothing(scene *s)
{
    requests(s, scene_rate(9, SCENE_UX));
}

static void rate_at_rest(scene *s)
{
    scene_add_quantity(s, "v", "m/s", 0, scene_rate(TIP, SCENE_UX));
}

static void frequency_of_motion(scene *s)
{
    requests(s, scene_frequency(0, SCENE_ANY));
}

static const refusal refusals[] = {
    {step_of_nothing, "analysis 1: ", "the time step is 0 s"},
    {step_without_end, "analysis 1: ", "step = inf"},
    {tolerance_below, "analysis 1: ", "the tolerance is -0.0001"},
    {tolerance_above, "analysis 1: ", "the tolerance is 1;"},
    {station_before, "analysis 1: ", "a station is at -0.5 s"},
    {stations_fall, "analysis 1: ", "must ascend"},
    {alpha_unstable, "analysis 1: ", "alpha_m = 0.3 and alpha_f = 0.2, alpha is not"},
    {alpha_beyond, "analysis 1: ", "not unconditionally stable"},
    {alpha_of_radius_beyond, "analysis 1: ", "not unconditionally stable"},
    {integrator_unknown, "analysis 1: ", "unknown integrator"},
    {starts_nowhere, "analysis 1: ", "spin = nan"},
    {without_mass, "analysis 1: ", "the structure has no mass"},
    {after_linear, "analysis 2: ", "of the kind 'linear'"},
    {modes_of_motion, "analysis 2: ", "at an instant of a motion"},
    {unknown_driver, "motion slide: ", "its value is unknown"},
    {values_over_no_path, "motion push: ", "its values are given over a path"},
    {factors_over_no_path, "load 0: ", "its factors are given over a path"},
    {begins_elsewhere, "motion push: ", "its value at 0 s is 0, but the analysis starts from 1"},
    {driver_jumps, "motion push: ", "the value jumps at 1 s"},
    {driver_hits, "motion push: ", "the velocity jumps at 1 s"},
    {driver_without_acceleration, "motion push: ", "at 0 s its value, velocity or acceleration"},
    {driver_unread, "motion push: ", "character 5: the name 'x' is unknown"},
    {pieces_fall, "load 0: ", "piece 2 ends at 1 s, not after"},
    {load_without_value, "load 0: ", "at 0 s the factor is not finite"},
    {idle_function, "load 0: ", "no analysis is a motion"},
    {relative_to_itself, "quantity asked: ", "are the same node"},
    {orientation_of_nothing, "quantity asked: ", "row: the value 3 is invalid; give one of x|y|z"},
    {rate_of_nothing, "quantity asked: ", "node: node 9 does not exist"},
    {rate_at_rest, "quantity v: ", "does not provide this kind"},
    {frequency_of_motion, "quantity asked: ", "does not provide this kind"},
};

static void accepts(void (*how)(scene *), const char *what)
{
    scene s;
    fault f = {""};
    refuse_unchanged(&s);
    how(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "%s: %s", what, f.text);
    scene_free(&s);
}

static void held(scene *s)
{
    moves(s);
}

static void continues_another(scene *s)
{
    drives(s, "1 + t^2", "2*t");
    scene_load_piece(s, 0, 1, "1");
    scene_load_piece(s, 0, 0, "sqrt(t)");
}

static void without_alpha(scene *s)
{
    scene_motion *m = moves(s);
    m->scheme = SCENE_RADAU;
    m->alpha = (scene_alpha){3, 2};
}

static void turns_steadily(scene *s)
{
    const double one = 1;
    const scene_rotating_frame frame = {.omega = {0, 0, 1}};
    moves_from(s, scene_add_rotation(s, 1, &one, 1, 0, frame));
}

static void weighs_at_a_node(scene *s)
{
    moves(s);
    s->section[0].density = 0;
    scene_set_body(s, BODY, (scene_body){.mass = 1});
}

static void validate_motion_tests(void)
{
    refuse_all(sizeof refusals / sizeof refusals[0], refusals);
    accepts(held, "what no function moves stays at the end of the path");
    accepts(continues_another,
            "a driver goes on where the path has left it, a load may do anything");
    accepts(without_alpha, "parameters of another integrator");
    accepts(turns_steadily, "a start from a stationary rotation");
    accepts(weighs_at_a_node, "a mass at a node only");
}

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

static void corrupt_body(scene *s, scene_body b)
{
    scene_set_body(s, 1, b);
}

static void negative_mass(scene *s)
{
    corrupt_body(s, (scene_body){.mass = -1});
}

static void endless_inertia(scene *s)
{
    corrupt_body(s, (scene_body){.mass = 1, .inertia = {INFINITY, 1, 1}});
}

static void centre_of_nothing(scene *s)
{
    corrupt_body(s, (scene_body){.centre = {0, 1, 0}});
}

static void no_triangle(scene *s)
{
    corrupt_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 2.1}});
}

static void products_too_large(scene *s)
{
    corrupt_body(s, (scene_body){.mass = 1, .inertia = {1, 1, 1, 0.6, 0, 0}});
}

static void loose_mass(scene *s)
{
    scene_set_body(s, scene_add_node(s, 0, 0, 7), (scene_body){.mass = 1});
}

static const refusal node_refusals[] = {
    {position, "node 1: ", "at = "},
    {driver_of_node, "node 1: ", "its motion does not exist"},
    {half_a_vector, "node 1: ", "three motions"},
    {fork_and_held, "node 0: ", "its fork determines all rotations, but rx is also fixed"},
    {web_along, "node 1: ", "not perpendicular"},
    {no_web, "node 1: ", "not perpendicular"},
    {fork_across, "node 1: ", "no member at this node runs along"},
    {body_of_body, "node 1: ", "attached to node 2, which is itself attached to another"},
    {body_of_itself, "node 2: ", "attached to itself"},
    {body_of_nothing, "node 2: ", "part_of: node 9 does not exist"},
    {body_held, "node 2: ", "from moving with node 1"},
    {negative_mass, "node 1: ", "mass = -"},
    {endless_inertia, "node 1: ", "inertia = "},
    {centre_of_nothing, "node 1: ", "a centre is given without a mass"},
    {no_triangle, "node 1: ", "no body has this inertia"},
    {products_too_large, "node 1: ", "no body has this inertia"},
    {loose_mass, "node 3: ", "the body is not connected"},
};

static void validate_node_tests(void)
{
    refuse_all(sizeof node_refusals / sizeof node_refusals[0], node_refusals);
}

static void driven(scene *s)
{
    const double station[] = {0, 1};
    free(scene_path_of(&s->analysis[0])->value);
    s->analyses = 0;
    scene_add_continuation(
        s, 2, station,
        (scene_control){.node = TIP, .component = SCENE_UX, .step = 0.1, .step_max = 0.1});
}

static void continued(scene *s)
{
    driven(s);
    scene_drive(s, TIP, SCENE_UY, SCENE_FREE);
    free(s->driver[0].path);
    free(s->driver[0].value);
    s->drivers = 0;
}

static void follows_itself(scene *s)
{
    s->analysis[0].follows = 0;
}

static void stations(scene *s)
{
    s->analysis[0].of.walk.path.value[1] = -1;
}

static void no_station(scene *s)
{
    s->analysis[0].of.walk.path.stations = 0;
}

static void spin(scene *s)
{
    scene_set_rotating_frame(s, 0, (scene_rotating_frame){.omega = {0, 0, NAN}});
}

static void two_names(scene *s)
{
    scene_add_quantity(s, "u", "m", 0, scene_coordinate(TIP, SCENE_UX));
}

static void no_analysis(scene *s)
{
    s->quantity[0].analysis = 1;
}

static void no_coordinate(scene *s)
{
    s->quantity[0].what.of.component.component = 6;
}

static void not_of_a_path(scene *s)
{
    scene_add_quantity(s, "frequency", "Hz", 0, scene_frequency(0, SCENE_ANY));
}

static void no_entry(scene *s)
{
    const int at_tip = scene_add_compliance(s, 0, (scene_compliance){.node = TIP});
    scene_add_quantity(s, "entry", "m/N", at_tip, scene_compliance_entry(SCENE_UX, 6));
}

static void no_driver(scene *s)
{
    scene_add_quantity(s, "angle", "rad", 0, scene_driver_value(1));
}

static void uncontrolled(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.component = SCENE_RX;
}

static void step(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.step = 0;
}

static void smaller_step(scene *s)
{
    continued(s);
    s->analysis[0].of.continuation.control.step_max = 0.05;
}

static void compliance_nowhere(scene *s)
{
    scene_add_compliance(s, SCENE_NONE, (scene_compliance){.node = SCENE_NONE});
}

static void compliance_of_compliance(scene *s)
{
    const scene_compliance at_tip = {.node = TIP};
    scene_add_compliance(s, scene_add_compliance(s, 0, at_tip), at_tip);
}

static void critical_about_linear(scene *s)
{
    scene_add_buckling(s, scene_add_linear(s));
}

static void critical_about_buckling(scene *s)
{
    scene_add_buckling(s, scene_add_buckling(s, SCENE_NONE));
}

static void frequencies_about_rotation(scene *s)
{
    const double end = 1;
    scene_add_modal(
        s, scene_add_rotation(s, 1, &end, 1, 0, (scene_rotating_frame){.omega = {0, 0, 1}}));
}

static void station_of_linear(scene *s)
{
    scene_set_at(
        scene_add_quantity(s, "v", "m", scene_add_linear(s), scene_coordinate(TIP, SCENE_UY)), 0.5);
}

static void station_of_frequencies_about_a_path(scene *s)
{
    const double end = 1;
    scene_set_at(scene_add_quantity(s, "f", "Hz",
                                    scene_add_modal(s, scene_add_static(s, 1, &end, 1)),
                                    scene_frequency(0, SCENE_ANY)),
                 0.5);
}

static void largest_of_frequencies(scene *s)
{
    scene_add_quantity(s, "f", "Hz", scene_add_modal(s, 0), scene_frequency(0, SCENE_ANY))
        ->reduction = SCENE_MAX;
}

static const refusal wanted_refusals[] = {
    {follows_itself, "analysis 0: ", "does not precede this one"},
    {stations, "analysis 0: ", "must ascend"},
    {no_station, "analysis 0: ", "has no stations"},
    {spin, "analysis 0: ", "omega = "},
    {uncontrolled, "analysis 0: ", "component: the value 3 is invalid; give one of ux|uy|uz"},
    {step, "analysis 0: ", "the initial step is 0 and the largest step is 0.1"},
    {smaller_step, "analysis 0: ", "the initial step is 0.1 and the largest step is 0.05"},
    {compliance_nowhere, "analysis 1: ", "node: no node is named; name one"},
    {compliance_of_compliance, "analysis 2: ", "computed about a path"},
    {critical_about_linear, "analysis 2: ", "name a static analysis, or remove 'about'"},
    {critical_about_buckling, "analysis 2: ", "name a static analysis, or remove 'about'"},
    {frequencies_about_rotation, "analysis 2: ", "request the frequencies of the rotation itself"},
    {station_of_linear, "quantity v: ", "analysis 1 has one state and no stations"},
    {largest_of_frequencies, "quantity f: ", "analysis 1 is about the last state of"},
    {station_of_frequencies_about_a_path, "quantity f: ", "for an earlier state, add a path"},
    {two_names, "quantity u: ", "two quantities have this name"},
    {no_analysis, "quantity u: ", "analysis: analysis 1 does not exist"},
    {no_coordinate, "quantity u: ", "component: the value 6 is invalid"},
    {not_of_a_path, "quantity frequency: ", "does not provide this kind"},
    {no_entry, "quantity entry: ", "column: the value 6 is invalid"},
    {no_driver, "quantity angle: ", "motion: motion 1 does not exist"},
};

static void accepts_continuation(void)
{
    scene s;
    fault f = {""};
    refuse_unchanged(&s);
    continued(&s);
    gsl_test(scene_validate(&s, &f) != STATUS_OK, "a continued path is sound: %s", f.text);
    scene_free(&s);
}

static void validate_wanted_tests(void)
{
    refuse_all(sizeof wanted_refusals / sizeof wanted_refusals[0], wanted_refusals);
    accepts_continuation();
}

int main(void)
{
    validate_motion_tests();
    validate_node_tests();
    validate_wanted_tests();
    return gsl_test_summary();
}
